//! A sphere against a wall of any direction, which may move.

use super::plane::{Plane, unit};
use super::vector::{Vector, add, cross, dot, length};
use super::{Departing, SpatialMotion, approach};
use crate::{Approach, InputError, NormalMotion, Oblique, Parameter, PlanarMotion, Real, Sphere};

/// A wall: the plane that a sphere hits, at rest or moving.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact};
/// use microimpact::space::{SpatialMotion, Wall};
/// use microimpact::{Sphere, Stiffness};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(1e10)?).with_friction(0.5)?;
/// let wall = Wall::moving([0.0, 0.0, 1.0], [0.0, 0.0, 0.5])?;
/// let before = wall.incidence(&sphere, &SpatialMotion::new([0.3, 0.4, -0.5], [0.0, 0.0, 7.0])?)?;
/// let after = before.after(&scene.solve(&before, &Adaptive::new(1e-9)?)?).unwrap();
/// // It rolls, bounces off with the speed at which it met the wall, and goes on spinning about the normal.
/// let [x, y, z] = after.velocity();
/// assert!((x - 0.3 * 5.0 / 7.0_f64).abs() < 1e-12 && (y - 0.4 * 5.0 / 7.0).abs() < 1e-12 && (z - 1.5).abs() < 1e-8);
/// assert_eq!(after.spin()[2], 7.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Wall<T> {
    normal: Vector<T>,
    velocity: Vector<T>,
}

impl<T: Real> Wall<T> {
    /// A wall at rest, from its normal, which points to the sphere. A length within 1e-3 of one is set to one.
    ///
    /// # Errors
    /// A normal of another length.
    ///
    /// ```
    /// use microimpact::{Parameter, space::Wall};
    ///
    /// assert!(Wall::new([0.577, 0.577, 0.577]).is_ok());
    /// assert_eq!(Wall::new([1.0, 1.0, 1.0]).unwrap_err().parameter, Parameter::NormalLength);
    /// ```
    pub fn new(normal: [T; 3]) -> Result<Self, InputError> {
        Self::moving(normal, [T::ZERO; 3])
    }

    /// A wall whose surface moves at the contact with a velocity, m/s.
    ///
    /// # Errors
    /// As [`new`](Self::new); a component of the velocity outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, space::{SpatialMotion, Wall}};
    ///
    /// // A belt that runs along with the sphere.
    /// let belt = Wall::moving([0.0, 0.0, 1.0], [2.0, 0.0, 0.0])?;
    /// let before = belt.incidence(&Sphere::solid(1e-3, 1e3)?, &SpatialMotion::new([2.0, 0.0, -1.0], [0.0; 3])?)?;
    /// assert_eq!(microimpact::Oblique::slip(&before), 0.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn moving(normal: [T; 3], velocity: [T; 3]) -> Result<Self, InputError> {
        for component in velocity {
            Parameter::VelocityComponent.check(component)?;
        }
        Ok(Self { normal: unit(normal)?, velocity })
    }

    /// The motion of a sphere towards this wall, as the planar motion that it is.
    ///
    /// # Errors
    /// A sphere that rests or recedes, seen from the wall; a part of the planar motion outside its range.
    ///
    /// ```
    /// use microimpact::{Approach, Oblique, Sphere, space::{SpatialMotion, Wall}};
    ///
    /// let sphere = Sphere::solid(0.5, 1000.0)?;
    /// let before = Wall::new([0.0, 0.0, 1.0])?.incidence(&sphere, &SpatialMotion::new([3.0, 4.0, -2.0], [0.0; 3])?)?;
    /// assert_eq!((before.normal().speed(), before.slip()), (2.0, 5.0));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn incidence(&self, sphere: &Sphere<T>, motion: &SpatialMotion<T>) -> Result<WallIncidence<T>, InputError> {
        let relative = add(motion.velocity(), -T::ONE, self.velocity);
        let at_contact = add(relative, -sphere.radius(), cross(motion.spin(), self.normal));
        let largest = length(relative) + sphere.radius() * length(motion.spin());
        let plane = Plane::of(self.normal, at_contact, relative, largest);
        let planar = approach(-dot(relative, self.normal))?
            .with_tangential(dot(relative, plane.tangent))?
            .with_spin(sphere, dot(motion.spin(), plane.axis))?;
        let turning = sphere.radius() * sphere.gyration_ratio();
        Ok(WallIncidence { planar, plane, turning, sideways: dot(relative, plane.axis), before: *motion })
    }
}

