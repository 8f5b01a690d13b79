//! Scenes as plain data: what a configuration stores, sends and chooses at run time.

use crate::contact::{AnyLaw, AnyScene, Contact, JkrEnd};
use crate::rigid::{
    AdhesionCoefficient, AnyAdhesion, AnyRestitution, AnyRigidBody, ElasticPlasticRestitution, PowerRestitution,
    SpeedAdhesion, ViscoelasticRestitution, WorkOfAdhesion,
};
use crate::{ConstantRestitution, InputError, Real, RigidBody, SpeedRestitution, Sphere, Stiffness};

/// Gyration ratio of a solid sphere.
const SOLID: f64 = 0.4;

/// A scene of either model as plain numbers in SI units, with the terms that it has: restitution or stiffness, damping, adhesion,
/// friction, and an external force on a contact. Rolling dissipation, a peeling moment, tangential compliance and external impulses
/// are left to typed scenes.
///
/// It can be a constant, be written by `serde`, and be changed at run time. Its numbers are not checked until
/// [`scene`](Self::scene) makes a scene of it.
///
/// ```
/// use microimpact::contact::Adaptive;
/// use microimpact::{AdhesionConfig, AnyModel, DampingConfig, ModelConfig, NormalMotion, SceneConfig};
///
/// const GLASS_ON_STEEL: SceneConfig<f64> = SceneConfig {
///     radius: 5.06e-6,
///     density: 2600.0,
///     gyration_ratio: 0.4,
///     friction: 0.1,
///     model: ModelConfig::Contact {
///         stiffness: 7.5e10,
///         damping: DampingConfig::Hysteretic { zeta: 10.5 },
///         adhesion: AdhesionConfig::Ring { strength: 250.0, zeta: 6.25 },
///         force: 0.0,
///     },
/// };
/// let AnyModel::Contact(scene) = GLASS_ON_STEEL.scene()? else { unreachable!("a contact was configured") };
/// let before = NormalMotion::new(2.8)?.with_tangential(0.0)?;
/// let e = scene.solve(&before, &Adaptive::new(1e-9)?)?.normal.overall_restitution();
/// assert!((e - 0.746193).abs() < 1e-6);
///
/// let mistaken = SceneConfig { radius: 5.06, ..GLASS_ON_STEEL }.scene().unwrap_err();
/// assert_eq!(mistaken.to_string(), "radius is 5.06 m, but must be 1e-10 to 1 m; enter 5.06 um as 5.06e-6");
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SceneConfig<T> {
    /// Radius r of the sphere, m.
    pub radius: T,
    /// Mean density, kg/m^3.
    pub density: T,
    /// Gyration ratio kappa; 0.4 for a solid sphere.
    pub gyration_ratio: T,
    /// Friction coefficient f; zero for a smooth surface.
    pub friction: T,
    /// The normal motion.
    pub model: ModelConfig<T>,
}

/// The normal motion of a [`SceneConfig`]: the model and its terms.
///
/// ```
/// use microimpact::{ModelConfig, ReboundAdhesionConfig, RestitutionConfig};
///
/// let restitution = RestitutionConfig::Constant { restitution: 0.9_f32 };
/// let model = ModelConfig::RigidBody { restitution, adhesion: ReboundAdhesionConfig::None };
/// assert!(matches!(model, ModelConfig::RigidBody { .. }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ModelConfig<T> {
    /// The rigid-body model.
    RigidBody {
        /// Restitution R without adhesion.
        restitution: RestitutionConfig<T>,
        /// Adhesion on rebound.
        adhesion: ReboundAdhesionConfig<T>,
    },
    /// The simulation of the contact.
    Contact {
        /// Hertz stiffness K, Pa (B2).
        stiffness: T,
        /// Damping of the materials.
        damping: DampingConfig<T>,
        /// Adhesion.
        adhesion: AdhesionConfig<T>,
        /// External force, N, positive out of the surface; zero for none.
        force: T,
    },
}

/// Restitution R of a rigid body.
///
/// ```
/// use microimpact::{RestitutionConfig, RestitutionLaw, Sphere};
///
/// let law = RestitutionConfig::Speed { speed: 130.0 }.law(&Sphere::solid(1e-6, 1000.0)?)?;
/// assert_eq!(law.restitution(130.0), 0.5);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum RestitutionConfig<T> {
    /// The same R at every speed.
    Constant {
        /// R.
        restitution: T,
    },
    /// R = k/(k + v).
    Speed {
        /// k, m/s.
        speed: T,
    },
    /// R = k^p/(k^p + v^p).
    Power {
        /// k, m/s.
        speed: T,
        /// p.
        power: T,
    },
    /// That of an elastic-plastic sphere (Thornton 1997).
    ElasticPlastic {
        /// Speed of first yield, m/s.
        yield_speed: T,
    },
    /// That of a viscoelastic sphere.
    Viscoelastic {
        /// Hertz stiffness K, Pa.
        stiffness: T,
        /// Relaxation time A, s.
        relaxation_time: T,
    },
}

