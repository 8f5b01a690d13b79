//! The contact simulation with compliance along the surface.

use microimpact::contact::{AnyLaw, Compliance, CompliantVelocities, Contact, SimulatedImpact, Unloading};
use microimpact::{InputError, PlanarMotion};

use crate::error::Error;
use crate::memory;
use crate::simulation::{ContactScene, Method, simulate_each};
use crate::status::{Class, Failure, Motion, Status, followed, initialise};

/// A contact that gives sideways before it slips: one elastic element between sphere and surface sticks until friction is exhausted
/// (Mindlin 1949; Thornton, Cummins and Cleary 2011).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompliantScene {
    /// The contact: Hertz's force with material_damping and friction, any of which may be zero. All that belongs to another law,
    /// adhesion, other damping and ends_by_force, must be zero.
    pub contact: ContactScene,
    /// Stiffness ratio chi, 0.001 to 1000: the stiffness along the surface over (3/2) K a, with the Hertz stiffness K and the contact
    /// radius a. It is 2 (1 - nu)/(2 - nu) for two materials with the same Poisson's ratio nu.
    pub stiffness_ratio: f32,
    /// How the force along the surface changes while the contact shrinks. Zero: it falls with the stiffness, so that no energy is
    /// created. Anything else: it does not, as in many programs for granular flow; this rule creates energy.
    pub incremental_unloading: u32,
}

/// cbindgen:ignore
type Scene = Contact<f32, AnyLaw<f32>, Compliance<f32>>;

impl CompliantScene {
    fn check(self) -> Result<(Scene, Method), InputError> {
        let (scene, method) = self.contact.check()?;
        let unloading = if self.incremental_unloading == 0 { Unloading::Rescaled } else { Unloading::Incremental };
        Ok((scene.with_compliance(self.stiffness_ratio)?.with_unloading(unloading), method))
    }

    fn filled(self) -> Result<Self, InputError> {
        let filled = Self { contact: self.contact.filled()?, ..self };
        filled.check()?;
        Ok(filled)
    }
}

/// Initialises a scene as microimpact_contact_init does, with the tolerance of its contact. If another law of contact is asked for, the
/// error names the stiffness ratio with the fault MICROIMPACT_FAULT_OTHER_LAW. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_compliant_init(
    parameters: *const CompliantScene,
    scene: *mut CompliantScene,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { initialise(parameters, scene, error, CompliantScene::filled) }
}

/// A simulated impact with compliance along the surface.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompliantContact {
    /// What became of the sphere. Where friction acts, the contact slips in the end.
    pub impact_class: Class,
    /// Overall restitution.
    pub restitution: f32,
    /// Peak indentation, m.
    pub peak_indentation: f32,
    /// Tangential velocity after the contact, m/s.
    pub tangential: f32,
    /// Spin after the contact, rad/s.
    pub spin: f32,
    /// Velocity of the contact point after the contact, m/s.
    pub slip: f32,
    /// Tangential over normal impulse, negative against a positive slip.
    pub impulse_ratio: f32,
    /// Number of phases: longest intervals of sticking, or of slip in one direction.
    pub phases: u32,
}

impl CompliantContact {
    fn of(impact: &SimulatedImpact<f32, CompliantVelocities<f32>>) -> Result<Self, Failure> {
        let (class, along) = (impact.class().ok_or(Failure::Status(Status::Unsolved))?, &impact.tangential);
        Ok(Self {
            impact_class: class.into(),
            restitution: impact.normal.overall_restitution().min(1.0),
            peak_indentation: impact.normal.peak_indentation().unwrap_or(-1.0),
            tangential: along.velocity(),
            spin: along.spin(),
            slip: along.slip(),
            impulse_ratio: along.impulse_ratio(),
            phases: along.phases(),
        })
    }
}

/// Simulates impacts with compliance along the surface, as microimpact_simulate does without. microimpact_wall_after and
/// microimpact_pair_after take the restitution and the tangential velocity of the results. For microimpact_pair_incidence, initialise
/// the contact of the scene with the radius and the density of the reduced sphere. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the motions to `count` of them and the results to room for
/// `capacity`, and nobody else uses them during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_simulate_compliant(
    scene: *const CompliantScene,
    motions: *const Motion,
    count: usize,
    results: *mut CompliantContact,
    capacity: usize,
    written: *mut usize,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe {
        simulate_each(motions, count, results, capacity, written, error, || {
            let (scene, method) = followed(memory::read(scene))?.check()?;
            Ok(move |motion: &PlanarMotion<f32>| CompliantContact::of(&scene.solve(motion, &method)?))
        })
    }
}
