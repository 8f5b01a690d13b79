//! What a simulation can be asked for besides how it ends: each a type that costs nothing where it is not named.

use super::integrals::{Impulses, Times, Works};
use super::motion::{End, NormalPath};
use super::observer::Observer;
use super::scaled::Scaled;
use crate::{Real, Sphere};

/// Something that a simulation can be asked for besides how it ends; chosen by its type, and absent where not named.
///
/// ```
/// use microimpact::simulation::{ContactTimes, Output};
///
/// // Times of separation and peak are all that has to be carried along for them.
/// assert_eq!(size_of::<<ContactTimes<f64> as Output<f64>>::Observer>(), 16);
/// ```
pub trait Output<T: Real>: Sized {
    /// What is integrated along the motion.
    type Observer: Observer<T>;

    /// The state at first touch.
    fn begin() -> Self::Observer;

    /// The output in SI units.
    fn finish(observer: Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self;
}

impl<T: Real> Output<T> for () {
    type Observer = ();

    fn begin() {}

    fn finish((): (), _path: &NormalPath<T>, _sphere: &Sphere<T>, _units: &Scaled<T>) {}
}

impl<T: Real, A: Output<T>, B: Output<T>> Output<T> for (A, B) {
    type Observer = (A::Observer, B::Observer);

    fn begin() -> Self::Observer {
        (A::begin(), B::begin())
    }

    fn finish((a, b): Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        (A::finish(a, path, sphere, units), B::finish(b, path, sphere, units))
    }
}

/// All outputs of a simulation.
///
/// ```
/// use microimpact::simulation::{Collocation, Everything, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let scene = Simulation::new(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
/// let Everything { times, impulses, works } =
///     scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?.outputs;
/// assert!(times.contact.is_some() && impulses.elastic > 0.0 && works.material > 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Everything<T> {
    /// When the peak and the separation came.
    pub times: ContactTimes<T>,
    /// Impulses of the elastic force and of adhesion.
    pub impulses: ContactImpulses<T>,
    /// Works of the two kinds of damping.
    pub works: ContactWorks<T>,
}

impl<T: Real> Output<T> for Everything<T> {
    type Observer = (Times<T>, (Impulses<T>, Works<T>));

    fn begin() -> Self::Observer {
        (Times::new(), (Impulses::new(), Works::new()))
    }

    fn finish(observer: Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        let (times, (impulses, works)) = observer;
        Self {
            times: Output::finish(times, path, sphere, units),
            impulses: Output::finish(impulses, path, sphere, units),
            works: Output::finish(works, path, sphere, units),
        }
    }
}

/// Times of a simulated impact, s, from first touch.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{Hertz, NormalMotion, Sphere, Stiffness};
///
/// let (sphere, stiffness) = (Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?);
/// let motion = NormalMotion::new(1.0)?;
/// let times = Simulation::new(sphere, stiffness).impact(&Collocation::<9, f64>::new(1e-9)?, &motion)?.outputs.times;
/// assert!((times.contact.unwrap() / Hertz::new(&sphere, stiffness, &motion).duration - 1.0).abs() < 1e-7);
/// assert!((times.peak.unwrap() / times.contact.unwrap() - 0.5).abs() < 1e-7);
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

impl<T: Real> Output<T> for ContactTimes<T> {
    type Observer = Times<T>;

    fn begin() -> Times<T> {
        Times::new()
    }

    fn finish(times: Times<T>, path: &NormalPath<T>, _sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        Self::new(&times, path, units)
    }
}

impl<T: Real> ContactTimes<T> {
    pub(super) fn new(times: &Times<T>, path: &NormalPath<T>, units: &Scaled<T>) -> Self {
        let unit = units.time();
        Self {
            peak: (path.peak > T::ZERO).then(|| times.peak * unit),
            contact: (path.end == End::Separation).then(|| times.now * unit),
        }
    }
}

/// Normal impulses of a simulated impact, N s.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// // Without adhesion and damping the elastic force reverses the momentum.
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = Simulation::new(sphere, Stiffness::new(1e10)?);
/// let impulses = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(1.0)?)?.outputs.impulses;
/// assert!((impulses.elastic / (2.0 * sphere.mass()) - 1.0).abs() < 1e-8);
/// assert_eq!(impulses.adhesion_rebound, 0.0);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactImpulses<T> {
    /// Integral of the elastic force sqrt(r) K delta^(3/2).
    pub elastic: T,
    /// Size of the impulse of adhesion on rebound, its damping included.
    pub adhesion_rebound: T,
}

impl<T: Real> Output<T> for ContactImpulses<T> {
    type Observer = Impulses<T>;

    fn begin() -> Impulses<T> {
        Impulses::new()
    }

    fn finish(impulses: Impulses<T>, _path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        Self::new(&impulses, sphere, units)
    }
}

impl<T: Real> ContactImpulses<T> {
    pub(super) fn new(impulses: &Impulses<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        let unit = sphere.mass() * units.speed;
        Self { elastic: impulses.elastic * unit, adhesion_rebound: impulses.adhesion_rebound * unit }
    }
}

/// Energies that the two kinds of damping take from the normal motion, J.
///
/// ```
/// use microimpact::simulation::{Collocation, Simulation};
/// use microimpact::{NormalMotion, Sphere, Stiffness};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = Simulation::new(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)?;
/// let impact = scene.impact(&Collocation::<9, f64>::new(1e-9)?, &NormalMotion::new(2.8)?)?;
/// let e = impact.normal.overall_restitution();
/// let lost = 0.5 * sphere.mass() * 2.8 * 2.8 * (1.0 - e * e);
/// assert!(((impact.outputs.works.material + impact.outputs.works.adhesion) / lost - 1.0).abs() < 1e-8);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactWorks<T> {
    /// Lost to the damping in the materials.
    pub material: T,
    /// Lost to the damping of adhesion.
    pub adhesion: T,
}

impl<T: Real> Output<T> for ContactWorks<T> {
    type Observer = Works<T>;

    fn begin() -> Works<T> {
        Works::new()
    }

    fn finish(works: Works<T>, _path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        Self::new(&works, sphere, units)
    }
}

impl<T: Real> ContactWorks<T> {
    pub(super) fn new(works: &Works<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> Self {
        // In this order no factor leaves the range of single precision.
        let energy = |work: T| sphere.mass() * units.speed * (units.speed * work);
        Self { material: energy(works.material), adhesion: energy(works.adhesion) }
    }
}
