//! The only door between SI units and the dimensionless motion.
//!
//! Unit of length is the peak indentation L of the undamped motion without external force, unit of speed U is such that the
//! elastic force becomes (5/4) s^3, with the contact radius in units of sqrt(r L). Then 0 <= s <= 1 and |y| <= 1 without an
//! external force, whatever the particle, and 2 E = 1 - p before the impact, where p < 1 is the strength of adhesion: its
//! force is (3/4) p s.

use core::f64::consts::PI;

use super::damping::{HystereticDamping, NoDamping, ScaledDamping};
use super::force::{ConstantForce, NoForce, ScaledForce};
use super::ring::{Ring, ScaledRing};
use super::tangential::{NoPeeling, Peeling, ScaledPeeling, SpinDamping};
use crate::{InputError, NoAdhesion, Parameter, Real, Sphere, Stiffness};

/// The units of one impact, and the energy that the sphere brings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaled<T> {
    /// L, m.
    pub(super) length: T,
    /// U, m/s.
    pub(super) speed: T,
    /// Strength p of adhesion.
    pub(super) adhesion: T,
    /// Kinetic energy before the impact, in units of m U^2.
    pub(super) energy: T,
    /// C U, the damping of strength zeta = 1.
    pub(super) damping: T,
}

impl<T: Real> Scaled<T> {
    /// Units for a sphere that arrives with `approach` (m/s) at a contact of equilibrium indentation `equilibrium` (m).
    pub(super) fn new(
        sphere: &Sphere<T>,
        stiffness: Stiffness<T>,
        equilibrium: T,
        approach: T,
    ) -> Result<Self, InputError> {
        // w = v sqrt(m/(r^3 K)), where m/r^3 = 4 pi density/3: no product here leaves the range of single precision.
        let w = approach * (T::constant(4.0 * PI / 3.0) * sphere.density() / stiffness.pascals()).sqrt();
        let root = w.two_fifths_power();
        // C v, with C of B4: (m/(r^3 K))^(2/5) v^(4/5).
        let damping = root * root;
        // delta_Hertz = (5/4)^(2/5) r w^(4/5).
        let hertz = T::constant(1.093_362_073_943_278_1) * damping * sphere.radius();
        let adhesion = Parameter::AdhesionRatio.check(T::constant(5.0 / 3.0) * equilibrium / hertz)?;
        let (inverse, energy) = inverse_peak_contact_radius(adhesion);
        let peak = T::ONE / inverse;
        let growth = peak * peak * peak.sqrt();
        Ok(Self {
            length: hertz * peak * peak,
            speed: approach * growth,
            adhesion: (adhesion * inverse) * inverse,
            energy,
            damping: damping * growth,
        })
    }

    /// Unit of time L/U, s.
    pub(super) fn time(&self) -> T {
        self.length / self.speed
    }
}

/// The dimensionless groups of an impact: what its normal motion depends on.
///
/// With the peak indentation L of the undamped motion for a unit of length and its largest speed U for one of speed, the
/// elastic force is A s^3 and adhesion B s at the contact radius s, both over m U^2/L; h = c_H U and g = c_A U.
///
/// ```
/// use microimpact::simulation::Simulation;
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// let groups = scene.groups(&NormalMotion::new(2.8)?)?;
/// assert!((groups.elasticity - 4.04664580819485_f64).abs() < 1e-13);
/// assert!((groups.adhesion - 1.93338183537566).abs() < 1e-13);
/// assert!((groups.material_damping - 0.05421470475834531).abs() < 1e-15);
/// assert!((groups.adhesion_damping - 0.03227065759425316).abs() < 1e-15);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Groups<T> {
    /// A, from 5/4 without adhesion to 6.72.
    pub elasticity: T,
    /// B, from 0 to 4.04.
    pub adhesion: T,
    /// h.
    pub material_damping: T,
    /// g.
    pub adhesion_damping: T,
}

impl<T: Real> Scaled<T> {
    /// The groups of an impact whose damping rates, in these units, are as given.
    pub(super) fn groups(&self, material_damping: T, adhesion_damping: T) -> Groups<T> {
        // The undamped motion is fastest at s^2 = (3/5) p, where V = -(1/5) (3/5)^(3/2) p^(5/2).
        let p = self.adhesion;
        let fastest = self.energy + self.energy + T::constant(0.4 * 0.464_758_001_544_890_1) * p * p * p.sqrt();
        let speed = fastest.sqrt();
        Groups {
            elasticity: T::constant(1.25) / fastest,
            adhesion: T::constant(0.75) * p / fastest,
            material_damping: material_damping * speed,
            adhesion_damping: adhesion_damping * speed,
        }
    }
}

