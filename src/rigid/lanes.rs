//! One of several impacts that a number type with lanes holds.

use crate::{Impact, Real, TangentialImpact};

impl<V: Real> Impact<V, TangentialImpact<V>> {
    /// The impact of one lane of a scene whose numbers hold one number of each of several impacts; `lane` takes the number of the lane.
    ///
    /// [`Real`] states what such a number type has to do. The scene may have Coulomb friction, any adhesion of this library, and a
    /// [`ConstantRestitution`](crate::ConstantRestitution), [`SpeedRestitution`](crate::SpeedRestitution),
    /// [`PowerRestitution`](super::PowerRestitution) or [`ElasticPlasticRestitution`](super::ElasticPlasticRestitution). Velocities and
    /// ratios may be read in lanes; classes and energies only from the impact that this function returns.
    ///
    /// ```
    /// use microimpact::{ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // A number is its own only lane. The package `impact-arrays` of the repository has types of four and eight.
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(0.9)?).with_friction(0.1)?;
    /// let impact = scene.impact(&NormalMotion::new(1.0)?.with_tangential(5.0)?);
    /// assert_eq!(impact.lane(|number: f64| number), impact);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn lane<T: Real>(&self, lane: impl Fn(V) -> T) -> Impact<T, TangentialImpact<T>> {
        Impact { normal: self.normal.map(&lane), tangential: self.tangential.map(lane) }
    }
}

impl<V: Real> TangentialImpact<V> {
    #[inline]
    fn map<T: Real>(&self, of: impl Fn(V) -> T) -> TangentialImpact<T> {
        let (friction, rolling_friction) = (of(self.friction), of(self.rolling_friction));
        TangentialImpact {
            gyration_ratio: of(self.gyration_ratio),
            contact_inertia: of(self.contact_inertia),
            approach: of(self.approach),
            normal_impulse: of(self.normal_impulse),
            velocity_before: of(self.velocity_before),
            peripheral_before: of(self.peripheral_before),
            slip_before: of(self.slip_before),
            velocity: of(self.velocity),
            peripheral: of(self.peripheral),
            // A sphere rolls in one lane and slides in another.
            rolls: if V::HAS_LANES { friction == rolling_friction } else { self.rolls },
            friction,
            sliding_friction: of(self.sliding_friction),
            holding_friction: of(self.holding_friction),
            rolling_friction,
            moment: of(self.moment),
        }
    }
}