/// The motion of a sphere towards a [`Wall`], seen in the plane of the normal and the slip.
///
/// It goes wherever a planar motion goes, but for a peeling moment and for rolling dissipation: both act against a spin about one
/// axis, and what they do to another is not known. The impact is exact: friction acts against the slip, whose direction never changes.
/// The velocity across the plane stays, and so does the spin about the normal and about the slip.
///
/// ```
/// use microimpact::space::{SpatialMotion, Wall};
/// use microimpact::{ConstantRestitution, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(0.5)?).with_friction(0.1)?;
/// let before = Wall::new([0.0, 1.0, 0.0])?.incidence(&sphere, &SpatialMotion::new([9.0, -2.0, 0.0], [0.0; 3])?)?;
/// // Friction takes f (1 + e) of the approach speed.
/// let after = before.after(&scene.impact(&before)).unwrap();
/// assert!((after.velocity()[0] - 8.7_f64).abs() < 1e-12 && (after.velocity()[1] - 1.0).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
///
/// ```compile_fail
/// # use microimpact::contact::{Adaptive, Contact};
/// # use microimpact::space::{SpatialMotion, Wall};
/// # use microimpact::{Sphere, Stiffness};
/// # let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(1e10)?).with_ring(100.0, 1.0)?.with_friction(0.1)?.with_peeling(1e-12)?;
/// let before = Wall::new([0.0, 1.0, 0.0])?.incidence(&sphere, &SpatialMotion::new([9.0, -2.0, 0.0], [0.0; 3])?)?;
/// scene.solve(&before, &Adaptive::new(1e-9)?)?; // a peeling moment needs a planar motion
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct WallIncidence<T> {
    planar: PlanarMotion<T>,
    plane: Plane<T>,
    /// kappa r: by what an impulse is divided that turns the sphere.
    turning: T,
    sideways: T,
    before: SpatialMotion<T>,
}

impl<T: Real> WallIncidence<T> {
    /// Velocity across the plane of the impact, seen from the wall, m/s. The sphere keeps it: one that the plane shows at rest rolls
    /// sideways with it.
    ///
    /// ```
    /// use microimpact::{Sphere, space::{SpatialMotion, Wall}};
    ///
    /// // It rolls along y, and slips along x.
    /// let (sphere, motion) = (Sphere::solid(1.0, 1000.0)?, SpatialMotion::new([1.0, 3.0, -1.0], [-3.0, 0.0, 0.0])?);
    /// assert_eq!(Wall::new([0.0, 0.0, 1.0])?.incidence(&sphere, &motion)?.sideways(), 3.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn sideways(&self) -> T {
        self.sideways
    }

    /// The motion of the sphere after an impact; `None` where the method found no solution.
    ///
    /// ```
    /// use microimpact::contact::{Contact, FixedCost};
    /// use microimpact::space::{SpatialMotion, Wall};
    /// use microimpact::{Sphere, Stiffness};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let scene = Contact::hertz(sphere, Stiffness::new(1e10)?);
    /// let before = Wall::new([1.0, 0.0, 0.0])?.incidence(&sphere, &SpatialMotion::new([-2.0, 1.0, 0.0], [0.0; 3])?)?;
    /// let after = before.after(&scene.solve(&before, &FixedCost::<5>::new(3)?)?).unwrap();
    /// assert!((after.velocity()[0] - 2.0_f64).abs() < 1e-9 && after.velocity()[1] == 1.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn after(&self, impact: &impl Departing<T>) -> Option<SpatialMotion<T>> {
        let (speed, tangential) = (self.planar.normal().speed(), self.planar.tangential());
        let after = impact.departure(tangential)?;
        let friction = after.tangential - tangential;
        let velocity = self.plane.vector(speed + after.normal, friction);
        Some(self.before.changed(velocity, (-friction / self.turning, self.plane.axis)))
    }
}

impl<T: Real> Approach<T> for WallIncidence<T> {
    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        self.planar.normal()
    }
}

impl<T: Real> Oblique<T> for WallIncidence<T> {
    #[inline]
    fn tangential(&self) -> T {
        self.planar.tangential()
    }

    #[inline]
    fn peripheral(&self) -> T {
        self.planar.peripheral()
    }

    #[inline]
    fn slip(&self) -> T {
        self.planar.slip()
    }
}
