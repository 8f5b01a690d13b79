//! Figures of the paper's kinds: velocity ratio against speed, and impulse ratio against angle of incidence.

use std::error::Error;
use std::path::Path;

use microimpact::{NormalMotion, RigidBody, SpeedRestitution, Sphere};
use plotters::coord::Shift;
use plotters::prelude::*;

use super::summary::{Point, Summary};

const SIZE: (u32, u32) = (800, 500);

type Drawing<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Overall restitution against approach speed (figure 6), with the curve of the rigid-body model (A34) through it.
pub fn velocity_ratio(path: &Path, summary: &Summary) -> Result<(), Box<dyn Error>> {
    let area = drawing(path)?;
    let fastest = largest(summary, |point| point.rebound.speed);
    let mut chart = ChartBuilder::on(&area)
        .caption("Velocity ratio against approach speed", ("sans-serif", 18))
        .margin(10)
        .set_label_area_size(LabelAreaPosition::Left, 50)
        .set_label_area_size(LabelAreaPosition::Bottom, 40)
        .build_cartesian_2d(0.0..1.05 * fastest, 0.0..1.0)?;
    chart.configure_mesh().light_line_style(TRANSPARENT).x_desc("approach speed, m/s").y_desc("e").draw()?;
    let points = summary.sample.iter().map(|point| (point.rebound.speed, point.rebound.restitution));
    chart.draw_series(points.map(|at| Circle::new(at, 2, BLUE.filled())))?;
    if let (Ok(fit), Some(first)) = (summary.restitution(), summary.sample.first()) {
        let law = SpeedRestitution::new(fit.restitution_speed.value)?;
        let sphere: Sphere<f64> = *first.sphere();
        let scene = RigidBody::new(sphere, law).with_work_of_adhesion(fit.work_of_adhesion.value)?;
        let curve = (1..=400).map(|step| 1.05 * fastest * f64::from(step) / 400.0).filter_map(|speed| {
            let motion = NormalMotion::new(speed).ok()?;
            Some((speed, scene.impact(&motion).normal.overall_restitution()))
        });
        chart.draw_series(LineSeries::new(curve, &BLACK))?;
    }
    area.present()?;
    Ok(())
}

/// Impulse ratio against angle of incidence (figure 4), with the bound mu_0 of spheres without spin and with the largest
/// spins of the sample, at its mean speed and restitution.
pub fn impulse_ratio(path: &Path, summary: &Summary) -> Result<(), Box<dyn Error>> {
    let area = drawing(path)?;
    let reach = 1.2 * largest(summary, |point| point.slowing.abs());
    let mut chart = ChartBuilder::on(&area)
        .caption("Impulse ratio against angle of incidence", ("sans-serif", 18))
        .margin(10)
        .set_label_area_size(LabelAreaPosition::Left, 50)
        .set_label_area_size(LabelAreaPosition::Bottom, 40)
        .build_cartesian_2d(0.0..92.0, -reach..reach)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("angle of incidence, degrees")
        .y_desc("mu against the motion")
        .draw()?;
    let points = summary.sample.iter().map(|point| (point.incidence, point.slowing));
    chart.draw_series(points.map(|at| Circle::new(at, 2, BLUE.filled())))?;
    if let Some(first) = summary.sample.first() {
        let mean =
            |of: &dyn Fn(&Point) -> f64| summary.sample.iter().map(of).sum::<f64>() / summary.sample.len() as f64;
        let (speed, restitution) = (mean(&|point| point.speed), mean(&|point| point.rebound.restitution));
        let spin = largest(summary, |point| point.peripheral.abs());
        for (peripheral, color) in [(0.0, BLACK), (spin, RED), (-spin, RED)] {
            let bound = (5..=900).filter_map(|step| {
                let angle = f64::from(step) / 10.0;
                let (normal, tangential) = angle.to_radians().sin_cos();
                let motion = NormalMotion::new(speed * normal).ok()?.with_tangential(speed * tangential).ok()?;
                let motion = motion.with_peripheral_velocity(peripheral).ok()?;
                let law = microimpact::ConstantRestitution::new(restitution.clamp(0.0, 1.0)).ok()?;
                let scene = RigidBody::new(*first.sphere(), law).with_friction(0.0).ok()?;
                let ratio = -scene.impact(&motion).tangential.rolling_ratio();
                (ratio.abs() <= reach).then_some((angle, ratio))
            });
            chart.draw_series(LineSeries::new(bound, &color))?;
        }
    }
    area.present()?;
    Ok(())
}

fn drawing(path: &Path) -> Result<Drawing<'_>, Box<dyn Error>> {
    let area = SVGBackend::new(path, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    Ok(area)
}

/// Largest value over the sample, and at least a small one, so that there is an axis.
fn largest(summary: &Summary, of: impl Fn(&Point) -> f64) -> f64 {
    summary.sample.iter().map(of).fold(1e-3, f64::max)
}
