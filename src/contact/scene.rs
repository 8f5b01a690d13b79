//! Scenes: a sphere, the law of its contact, and what happens along the surface.

use super::along::{Compliance, CompliantVelocities, Peeling, PressingForce, Surface, Unloading};
use super::law::{
    AnyLaw, Attraction, ConstantDamping, ConstantForce, ContactLaw, Dmt, Groups, HertzLaw, HystereticDamping,
    NoTension, ProportionalDamping, Ring, RingStrength, Units, ViscoelasticDamping,
};
use super::outputs::{Ended, Output};
use super::result::{NormalContact, SettledImpact, SimulatedImpact};
use super::solve::critical::Trial;
use super::solve::critical_search;
use super::solve::quantities::Times;
use super::solve::{ErrorControl, Method, RestCriterion, RunReport, Status};
use super::{AnyScene, TangentialVelocities};
use crate::{
    Approach, Classification, ContactClass, Coulomb, CriticalSpeed, Fault, InputError, NoAdhesion, NoFriction,
    Parameter, Real, Sphere, Stiffness,
};

/// An approach speed that occurs, m/s.
const ORDINARY_SPEED: f64 = 1.0;

/// A sphere and the physics of its contact: `L` the law of contact along the normal, `S` what happens along the surface.
/// A term that is not added takes no memory and no time.
///
/// Names for common scenes are [`HertzScene`](super::HertzScene), [`RingScene`](super::RingScene),
/// [`PaperScene`](super::PaperScene) and [`AnyScene`].
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, Slip};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Table 1 of the paper. Its program halves the damping of adhesion, so the printed 12.5 is 6.25 here.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
/// let (impact, slip) = scene.solve_for(&before, &Adaptive::new(1e-9)?, Slip)?;
/// assert!((impact.normal.overall_restitution() - 0.746193_f64).abs() < 1e-6);
/// assert!((impact.normal.peak_indentation().unwrap() - 4.251e-8).abs() < 1e-11);
/// assert!((impact.tangential.velocity() - 0.2102).abs() < 1e-4);
/// assert!((slip.rotation_degrees() - 0.1234).abs() < 1e-4);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        deserialize = "T: Real + serde::Deserialize<'de>, L: serde::Deserialize<'de>, S: serde::Deserialize<'de>"
    ))
)]
pub struct Contact<T, L, S = NoFriction> {
    pub(crate) sphere: Sphere<T>,
    pub(crate) law: L,
    pub(crate) surface: S,
}

impl<T: Real, L> Contact<T, L> {
    /// A scene of a sphere and a law of contact, without friction.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::{Contact, HertzLaw}};
    ///
    /// let law = HertzLaw::new(Stiffness::new(1e10_f32)?);
    /// let scene = Contact::new(Sphere::solid(1e-6_f32, 1000.0)?, law);
    /// assert_eq!(size_of_val(&scene), size_of::<Sphere<f32>>() + size_of::<f32>());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn new(sphere: Sphere<T>, law: L) -> Self {
        Self { sphere, law, surface: NoFriction }
    }
}

impl<T: Real> Contact<T, HertzLaw<T>> {
    /// A scene of a sphere and the stiffness of its elastic contact, with no other physics.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6_f32, 1000.0)?, Stiffness::new(1e10)?);
    /// assert_eq!(size_of_val(&scene), size_of::<Sphere<f32>>() + size_of::<f32>());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn hertz(sphere: Sphere<T>, stiffness: Stiffness<T>) -> Self {
        Self::new(sphere, HertzLaw::new(stiffness))
    }
}

