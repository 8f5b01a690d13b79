//! The adhesive contact of Johnson, Kendall and Roberts.
//!
//! The coordinate s is the root of the contact radius a. In units of an impact the indentation is s^4 - q s, the elastic force
//! (5/4) s^6, the force of adhesion (15/8) q s^3, and the potential s^10/2 - (5/4) q s^7 + (15/32) q^2 s^4 less its value where
//! contact ends. The strength q of adhesion is sqrt(2 pi G/E*) (r/L^3)^(1/4).

use core::f64::consts::PI;

use super::hertz::{HertzUnits, undamped_peak};
use super::{ConstantDamping, ContactLaw, Damping, HystereticDamping, NoDamping, Units, ViscoelasticDamping};
use crate::numbers::cube_root;
use crate::{InputError, Parameter, Real, Sphere, Stiffness};

/// Where a contact with adhesion that is drawn out lets go.
///
/// ```
/// use microimpact::contact::JkrEnd;
///
/// assert_eq!(JkrEnd::default(), JkrEnd::SnapOff);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum JkrEnd {
    /// Where no contact is possible farther out (Thornton and Ning 1998): a^3 = a_0^3/16, with the contact radius a_0 of first
    /// touch.
    #[default]
    SnapOff,
    /// Where the undamped force of the contact pulls most, as in some simulation codes: a^3 = (9/16) a_0^3. Half of the work of
    /// adhesion is not spent then.
    PullOff,
}

/// Contact of spheres whose adhesion deforms them (Johnson, Kendall and Roberts 1971), with damping `D`. It suits large and soft
/// spheres.
///
/// The work of adhesion G (J/m^2) of equal materials is twice their surface energy. Contact begins at zero indentation, at once with
/// a finite radius, and lasts beyond zero indentation on the way out. Without damping e^2 = 1 - (V_s/v)^2 with V_s = 1.840183
/// (G/r)^(5/6)/(rho^(1/2) E*^(1/3)). There is no external force: it has no simple potential where a contact is stretched.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, JkrLaw};
/// use microimpact::{CriticalSpeed, Sphere, Stiffness};
///
/// let (sphere, stiffness) = (Sphere::solid(2e-6, 1050.0)?, Stiffness::new(5e9)?);
/// let scene = Contact::new(sphere, JkrLaw::new(stiffness, 0.1)?);
/// let CriticalSpeed::At(speed) = scene.critical_speed(&Adaptive::new(1e-9_f64)?)? else { panic!() };
/// let sticking = 1.840183180799 * (0.1 / 2e-6_f64).powf(5.0 / 6.0) / 1050_f64.sqrt() / 3.75e9_f64.cbrt();
/// assert!((speed / sticking - 1.0).abs() < 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JkrLaw<T, D = NoDamping> {
    /// K, Pa.
    stiffness: T,
    /// G in J/m^2 or, in units of an impact, q.
    adhesion: T,
    damping: D,
    end: JkrEnd,
    /// In units of an impact: coordinates of first contact and of the end, and the potential at the latter.
    first: T,
    last: T,
    offset: T,
}

/// Coefficients of the potential.
const QUADRATIC: f64 = 15.0 / 32.0;
const LINEAR: f64 = 5.0 / 4.0;

/// Coordinates over that of first contact, the cube root of q: the cube roots of 1/4
const SNAP_OFF: f64 = 0.629_960_524_947_436_6;

/// of 3/4,
const PULL_OFF: f64 = 0.908_560_296_416_069_8;

/// and, where the forces balance, that of 3/2.
const EQUILIBRIUM: f64 = 1.144_714_242_553_332;

/// Steps for the coordinate of an indentation; at snap-off, a double root, each halves the error.
const INVERSION_STEPS: u32 = 60;

impl<T: Real> JkrLaw<T> {
    /// The elastic contact of a stiffness with a work of adhesion G >= 0, J/m^2.
    ///
    /// # Errors
    /// A work outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::JkrLaw};
    ///
    /// assert!(JkrLaw::new(Stiffness::new(1e10)?, -0.1).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(stiffness: Stiffness<T>, work: T) -> Result<Self, InputError> {
        let (adhesion, zero) = (Parameter::AdhesionEnergy.check(work)?, T::ZERO);
        let (stiffness, end) = (stiffness.pascals(), JkrEnd::SnapOff);
        Ok(Self { stiffness, adhesion, damping: NoDamping, end, first: zero, last: zero, offset: zero })
    }
}

