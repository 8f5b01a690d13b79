//! Coulomb's friction with a moment that slows the spin.

use super::coulomb::surface_motion;
use super::{SlipStart, Surface, TangentialMotion, TangentialVelocities};
use crate::contact::law::{ContactLaw, Units};
use crate::contact::solve::path::{End, NormalPath};
use crate::rolling::rolling;
use crate::terms::ElasticForce;
use crate::{Coulomb, InputError, Parameter, Planar, Real, Sphere};

/// Coulomb's friction and the peeling moment g = -lambda c_A a theta' against the spin (B10).
///
/// The moment is proportional to the damping c_A of a ring of adhesion: only scenes with a ring have one.
///
/// ```
/// use microimpact::{Coulomb, contact::Peeling};
///
/// assert!(Peeling::new(Coulomb::new(0.1)?, 2e-12).is_ok());
/// assert!(Peeling::new(Coulomb::new(0.1)?, -2e-12).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Peeling<T> {
    friction: Coulomb<T>,
    lambda: T,
}

impl<T: Real> Peeling<T> {
    /// Friction with a moment of strength lambda >= 0, N m.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::{Coulomb, contact::Peeling};
    ///
    /// assert!(Peeling::new(Coulomb::new(0.1)?, f64::NAN).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(friction: Coulomb<T>, lambda: T) -> Result<Self, InputError> {
        Ok(Self { friction, lambda: Parameter::PeelingMoment.check(lambda)? })
    }
}

#[diagnostic::do_not_recommend]
impl<T: Real, B: Planar<T>> Surface<T, B> for Peeling<T> {
    type Start = SlipStart<T, ElasticForce, true>;
    type Observer = TangentialMotion<T, ElasticForce, true>;
    type After = TangentialVelocities<T>;

    fn start<L: ContactLaw<T>>(
        &self,
        before: &B,
        sphere: &Sphere<T>,
        law: &L,
        units: &Units<T>,
    ) -> Result<Self::Start, InputError> {
        // lambda c_A a/(kappa m r^2) at a = sqrt(r L), for a time L/U.
        let inertia = sphere.gyration_ratio() * sphere.mass();
        let decay = self.lambda / inertia / units.speed * (law.adhesion_damping_rate() / units.speed);
        let depth = units.length / sphere.radius();
        let rate = Parameter::DampingRatio.check(decay * depth * depth.sqrt())?;
        Ok(SlipStart::new(&self.friction, before, sphere, units, rate))
    }

    fn observer(start: &Self::Start) -> TangentialMotion<T, ElasticForce, true> {
        TangentialMotion::new(start)
    }

    fn after(
        observer: &TangentialMotion<T, ElasticForce, true>,
        path: &NormalPath<T>,
        sphere: &Sphere<T>,
        units: &Units<T>,
    ) -> TangentialVelocities<T> {
        let captured = path.end == End::Capture;
        let (mut velocity, mut peripheral) = (observer.velocity, observer.peripheral);
        let sliding = observer.slides() && !(captured && observer.friction > T::ZERO);
        if observer.slides() && !sliding {
            velocity = rolling(velocity, peripheral, observer.gyration_ratio);
            peripheral = velocity;
        }
        TangentialVelocities {
            motion: surface_motion(sliding, captured && velocity.abs() <= observer.rounding),
            velocity: velocity * units.speed,
            spin: peripheral * units.speed / sphere.radius(),
            sliding_friction: T::ZERO,
            rolling_friction: T::ZERO,
        }
    }
}
