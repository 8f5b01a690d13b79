//! The regularised equations in the contact radius s, in which the motion is smooth and free of roots.
//!
//! ds/dz = y,   dy/dz = 2 s^2 (B (1 - g y) - A s^2 (1 + h y)),   dt/dz = 2 s,   dI/dz = 2 A s^4
//!
//! with g = 0 on approach.

use std::f64::consts::PI;

use host_tests::Case;

use crate::contestant::Answer;

/// The equations, with the variable that they are solved against.
#[derive(Clone, Copy)]
pub struct Regularised {
    elastic: f64,
    adhesion: f64,
    material_damping: f64,
    adhesion_damping: f64,
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
    pub fn of(case: &Case) -> Self {
        let (elastic, adhesion) = (case.number("group_a"), case.number("group_b"));
        let mut equations = Self {
            elastic,
            adhesion,
            material_damping: case.number("group_h"),
            adhesion_damping: case.number("group_g"),
            rebound: false,
            against: Variable::Stretched,
            units: Units { time: 1.0, impulse: 1.0 },
        };
        let radius = case.number("radius_m");
        let mass = 4.0 / 3.0 * PI * radius.powi(3) * case.number("density_kg_m3");
        let speed = case.number("speed_normal_m_s") / equations.start()[1];
        // A is sqrt(r) K length^(5/2)/(m speed^2).
        let length = (elastic * mass * speed * speed / (radius.sqrt() * case.number("stiffness_pa"))).powf(0.4);
        equations.units = Units { time: length / speed, impulse: mass * speed };
        equations
    }

    /// The equations on the way out.
    pub fn on_rebound(self) -> Self {
        Self { rebound: true, ..self }
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

    /// The contact by a solver that finds no events: from a state at one value of the variable to another, four times.
    ///
    /// `places` are values of z shortly before the peak and the separation.
    #[inline]
    pub fn without_events(
        self,
        places: [f64; 2],
        mut leg: impl FnMut(Self, f64, Vector, f64) -> Option<Vector>,
    ) -> Option<Vector> {
        let short = leg(self, 0.0, self.start(), places[0])?;
        let peak = leg(Self { against: Variable::Speed, ..self }, short[1], short, 0.0)?;
        let back = self.on_rebound();
        let short = leg(back, 0.0, peak, places[1])?;
        leg(Self { against: Variable::Radius, ..back }, short[0], short, 0.0)
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

/// Place of a sign change of `value` between two places, by the Illinois method.
pub fn sign_change(mut low: (f64, f64), mut high: (f64, f64), mut value: impl FnMut(f64) -> f64) -> f64 {
    let mut place = high.0;
    for _ in 0..12 {
        place = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
        let value = value(place);
        if value.abs() < 1e-15 {
            break;
        }
        if value > 0.0 {
            low = (place, value);
            high.1 *= 0.5;
        } else {
            high = (place, value);
            low.1 *= 0.5;
        }
    }
    place
}
