//! The rigid-body model in fixed point.

use core::f64::consts::PI;

use super::FixedPoint;
use crate::rigid::{AdhesionCoefficient, WorkOfAdhesion};
use crate::{
    ConstantRestitution, Coulomb, InputError, NoAdhesion, NoFriction, NormalMotion, ObliqueMotion, Parameter,
    PlanarMotion, Real, RigidBody, SpeedRestitution, Sphere,
};

/// A scene, a term or a motion that can be converted to fixed point.
///
/// A scene and its motions must have the same unit of speed U, which you choose near the speeds that occur. Classes, margins and
/// coefficients have no unit, and a margin above 128 becomes 128. Numbers of the result are in these units, with the sphere's mass m and
/// radius r:
///
/// | quantity | unit |
/// | --- | --- |
/// | velocity; spin | U; U/r |
/// | length along the normal L, time | r (m U^2/(r^3 K))^(2/5); L/U |
/// | impulse; work, energy | m U; m U^2 |
///
/// ```
/// use microimpact::{Class, InFixedPoint, NormalMotion, RigidBody, Sphere, SpeedRestitution};
///
/// let sphere = Sphere::solid(5.06e-6_f32, 2600.0)?;
/// let scene = RigidBody::new(sphere, SpeedRestitution::new(130.0)?)
///     .with_work_of_adhesion(2.22e-12)?
///     .with_friction(0.1)?;
/// let motion = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.46e5)?;
///
/// // The set-up uses floating point. The classification uses integers only.
/// let unit = 4.0;
/// let (scene, motion) = (scene.in_fixed_point(unit)?, motion.in_fixed_point(unit)?);
/// let result = scene.classify(&motion);
/// assert_eq!(result.class(), Class::ReboundRolling);
/// assert!(result.speed_over_critical.is_some_and(|margin| (margin.to_f64() - 1.557).abs() < 0.001));
/// let rebound = scene.impact(&motion).normal.rebound_speed();
/// assert!((4.0 * rebound.to_f64() - 2.09).abs() < 0.005);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait InFixedPoint<T> {
    /// The converted type.
    type Fixed;

    /// Converts this to fixed point, with a `unit` of speed in m/s.
    ///
    /// # Errors
    /// The unit is outside its range, or a value in this unit is outside its range for [`FixedPoint`].
    ///
    /// ```
    /// use microimpact::{InFixedPoint, NormalMotion, Parameter};
    ///
    /// let motion = NormalMotion::new(40.0)?;
    /// assert_eq!(motion.in_fixed_point(10.0)?.speed().to_f64(), 4.0);
    /// assert_eq!(motion.in_fixed_point(1.0).unwrap_err().parameter, Parameter::SpeedInUnits);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError>;
}

/// A speed or a velocity divided by the unit, if it is in the range of `parameter`.
fn in_units<T: Real>(speed: T, unit: T, parameter: Parameter) -> Result<FixedPoint, InputError> {
    let ratio = speed.saturating_div(Parameter::SpeedUnit.check(unit)?);
    Ok(FixedPoint::nearest(parameter.check(ratio)?.to_f64()))
}

impl<T: Real> InFixedPoint<T> for Sphere<T> {
    type Fixed = Sphere<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Parameter::FixedPointGyration.check(self.gyration_ratio)?;
        Ok(Sphere {
            radius: FixedPoint::ONE,
            // The density of a sphere with radius one and mass one.
            density: const { FixedPoint::nearest(3.0 / (4.0 * PI)) },
            gyration_ratio: FixedPoint::nearest(self.gyration_ratio.to_f64()),
            contact_inertia: FixedPoint::nearest(self.contact_inertia.to_f64()),
        })
    }
}

impl<T: Real> InFixedPoint<T> for ConstantRestitution<T> {
    type Fixed = ConstantRestitution<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(ConstantRestitution { restitution: FixedPoint::nearest(self.restitution.to_f64()) })
    }
}

impl<T: Real> InFixedPoint<T> for SpeedRestitution<T> {
    type Fixed = SpeedRestitution<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(SpeedRestitution { speed: in_units(self.speed, unit, Parameter::RestitutionSpeedInUnits)? })
    }
}

