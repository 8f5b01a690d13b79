//! Hertz's elastic contact, alone or with adhesion and an external force that leave its profile as it is.
//!
//! In units of an impact the elastic force is (5/4) s^3 at the contact radius s, the indentation s^2, and the potential
//! V = s^5/2 less what adhesion and the external force give.

use core::f64::consts::PI;

use super::{ConstantForce, ContactLaw, Damping, Fraction, HystereticDamping, NoDamping, NoForce, Ring};
use crate::contact::units::Units;
use crate::{InputError, NoAdhesion, Parameter, Real, Sphere, Stiffness};

/// Duration of Hertz's impact in units of its peak indentation over its speed: 2 sqrt(pi) Gamma(7/5)/Gamma(9/10).
pub(super) const HERTZ_DURATION: f64 = 2.943_275_2;

/// Peak indentation of Hertz's impact over r (m v^2/(r^3 K))^(2/5): (5/4)^(2/5).
const HERTZ_PEAK: f64 = 1.093_362_073_943_278_1;

/// Coefficients of a first value of the peak, right to 1e-3 for every strength of adhesion.
const PEAK_RATIO: (f64, f64) = (0.58, 0.315);

/// Steps of Newton's method after it, at most.
const PEAK_STEPS: u32 = 4;

/// Square of the relative step at which they end, in roundings: the error that remains is below twice the square.
const PEAK_ACCURACY: f64 = 0.06;

/// Factor in the search for a coordinate beyond the peak under an external force,
const PEAK_GROWTH: f64 = 1.5;

/// and steps of it and of Newton's method at most.
const PEAK_SEARCH: u32 = 60;

/// Relative step of the latter, in roundings, at which it ends.
const PEAK_ROUNDING: f64 = 4.0;

/// A force besides the elastic one, conservative but for its damping on rebound: adhesion or an external force.
///
/// What it gives the sphere is taken from the potential, so that an absent force leaves no operation behind. All functions
/// but [`in_units`](Self::in_units) and [`equilibrium`](Self::equilibrium) are those of the force in units of an impact.
///
/// ```
/// use microimpact::{NoAdhesion, contact::Attraction};
///
/// assert_eq!(Attraction::<f32>::energy(&NoAdhesion, 0.5), 0.0);
/// ```
pub trait Attraction<T: Real>: Copy {
    /// The force in units of the impact of a sphere.
    ///
    /// # Errors
    /// A ratio of forces that cannot be represented.
    fn in_units(&self, sphere: &Sphere<T>, units: &HertzUnits<T>) -> Result<Self, InputError>;

    /// Whether there is such a force at all.
    #[inline]
    fn is_present(&self) -> bool {
        true
    }

    /// Equilibrium indentation that adhesion alone would give the sphere, m.
    #[inline]
    fn equilibrium(&self, _stiffness: T) -> T {
        T::ZERO
    }

    /// Energy that the force gives a sphere on its way to s.
    #[inline]
    fn energy(&self, _s: T) -> T {
        T::ZERO
    }

    /// Its derivative with respect to s.
    #[inline]
    fn slope(&self, _s: T) -> T {
        T::ZERO
    }

    /// Its second derivative with respect to s.
    #[inline]
    fn curvature(&self, _s: T) -> T {
        T::ZERO
    }

    /// (energy(p) - energy(s))/(p - s), without the cancellation of a difference.
    #[inline]
    fn mean_slope(&self, _p: T, _s: T) -> T {
        T::ZERO
    }

    /// The force itself.
    #[inline]
    fn force(&self, _s: T) -> T {
        T::ZERO
    }

    /// Its damping force for each unit of speed.
    #[inline]
    fn damping(&self, _s: T) -> T {
        T::ZERO
    }

    /// As [`ContactLaw::potential_drop`], of the energy.
    #[inline]
    fn energy_drop(&self, _peak: T, _fraction: &Fraction<T>) -> T {
        T::ZERO
    }

    /// As [`ContactLaw::loss_over_square`].
    #[inline]
    fn loss_over_square(&self, _peak: T, _fraction: &Fraction<T>) -> T {
        T::ZERO
    }

