//! Logarithms to base 2 in integers: 2^-23 octaves, counted like the bits of a single-precision number.
//!
//! The bits of a positive number, read as an integer, are its logarithm but for the part between two powers of two, where
//! they are linear. So a logarithm costs one short polynomial, with or without a floating-point unit.

use crate::Real;

/// A number type whose numbers can be had from and read in single precision.
///
/// ```
/// use microimpact::boundary::Single;
///
/// assert_eq!(1.5_f64.single(), 1.5_f32);
/// assert_eq!(f64::from_single(1.5), 1.5);
/// ```
pub trait Single: Real {
    /// The nearest number of single precision.
    fn single(self) -> f32;

    /// The same number.
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

/// An octave, a factor of two.
pub(super) const OCTAVE: u32 = 1 << 23;

/// A difference of logarithms in octaves.
#[inline]
pub(super) fn octaves<T: Single>(difference: i32) -> T {
    T::from_single(difference as f32 * (1.0 / OCTAVE as f32))
}

/// Greatest error of [`logarithm`]; the test below tries every number of an octave.
pub(super) const GREATEST_ERROR: u32 = 200;

/// Logarithm of a positive normal number, to [`GREATEST_ERROR`].
#[inline]
pub(super) const fn logarithm(number: f32) -> i32 {
    let bits = number.to_bits();
    (bits + bulge(bits)) as i32
}

/// By how much the logarithm exceeds the bits: log2(1 + f) - f = f (1 - f) q(f), f being the fraction.
#[inline]
const fn bulge(bits: u32) -> u32 {
    // The cubic of least greatest error in f (1 - f) q(f), in units of 2^-17; factors of 16 bits fit any processor.
    const Q: [u32; 4] = [57_923, 35_020, 19_455, 5_918];
    let f = (bits >> 7) & 0xffff;
    let q = Q[2] - ((Q[3] * f) >> 16);
    let q = Q[1] - ((q * f) >> 16);
    let q = Q[0] - ((q * f) >> 16);
    let parabola = (f * (0x1_0000 - f)) >> 14;
    (parabola * q) >> 12
}

/// The number whose [`logarithm`] is given.
pub(super) fn number(logarithm: i32) -> f32 {
    // The bulge is never steeper than 0.45, so that each turn more than halves the error.
    let mut bits = logarithm as u32;
    for _ in 0..23 {
        bits = (logarithm as u32).wrapping_sub(bulge(bits));
    }
    f32::from_bits(bits)
}

/// Logarithm of a positive normal number, to two units: by squaring, one digit after the other.
pub(super) fn exact_logarithm(number: f32) -> i32 {
    let bits = number.to_bits();
    // One bit before the point, 31 behind it.
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
    use super::{GREATEST_ERROR, OCTAVE, exact_logarithm, logarithm, number};

    /// In units, counted from one.
    fn reference(x: f32) -> f64 {
        libm::log2(f64::from(x)) * f64::from(OCTAVE)
    }

    fn from_one(logarithm: i32) -> f64 {
        f64::from(logarithm - 127 * OCTAVE as i32)
    }

    #[test]
    fn errors_over_an_octave() {
        let (mut greatest, mut of_exact) = (0.0_f64, 0.0_f64);
        for fraction in 0..OCTAVE {
            let x = f32::from_bits(127 * OCTAVE + fraction);
            greatest = greatest.max((from_one(logarithm(x)) - reference(x)).abs());
            of_exact = of_exact.max((from_one(exact_logarithm(x)) - reference(x)).abs());
        }
        assert!(greatest <= f64::from(GREATEST_ERROR), "{greatest}");
        // A bound that is far from what happens would widen every margin.
        assert!(greatest > 0.9 * f64::from(GREATEST_ERROR), "{greatest}");
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
            x *= 1.000_37;
        }
    }
}