impl<T: Real, D> JkrLaw<T, D> {
    /// The same law with another damping.
    pub(crate) fn damped<E>(self, damping: E) -> JkrLaw<T, E> {
        let Self { stiffness, adhesion, end, first, last, offset, .. } = self;
        JkrLaw { stiffness, adhesion, damping, end, first, last, offset }
    }

    /// The same law with hysteretic damping of strength zeta_H >= 0 in the materials. [`HystereticDamping`] says how zeta_H
    /// relates to a damping constant in s/m.
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::JkrLaw};
    ///
    /// assert!(JkrLaw::new(Stiffness::new(1e10)?, 0.1)?.with_damping(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_damping(self, zeta: T) -> Result<JkrLaw<T, HystereticDamping<T>>, InputError> {
        Ok(self.damped(HystereticDamping::new(zeta)?))
    }

    /// The same law with viscoelastic damping of the relaxation time A >= 0, s.
    ///
    /// # Errors
    /// A time outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::JkrLaw};
    ///
    /// assert!(JkrLaw::new(Stiffness::new(1e10)?, 0.1)?.with_viscoelastic_damping(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_viscoelastic_damping(self, time: T) -> Result<JkrLaw<T, ViscoelasticDamping<T>>, InputError> {
        Ok(self.damped(ViscoelasticDamping::new(time)?))
    }

    /// The same law with the damping of [`ConstantDamping`], which without adhesion would leave a restitution e.
    ///
    /// # Errors
    /// A restitution outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::JkrLaw};
    ///
    /// assert!(JkrLaw::new(Stiffness::new(1e10)?, 0.1)?.with_constant_damping(2.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_constant_damping(self, restitution: T) -> Result<JkrLaw<T, ConstantDamping<T>>, InputError> {
        Ok(self.damped(ConstantDamping::new(restitution)?))
    }

    /// The same law with another end of contact.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, JkrEnd, JkrLaw};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let (sphere, motion) = (Sphere::solid(2e-6, 1050.0)?, NormalMotion::new(1.0)?);
    /// let law = JkrLaw::new(Stiffness::new(5e9)?, 0.1)?;
    /// let restitution = |end| -> Result<f64, microimpact::InputError> {
    ///     let scene = Contact::new(sphere, law.ending_at(end));
    ///     Ok(scene.solve(&motion, &Adaptive::new(1e-9)?)?.normal.overall_restitution())
    /// };
    /// assert!(restitution(JkrEnd::PullOff)? > restitution(JkrEnd::SnapOff)?);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn ending_at(self, end: JkrEnd) -> Self {
        Self { end, ..self }
    }
}

impl<T: Real, D: Damping<T>> JkrLaw<T, D> {
    /// The law in units of an impact in which the strength of adhesion is q, the cube of `first`.
    fn with_strength(&self, first: T, units: &HertzUnits<T>) -> Result<Self, InputError> {
        let adhesion = Parameter::AdhesionRatio.check(first * first * first)?;
        let end = match self.end {
            JkrEnd::SnapOff => SNAP_OFF,
            JkrEnd::PullOff => PULL_OFF,
        };
        let (damping, last) = (self.damping.in_units(units)?, T::constant(end) * first);
        let law = Self { adhesion, damping, first, last, ..*self };
        Ok(Self { offset: law.energy(last), ..law })
    }

    /// The potential but for its value where contact ends.
    #[inline]
    fn energy(&self, s: T) -> T {
        let (q, cube) = (self.adhesion, s * s * s);
        s * cube * (T::constant(0.5) * cube * cube - q * (T::constant(LINEAR) * cube - T::constant(QUADRATIC) * q))
    }
}

/// (p^n - s^n)/(p - s).
#[inline]
fn mean_power<T: Real>(p: T, s: T, n: u32) -> T {
    let (mut sum, mut power) = (T::ONE, T::ONE);
    for _ in 1..n {
        power = power * s;
        sum = sum * p + power;
    }
    sum
}

