//! What a simulation can be asked for besides how it ends: each a value that costs nothing where it is not given.

use core::f64::consts::PI;

use super::along::{CompliantMotion, PressingForce, SlipStart, TangentialMotion};
use super::law::{ContactLaw, Units};
use super::solve::integrals;
use super::solve::observer::Observer;
use super::solve::path::{End, NormalPath};
use super::solve::quantities;
use crate::rigid::EnergyLedger;
use crate::{Real, Sphere};

/// Something that a simulation can be asked for besides how it ends. `S` is the state along the surface before contact.
///
/// Two to four outputs make a tuple.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, Impulses, Times};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
/// let (impact, (times, impulses)) =
///     scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9_f64)?, (Times, Impulses))?;
/// assert!(times.contact.is_some() && impulses.elastic > 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no output of this scene",
    label = "outputs are `Times`, `Impulses`, `Works`, `Energy`, `Recording` and `Slip`"
)]
pub trait Output<T: Real, S> {
    /// What is integrated along the motion.
    type Observer: Observer<T>;

    /// What comes out.
    type Result;

    /// The state at first contact.
    fn begin(&self, start: &S) -> Self::Observer;

    /// The output in SI units.
    fn finish<L: ContactLaw<T>>(&self, observer: Self::Observer, end: &Ended<'_, T, L>) -> Self::Result;
}

/// A motion that has come to its end, and its units.
#[derive(Clone, Copy, Debug)]
pub struct Ended<'a, T, L> {
    pub(super) law: &'a L,
    pub(super) path: &'a NormalPath<T>,
    pub(super) sphere: &'a Sphere<T>,
    pub(super) units: &'a Units<T>,
}

/// No output.
impl<T: Real, S> Output<T, S> for () {
    type Observer = ();
    type Result = ();

    #[inline]
    fn begin(&self, _start: &S) {}

    #[inline]
    fn finish<L: ContactLaw<T>>(&self, (): (), _end: &Ended<'_, T, L>) {}
}

/// Outputs side by side. Observers come in pairs, so that those of a longer tuple are nested.
macro_rules! side_by_side {
    ($($output:ident $index:tt),*; $observer:ty, $nested:pat, $($begin:tt)*) => {
        impl<T: Real, S, $($output: Output<T, S>),*> Output<T, S> for ($($output,)*) {
            type Observer = $observer;
            type Result = ($($output::Result,)*);

            #[inline]
            fn begin(&self, start: &S) -> Self::Observer {
                let begun = ($(self.$index.begin(start),)*);
                ($($begin)*)(begun)
            }

            #[inline]
            #[allow(non_snake_case)] // an observer is called as its output
            fn finish<L: ContactLaw<T>>(&self, $nested: Self::Observer, end: &Ended<'_, T, L>) -> Self::Result {
                ($(self.$index.finish($output, end),)*)
            }
        }
    };
}

side_by_side!(A 0, B 1; (A::Observer, B::Observer), (A, B), |begun| begun);
side_by_side!(A 0, B 1, C 2; (A::Observer, (B::Observer, C::Observer)), (A, (B, C)), |(a, b, c)| (a, (b, c)));
side_by_side!(
    A 0, B 1, C 2, D 3;
    ((A::Observer, B::Observer), (C::Observer, D::Observer)), ((A, B), (C, D)), |(a, b, c, d)| ((a, b), (c, d))
);

/// Asks for [`ContactTimes`].
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Times};
/// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
///
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let motion = NormalMotion::new(1.0)?;
/// let (_, times) = Contact::hertz(sphere, stiffness).solve_for(&motion, &Collocation::<9, f64>::new(1e-9)?, Times)?;
/// assert!((times.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0).abs() < 1e-7);
/// assert!((times.peak.unwrap() / times.contact.unwrap() - 0.5).abs() < 1e-7);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Times;

/// Times of a simulated impact, s, from first contact.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, ContactTimes, Times};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let (_, times): (_, ContactTimes<f64>) =
///     scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9)?, Times)?;
/// assert!(times.peak < times.contact);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactTimes<T> {
    /// Time of the peak; `None` where there is none.
    pub peak: Option<T>,
    /// Time of separation; `None` for a capture.
    pub contact: Option<T>,
}