/// Adhesion of a rigid body.
///
/// ```
/// use microimpact::{ReboundAdhesionConfig, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// assert!(ReboundAdhesionConfig::Coefficient { coefficient: 0.2 }.adhesion(&sphere).is_ok());
/// assert!(ReboundAdhesionConfig::Work { work: -1.0 }.adhesion(&sphere).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ReboundAdhesionConfig<T> {
    /// No adhesion.
    None,
    /// A coefficient rho.
    Coefficient {
        /// rho, 0 to 1.
        coefficient: T,
    },
    /// A work W_A.
    Work {
        /// W_A, J.
        work: T,
    },
    /// A coefficient rho = l^q/(l^q + v^q).
    Speed {
        /// l, m/s.
        speed: T,
        /// q.
        power: T,
    },
}

/// Damping of the materials of a contact.
///
/// ```
/// use microimpact::DampingConfig;
///
/// assert_ne!(DampingConfig::None, DampingConfig::Hysteretic { zeta: 10.5 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum DampingConfig<T> {
    /// Elastic materials.
    None,
    /// Damping of Hunt and Crossley.
    Hysteretic {
        /// zeta_H.
        zeta: T,
    },
    /// Damping of a viscoelastic material.
    Viscoelastic {
        /// Relaxation time A, s.
        relaxation_time: T,
    },
    /// Damping that, without adhesion, leaves the same restitution at every speed.
    Constant {
        /// e.
        restitution: T,
    },
}

/// Adhesion of a contact, and where contact ends.
///
/// ```
/// use microimpact::AdhesionConfig;
///
/// assert_ne!(AdhesionConfig::None, AdhesionConfig::Dmt { work: 0.1 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AdhesionConfig<T> {
    /// No adhesion; contact ends at zero indentation.
    None,
    /// No adhesion; contact ends where damping cancels the elastic force.
    WithoutTension,
    /// The paper's ring force.
    Ring {
        /// f0, N/m.
        strength: T,
        /// zeta_A, on rebound.
        zeta: T,
    },
    /// Adhesion of Derjaguin, Muller and Toporov.
    Dmt {
        /// Work of adhesion G, J/m^2.
        work: T,
    },
    /// Adhesion of Johnson, Kendall and Roberts. It takes no external force.
    Jkr {
        /// Work of adhesion G, J/m^2.
        work: T,
        /// Where contact ends.
        end: JkrEnd,
    },
}

/// A scene of either model, chosen at run time, with friction.
///
/// [`Simulated`](crate::instrument::Simulated) classifies the readings of an instrument by it, with a method for scenes that are
/// simulated.
///
/// ```
/// use microimpact::{AnyModel, ModelConfig, ReboundAdhesionConfig, RestitutionConfig, SceneConfig};
///
/// let restitution = RestitutionConfig::Constant { restitution: 0.9 };
/// let model = ModelConfig::RigidBody { restitution, adhesion: ReboundAdhesionConfig::None };
/// let scene = SceneConfig::solid(1e-6, 1000.0, model).scene()?;
/// assert!(matches!(scene, AnyModel::RigidBody(body) if body.sphere().radius() == 1e-6));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(bound(deserialize = "T: Real + serde::Deserialize<'de>")))]
#[allow(clippy::large_enum_variant)] // there is no allocation to box it
pub enum AnyModel<T> {
    /// The rigid-body model.
    RigidBody(AnyRigidBody<T>),
    /// The simulation.
    Contact(AnyScene<T>),
}

impl<T: Real> SceneConfig<T> {
    /// A solid sphere of `radius` (m) and `density` (kg/m^3) on a surface without friction.
    ///
    /// ```
    /// use microimpact::{AdhesionConfig, DampingConfig, ModelConfig, SceneConfig};
    ///
    /// let (damping, adhesion) = (DampingConfig::None, AdhesionConfig::Dmt { work: 0.1 });
    /// let model = ModelConfig::Contact { stiffness: 1e10, damping, adhesion, force: 0.0 };
    /// let rough = SceneConfig { friction: 0.2, ..SceneConfig::solid(1e-6, 1000.0, model) };
    /// assert!(rough.scene().is_ok());
    /// ```
    pub fn solid(radius: T, density: T, model: ModelConfig<T>) -> Self {
        Self { radius, density, gyration_ratio: T::constant(SOLID), friction: T::ZERO, model }
    }

