//! Scenes of normal motion, from rows of the reference.

use microimpact::contact::{Contact, HertzScene, RingScene, Status};
use microimpact::{NormalMotion, Real, Sphere, Stiffness};
use reference::Case;

use super::contestant::Answer;

/// The normal motion of a row.
pub fn normal_scene<T: Real>(case: &Case) -> (RingScene<T>, NormalMotion<T>) {
    let number = |column| T::constant(case.number(column));
    let (scene, motion) = hertz_scene(case);
    (scene.with_ring(number("adhesion_n_m"), number("zeta_a")).unwrap(), motion)
}

/// The same without adhesion.
pub fn hertz_scene<T: Real>(case: &Case) -> (HertzScene<T>, NormalMotion<T>) {
    let number = |column| T::constant(case.number(column));
    let sphere = Sphere::solid(number("radius_m"), number("density_kg_m3")).unwrap();
    let scene = Contact::hertz(sphere, Stiffness::new(number("stiffness_pa")).unwrap());
    (scene.with_damping(number("zeta_h")).unwrap(), NormalMotion::new(number("speed_normal_m_s")).unwrap())
}

/// The solution of a row.
pub fn solution(case: &Case) -> Answer {
    Answer {
        restitution: case.number("restitution"),
        contact_time: Some(case.number("contact_time_s")),
        impulse: Some(case.number("impulse_hertz_n_s")),
        effort: None,
    }
}

/// A value that counts only where the method came to its end.
pub fn solved<T>(value: T, status: Status) -> Option<T> {
    (status == Status::Solved).then_some(value)
}
