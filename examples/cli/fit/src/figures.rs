//! Figures of a joint fit: the cloud with the prediction, predicted against measured, residuals, and a confidence region.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::{JointFit, NAMES};

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws four panels into an SVG file.
///
/// # Errors
/// A file that cannot be written.
pub fn draw(fit: &JointFit, path: &Path) -> Result<(), Box<dyn Error>> {
    let area = SVGBackend::new(path, (1200, 900)).into_drawing_area();
    area.fill(&WHITE)?;
    if let [cloud, predicted, residuals, region] = &area.split_evenly((2, 2))[..] {
        draw_cloud(fit, cloud)?;
        draw_predicted(fit, predicted)?;
        draw_residuals(fit, residuals)?;
        draw_region(fit, region)?;
    }
    area.present()?;
    Ok(())
}

/// A panel with points and lines in it.
fn panel(
    area: &Panel<'_>,
    caption: &str,
    (x, y): (std::ops::Range<f64>, std::ops::Range<f64>),
    (x_name, y_name): (&str, &str),
    points: &[(f64, f64)],
    lines: &[Vec<(f64, f64)>],
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .caption(caption, ("sans-serif", 18))
        .margin(10)
        .set_label_area_size(LabelAreaPosition::Left, 60)
        .set_label_area_size(LabelAreaPosition::Bottom, 40)
        .build_cartesian_2d(x, y)?;
    chart.configure_mesh().light_line_style(TRANSPARENT).x_desc(x_name).y_desc(y_name).draw()?;
    chart.draw_series(points.iter().map(|at| Circle::new(*at, 2, BLUE.filled())))?;
    for line in lines {
        chart.draw_series(LineSeries::new(line.iter().copied(), &RED))?;
    }
    Ok(())
}

fn fastest(fit: &JointFit) -> f64 {
    1.05 * fit.predictions.iter().map(|(impact, _)| impact.speed).fold(1e-3, f64::max)
}

fn draw_cloud(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let points: Vec<_> = fit.predictions.iter().map(|(impact, _)| (impact.speed, impact.restitution)).collect();
    let mut sorted = fit.predictions.clone();
    sorted.sort_by(|a, b| a.0.speed.total_cmp(&b.0.speed));
    let line = |deviations: f64| {
        let at = |moments: &super::Moments<f64>| moments.mean + deviations * moments.variance.sqrt();
        sorted.iter().map(|(impact, moments)| (impact.speed, at(moments))).collect()
    };
    let lines = [line(-2.0), line(0.0), line(2.0)];
    let names = ("approach speed, m/s", "e");
    panel(area, "Cloud, mean and two deviations of diameters", (0.0..fastest(fit), 0.0..1.05), names, &points, &lines)
}

fn draw_predicted(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let points: Vec<_> = fit.predictions.iter().map(|(impact, moments)| (moments.mean, impact.restitution)).collect();
    let names = ("predicted mean of e", "measured e");
    panel(area, "Predicted against measured", (0.0..1.05, 0.0..1.05), names, &points, &[vec![(0.0, 0.0), (1.0, 1.0)]])
}

fn draw_residuals(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let points: Vec<_> = fit.residuals().collect();
    let (names, reach) = (("approach speed, m/s", "standard deviations"), fastest(fit));
    panel(area, "Residuals", (0.0..reach, -4.0..4.0), names, &points, &[vec![(0.0, 0.0), (reach, 0.0)]])
}

fn draw_region(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let outline = fit.region(0, 2);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) = outline.iter().map(of).fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        let room = 0.1 * (high - low) + 1e-9 * high.abs();
        low - room..high + room
    };
    let ranges = (range(|at| at.0), range(|at| at.1));
    let centre = [(fit.parameters[0], fit.parameters[2])];
    panel(area, "Region of 95 %", ranges, (NAMES[0].0, NAMES[2].0), &centre, std::slice::from_ref(&outline))
}