impl<T: Real> ContactTimes<T> {
    pub(super) fn new(times: &quantities::Times<T>, path: &NormalPath<T>, units: &Units<T>) -> Self {
        let unit = units.time();
        Self {
            peak: (path.peak > T::ZERO).then(|| times.peak * unit),
            contact: (path.end == End::Separation).then(|| times.now * unit),
        }
    }
}

impl<T: Real, S> Output<T, S> for Times {
    type Observer = quantities::Times<T>;
    type Result = ContactTimes<T>;

    #[inline]
    fn begin(&self, _start: &S) -> Self::Observer {
        quantities::Times::new()
    }

    fn finish<L: ContactLaw<T>>(&self, times: Self::Observer, end: &Ended<'_, T, L>) -> ContactTimes<T> {
        ContactTimes::new(&times, end.path, end.units)
    }
}

/// Asks for [`ContactImpulses`].
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Impulses};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Without adhesion and damping the elastic force reverses the momentum.
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(1e10)?);
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let (_, impulses) = scene.solve_for(&NormalMotion::new(1.0)?, &method, Impulses)?;
/// assert!((impulses.elastic / (2.0 * sphere.mass()) - 1.0).abs() < 1e-8);
/// assert_eq!(impulses.adhesion_rebound, 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Impulses;

/// Normal impulses of a simulated impact, N s.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, ContactImpulses, Impulses};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let (_, impulses): (_, ContactImpulses<f64>) =
///     scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9)?, Impulses)?;
/// assert!(impulses.elastic > 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactImpulses<T> {
    /// Integral of the elastic force.
    pub elastic: T,
    /// Size of the impulse of adhesion on rebound, its damping included.
    pub adhesion_rebound: T,
}

impl<T: Real> ContactImpulses<T> {
    pub(super) fn new(impulses: &integrals::Impulses<T>, sphere: &Sphere<T>, units: &Units<T>) -> Self {
        let unit = sphere.mass() * units.speed;
        Self { elastic: impulses.elastic * unit, adhesion_rebound: impulses.adhesion_rebound * unit }
    }
}

impl<T: Real, S> Output<T, S> for Impulses {
    type Observer = integrals::Impulses<T>;
    type Result = ContactImpulses<T>;

    #[inline]
    fn begin(&self, _start: &S) -> Self::Observer {
        integrals::Impulses::new()
    }

    fn finish<L: ContactLaw<T>>(&self, impulses: Self::Observer, end: &Ended<'_, T, L>) -> ContactImpulses<T> {
        ContactImpulses::new(&impulses, end.sphere, end.units)
    }
}

/// Asks for [`ContactWorks`].
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Works};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
/// let (impact, works) = scene.solve_for(&NormalMotion::new(2.8)?, &Collocation::<9, f64>::new(1e-9)?, Works)?;
/// let e = impact.normal.overall_restitution();
/// let lost = 0.5 * sphere.mass() * 2.8 * 2.8 * (1.0 - e * e);
/// assert!(((works.material + works.adhesion) / lost - 1.0).abs() < 1e-8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Works;

/// Energies that the normal motion loses to the materials and to adhesion, J: to their damping, and what either keeps at separation.
///
/// Those of a captured sphere are lost until it first turns back. Of a rebound they add up to the loss of kinetic energy along the
/// normal.
///
/// ```
/// use microimpact::contact::{Adaptive, Contact, ContactWorks, Works};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let (_, works): (_, ContactWorks<f64>) =
///     scene.solve_for(&NormalMotion::new(1.0)?, &Adaptive::new(1e-9)?, Works)?;
/// assert_eq!((works.material, works.adhesion), (0.0, 0.0)); // nothing damps here
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactWorks<T> {
    /// Lost to the materials: to their damping, and what they have not given back where damping cancels their force.
    pub material: T,
    /// Lost to adhesion: to its damping, and what lies between first contact and the end of contact if it pulls farther out than it
    /// caught the sphere, as that of Johnson, Kendall and Roberts does.
    pub adhesion: T,
}

impl<T: Real> ContactWorks<T> {
    fn new<L: ContactLaw<T>>(works: &integrals::Works<T>, end: &Ended<'_, T, L>) -> Self {
        let (mut material, mut adhesion) = (works.material, works.adhesion);
        if end.path.end == End::Separation {
            if end.law.release_speed(end.law.end()).is_some() {
                material = end.units.energy - end.path.energy;
            }
            adhesion = adhesion - end.law.potential(end.law.start());
        }
        // In this order no factor leaves the range of single precision.
        let energy = |work: T| end.sphere.mass() * end.units.speed * (end.units.speed * work);
        Self { material: energy(material), adhesion: energy(adhesion) }
    }
}

