//! Scenes of either model as one plain structure, which says at run time which terms are present.

use microimpact::contact::{Collocation, FixedCost, JkrEnd};
use microimpact::{
    AdhesionConfig, AnyModel, CriticalSpeed, DampingConfig, ModelConfig, PlanarMotion, ReboundAdhesionConfig,
    RestitutionConfig,
};

use crate::error::Error;
use crate::memory;
use crate::simulation::{ALL_INTERVALS, Contact, TOLERANCE, simulated};
use crate::status::{Class, Failure, Motion, Status, finish, followed, initialise};
use crate::terms::Model;

/// A scene of either model. The choices, numbers of the enumerations in the comments, say which terms are present; a number of a term
/// that was not chosen is not looked at. What is left out is zero.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SceneConfig {
    /// Radius of the sphere, m.
    pub radius: f32,
    /// Its mean density, kg/m^3.
    pub density: f32,
    /// Squared radius of gyration over squared radius; microimpact_scene_init makes zero that of a solid sphere, 0.4. See
    /// microimpact_sphere_hollow and microimpact_sphere_coated for others.
    pub gyration_ratio: f32,
    /// Friction coefficient; may be zero.
    pub friction: f32,
    /// MicroimpactModel.
    pub model: u32,

    /// MicroimpactRestitutionLaw, of a rigid body.
    pub restitution_law: u32,
    /// R of a constant restitution.
    pub restitution: f32,
    /// Speed k of MICROIMPACT_RESTITUTION_LAW_SPEED and POWER, m/s.
    pub restitution_speed: f32,
    /// Power p of MICROIMPACT_RESTITUTION_LAW_POWER.
    pub restitution_power: f32,
    /// Speed of first yield of MICROIMPACT_RESTITUTION_LAW_ELASTIC_PLASTIC, m/s.
    pub yield_speed: f32,
    /// MicroimpactReboundAdhesion, of a rigid body.
    pub rebound_adhesion: u32,
    /// rho of MICROIMPACT_REBOUND_ADHESION_COEFFICIENT.
    pub adhesion_coefficient: f32,
    /// Work of MICROIMPACT_REBOUND_ADHESION_WORK, J.
    pub work_of_adhesion: f32,
    /// Speed l of MICROIMPACT_REBOUND_ADHESION_SPEED, m/s.
    pub adhesion_speed: f32,
    /// Its power q.
    pub adhesion_power: f32,

    /// Hertz stiffness of a contact, and of MICROIMPACT_RESTITUTION_LAW_VISCOELASTIC, Pa.
    pub stiffness: f32,
    /// Relaxation time of a viscoelastic material, of either model, s.
    pub relaxation_time: f32,
    /// MicroimpactDamping, of a contact.
    pub damping: u32,
    /// zeta_H of MICROIMPACT_DAMPING_HYSTERETIC.
    pub material_damping: f32,
    /// e of MICROIMPACT_DAMPING_CONSTANT.
    pub nominal_restitution: f32,
    /// MicroimpactAdhesion, of a contact.
    pub adhesion: u32,
    /// f0 of MICROIMPACT_ADHESION_RING, N/m.
    pub adhesion_strength: f32,
    /// Its zeta_A.
    pub adhesion_damping: f32,
    /// Work of adhesion per area of the laws DMT and JKR, J/m^2.
    pub adhesion_energy: f32,
    /// External force on a contact, N, positive out of the surface.
    pub external_force: f32,

    /// Tolerance of the square of the restitution of a contact; microimpact_scene_init makes zero 1e-6.
    pub tolerance: f32,
    /// Iterations of the method of fixed cost, 1 to 40, which then takes the place of the one with a tolerance; zero for the latter.
    /// Contact has to begin and end at zero indentation: with MICROIMPACT_ADHESION_WITHOUT_TENSION or JKR the status is
    /// MICROIMPACT_STATUS_CHOICE.
    pub iterations: u32,
}

/// A choice of a C program among all that there are.
fn chosen<T: Copy, const N: usize>(choice: u32, all: [T; N]) -> Result<T, Failure> {
    all.get(choice as usize).copied().ok_or(Failure::Status(Status::Choice))
}

