//! The regularised equations in the contact radius s, in which the motion is smooth and free of roots.
//!
//! ds/dz = y,   dy/dz = 2 s^2 (B (1 - g y) - A s^2 (1 + h y)),   dt/dz = 2 s,   dI/dz = 2 A s^4
//!
//! with g = 0 on approach.

use core::hint::black_box;

use microimpact::contact::Groups;
use microimpact::{FixedPoint, Real};

use super::inputs::Inputs;
use super::{Amount, Contestant, Extent, Number, Reply, Task, Variant, Visitor, runge_kutta};

/// Name of the Runge-Kutta method on these equations.
pub const NAME: &str = "RK4 in z";

/// The equations, with the variable that they are solved against.
///
/// A, B, h and g are `elastic`, `adhesion`, `material_damping` and `adhesion_damping`.
#[derive(Clone, Copy, Debug)]
pub struct Regularised<T> {
    /// A.
    pub elastic: T,
    /// B.
    pub adhesion: T,
    /// h.
    pub material_damping: T,
    /// g.
    pub adhesion_damping: T,
    /// Whether the sphere is on its way out.
    pub rebound: bool,
    /// The independent variable.
    pub against: Variable,
}

/// An independent variable: z, or what has a given value at an event, so that the event is met exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// z.
    Stretched,
    /// y.
    Speed,
    /// s.
    Radius,
}

impl<T: Real> Regularised<T> {
    /// The approach against z.
    pub fn new(groups: &Groups<T>) -> Self {
        Self {
            elastic: groups.elasticity,
            adhesion: groups.adhesion,
            material_damping: groups.material_damping,
            adhesion_damping: groups.adhesion_damping,
            rebound: false,
            against: Variable::Stretched,
        }
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
    pub fn speed(&self) -> T {
        (T::constant(0.8) * self.elastic - T::constant(4.0 / 3.0) * self.adhesion).sqrt()
    }

    /// The state at first touch: contact radius and speed and, with four quantities, time and Hertz impulse.
    pub fn start<const S: usize>(&self) -> [T; S] {
        let mut state = [T::ZERO; S];
        state[1] = self.speed();
        state
    }

    /// Rates of contact radius and speed and, with four quantities, of time and Hertz impulse.
    #[inline]
    pub fn rates<const S: usize>(&self, state: [T; S]) -> [T; S] {
        let (s, y) = (state[0], state[1]);
        let square = s * s;
        let twice = square + square;
        let lost = if self.rebound { self.adhesion_damping * y } else { T::ZERO };
        let elastic = self.elastic * square;
        let pull = self.adhesion * (T::ONE - lost) - elastic * (T::ONE + self.material_damping * y);
        let mut rates = [T::ZERO; S];
        rates[0] = y;
        rates[1] = twice * pull;
        if let [_, _, time, impulse] = rates.as_mut_slice() {
            *time = s + s;
            *impulse = twice * elastic;
        }
        let per_variable = match self.against {
            Variable::Stretched => return rates,
            Variable::Speed => T::ONE / rates[1],
            Variable::Radius => T::ONE / rates[0],
        };
        rates.map(|rate| rate * per_variable)
    }

    /// e of the state at separation.
    #[inline]
    pub fn restitution<const S: usize>(&self, state: &[T; S]) -> T {
        -state[1] / self.speed()
    }

    /// The contact by a solver that finds no events: from a state at one value of the variable to another, four times.
    ///
    /// `places` are values of z shortly before the peak, and from there before the separation.
    #[inline]
    pub fn without_events<const S: usize>(
        self,
        places: [T; 2],
        mut leg: impl FnMut(Self, T, [T; S], T) -> Option<[T; S]>,
    ) -> Option<[T; S]> {
        let short = leg(self, T::ZERO, self.start(), places[0])?;
        let peak = leg(self.against(Variable::Speed), short[1], short, T::ZERO)?;
        let back = self.on_rebound();
        let short = leg(back, T::ZERO, peak, places[1])?;
        leg(back.against(Variable::Radius), short[0], short, T::ZERO)
    }

    /// The contact by the classical Runge-Kutta method with a fixed step in z, its events by a last step against their
    /// own variable; the state at separation, the values of z from event to event, and evaluations.
    pub fn solve<const S: usize>(&self, step: T, most: u32) -> Option<([T; S], [T; 2], u32)> {
        let mut evaluations = 0;
        let mut leg = |equations: &Self, mut state: [T; S], event: usize, variable: Variable| {
            let mut place = T::ZERO;
            for _ in 0..most {
                let next = runge_kutta::step(|state| equations.rates(state), state, step);
                evaluations += 4;
                if next[event] <= T::ZERO {
                    evaluations += 4;
                    place = place + step * state[event] / (state[event] - next[event]);
                    let against = equations.against(variable);
                    return Some((runge_kutta::step(|state| against.rates(state), state, -state[event]), place));
                }
                (state, place) = (next, place + step);
            }
            None
        };
        let (mut peak, to_peak) = leg(self, self.start(), 1, Variable::Speed)?;
        peak[1] = T::ZERO;
        let (end, to_separation) = leg(&self.on_rebound(), peak, 0, Variable::Radius)?;
        Some((end, [to_peak, to_separation], evaluations))
    }
}

/// z of an undamped contact without adhesion: twice the integral of ds/sqrt(1 - s^5) from 0 to 1.
pub const UNDAMPED_LENGTH: f64 = 2.538;

/// A motion that takes this many times the undamped length is given up.
pub const LONGEST: u32 = 12;

/// Numbers of steps in a contact of the undamped length.
pub fn visit<T: Number>(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    let Ok((scene, motion)) = inputs.normal::<T>() else { return };
    for steps in extent.steps(8).take_while(|&steps| steps <= MOST_STEPS) {
        visitor.visit::<T>(contestant(steps), move || {
            let equations = Regularised::new(&black_box(&scene).groups(black_box(&motion)).ok()?);
            stepped(&equations, steps)
        });
    }
}

/// The same in fixed point, with groups computed before.
pub fn visit_fixed_point(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    let Some(groups) = inputs.normal::<f32>().ok().and_then(|(scene, motion)| scene.groups(&motion).ok()) else {
        return;
    };
    let fixed = |value: f32| FixedPoint::nearest(f64::from(value));
    let equations = Regularised::new(&Groups {
        elasticity: fixed(groups.elasticity),
        adhesion: fixed(groups.adhesion),
        material_damping: fixed(groups.material_damping),
        adhesion_damping: fixed(groups.adhesion_damping),
    });
    for steps in extent.steps(8).take_while(|&steps| steps <= MOST_STEPS) {
        visitor.visit::<FixedPoint>(contestant(steps), move || stepped(black_box(&equations), steps));
    }
}

/// Beyond which rounding outweighs the error of the steps.
const MOST_STEPS: u32 = 4096;

fn contestant(steps: u32) -> Contestant {
    Contestant { task: Task::Normal, method: NAME, variant: Variant::Only, amount: Amount::Steps(steps) }
}

fn stepped<T: Number>(equations: &Regularised<T>, steps: u32) -> Option<Reply<T>> {
    let step = T::constant(UNDAMPED_LENGTH / f64::from(black_box(steps)));
    let (end, ..) = equations.solve::<2>(step, steps.saturating_mul(LONGEST))?;
    Some(Reply::normal(equations.restitution(&end)))
}