impl<T: Real, S> Output<T, S> for Works {
    type Observer = integrals::Works<T>;
    type Result = ContactWorks<T>;

    #[inline]
    fn begin(&self, _start: &S) -> Self::Observer {
        integrals::Works::new()
    }

    fn finish<L: ContactLaw<T>>(&self, works: Self::Observer, end: &Ended<'_, T, L>) -> ContactWorks<T> {
        ContactWorks::new(&works, end)
    }
}

/// Asks for the energy ledger of a rebound: where the kinetic energy went. The answer is `None` for a captured sphere, which
/// has not yet come to rest, and where there is no solution.
///
/// The works of damping are integrals of their own, so the difference between the losses and the change of the kinetic
/// energy shows the error of the run. The external force is conservative and gives back what it takes.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Energy};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
/// let (_, ledger) = scene.solve_for(&before, &Collocation::<12, f64>::new(1e-12)?, Energy)?;
/// let ledger = ledger.unwrap();
/// assert!((ledger.lost() / (ledger.before - ledger.after) - 1.0).abs() < 1e-12);
/// assert!((ledger.adhesion - 4.828e-13).abs() < 1e-16); // the paper's work of adhesion
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Energy;

impl Energy {
    /// The ledger, from the energies along the surface: kinetic after, and taken by friction and peeling, in units of the mass and the
    /// square of a speed in units of the impact.
    fn ledger<T: Real, L: ContactLaw<T>>(
        works: &integrals::Works<T>,
        (along, energy_speed): ([T; 3], T),
        end: &Ended<'_, T, L>,
    ) -> Option<EnergyLedger<T>> {
        if end.path.end != End::Separation {
            return None;
        }
        let joules = |energy: T| end.sphere.mass() * end.units.speed * (end.units.speed * energy);
        let unit = end.units.speed * energy_speed;
        let [after, friction, peeling] = along.map(|energy| end.sphere.mass() * unit * (unit * energy));
        let works = ContactWorks::new(works, end);
        Some(EnergyLedger {
            before: joules(end.units.energy) + after + friction + peeling,
            after: joules(end.path.energy.max(T::ZERO)) + after,
            material: works.material,
            adhesion: works.adhesion,
            friction,
            rolling: peeling,
            external: T::ZERO,
        })
    }
}

impl<T: Real> Output<T, ()> for Energy {
    type Observer = integrals::Works<T>;
    type Result = Option<EnergyLedger<T>>;

    #[inline]
    fn begin(&self, (): &()) -> Self::Observer {
        integrals::Works::new()
    }

    fn finish<L: ContactLaw<T>>(&self, works: Self::Observer, end: &Ended<'_, T, L>) -> Self::Result {
        Self::ledger(&works, ([T::ZERO; 3], T::ONE), end)
    }
}

impl<T: Real, P: PressingForce<T>, const PEELS: bool> Output<T, SlipStart<T, P, PEELS>> for Energy {
    type Observer = (integrals::Works<T>, TangentialMotion<T, P, PEELS>);
    type Result = Option<EnergyLedger<T>>;

    #[inline]
    fn begin(&self, start: &SlipStart<T, P, PEELS>) -> Self::Observer {
        (integrals::Works::new(), TangentialMotion::new(start))
    }

    fn finish<L: ContactLaw<T>>(&self, (works, motion): Self::Observer, end: &Ended<'_, T, L>) -> Self::Result {
        let along = [motion.energy(), motion.friction_loss, motion.peeling_loss];
        Self::ledger(&works, (along, motion.energy_speed), end)
    }
}

impl<T: Real> Output<T, CompliantMotion<T>> for Energy {
    type Observer = (integrals::Works<T>, CompliantMotion<T>);
    type Result = Option<EnergyLedger<T>>;

    #[inline]
    fn begin(&self, start: &CompliantMotion<T>) -> Self::Observer {
        (integrals::Works::new(), *start)
    }

    fn finish<L: ContactLaw<T>>(&self, (works, motion): Self::Observer, end: &Ended<'_, T, L>) -> Self::Result {
        // At separation the element holds no energy.
        let [before, after] = motion.energies();
        Self::ledger(&works, ([after, before - after, T::ZERO], motion.energy_speed()), end)
    }
}

