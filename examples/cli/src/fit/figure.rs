//! The figure of a fit: impacts with the fitted curve and the critical speed above, residuals below.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use impact_fit::{Interval, Observation, Statement, Verdict};
use plotters::prelude::*;

use crate::figure::{Chart, Panel, axes, drawing};

const SIZE: (u32, u32) = (900, 800);

/// Name of the axis of both parts.
const SPEED: &str = "approach speed, m/s";

/// Height of the upper part.
const UPPER: u32 = 540;

/// Residuals beyond this are drawn as outliers.
const OUTLIER: f64 = 4.0;

/// Height of the legend over the range of the impacts.
const LEGEND: f64 = 0.22;

/// Points of a curve.
const POINTS: u32 = 400;

const REBOUND: RGBColor = RGBColor(31, 119, 180);
const CAPTURE: RGBColor = RGBColor(255, 127, 14);
const FAR: RGBColor = RGBColor(148, 103, 189);
const CURVE: RGBColor = RGBColor(200, 30, 30);
const CRITICAL: RGBColor = RGBColor(20, 130, 60);

/// A class of impacts, with its colour and the impacts in it.
struct Class<'a> {
    name: &'static str,
    colour: RGBColor,
    impacts: Vec<(&'a Observation, Option<f64>)>,
}

/// Draws a fit, or the impacts alone if no law fits them.
///
/// # Errors
/// The file cannot be written.
pub fn draw(path: &Path, observations: &[Observation], verdict: &Verdict) -> Result<(), Box<dyn Error>> {
    let area = drawing(path, SIZE)?;
    let statement = if let Verdict::Fits(statement) = verdict { Some(statement.as_ref()) } else { None };
    let classes = classes(observations, statement);
    let x = speeds(observations, statement);
    if let Some(statement) = statement {
        let (upper, lower) = area.split_vertically(UPPER);
        draw_impacts(&upper, x.clone(), &classes, Some(statement))?;
        draw_residuals(&lower, x, &classes)?;
    } else {
        draw_impacts(&area, x, &classes, None)?;
    }
    Ok(area.present()?)
}

fn classes<'a>(observations: &'a [Observation], statement: Option<&Statement>) -> Vec<Class<'a>> {
    let residuals = statement.map_or(vec![None; observations.len()], |statement| statement.fit.residuals());
    let mut classes = [("rebound", REBOUND), ("rebound beyond 4 standard deviations", FAR), ("capture", CAPTURE)]
        .map(|(name, colour)| Class { name, colour, impacts: Vec::new() });
    for (observation, residual) in observations.iter().zip(residuals) {
        let far = residual.is_some_and(|residual| residual.abs() > OUTLIER);
        let class = if observation.rebounds() { usize::from(far) } else { 2 };
        classes[class].impacts.push((observation, residual));
    }
    classes.into_iter().filter(|class| !class.impacts.is_empty()).collect()
}

