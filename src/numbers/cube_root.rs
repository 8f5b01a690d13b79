//! Cube roots of any number type.

use crate::Real;

/// Steps of Newton's method for a cube root at most. A first value that is far too large takes one for each third of itself.
const CUBE_ROOT_STEPS: u32 = 60;

/// Relative step, in roundings, at which they end.
const CUBE_ROOT_ROUNDING: f64 = 1.0;

/// The cube root of a positive number, zero of others.
pub(crate) fn cube_root<T: Real>(value: T) -> T {
    if value <= T::ZERO {
        return T::ZERO;
    }
    let third = T::constant(1.0 / 3.0);
    let mut root = value.two_fifths_power();
    for _ in 0..CUBE_ROOT_STEPS {
        let step = third * (value / (root * root) - root);
        root = root + step;
        if step.abs() <= T::constant(CUBE_ROOT_ROUNDING) * T::EPSILON * root {
            break;
        }
    }
    root
}

#[cfg(test)]
mod tests {
    use super::cube_root;

    #[test]
    fn cubes_of_roots_are_exact_to_four_units() {
        for power in -30..30 {
            let (double, single) = (1.7 * 10_f64.powi(power), 1.7 * 10_f32.powi(power));
            let root = cube_root(double);
            assert!((root * root * root / double - 1.0).abs() <= 4.0 * f64::EPSILON, "{double:e}");
            let root = f64::from(cube_root(single));
            assert!((root.powi(3) / f64::from(single) - 1.0).abs() <= 4.0 * f64::from(f32::EPSILON), "{single:e}");
        }
        assert_eq!(cube_root(0.0_f32), 0.0);
    }
}
