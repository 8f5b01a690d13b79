//! Hertz's elastic contact, alone or with adhesion and an external force that leave its profile as it is.
//!
//! In units of an impact the elastic force is (5/4) s^3 at the contact radius s, the indentation s^2, and the potential
//! V = s^5/2 less what adhesion and the external force give.

use core::f64::consts::PI;

use super::{
    ConstantDamping, ConstantForce, ContactLaw, Damping, Dmt, Fraction, HystereticDamping, NoDamping, NoForce,
    NoTension, ProportionalDamping, Ring, RingStrength, ViscoelasticDamping,
};
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

    /// Whether the force moves the peak of the undamped motion from where elasticity and a ring have it.
    #[inline]
    fn moves_peak(&self) -> bool {
        true
    }

    /// Whether there is no such force, and contact lasts to zero indentation.
    #[inline]
    fn is_absent(&self) -> bool {
        false
    }

    /// Equilibrium indentation that adhesion alone would give the sphere, m.
    #[inline]
    fn equilibrium(&self, _sphere: &Sphere<T>, _stiffness: T) -> T {
        T::ZERO
    }

    /// Whether contact ends where the force of the contact vanishes, before it pulls.
    #[inline]
    fn ends_without_force(&self) -> bool {
        false
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
    fn is_absent(&self) -> bool {
        true
    }

    #[inline]
    fn moves_peak(&self) -> bool {
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

impl<T: Real, D> HertzLaw<T, D> {
    /// The same law with an end of contact where damping cancels the elastic force, and not at zero indentation.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, HertzLaw};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let law = HertzLaw::new(Stiffness::new(1e9)?).with_constant_damping(0.5)?;
    /// let (sphere, motion) = (Sphere::solid(1e-3, 1000.0)?, NormalMotion::new(1.0)?);
    /// let method = Adaptive::new(1e-9)?;
    /// let e = Contact::new(sphere, law).solve(&motion, &method)?.normal.overall_restitution();
    /// assert!((e - 0.5_f64).abs() < 1e-9);
    /// let e = Contact::new(sphere, law.without_tension()).solve(&motion, &method)?.normal.overall_restitution();
    /// assert!((e - 0.550_283_169_6).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn without_tension(self) -> HertzLaw<T, D, NoTension> {
        let Self { stiffness, damping, force, .. } = self;
        HertzLaw { stiffness, damping, adhesion: NoTension, force }
    }
}

impl<T: Real, D, A, X> HertzLaw<T, D, A, X> {
    pub(super) fn damped<E>(self, damping: E) -> HertzLaw<T, E, A, X> {
        let Self { stiffness, adhesion, force, .. } = self;
        HertzLaw { stiffness, damping, adhesion, force }
    }

    /// The same law with hysteretic damping of strength zeta_H >= 0 in the materials. [`HystereticDamping`] says how zeta_H
    /// relates to a damping constant in s/m.
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
        Ok(self.damped(HystereticDamping::new(zeta)?))
    }

    /// The same law with viscoelastic damping of the relaxation time A >= 0, s.
    ///
    /// # Errors
    /// A time outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert!(HertzLaw::new(Stiffness::new(1e10)?).with_viscoelastic_damping(-1e-9).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_viscoelastic_damping(self, time: T) -> Result<HertzLaw<T, ViscoelasticDamping<T>, A, X>, InputError> {
        Ok(self.damped(ViscoelasticDamping::new(time)?))
    }

    /// The same law with damping that leaves a restitution e at every speed.
    ///
    /// # Errors
    /// A restitution outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert!(HertzLaw::new(Stiffness::new(1e10)?).with_constant_damping(0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_constant_damping(self, restitution: T) -> Result<HertzLaw<T, ConstantDamping<T>, A, X>, InputError> {
        Ok(self.damped(ConstantDamping::new(restitution)?))
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

    /// The same law with the adhesion of Derjaguin, Muller and Toporov, of a work of adhesion G >= 0, J/m^2.
    ///
    /// # Errors
    /// A work outside its range.
    ///
    /// ```
    /// use microimpact::{Stiffness, contact::HertzLaw};
    ///
    /// assert!(HertzLaw::new(Stiffness::new(1e10)?).with_dmt(-0.1).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_dmt(self, work: T) -> Result<HertzLaw<T, D, Dmt<T>, X>, InputError> {
        let Self { stiffness, damping, force, .. } = self;
        Ok(HertzLaw { stiffness, damping, adhesion: Dmt::new(work)?, force })
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
            damping: self.damping.in_units(units)?,
            adhesion: self.adhesion.in_units(sphere, units)?,
            force: self.force.in_units(sphere, units)?,
        })
    }

    /// Refuses adhesion and damping, in units of an impact, that fixed point does not hold.
    pub(crate) fn fits_fixed_point(&self) -> Result<(), InputError> {
        let energy = self.adhesion.energy(T::ONE);
        Parameter::DimensionlessAdhesion.check(energy + energy)?;
        // At the peak, where the elastic force is 5/4.
        let force = self.damping.force(T::constant(1.25), T::ONE, T::ONE);
        Parameter::DimensionlessDamping.check(T::constant(0.8) * force)?;
        Parameter::DimensionlessDamping.check(self.adhesion.damping_rate())?;
        Ok(())
    }

    /// The contact radius at a coordinate, which is that radius or, where the damping needs it, the root of it.
    #[inline]
    fn radius(&self, s: T) -> T {
        if self.damping.needs_root() { s * s } else { s }
    }

    /// Rate of change of the potential with the contact radius.
    #[inline]
    fn radial_slope(&self, a: T) -> T {
        let a2 = a * a;
        T::constant(2.5) * a2 * a2 - self.adhesion.slope(a) - self.force.slope(a)
    }

    /// A rate of change with the coordinate, from that with the contact radius.
    #[inline]
    fn along(&self, s: T, radial: T) -> T {
        if self.damping.needs_root() { radial * (s + s) } else { radial }
    }
}

