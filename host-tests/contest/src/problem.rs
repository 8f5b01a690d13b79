//! The regularised equations with four quantities and the units of a scene.

use std::ops::Deref;

use microimpact::contact::RingScene;
use microimpact::{NormalMotion, Sphere, Stiffness};

use super::contestant::Answer;
use microimpact_scenes::methods::regularised::Regularised;

/// Contact radius, speed, time and Hertz impulse.
pub type Vector = [f64; 4];

/// The equations in double precision.
pub type Equations = Regularised<f64>;

/// The equations of a scene, and what their solution means in SI units.
#[derive(Clone, Copy)]
pub struct Problem {
    equations: Equations,
    units: Units,
}

/// A Hertz impulse and a contact time of one, in SI units.
#[derive(Clone, Copy)]
struct Units {
    time: f64,
    impulse: f64,
}

impl Problem {
    /// The equations of a motion.
    pub fn new(scene: &RingScene<f64>, stiffness: Stiffness<f64>, motion: &NormalMotion<f64>) -> Self {
        let equations = Equations::new(&scene.groups(motion).expect("the scene can be represented"));
        let units = Units::new(&equations, scene.sphere(), stiffness, motion);
        Self { equations, units }
    }

    /// The state at first contact.
    pub fn start(&self) -> Vector {
        self.equations.start()
    }

    /// What the state at separation says.
    #[inline]
    pub fn answer(&self, state: Vector, evaluations: Option<usize>) -> Answer {
        let [_, _, time, impulse] = state;
        Answer {
            restitution: self.equations.restitution(&state),
            contact_time: Some(time * self.units.time),
            impulse: Some(impulse * self.units.impulse),
            effort: evaluations.map(|count| (count, "evaluations")),
        }
    }
}

impl Deref for Problem {
    type Target = Equations;

    fn deref(&self) -> &Equations {
        &self.equations
    }
}

impl Units {
    fn new(equations: &Equations, sphere: &Sphere<f64>, stiffness: Stiffness<f64>, motion: &NormalMotion<f64>) -> Self {
        let speed = motion.speed() / equations.speed();
        // A is sqrt(r) K length^(5/2)/(m speed^2).
        let stiffness = sphere.radius().sqrt() * stiffness.pascals();
        let length = (equations.elastic * sphere.mass() * speed * speed / stiffness).powf(0.4);
        Self { time: length / speed, impulse: sphere.mass() * speed }
    }
}