impl<T: Real, D, A, X, S> Contact<T, HertzLaw<T, D, A, X>, S> {
    /// The same scene with hysteretic damping of strength zeta_H >= 0 in the materials. [`HystereticDamping`] says how zeta_H
    /// relates to a damping constant in s/m.
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_damping(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_damping(self, zeta: T) -> Result<Contact<T, HertzLaw<T, HystereticDamping<T>, A, X>, S>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law.with_damping(zeta)?, surface: self.surface })
    }

    /// The same scene with viscoelastic damping of the relaxation time A >= 0, s.
    ///
    /// # Errors
    /// A time outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_viscoelastic_damping(-1e-9).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_viscoelastic_damping(
        self,
        time: T,
    ) -> Result<Contact<T, HertzLaw<T, ViscoelasticDamping<T>, A, X>, S>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law.with_viscoelastic_damping(time)?, surface: self.surface })
    }

    /// The same scene with damping that, without adhesion, leaves a restitution e at every speed.
    ///
    /// # Errors
    /// A restitution outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_constant_damping(0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_constant_damping(
        self,
        restitution: T,
    ) -> Result<Contact<T, HertzLaw<T, ConstantDamping<T>, A, X>, S>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law.with_constant_damping(restitution)?, surface: self.surface })
    }

    /// The same scene with a constant external force, N, positive out of the surface.
    ///
    /// # Errors
    /// A force outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_external_force(f64::INFINITY).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_external_force(
        self,
        force: T,
    ) -> Result<Contact<T, HertzLaw<T, D, A, ConstantForce<T>>, S>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law.with_external_force(force)?, surface: self.surface })
    }
}

impl<T: Real, D, X, S> Contact<T, HertzLaw<T, D, NoAdhesion, X>, S> {
    /// The same scene with adhesion as a force 2 pi a f0 along the edge of the contact (the ring force), of strength f0 >= 0
    /// (N/m), and with its damping zeta_A >= 0 on rebound.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_ring(-1.0, 0.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_ring(self, strength: T, zeta: T) -> Result<Contact<T, HertzLaw<T, D, Ring<T>, X>, S>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law.with_ring(strength, zeta)?, surface: self.surface })
    }

    /// The same scene with the adhesion of Derjaguin, Muller and Toporov, of a work of adhesion G >= 0, J/m^2.
    ///
    /// # Errors
    /// A work outside its range.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// // 2 pi G r = 1, m = r = K = 1.
    /// let sphere = Sphere::solid(1.0, 0.75 / core::f64::consts::PI)?;
    /// let scene = Contact::hertz(sphere, Stiffness::new(1.0)?)
    ///     .with_dmt(0.5 / core::f64::consts::PI)?
    ///     .with_viscoelastic_damping(0.05)?;
    /// let impact = scene.solve(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9)?)?;
    /// assert!((impact.normal.overall_restitution() - 0.5921461602612_f64).abs() < 1e-9);
    /// assert!(Contact::hertz(sphere, Stiffness::new(1.0)?).with_dmt(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_dmt(self, work: T) -> Result<Contact<T, HertzLaw<T, D, Dmt<T>, X>, S>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law.with_dmt(work)?, surface: self.surface })
    }
}

impl<T: Real, D, S> Contact<T, HertzLaw<T, D>, S> {
    /// The same scene with an end of contact where damping cancels the elastic force, and not at zero indentation.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-3, 1000.0)?, Stiffness::new(1e9)?).with_constant_damping(0.5)?;
    /// let (motion, method) = (NormalMotion::new(1.0)?, Adaptive::new(1e-9)?);
    /// let e = scene.without_tension().solve(&motion, &method)?.normal.overall_restitution();
    /// assert!((e - 0.550_283_169_6_f64).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn without_tension(self) -> Contact<T, HertzLaw<T, D, NoTension>, S> {
        Contact { sphere: self.sphere, law: self.law.without_tension(), surface: self.surface }
    }
}