impl SceneConfig {
    /// The scene of the library, whose numbers are not checked yet.
    pub(crate) fn config(&self) -> Result<microimpact::SceneConfig<f32>, Failure> {
        let model = match chosen(self.model, [Model::RigidBody, Model::Contact])? {
            Model::RigidBody => {
                ModelConfig::RigidBody { restitution: self.restitution()?, adhesion: self.rebound_adhesion()? }
            }
            Model::Contact => ModelConfig::Contact {
                stiffness: self.stiffness,
                damping: self.damping()?,
                adhesion: self.adhesion()?,
                force: self.external_force,
            },
        };
        let Self { radius, density, gyration_ratio, friction, .. } = *self;
        Ok(microimpact::SceneConfig { radius, density, gyration_ratio, friction, model })
    }

    fn restitution(&self) -> Result<RestitutionConfig<f32>, Failure> {
        let speed = self.restitution_speed;
        let (stiffness, relaxation_time) = (self.stiffness, self.relaxation_time);
        chosen(
            self.restitution_law,
            [
                RestitutionConfig::Constant { restitution: self.restitution },
                RestitutionConfig::Speed { speed },
                RestitutionConfig::Power { speed, power: self.restitution_power },
                RestitutionConfig::ElasticPlastic { yield_speed: self.yield_speed },
                RestitutionConfig::Viscoelastic { stiffness, relaxation_time },
            ],
        )
    }

    fn rebound_adhesion(&self) -> Result<ReboundAdhesionConfig<f32>, Failure> {
        chosen(
            self.rebound_adhesion,
            [
                ReboundAdhesionConfig::None,
                ReboundAdhesionConfig::Coefficient { coefficient: self.adhesion_coefficient },
                ReboundAdhesionConfig::Work { work: self.work_of_adhesion },
                ReboundAdhesionConfig::Speed { speed: self.adhesion_speed, power: self.adhesion_power },
            ],
        )
    }

    fn damping(&self) -> Result<DampingConfig<f32>, Failure> {
        chosen(
            self.damping,
            [
                DampingConfig::None,
                DampingConfig::Hysteretic { zeta: self.material_damping },
                DampingConfig::Viscoelastic { relaxation_time: self.relaxation_time },
                DampingConfig::Constant { restitution: self.nominal_restitution },
            ],
        )
    }

    fn adhesion(&self) -> Result<AdhesionConfig<f32>, Failure> {
        let work = self.adhesion_energy;
        chosen(
            self.adhesion,
            [
                AdhesionConfig::None,
                AdhesionConfig::WithoutTension,
                AdhesionConfig::Ring { strength: self.adhesion_strength, zeta: self.adhesion_damping },
                AdhesionConfig::Dmt { work },
                AdhesionConfig::Jkr { work, end: JkrEnd::SnapOff },
                AdhesionConfig::Jkr { work, end: JkrEnd::PullOff },
            ],
        )
    }

    /// The scene and the method, with all numbers checked.
    pub(crate) fn check(&self) -> Result<(AnyModel<f32>, SceneMethod), Failure> {
        let scene = self.config()?.scene()?;
        let method = match self.iterations {
            _ if self.model == Model::RigidBody as u32 => SceneMethod::None,
            0 => SceneMethod::Tolerance(Collocation::new(self.tolerance)?),
            // That method carries laws whose contact begins and ends at zero indentation.
            _ if matches!(self.adhesion()?, AdhesionConfig::WithoutTension | AdhesionConfig::Jkr { .. }) => {
                return Err(Failure::Status(Status::Choice));
            }
            iterations => SceneMethod::FixedCost(FixedCost::<7>::new(iterations)?.with_outputs()),
        };
        Ok((scene, method))
    }

    fn filled(mut self) -> Result<Self, Failure> {
        if self.gyration_ratio == 0.0 {
            self.gyration_ratio = SOLID;
        }
        if self.tolerance == 0.0 {
            self.tolerance = TOLERANCE;
        }
        self.check()?;
        Ok(self)
    }