impl<T: Real, D: ProportionalDamping<T>, A: RingStrength<T>, X: Attraction<T>> HertzLaw<T, D, A, X> {
    /// The dimensionless groups of this law in units of an impact of the kinetic energy `energy`.
    pub(crate) fn groups(&self, energy: T) -> Groups<T> {
        // The undamped motion is fastest at s^2 = (3/5) p, where V = -(1/5) (3/5)^(3/2) p^(5/2).
        let p = self.adhesion.strength();
        let fastest = energy + energy + T::constant(0.4 * 0.464_758_001_544_890_1) * p * p * p.sqrt();
        let speed = fastest.sqrt();
        Groups {
            elasticity: T::constant(1.25) / fastest,
            adhesion: T::constant(0.75) * p / fastest,
            material_damping: self.damping.rate() * speed,
            adhesion_damping: self.adhesion.damping_rate() * speed,
        }
    }
}

/// Coordinate at which the undamped motion turns, beyond a coordinate `from` that is no nearer than the bottom of the potential;
/// `None` where a force turns it back before.
pub(super) fn undamped_peak<T: Real>(law: &impl ContactLaw<T>, from: T, energy: T) -> Option<T> {
    let mut peak = from;
    for _ in 0..PEAK_SEARCH {
        let potential = law.potential(peak);
        if !energy.any_above(potential) {
            break;
        }
        peak = energy.where_above(potential, peak * T::constant(PEAK_GROWTH), peak);
    }
    // From above Newton's method comes down without passing the root, as the potential is convex there. In lanes, those that have
    // converged wait for the others.
    let (mut change, mut enough) = (T::ONE, T::ZERO);
    for _ in 0..PEAK_SEARCH {
        if !change.any_above(enough) {
            break;
        }
        let slope = law.slope(peak);
        if slope <= T::ZERO {
            return None;
        }
        let step = (law.potential(peak) - energy) / slope;
        let next = peak - step;
        let open = |new: T, old: T| change.where_above(enough, new, old);
        let rounding = T::constant(PEAK_ROUNDING) * T::EPSILON * next;
        (peak, change, enough) = (open(next, peak), open(step.abs(), change), open(rounding, enough));
    }
    Some(peak)
}