impl<T: Real, L, S> Contact<T, L, S> {
    /// The same scene with Coulomb friction of `coefficient` f >= 0, which is proportional to the elastic force alone (B8).
    ///
    /// # Errors
    /// A coefficient outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_friction(-0.1).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_friction(self, coefficient: T) -> Result<Contact<T, L, Coulomb<T>>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law, surface: Coulomb::new(coefficient)? })
    }

    /// The same scene with Coulomb friction of `coefficient` f >= 0, which is proportional to a force of your choice:
    /// [`ElasticForce`](super::ElasticForce), [`TotalForce`](super::TotalForce) or [`TotalAndPullOff`](super::TotalAndPullOff).
    ///
    /// # Errors
    /// A coefficient outside its range.
    ///
    /// ```
    /// use microimpact::contact::{Contact, TotalForce};
    /// use microimpact::{Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert!(scene.with_friction_under(0.1, TotalForce::new()).is_ok());
    /// assert!(scene.with_friction_under(-0.1, TotalForce::new()).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_friction_under<P: PressingForce<T>>(
        self,
        coefficient: T,
        pressing: P,
    ) -> Result<Contact<T, L, Coulomb<T, P>>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law, surface: Coulomb::new(coefficient)?.under(pressing) })
    }

    /// The sphere of this scene.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// assert_eq!(Contact::hertz(sphere, Stiffness::new(1e10)?).sphere(), &sphere);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn sphere(&self) -> &Sphere<T> {
        &self.sphere
    }

    /// The law of contact of this scene, in SI units.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::{Contact, HertzLaw}};
    ///
    /// let stiffness = Stiffness::new(1e10)?;
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, stiffness);
    /// assert_eq!(scene.law(), &HertzLaw::new(stiffness));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn law(&self) -> &L {
        &self.law
    }
}

impl<T: Real, D, X> Contact<T, HertzLaw<T, D, Ring<T>, X>, Coulomb<T>> {
    /// The same scene with a peeling moment of strength lambda >= 0 (N m), which is proportional to the damping of the ring
    /// (B10).
    ///
    /// # Errors
    /// A strength outside its range.
    ///
    /// ```
    /// use microimpact::{Sphere, Stiffness, contact::Contact};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?)
    ///     .with_ring(10.0, 1.0)?
    ///     .with_friction(0.1)?;
    /// assert!(scene.with_peeling(-1.0).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_peeling(self, lambda: T) -> Result<Contact<T, HertzLaw<T, D, Ring<T>, X>, Peeling<T>>, InputError> {
        Ok(Contact { sphere: self.sphere, law: self.law, surface: Peeling::new(self.surface, lambda)? })
    }
}

impl<T: Real, L: ContactLaw<T>> Contact<T, L, Coulomb<T>> {
    /// The same scene with tangential compliance: the contact sticks elastically, with the stiffness k_t = chi (3/2) K a, and slips
    /// where friction is exhausted.
    ///
    /// It goes with Hertz's contact without adhesion and external force, with hysteretic damping or none, and with the methods
    /// [`Adaptive`](super::Adaptive), [`Collocation`](super::Collocation) and [`FixedCost`](super::FixedCost). For
    /// [`RungeKuttaGill`](super::RungeKuttaGill) the status is [`Unsupported`](Status::Unsupported).
    ///
    /// # Errors
    /// A stiffness ratio chi outside 1e-3 to 1e3, or another law of contact.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Parameter, Sphere, Stiffness};
    ///
    /// // A ball of alumina, at 20 degrees from the normal (Kharaz, Gorham and Salman 2001).
    /// let chi = 2.0 * (1.0 - 0.23) / (2.0 - 0.23);
    /// let scene = Contact::hertz(Sphere::solid(2.5e-3, 4000.0)?, Stiffness::new(2.6e11)?).with_friction(0.092)?;
    /// let speed = 20f64.to_radians().tan();
    /// let motion = NormalMotion::new(1.0)?.with_tangential(speed)?;
    /// let after = scene.with_compliance(chi)?.solve(&motion, &Adaptive::new(1e-9)?)?.tangential;
    /// assert!((after.velocity() / speed - 0.62).abs() < 0.01);
    /// // With adhesion the compliance of a contact is not known as well.
    /// let refused = scene.with_dmt(0.1)?.with_compliance(chi).unwrap_err();
    /// assert_eq!(refused.parameter, Parameter::StiffnessRatio);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_compliance(self, stiffness_ratio: T) -> Result<Contact<T, L, Compliance<T>>, InputError> {
        let surface = Compliance::new(self.surface, stiffness_ratio)?.under(&self.law)?;
        Ok(Contact { sphere: self.sphere, law: self.law, surface })
    }
}

