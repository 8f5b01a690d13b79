//! The force of a contact, for those who step many contacts in time.

use super::law::{ContactLaw, Units};
use super::scene::Contact;
use crate::{Approach, InputError, Real};

/// The force between sphere and surface as a function of indentation and rate, during one impact.
///
/// It is what a simulation of many particles adds up. Hysteretic damping depends on the speed before the impact (B4), hence the
/// impact.
///
/// ```
/// use microimpact::contact::{Contact, JkrLaw};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let (sphere, stiffness, work) = (Sphere::solid(2e-6, 1050.0)?, Stiffness::new(5e9)?, 0.1);
/// let scene = Contact::new(sphere, JkrLaw::new(stiffness, work)?.with_viscoelastic_damping(1e-9)?);
/// let force = scene.force(&NormalMotion::new(1.0)?)?;
/// // Johnson, Kendall and Roberts' force of first touch, 8/9 of the pull-off force.
/// let pull_off = 1.5 * core::f64::consts::PI * work * sphere.radius();
/// assert!((force.at(0.0, 0.0).unwrap() / pull_off + 8.0 / 9.0).abs() < 1e-12);
/// // Damping opposes the motion, and there is no force without contact.
/// assert!(force.at(1e-8, 1.0) > force.at(1e-8, 0.0) && force.at(1e-8, -1.0) < force.at(1e-8, 0.0));
/// assert_eq!(force.at(-1e-8, 0.0), None);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactForce<T, L> {
    law: L,
    units: Units<T>,
    /// Unit of force, N.
    force: T,
}

impl<T: Real, L: ContactLaw<T>> ContactForce<T, L> {
    /// The force, N, positive out of the surface, at an indentation (m) that grows at a rate (m/s, positive inwards). The external
    /// force is not part of it. `None` where there is no contact.
    ///
    /// A contact of Johnson, Kendall and Roberts begins at zero indentation and lasts to a negative one. Whether spheres that far apart
    /// have touched is for the caller to know.
    ///
    /// ```
    /// use microimpact::contact::Contact;
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(0.25, 1000.0)?, Stiffness::new(1e10)?);
    /// // sqrt(r) K delta^(3/2)
    /// let force = scene.force(&NormalMotion::new(1.0)?)?.at(0.01, 0.0);
    /// assert!((force.unwrap() - 5e6_f64).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn at(&self, indentation: T, rate: T) -> Option<T> {
        let (s, rate) = (self.law.coordinate_in_contact(indentation / self.units.length)?, rate / self.units.speed);
        if self.law.release_speed(s).is_some_and(|most| -rate > most) {
            return None; // the contact has ended before
        }
        let damping = self.law.damping(s, rate < T::ZERO) * rate;
        Some(self.force * (self.law.elastic_force(s) - self.law.adhesion_force(s) + damping))
    }
}

impl<T: Real, L: ContactLaw<T>, S> Contact<T, L, S> {
    /// The force of the contact during the impact of a sphere that arrives with the motion `before`.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::Contact;
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_dmt(0.1)?;
    /// let force = scene.force(&NormalMotion::new(1.0)?)?;
    /// // 2 pi G r
    /// assert!((force.at(0.0, 0.0).unwrap() + 6.283185307e-7_f64).abs() < 1e-15);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn force(&self, before: &impl Approach<T>) -> Result<ContactForce<T, L>, InputError> {
        let (law, units, _) = self.in_units_of(before)?;
        let force = self.sphere().mass() * units.speed * (units.speed / units.length);
        Ok(ContactForce { law, units, force })
    }
}