/// The range of speeds, with the critical speed in it if that leaves no half of the axis empty.
fn speeds(observations: &[Observation], statement: Option<&Statement>) -> Range<f64> {
    let speed = |observation: &Observation| observation.speed;
    let (mut low, high) = observations.iter().map(speed).fold((f64::MAX, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    if let Some(critical) = critical(statement)
        && critical.low > 2.0 * low - high
    {
        low = low.min(critical.low);
    }
    let room = 0.04 * (high - low).max(0.1 * high);
    (low - room).max(0.0)..high + room
}

fn critical(statement: Option<&Statement>) -> Option<Interval> {
    statement?.quantity("critical_speed_m_s")
}

fn draw_impacts(
    area: &Panel<'_>,
    x: Range<f64>,
    classes: &[Class<'_>],
    statement: Option<&Statement>,
) -> Result<(), Box<dyn Error>> {
    let all = || classes.iter().flat_map(|class| &class.impacts).map(|(observation, _)| *observation);
    let reach = |observation: &Observation| {
        let (e, error) = (observation.restitution(), observation.restitution_error());
        (e - error, e + error)
    };
    let (low, high) = all().map(reach).fold((f64::MAX, f64::MIN), |(a, b), (low, high)| (a.min(low), b.max(high)));
    let room = 0.05 * (high - low).max(0.02);
    // The legend stands below the impacts.
    let low = low - LEGEND * (high - low);
    let caption = statement.map_or("Impacts; no law fits".to_owned(), |statement| {
        format!("Restitution, and its median by the law {}", statement.fit.law.name())
    });
    let mut chart = axes(area, &caption, [(x.clone(), SPEED), (low - room..high + room, "restitution e")])?;
    if let Some(statement) = statement {
        draw_curve(&mut chart, x, (low - room, high + room), statement)?;
    }
    for Class { name, colour, impacts } in classes {
        let colour = *colour;
        let bars = impacts.iter().flat_map(|(observation, _)| {
            let (speed, e) = (observation.speed, observation.restitution());
            let (low, high) = reach(observation);
            let error = observation.speed_error;
            [vec![(speed, low), (speed, high)], vec![(speed - error, e), (speed + error, e)]]
        });
        chart.draw_series(bars.map(|bar| PathElement::new(bar, colour.mix(0.45))))?;
        chart
            .draw_series(impacts.iter().map(|(o, _)| Circle::new((o.speed, o.restitution()), 2, colour.filled())))?
            .label(format!("{name}, with standard errors"))
            .legend(move |(x, y)| Circle::new((x + 10, y), 3, colour.filled()));
    }
    legend(&mut chart, SeriesLabelPosition::LowerRight)
}

fn legend<'a, 'b: 'a>(chart: &mut Chart<'a, 'b>, position: SeriesLabelPosition) -> Result<(), Box<dyn Error>> {
    Ok(chart
        .configure_series_labels()
        .position(position)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK)
        .label_font(("sans-serif", 13))
        .draw()?)
}

fn draw_curve(
    chart: &mut Chart<'_, '_>,
    x: Range<f64>,
    (bottom, top): (f64, f64),
    statement: &Statement,
) -> Result<(), Box<dyn Error>> {
    let at = |step: u32| x.start + (x.end - x.start) * f64::from(step) / f64::from(POINTS);
    let mut speeds: Vec<f64> = (0..=POINTS).map(at).filter(|speed| *speed > 0.0).collect();
    if let Some(critical) = critical(Some(statement)) {
        // The curve rises as a root there.
        speeds.extend(
            (0..60).map(|step| critical.value * (1.0 + 1e-4 * f64::from(step * step))).filter(|v| x.contains(v)),
        );
        speeds.sort_by(f64::total_cmp);
        let band = Rectangle::new(
            [(critical.low.max(x.start), bottom), (critical.high.min(x.end), top)],
            CRITICAL.mix(0.15).filled(),
        );
        if critical.high > x.start && critical.low < x.end {
            chart.draw_series(std::iter::once(band))?;
        }
        if x.contains(&critical.value) {
            chart
                .draw_series(LineSeries::new([(critical.value, bottom), (critical.value, top)], CRITICAL))?
                .label("critical speed, with interval of 95 %")
                .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], CRITICAL));
        }
    }
    let band = statement.fit.band(&speeds);
    let lower = speeds.iter().zip(&band).map(|(speed, band)| (*speed, band.0.clamp(bottom, top)));
    let upper = speeds.iter().zip(&band).map(|(speed, band)| (*speed, band.1.clamp(bottom, top)));
    let outline: Vec<_> = lower.chain(upper.collect::<Vec<_>>().into_iter().rev()).collect();
    chart.draw_series(std::iter::once(Polygon::new(outline, CURVE.mix(0.25))))?;
    let curve = speeds.iter().map(|speed| (*speed, statement.fit.restitution(*speed).clamp(bottom, top)));
    chart
        .draw_series(LineSeries::new(curve, CURVE))?
        .label("median, with band of 95 %")
        .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], CURVE));
    Ok(())
}

fn draw_residuals(area: &Panel<'_>, x: Range<f64>, classes: &[Class<'_>]) -> Result<(), Box<dyn Error>> {
    let residuals = || classes.iter().flat_map(|class| class.impacts.iter().filter_map(|(_, residual)| *residual));
    // Few far outliers shall not flatten all others; they are drawn at the border.
    let reach = residuals().map(f64::abs).filter(|size| *size < 2.0 * OUTLIER).fold(2.5, f64::max) * 1.1;
    let name = "residual, standard deviations";
    let mut chart = axes(area, "Residuals of the rebound speed", [(x.clone(), SPEED), (-reach..reach, name)])?;
    chart.draw_series(LineSeries::new([(x.start, 0.0), (x.end, 0.0)], CURVE))?;
    for Class { colour, impacts, .. } in classes {
        let points =
            impacts.iter().filter_map(|(o, residual)| Some((o.speed, residual.as_ref()?.clamp(-reach, reach))));
        chart.draw_series(points.map(|at| Circle::new(at, 2, colour.filled())))?;
    }
    Ok(())
}
