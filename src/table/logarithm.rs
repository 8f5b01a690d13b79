//! Logarithms to base 2 as integers, in units of 2^-23 octaves.
//!
//! The bits of a positive f32, read as an integer, are its logarithm plus an offset, but between two powers of two they are
//! linear. A short polynomial corrects this difference. It needs no floating-point unit.

use crate::Real;

/// A number type that converts from and to f32, as the tables need it.
///
/// ```
/// use microimpact::table::Single;
///
/// assert_eq!(1.5_f64.single(), 1.5_f32);
/// assert_eq!(f64::from_single(1.5), 1.5);
/// ```
pub trait Single: Real {
    /// The nearest f32.
    fn single(self) -> f32;

    /// Converts an f32 without error.
    fn from_single(number: f32) -> Self;
}

impl Single for f32 {
    #[inline]
    fn single(self) -> f32 {
        self
    }

    #[inline]
    fn from_single(number: f32) -> Self {
        number
    }
}

impl Single for f64 {
    #[inline]
    fn single(self) -> f32 {
        self as f32
    }

    #[inline]
    fn from_single(number: f32) -> Self {
        number.into()
    }
}

/// An octave (a factor of two) in the units of the logarithms.
pub(super) const OCTAVE: u32 = 1 << 23;

/// Converts a difference of logarithms to octaves.
#[inline]
pub(super) fn octaves<T: Single>(difference: i32) -> T {
    T::from_single(difference as f32 * (1.0 / OCTAVE as f32))
}

/// Largest error of [`logarithm`]. A test tries every number of an octave.
pub(super) const LARGEST_ERROR: u32 = 200;

/// Logarithm of a positive normal number. The error is at most [`LARGEST_ERROR`].
#[inline]
pub(super) const fn logarithm(number: f32) -> i32 {
    let bits = number.to_bits();
    (bits + bulge(bits)) as i32
}

/// Difference between the logarithm and the bits: log2(1 + f) - f = f (1 - f) q(f), where f is the fraction.
#[inline]
const fn bulge(bits: u32) -> u32 {
    // The cubic q minimizes the largest error of f (1 - f) q(f); its unit is 2^-17. All factors have 16 bits, so that every
    // processor can multiply them.
    const Q: [u32; 4] = [57_923, 35_020, 19_455, 5_918];
    let f = (bits >> 7) & 0xffff;
    let q = Q[2] - ((Q[3] * f) >> 16);
    let q = Q[1] - ((q * f) >> 16);
    let q = Q[0] - ((q * f) >> 16);
    let parabola = (f * (0x1_0000 - f)) >> 14;
    (parabola * q) >> 12
}

/// The number with a given [`logarithm`].
pub(super) const fn number(logarithm: i32) -> f32 {
    // The slope of the bulge is at most 0.45, so that each iteration more than halves the error.
    let mut bits = logarithm as u32;
    let mut iteration = 0;
    while iteration < 23 {
        bits = (logarithm as u32).wrapping_sub(bulge(bits));
        iteration += 1;
    }
    f32::from_bits(bits)
}

/// Logarithm of a positive normal number with an error of at most two units. Each squaring gives one binary digit.
pub(super) fn exact_logarithm(number: f32) -> i32 {
    let bits = number.to_bits();
    // One bit before the binary point, 31 after it.
    let mut mantissa = u64::from((bits << 8) | 1 << 31);
    let mut fraction = 0;
    for _ in 0..23 {
        mantissa = (mantissa * mantissa) >> 31;
        let digit = mantissa >> 32;
        mantissa >>= digit;
        fraction = fraction << 1 | digit as u32;
    }
    ((bits & !(OCTAVE - 1)) | fraction) as i32
}

#[cfg(test)]
mod tests {
    use super::{LARGEST_ERROR, OCTAVE, exact_logarithm, logarithm, number};

    /// The exact logarithm, zero for the number one.
    fn reference(x: f32) -> f64 {
        libm::log2(f64::from(x)) * f64::from(OCTAVE)
    }

    fn from_one(logarithm: i32) -> f64 {
        f64::from(logarithm - 127 * OCTAVE as i32)
    }

    #[test]
    fn errors_over_an_octave() {
        let (mut greatest, mut of_exact) = (0.0_f64, 0.0_f64);
        for fraction in (0..OCTAVE).step_by(if cfg!(miri) { 100_003 } else { 1 }) {
            let x = f32::from_bits(127 * OCTAVE + fraction);
            greatest = greatest.max((from_one(logarithm(x)) - reference(x)).abs());
            of_exact = of_exact.max((from_one(exact_logarithm(x)) - reference(x)).abs());
        }
        assert!(greatest <= f64::from(LARGEST_ERROR), "{greatest}");
        // A bound far above the actual error would widen every margin.
        assert!(cfg!(miri) || greatest > 0.9 * f64::from(LARGEST_ERROR), "{greatest}");
        assert!(of_exact <= 2.0, "{of_exact}");
    }

    #[test]
    fn octaves_differ_by_their_number() {
        for power in -40..40 {
            let (x, units) = (1.37 * libm::exp2(f64::from(power)) as f32, power * OCTAVE as i32);
            assert_eq!(logarithm(x), logarithm(1.37) + units);
            assert_eq!(exact_logarithm(x), exact_logarithm(1.37) + units);
        }
    }

    #[test]
    fn number_inverts_the_logarithm() {
        let mut x = 1e-12_f32;
        while x < 1e6 {
            assert!((logarithm(number(logarithm(x))) - logarithm(x)).abs() <= 1, "{x}");
            x *= if cfg!(miri) { 1.37 } else { 1.000_37 };
        }
    }
}