    /// What becomes of a sphere of this scene.
    pub(crate) fn impact(&self, motion: &PlanarMotion<f32>) -> Result<SceneImpact, Failure> {
        match self.check()? {
            (AnyModel::RigidBody(body), _) => {
                let impact = body.impact(motion);
                let classification = body.classify_impact(&impact);
                Ok(SceneImpact {
                    impact_class: classification.class().into(),
                    restitution: impact.normal.overall_restitution(),
                    tangential: impact.tangential.velocity(),
                    peripheral: impact.tangential.peripheral(),
                })
            }
            (AnyModel::Contact(scene), SceneMethod::FixedCost(method)) => {
                Ok(SceneImpact::of(Contact::of(&scene.solve(motion, &method)?)?, self.radius))
            }
            (AnyModel::Contact(scene), SceneMethod::Tolerance(method)) => {
                let impact = simulated(&scene, motion, method, ALL_INTERVALS)?;
                Ok(SceneImpact::of(Contact::of(&impact)?, self.radius))
            }
            (AnyModel::Contact(_), SceneMethod::None) => Err(Failure::Status(Status::Choice)),
        }
    }
}

/// Gyration ratio of a solid sphere.
const SOLID: f32 = 0.4;

/// How a contact is simulated.
#[derive(Clone, Copy)]
pub(crate) enum SceneMethod {
    /// A rigid body needs none.
    None,
    /// To a tolerance.
    Tolerance(Collocation<7, f32>),
    /// In a number of iterations.
    FixedCost(FixedCost<7>),
}

/// What became of a sphere of a scene of either model.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneImpact {
    /// The class.
    pub impact_class: Class,
    /// Overall restitution, zero for a capture.
    pub restitution: f32,
    /// Tangential velocity after the impact, m/s.
    pub tangential: f32,
    /// Peripheral velocity after the impact, spin times radius, m/s.
    pub peripheral: f32,
}

impl SceneImpact {
    fn of(contact: Contact, radius: f32) -> Self {
        let Contact { impact_class, restitution, tangential, spin, .. } = contact;
        Self { impact_class, restitution, tangential, peripheral: spin * radius }
    }
}

/// Initialises a scene with parameters, fills in the gyration ratio and the tolerance if they are zero, and checks every number that the
/// chosen terms have. The error names the first that is outside its range, and may be null; an unknown choice is
/// MICROIMPACT_STATUS_CHOICE. Where this fails, the scene holds zeros, which every function reports. The parameters and the scene may
/// be the same memory. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_scene_init(
    parameters: *const SceneConfig,
    scene: *mut SceneConfig,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { initialise(parameters, scene, error, SceneConfig::filled) }
}

/// What becomes of a sphere of a scene. A contact for which the method does not come to an end, or whose error the method of fixed
/// cost cannot bound, is MICROIMPACT_STATUS_UNSOLVED. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_scene_classify(
    scene: *const SceneConfig,
    motion: *const Motion,
    impact: *mut SceneImpact,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let classified = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            let motion = followed(memory::read(motion))?.check()?;
            followed(memory::write(impact, scene.impact(&motion)?))
        };
        finish(classified(), error)
    }
}

/// Writes the speed below which the surface holds a sphere of a scene, m/s: zero if it never does, a negative number if it always
/// does. A contact needs a tolerance, not iterations. microimpact_critical_speed_step finds it in steps. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_scene_critical_speed(
    scene: *const SceneConfig,
    speed: *mut f32,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let found = || -> Result<(), Failure> {
            let critical = match followed(memory::read(scene))?.check()? {
                (AnyModel::RigidBody(body), _) => body.critical_speed(),
                (AnyModel::Contact(contact), SceneMethod::Tolerance(method)) => contact.critical_speed(&method)?,
                _ => return Err(Failure::Status(Status::Choice)),
            };
            followed(memory::write(speed, number_of(critical)))
        };
        finish(found(), error)
    }
}

/// A critical speed as a number, m/s, as microimpact_scene_critical_speed says.
pub(crate) fn number_of(critical: CriticalSpeed<f32>) -> f32 {
    match critical {
        CriticalSpeed::At(speed) => speed,
        CriticalSpeed::AlwaysRebounds => 0.0,
        CriticalSpeed::NeverRebounds => -1.0,
    }
}
