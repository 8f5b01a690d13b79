//! Methods tried on one impact, and the bounds they are held to.

use microimpact::contact::Collocation;
use reference::grids::Impact;

use super::independent;
use super::solution::{
    Found, TOLERANCE, by_the_paper, exactly, in_double_precision, in_fixed_point, in_single_precision,
};

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Method {
    Double,
    Single,
    Fixed,
    Paper,
}

impl Method {
    pub(super) const ALL: [Self; 4] = [Self::Double, Self::Single, Self::Fixed, Self::Paper];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Double => "f64",
            Self::Single => "f32",
            Self::Fixed => "fixed point",
            Self::Paper => "the paper's method, f64",
        }
    }

    /// What solves the scenes.
    pub(super) const fn text(self) -> &'static str {
        match self {
            Self::Double => "Adaptive, 1e-11",
            Self::Single => "Collocation<8>, 1e-6",
            Self::Fixed => "FixedCost<4>, 2 iterations",
            Self::Paper => "Runge-Kutta-Gill, 1000 steps",
        }
    }

    /// Of its files.
    pub(super) const fn file(self) -> &'static str {
        match self {
            Self::Double => "f64",
            Self::Single => "f32",
            Self::Fixed => "fixed",
            Self::Paper => "paper",
        }
    }

    /// Largest error: of e^2 and of the peak indentation, in fixed point of e.
    pub(super) const fn bound(self) -> f64 {
        match self {
            // The error that the adaptive method promises.
            Self::Double => 3.0 * TOLERANCE,
            Self::Single => 2e-6,
            // What rounding adds to the error of the method.
            Self::Fixed => 1e-5,
            // Not a promise; what is worse is no solution.
            Self::Paper => 1e-3,
        }
    }

    /// Largest energy balance error, over the energy of the motion.
    pub(super) const fn ledger_bound(self) -> f64 {
        match self {
            // The errors of e^2 and of the works.
            Self::Double => 1e-10,
            Self::Single => 2e-5,
            Self::Fixed | Self::Paper => 1e-3,
        }
    }
}

/// Errors up to this one are rounding.
pub(super) const ROUNDING: f64 = 1e-16;

/// Intervals after which a run gives up.
pub(super) const MOST_INTERVALS: u32 = Collocation::<14, f64>::MOST_INTERVALS;

/// What became of a method on an impact.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    pub(super) assessment: Assessment,
    /// Where there is a solution.
    pub(super) error: Option<f64>,
    pub(super) steps: Option<u32>,
    pub(super) residual: Option<f64>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Assessment {
    /// An input lies outside its range.
    Refused,
    Within,
    /// e^2, in fixed point e, errs by more than the bound.
    InexactRestitution,
    InexactPeak,
    /// The energy balance error exceeds the bound.
    UnbalancedEnergy,
    /// A capture for a rebound or the reverse, by more than the bound.
    WrongOutcome,
    NoSolution,
    /// Closer to the boundary between capture and rebound than the error.
    Undecided,
    /// No solution in fixed point and none in double precision, because the impact is damped too strongly for a method of fixed
    /// cost; or no bound.
    Declined,
    TooManySteps,
}

impl Assessment {
    pub(super) const fn text(self) -> &'static str {
        match self {
            Self::Refused => "refused",
            Self::Within => "within the bound",
            Self::InexactRestitution => "restitution beyond the bound",
            Self::InexactPeak => "peak indentation beyond the bound",
            Self::UnbalancedEnergy => "energy balance error beyond the bound",
            Self::WrongOutcome => "wrong outcome",
            Self::NoSolution => "did not converge",
            Self::Undecided => "undecided",
            Self::Declined => "outside the range of the method",
            Self::TooManySteps => "too many steps",
        }
    }

    /// Whether the method takes the scene.
    pub(super) const fn applies(self) -> bool {
        !matches!(self, Self::Refused | Self::Declined)
    }

    pub(super) const fn fails(self) -> bool {
        !matches!(self, Self::Refused | Self::Declined | Self::Undecided | Self::Within)
    }
}

