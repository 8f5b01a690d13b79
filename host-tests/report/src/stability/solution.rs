//! What a method finds of an impact.

use microimpact::contact::{Adaptive, Collocation, Energy, FixedCost, Method, RungeKuttaGill, Status, Works};
use microimpact::{InputError, Outcome, Real};
use reference::grids::Impact;

/// How a run ended, in double precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    /// `None` where the run spent its budget, or does not decide.
    pub(super) solution: Option<Solution>,
    /// Whether it does not decide.
    pub(super) undecided: bool,
    /// Intervals or steps, refused ones included.
    pub(super) steps: u32,
    /// Energy balance error over the energy before; of a capture along the normal alone, over the largest kinetic energy of
    /// the undamped motion.
    pub(super) residual: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Solution {
    pub(super) rebounds: bool,
    /// e^2.
    pub(super) square: f64,
    /// m; `None` where there is none, or the method does not report it.
    pub(super) peak: Option<f64>,
}

impl Solution {
    /// Largest error of e^2, absolute, and of the peak indentation, relative; NaN where only one of both has a peak.
    pub(super) fn error(&self, exact: &Self) -> f64 {
        let peak = match (self.peak, exact.peak) {
            (Some(peak), Some(exact)) => (peak / exact - 1.0).abs(),
            (None, None) => 0.0,
            _ => f64::NAN,
        };
        let square = self.error_of_square(exact);
        if peak.is_nan() { peak } else { square.max(peak) }
    }

    pub(super) fn error_of_square(&self, exact: &Self) -> f64 {
        (self.square - exact.square).abs()
    }
}

/// The setting that the others are measured by.
pub(super) fn exactly(impact: &Impact) -> Result<Found, InputError> {
    solve::<f64>(impact, &Collocation::<14, f64>::new(1e-13)?)
}

/// Tolerance of the adaptive method in the maps.
pub(super) const TOLERANCE: f64 = 1e-11;

pub(super) fn in_double_precision(impact: &Impact) -> Result<Found, InputError> {
    solve::<f64>(impact, &Adaptive::new(TOLERANCE)?)
}

pub(super) fn in_single_precision(impact: &Impact) -> Result<Found, InputError> {
    solve::<f32>(impact, &Collocation::<8, f32>::new(1e-6)?)
}

/// Steps of the paper's method in the duration of Hertz's impact.
pub(super) const STEPS: u32 = 1000;

pub(super) fn by_the_paper(impact: &Impact) -> Result<Found, InputError> {
    solve::<f64>(impact, &RungeKuttaGill::new(STEPS))
}

/// Fixed point and, by the same method, double precision; neither where one leaves the outcome undecided.
pub(super) fn in_fixed_point(impact: &Impact) -> Result<(Found, Found), InputError> {
    let groups = impact.scene::<f32>()?.dimensionless(&impact.motion::<f32>()?)?;
    let method = FixedCost::<4>::new(2)?;
    let narrow = groups.in_fixed_point()?.solve(&method);
    let wide = impact.scene::<f64>()?.dimensionless(&impact.motion::<f64>()?)?.solve(&method);
    let undecided = [narrow.outcome, wide.outcome].contains(&Some(Outcome::Undecided));
    let found = |outcome: Option<Outcome>, square: f64| Found {
        solution: outcome.filter(|_| !undecided).map(|outcome| Solution {
            rebounds: outcome == Outcome::Rebound,
            square,
            peak: None,
        }),
        undecided,
        steps: 2,
        residual: None,
    };
    Ok((found(narrow.outcome, narrow.restitution_squared.to_f64()), found(wide.outcome, wide.restitution_squared)))
}

fn solve<T: Real + Into<f64>>(impact: &Impact, method: &impl Method<T>) -> Result<Found, InputError> {
    let scene = impact.scene::<T>()?;
    let (simulated, (works, ledger)) = scene.solve_for(&impact.motion()?, method, (Works, Energy))?;
    let (run, normal) = (&simulated.run, &simulated.normal);
    let square: f64 = normal.overall_restitution().into();
    let outcome = normal.outcome().filter(|_| run.status == Status::Solved);
    let undecided = outcome == Some(Outcome::Undecided);
    let solution = outcome.filter(|_| !undecided).map(|outcome| Solution {
        rebounds: outcome == Outcome::Rebound,
        square: square * square,
        peak: normal.peak_indentation().map(Into::into),
    });
    let residual = match solution {
        Some(Solution { rebounds: true, .. }) => ledger.map(|ledger| {
            let [before, after, lost] = [ledger.before, ledger.after, ledger.lost()].map(Into::<f64>::into);
            (before, (before - after - lost) / before)
        }),
        Some(_) => normal.turning_indentation().map(|turning| {
            let taken = [works.material, works.adhesion].map(Into::<f64>::into);
            let before = 0.5 * impact.mass() * impact.speed * impact.speed;
            let largest = before - impact.potential(impact.equilibrium());
            (largest, (before - impact.potential(turning.into()) - taken[0] - taken[1]) / largest)
        }),
        None => None,
    };
    // Energies in joules of particles so small that single precision cannot hold them say nothing.
    let smallest = T::constant(f64::from(f32::MIN_POSITIVE) / f64::from(f32::EPSILON)).into();
    let residual = residual.filter(|(scale, _)| *scale > smallest).map(|(_, residual)| residual.abs());
    Ok(Found { solution, undecided, steps: run.steps + run.refused, residual })
}
