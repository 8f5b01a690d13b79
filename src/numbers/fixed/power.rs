//! The power 2/5 in integers.

// The octaves of a number are counted modulo the length of the array.
#![allow(clippy::indexing_slicing)]

use super::{FRACTION, FixedPoint};
use crate::Real;

/// Bits after the binary point on the way to the power, where numbers are below four.
const BITS: u32 = 30;

/// x^(-1/5) in the middle of each of the five octaves from 1 down to 1/32.
const STARTS: [u32; 5] = [scaled(1.0743), scaled(1.2341), scaled(1.4176), scaled(1.6284), scaled(1.8706)];

/// Steps of Newton's method. The error of a start is below 7 %, and each step makes an error of e one of 3 e^2. A last step is
/// taken on the power itself.
const STEPS: u32 = 3;

const fn scaled(value: f64) -> u32 {
    (value * (1_u64 << BITS) as f64) as u32
}

/// x^(2/5), with an error below one unit up to 16 and two units above; zero unless x is positive.
pub(super) fn two_fifths(x: FixedPoint) -> FixedPoint {
    let units = x.0.to_bits();
    if units <= 0 {
        return FixedPoint::ZERO;
    }
    // m = x 32^n lies between 1/32 and 1, `octave` octaves below 1.
    let zeros = units.leading_zeros() + 2;
    let (n_and_two, octave) = (zeros / 5, (zeros % 5) as usize);
    let m = if n_and_two == 0 { units.unsigned_abs() >> 4 } else { units.unsigned_abs() << (5 * n_and_two - 4) };
    let (mut root, fifth) = (STARTS[octave], product(scaled(0.2), m));
    for _ in 0..STEPS {
        let square = product(root, root);
        let excess = product(product(product(fifth, square), square), root);
        root = product(root, scaled(1.2) - excess);
    }
    let square = product(root, root);
    let power = product(product(m, root), square);
    let power = product(power, scaled(1.6) - product(scaled(0.6), product(power, square)));
    // x^(2/5) = 4^-n m^(2/5).
    let shift = BITS - FRACTION - 4 + 2 * n_and_two;
    FixedPoint::from_bits(((power + (1 << (shift - 1))) >> shift) as i32)
}

/// Product of two numbers, rounded to the nearest.
#[inline(never)]
fn product(a: u32, b: u32) -> u32 {
    ((u64::from(a) * u64::from(b) + (1 << (BITS - 1))) >> BITS) as u32
}

#[cfg(test)]
mod tests {
    use super::two_fifths;
    use crate::{FixedPoint, Real};

    #[test]
    fn powers_are_exact_to_a_few_units() {
        let mut units = 1_i32;
        while units < i32::MAX / 2 {
            for units in [units, units + 1, 2 * units - 1] {
                let x = FixedPoint::from_bits(units);
                let exact = x.to_f64().two_fifths_power() * (1 << 24) as f64;
                let error = f64::from(two_fifths(x).to_bits()) - exact;
                let most = if units < 16 << 24 { 1.0 } else { 2.0 };
                assert!(error.abs() <= most, "{units}: {error}");
            }
            units += if cfg!(miri) { units / 2 + 1 } else { units / 300 + 1 };
        }
        for units in [i32::MIN, -1, 0] {
            assert_eq!(two_fifths(FixedPoint::from_bits(units)), FixedPoint::ZERO);
        }
    }
}
