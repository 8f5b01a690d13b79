//! The restitution of a viscoelastic sphere.

use core::f64::consts::PI;

use super::searched_approach_speed;
use crate::{InputError, Parameter, Real, RestitutionLaw, Sphere, Stiffness};

/// Coefficients of the numerator and of the denominator in z = sqrt(x): a least-squares fit to the simulation for x up to 150. The
/// first ones keep the exact series R = 1 - C_1 x + 0 x^(3/2) with C_1 = 1.1534489.
const NUMERATOR: [f64; 5] =
    [1.0, 1.046_054_025_274_218_5, 0.514_052_760_327_328_4, 0.185_390_921_908_044_26, 0.012_958_969_180_420_084];
const DENOMINATOR: [f64; 9] = [
    1.0,
    1.046_054_025_274_218_5,
    1.667_501_618_427_328_4,
    1.391_960_742_871_500_2,
    1.137_536_589_146_554_5,
    0.506_850_081_476_490_5,
    0.220_846_363_191_318_56,
    0.031_377_824_261_649_48,
    0.000_263_780_280_906_330_6,
];

/// The law of a viscoelastic sphere (Kuwabara and Kono 1987, Brilliantov et al. 1996) whose contact ends where damping cancels the
/// elastic force (Schwager and Poeschel 2008).
///
/// R is a function of x = (3/2) A (K sqrt(r)/m)^(2/5) v^(1/5) alone, and a quotient of polynomials in sqrt(x) here. It differs by
/// less than 3e-7 at any speed from the simulation with
/// [`ViscoelasticDamping`](crate::contact::ViscoelasticDamping) and [`NoTension`](crate::contact::NoTension).
///
/// ```
/// use microimpact::{RestitutionLaw, Sphere, Stiffness, rigid::ViscoelasticRestitution};
///
/// // m = r = K = 1
/// let sphere = Sphere::solid(1.0, 0.75 / core::f64::consts::PI)?;
/// let law = ViscoelasticRestitution::new(&sphere, Stiffness::new(1.0)?, 0.1)?;
/// assert!((law.restitution(1.0) - 0.845_143_806_327_f64).abs() < 3e-7);
/// assert!((law.approach_speed(0.845_143_806).unwrap() - 1.0).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ViscoelasticRestitution<T> {
    /// x at a speed of 1 m/s.
    pub(crate) strength: T,
}

impl<T: Real> ViscoelasticRestitution<T> {
    /// Creates a law from a sphere, the stiffness of its contact, and the relaxation time A of the material, s.
    ///
    /// # Errors
    /// The time is outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, rigid::ViscoelasticRestitution};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert!(ViscoelasticRestitution::new(&sphere, Stiffness::new(1e10)?, -1e-9).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(sphere: &Sphere<T>, stiffness: Stiffness<T>, time: T) -> Result<Self, InputError> {
        let time = Parameter::RelaxationTime.check(time)?;
        let rate = (stiffness.pascals() / sphere.density() * T::constant(0.75 / PI)).two_fifths_power();
        Ok(Self { strength: T::constant(1.5) * time.saturating_div(sphere.radius()) * rate })
    }
}

impl<T: Real> RestitutionLaw<T> for ViscoelasticRestitution<T> {
    fn restitution(&self, speed: T) -> T {
        let z = (self.strength * speed.two_fifths_power().sqrt()).sqrt();
        // In powers of 1/z where these are smaller, so that nothing overflows.
        let large = z > T::ONE;
        let power = if large { T::ONE / z } else { z };
        let polynomial = |coefficients: &[f64]| {
            let step = |sum: T, coefficient: &f64| sum * power + T::constant(*coefficient);
            if large { coefficients.iter().fold(T::ZERO, step) } else { coefficients.iter().rev().fold(T::ZERO, step) }
        };
        let quotient = polynomial(&NUMERATOR) / polynomial(&DENOMINATOR);
        // The polynomials differ in degree by four.
        let square = power * power;
        if large { quotient * square * square } else { quotient }
    }

    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        searched_approach_speed(self, body_rebound)
    }
}
