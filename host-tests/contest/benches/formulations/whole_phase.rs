//! Collocation of the energy over a whole phase with Gauss's plain nodes in z, where s = peak (1 - z^2).
//!
//! y^2 = 2 (V(peak) - V(s)) +- 2 integral of l(s) y ds from the peak, V = (2/5) A s^5 - (2/3) B s^3 and
//! l = 2 s^2 (A h s^2 + B g): with the losses still to come on approach, without those past on rebound. Iterations are
//! plain fixed points; each also moves the peak by one of Newton's steps. The contact time is the integral of 2 s/y.

use std::hint::black_box;

use crate::gauss::Nodes;
use contest::contestant::{Answer, Contestant};
use contest::problem::{Equations, Problem};

/// Numbers of nodes, and changes of the speeds at which the iterations end.
pub fn contestants(equations: Problem) -> Vec<Contestant> {
    let mut all = Vec::new();
    for digits in [4, 6, 8, 10, 12, 14] {
        all.push(contestant::<6>(equations, digits));
        all.push(contestant::<8>(equations, digits));
        all.push(contestant::<12>(equations, digits));
        all.push(contestant::<16>(equations, digits));
        all.push(contestant::<24>(equations, digits));
        all.push(contestant::<32>(equations, digits));
    }
    all
}

fn contestant<const N: usize>(equations: Problem, digits: i32) -> Contestant {
    let (nodes, converged) = (Nodes::<N>::new(), 10f64.powi(-digits));
    let setting = format!("{N} nodes to {converged:.0e}");
    Contestant::new("whole phase, plain Gauss", "fixed point", setting, move || {
        solve(black_box(&equations), &nodes, converged)
    })
}

const MOST_ITERATIONS: usize = 60;

fn solve<const N: usize>(problem: &Problem, nodes: &Nodes<N>, converged: f64) -> Option<Answer> {
    let start = problem.start()[1];
    let energy = 0.5 * start * start;
    let mut peak = 1.0;
    let (mut iterations, mut time) = (0, 0.0);
    let mut left = energy;
    for equations in [**problem, problem.on_rebound()] {
        let sign = if equations.rebound { -1.0 } else { 1.0 };
        let mut phase = Phase::new(&equations, nodes, peak);
        loop {
            let change = phase.iterate(nodes, sign);
            let lost = phase.lost(&nodes.weights);
            let mut moved = 0.0;
            if !equations.rebound {
                // The loss grows with about the fifth power of the peak.
                let excess = potential(&equations, peak) + lost - energy;
                moved = excess / (force(&equations, peak) + 5.0 * lost / peak);
                peak -= moved;
                phase.describe(&equations, nodes, peak);
            }
            iterations += 1;
            if change.max(moved.abs()) <= converged {
                break;
            }
            if iterations > MOST_ITERATIONS {
                return None;
            }
        }
        left = potential(&equations, peak) - if equations.rebound { phase.lost(&nodes.weights) } else { 0.0 };
        time += phase.time(nodes);
    }
    let answer = problem.answer([0.0, -(2.0 * left).sqrt(), time, 0.0], None);
    Some(Answer { impulse: None, effort: Some((iterations, "products")), ..answer })
}

struct Phase<const N: usize> {
    s: [f64; N],
    y: [f64; N],
    /// y^2 without losses.
    free: [f64; N],
    /// Energy lost for each dz and unit of speed.
    loss: [f64; N],
    /// Contact radius spent for each dz.
    spent: [f64; N],
}

impl<const N: usize> Phase<N> {
    fn new(equations: &Equations, nodes: &Nodes<N>, peak: f64) -> Self {
        let zeros = [0.0; N];
        let mut phase = Self { s: zeros, y: zeros, free: zeros, loss: zeros, spent: zeros };
        phase.describe(equations, nodes, peak);
        phase.y = phase.free.map(f64::sqrt);
        phase
    }

    fn describe(&mut self, equations: &Equations, nodes: &Nodes<N>, peak: f64) {
        let adhesion = if equations.rebound { equations.adhesion * equations.adhesion_damping } else { 0.0 };
        for j in 0..N {
            self.s[j] = peak * (1.0 - nodes.z[j] * nodes.z[j]);
            self.free[j] = 2.0 * (potential(equations, peak) - potential(equations, self.s[j]));
            self.spent[j] = 2.0 * peak * nodes.z[j];
            let square = self.s[j] * self.s[j];
            let loss = 2.0 * square * (equations.elastic * equations.material_damping * square + adhesion);
            self.loss[j] = loss * self.spent[j];
        }
    }

    /// One fixed-point step; the largest change of a speed.
    fn iterate(&mut self, nodes: &Nodes<N>, sign: f64) -> f64 {
        let mut lost = [0.0; N];
        for (row, (loss, y)) in nodes.integration.iter().zip(self.loss.iter().zip(&self.y)) {
            for (lost, weight) in lost.iter_mut().zip(row) {
                *lost += weight * loss * y;
            }
        }
        let mut change = 0.0;
        for ((before, free), lost) in self.y.iter_mut().zip(&self.free).zip(lost) {
            let y = (free + sign * 2.0 * lost).max(0.0).sqrt();
            change = f64::max(change, (y - *before).abs());
            *before = y;
        }
        change
    }

    fn lost(&self, weights: &[f64; N]) -> f64 {
        (0..N).map(|j| weights[j] * self.loss[j] * self.y[j]).sum()
    }

    fn time(&self, nodes: &Nodes<N>) -> f64 {
        (0..N).map(|j| nodes.weights[j] * 2.0 * self.s[j] * self.spent[j] / self.y[j]).sum()
    }
}

fn potential(equations: &Equations, s: f64) -> f64 {
    s * s * s * (0.4 * equations.elastic * s * s - 2.0 / 3.0 * equations.adhesion)
}

/// The slope of the potential.
fn force(equations: &Equations, s: f64) -> f64 {
    2.0 * s * s * (equations.elastic * s * s - equations.adhesion)
}
