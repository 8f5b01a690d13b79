//! Calls of scenes that are chosen at run time.

use core::hint::black_box;

use microimpact::contact::{FixedCost, JkrEnd};
use microimpact::{
    AdhesionConfig, AnyModel, DampingConfig, InputError, ModelConfig, NormalMotion, ReboundAdhesionConfig,
    RestitutionConfig, SceneConfig,
};

use super::contact::AnyNodes;
use super::{any, keep};

/// Calls everything, with one number type.
pub(super) fn call_all<T: AnyNodes>() -> Result<(), InputError> {
    let before = NormalMotion::new(any::<T>())?.with_tangential(any())?;
    match scene()? {
        AnyModel::RigidBody(body) => keep((body.classify(&before), body.critical_speed())),
        AnyModel::Contact(contact) => keep(contact.solve(&before, &FixedCost::<5>::new(black_box(3))?)?),
    }
    Ok(())
}

/// Any scene.
#[inline(never)]
pub(super) fn scene<T: AnyNodes>() -> Result<AnyModel<T>, InputError> {
    any_scene().scene()
}

/// Any configuration.
pub(super) fn any_scene<T: AnyNodes>() -> SceneConfig<T> {
    let rigid = ModelConfig::RigidBody { restitution: restitution(), adhesion: rebound_adhesion() };
    let contact = ModelConfig::Contact { stiffness: any(), damping: damping(), adhesion: adhesion(), force: any() };
    SceneConfig::solid(any(), any(), if black_box(true) { rigid } else { contact })
}

fn restitution<T: AnyNodes>() -> RestitutionConfig<T> {
    match black_box(0) {
        0 => RestitutionConfig::Constant { restitution: any() },
        1 => RestitutionConfig::Speed { speed: any() },
        2 => RestitutionConfig::Power { speed: any(), power: any() },
        3 => RestitutionConfig::ElasticPlastic { yield_speed: any() },
        _ => RestitutionConfig::Viscoelastic { stiffness: any(), relaxation_time: any() },
    }
}

fn rebound_adhesion<T: AnyNodes>() -> ReboundAdhesionConfig<T> {
    match black_box(0) {
        0 => ReboundAdhesionConfig::None,
        1 => ReboundAdhesionConfig::Coefficient { coefficient: any() },
        2 => ReboundAdhesionConfig::Work { work: any() },
        _ => ReboundAdhesionConfig::Speed { speed: any(), power: any() },
    }
}

fn damping<T: AnyNodes>() -> DampingConfig<T> {
    match black_box(0) {
        0 => DampingConfig::None,
        1 => DampingConfig::Hysteretic { zeta: any() },
        2 => DampingConfig::Viscoelastic { relaxation_time: any() },
        _ => DampingConfig::Constant { restitution: any() },
    }
}

fn adhesion<T: AnyNodes>() -> AdhesionConfig<T> {
    match black_box(0) {
        0 => AdhesionConfig::None,
        1 => AdhesionConfig::WithoutTension,
        2 => AdhesionConfig::Ring { strength: any(), zeta: any() },
        3 => AdhesionConfig::Dmt { work: any() },
        _ => AdhesionConfig::Jkr { work: any(), end: JkrEnd::SnapOff },
    }
}
