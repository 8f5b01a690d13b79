//! Two spheres that collide.

use super::plane::{Plane, unit};
use super::vector::{add, cross, dot, length, scaled};
use super::{Departing, SpatialMotion, approach};
use crate::{Approach, InputError, NormalMotion, Oblique, ObliqueMotion, Real, Sphere};

/// Two spheres, whose impact is that of one sphere on a wall.
///
/// The [reduced sphere](Self::reduced) has the radius r1 r2/(r1 + r2), the mass m1 m2/(m1 + m2), and a gyration ratio that makes its
/// contact point as hard to move as theirs. A wall is the limit of a second sphere that is large and heavy.
///
/// The lever arms of friction are the radii of both spheres, as at first contact, and do not shorten with the indentation. So momentum
/// and angular momentum are kept exactly, and spins differ from those of a program with shorter arms by about the indentation over
/// the radius.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact};
/// use microimpact::space::{Pair, SpatialMotion};
/// use microimpact::{Material, Sphere, Stiffness};
///
/// // Two glass spheres head on at 10 m/s each (Chung and Ooi 2011, test 1).
/// let glass = Material::new(4.8e10, 0.2)?;
/// let pair = Pair::new(Sphere::solid(0.01, 2800.0)?, Sphere::solid(0.01, 2800.0)?);
/// let scene = Contact::hertz(pair.reduced(), Stiffness::between(&glass, &glass)?);
/// let (left, right) = (SpatialMotion::new([10.0, 0.0, 0.0], [0.0; 3])?, SpatialMotion::new([-10.0, 0.0, 0.0], [0.0; 3])?);
/// let before = pair.incidence([-1.0, 0.0, 0.0], [&left, &right])?;
/// let impact = scene.solve(&before, &Adaptive::new(1e-9)?)?;
/// assert!((impact.normal.peak_indentation().unwrap() - 2.741127e-4_f64).abs() < 1e-9);
/// let [left, right] = before.after(&impact).unwrap();
/// assert!((left.velocity()[0] + 10.0).abs() < 1e-7 && (right.velocity()[0] - 10.0).abs() < 1e-7);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Pair<T> {
    spheres: [Sphere<T>; 2],
    reduced: Sphere<T>,
    /// m2/(m1 + m2) and m1/(m1 + m2).
    shares: [T; 2],
}

impl<T: Real> Pair<T> {
    /// Two spheres.
    ///
    /// ```
    /// use microimpact::{Sphere, space::Pair};
    ///
    /// let pair = Pair::new(Sphere::solid(2e-6, 1000.0)?, Sphere::solid(2e-6, 1000.0)?);
    /// assert_eq!(pair.reduced().radius(), 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(first: Sphere<T>, second: Sphere<T>) -> Self {
        let one = T::ONE;
        // Ratios, since the products of small masses are too small for f32.
        let size = first.radius() / second.radius();
        let mass = size * size * size * (first.density() / second.density());
        let shares = [one / (one + mass), mass / (one + mass)];
        let gyration_ratio = one / (shares[0] / first.gyration_ratio() + shares[1] / second.gyration_ratio());
        let larger = one + size;
        let reduced = Sphere {
            radius: first.radius() / larger,
            density: first.density() * shares[0] * larger * larger * larger,
            gyration_ratio,
            contact_inertia: gyration_ratio / (one + gyration_ratio),
        };
        Self { spheres: [first, second], reduced, shares }
    }

    /// The sphere whose impact on a wall theirs is. Scenes are built on it, and results are those of its impact: forces, works, times and
    /// the restitution are those of both spheres; kinetic energies are those of the reduced sphere with the closing speed and the slip.
    ///
    /// ```
    /// use microimpact::{Sphere, space::Pair};
    ///
    /// let (small, large) = (Sphere::solid(1e-6, 1000.0)?, Sphere::solid(1.0, 1000.0)?);
    /// let reduced = Pair::new(small, large).reduced();
    /// assert!((reduced.radius() / small.radius() - 1.0_f64).abs() < 2e-6);
    /// assert!((reduced.mass() / small.mass() - 1.0).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn reduced(&self) -> Sphere<T> {
        self.reduced
    }

    /// The motions of the spheres towards each other, as the planar motion of the reduced sphere. The normal points from the second
    /// centre to the first.
    ///
    /// The motion belongs to scenes on [`reduced`](Self::reduced). A scene on one of the two spheres solves another impact, and nothing
    /// reports it.
    ///
    /// # Errors
    /// A normal that is not of unit length within 1e-3; spheres that do not approach; a part of the planar motion outside its range.
    ///
    /// ```
    /// use microimpact::{Approach, Sphere, space::{Pair, SpatialMotion}};
    ///
    /// let pair = Pair::new(Sphere::solid(1e-3, 1000.0)?, Sphere::solid(1e-3, 1000.0)?);
    /// let (falls, rests) = (SpatialMotion::new([0.0, 0.0, -3.0], [0.0; 3])?, SpatialMotion::new([0.0; 3], [0.0; 3])?);
    /// assert_eq!(pair.incidence([0.0, 0.0, 1.0], [&falls, &rests])?.normal().speed(), 3.0);
    /// assert!(pair.incidence([0.0, 0.0, -1.0], [&falls, &rests]).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn incidence(
        &self,
        normal: [T; 3],
        [first, second]: [&SpatialMotion<T>; 2],
    ) -> Result<PairIncidence<T>, InputError> {
        let normal = unit(normal)?;
        let relative = add(first.velocity(), -T::ONE, second.velocity());
        let (mut at_contact, mut largest) = (relative, length(relative));
        for (sphere, motion) in self.spheres.iter().zip([first, second]) {
            at_contact = add(at_contact, -sphere.radius(), cross(motion.spin(), normal));
            largest = largest + sphere.radius() * length(motion.spin());
        }
        let plane = Plane::of(normal, at_contact, relative, largest);
        let slip = approach(-dot(relative, normal))?.with_tangential(dot(at_contact, plane.tangent))?;
        Ok(PairIncidence { pair: *self, slip, plane, before: [*first, *second] })
    }
}