impl<T: Real> InFixedPoint<T> for AdhesionCoefficient<T> {
    type Fixed = AdhesionCoefficient<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(AdhesionCoefficient { remainder: FixedPoint::nearest(self.remainder.to_f64()) })
    }
}

impl<T: Real> InFixedPoint<T> for WorkOfAdhesion<T> {
    type Fixed = WorkOfAdhesion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(WorkOfAdhesion { speed: in_units(self.speed, unit, Parameter::VelocityInUnits)? })
    }
}

impl<T: Real> InFixedPoint<T> for Coulomb<T> {
    type Fixed = Coulomb<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        let coefficient = Parameter::FixedPointFriction.check(self.coefficient)?;
        Ok(Coulomb { coefficient: FixedPoint::nearest(coefficient.to_f64()), pressing: self.pressing })
    }
}

/// Terms that hold no number.
macro_rules! nothing_to_convert {
    ($($term:ident),*) => {$(
        impl<T> InFixedPoint<T> for $term {
            type Fixed = Self;

            fn in_fixed_point(&self, _unit: T) -> Result<Self, InputError> {
                Ok(*self)
            }
        }
    )*};
}

nothing_to_convert!(NoAdhesion, NoFriction);

impl<T, L, A, S> InFixedPoint<T> for RigidBody<T, L, A, S>
where
    T: Real,
    L: InFixedPoint<T>,
    A: InFixedPoint<T>,
    S: InFixedPoint<T>,
{
    type Fixed = RigidBody<FixedPoint, L::Fixed, A::Fixed, S::Fixed>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        // Some terms hold no speed and would not check the unit.
        let unit = Parameter::SpeedUnit.check(unit)?;
        Ok(RigidBody {
            sphere: self.sphere.in_fixed_point(unit)?,
            restitution: self.restitution.in_fixed_point(unit)?,
            adhesion: self.adhesion.in_fixed_point(unit)?,
            surface: self.surface.in_fixed_point(unit)?,
            microforce: self.microforce,
        })
    }
}

impl<T: Real> InFixedPoint<T> for NormalMotion<T> {
    type Fixed = NormalMotion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(NormalMotion { speed: in_units(self.speed, unit, Parameter::SpeedInUnits)? })
    }
}

impl<T: Real> InFixedPoint<T> for ObliqueMotion<T> {
    type Fixed = ObliqueMotion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(ObliqueMotion {
            normal: self.normal.in_fixed_point(unit)?,
            tangential: in_units(self.tangential, unit, Parameter::VelocityInUnits)?,
        })
    }
}

impl<T: Real> InFixedPoint<T> for PlanarMotion<T> {
    type Fixed = PlanarMotion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(PlanarMotion {
            oblique: self.oblique.in_fixed_point(unit)?,
            peripheral: in_units(self.peripheral, unit, Parameter::VelocityInUnits)?,
        })
    }
}

impl PlanarMotion<FixedPoint> {
    /// Approach speed, tangential and peripheral velocity in a unit of speed: those of an instrument that measures in integers.
    ///
    /// # Errors
    /// A velocity is outside its range.
    ///
    /// ```
    /// use microimpact::{FixedPoint, InFixedPoint, NormalMotion, PlanarMotion};
    ///
    /// let velocities = [2.5, 1.0, -0.5].map(FixedPoint::nearest);
    /// let motion = NormalMotion::new(10.0)?.with_tangential(4.0)?.with_peripheral_velocity(-2.0)?;
    /// assert_eq!(PlanarMotion::in_units(velocities)?, motion.in_fixed_point(4.0)?);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn in_units([approach, tangential, peripheral]: [FixedPoint; 3]) -> Result<Self, InputError> {
        let speed = Parameter::SpeedInUnits.check(approach)?;
        let tangential = Parameter::VelocityInUnits.check(tangential)?;
        let peripheral = Parameter::VelocityInUnits.check(peripheral)?;
        Ok(Self { oblique: ObliqueMotion { normal: NormalMotion { speed }, tangential }, peripheral })
    }
}