    /// Fraction of the force that its damping adds for each unit of speed.
    #[inline]
    fn damping_rate(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> Attraction<T> for NoAdhesion {
    #[inline]
    fn in_units(&self, _sphere: &Sphere<T>, _units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self)
    }

    #[inline]
    fn is_present(&self) -> bool {
        false
    }
}

/// Hertz's contact: elastic force sqrt(r) K delta^(3/2) with damping `D`, adhesion `A` and external force `X` (B6).
///
/// ```
/// use microimpact::contact::HertzLaw;
/// use microimpact::{Sphere, Stiffness};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let law = HertzLaw::new(Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
/// let depth = 4.251e-8; // m, the peak of Table 1
/// assert!((law.contact_radius_at(&sphere, depth) - 4.638e-7_f64).abs() < 1e-10);
/// assert!((law.elastic_force_at(&sphere, depth) - 1.479e-3).abs() < 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HertzLaw<T, D = NoDamping, A = NoAdhesion, X = NoForce> {
    /// K, Pa.
    pub(crate) stiffness: T,
    pub(crate) damping: D,
    pub(crate) adhesion: A,
    pub(crate) force: X,
}

impl<T: Real> HertzLaw<T> {
    /// The elastic contact of a stiffness, with nothing else.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert_eq!(size_of_val(&HertzLaw::new(Stiffness::new(1e10_f32)?)), size_of::<f32>());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(stiffness: Stiffness<T>) -> Self {
        Self { stiffness: stiffness.pascals(), damping: NoDamping, adhesion: NoAdhesion, force: NoForce }
    }
}

impl<T: Real, D, A, X> HertzLaw<T, D, A, X> {
    /// The same law with hysteretic damping of strength zeta_H >= 0 in the materials.
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert!(HertzLaw::new(Stiffness::new(1e10)?).with_damping(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_damping(self, zeta: T) -> Result<HertzLaw<T, HystereticDamping<T>, A, X>, InputError> {
        let Self { stiffness, adhesion, force, .. } = self;
        Ok(HertzLaw { stiffness, damping: HystereticDamping::new(zeta)?, adhesion, force })
    }

    /// The same law with a ring force of strength f0 >= 0 (N/m) and its damping zeta_A >= 0 on rebound.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert!(HertzLaw::new(Stiffness::new(1e10)?).with_ring(-1.0, 0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_ring(self, strength: T, zeta: T) -> Result<HertzLaw<T, D, Ring<T>, X>, InputError> {
        let Self { stiffness, damping, force, .. } = self;
        Ok(HertzLaw { stiffness, damping, adhesion: Ring::new(strength, zeta)?, force })
    }

    /// The same law with a constant external force, N, positive out of the surface.
    ///
    /// # Errors
    /// A force outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert!(HertzLaw::new(Stiffness::new(1e10)?).with_external_force(f64::INFINITY).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_external_force(self, force: T) -> Result<HertzLaw<T, D, A, ConstantForce<T>>, InputError> {
        let Self { stiffness, damping, adhesion, .. } = self;
        Ok(HertzLaw { stiffness, damping, adhesion, force: ConstantForce::new(force)? })
    }

    /// Contact radius at an indentation (m): sqrt(r delta), m.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::HertzLaw};
    ///
    /// let law = HertzLaw::new(Stiffness::new(1e10)?);
    /// assert_eq!(law.contact_radius_at(&Sphere::solid(0.25, 1000.0)?, 0.01), 0.05);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn contact_radius_at(&self, sphere: &Sphere<T>, indentation: T) -> T {
        (sphere.radius() * indentation).sqrt()
    }

    /// Elastic force at an indentation (m): sqrt(r) K delta^(3/2), N.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::HertzLaw};
    ///
    /// let law = HertzLaw::new(Stiffness::new(1e10)?);
    /// assert!((law.elastic_force_at(&Sphere::solid(0.25, 1000.0)?, 0.01) - 5e6_f64).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn elastic_force_at(&self, sphere: &Sphere<T>, indentation: T) -> T {
        // In this order no product leaves the range of single precision.
        let ratio = indentation / sphere.radius();
        sphere.radius() * sphere.radius() * self.stiffness * ratio * ratio.sqrt()
    }
}

impl<T: Real, D: Damping<T>, A: Attraction<T>, X: Attraction<T>> HertzLaw<T, D, A, X> {
    fn in_hertz_units(&self, sphere: &Sphere<T>, units: &HertzUnits<T>) -> Result<Self, InputError> {
        Ok(Self {
            stiffness: self.stiffness,
            damping: self.damping.in_units(units.damping)?,
            adhesion: self.adhesion.in_units(sphere, units)?,
            force: self.force.in_units(sphere, units)?,
        })
    }

    /// Strength p of adhesion in units of an impact: its energy is (p/2) s^3.
    pub(crate) fn adhesion_strength(&self) -> T {
        T::constant(2.0) * self.adhesion.energy(T::ONE)
    }