/// Contact radius of Hertz's peak over that of the undamped one, the root b of b^5 + p b^2 = 1; and b^5/2, the energy
/// before the impact, which is exact to fewer roundings than a fifth power of b has.
fn inverse_peak_contact_radius<T: Real>(p: T) -> (T, T) {
    let (two, five) = (T::constant(2.0), T::constant(5.0));
    // Right to 1e-3 for every p.
    let ratio = T::ONE + p * (T::constant(0.58) + T::constant(0.315) * p);
    let mut b = (ratio / (p * ratio + T::ONE)).sqrt();
    let mut fifth = T::ONE;
    for _ in 0..4 {
        let square = b * b;
        let pull = p * square;
        fifth = square * square * b;
        let excess = (pull - T::ONE + fifth) / (five * fifth + two * pull);
        b = b - b * excess;
        fifth = fifth - five * fifth * excess;
        // What is left of the error is less than twice the square of the step.
        if excess * excess <= T::constant(0.06) * T::EPSILON {
            break;
        }
    }
    (b, T::constant(0.5) * fifth)
}

/// A term of a scene that becomes a dimensionless term of the motion.
///
/// ```
/// use microimpact::simulation::{NoDamping, Scale};
///
/// assert_eq!(size_of::<<NoDamping as Scale<f32>>::Scaled>(), 0);
/// ```
pub trait Scale<T: Real> {
    /// The dimensionless term.
    type Scaled: Copy;

    /// Equilibrium indentation that the term would give the sphere, m.
    #[inline]
    fn equilibrium(&self, _stiffness: Stiffness<T>) -> T {
        T::ZERO
    }

    /// The term in units of the impact of a sphere.
    ///
    /// # Errors
    /// A ratio outside its range.
    fn scale(&self, sphere: &Sphere<T>, units: &Scaled<T>) -> Result<Self::Scaled, InputError>;
}

macro_rules! absent {
    ($term:ty) => {
        impl<T: Real> Scale<T> for $term {
            type Scaled = Self;

            #[inline]
            fn scale(&self, _sphere: &Sphere<T>, _units: &Scaled<T>) -> Result<Self, InputError> {
                Ok(*self)
            }
        }
    };
}

absent!(NoDamping);
absent!(NoAdhesion);
absent!(NoForce);

impl<T: Real> Scale<T> for HystereticDamping<T> {
    type Scaled = ScaledDamping<T>;

    #[inline]
    fn scale(&self, _sphere: &Sphere<T>, units: &Scaled<T>) -> Result<ScaledDamping<T>, InputError> {
        Ok(ScaledDamping(Parameter::DampingRatio.check(self.zeta * units.damping)?))
    }
}

impl<T: Real> Scale<T> for Ring<T> {
    type Scaled = ScaledRing<T>;

    /// delta_eq = 2 pi f0/K.
    #[inline]
    fn equilibrium(&self, stiffness: Stiffness<T>) -> T {
        T::constant(2.0 * PI) * self.strength / stiffness.pascals()
    }

    #[inline]
    fn scale(&self, _sphere: &Sphere<T>, units: &Scaled<T>) -> Result<ScaledRing<T>, InputError> {
        let damping = Parameter::DampingRatio.check(self.zeta * units.damping)?;
        Ok(ScaledRing { strength: units.adhesion, damping })
    }
}

impl<T: Real> Scale<T> for ConstantForce<T> {
    type Scaled = ScaledForce<T>;

    #[inline]
    fn scale(&self, sphere: &Sphere<T>, units: &Scaled<T>) -> Result<ScaledForce<T>, InputError> {
        let acceleration = self.force / sphere.mass();
        let inwards = -(acceleration / units.speed * units.time());
        Ok(ScaledForce(Parameter::ForceRatio.check(inwards)?))
    }
}

/// A peeling moment of a scene that becomes one of the motion; it goes by the damping of the adhesion `A`.
pub trait ScalePeeling<T: Real, A> {
    /// The dimensionless moment.
    type Scaled: SpinDamping<T>;

    /// The moment in units of the impact of a sphere.
    ///
    /// # Errors
    /// A ratio outside its range.
    fn scale(&self, adhesion: &A, sphere: &Sphere<T>, units: &Scaled<T>) -> Result<Self::Scaled, InputError>;
}

impl<T: Real, A> ScalePeeling<T, A> for NoPeeling {
    type Scaled = Self;

    #[inline]
    fn scale(&self, _adhesion: &A, _sphere: &Sphere<T>, _units: &Scaled<T>) -> Result<Self, InputError> {
        Ok(*self)
    }
}

impl<T: Real> ScalePeeling<T, Ring<T>> for Peeling<T> {
    type Scaled = ScaledPeeling<T>;

    fn scale(&self, ring: &Ring<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Result<ScaledPeeling<T>, InputError> {
        // lambda c_A a/(kappa m r^2) at a = sqrt(r L), for a time L/U; c_A U = zeta_A C U.
        let inertia = sphere.gyration_ratio() * sphere.mass();
        let decay = self.lambda / inertia / units.speed * (ring.zeta * units.damping / units.speed);
        let depth = units.length / sphere.radius();
        let rate = decay * depth * depth.sqrt();
        Ok(ScaledPeeling(Parameter::DampingRatio.check(rate)?))
    }
}
