//! Scenes of normal motion, from rows of the reference.

use microimpact::contact::{Contact, HertzScene, RingScene, Status};
use microimpact::{NormalMotion, Real, Sphere, Stiffness};
use reference::Case;
use truth::{Outcome, Scene};

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

/// The solution of the inputs of a row, to 20 digits; `None` of a capture.
pub fn solve_exactly(case: &Case) -> Option<Answer> {
    let scene = Scene {
        radius: case.number("radius_m"),
        density: case.number("density_kg_m3"),
        gyration_ratio: 0.4,
        stiffness: case.number("stiffness_pa"),
        adhesion: case.number("adhesion_n_m"),
        material_damping: case.number("zeta_h"),
        adhesion_damping: case.number("zeta_a"),
        friction: 0.0,
        peeling: 0.0,
        force: 0.0,
        speed: case.number("speed_normal_m_s"),
        tangential: 0.0,
        spin: 0.0,
    };
    let truth = truth::solve(&scene, MOST_STEPS);
    (truth.outcome == Some(Outcome::Rebound)).then(|| Answer {
        restitution: truth.restitution_squared.sqrt().to_f64(),
        contact_time: Some(truth.time.to_f64()),
        impulse: Some(truth.elastic_impulse.to_f64()),
        effort: None,
    })
}

/// Of the series that [`solve_exactly`] takes.
const MOST_STEPS: u32 = 1_000_000;

/// A value that counts only where the method came to its end.
pub fn solved<T>(value: T, status: Status) -> Option<T> {
    (status == Status::Solved).then_some(value)
}
