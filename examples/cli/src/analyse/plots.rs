//! Figures of the paper's kinds: velocity ratio against speed, and impulse ratio against angle of incidence.

use std::error::Error;
use std::path::Path;

use impact_fit::Verdict;
use microimpact::{ConstantRestitution, NormalMotion, RigidBody};
use plotters::style::{BLACK, RED};

use super::summary::{Point, Summary};
use crate::figure::{Line, chart, drawing};

const SIZE: (u32, u32) = (800, 500);

/// Overall restitution against approach speed (figure 6), with the fitted curve of the rigid-body model (A34).
pub fn velocity_ratio(path: &Path, summary: &Summary) -> Result<(), Box<dyn Error>> {
    let area = drawing(path, SIZE)?;
    let fastest = largest(summary, |point| point.rebound.speed);
    let points = summary.sample.iter().map(|point| (point.rebound.speed, point.rebound.restitution));
    let mut lines: Vec<Line> = Vec::new();
    if let Verdict::Fits(statement) = summary.restitution() {
        let curve = (1..=400).map(|step| 1.05 * fastest * f64::from(step) / 400.0);
        lines.push((BLACK, curve.map(|speed| (speed, statement.fit.restitution(speed))).collect()));
    }
    let axes = [(0.0..1.05 * fastest, "approach speed, m/s"), (0.0..1.0, "e")];
    chart(&area, "Velocity ratio against approach speed", axes, points, lines)?;
    Ok(area.present()?)
}

/// Impulse ratio against angle of incidence (figure 4). Lines show the bound mu_0 without spin and for the largest spin of
/// the sample, at the mean speed and restitution of the sample.
pub fn impulse_ratio(path: &Path, summary: &Summary) -> Result<(), Box<dyn Error>> {
    let area = drawing(path, SIZE)?;
    let reach = 1.2 * largest(summary, |point| point.slowing.abs());
    let points = summary.sample.iter().map(|point| (point.incidence, point.slowing));
    let mut lines: Vec<Line> = Vec::new();
    if let Some(first) = summary.sample.first() {
        let mean =
            |of: &dyn Fn(&Point) -> f64| summary.sample.iter().map(of).sum::<f64>() / summary.sample.len() as f64;
        let (speed, restitution) = (mean(&|point| point.speed), mean(&|point| point.rebound.restitution));
        let law = ConstantRestitution::new(restitution.clamp(0.0, 1.0))?;
        let scene = RigidBody::new(first.sphere, law).with_friction(0.0)?;
        let spin = largest(summary, |point| point.peripheral.abs());
        for (peripheral, colour) in [(0.0, BLACK), (spin, RED), (-spin, RED)] {
            let bound = (5..=900).filter_map(|step| {
                let angle = f64::from(step) / 10.0;
                let (normal, tangential) = angle.to_radians().sin_cos();
                let motion = NormalMotion::new(speed * normal).ok()?.with_tangential(speed * tangential).ok()?;
                let motion = motion.with_peripheral_velocity(peripheral).ok()?;
                let ratio = -scene.impact(&motion).tangential.rolling_ratio();
                (ratio.abs() <= reach).then_some((angle, ratio))
            });
            lines.push((colour, bound.collect()));
        }
    }
    let axes = [(0.0..92.0, "angle of incidence, degrees"), (-reach..reach, "mu against the motion")];
    chart(&area, "Impulse ratio against angle of incidence", axes, points, lines)?;
    Ok(area.present()?)
}

/// Largest value over the sample, and at least a small one, so that there is an axis.
fn largest(summary: &Summary, of: impl Fn(&Point) -> f64) -> f64 {
    summary.sample.iter().map(of).fold(1e-3, f64::max)
}
