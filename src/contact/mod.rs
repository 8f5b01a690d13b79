//! The contact simulation (Appendix B): forces and time during contact, solved to a tolerance.
//!
//! A scene has a law of contact along the normal and, if it needs one, a law along the surface (Coulomb friction with spin, and a
//! peeling moment, B7 to B10). The law along the normal of the paper is Hertz's force with hysteretic damping, ring adhesion and a
//! constant external force (B6); there are [others](#laws-of-contact). Each term is a type, and a scene contains only the terms that you add. The solver follows
//! the kinetic energy against a coordinate in which the normal motion is smooth from first contact to separation. All other
//! results are integrals along this path. [The chapter on the method](method) has the mathematics.
//!
//! # Laws of contact
//! | law | adhesion | in a scene |
//! | --- | --- | --- |
//! | Hertz | none | [`Contact::hertz`] |
//! | Hertz, to zero force | none; contact ends before damping pulls | `.without_tension()` |
//! | Hertz and ring (the paper) | 2 pi a f0, with damping on rebound | `.with_ring(f0, zeta_A)` |
//! | Derjaguin, Muller and Toporov | 2 pi G r | `.with_dmt(G)` |
//! | Johnson, Kendall and Roberts | deforms the sphere; ends at [snap-off or pull-off](JkrEnd) | [`JkrLaw`] |
//!
//! | damping | force for each unit of speed | in a scene |
//! | --- | --- | --- |
//! | none | 0 | |
//! | hysteretic (the paper; Hunt and Crossley) | c_H K a^3/r | `.with_damping(zeta_H)` |
//! | viscoelastic (Kuwabara and Kono) | (3/2) A K a | `.with_viscoelastic_damping(A)` |
//! | constant (Tsuji, Tanaka and Ishida) | alpha sqrt(m K a) | `.with_constant_damping(e)` |
//!
//! Every damping goes with every law, and an external force with all but the second and the last. G is the work of adhesion for
//! each area, twice the surface energy of equal materials.
//!
//! Along the surface acts no friction, Coulomb's friction (`.with_friction(f)`), friction and a peeling moment (`.with_peeling(lambda)`),
//! or friction on a contact that sticks elastically (`.with_compliance(chi)`).
//!
//! # Figures
//! Figures 6 and 7 of the paper, by this simulation:
//!
//! | restitution against approach speed | normal force in time |
//! | --- | --- |
//! | ![Zero below the critical speed, then a steep rise, then a slow fall][figure-6] | ![Attractive at first and at last][figure-7] |
#![cfg_attr(doc, doc = "\n")]
#![cfg_attr(doc, doc = include_str!("../figures.md"))]

mod along;
mod dimensionless;
mod force;
mod lanes;
mod law;
#[cfg(doc)]
#[doc = include_str!("method.md")]
pub mod method {}
mod outputs;
mod result;
mod scene;
mod solve;
mod trajectory;
mod units;

pub use along::{
    Compliance, CompliantVelocities, Peeling, PressingForce, Surface, TangentialVelocities, TotalAndPullOff,
    TotalForce, Unloading,
};
pub use dimensionless::{DimensionlessContact, DimensionlessImpact};
pub use force::ContactForce;
pub use lanes::{OutputInLanes, SurfaceInLanes};
#[cfg(feature = "fixed")]
pub(crate) use law::unit_damping;
pub use law::{
    AnyDamping, AnyForce, AnyLaw, Attraction, ConstantDamping, ConstantForce, ContactLaw, Damping, Dmt, Fraction,
    Groups, HertzLaw, HystereticDamping, JkrEnd, JkrLaw, NoDamping, NoForce, NoTension, ProportionalDamping, Ring,
    RingStrength, Units, ViscoelasticDamping,
};
pub use outputs::{
    ContactImpulses, ContactTimes, ContactWorks, Energy, Impulses, Output, Slip, SlipHistory, Times, Works,
};
pub use result::{NormalContact, SettledImpact, SimulatedImpact};
pub use scene::{Classified, Contact};
pub use solve::{
    Adaptive, AdaptiveNodes, Budgeted, Collocation, CriticalSpeedSearch, ErrorControl, FixedCost, Method, MotionToRest,
    Nodes, PhaseNodes, PhaseSamples, RestCriterion, RunReport, RungeKuttaGill, Status,
};
pub use trajectory::{Recording, Sample, Trajectory};

pub use crate::terms::ElasticForce;
use crate::{Coulomb, NoFriction};

/// An elastic contact with damping, without adhesion and friction.
///
/// ```
/// use microimpact::contact::{Contact, HertzScene};
/// use microimpact::{Sphere, Stiffness};
///
/// struct Detector {
///     scene: HertzScene<f32>,
/// }
/// let scene = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?).with_damping(1.0)?;
/// assert_eq!(Detector { scene }.scene.sphere().radius(), 1e-6);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub type HertzScene<T, S = NoFriction> = Contact<T, HertzLaw<T, HystereticDamping<T>>, S>;

/// A contact with damping and the paper's ring of adhesion, without friction.
///
/// ```
/// use microimpact::contact::{Contact, RingScene};
/// use microimpact::{Sphere, Stiffness};
///
/// let scene: RingScene<f32> = Contact::hertz(Sphere::solid(1e-6, 1000.0)?, Stiffness::new(1e10)?)
///     .with_damping(10.5)?
///     .with_ring(250.0, 6.25)?;
/// assert_eq!(size_of_val(&scene), 8 * size_of::<f32>());
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub type RingScene<T, S = NoFriction> = Contact<T, HertzLaw<T, HystereticDamping<T>, Ring<T>>, S>;

/// The scene of the paper: damping, a ring of adhesion, and Coulomb friction.
///
/// Firmware holds it in a static, made at start:
///
/// ```
/// use microimpact::contact::{Contact, PaperScene};
/// use microimpact::{InputError, Sphere, Stiffness};
/// use static_cell::StaticCell;
///
/// static SCENE: StaticCell<PaperScene<f32>> = StaticCell::new();
///
/// fn glass_on_steel(radius: f32) -> Result<PaperScene<f32>, InputError> {
///     Contact::hertz(Sphere::solid(radius, 2600.0)?, Stiffness::new(7.5e10)?)
///         .with_damping(10.5)?
///         .with_ring(250.0, 6.25)?
///         .with_friction(0.1)
/// }
/// let scene: &'static PaperScene<f32> = SCENE.init(glass_on_steel(5.06e-6)?);
/// assert_eq!(scene.sphere().radius(), 5.06e-6);
/// # Ok::<(), InputError>(())
/// ```
pub type PaperScene<T> = RingScene<T, Coulomb<T>>;

/// A scene whose law of contact is chosen at run time, with Coulomb friction.
///
/// ```
/// use microimpact::contact::{AnyLaw, AnyScene, Contact};
/// use microimpact::{Sphere, Stiffness};
///
/// let law = AnyLaw::hertz(Stiffness::new(1e10)?);
/// let scene: AnyScene<f64> = Contact::new(Sphere::solid(1e-6, 1000.0)?, law).with_friction(0.1)?;
/// assert!(matches!(scene.law(), AnyLaw::Hertz(_)));
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub type AnyScene<T> = Contact<T, AnyLaw<T>, Coulomb<T>>;