impl<T: Real, D: Damping<T>> ContactLaw<T> for JkrLaw<T, D> {
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError> {
        let hertz = HertzUnits::new(sphere, self.stiffness, T::ZERO, approach)?;
        // E* = (3/4) K.
        let stretch = T::constant(8.0 * PI / 3.0) * self.adhesion / self.stiffness / sphere.radius();
        let root = (hertz.length / sphere.radius()).sqrt();
        let first = cube_root(stretch.sqrt().saturating_div(root * root.sqrt()));
        let law = self.with_strength(first, &hertz)?;
        let brought = hertz.energy + law.potential(first);
        let from = T::ONE.max(T::constant(EQUILIBRIUM) * first);
        let Some(peak) = undamped_peak(&law, from, brought) else {
            return Ok((law, hertz.units()));
        };
        let units = hertz.enlarged(peak * peak);
        let law = self.with_strength(first / peak, &units)?;
        Ok((law, units.units()))
    }

    #[inline]
    fn loss_power(&self) -> u32 {
        0 // contact begins and ends elsewhere than at s = 0
    }

    #[inline]
    fn potential(&self, s: T) -> T {
        self.energy(s) - self.offset
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        -(self.conservative_force(s) * self.indentation_slope(s))
    }

    #[inline]
    fn curvature(&self, s: T) -> T {
        let (q, cube) = (self.adhesion, s * s * s);
        let [constant, linear, square] = [12.0 * QUADRATIC, 42.0 * LINEAR, 45.0].map(T::constant);
        s * s * (constant * q * q + cube * (square * cube - linear * q))
    }

    #[inline]
    fn mean_slope(&self, p: T, s: T) -> T {
        let q = self.adhesion;
        let (four, seven, ten) = (mean_power(p, s, 4), mean_power(p, s, 7), mean_power(p, s, 10));
        T::constant(0.5) * ten - q * (T::constant(LINEAR) * seven - T::constant(QUADRATIC) * q * four)
    }

    #[inline]
    fn elastic_force(&self, s: T) -> T {
        let cube = s * s * s;
        T::constant(1.25) * cube * cube
    }

    #[inline]
    fn adhesion_force(&self, s: T) -> T {
        T::constant(1.875) * self.adhesion * s * s * s
    }

    #[inline]
    fn conservative_force(&self, s: T) -> T {
        self.adhesion_force(s) - self.elastic_force(s)
    }

    #[inline]
    fn material_damping(&self, s: T) -> T {
        self.damping.force(self.elastic_force(s), s * s, s)
    }

    #[inline]
    fn indentation(&self, s: T) -> T {
        s * (s * s * s - self.adhesion)
    }

    #[inline]
    fn indentation_slope(&self, s: T) -> T {
        T::constant(4.0) * s * s * s - self.adhesion
    }

    #[inline]
    fn coordinate(&self, _indentation: T) -> Option<T> {
        None // a stretched contact has two radii for each indentation
    }

    fn coordinate_in_contact(&self, indentation: T) -> Option<T> {
        if indentation < self.indentation(self.last) {
            return None;
        }
        // Newton's method from above, where the indentation is a convex function of the coordinate.
        let mut s = indentation.max(T::ZERO).sqrt().sqrt() + self.first;
        for _ in 0..INVERSION_STEPS {
            let slope = self.indentation_slope(s);
            if slope <= T::ZERO {
                break;
            }
            let step = (self.indentation(s) - indentation) / slope;
            s = s - step;
            if step <= T::EPSILON * s {
                break;
            }
        }
        Some(s.max(self.last))
    }

    #[inline]
    fn contact_radius(&self, s: T) -> T {
        s * s
    }

    #[inline]
    fn start(&self) -> T {
        self.first
    }

    #[inline]
    fn end(&self) -> T {
        self.last
    }

    #[inline]
    fn may_have_barrier(&self) -> bool {
        false
    }

    #[inline]
    fn energy_power(&self) -> f64 {
        10.0
    }

    /// The speed whose energy is about the work that an undamped impact loses.
    fn speed_of_adhesion(&self, sphere: &Sphere<T>) -> T {
        let ratio = self.adhesion / self.stiffness / sphere.radius();
        let rate = (self.stiffness / sphere.density()).sqrt();
        if ratio <= T::ZERO {
            return T::ONE;
        }
        // V_s/sqrt(K/rho) = 2.03 (G/(K r))^(5/6).
        T::constant(2.0) * rate * ratio.sqrt() * cube_root(ratio)
    }
}
