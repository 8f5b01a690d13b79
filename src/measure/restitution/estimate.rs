//! The estimate: first a curve that no outlier moves, then its refinement, its covariance, and the test of a trend.

use super::MeasuredImpact;
use super::curve::Curve;
use super::rows::Row;
use super::symmetric::Symmetric;
use crate::Real;
use crate::measure::robust::{MOST_PASSES, median, number};
use crate::measure::{CalibrationError, NormalDistribution};

/// Impacts, and the units of the fit.
#[derive(Clone, Copy)]
pub(super) struct Cloud<'a, T> {
    pub(super) impacts: &'a [MeasuredImpact<T>],
    /// Largest approach speed, m/s.
    pub(super) fastest: T,
    /// Median mass, kg.
    pub(super) mass: T,
    pub(super) rebounds: u32,
    pub(super) captures: u32,
}

/// A curve with its covariance.
pub(super) struct Fitted<T> {
    pub(super) curve: Curve<T>,
    pub(super) scatter: T,
    pub(super) covariance: Symmetric<T>,
    pub(super) outliers: u32,
    pub(super) fits: bool,
}

/// Pairs of rebounds that are tried for a first curve. Even if half of the rebounds are outliers, some pair has none.
const MOST_PAIRS: u32 = 128;

/// Least difference of the speeds of a pair, over the larger one.
const APART: f64 = 0.05;

/// Parameters: c, b and the scatter.
pub(super) const PARAMETERS: u32 = 3;

/// Median of the size of a standard normal variable.
const MIDDLE: f64 = 0.674_489_750_196_081_7;

/// Distances, in standard deviations, from which on their influence stays the same (Huber 1964), and at which it has fallen to zero.
/// The larger the first, the smaller the error of the estimate; the smaller, the nearer it is to the median where scatter is skewed.
const STEADY: f64 = 1.2;
const CUT: f64 = 20.0;

/// Influence of a distance.
struct Influence<T> {
    weight: T,
    psi: T,
    slope: T,
}

impl<T: Real> Influence<T> {
    #[inline(never)]
    fn of(deviates: T) -> Self {
        let (size, steady) = (deviates.abs(), T::constant(STEADY));
        if size <= steady {
            return Self { weight: T::ONE, psi: deviates, slope: T::ONE };
        }
        let ratio = size * T::constant(1.0 / CUT);
        let rest = T::ONE - ratio * ratio;
        if rest <= T::ZERO {
            return Self { weight: T::ZERO, psi: T::ZERO, slope: T::ZERO };
        }
        let weight = steady * rest * rest / size;
        Self { weight, psi: weight * deviates, slope: T::constant(-4.0 / CUT) * steady * rest * ratio }
    }
}

/// What all rows say at a curve.
struct Sums<T> {
    score: [T; 2],
    /// Information of the rebounds with the weights of their distances, and of the outcomes. It makes steps that never fail.
    weights: Symmetric<T>,
    /// Outer products of the slopes at the rebounds.
    slopes: Symmetric<T>,
    /// Information of the outcomes.
    outcomes: Symmetric<T>,
    /// Products of the scores of rebounds and outcomes.
    shared: Symmetric<T>,
    /// Outer products of the scores of the rebounds.
    scores: Symmetric<T>,
    /// Sums of the squared influence and of its slope.
    influence: [T; 2],
    outliers: u32,
}

impl<T: Real> Sums<T> {
    /// Minus the mean derivative of the score, and its covariance.
    ///
    /// The influence of the rebounds is averaged over all of them, since few slow ones determine the work of adhesion. Where the
    /// scores themselves vary more, as outliers at some speeds make them do, the larger variance counts.
    fn information(&self, rebounds: u32) -> (Symmetric<T>, Symmetric<T>) {
        let [squares, slopes] = self.influence.map(|sum| sum / number(rebounds));
        let information = self.slopes.scaled(slopes).plus(&self.outcomes);
        let variance = self.slopes.scaled(squares).at_least(&self.scores);
        (information, variance.plus(&self.outcomes).plus(&self.shared))
    }
}

