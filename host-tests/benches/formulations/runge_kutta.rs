//! The classical Runge-Kutta method of order 4 with a fixed step on the regularised equations.
//!
//! An event is met by a last step against its own variable (Henon 1982), from the last point before it.

use std::hint::black_box;

use crate::common::contestant::Contestant;
use crate::common::regularised::{Regularised, Variable, Vector};

/// Numbers of steps in a contact of the length that an undamped one without adhesion has in z.
pub fn contestants(equations: Regularised) -> Vec<Contestant> {
    let contestant = |octaves: u32| {
        let steps = 8 << octaves;
        Contestant::new("Runge-Kutta 4 in s(z)", "Henon's events", format!("{steps} steps"), move || {
            let (end, evaluations) = solve(black_box(&equations), UNDAMPED_LENGTH / f64::from(steps))?;
            Some(equations.answer(end, Some(evaluations)))
        })
    };
    (0..11).map(contestant).collect()
}

/// Twice the integral of ds/sqrt(1 - s^5) from 0 to 1.
pub const UNDAMPED_LENGTH: f64 = 2.538;

/// A motion that takes this many times the undamped length is given up.
pub const LONGEST: f64 = 30.0;

fn solve(equations: &Regularised, step: f64) -> Option<(Vector, usize)> {
    let mut evaluations = 0;
    let mut leg = |equations: &Regularised, mut state: Vector, event: usize, variable: Variable| {
        for _ in 0..(LONGEST / step) as u32 {
            let next = advance(equations, state, step);
            evaluations += 4;
            if next[event] <= 0.0 {
                evaluations += 4;
                return Some(advance(&equations.against(variable), state, -state[event]));
            }
            state = next;
        }
        None
    };
    let mut peak = leg(equations, equations.start(), 1, Variable::Speed)?;
    peak[1] = 0.0;
    let end = leg(&equations.on_rebound(), peak, 0, Variable::Radius)?;
    Some((end, evaluations))
}

fn advance(equations: &Regularised, state: Vector, step: f64) -> Vector {
    let moved = |rates: &Vector, step: f64| std::array::from_fn(|i| state[i] + step * rates[i]);
    let first = equations.rates(state);
    let second = equations.rates(moved(&first, 0.5 * step));
    let third = equations.rates(moved(&second, 0.5 * step));
    let fourth = equations.rates(moved(&third, step));
    std::array::from_fn(|i| state[i] + step / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
}