impl<T: Real, L> Contact<T, L, Compliance<T>> {
    /// The same scene with another rule for the element while the contact shrinks.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, Unloading};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?)
    ///     .with_friction(0.5)?
    ///     .with_compliance(0.85)?;
    /// let slip_after = |unloading| -> Result<f64, microimpact::InputError> {
    ///     let motion = NormalMotion::new(1.0)?.with_tangential(0.1)?;
    ///     Ok(scene.with_unloading(unloading).solve(&motion, &Adaptive::new(1e-9)?)?.tangential.slip())
    /// };
    /// assert!(slip_after(Unloading::Incremental)?.abs() > slip_after(Unloading::Rescaled)?.abs());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[must_use]
    pub fn with_unloading(self, unloading: Unloading) -> Self {
        Self { surface: self.surface.with_unloading(unloading), ..self }
    }
}

impl<T: Real> AnyScene<T> {
    /// The same scene with a peeling moment of strength lambda >= 0 (N m).
    ///
    /// # Errors
    /// A strength outside its range, or not zero where the law has no ring.
    ///
    /// ```
    /// use microimpact::contact::{AnyLaw, Contact};
    /// use microimpact::{Sphere, Stiffness};
    ///
    /// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// let with_peeling = |law: AnyLaw<f64>| Contact::new(sphere, law).with_friction(0.1)?.with_peeling(1e-12);
    /// assert!(with_peeling(AnyLaw::ring(stiffness, 10.0, 1.0)?).is_ok());
    /// assert!(with_peeling(AnyLaw::hertz(stiffness)).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn with_peeling(self, lambda: T) -> Result<Contact<T, AnyLaw<T>, Peeling<T>>, InputError> {
        let Self { sphere, law, surface } = self;
        let surface = Peeling::new(surface, lambda)?;
        if lambda > T::ZERO && !matches!(law, AnyLaw::Ring(_)) {
            return Err(InputError {
                parameter: Parameter::PeelingMoment,
                fault: Fault::OtherLaw,
                value: lambda.to_f64() as f32,
            });
        }
        Ok(Contact { sphere, law, surface })
    }
}

impl<T: Real, L: ContactLaw<T>, S> Contact<T, L, S> {
    /// The impact of a sphere that arrives with the motion `before`: whether it rebounds, and the velocities
    /// after it.
    ///
    /// # Errors
    /// Forces so different in size that the motion cannot be represented.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Outcome, Sphere, Stiffness};
    ///
    /// // A sphere of 5 um diameter, as in figure 6, is captured at 5 m/s and rebounds at 8 m/s.
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?;
    /// let method = Adaptive::new(1e-6)?;
    /// assert_eq!(scene.solve(&NormalMotion::new(5.0)?, &method)?.normal.outcome(), Some(Outcome::Capture));
    /// assert_eq!(scene.solve(&NormalMotion::new(8.0)?, &method)?.normal.outcome(), Some(Outcome::Rebound));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn solve<B, M>(&self, before: &B, method: &M) -> Result<SimulatedImpact<T, S::After>, InputError>
    where
        B: Approach<T>,
        S: Surface<T, B>,
        M: Method<T>,
    {
        Ok(self.solve_for(before, method, ())?.0)
    }

