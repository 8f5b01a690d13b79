//! Laws of contact: the normal force as a function of one coordinate, one law a file.

mod chosen;
mod damping;
mod dmt;
mod force;
mod fraction;
mod hertz;
mod jkr;
mod ring;
mod tension;

pub use chosen::{AnyDamping, AnyForce, AnyLaw};
pub use damping::{ConstantDamping, Damping, HystereticDamping, NoDamping, ProportionalDamping, ViscoelasticDamping};
pub use dmt::Dmt;
pub use force::{ConstantForce, NoForce};
pub use fraction::Fraction;
#[cfg(feature = "fixed")]
pub(crate) use hertz::unit_damping;
pub use hertz::{Attraction, Groups, HertzLaw};
pub use jkr::{JkrEnd, JkrLaw};
pub use ring::{Ring, RingStrength};
pub use tension::NoTension;

pub use crate::contact::units::Units;
use crate::{InputError, Real, Sphere};

/// A law of contact: the forces between sphere and surface along the normal, and the energy that damping dissipates.
///
/// A scene holds a law in SI units. For each impact, [`in_units`](Self::in_units) gives the same law with its numbers in
/// units of that impact, and the solver calls all other functions on the result. In those units the mass is one and the
/// undamped motion, adhesion and other forces included, turns at s = 1. Speeds are then about one at most, and no product
/// leaves the range of `f32`. [`FixedCost`](crate::contact::FixedCost) starts from s = 1 and relies on it. The other methods
/// search for the turning point; with units that are several times too small or too large they only take longer.
///
/// The *coordinate* s is the contact radius or a root of it. It is chosen such that indentation, potential and losses are
/// smooth functions of it, polynomials in most cases, even where contact begins and ends. The normal motion is then the
/// path y^2/2 = E - V(s), along which only the losses change the energy E (y is the size of the normal velocity).
///
/// To write a law of your own, implement the functions without a default. Forces of adhesion and damping are positive
/// numbers. The potential contains the elastic force and adhesion, but no damping. Where the indentation is not x = s^2,
/// implement [`indentation`](Self::indentation), [`indentation_slope`](Self::indentation_slope),
/// [`coordinate`](Self::coordinate), [`conservative_force`](Self::conservative_force),
/// [`contact_radius`](Self::contact_radius), [`energy_power`](Self::energy_power) and [`duration`](Self::duration) too. The solver cannot check that
/// these functions agree: test yours by comparing [`slope`](Self::slope) and [`mean_slope`](Self::mean_slope) with
/// differences of [`potential`](Self::potential), or the results of two methods with each other.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, ContactLaw, Times, Units};
/// use microimpact::{InputError, NormalMotion, Sphere};
///
/// /// A linear spring (N/m) with a dashpot (N s/m). The coordinate is the root of the indentation, so that x = s^2.
/// #[derive(Clone, Copy)]
/// struct SpringAndDashpot {
///     spring: f64,
///     dashpot: f64,
/// }
///
/// impl ContactLaw<f64> for SpringAndDashpot {
///     fn in_units(&self, sphere: &Sphere<f64>, approach: f64) -> Result<(Self, Units<f64>), InputError> {
///         // Without damping the sphere turns at v sqrt(m/k). With that as the unit of length and v as the unit of speed
///         // the spring is one, and the kinetic energy before the impact one half.
///         let frequency = (self.spring / sphere.mass()).sqrt();
///         let dashpot = self.dashpot / sphere.mass() / frequency;
///         let units = Units { length: approach / frequency, speed: approach, energy: 0.5 };
///         Ok((Self { spring: 1.0, dashpot }, units))
///     }
///     fn loss_power(&self) -> u32 {
///         1 // c dx/ds = 2 c s
///     }
///     fn potential(&self, s: f64) -> f64 {
///         self.spring * s.powi(4) / 2.0
///     }
///     fn slope(&self, s: f64) -> f64 {
///         2.0 * self.spring * s.powi(3)
///     }
///     fn curvature(&self, s: f64) -> f64 {
///         6.0 * self.spring * s * s
///     }
///     fn mean_slope(&self, p: f64, s: f64) -> f64 {
///         self.spring * (p + s) * (p * p + s * s) / 2.0
///     }
///     fn elastic_force(&self, s: f64) -> f64 {
///         self.spring * s * s
///     }
///     fn material_damping(&self, _s: f64) -> f64 {
///         self.dashpot
///     }
/// }
///
/// // A dashpot of half the critical strength 2 sqrt(k m). At zero indentation e = exp(-pi/sqrt(3)).
/// let sphere = Sphere::solid(1e-3, 1000.0)?;
/// let spring = 1e3;
/// let law = SpringAndDashpot { spring, dashpot: (spring * sphere.mass()).sqrt() };
/// let scene = Contact::new(sphere, law);
/// let (impact, times) = scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9)?, Times)?;
/// let e = (-core::f64::consts::PI / 3f64.sqrt()).exp();
/// assert!((impact.normal.overall_restitution() - e).abs() < 1e-8);
/// let period = core::f64::consts::PI * (sphere.mass() / spring / 0.75).sqrt();
/// assert!((times.contact.unwrap() / period - 1.0).abs() < 1e-7);
/// # Ok::<(), InputError>(())
/// ```
pub trait ContactLaw<T: Real>: Copy {
    /// The law with its numbers in units of the impact of `sphere` at the speed `approach` (m/s), and those units.
    ///
    /// # Errors
    /// A ratio of forces that cannot be represented.
    fn in_units(&self, sphere: &Sphere<T>, approach: T) -> Result<(Self, Units<T>), InputError>;