/// An impact with all that was tried on it.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// e; `None` where an input is refused.
    pub(super) restitution: Option<f64>,
    /// The stronger of both damping groups, h of the materials and g of adhesion.
    pub(super) damping: Option<f64>,
    /// In the order of [`Method::ALL`].
    pub(super) trials: [Trial; 4],
    /// Difference of e^2 from an independent solution, where there is one.
    pub(super) unlike: Option<f64>,
}

impl Point {
    const REFUSED: Self = Self { restitution: None, damping: None, trials: [Trial::REFUSED; 4], unlike: None };

    pub(super) fn at(impact: Option<Impact>) -> Self {
        let Some((impact, exact)) = impact.and_then(|impact| Some((impact, exactly(&impact).ok()?))) else {
            return Self::REFUSED;
        };
        let single = impact.in_single_precision();
        let trials = [
            Trial::of(Method::Double, in_double_precision(&impact).ok(), Some(exact)),
            Trial::of(Method::Single, in_single_precision(&single).ok(), exactly(&single).ok()),
            Trial::in_fixed_point(&single),
            Trial::of(Method::Paper, by_the_paper(&impact).ok(), Some(exact)),
        ];
        let unlike = exact.solution.and_then(|exact| Some((independent::confirmed(&impact)? - exact.square).abs()));
        Self { restitution: exact.solution.map(|exact| exact.square.sqrt()), damping: impact.damping(), trials, unlike }
    }

    pub(super) fn trial(&self, method: Method) -> &Trial {
        &self.trials[method as usize]
    }
}

impl Trial {
    const REFUSED: Self = Self { assessment: Assessment::Refused, error: None, steps: None, residual: None };

    fn of(method: Method, found: Option<Found>, exact: Option<Found>) -> Self {
        let Some(found) = found else {
            return Self::REFUSED;
        };
        let unsolved = Self {
            assessment: Assessment::NoSolution,
            error: None,
            steps: Some(found.steps),
            residual: found.residual,
        };
        if found.undecided || exact.is_some_and(|exact| exact.undecided) {
            return Self { assessment: Assessment::Undecided, ..unsolved };
        }
        let (Some(solution), Some(exact)) = (found.solution, exact.and_then(|exact| exact.solution)) else {
            return unsolved;
        };
        let error = solution.error(&exact);
        let bound = method.bound();
        let assessment = match method {
            _ if error > bound && solution.rebounds != exact.rebounds => Assessment::WrongOutcome,
            _ if solution.error_of_square(&exact) > bound => Assessment::InexactRestitution,
            // NaN is beyond it too.
            _ if error.is_nan() || error > bound => Assessment::InexactPeak,
            Method::Paper if found.residual.is_some_and(|residual| residual > method.ledger_bound()) => {
                Assessment::UnbalancedEnergy
            }
            Method::Double | Method::Single if found.steps > MOST_INTERVALS => Assessment::TooManySteps,
            _ => Assessment::Within,
        };
        Self { assessment, error: Some(error).filter(|error| !error.is_nan()), ..unsolved }
    }

    /// The error is what fixed point adds to that of e in double precision by the same method. Its bound holds where e exceeds
    /// 0.2 and p is below 0.95; the outcome is that of double precision wherever e exceeds 0.02.
    fn in_fixed_point(impact: &Impact) -> Self {
        let Ok((narrow, wide)) = in_fixed_point(impact) else {
            return Self::REFUSED;
        };
        let of = |assessment, error| Self { assessment, error, steps: Some(narrow.steps), residual: None };
        let (solution, wide) = match (narrow.solution, wide.solution) {
            (Some(narrow), Some(wide)) => (narrow, wide),
            _ if narrow.undecided => return of(Assessment::Undecided, None),
            (None, None) => return of(Assessment::Declined, None),
            _ => return of(Assessment::NoSolution, None),
        };
        let [e, of_wide] = [solution, wide].map(|solution| solution.square.sqrt());
        if solution.rebounds != wide.rebounds && of_wide.max(e) > 0.02 {
            return of(Assessment::WrongOutcome, None);
        }
        if of_wide <= 0.2 || impact.adhesion_strength().is_none_or(|p| p >= 0.95) {
            return of(Assessment::Declined, None);
        }
        let error = (e - of_wide).abs();
        let exceeds = error > Method::Fixed.bound();
        of(if exceeds { Assessment::InexactRestitution } else { Assessment::Within }, Some(error))
    }
}
