//! The rigid-body model in fixed point, in units of its sphere and of a speed.

use core::f64::consts::PI;

use super::FixedPoint;
use crate::rigid::{AdhesionCoefficient, WorkOfAdhesion};
use crate::{
    ConstantRestitution, Coulomb, InputError, NoAdhesion, NoFriction, NormalMotion, ObliqueMotion, Parameter,
    PlanarMotion, Real, RigidBody, SpeedRestitution, Sphere,
};

/// A scene, a term of it or a motion that fixed point holds in units of the sphere's radius and mass and of a speed.
///
/// The unit of speed is free; with one near the speeds that occur, they have the most digits. All of a scene and its motions
/// take the same unit, and velocities of the result are in this unit. Classes, margins and coefficients have no unit; a
/// margin above 128 is held there.
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
/// // Set-up in floating point; from here on integers.
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
    /// The same with fixed-point numbers.
    type Fixed;

    /// The same in fixed point, with a `unit` of speed in m/s.
    ///
    /// # Errors
    /// A unit outside its range, or a value that in this unit lies outside its range for [`FixedPoint`].
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

/// A speed or velocity in units of another, within the range of a parameter.
fn in_units<T: Real + Into<f64>>(speed: T, unit: T, parameter: Parameter) -> Result<FixedPoint, InputError> {
    let ratio = speed.saturating_div(Parameter::SpeedUnit.check(unit)?);
    Ok(FixedPoint::nearest(parameter.check(ratio)?.into()))
}

impl<T: Real + Into<f64>> InFixedPoint<T> for Sphere<T> {
    type Fixed = Sphere<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(Sphere {
            radius: FixedPoint::ONE,
            // Of a sphere of mass one.
            density: const { FixedPoint::nearest(3.0 / (4.0 * PI)) },
            gyration_ratio: FixedPoint::nearest(self.gyration_ratio.into()),
            contact_inertia: FixedPoint::nearest(self.contact_inertia.into()),
        })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for ConstantRestitution<T> {
    type Fixed = ConstantRestitution<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(ConstantRestitution { restitution: FixedPoint::nearest(self.restitution.into()) })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for SpeedRestitution<T> {
    type Fixed = SpeedRestitution<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(SpeedRestitution { speed: in_units(self.speed, unit, Parameter::RestitutionSpeedInUnits)? })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for AdhesionCoefficient<T> {
    type Fixed = AdhesionCoefficient<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        Ok(AdhesionCoefficient { remainder: FixedPoint::nearest(self.remainder.into()) })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for WorkOfAdhesion<T> {
    type Fixed = WorkOfAdhesion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(WorkOfAdhesion { speed: in_units(self.speed, unit, Parameter::VelocityInUnits)? })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for Coulomb<T> {
    type Fixed = Coulomb<FixedPoint>;

    fn in_fixed_point(&self, _unit: T) -> Result<Self::Fixed, InputError> {
        let coefficient = Parameter::FixedPointFriction.check(self.coefficient)?;
        Ok(Coulomb { coefficient: FixedPoint::nearest(coefficient.into()) })
    }
}

/// What has no number in it.
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

impl<T, L, A, F> InFixedPoint<T> for RigidBody<T, L, A, F>
where
    T: Real + Into<f64>,
    L: InFixedPoint<T>,
    A: InFixedPoint<T>,
    F: InFixedPoint<T>,
{
    type Fixed = RigidBody<FixedPoint, L::Fixed, A::Fixed, F::Fixed>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        // Not every term has a speed.
        let unit = Parameter::SpeedUnit.check(unit)?;
        Ok(RigidBody {
            sphere: self.sphere.in_fixed_point(unit)?,
            restitution: self.restitution.in_fixed_point(unit)?,
            adhesion: self.adhesion.in_fixed_point(unit)?,
            friction: self.friction.in_fixed_point(unit)?,
            rolling: self.rolling,
            microforce: self.microforce,
        })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for NormalMotion<T> {
    type Fixed = NormalMotion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(NormalMotion { speed: in_units(self.speed, unit, Parameter::SpeedInUnits)? })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for ObliqueMotion<T> {
    type Fixed = ObliqueMotion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(ObliqueMotion {
            normal: self.normal.in_fixed_point(unit)?,
            tangential: in_units(self.tangential, unit, Parameter::VelocityInUnits)?,
        })
    }
}

impl<T: Real + Into<f64>> InFixedPoint<T> for PlanarMotion<T> {
    type Fixed = PlanarMotion<FixedPoint>;

    fn in_fixed_point(&self, unit: T) -> Result<Self::Fixed, InputError> {
        Ok(PlanarMotion {
            oblique: self.oblique.in_fixed_point(unit)?,
            peripheral: in_units(self.peripheral, unit, Parameter::VelocityInUnits)?,
        })
    }
}