    /// The impact as by [`solve`](Self::solve), and the outputs asked for: [`Times`](super::Times),
    /// [`Impulses`](super::Impulses), [`Works`](super::Works), [`Energy`](super::Energy), [`Slip`](super::Slip),
    /// [`Recording`](super::Recording), or a tuple of them. What is not asked for is not computed.
    ///
    /// With an output a captured sphere is followed until it first turns back; [`solve_to_rest`](Self::solve_to_rest) goes on.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, Times};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
    /// let (impact, times) = scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9_f64)?, Times)?;
    /// assert!(impact.normal.overall_restitution() < 1.0);
    /// assert!(times.contact.unwrap() > 2.0 * times.peak.unwrap());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn solve_for<B: Approach<T>, O: Output<T, S::Start>>(
        &self,
        before: &B,
        method: &impl Method<T>,
        outputs: O,
    ) -> Result<(SimulatedImpact<T, S::After>, O::Result), InputError>
    where
        S: Surface<T, B>,
    {
        let (law, units, approach) = self.in_units_of(before)?;
        let start = self.surface.start(before, &self.sphere, &law, &units)?;
        let mut observer = (outputs.begin(&start), S::observer(&start));
        let path = method.solve(&law, units.energy, &mut observer);
        let (observed, surface) = observer;
        let impact = SimulatedImpact {
            normal: NormalContact::new(&path, approach, &law, &units),
            tangential: S::after(&surface, &path, &self.sphere, &units),
            run: RunReport::new(&path),
        };
        let end = Ended { law: &law, path: &path, sphere: &self.sphere, units: &units };
        Ok((impact, outputs.finish(observed, &end)))
    }

    /// The normal motion alone: outcome and rebound speed, without what happens along the surface.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let contact = scene.solve_normal(&NormalMotion::new(2.8)?, &Adaptive::new(1e-6)?)?;
    /// assert!((contact.overall_restitution() - 0.62_f64).abs() < 0.001);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    #[inline]
    pub fn solve_normal(
        &self,
        before: &impl Approach<T>,
        method: &impl Method<T>,
    ) -> Result<NormalContact<T>, InputError> {
        let (law, units, approach) = self.in_units_of(before)?;
        let path = method.solve(&law, units.energy, &mut ());
        Ok(NormalContact::new(&path, approach, &law, &units))
    }

    /// The impact as by [`solve_for`](Self::solve_for). A captured sphere is followed, with its outputs, until
    /// it rests by the `criterion`.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact, RestCriterion, Slip};
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let (method, criterion) = (Adaptive::new(1e-9)?, RestCriterion::new(1e-6, 1000)?);
    /// let motion = NormalMotion::new(1.0)?.with_tangential(70.0)?;
    /// // It still slides where it first turns back. At rest along the normal it rolls, with 5/7 of its velocity.
    /// assert!(scene.solve_for(&motion, &method, Slip)?.1.slides);
    /// let settled = scene.solve_to_rest(&motion, &method, &criterion, Slip)?;
    /// assert!(!settled.outputs.slides);
    /// assert!((settled.outputs.velocity - 50.0_f64).abs() < 1e-9);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn solve_to_rest<B, M, O>(
        &self,
        before: &B,
        method: &M,
        criterion: &RestCriterion<T>,
        outputs: O,
    ) -> Result<SettledImpact<T, S::After, O::Result>, InputError>
    where
        B: Approach<T>,
        S: Surface<T, B>,
        M: ErrorControl<T>,
        O: Output<T, S::Start>,
    {
        let (law, units, approach) = self.in_units_of(before)?;
        let start = self.surface.start(before, &self.sphere, &law, &units)?;
        let mut observer = (Times::new(), (outputs.begin(&start), S::observer(&start)));
        let (path, settling) = method.solve_to_rest(&law, units.energy, &mut observer, criterion);
        let (times, (observed, surface)) = observer;
        let mut run = RunReport::new(&path);
        if settling.as_ref().is_some_and(|settling| !settling.at_rest) {
            run.status = Status::BudgetSpent;
        }
        let impact = SimulatedImpact {
            normal: NormalContact::new(&path, approach, &law, &units),
            tangential: S::after(&surface, &path, &self.sphere, &units),
            run,
        };
        let end = Ended { law: &law, path: &path, sphere: &self.sphere, units: &units };
        let outputs = outputs.finish(observed, &end);
        let motion = settling.map(|settling| settling.in_units(times.now, &units));
        Ok(SettledImpact { impact, motion, outputs })
    }

    /// The largest number of trial speeds of [`critical_speed`](Self::critical_speed). Each trial follows two paths of at
    /// most 160 intervals. Most scenes need four to eight trials, with about four intervals for each path.
    ///
    /// ```
    /// use microimpact::contact::{Contact, HertzLaw};
    ///
    /// assert_eq!(Contact::<f32, HertzLaw<f32>>::MOST_TRIALS, 88);
    /// ```
    pub const MOST_TRIALS: u32 = critical_search::MOST_TRIALS;

    /// The approach speed, m/s, that separates capture from rebound (B6), to the relative tolerance of `method`. In single
    /// precision rounding leaves an error of up to 1e-3 where damping is so strong that little depends on the speed, and of tens of
    /// percent, rarely of a factor, where it takes all but a millionth of the energy; a well that an external force has flattened to a millionth may not be
    /// seen.
    ///
    /// A sphere that just separates arrived with exactly the energy that damping dissipates. That energy grows with the
    /// damping, and the damping falls with the speed (B4), so there is at most one such speed. A law of your own must have
    /// only one, too. A force out of the surface is a barrier to
    /// slow spheres, which then turn back before adhesion holds them: the critical speed is the largest that attaches.
    ///
    /// Where nothing holds a sphere, or nothing takes energy from it, or every speed of the range of
    /// [`Parameter::ApproachSpeed`] rebounds, the answer is [`CriticalSpeed::AlwaysRebounds`]; if a sphere is captured
    /// even at the largest of them, [`CriticalSpeed::NeverRebounds`]. That is said only of a scene whose forces are within their ranges at
    /// 1 m/s.
    ///
    /// The search makes at most 88 trials of a speed, and few as a rule. A trial is the path of an impact, and one in reverse, of at most
    /// [`Collocation::MOST_INTERVALS`](super::Collocation::MOST_INTERVALS) intervals each. A
    /// [`CriticalSpeedSearch`](super::CriticalSpeedSearch) makes them in steps.
    ///
    /// # Errors
    /// A ratio of the scene's forces outside its range at the critical speed, or, where no speed rebounds, at 1 m/s.
    /// [`Parameter::Tolerance`] where rounding does not allow even the largest tolerance.
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{CriticalSpeed, Sphere, Stiffness};
    ///
    /// // A sphere of 5 um diameter, as in figure 6.
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
    /// let method = Adaptive::new(1e-9_f64)?;
    /// assert_eq!(scene.critical_speed(&method)?, CriticalSpeed::AlwaysRebounds);
    /// let CriticalSpeed::At(speed) = scene.with_ring(250.0, 6.25)?.critical_speed(&method)? else { panic!() };
    /// assert!((speed - 5.159_566_762).abs() < 1e-8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn critical_speed(&self, method: &impl ErrorControl<T>) -> Result<CriticalSpeed<T>, InputError> {
        let try_speed = |speed, allowed| self.try_speed(speed, allowed, method);
        self.suited(critical_search::critical_speed(self.first_trial(), method.tolerance(), try_speed)?)
    }

    /// The critical speed, unless no speed rebounds because none that occurs suits the scene: a stiffness may be in the wrong unit.
    pub(super) fn suited(&self, critical: CriticalSpeed<T>) -> Result<CriticalSpeed<T>, InputError> {
        if critical == CriticalSpeed::NeverRebounds {
            self.law.in_units(&self.sphere, T::constant(ORDINARY_SPEED))?;
        }
        Ok(critical)
    }

    /// The first speed, m/s, that a search for the critical speed tries.
    #[inline]
    pub(super) fn first_trial(&self) -> T {
        self.law.speed_of_adhesion(&self.sphere)
    }

    /// What becomes of a sphere that arrives with a speed (m/s), to a tolerance.
    #[inline]
    pub(super) fn try_speed(
        &self,
        speed: T,
        tolerance: T,
        method: &impl ErrorControl<T>,
    ) -> Result<Trial<T>, InputError> {
        let (law, units) = self.law.in_units(&self.sphere, speed)?;
        Ok(method.try_energy(tolerance, &law, units.energy))
    }

    /// The class of the impact of a sphere that arrives with the motion `before`, with its margins as in the rigid-body
    /// model: approach over [`critical_speed`](Self::critical_speed) and, with friction, the change of
    /// slip that friction can produce, divided by the slip. `None` where the method found no solution.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::{Adaptive, Contact};
    /// use microimpact::{Class, NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(2.5e-6, 2600.0)?, Stiffness::new(7.5e10)?)
    ///     .with_damping(10.5)?
    ///     .with_ring(250.0, 6.25)?
    ///     .with_friction(0.1)?;
    /// let motion = NormalMotion::new(8.0)?.with_tangential(1.0)?;
    /// let result = scene.classify(&motion, &Adaptive::new(1e-9_f64)?)?.unwrap();
    /// assert_eq!(result.class(), Class::ReboundRolling);
    /// assert!((result.speed_over_critical.unwrap() - 8.0 / 5.159_566_762).abs() < 1e-8);
    /// assert!(result.contact.friction_over_limit.unwrap() > 1.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn classify<B, M>(
        &self,
        before: &B,
        method: &M,
    ) -> Result<Option<Classification<T, <S::After as Classified<T>>::Contact>>, InputError>
    where
        B: Approach<T>,
        S: Surface<T, B, After: Classified<T>>,
        M: ErrorControl<T>,
    {
        let SimulatedImpact { normal, tangential, .. } = self.solve(before, method)?;
        let Some(outcome) = normal.outcome() else {
            return Ok(None);
        };
        let speed_over_critical = match self.critical_speed(method)? {
            CriticalSpeed::At(speed) => Some(before.normal().speed().saturating_div(speed)),
            CriticalSpeed::AlwaysRebounds | CriticalSpeed::NeverRebounds => None,
        };
        Ok(Some(Classification { outcome, speed_over_critical, contact: tangential.contact() }))
    }

    /// The law in units of the impact of a sphere that arrives with a motion, those units, and the approach speed.
    #[inline]
    pub(super) fn in_units_of<B: Approach<T>>(&self, before: &B) -> Result<(L, Units<T>, T), InputError> {
        let (speed, force) = (before.normal().speed(), self.law.external_force());
        if B::OF_TWO_BODIES && force != T::ZERO {
            let value = force.to_f64() as f32;
            return Err(InputError { parameter: Parameter::ExternalForce, fault: Fault::TwoBodies, value });
        }
        let (law, units) = self.law.in_units(&self.sphere, speed)?;
        Ok((law, units, speed))
    }

    /// The law in units of the impact of a sphere with an approach speed (m/s), and those units.
    pub(super) fn in_units(&self, approach: T) -> Result<(L, Units<T>), InputError> {
        self.law.in_units(&self.sphere, approach)
    }
}