impl<T: Real + NormalDistribution> Cloud<'_, T> {
    fn rows(&self) -> impl Iterator<Item = Row<T>> + Clone {
        let (fastest, mass) = (self.fastest, self.mass);
        self.impacts.iter().map(move |impact| Row::new(impact, fastest, mass))
    }

    /// The estimate.
    pub(super) fn fit(&self) -> Result<Fitted<T>, CalibrationError> {
        let mut curve = self.start().ok_or(CalibrationError::Undetermined)?;
        let mut scatter = self.scatter(&curve);
        for _ in 0..ROUNDS {
            self.refine(&mut curve, scatter)?;
            scatter = self.scatter(&curve);
        }
        self.refine(&mut curve, scatter)?;
        let sums = self.sums(&curve, scatter);
        let (information, variance) = sums.information(self.rebounds);
        let inverse = information.inverse().ok_or(CalibrationError::Undetermined)?;
        let rows = self.rebounds + self.captures;
        let freedom = number::<T>(rows) / number(rows - PARAMETERS);
        let covariance = variance.between(&inverse).scaled(freedom);
        let numbers = [curve.loss, curve.pull, covariance.first, covariance.mixed, covariance.second];
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(CalibrationError::Undetermined);
        }
        let fits = !self.has_trend(&curve, scatter, &information)
            && !self.has_like_neighbours(&curve, scatter)
            && !self.is_contradicted(&curve, scatter);
        Ok(Fitted { curve, scatter, covariance, outliers: sums.outliers, fits })
    }

    /// The curve through two rebounds that has the smallest median deviation of e.
    fn start(&self) -> Option<Curve<T>> {
        let rebounds = self.rows().filter(|row| row.rebound.is_some());
        let mut best: Option<(Curve<T>, T)> = None;
        let mut state = 1_u32;
        let mut draw = || {
            // The high bits of a linear congruential generator are random enough.
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8).checked_rem(self.rebounds)
        };
        for _ in 0..MOST_PAIRS {
            let mut point = || Some(rebounds.clone().nth(draw()? as usize)?.point());
            let (first, second) = (point()?, point()?);
            let (slow, fast) = if first.0 < second.0 { (first, second) } else { (second, first) };
            if fast.0 - slow.0 < T::constant(APART) * fast.0 {
                continue;
            }
            let Some(curve) = Curve::through(slow, fast) else {
                continue;
            };
            let deviations = rebounds.clone().map(|row| row.deviation(&curve));
            // One count rejects most curves.
            if let Some((_, least)) = best
                && 2 * deviations.clone().filter(|deviation| *deviation < least).count() <= self.rebounds as usize
            {
                continue;
            }
            best = median(deviations).map(|median| (curve, median));
        }
        best.map(|(curve, _)| curve)
    }

    /// The natural scatter of e with which half of the rebounds are as near to the curve as half of all normal deviates.
    #[inline(never)]
    fn scatter(&self, curve: &Curve<T>) -> T {
        let near = |scatter: T| {
            let distances = self.rows().filter_map(|row| row.distance(curve, scatter));
            let near = distances.filter(|distance| distance.deviates.abs() < T::constant(MIDDLE)).count();
            // The curve has taken two degrees of freedom.
            2 * near as u32 >= self.rebounds + 2
        };
        let (mut low, mut high) = (T::ZERO, T::ONE);
        if near(low) {
            return low;
        }
        for _ in 0..SCATTER_HALVINGS {
            let middle = if low > T::ZERO { low.geometric_mean(high) } else { T::constant(0.1) * high };
            if near(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }

    fn sums(&self, curve: &Curve<T>, scatter: T) -> Sums<T> {
        let mut sums = Sums {
            score: [T::ZERO; 2],
            weights: Symmetric::ZERO,
            slopes: Symmetric::ZERO,
            outcomes: Symmetric::ZERO,
            shared: Symmetric::ZERO,
            scores: Symmetric::ZERO,
            influence: [T::ZERO; 2],
            outliers: 0,
        };
        for row in self.rows() {
            let mut score = [T::ZERO; 2];
            if let Some(distance) = row.distance(curve, scatter) {
                let Influence { weight, psi, slope } = Influence::of(distance.deviates);
                sums.outliers += u32::from(weight == T::ZERO);
                sums.slopes.add(T::ONE, distance.slopes);
                sums.weights.add(weight, distance.slopes);
                sums.influence = [sums.influence[0] + psi * psi, sums.influence[1] + slope];
                score = distance.slopes.map(|slope| psi * slope);
                sums.scores.add(T::ONE, score);
            }
            // Where captures are not recorded, all rows are rebounds.
            if self.captures > 0 {
                let outcome = row.outcome(curve, scatter);
                sums.outcomes.add(outcome.information, outcome.slopes);
                let own = outcome.slopes.map(|slope| outcome.score * slope);
                sums.shared.add_product(score, own);
                score = [score[0] + own[0], score[1] + own[1]];
            }
            sums.score = [sums.score[0] + score[0], sums.score[1] + score[1]];
        }
        sums.weights = sums.weights.plus(&sums.outcomes);
        sums
    }

    /// Refines the curve until its score is zero.
    #[inline(never)]
    fn refine(&self, curve: &mut Curve<T>, scatter: T) -> Result<(), CalibrationError> {
        for _ in 0..MOST_PASSES {
            let sums = self.sums(curve, scatter);
            let inverse = sums.weights.inverse().ok_or(CalibrationError::Undetermined)?;
            let step = inverse.times(sums.score);
            *curve = curve.moved(step);
            // A step that is small beside the standard errors changes nothing.
            if sums.weights.form(step) < T::constant(NEGLIGIBLE * NEGLIGIBLE) {
                break;
            }
        }
        Ok(())
    }

    /// Whether the distances of rebounds at neighbouring speeds are alike, as those from a curve of another shape are: their products have
    /// the mean zero by chance.
    fn has_like_neighbours(&self, curve: &Curve<T>, scatter: T) -> bool {
        let rebounds = || self.rows().filter(|row| row.rebound.is_some());
        let psi = |row: &Row<T>| row.distance(curve, scatter).map(|distance| Influence::of(distance.deviates).psi);
        let (mut sum, mut variance) = (T::ZERO, T::ZERO);
        for row in rebounds() {
            let next = rebounds().filter(|other| other.x > row.x).reduce(|a, b| if b.x < a.x { b } else { a });
            if let Some((own, other)) = psi(&row).zip(next.as_ref().and_then(psi)) {
                let product = own * other;
                (sum, variance) = (sum + product, variance + product * product);
            }
        }
        sum > T::constant(ALIKE) * variance.sqrt()
    }

    /// Whether polynomials over the logarithm of the speed, added to e^2, describe the rebounds better than chance explains.
    fn has_trend(&self, curve: &Curve<T>, scatter: T, information: &Symmetric<T>) -> bool {
        let Some(inverse) = information.inverse() else {
            return false;
        };
        let rebounds = || self.rows().filter(|row| row.rebound.is_some());
        let (low, high) = rebounds().fold((T::ONE, T::ZERO), |(low, high), row| (low.min(row.x), high.max(row.x)));
        let (low, width) = (low.ln(), (high / low).ln());
        if width <= T::ZERO {
            return false;
        }
        // Chebyshev polynomials of the second and the third degree; those of lower degree are nearly c and b.
        let polynomials = |x: T| {
            let place = T::constant(2.0) * (x.ln() - low) / width - T::ONE;
            let square = place * place;
            [T::constant(2.0) * square - T::ONE, (T::constant(4.0) * square - T::constant(3.0)) * place]
        };
        let mut shared = [[T::ZERO; 2]; 2];
        for row in rebounds() {
            if let Some(distance) = row.distance(curve, scatter) {
                let slope = Influence::of(distance.deviates).slope;
                for (sums, polynomial) in shared.iter_mut().zip(polynomials(row.x)) {
                    let term = slope * polynomial * distance.unit;
                    *sums = [sums[0] + term * distance.slopes[0], sums[1] + term * distance.slopes[1]];
                }
            }
        }
        // What c and b explain of each polynomial is taken away from it.
        let [first, second] = shared.map(|sums| inverse.times(sums));
        let (mut score, mut variance) = ([T::ZERO; 2], Symmetric::ZERO);
        for row in self.rows() {
            let mut total = [T::ZERO; 2];
            let explained = |slopes: [T; 2]| {
                [first[0] * slopes[0] + first[1] * slopes[1], second[0] * slopes[0] + second[1] * slopes[1]]
            };
            if let Some(distance) = row.distance(curve, scatter) {
                let psi = Influence::of(distance.deviates).psi;
                let ([even, odd], [first, second]) = (polynomials(row.x), explained(distance.slopes));
                total = [psi * (even * distance.unit - first), psi * (odd * distance.unit - second)];
            }
            if self.captures > 0 {
                let outcome = row.outcome(curve, scatter);
                let [first, second] = explained(outcome.slopes);
                total = [total[0] - outcome.score * first, total[1] - outcome.score * second];
            }
            variance.add(T::ONE, total);
            score = [score[0] + total[0], score[1] + total[1]];
        }
        variance.inverse().is_some_and(|inverse| inverse.form(score) > T::constant(LARGEST_TREND))
    }

    /// Whether more rows are on the wrong side of the critical speed than outliers explain.
    fn is_contradicted(&self, curve: &Curve<T>, scatter: T) -> bool {
        let wrong = self.rows().filter(|row| row.contradicts(curve, scatter)).count() as u32;
        wrong > FEW && wrong * LEAST_SHARE > self.rebounds + self.captures
    }
}

/// Rounds of curve and scatter.
const ROUNDS: u32 = 3;

/// Halvings of the logarithm of the scatter: to a hundredth.
const SCATTER_HALVINGS: u32 = 12;

/// A step of this number of standard errors changes nothing.
const NEGLIGIBLE: f64 = 1e-3;

/// Chi-squared of two degrees of freedom exceeds 13.8 in one of a thousand. The statistic does so more often, since few rows have most of
/// the weight; it exceeds this number in one of a thousand of the sets of `cargo coverage`.
const LARGEST_TREND: f64 = 16.0;

/// A normal deviate exceeds this in one of three thousand.
const ALIKE: f64 = 3.4;

/// Rows on the wrong side that outliers explain: a few, or one in so many.
const FEW: u32 = 2;
const LEAST_SHARE: u32 = 8;