    /// The dimensionless groups of this law in units of an impact of the kinetic energy `energy`.
    pub(crate) fn groups(&self, energy: T) -> Groups<T> {
        // The undamped motion is fastest at s^2 = (3/5) p, where V = -(1/5) (3/5)^(3/2) p^(5/2).
        let p = self.adhesion_strength();
        let fastest = energy + energy + T::constant(0.4 * 0.464_758_001_544_890_1) * p * p * p.sqrt();
        let speed = fastest.sqrt();
        Groups {
            elasticity: T::constant(1.25) / fastest,
            adhesion: T::constant(0.75) * p / fastest,
            material_damping: self.damping.rate() * speed,
            adhesion_damping: self.adhesion.damping_rate() * speed,
        }
    }

    /// Coordinate at which the undamped motion under an external force turns, `None` where the force turns it back before.
    fn undamped_peak(&self, energy: T) -> Option<T> {
        let mut peak = T::ONE;
        for _ in 0..PEAK_SEARCH {
            if self.potential(peak) >= energy {
                break;
            }
            peak = peak * T::constant(PEAK_GROWTH);
        }
        // From above Newton's method comes down without passing the root, as the potential is convex there.
        for _ in 0..PEAK_SEARCH {
            let slope = self.slope(peak);
            if slope <= T::ZERO {
                return None;
            }
            let step = (self.potential(peak) - energy) / slope;
            peak = peak - step;
            if step.abs() <= T::constant(PEAK_ROUNDING) * T::EPSILON * peak {
                break;
            }
        }
        Some(peak)
    }
}

impl<T: Real, D: Damping<T>, A: Attraction<T>, X: Attraction<T>> ContactLaw<T> for HertzLaw<T, D, A, X> {
    #[inline]
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError> {
        let mut units = HertzUnits::new(sphere, self.stiffness, self.adhesion.equilibrium(self.stiffness), approach)?;
        let mut law = self.in_hertz_units(sphere, &units)?;
        if self.force.is_present() {
            let peak = law.undamped_peak(units.energy);
            if let Some(peak) = peak.filter(|peak| *peak > T::constant(LEAST_PEAK)) {
                let enlarged = units.enlarged(peak);
                // Damping that is out of range in larger units stays in those of the impact without the force.
                if let Ok(in_enlarged) = self.in_hertz_units(sphere, &enlarged) {
                    (units, law) = (enlarged, in_enlarged);
                }
            }
        }
        Ok((law, Units { length: units.length, speed: units.speed, energy: units.energy }))
    }

    #[inline]
    fn loss_power(&self) -> u32 {
        // Material damping goes with s^4, that of a ring with s^2.
        2
    }

    #[inline]
    fn may_have_barrier(&self) -> bool {
        self.force.is_present()
    }

    #[inline]
    fn potential(&self, s: T) -> T {
        let s2 = s * s;
        T::constant(0.5) * s2 * s2 * s - self.adhesion.energy(s) - self.force.energy(s)
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        let s2 = s * s;
        T::constant(2.5) * s2 * s2 - self.adhesion.slope(s) - self.force.slope(s)
    }

    #[inline]
    fn curvature(&self, s: T) -> T {
        T::constant(10.0) * s * s * s - self.adhesion.curvature(s) - self.force.curvature(s)
    }

    #[inline]
    fn mean_slope(&self, p: T, s: T) -> T {
        let (p2, s2, product) = (p * p, s * s, p * s);
        let elastic = T::constant(0.5) * (p2 * p2 + s2 * s2 + product * (p2 + product + s2));
        elastic - self.adhesion.mean_slope(p, s) - self.force.mean_slope(p, s)
    }

    #[inline]
    fn material_damping(&self, s: T) -> T {
        self.damping.rate() * self.elastic_force(s)
    }

    #[inline]
    fn adhesion_damping(&self, s: T) -> T {
        self.adhesion.damping(s)
    }

    #[inline]
    fn adhesion_damping_rate(&self) -> T {
        self.adhesion.damping_rate()
    }

    #[inline]
    fn potential_drop(&self, peak: T, fraction: &Fraction<T>) -> T {
        let square = peak * peak;
        let elastic = T::constant(0.5) * square * square * peak * fraction.quintic;
        elastic - self.adhesion.energy_drop(peak, fraction) - self.force.energy_drop(peak, fraction)
    }

    #[inline]
    fn loss_over_square(&self, peak: T, fraction: &Fraction<T>, rebound: bool) -> T {
        let square = peak * peak;
        let material = T::constant(2.5) * self.damping.rate() * square * square * fraction.square;
        if rebound { material + self.adhesion.loss_over_square(peak, fraction) } else { material }
    }