/// Velocities after an impact as a part of a [`Classification`].
pub trait Classified<T> {
    /// `()` or [`ContactClass`].
    type Contact;

    /// How the contact point moves, and its margin.
    fn contact(&self) -> Self::Contact;
}

impl<T> Classified<T> for () {
    type Contact = ();

    #[inline]
    fn contact(&self) {}
}

impl<T: Real> Classified<T> for TangentialVelocities<T> {
    type Contact = ContactClass<T>;

    #[inline]
    fn contact(&self) -> ContactClass<T> {
        self.class()
    }
}

impl<T: Real> Classified<T> for CompliantVelocities<T> {
    type Contact = ContactClass<T>;

    /// Without a margin: the slip of a compliant contact ends and begins again.
    #[inline]
    fn contact(&self) -> ContactClass<T> {
        ContactClass { motion: self.motion(), friction_over_limit: None }
    }
}

impl<T, D, A, X, S> Contact<T, HertzLaw<T, D, A, X>, S>
where
    T: Real,
    D: ProportionalDamping<T>,
    A: RingStrength<T>,
    X: Attraction<T>,
{
    /// The dimensionless groups of the impact of a sphere that arrives with the motion `before`; the external force is not
    /// among them.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    ///
    /// ```
    /// use microimpact::contact::Contact;
    /// use microimpact::{NormalMotion, Sphere, Stiffness};
    ///
    /// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
    /// assert_eq!(scene.groups(&NormalMotion::new(1.0)?)?.adhesion, 0.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn groups(&self, before: &impl Approach<T>) -> Result<Groups<T>, InputError> {
        let (law, units, _) = self.in_units_of(before)?;
        Ok(law.groups(units.energy))
    }
}
