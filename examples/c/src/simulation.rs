//! The contact simulation.

use microimpact::contact::{self, AnyLaw, AnyScene, Collocation, JkrEnd, SimulatedImpact, TangentialVelocities};
use microimpact::{CriticalSpeed, Fault, InputError, Parameter, PlanarMotion, Sphere, Stiffness};

use crate::error::Error;
use crate::memory;
use crate::status::{Class, Failure, Motion, Status, finish, followed, initialise};

/// A contact with Hertz's force, adhesion of one kind, damping of one kind, and friction. Zero leaves a term out.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactScene {
    /// Radius of the sphere, m.
    pub radius: f32,
    /// Its density, kg/m^3.
    pub density: f32,
    /// Hertz stiffness, Pa.
    pub stiffness: f32,
    /// Strength zeta_H of hysteretic damping in the materials; may be zero. A damping constant c in s/m of the elastic force times
    /// 1 + c v is zeta_H (m/(r^3 K sqrt(v)))^(2/5), with mass m, radius r, stiffness K and approach speed v.
    pub material_damping: f32,
    /// Strength of the ring of adhesion, N/m; may be zero.
    pub adhesion_strength: f32,
    /// Strength of the damping of adhesion; may be zero.
    pub adhesion_damping: f32,
    /// Friction coefficient; may be zero.
    pub friction: f32,
    /// Tolerance of the square of the restitution; microimpact_contact_init fills in 1e-6.
    pub tolerance: f32,
    /// Work of adhesion by Derjaguin, Muller and Toporov, J/m^2; may be zero.
    pub dmt_work: f32,
    /// Work of adhesion by Johnson, Kendall and Roberts, J/m^2; may be zero.
    pub jkr_work: f32,
    /// Relaxation time of viscoelastic damping, s; may be zero.
    pub relaxation_time: f32,
    /// Restitution that constant damping leaves without adhesion, 0.001 to 1; zero leaves the damping out.
    pub nominal_restitution: f32,
    /// Zero for an end of contact at zero indentation, or where a JKR contact snaps off. Anything else for an end where damping
    /// cancels the elastic force, or at the pull-off force of a JKR contact; the ring and DMT have no such end.
    pub ends_by_force: u32,
}

/// Its law of contact is chosen at run time, so that there is one solver for all scenes.
type Scene = AnyScene<f32>;
pub(crate) type Method = Collocation<7, f32>;

/// What suits single precision.
pub(crate) const TOLERANCE: f32 = 1e-6;

/// A number that does not go with the others.
fn refused(parameter: Parameter, value: f32) -> InputError {
    InputError { parameter, fault: Fault::OtherLaw, value }
}

impl ContactScene {
    pub(crate) fn check(self) -> Result<(Scene, Method), InputError> {
        let sphere = Sphere::solid(self.radius, self.density)?;
        let scene = contact::Contact::new(sphere, self.law()?).with_friction(self.friction)?;
        Ok((scene, Collocation::new(self.tolerance)?))
    }

    /// The same scene with a tolerance, if every number of it is valid.
    pub(crate) fn filled(self) -> Result<Self, InputError> {
        let tolerance = if self.tolerance == 0.0 { TOLERANCE } else { self.tolerance };
        let filled = Self { tolerance, ..self };
        filled.check()?;
        Ok(filled)
    }

    fn law(self) -> Result<AnyLaw<f32>, InputError> {
        let stiffness = Stiffness::new(self.stiffness)?;
        let law = self.undamped(stiffness)?;
        match [self.material_damping, self.relaxation_time, self.nominal_restitution].map(|value| value != 0.0) {
            [_, false, false] => law.with_damping(self.material_damping),
            [false, true, false] => law.with_viscoelastic_damping(self.relaxation_time),
            [false, false, true] => law.with_constant_damping(self.nominal_restitution),
            [_, true, _] => Err(refused(Parameter::RelaxationTime, self.relaxation_time)),
            [_, false, true] => Err(refused(Parameter::NominalRestitution, self.nominal_restitution)),
        }
    }

    fn undamped(self, stiffness: Stiffness<f32>) -> Result<AnyLaw<f32>, InputError> {
        let ring = self.adhesion_strength != 0.0 || self.adhesion_damping != 0.0;
        match (ring, self.dmt_work != 0.0, self.jkr_work != 0.0, self.ends_by_force != 0) {
            (false, false, false, false) => Ok(AnyLaw::hertz(stiffness)),
            (false, false, false, true) => Ok(AnyLaw::without_tension(stiffness)),
            (true, false, false, false) => AnyLaw::ring(stiffness, self.adhesion_strength, self.adhesion_damping),
            (false, true, false, false) => AnyLaw::dmt(stiffness, self.dmt_work),
            (false, false, true, false) => AnyLaw::jkr(stiffness, self.jkr_work, JkrEnd::SnapOff),
            (false, false, true, true) => AnyLaw::jkr(stiffness, self.jkr_work, JkrEnd::PullOff),
            (true, ..) => Err(refused(Parameter::AdhesionStrength, self.adhesion_strength)),
            (false, true, ..) => Err(refused(Parameter::AdhesionEnergy, self.dmt_work)),
        }
    }