    /// The lowest power of s in the losses c(s) dx/ds, over all that damps on the way in or out.
    ///
    /// [`FixedCost`](crate::contact::FixedCost), which solves a whole phase as one polynomial, needs losses of power two or
    /// higher, and contacts that begin and end at s = 0. For other laws it returns
    /// [`Status::Unsupported`](crate::contact::Status::Unsupported). A law without damping returns any power from two on; a
    /// law whose contact begins or ends elsewhere returns zero.
    fn loss_power(&self) -> u32;

    /// Potential energy V, zero where contact ends. The sphere arrives at [`start`](Self::start) with the kinetic energy
    /// [`Units::energy`], whatever V is there.
    fn potential(&self, s: T) -> T;

    /// dV/ds.
    fn slope(&self, s: T) -> T;

    /// d^2V/ds^2.
    fn curvature(&self, s: T) -> T;

    /// The mean slope (V(p) - V(s))/(p - s), in a form that does not cancel where p and s are close.
    fn mean_slope(&self, p: T, s: T) -> T;

    /// The elastic force, to which Coulomb's friction is proportional (B8).
    fn elastic_force(&self, s: T) -> T;

    /// Damping force of the materials for each unit of speed, on the way in and out; none unless given.
    #[inline]
    fn material_damping(&self, _s: T) -> T {
        T::ZERO
    }

    /// Force of adhesion without its damping, of which the adhesive impulse is the integral; none unless given.
    #[inline]
    fn adhesion_force(&self, _s: T) -> T {
        T::ZERO
    }

    /// Damping force of adhesion for each unit of speed, on the way out; none unless given.
    #[inline]
    fn adhesion_damping(&self, _s: T) -> T {
        T::ZERO
    }

    /// Fraction of the force of adhesion that its damping adds for each unit of speed, to which the peeling moment is
    /// proportional (B10).
    #[inline]
    fn adhesion_damping_rate(&self) -> T {
        T::ZERO
    }

    /// Indentation x; s^2 unless given.
    #[inline]
    fn indentation(&self, s: T) -> T {
        s * s
    }

    /// dx/ds; 2 s unless given.
    #[inline]
    fn indentation_slope(&self, s: T) -> T {
        s + s
    }

    /// The coordinate of an indentation, `None` where the indentation does not determine it.
    ///
    /// Only [`RungeKuttaGill`](crate::contact::RungeKuttaGill) needs it, which integrates in time.
    #[inline]
    fn coordinate(&self, indentation: T) -> Option<T> {
        Some(indentation.max(T::ZERO).sqrt())
    }