    #[inline]
    fn elastic_force(&self, s: T) -> T {
        T::constant(1.25) * s * s * s
    }

    #[inline]
    fn adhesion_force(&self, s: T) -> T {
        self.adhesion.force(s)
    }

    #[inline]
    fn conservative_force(&self, s: T) -> T {
        self.adhesion_force(s) + self.force.force(s) - self.elastic_force(s)
    }

    /// The speed at which Hertz's peak indentation is 5/3 of the equilibrium one.
    fn speed_of_adhesion(&self, sphere: &Sphere<T>) -> T {
        let depth = self.adhesion.equilibrium(self.stiffness) / sphere.radius();
        if depth <= T::ZERO {
            return T::ONE;
        }
        // The units of an impact, solved for the speed.
        let depth = T::constant(5.0 / 3.0 / HERTZ_PEAK) * depth;
        let rate = T::constant(4.0 * PI / 3.0) * sphere.density() / self.stiffness;
        depth * depth.sqrt().sqrt() / rate.sqrt()
    }
}

/// Peak under an external force, in units of the peak without it, from which it becomes the unit. A force that leaves less
/// outweighs the elastic one so far that its ratio could not be represented.
const LEAST_PEAK: f64 = 0.1;

/// The units of one impact in Hertz's contact, and what terms of the law are in them.
///
/// The unit of length is the peak indentation L of the undamped motion. The unit of speed U is such that the elastic force
/// becomes (5/4) s^3, with the contact radius in units of sqrt(r L). Then 0 <= s <= 1 and |y| <= 1, whatever the particle.
/// Without an external force 2 E = 1 - p before the impact, where p < 1 is the strength of adhesion: its force is (3/4) p s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HertzUnits<T> {
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

impl<T: Real> HertzUnits<T> {
    /// Units for a sphere that arrives with `approach` (m/s) at a contact of equilibrium indentation `equilibrium` (m).
    fn new(sphere: &Sphere<T>, stiffness: T, equilibrium: T, approach: T) -> Result<Self, InputError> {
        // w = v sqrt(m/(r^3 K)), where m/r^3 = 4 pi density/3: no product here leaves the range of single precision.
        let w = approach * (T::constant(4.0 * PI / 3.0) * sphere.density() / stiffness).sqrt();
        let root = w.two_fifths_power();
        // C v, with C of B4: (m/(r^3 K))^(2/5) v^(4/5).
        let damping = root * root;
        // delta_Hertz = (5/4)^(2/5) r w^(4/5).
        let hertz = T::constant(HERTZ_PEAK) * damping * sphere.radius();
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

    /// The same impact in units of a contact radius that is larger by this factor.
    fn enlarged(&self, factor: T) -> Self {
        let area = factor * factor;
        let growth = area * factor.sqrt();
        Self {
            length: self.length * area,
            speed: self.speed * growth,
            adhesion: self.adhesion / area,
            energy: self.energy / growth / growth,
            damping: self.damping * growth,
        }
    }
}

/// Contact radius of Hertz's peak over that of the undamped one, the root b of b^5 + p b^2 = 1; and b^5/2, the energy
/// before the impact, which is exact to fewer roundings than a fifth power of b has.
fn inverse_peak_contact_radius<T: Real>(p: T) -> (T, T) {
    let (two, five) = (T::constant(2.0), T::constant(5.0));
    let ratio = T::ONE + p * (T::constant(PEAK_RATIO.0) + T::constant(PEAK_RATIO.1) * p);
    let mut b = (ratio / (p * ratio + T::ONE)).sqrt();
    let mut fifth = T::ONE;
    for _ in 0..PEAK_STEPS {
        let square = b * b;
        let pull = p * square;
        fifth = square * square * b;
        let excess = (pull - T::ONE + fifth) / (five * fifth + two * pull);
        b = b - b * excess;
        fifth = fifth - five * fifth * excess;
        if excess * excess <= T::constant(PEAK_ACCURACY) * T::EPSILON {
            break;
        }
    }
    (b, T::constant(0.5) * fifth)
}

/// The dimensionless groups of an impact, on which its normal motion depends.
///
/// With the peak indentation L of the undamped motion for a unit of length and its largest speed U for one of speed, the
/// elastic force is A s^3 and adhesion B s at the contact radius s, both over m U^2/L; h = c_H U and g = c_A U.
///
/// ```
/// use microimpact::contact::Contact;
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
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