impl<T: Real, D: Damping<T>, A: Attraction<T>, X: Attraction<T>> ContactLaw<T> for HertzLaw<T, D, A, X> {
    #[inline]
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError> {
        let in_peak =
            if self.adhesion.moves_peak() { T::ZERO } else { self.adhesion.equilibrium(sphere, self.stiffness) };
        let mut units = HertzUnits::new(sphere, self.stiffness, in_peak, approach)?;
        let mut law = self.in_hertz_units(sphere, &units)?;
        if self.adhesion.moves_peak() || self.force.moves_peak() {
            let peak = undamped_peak(&law, T::ONE, units.energy).map(|peak| self.radius(peak));
            if let Some(peak) = peak.filter(|peak| *peak > T::constant(LEAST_PEAK)) {
                let enlarged = units.enlarged(peak);
                // Damping that is out of range in larger units stays in those of the impact without the force.
                if let Ok(in_enlarged) = self.in_hertz_units(sphere, &enlarged) {
                    (units, law) = (enlarged, in_enlarged);
                }
            }
        }
        if T::IS_FIXED_POINT {
            Parameter::ContactSpeedInUnits.check(approach)?;
            law.fits_fixed_point()?;
        }
        Ok((law, units.units()))
    }

    #[inline]
    fn loss_power(&self) -> u32 {
        // Hysteretic damping goes with s^4, a viscoelastic material and a ring with s^2, and constant damping with s^4 of its root.
        if self.adhesion.ends_without_force() { 0 } else { 2 }
    }

    #[inline]
    fn external_force(&self) -> T {
        self.force.force(T::ZERO)
    }

    #[inline]
    fn may_have_barrier(&self) -> bool {
        self.force.moves_peak()
    }

    #[inline]
    fn admits_compliance(&self) -> bool {
        self.damping.is_proportional() && self.adhesion.is_absent() && self.force.is_absent()
    }

    #[inline]
    fn potential(&self, s: T) -> T {
        let a = self.radius(s);
        let a2 = a * a;
        T::constant(0.5) * a2 * a2 * a - self.adhesion.energy(a) - self.force.energy(a)
    }

    #[inline]
    fn slope(&self, s: T) -> T {
        self.along(s, self.radial_slope(self.radius(s)))
    }

    #[inline]
    fn curvature(&self, s: T) -> T {
        let a = self.radius(s);
        let curvature = T::constant(10.0) * a * a * a - self.adhesion.curvature(a) - self.force.curvature(a);
        if self.damping.needs_root() {
            return self.along(s, self.along(s, curvature)) + T::constant(2.0) * self.radial_slope(a);
        }
        curvature
    }

    #[inline]
    fn mean_slope(&self, p: T, s: T) -> T {
        let (to, from) = (self.radius(p), self.radius(s));
        let (p2, s2, product) = (to * to, from * from, to * from);
        let elastic = T::constant(0.5) * (p2 * p2 + s2 * s2 + product * (p2 + product + s2));
        let mean = elastic - self.adhesion.mean_slope(to, from) - self.force.mean_slope(to, from);
        if self.damping.needs_root() { mean * (p + s) } else { mean }
    }

    #[inline]
    fn material_damping(&self, s: T) -> T {
        self.damping.force(self.elastic_force(s), self.radius(s), s)
    }

    #[inline]
    fn adhesion_damping(&self, s: T) -> T {
        self.adhesion.damping(self.radius(s))
    }

    #[inline]
    fn adhesion_damping_rate(&self) -> T {
        self.adhesion.damping_rate()
    }

    #[inline]
    fn indentation(&self, s: T) -> T {
        let a = self.radius(s);
        a * a
    }

    #[inline]
    fn indentation_slope(&self, s: T) -> T {
        let a = self.radius(s);
        self.along(s, a + a)
    }

    #[inline]
    fn coordinate(&self, indentation: T) -> Option<T> {
        let radius = indentation.max(T::ZERO).sqrt();
        Some(if self.damping.needs_root() { radius.sqrt() } else { radius })
    }

    #[inline]
    fn contact_radius(&self, s: T) -> T {
        self.radius(s)
    }

    #[inline]
    fn energy_power(&self) -> f64 {
        if self.damping.needs_root() { 10.0 } else { 5.0 }
    }