/// The motion of two spheres towards each other, as that of the reduced sphere of a [`Pair`]: its tangential velocity is their slip,
/// and it does not spin.
///
/// It goes wherever an oblique motion goes, but for a peeling moment, rolling dissipation, and external forces and impulses: these act
/// on one body. The contact is short: the normal keeps its direction while it lasts.
///
/// ```
/// use microimpact::space::{Pair, SpatialMotion};
/// use microimpact::{ConstantRestitution, RigidBody, Sphere};
///
/// let pair = Pair::new(Sphere::solid(1.0, 1000.0)?, Sphere::solid(1.0, 1000.0)?);
/// let scene = RigidBody::new(pair.reduced(), ConstantRestitution::new(1.0)?).with_friction(0.4)?;
/// let still = SpatialMotion::new([0.0; 3], [0.0; 3])?;
/// let before = pair.incidence([0.0, 0.0, 1.0], [&SpatialMotion::new([0.0, 0.0, -1.0], [0.0; 3])?, &still])?;
/// let [first, second] = before.after(&scene.impact(&before)).unwrap();
/// assert_eq!((first.velocity()[2], second.velocity()[2]), (0.0, -1.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PairIncidence<T> {
    pair: Pair<T>,
    slip: ObliqueMotion<T>,
    plane: Plane<T>,
    before: [SpatialMotion<T>; 2],
}

impl<T: Real> PairIncidence<T> {
    /// The motions of both spheres after an impact; `None` where the method found no solution. Captured, they have the same velocity
    /// along the normal; along the surface they slide or roll on each other.
    ///
    /// ```
    /// use microimpact::space::{Pair, SpatialMotion};
    /// use microimpact::{ConstantRestitution, RigidBody, Sphere};
    ///
    /// // Adhesion holds them: both have half of the velocity.
    /// let pair = Pair::new(Sphere::solid(1e-6, 1000.0)?, Sphere::solid(1e-6, 1000.0)?);
    /// let scene = RigidBody::new(pair.reduced(), ConstantRestitution::new(0.5)?).with_work_of_adhesion(1e-12)?;
    /// let still = SpatialMotion::new([0.0; 3], [0.0; 3])?;
    /// let before = pair.incidence([0.0, 0.0, 1.0], [&SpatialMotion::new([0.0, 0.0, -1.0], [0.0; 3])?, &still])?;
    /// let [first, second] = before.after(&scene.impact(&before)).unwrap();
    /// assert_eq!((first.velocity()[2], second.velocity()[2]), (-0.5, -0.5));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn after(&self, impact: &impl Departing<T>) -> Option<[SpatialMotion<T>; 2]> {
        let (speed, slip) = (self.slip.normal().speed(), self.slip.tangential());
        let after = impact.departure(slip)?;
        let friction = after.tangential - slip;
        let change = self.plane.vector(speed + after.normal, friction);
        let ([first, second], shares) = (self.pair.spheres, self.pair.shares);
        let turned = |sphere: Sphere<T>, share: T| {
            (-(share * friction) / (sphere.radius() * sphere.gyration_ratio()), self.plane.axis)
        };
        Some([
            self.before[0].changed(scaled(change, shares[0]), turned(first, shares[0])),
            self.before[1].changed(scaled(change, -shares[1]), turned(second, shares[1])),
        ])
    }
}

impl<T: Real> Approach<T> for PairIncidence<T> {
    const OF_TWO_BODIES: bool = true;

    #[inline]
    fn normal(&self) -> NormalMotion<T> {
        self.slip.normal()
    }
}

impl<T: Real> Oblique<T> for PairIncidence<T> {
    #[inline]
    fn tangential(&self) -> T {
        self.slip.tangential()
    }

    #[inline]
    fn peripheral(&self) -> T {
        T::ZERO
    }

    #[inline]
    fn slip(&self) -> T {
        self.slip.tangential()
    }
}