    /// The coordinate of an indentation at which there is contact, the outer one of two; `None` where there is none.
    ///
    /// Only [`ContactForce`](crate::contact::ContactForce) needs it.
    #[inline]
    fn coordinate_in_contact(&self, indentation: T) -> Option<T> {
        if indentation < T::ZERO { None } else { self.coordinate(indentation) }
    }

    /// Contact radius in units of sqrt(r L), with the sphere's radius r and the unit of length L.
    #[inline]
    fn contact_radius(&self, s: T) -> T {
        s
    }

    /// Coordinate of first contact.
    #[inline]
    fn start(&self) -> T {
        T::ZERO
    }

    /// Coordinate at which contact ends on the way out.
    #[inline]
    fn end(&self) -> T {
        T::ZERO
    }

    /// Outward speed at which contact ends at s, before [`end`](Self::end), for a law that ends so: the damping cancels the elastic
    /// force there. Such a law has no adhesion. `None` unless given.
    #[inline]
    fn release_speed(&self, _s: T) -> Option<T> {
        None
    }

    /// External force, N. Called on the law in SI units: two bodies that meet are refused if one acts, which it does on one of them.
    #[inline]
    fn external_force(&self) -> T {
        T::ZERO
    }

    /// Whether a maximum of the potential may lie between the end of contact and the peak, as under a force out of the
    /// surface. A law that returns `false` saves the search for it.
    #[inline]
    fn may_have_barrier(&self) -> bool {
        true
    }

    /// Whether [`Compliance`](crate::contact::Compliance) along the surface goes with this law: Hertz's force alone, with the contact
    /// radius for coordinate, and a damping in proportion to it or none. `false` unless given.
    #[inline]
    fn admits_compliance(&self) -> bool {
        false
    }

    /// The power of s to which the elastic energy is proportional: 5 for Hertz's with x = s^2. Adaptive and FixedCost estimate
    /// the peak with it and may need more iterations if it is wrong.
    #[inline]
    fn energy_power(&self) -> f64 {
        5.0
    }

    /// A speed (m/s) of the order of the critical speed, from which the search for it starts. Called on the law in SI units.
    #[inline]
    fn speed_of_adhesion(&self, _sphere: &Sphere<T>) -> T {
        T::ONE
    }

    /// Approximate duration of a contact without damping and adhesion, for a kinetic energy before the impact; Hertz's unless
    /// given. The step of [`RungeKuttaGill`](crate::contact::RungeKuttaGill) is a fraction of it.
    #[inline]
    fn duration(&self, energy: T) -> T {
        let square = energy + energy;
        T::constant(hertz::HERTZ_DURATION) * square.two_fifths_power() / square.sqrt()
    }

    /// Force of the potential, -dV/dx. A law with another indentation than s^2 has to give the limit where its slope is zero.
    #[inline]
    fn conservative_force(&self, s: T) -> T {
        let slope = self.indentation_slope(s);
        // The limit where x = s^2 at s = 0.
        if slope == T::ZERO { -(self.curvature(s) / T::constant(2.0)) } else { -(self.slope(s) / slope) }
    }

    /// Damping force of both kinds for each unit of speed, on the way in or out.
    #[inline]
    fn damping(&self, s: T, rebound: bool) -> T {
        if rebound { self.material_damping(s) + self.adhesion_damping(s) } else { self.material_damping(s) }
    }

    /// Energy that damping dissipates, per unit of s and per unit of speed.
    #[inline]
    fn loss(&self, s: T, rebound: bool) -> T {
        self.indentation_slope(s) * self.damping(s, rebound)
    }

    /// The potential drop from the peak to a fraction m of its coordinate, over 1 - m.
    #[inline]
    fn potential_drop(&self, peak: T, fraction: &Fraction<T>) -> T {
        peak * self.mean_slope(peak, peak * fraction.value)
    }

    /// [`loss`](Self::loss) at a fraction m > 0 of the peak, over m^2.
    #[inline]
    fn loss_over_square(&self, peak: T, fraction: &Fraction<T>, rebound: bool) -> T {
        self.loss(peak * fraction.value, rebound) / fraction.square
    }
}