/// Asks for [`SlipHistory`]. A scene without friction has none, and gives `()`. With tangential compliance slip begins again before
/// separation, so that it does not end.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Slip};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_friction(0.5)?;
/// let straight = NormalMotion::new(1.0)?.with_tangential(0.0)?;
/// let (_, slip) = scene.solve_for(&straight, &Collocation::<9, f64>::new(1e-9)?, Slip)?;
/// assert_eq!(slip.rolls_from, Some(0.0));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Slip;

/// The motion along the surface during contact, to separation or, for a captured sphere, to where it was followed.
///
/// ```
/// use microimpact::contact::{Collocation, Contact, Slip, SlipHistory};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Table 1: the sphere turns by 0.12 degrees during contact.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?
///     .with_friction(0.1)?;
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?.with_spin(&sphere, 1.454e5)?;
/// let (_, slip): (_, SlipHistory<f64>) =
///     scene.solve_for(&before, &Collocation::<9, f64>::new(1e-9)?, Slip)?;
/// assert!((slip.rotation_degrees() - 0.1234).abs() < 1e-4);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SlipHistory<T> {
    /// Whether the contact point still slips there.
    pub slides: bool,
    /// Tangential velocity V_t there, m/s.
    pub velocity: T,
    /// Spin W there, rad/s.
    pub spin: T,
    /// Angle through which the sphere has turned, rad.
    pub rotation: T,
    /// Distance of the centre along the surface, m.
    pub displacement: T,
    /// Time at which the slip ended, s; zero if there was none, `None` if it did not end.
    pub rolls_from: Option<T>,
}

impl<T: Real> SlipHistory<T> {
    /// Rotation in degrees.
    ///
    /// ```
    /// use core::f64::consts::PI;
    /// use microimpact::contact::SlipHistory;
    ///
    /// let turned = SlipHistory {
    ///     slides: false, velocity: 0.0, spin: 0.0, rotation: PI, displacement: 0.0, rolls_from: None,
    /// };
    /// assert!((turned.rotation_degrees() - 180.0).abs() < 1e-12);
    /// ```
    pub fn rotation_degrees(&self) -> T {
        self.rotation * T::constant(180.0 / PI)
    }
}

impl<T: Real> Output<T, ()> for Slip {
    type Observer = ();
    type Result = ();

    #[inline]
    fn begin(&self, (): &()) {}

    #[inline]
    fn finish<L: ContactLaw<T>>(&self, (): (), _end: &Ended<'_, T, L>) {}
}

impl<T: Real, P: PressingForce<T>, const PEELS: bool> Output<T, SlipStart<T, P, PEELS>> for Slip {
    type Observer = TangentialMotion<T, P, PEELS>;
    type Result = SlipHistory<T>;

    #[inline]
    fn begin(&self, start: &SlipStart<T, P, PEELS>) -> Self::Observer {
        TangentialMotion::new(start)
    }

    fn finish<L: ContactLaw<T>>(&self, motion: Self::Observer, end: &Ended<'_, T, L>) -> SlipHistory<T> {
        let (units, radius) = (end.units, end.sphere.radius());
        SlipHistory {
            slides: motion.slides(),
            velocity: motion.velocity * units.speed,
            spin: motion.peripheral * units.speed / radius,
            rotation: motion.rotation * (units.length / radius),
            displacement: motion.displacement * units.length,
            rolls_from: motion.rolls_from.map(|time| time * units.time()),
        }
    }
}

impl<T: Real> Output<T, CompliantMotion<T>> for Slip {
    type Observer = CompliantMotion<T>;
    type Result = SlipHistory<T>;

    #[inline]
    fn begin(&self, start: &CompliantMotion<T>) -> Self::Observer {
        *start
    }

    fn finish<L: ContactLaw<T>>(&self, motion: Self::Observer, end: &Ended<'_, T, L>) -> SlipHistory<T> {
        let (units, radius) = (end.units, end.sphere.radius());
        let ((velocity, peripheral), (displacement, rotation)) = (motion.velocities(), motion.distances());
        SlipHistory {
            slides: motion.moves(),
            velocity: velocity * units.speed,
            spin: peripheral * units.speed / radius,
            rotation: rotation * (units.length / radius),
            displacement: displacement * units.length,
            rolls_from: (!motion.moves()).then_some(T::ZERO),
        }
    }
}
