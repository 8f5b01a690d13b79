//! A figure of a population: capture efficiency by diameter, and bounce fraction by speed.

use std::error::Error;
use std::path::Path;

use plotters::style::{BLUE, RED, RGBColor};
use population::{Results, SizeBin};

use crate::figure::{Panel, chart, drawing};

/// Size of a panel.
const PANEL: (u32, u32) = (600, 450);

/// Draws a panel for the diameters, unless there is only one, and a panel for the speeds.
pub(super) fn draw(name: &str, results: &Results, path: &Path) -> Result<(), Box<dyn Error>> {
    let (Some(first), Some(last)) = (results.sizes.first(), results.sizes.last()) else {
        let area = drawing(path, PANEL)?;
        draw_speeds(name, results, &area)?;
        return Ok(area.present()?);
    };
    let area = drawing(path, (2 * PANEL.0, PANEL.1))?;
    if let [sizes, speeds] = &area.split_evenly((1, 2))[..] {
        draw_sizes(results, [first.from, last.to].map(micrometres), sizes)?;
        draw_speeds(name, results, speeds)?;
    }
    Ok(area.present()?)
}

fn micrometres(metres: f64) -> f64 {
    1e6 * metres
}

fn draw_sizes(results: &Results, [from, to]: [f64; 2], area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    // Steps, as each range of diameters has one efficiency.
    let steps = |colour: RGBColor, of: fn(&SizeBin) -> f64| {
        let line = results
            .sizes
            .iter()
            .flat_map(|size| [size.from, size.to].map(|diameter| (micrometres(diameter), of(size))));
        (colour, line.collect())
    };
    let lines = [steps(BLUE, |size| size.by_number.value), steps(RED, |size| size.by_mass.value)];
    let axes = [(from..to, "diameter, um"), (0.0..1.02, "captured part")];
    chart(area, "Capture efficiency by number (blue), mass (red)", axes, std::iter::empty(), lines)
}

fn draw_speeds(name: &str, results: &Results, area: &Panel<'_>) -> Result<(), Box<dyn Error>> {
    let fastest = results.bounces.iter().map(|bounce| bounce.speed).fold(0.0, f64::max);
    let points = results.bounces.iter().map(|bounce| (bounce.speed, bounce.bounce_fraction.value));
    let intervals = results
        .bounces
        .iter()
        .map(|bounce| (RED, bounce.interval.iter().map(|end| (bounce.speed, *end)).collect::<Vec<_>>()));
    let caption = format!("Bounce fraction, 95 % of {} particles: {name}", results.particles);
    let axes = [(0.0..1.05 * fastest, "speed, m/s"), (0.0..1.02, "bounce fraction")];
    chart(area, &caption, axes, points, intervals)
}
