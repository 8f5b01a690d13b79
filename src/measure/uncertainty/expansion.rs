//! Quantities as functions of the deviations of the inputs.

use super::{Classifiable, Uncertain};
use crate::{InputError, Real};

/// Distance of the points of an expansion from its centre, in standard errors: with it, means are exact for polynomials of
/// the fifth degree (Gauss and Hermite).
const STEP: f64 = 1.732_050_807_568_877_2;

/// Number of rebounds for which the stopped slip is computed.
pub(super) const REBOUNDS: usize = 2;

/// Stopped slips: those of the rebounds, then that of a capture.
pub(super) const STOPPED: usize = REBOUNDS + 1;

/// Largest relative difference, in roundings, behind which there is no mixed derivative.
const ROUNDINGS: f64 = 64.0;

/// Difference of two numbers, relative to their mean. It is nearly the logarithm of their ratio, and lies between -2 and 2.
pub(super) fn relative<T: Real>(value: T, reference: T) -> T {
    let sum = value + reference;
    if sum > T::ZERO { (value - reference) / sum * T::constant(2.0) } else { T::ZERO }
}

/// Inverse of [`relative`].
pub(super) fn absolute<T: Real>(relative: T, reference: T) -> T {
    let two = T::constant(2.0);
    let bounded = relative.max(T::constant(-1.9)).min(T::constant(1.9));
    reference * (two + bounded) / (two - bounded)
}

/// A quantity as a sum of Hermite polynomials of the deviations z, up to the second degree.
#[derive(Clone, Copy)]
pub(super) struct Expansion<T, const N: usize> {
    pub(super) mean: T,
    /// Coefficients of z and of z^2 - 1.
    pub(super) linear: [T; N],
    pub(super) square: [T; N],
}

impl<T: Real, const N: usize> Expansion<T, N> {
    pub(super) fn constant(mean: T) -> Self {
        Self { mean, linear: [T::ZERO; N], square: [T::ZERO; N] }
    }

    /// Adds the effect of an input, from the `value` without deviations and the values at the deviations `centre` less `step`,
    /// `centre`, and `centre` plus `step`.
    pub(super) fn add(&mut self, input: usize, centre: T, step: T, value: T, [below, middle, above]: [T; 3]) {
        let half = T::constant(0.5);
        let curvature = half * (above - middle - (middle - below)) / (step * step);
        let slope = half * (above - below) / step - T::constant(2.0) * curvature * centre;
        // The mean of the parabola.
        self.mean = self.mean + (middle - value) - (slope + curvature * centre) * centre + curvature;
        if let (Some(linear), Some(square)) = (self.linear.get_mut(input), self.square.get_mut(input)) {
            (*linear, *square) = (slope, curvature);
        }
    }

    /// The expansion in another variable u for the deviation of one input, which is mean + spread (u + skew (u^2 - 1)).
    pub(super) fn with(mut self, input: usize, [mean, spread, skew]: [T; 3]) -> Self {
        if let (Some(linear), Some(square)) = (self.linear.get_mut(input), self.square.get_mut(input)) {
            let two = T::constant(2.0);
            let both = two * skew * skew;
            self.mean =
                self.mean + *linear * mean + *square * (mean * mean + spread * spread * (T::ONE + both) - T::ONE);
            let slope = *linear + two * *square * mean;
            let curved = *square * spread;
            *linear = spread * (slope + two * two * curved * skew);
            *square = spread * (slope * skew + curved * (T::ONE + two * both));
        }
        self
    }
}

pub(super) fn squares<T: Real, const N: usize>(a: &[T; N]) -> T {
    a.iter().fold(T::ZERO, |sum, a| sum + *a * *a)
}

/// The slip that friction stops: its value without deviations, and the expansion of the [`relative`] difference to it.
#[derive(Clone, Copy)]
pub(super) struct Stopped<T, const N: usize> {
    pub(super) value: T,
    pub(super) relative: Expansion<T, N>,
}

/// Expansions of what decides the class.
#[derive(Clone, Copy)]
pub(super) struct Expanded<T, const N: usize> {
    /// Ratio of the speed to the critical speed without deviations, and the [`relative`] difference to it.
    pub(super) ratio: T,
    pub(super) speeds: Expansion<T, N>,
    pub(super) slip: Expansion<T, N>,
    /// Mixed second derivatives of the slip, if two inputs have any.
    pub(super) mixed: Option<[[T; N]; N]>,
    /// For rebounds at multiples of the critical speed, divided by the multiple; then for captures at the critical speed.
    /// `None` if friction stops every slip.
    pub(super) stopped: [Option<Stopped<T, N>>; STOPPED],
    /// Relative curvature of the stopped slip between the rebounds, four times the difference in the middle.
    pub(super) stopped_bend: T,
}

