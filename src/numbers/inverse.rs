//! Powers, and inverses of increasing functions.

use super::{NotConverged, root};
use crate::Real;

/// Doublings in the search for a bracket: from the smallest speed beyond the largest.
const MOST_DOUBLINGS: u32 = 100;

/// x^p of x >= 0 and p > 0.
pub(crate) fn power<T: Real>(x: T, p: T) -> T {
    if x > T::ZERO { (p * x.ln()).exp() } else { T::ZERO }
}

/// Where an increasing function has the value `target` > 0, from a place where it is no larger; `None` where it stays below.
pub(crate) fn inverse<T: Real>(f: impl Fn(T) -> T, target: T, from: T) -> Option<T> {
    if target <= T::ZERO {
        return Some(T::ZERO);
    }
    let excess = |x: T| f(x) / target - T::ONE;
    let (mut low, mut high) = ((from, excess(from)), (from, excess(from)));
    let mut doublings = 0;
    while high.1 < T::ZERO {
        if doublings == MOST_DOUBLINGS {
            return None;
        }
        doublings += 1;
        low = high;
        high.0 = high.0 + high.0;
        high.1 = excess(high.0);
    }
    let found =
        if low.0 == high.0 { Ok(low.0) } else { root(low, high, T::EPSILON, |x| Ok::<_, NotConverged>(excess(x))) };
    let x = found.ok()?;
    // A step of Newton's method, with a difference for the slope: with it the derivatives of a `Dual` are those of the inverse.
    let h = x * T::EPSILON.sqrt().sqrt();
    let slope = (excess(x + h) - excess(x - h)) / (h + h);
    Some(if slope > T::ZERO { x - excess(x) / slope } else { x })
}

#[cfg(test)]
mod tests {
    use super::{inverse, power};
    use crate::{Dual, Real};

    #[test]
    fn powers_are_those_of_the_standard_library() {
        for (x, p) in [(2.0, 0.5), (1e-9, 0.01), (1e9, 16.0), (0.3, 3.7)] {
            let expected = f64::powf(x, p);
            assert!((power(x, p) / expected - 1.0).abs() < 1e-13, "{x} {p}");
        }
        assert_eq!(power(0.0_f32, 0.5), 0.0);
    }

    #[test]
    fn inverses_have_the_digits_of_their_type_and_their_derivatives() {
        let cubic = |x: f64| x * x * x + x;
        for x in [1e-9, 0.7, 3.0, 1e6] {
            assert!((inverse(cubic, cubic(x), 0.1 * x).unwrap_or(0.0) / x - 1.0).abs() < 1e-14, "{x}");
        }
        let x: Option<f32> = inverse(|x| x * x, 2.0, 1.0);
        assert!(x.is_some_and(|x| (x - 2f32.sqrt()).abs() < 3e-7));
        // The inverse of a square has the derivative 1/(2 x).
        let [target] = Dual::<f64, 1>::variables([9.0]);
        let x = inverse(|x| x * x, target, Dual::constant(1.0));
        assert!(x.is_some_and(|x| (x.value - 3.0).abs() < 1e-14 && (x.partials[0] - 1.0 / 6.0).abs() < 1e-9));
        assert_eq!(inverse(|x: f64| x / (1.0 + x), 1.5, 1.5), None);
    }
}
