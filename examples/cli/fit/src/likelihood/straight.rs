//! Rows over whose error the curve is straight.

use super::{Datum, Likelihood};
use crate::law::Curve;
use crate::scatter::Scatter;

/// Where straight rows begin, among others below.
///
/// The scores of straight rows have the mean zero if all rows with the same true speed are among them. Errors carry rows across the
/// border: of n f(u) rows per unit of speed, the mean score is -n f s^2 w' dw/dtheta/sigma^2. A term that is linear in w(u) takes it
/// away.
#[derive(Clone, Copy, Debug)]
pub(super) struct Border {
    /// The slowest straight row.
    pub(super) row: usize,
    pub(super) factor: f64,
    /// Its rebound speed in the first fit, where the term is zero.
    pub(super) rebound: f64,
}

/// Largest curvature of a straight curve: the change of the mean rebound speed that it makes, in standard deviations of the row.
const CURVATURE: f64 = 0.03;

/// Ratio of speeds within which rows count as near the border of straight rows.
const BORDER: f64 = 1.25;

impl Likelihood {
    /// Finds the rows over whose error a curve is straight.
    ///
    /// The likelihood of such a row shall depend on the curve through its distance alone (total least squares, Fuller 1987), so that
    /// the distribution of the true speeds does not matter. The steepness in its normalising factor is therefore kept.
    pub fn keep_straight_rows(&mut self, values: &[f64]) {
        let Some(curve) = self.curve(values) else {
            return;
        };
        let scatter = self.scatter(values);
        let straight = |datum: &Datum| {
            let (_, error) = datum.rebound?;
            let deviation = self.approach_variance(&curve, datum).sqrt();
            let at = |deviations: f64| curve.square(datum.speed + deviations * deviation, datum.size);
            let [before, (square, slope), after] = [-2.0, 0.0, 2.0].map(at);
            if before.0 <= 0.0 {
                return None;
            }
            let bend = (before.0.sqrt() + after.0.sqrt() - 2.0 * square.sqrt()).abs() / 8.0;
            let steepness = 0.25 * slope * slope / square;
            let variance =
                error + scatter.parts[0].variance * datum.speed * datum.speed + steepness * deviation * deviation;
            (bend * bend < CURVATURE * CURVATURE * variance).then_some(steepness)
        };
        self.straight = self.data.iter().map(straight).collect();
        let rows = || self.data.iter().zip(&self.straight).filter(|(datum, _)| datum.rebound.is_some());
        let fastest =
            rows().filter(|(_, straight)| straight.is_none()).map(|(datum, _)| datum.speed).fold(0.0, f64::max);
        for (datum, straight) in self.data.iter().zip(&mut self.straight) {
            if datum.speed <= fastest {
                *straight = None;
            }
        }
        self.border = if fastest > 0.0 { self.border_of(&curve, &scatter) } else { None };
    }

    fn border_of(&self, curve: &Curve, scatter: &Scatter) -> Option<Border> {
        let straight = |row: &usize| self.straight[*row].is_some();
        let row =
            (0..self.data.len()).filter(straight).min_by(|a, b| self.data[*a].speed.total_cmp(&self.data[*b].speed))?;
        let (datum, kept) = (self.data[row], self.straight[row]?);
        let near = |other: &&Datum| (1.0 / BORDER..BORDER).contains(&(other.speed / datum.speed));
        let density = self.data.iter().filter(near).count() as f64 / (datum.speed * (BORDER - 1.0 / BORDER));
        let variance = self.approach_variance(curve, &datum);
        let across = datum.rebound?.1 + scatter.parts[0].variance * datum.speed * datum.speed;
        let factor = density * variance * kept.sqrt() / (across + kept * variance);
        let rebound = curve.rebound(datum.speed, datum.size);
        factor.is_finite().then_some(Border { row, factor, rebound })
    }
}
