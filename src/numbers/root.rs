//! Root of a function in a bracket.

use crate::Real;

/// No root was found in the trials allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NotConverged;

/// Largest number of trials. Bisection alone needs a third of them.
const MOST_TRIALS: u32 = 150;

/// Finds a root of f in a bracket, to a relative `tolerance`. The ends of the bracket are given with their values.
///
/// Chandrupatla's method (1997) uses inverse quadratic interpolation where it is safe, and bisection elsewhere.
pub(crate) fn root<T: Real, E: From<NotConverged>>(
    (mut a, mut f_a): (T, T),
    (mut b, mut f_b): (T, T),
    tolerance: T,
    mut f: impl FnMut(T) -> Result<T, E>,
) -> Result<T, E> {
    let tolerance = tolerance.max(T::constant(4.0) * T::EPSILON);
    let mut fraction = T::constant(0.5);
    for _ in 0..MOST_TRIALS {
        let x = a + fraction * (b - a);
        let f_x = f(x)?;
        // The new end a, the opposite end b, and the end c that a replaces.
        let (c, f_c);
        if (f_x > T::ZERO) == (f_a > T::ZERO) {
            (c, f_c) = (a, f_a);
        } else {
            (c, f_c) = (b, f_b);
            (b, f_b) = (a, f_a);
        }
        (a, f_a) = (x, f_x);
        let (best, f_best) = if f_a.abs() < f_b.abs() { (a, f_a) } else { (b, f_b) };
        let width = (b - a).abs();
        let close = tolerance * best.abs();
        if f_best == T::ZERO || width <= close + close {
            return Ok(best);
        }
        let (xi, phi) = ((a - b) / (c - b), (f_a - f_b) / (f_c - f_b));
        fraction = if phi * phi < xi && (T::ONE - phi) * (T::ONE - phi) < T::ONE - xi {
            f_a / (f_b - f_a) * (f_c / (f_b - f_c)) + (c - a) / (b - a) * (f_a / (f_c - f_a)) * (f_b / (f_c - f_b))
        } else {
            T::constant(0.5)
        };
        // Keep a distance from both ends, whose values are known.
        let least = close / width;
        fraction = fraction.max(least).min(T::ONE - least);
    }
    Err(NotConverged.into())
}

#[cfg(test)]
mod tests {
    use super::{NotConverged, root};

    fn solve(bracket: (f64, f64), f: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut trials = 0;
        let found = root((bracket.0, f(bracket.0)), (bracket.1, f(bracket.1)), 1e-13, |x| {
            trials += 1;
            Ok::<_, NotConverged>(f(x))
        });
        (found.unwrap_or(f64::NAN), trials)
    }

    #[test]
    fn smooth_functions_take_few_trials() {
        for (bracket, f, expected) in [
            ((0.0, 4.0), (|x| x * x - 2.0) as fn(f64) -> f64, 2f64.sqrt()),
            ((3.0, -1.0), |x| x.exp() - 2.0, 2f64.ln()),
            ((1e-6, 1e6), |x| 1.0 / x - 1e-3, 1e3),
        ] {
            let (found, trials) = solve(bracket, f);
            assert!((found / expected - 1.0).abs() < 1e-12 && trials < 50, "{found} {trials}");
        }
    }

    /// Constant parts, jumps and noise, which simulations have, do not stop the search.
    #[test]
    fn awkward_functions_take_bounded_trials() {
        let (found, trials) = solve((0.0, 1e9), |x| if x > 7.0 { -0.5 } else { 7.0 - x });
        assert!((found - 7.0).abs() < 1e-11 && trials < 150, "{found} {trials}");
        let (found, trials) = solve((0.0, 10.0), |x| 3.0 - x + 1e-9 * (1e12 * x).sin());
        assert!((found - 3.0).abs() < 1e-8 && trials < 150, "{found} {trials}");
    }

    #[test]
    fn errors_of_trials_end_the_search() {
        let failed = root((0.0, 1.0), (1.0, -1.0), 1e-9, |_| Err(NotConverged));
        assert_eq!(failed, Err(NotConverged));
    }
}
