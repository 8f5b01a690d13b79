//! The simulation of a contact in integers, for processors without floating point.

use microimpact::contact::{Contact, FixedCost, RingScene, Status as RunStatus};
use microimpact::{Coulomb, Fault, FixedPoint, InFixedPoint, InputError, Parameter, Sphere, Stiffness};

use crate::error::Error;
use crate::fixed_point::FixedMotion;
use crate::memory;
use crate::simulation::ContactScene;
use crate::status::{Class, Failure, Status, finish, followed};

/// Room for a contact in integers, which microimpact_fixed_contact_init makes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FixedContact {
    /// What is in it concerns the library alone.
    pub words: [u32; 10],
}

/// What is in the room.
#[derive(Clone, Copy)]
struct Made {
    mark: u32,
    scene: RingScene<FixedPoint, Coulomb<FixedPoint>>,
}

/// Tells a contact from memory in which none was made.
const MARK: u32 = 0x6d69_6663;

const _: () = assert!(size_of::<Made>() == size_of::<FixedContact>());
const _: () = assert!(align_of::<Made>() <= align_of::<FixedContact>());

/// Iterations of the method of fixed cost, for each of its nodes.
const ITERATIONS: u32 = 3;

/// What became of a sphere, and its velocities after the impact, in 2^-24.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedImpact {
    /// What became of the sphere.
    pub impact_class: Class,
    /// Overall restitution, zero for a capture.
    pub restitution: i32,
    /// Tangential velocity after the impact, in the unit of speed.
    pub tangential: i32,
    /// Peripheral velocity after the impact, in the unit of speed.
    pub peripheral: i32,
}

impl ContactScene {
    /// The scene, if it has no terms but those of the paper.
    fn of_the_paper(self) -> Result<RingScene<f32, Coulomb<f32>>, InputError> {
        let others = [
            (Parameter::AdhesionEnergy, self.dmt_work),
            (Parameter::AdhesionEnergy, self.jkr_work),
            (Parameter::RelaxationTime, self.relaxation_time),
            (Parameter::NominalRestitution, self.nominal_restitution),
        ];
        if let Some((parameter, value)) = others.into_iter().find(|(_, value)| *value != 0.0) {
            return Err(InputError { parameter, fault: Fault::OtherLaw, value });
        }
        Contact::hertz(Sphere::solid(self.radius, self.density)?, Stiffness::new(self.stiffness)?)
            .with_damping(self.material_damping)?
            .with_ring(self.adhesion_strength, self.adhesion_damping)?
            .with_friction(self.friction)
    }
}

/// Makes a contact in integers of a scene and a unit of speed, m/s, near the speeds that occur. The scene has hysteretic damping, a ring
/// of adhesion and friction, each of which may be zero; another adhesion, damping or end of contact is refused. This takes floating point;
/// what it makes can be copied, stored and made on another machine of the same byte order. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_fixed_contact_init(
    scene: *const ContactScene,
    unit: f32,
    contact: *mut FixedContact,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the contact is room for a `Made`.
    unsafe {
        let made = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            if scene.ends_by_force != 0 {
                return Err(Failure::Status(Status::Choice));
            }
            let scene = scene.of_the_paper()?.in_fixed_point(unit)?;
            followed(memory::write(contact.cast(), Made { mark: MARK, scene }))
        };
        finish(made(), error)
    }
}

/// Simulates an impact in integers alone, by the method of fixed cost with 5 nodes and 3 iterations; the approach speed must be 0.1 to 8
/// units. A number that is refused is the exception, of which the error tells in floating point. Damping that is too strong for the method
/// is MICROIMPACT_STATUS_UNSOLVED. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_fixed_simulate(
    contact: *const FixedContact,
    motion: *const FixedMotion,
    impact: *mut FixedImpact,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; `Made` is plain numbers.
    unsafe {
        let simulated = || -> Result<(), Failure> {
            let made: Made = followed(memory::read(contact.cast()))?;
            if made.mark != MARK {
                return Err(Failure::Status(Status::Unmade));
            }
            let motion = followed(memory::read(motion))?.check()?;
            let solved = made.scene.solve(&motion, &FixedCost::<5>::new(ITERATIONS)?.with_outputs::<7>())?;
            let class = solved.class().filter(|_| solved.run.status == RunStatus::Solved);
            let class = class.ok_or(Failure::Status(Status::Unsolved))?;
            followed(memory::write(
                impact,
                FixedImpact {
                    impact_class: class.into(),
                    restitution: solved.normal.overall_restitution().to_bits(),
                    tangential: solved.tangential.velocity().to_bits(),
                    // The unit of length is the radius.
                    peripheral: solved.tangential.spin().to_bits(),
                },
            ))
        };
        finish(simulated(), error)
    }
}
