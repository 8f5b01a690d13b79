//! The regularised equations in the contact radius s, in which the motion is smooth and free of roots.
//!
//! ds/dz = y,   dy/dz = 2 s^2 (B (1 - g y) - A s^2 (1 + h y)),   dt/dz = 2 s,   dI/dz = 2 A s^4
//!
//! with g = 0 on approach.

use microimpact::simulation::Groups;
use microimpact::{NormalMotion, Sphere, Stiffness};

use super::contestant::Answer;

/// The equations, with the variable that they are solved against.
///
/// A, B, h and g are `elastic`, `adhesion`, `material_damping` and `adhesion_damping`.
#[derive(Clone, Copy)]
pub struct Regularised {
    pub elastic: f64,
    pub adhesion: f64,
    pub material_damping: f64,
    pub adhesion_damping: f64,
    /// Whether the sphere is on its way out.
    pub rebound: bool,
    /// The independent variable.
    pub against: Variable,
    units: Units,
}

/// An independent variable: z, or what has a given value at an event, so that the event is met exactly.
#[derive(Clone, Copy)]
pub enum Variable {
    Stretched,
    Speed,
    Radius,
}

/// Contact radius, speed, time and Hertz impulse.
pub type Vector = [f64; 4];

/// A Hertz impulse and a contact time of one, in SI units.
#[derive(Clone, Copy)]
struct Units {
    time: f64,
    impulse: f64,
}

impl Regularised {
    pub fn new(
        groups: &Groups<f64>,
        sphere: &Sphere<f64>,
        stiffness: Stiffness<f64>,
        motion: &NormalMotion<f64>,
    ) -> Self {
        let mut equations = Self {
            elastic: groups.elasticity,
            adhesion: groups.adhesion,
            material_damping: groups.material_damping,
            adhesion_damping: groups.adhesion_damping,
            rebound: false,
            against: Variable::Stretched,
            units: Units { time: 1.0, impulse: 1.0 },
        };
        let speed = motion.speed() / equations.start()[1];
        // A is sqrt(r) K length^(5/2)/(m speed^2).
        let stiffness = sphere.radius().sqrt() * stiffness.pascals();
        let length = (equations.elastic * sphere.mass() * speed * speed / stiffness).powf(0.4);
        equations.units = Units { time: length / speed, impulse: sphere.mass() * speed };
        equations
    }

    /// The equations on the way out.
    pub fn on_rebound(self) -> Self {
        Self { rebound: true, ..self }
    }

    /// The equations with another independent variable.
    pub fn against(self, variable: Variable) -> Self {
        Self { against: variable, ..self }
    }

    /// Speed at first touch: the scale of length is the undamped peak, where this energy is spent.
    pub fn start(&self) -> Vector {
        [0.0, (0.8 * self.elastic - 4.0 / 3.0 * self.adhesion).sqrt(), 0.0, 0.0]
    }

    #[inline]
    pub fn rates(&self, [s, y, _, _]: Vector) -> Vector {
        let square = s * s;
        let lost = if self.rebound { self.adhesion_damping * y } else { 0.0 };
        let pull = self.adhesion * (1.0 - lost) - self.elastic * square * (1.0 + self.material_damping * y);
        let rates = [y, 2.0 * square * pull, 2.0 * s, 2.0 * self.elastic * square * square];
        let share = match self.against {
            Variable::Stretched => return rates,
            Variable::Speed => 1.0 / rates[1],
            Variable::Radius => 1.0 / rates[0],
        };
        rates.map(|rate| rate * share)
    }

    /// What the state at separation says.
    #[inline]
    pub fn answer(&self, [_, y, time, impulse]: Vector, evaluations: Option<usize>) -> Answer {
        Answer {
            restitution: -y / self.start()[1],
            contact_time: Some(time * self.units.time),
            impulse: Some(impulse * self.units.impulse),
            effort: evaluations.map(|count| (count, "evaluations")),
        }
    }
}