    /// The speed below which the surface holds a sphere of the same material.
    pub(crate) fn critical_speed(self, radius: f32) -> Result<CriticalSpeed<f32>, InputError> {
        let (scene, method) = Self { radius, friction: 0.0, ..self }.check()?;
        scene.critical_speed(&method)
    }
}

/// Initialises a scene with parameters, of which what is left out is zero, fills in the tolerance if it is, and checks every
/// one. The error names the first that is outside its range, and may be null. Where this fails, the scene holds zeros, which
/// every function reports. The parameters and the scene may be the same memory. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_contact_init(
    parameters: *const ContactScene,
    scene: *mut ContactScene,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { initialise(parameters, scene, error, ContactScene::filled) }
}

/// A simulated impact. An indentation that does not exist is negative.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What became of the sphere.
    pub impact_class: Class,
    /// Overall restitution, zero for a capture.
    pub restitution: f32,
    /// Peak indentation, m.
    pub peak_indentation: f32,
    /// Tangential velocity after the contact, m/s.
    pub tangential: f32,
    /// Spin after the contact, rad/s.
    pub spin: f32,
}

/// Simulates `count` impacts into a buffer with room for `capacity` results, in the order of the motions, and writes how many
/// there are, of those before the first that fails. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the motions to `count` of them and the results to room for
/// `capacity`, and nobody else uses them during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_simulate(
    scene: *const ContactScene,
    motions: *const Motion,
    count: usize,
    results: *mut Contact,
    capacity: usize,
    written: *mut usize,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { simulate_each(motions, count, results, capacity, written, error, || within(scene, ALL_INTERVALS)) }
}

/// As many intervals as the method allows.
pub(crate) const ALL_INTERVALS: u32 = Method::MOST_INTERVALS;

/// The impact of a contact in at most so many intervals. All functions have this one solver of a motion without a trajectory: another,
/// for a number of intervals that is known, would take more flash.
pub(crate) fn simulated(
    scene: &Scene,
    motion: &PlanarMotion<f32>,
    method: Method,
    intervals: u32,
) -> Result<SimulatedImpact<f32, TangentialVelocities<f32>>, InputError> {
    scene.solve(motion, &method.with_budget(intervals))
}

/// Simulates as microimpact_simulate, each impact in at most so many intervals of its motion, refused ones included: a bound of its time,
/// since an interval takes at most 350 evaluations of the forces. An impact that needs more is MICROIMPACT_STATUS_UNSOLVED, or
/// undecided where no more than that can be told; any other result is that of microimpact_simulate to the last bit. That function allows
/// 320 intervals, and so does a larger number here. The error may be null. Re-entrant.
///
/// # Safety
/// As for [`microimpact_simulate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_simulate_within(
    scene: *const ContactScene,
    intervals: u32,
    motions: *const Motion,
    count: usize,
    results: *mut Contact,
    capacity: usize,
    written: *mut usize,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { simulate_each(motions, count, results, capacity, written, error, || within(scene, intervals)) }
}

/// What simulates the impacts of a scene in at most so many intervals.
///
/// # Safety
/// The scene is null or points to one, and nobody writes to it during the call.
unsafe fn within(
    scene: *const ContactScene,
    intervals: u32,
) -> Result<impl Fn(&PlanarMotion<f32>) -> Result<Contact, Failure>, Failure> {
    // SAFETY: the contract of this function is that of the function in `memory`.
    let (scene, method) = followed(unsafe { memory::read(scene) })?.check()?;
    Ok(move |motion: &PlanarMotion<f32>| Contact::of(&simulated(&scene, motion, method, intervals)?))
}

/// Simulates impacts by the solver that `solver` makes, as microimpact_simulate says.
///
/// # Safety
/// As for [`microimpact_simulate`].
pub(crate) unsafe fn simulate_each<R: Copy, S: Fn(&PlanarMotion<f32>) -> Result<R, Failure>>(
    motions: *const Motion,
    count: usize,
    results: *mut R,
    capacity: usize,
    written: *mut usize,
    error: *mut Error,
    solver: impl FnOnce() -> Result<S, Failure>,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; indices stay below count and capacity.
    unsafe {
        let mut done = 0;
        let simulated = || -> Result<(), Failure> {
            followed(memory::write(written, 0))?;
            let solve = solver()?;
            while done < count {
                if done >= capacity {
                    return Err(Failure::Status(Status::Capacity));
                }
                let motion = followed(memory::read(memory::element(motions, done)))?;
                followed(memory::write(memory::element_mut(results, done), solve(&motion.check()?)?))?;
                done += 1;
            }
            Ok(())
        };
        let result = simulated();
        let _ = memory::write(written, done);
        finish(result, error)
    }
}

impl Contact {
    pub(crate) fn of(impact: &SimulatedImpact<f32, TangentialVelocities<f32>>) -> Result<Self, Failure> {
        let class = impact.class().ok_or(Failure::Status(Status::Unsolved))?;
        Ok(Self {
            impact_class: class.into(),
            // A force out of the surface may let rounding exceed one.
            restitution: impact.normal.overall_restitution().min(1.0),
            peak_indentation: impact.normal.peak_indentation().unwrap_or(-1.0),
            tangential: impact.tangential.velocity(),
            spin: impact.tangential.spin(),
        })
    }
}