    /// The scene, with all numbers checked.
    ///
    /// # Errors
    /// A number outside its range, or an external force with a law that takes none.
    ///
    /// ```
    /// use microimpact::{AdhesionConfig, DampingConfig, Fault, ModelConfig, SceneConfig, contact::JkrEnd};
    ///
    /// let adhesion = AdhesionConfig::Jkr { work: 0.1, end: JkrEnd::SnapOff };
    /// let model = ModelConfig::Contact { stiffness: 1e10, damping: DampingConfig::None, adhesion, force: 1e-9 };
    /// assert_eq!(SceneConfig::solid(1e-6, 1000.0, model).scene().unwrap_err().fault, Fault::OtherLaw);
    /// ```
    pub fn scene(&self) -> Result<AnyModel<T>, InputError> {
        let sphere = Sphere::new(self.radius, self.density, self.gyration_ratio)?;
        Ok(match self.model {
            ModelConfig::RigidBody { restitution, adhesion } => AnyModel::RigidBody(
                RigidBody::new(sphere, restitution.law(&sphere)?)
                    .with_adhesion(adhesion.adhesion(&sphere)?)
                    .with_friction(self.friction)?,
            ),
            ModelConfig::Contact { stiffness, damping, adhesion, force } => {
                let law = damping.added_to(adhesion.law(Stiffness::new(stiffness)?)?)?;
                let law = if force == T::ZERO { law } else { law.with_external_force(force)? };
                AnyModel::Contact(Contact::new(sphere, law).with_friction(self.friction)?)
            }
        })
    }
}

impl<T: Real> RestitutionConfig<T> {
    /// The law for a sphere.
    ///
    /// # Errors
    /// A number outside its range.
    ///
    /// ```
    /// use microimpact::{RestitutionConfig, Sphere};
    ///
    /// let config = RestitutionConfig::Constant { restitution: 1.1 };
    /// assert!(config.law(&Sphere::solid(1e-6, 1000.0)?).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn law(&self, sphere: &Sphere<T>) -> Result<AnyRestitution<T>, InputError> {
        match *self {
            Self::Constant { restitution } => ConstantRestitution::new(restitution).map(Into::into),
            Self::Speed { speed } => SpeedRestitution::new(speed).map(Into::into),
            Self::Power { speed, power } => PowerRestitution::new(speed, power).map(Into::into),
            Self::ElasticPlastic { yield_speed } => ElasticPlasticRestitution::new(yield_speed).map(Into::into),
            Self::Viscoelastic { stiffness, relaxation_time } => {
                ViscoelasticRestitution::new(sphere, Stiffness::new(stiffness)?, relaxation_time).map(Into::into)
            }
        }
    }
}

impl<T: Real> ReboundAdhesionConfig<T> {
    /// The adhesion of a sphere.
    ///
    /// # Errors
    /// A number outside its range.
    ///
    /// ```
    /// use microimpact::{ReboundAdhesionConfig, Sphere, rigid::AnyAdhesion};
    ///
    /// let adhesion = ReboundAdhesionConfig::None.adhesion(&Sphere::solid(1e-6, 1000.0)?)?;
    /// assert_eq!(adhesion, AnyAdhesion::None);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn adhesion(&self, sphere: &Sphere<T>) -> Result<AnyAdhesion<T>, InputError> {
        match *self {
            Self::None => Ok(AnyAdhesion::None),
            Self::Coefficient { coefficient } => AdhesionCoefficient::new(coefficient).map(Into::into),
            Self::Work { work } => WorkOfAdhesion::new(work, sphere).map(Into::into),
            Self::Speed { speed, power } => SpeedAdhesion::new(speed, power).map(Into::into),
        }
    }
}

impl<T: Real> DampingConfig<T> {
    fn added_to(&self, law: AnyLaw<T>) -> Result<AnyLaw<T>, InputError> {
        match *self {
            Self::None => Ok(law),
            Self::Hysteretic { zeta } => law.with_damping(zeta),
            Self::Viscoelastic { relaxation_time } => law.with_viscoelastic_damping(relaxation_time),
            Self::Constant { restitution } => law.with_constant_damping(restitution),
        }
    }
}

impl<T: Real> AdhesionConfig<T> {
    fn law(&self, stiffness: Stiffness<T>) -> Result<AnyLaw<T>, InputError> {
        match *self {
            Self::None => Ok(AnyLaw::hertz(stiffness)),
            Self::WithoutTension => Ok(AnyLaw::without_tension(stiffness)),
            Self::Ring { strength, zeta } => AnyLaw::ring(stiffness, strength, zeta),
            Self::Dmt { work } => AnyLaw::dmt(stiffness, work),
            Self::Jkr { work, end } => AnyLaw::jkr(stiffness, work, end),
        }
    }
}