    #[inline]
    fn release_speed(&self, s: T) -> Option<T> {
        self.adhesion.ends_without_force().then(|| self.damping.release_speed(self.radius(s), s))
    }

    #[inline]
    fn potential_drop(&self, peak: T, fraction: &Fraction<T>) -> T {
        if self.damping.needs_root() {
            return peak * self.mean_slope(peak, peak * fraction.value);
        }
        let square = peak * peak;
        let elastic = T::constant(0.5) * square * square * peak * fraction.quintic;
        elastic - self.adhesion.energy_drop(peak, fraction) - self.force.energy_drop(peak, fraction)
    }

    #[inline]
    fn loss_over_square(&self, peak: T, fraction: &Fraction<T>, rebound: bool) -> T {
        if self.damping.needs_root() {
            return self.loss(peak * fraction.value, rebound) / fraction.square;
        }
        let material = self.damping.loss_over_square(peak, fraction);
        if rebound { material + self.adhesion.loss_over_square(peak, fraction) } else { material }
    }

    #[inline]
    fn elastic_force(&self, s: T) -> T {
        let a = self.radius(s);
        T::constant(1.25) * a * a * a
    }

    #[inline]
    fn adhesion_force(&self, s: T) -> T {
        self.adhesion.force(self.radius(s))
    }

    #[inline]
    fn conservative_force(&self, s: T) -> T {
        self.adhesion_force(s) + self.force.force(self.radius(s)) - self.elastic_force(s)
    }

    /// The speed at which Hertz's peak indentation is 5/3 of the equilibrium one.
    fn speed_of_adhesion(&self, sphere: &Sphere<T>) -> T {
        let depth = self.adhesion.equilibrium(sphere, self.stiffness) / sphere.radius();
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
    pub(super) fn new(sphere: &Sphere<T>, stiffness: T, equilibrium: T, approach: T) -> Result<Self, InputError> {
        let damping = unit_damping(sphere, stiffness, approach);
        // delta_Hertz = (5/4)^(2/5) r C v.
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

    /// As a scene has them.
    pub(super) fn units(&self) -> Units<T> {
        Units { length: self.length, speed: self.speed, energy: self.energy }
    }

    /// A force (N) on the sphere in units of the impact.
    pub(super) fn force(&self, force: T, sphere: &Sphere<T>) -> T {
        let acceleration = force / sphere.mass();
        acceleration / self.speed * (self.length / self.speed)
    }

    /// The same impact in units of a contact radius that is larger by this factor.
    pub(super) fn enlarged(&self, factor: T) -> Self {
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

/// The damping C v of strength zeta = 1 (B4), with C v = (m v^2/(r^3 K))^(2/5).
pub(crate) fn unit_damping<T: Real>(sphere: &Sphere<T>, stiffness: T, approach: T) -> T {
    // m/r^3 = 4 pi density/3: no product here leaves the range of single precision.
    let w = approach * (T::constant(4.0 * PI / 3.0) * sphere.density() / stiffness).sqrt();
    let root = w.two_fifths_power();
    root * root
}

/// Contact radius of Hertz's peak over that of the undamped one, the root b of b^5 + p b^2 = 1; and b^5/2, the energy
/// before the impact, which is exact to fewer roundings than a fifth power of b has.
fn inverse_peak_contact_radius<T: Real>(p: T) -> (T, T) {
    let (two, five) = (T::constant(2.0), T::constant(5.0));
    let ratio = T::ONE + p * (T::constant(PEAK_RATIO.0) + T::constant(PEAK_RATIO.1) * p);
    let mut b = (ratio / (p * ratio + T::ONE)).sqrt();
    let mut fifth = T::ONE;
    // Square of the last step. In lanes, those that have converged wait for the others.
    let (mut error, enough) = (T::ONE, T::constant(PEAK_ACCURACY) * T::EPSILON);
    for _ in 0..PEAK_STEPS {
        if !error.any_above(enough) {
            break;
        }
        let square = b * b;
        let pull = p * square;
        let power = square * square * b;
        let excess = (pull - T::ONE + power) / (five * power + two * pull);
        b = error.where_above(enough, b - b * excess, b);
        fifth = error.where_above(enough, power - five * power * excess, fifth);
        error = error.where_above(enough, excess * excess, error);
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
