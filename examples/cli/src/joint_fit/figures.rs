//! Figures of a joint fit: measured impacts with the prediction, predicted against measured, residuals, and a confidence
//! region.

use std::error::Error;
use std::path::Path;

use joint_fit::{JointFit, Moments, NAMES};
use plotters::style::RED;

use crate::figure::{Panel, chart, drawing};

/// Draws four panels into an SVG file.
///
/// # Errors
/// The file cannot be written.
pub fn draw(fit: &JointFit, path: &Path) -> Result<(), Box<dyn Error>> {
    let area = drawing(path, (1200, 900))?;
    if let [cloud, predicted, residuals, region] = &area.split_evenly((2, 2))[..] {
        draw_cloud(fit, cloud)?;
        draw_predicted(fit, predicted)?;
        draw_residuals(fit, residuals)?;
        draw_region(fit, region)?;
    }
    Ok(area.present()?)
}

fn fastest(fit: &JointFit) -> f64 {
    1.05 * fit.predictions.iter().map(|(impact, _)| impact.speed).fold(1e-3, f64::max)
}

fn draw_cloud(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let points = fit.predictions.iter().map(|(impact, _)| (impact.speed, impact.restitution));
    let mut sorted = fit.predictions.clone();
    sorted.sort_by(|a, b| a.0.speed.total_cmp(&b.0.speed));
    let line = |deviations: f64| {
        let at = |moments: &Moments<f64>| moments.mean + deviations * moments.variance.sqrt();
        (RED, sorted.iter().map(|(impact, moments)| (impact.speed, at(moments))).collect())
    };
    let axes = [(0.0..fastest(fit), "approach speed, m/s"), (0.0..1.05, "e")];
    chart(area, "Cloud, mean and two deviations of diameters", axes, points, [-2.0, 0.0, 2.0].map(line))
}

fn draw_predicted(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let points = fit.predictions.iter().map(|(impact, moments)| (moments.mean, impact.restitution));
    let axes = [(0.0..1.05, "predicted mean of e"), (0.0..1.05, "measured e")];
    chart(area, "Predicted against measured", axes, points, [(RED, vec![(0.0, 0.0), (1.0, 1.0)])])
}

fn draw_residuals(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let reach = fastest(fit);
    let axes = [(0.0..reach, "approach speed, m/s"), (-4.0..4.0, "standard deviations")];
    chart(area, "Residuals", axes, fit.residuals(), [(RED, vec![(0.0, 0.0), (reach, 0.0)])])
}

fn draw_region(fit: &JointFit, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let outline = fit.region(0, 2);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) = outline.iter().map(of).fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
        let room = 0.1 * (high - low) + 1e-9 * high.abs();
        low - room..high + room
    };
    let axes = [(range(|at| at.0), NAMES[0].0), (range(|at| at.1), NAMES[2].0)];
    let centre = (fit.parameters[0], fit.parameters[2]);
    chart(area, "Region of 95 %", axes, std::iter::once(centre), [(RED, outline)])
}