impl<T: Real, const N: usize> Expanded<T, N> {
    /// Expands the quantities that `quantities` computes: the speed, the slip, and the stopped slips.
    pub(super) fn new<C: Classifiable<T>>(
        inputs: &[Uncertain<T>; N],
        impact: &impl Fn([T; N]) -> Result<C, InputError>,
        nominal: &C,
        quantities: impl Fn(&C) -> Result<(Option<T>, [Option<T>; STOPPED]), InputError>,
    ) -> Result<Self, InputError> {
        let zero = Expansion::constant(T::ZERO);
        let (ratio, stopped) = quantities(nominal)?;
        let ratio = ratio.unwrap_or(T::ONE);
        let slip = nominal.slip();
        let mut expanded = Self {
            ratio,
            speeds: zero,
            slip: Expansion::constant(slip),
            mixed: None,
            stopped: stopped.map(|value| value.map(|value| Stopped { value, relative: zero })),
            stopped_bend: T::ZERO,
        };
        let values = inputs.map(|input| input.value);
        for (input, uncertain) in inputs.iter().enumerate() {
            let Uncertain { error, bounds: [low, high], .. } = uncertain;
            let step = T::constant(STEP).min(T::constant(0.5) * (*low + *high));
            let centre = T::ZERO.max(step - *low).min(*high - step);
            if *error <= T::ZERO {
                continue;
            }
            let (mut speeds, mut slips, mut reliefs) = ([T::ZERO; 3], [slip; 3], [[T::ZERO; 3]; STOPPED]);
            for place in 0..3 {
                let deviation = centre + step * T::constant(place as f64 - 1.0);
                if deviation == T::ZERO {
                    continue;
                }
                let mut values = values;
                if let Some(varied) = values.get_mut(input) {
                    *varied = uncertain.at(deviation);
                }
                // A reference, because an impact is large.
                let impact = impact(values);
                let impact = impact.as_ref().map_err(|error| *error)?;
                let (speed, stopped) = quantities(impact)?;
                if let (Some(place), Some(speed)) = (speeds.get_mut(place), speed) {
                    *place = relative(speed, ratio);
                }
                if let Some(place) = slips.get_mut(place) {
                    *place = impact.slip();
                }
                for ((relief, expansion), stopped) in reliefs.iter_mut().zip(&expanded.stopped).zip(stopped) {
                    if let (Some(place), Some(expansion), Some(stopped)) = (relief.get_mut(place), expansion, stopped) {
                        *place = relative(stopped, expansion.value);
                    }
                }
            }
            expanded.speeds.add(input, centre, step, T::ZERO, speeds);
            expanded.slip.add(input, centre, step, slip, slips);
            for (expansion, relief) in expanded.stopped.iter_mut().zip(reliefs) {
                if let Some(expansion) = expansion {
                    expansion.relative.add(input, centre, step, T::ZERO, relief);
                }
            }
        }
        expanded.set_mixed(inputs, slip, |values| impact(values).as_ref().map(C::slip).map_err(|error| *error))?;
        Ok(expanded)
    }

    /// Sets the curvature of the stopped slip from its value without deviations in the middle between the rebounds.
    pub(super) fn bend_stopped(&mut self, middle: T) {
        if let [Some(first), Some(last), _] = &self.stopped {
            let mean = T::constant(0.5) * (first.value + last.value);
            self.stopped_bend = T::constant(4.0) * if mean > T::ZERO { middle / mean - T::ONE } else { T::ZERO };
        }
    }

    /// Sets the mixed second derivatives of the slip with respect to the deviations of the inputs, from the `slip` without any.
    ///
    /// The slip is a difference, so that no function of it is nearly a sum of functions of the inputs.
    fn set_mixed(
        &mut self,
        inputs: &[Uncertain<T>; N],
        slip: T,
        slip_at: impl Fn([T; N]) -> Result<T, InputError>,
    ) -> Result<(), InputError> {
        let values = inputs.map(|input| input.value);
        // Deviation in the direction of the farther bound, and the change of the slip with it.
        let single = |index: usize| {
            let (uncertain, linear, square) =
                (inputs.get(index)?, *self.slip.linear.get(index)?, *self.slip.square.get(index)?);
            let [low, high] = uncertain.bounds;
            let z = if high < low { -low.min(T::ONE) } else { high.min(T::ONE) };
            (linear != T::ZERO).then_some((z, uncertain.at(z), (linear + square * z) * z))
        };
        for first in 0..N {
            let Some((z, value, change)) = single(first) else { continue };
            for second in first + 1..N {
                let Some((other_z, other_value, other_change)) = single(second) else { continue };
                let mut values = values;
                if let Some(place) = values.get_mut(first) {
                    *place = value;
                }
                if let Some(place) = values.get_mut(second) {
                    *place = other_value;
                }
                let together = slip_at(values)? - slip;
                let mixed = (together - change - other_change) / (z * other_z);
                if mixed.abs() <= T::constant(ROUNDINGS) * T::EPSILON * (together.abs() + slip.abs()) {
                    continue;
                }
                let derivatives = self.mixed.get_or_insert([[T::ZERO; N]; N]);
                for (row, column) in [(first, second), (second, first)] {
                    if let Some(entry) = derivatives.get_mut(row).and_then(|row| row.get_mut(column)) {
                        *entry = mixed;
                    }
                }
            }
        }
        Ok(())
    }

    /// The expansions with another distribution of one input.
    pub(super) fn with(self, input: usize, distribution: [T; 3]) -> Self {
        let [mean, spread, _] = distribution;
        let mut slip = self.slip.with(input, distribution);
        let mixed = self.mixed.map(|mut rows| {
            if let Some(row) = rows.get_mut(input) {
                for (linear, mixed) in slip.linear.iter_mut().zip(row) {
                    *linear = *linear + *mixed * mean;
                    *mixed = *mixed * spread;
                }
            }
            for entry in rows.iter_mut().filter_map(|row| row.get_mut(input)) {
                *entry = *entry * spread;
            }
            rows
        });
        Self {
            speeds: self.speeds.with(input, distribution),
            slip,
            mixed,
            stopped: self.stopped.map(|stopped| {
                stopped.map(|stopped| Stopped { relative: stopped.relative.with(input, distribution), ..stopped })
            }),
            ..self
        }
    }
}
