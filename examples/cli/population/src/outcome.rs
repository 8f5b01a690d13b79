//! Integrals of classes and restitutions over a population.
//!
//! The class of an impact jumps at the critical speed, so a quadrature across the jump converges slowly. One variable is
//! therefore integrated exactly: the *inner* variable, whose spread moves the impacts most across the critical speed. For given
//! values of the others, a search finds where the class changes along it, and its distribution function gives the probability
//! of each part. Restitution is integrated over the parts by nodes that are close at their ends, because it rises as a root
//! above the critical speed. As a function of the other variables the result jumps only at the angle of incidence above which
//! captured spheres slide; it is integrated adaptively, and samples are summed.

use microimpact::CriticalSpeed;

use crate::PopulationError;
use crate::distribution::Distribution;
use crate::quadrature::{Adaptive, Integrals, Rule};
use crate::response::Response;

/// The variables of an impact, in the order of their indices.
pub(crate) const DIAMETER: usize = 0;
pub(crate) const ADHESION: usize = 1;
pub(crate) const ANGLE: usize = 2;
pub(crate) const SPEED: usize = 3;
pub(crate) const VARIABLES: usize = 4;

/// Index of the first power of the restitution among the quantities; those of the classes come before.
pub(crate) const POWERS: usize = 4;

/// Intervals in which a change of the class is looked for.
const INTERVALS: usize = 16;

/// Iterations that locate a change of the class, and the width, relative to the interval, at which they end.
const ITERATIONS: usize = 60;
const WIDTH: f64 = 1e-12;

/// Orders of the rules for powers of the restitution.
const ORDERS: [usize; 2] = [18, 28];

/// Largest number of combinations of samples.
const MOST_COMBINATIONS: usize = 4_000_000;

/// Whether the contact point slides after an impact, and the restitution of a rebound.
struct Point {
    rebounds: bool,
    slides: bool,
    restitution: f64,
}

/// Whether an integral is to end without a result.
pub type Stop<'a> = dyn Fn() -> bool + Sync + 'a;

/// What is integrated.
pub(crate) struct Problem<'a, R> {
    distributions: &'a [Distribution; VARIABLES],
    response: &'a R,
    /// Variables with more than one value, the inner one last.
    order: Vec<usize>,
    with_powers: bool,
    adaptive: Adaptive,
    rules: [Rule; 2],
    stop: &'a Stop<'a>,
}

impl<'a, R: Response> Problem<'a, R> {
    pub(crate) fn new(
        distributions: &'a [Distribution; VARIABLES],
        response: &'a R,
        with_powers: bool,
        tolerance: f64,
        stop: &'a Stop<'a>,
    ) -> Result<Self, PopulationError> {
        let (adaptive, rules) = (Adaptive::over(1, tolerance), ORDERS.map(Rule::new));
        let mut problem = Self { distributions, response, order: Vec::new(), with_powers, adaptive, rules, stop };
        problem.order = problem.ordered()?;
        let continuous = problem.order.iter().filter(|variable| distributions[**variable].is_continuous());
        problem.adaptive = Adaptive::over(continuous.count().saturating_sub(1), tolerance);
        let sampled = problem.order.iter().filter(|variable| !distributions[**variable].is_continuous());
        let combinations = sampled.map(|variable| distributions[*variable].weighted_samples().len()).product::<usize>();
        if combinations > MOST_COMBINATIONS {
            return Err(PopulationError::TooManySamples { combinations, most: MOST_COMBINATIONS });
        }
        Ok(problem)
    }

    /// The variables that vary: samples first, the continuous one with the largest effect last.
    fn ordered(&self) -> Result<Vec<usize>, PopulationError> {
        let medians = [0, 1, 2, 3].map(|variable: usize| self.distributions[variable].quantile(0.5));
        let mut effects = Vec::new();
        for (variable, distribution) in self.distributions.iter().enumerate().filter(|(_, one)| !one.is_fixed()) {
            // Two standard deviations apart, if it is normal.
            let at = |p: f64| {
                let mut values = medians;
                values[variable] = distribution.quantile(p);
                self.logarithmic_excess(&values)
            };
            let effect = if distribution.is_continuous() { (at(0.84)? - at(0.16)?).abs() } else { -1.0 };
            effects.push((effect, variable));
        }
        effects.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(effects.into_iter().map(|(_, variable)| variable).collect())
    }

    /// Logarithm of the normal speed, over the critical speed if there is one.
    fn logarithmic_excess(&self, values: &[f64; VARIABLES]) -> Result<f64, PopulationError> {
        let normal = normal_speed(values);
        Ok(match self.response.critical_speed(values[DIAMETER], values[ADHESION])? {
            CriticalSpeed::At(critical) => (normal / critical).ln(),
            _ => normal.ln(),
        })
    }

    /// Negative for a capture.
    fn margin(&self, values: &[f64; VARIABLES]) -> Result<f64, PopulationError> {
        match self.response.critical_speed(values[DIAMETER], values[ADHESION])? {
            CriticalSpeed::At(critical) => Ok((normal_speed(values) / critical).ln()),
            CriticalSpeed::AlwaysRebounds => Ok(1.0),
            CriticalSpeed::NeverRebounds => Ok(-1.0),
        }
    }

    /// Positive if the contact point slides after an impact.
    fn excess_slip(&self, values: &[f64; VARIABLES], rebounds: bool) -> Result<f64, PopulationError> {
        let tangent = values[ANGLE].tan();
        if tangent == 0.0 {
            return Ok(-1.0);
        }
        let stopped = if rebounds {
            self.response.rebound(values[DIAMETER], values[ADHESION], normal_speed(values))?.stopped
        } else {
            self.response.stopped_in_capture(values[DIAMETER], values[ADHESION])?
        };
        Ok(tangent - stopped)
    }

    fn restitution(&self, values: &[f64; VARIABLES]) -> Result<f64, PopulationError> {
        Ok(self.response.rebound(values[DIAMETER], values[ADHESION], normal_speed(values))?.restitution)
    }

    /// The integrals over all variables.
    pub(crate) fn integrals(&self) -> Result<Integrals, PopulationError> {
        let mut values = [0, 1, 2, 3].map(|variable: usize| self.distributions[variable].bounds()[0]);
        self.over(&self.order, &mut values)
    }

    /// The integrals over some variables for given values of the others.
    fn over(&self, variables: &[usize], values: &mut [f64; VARIABLES]) -> Result<Integrals, PopulationError> {
        if (self.stop)() {
            return Err(PopulationError::Stopped);
        }
        let [variable, others @ ..] = variables else {
            return Ok(self.at(values)?.integrals());
        };
        let distribution = &self.distributions[*variable];
        if !distribution.is_continuous() {
            let mut sum = Integrals::default();
            for (value, weight) in distribution.weighted_samples() {
                values[*variable] = value;
                sum.add(weight, &self.over(others, values)?);
            }
            return Ok(sum);
        }
        let bounds = distribution.bounds().map(|bound| distribution.coordinate(bound));
        if others.is_empty() {
            return self.along(*variable, bounds, values);
        }
        let mut breaks = bounds.to_vec();
        if *variable == ANGLE {
            let stopped = self.response.stopped_in_capture(values[DIAMETER], values[ADHESION])?.atan();
            if stopped > bounds[0] && stopped < bounds[1] {
                breaks.insert(1, stopped);
            }
        }
        self.adaptive.integral(&breaks, |coordinate| {
            values[*variable] = distribution.value(coordinate);
            let mut part = Integrals::default();
            part.add(distribution.density(coordinate), &self.over(others, values)?);
            Ok(part)
        })
    }

    /// One impact.
    fn at(&self, values: &[f64; VARIABLES]) -> Result<Point, PopulationError> {
        let rebounds = self.margin(values)? > 0.0;
        let slides = self.excess_slip(values, rebounds)? > 0.0;
        let restitution = if rebounds && self.with_powers { self.restitution(values)? } else { 0.0 };
        Ok(Point { rebounds, slides, restitution })
    }

    /// The integrals along the inner variable.
    fn along(
        &self,
        variable: usize,
        bounds: [f64; 2],
        values: &[f64; VARIABLES],
    ) -> Result<Integrals, PopulationError> {
        let distribution = &self.distributions[variable];
        let with = |coordinate: f64| {
            let mut values = *values;
            values[variable] = distribution.value(coordinate);
            values
        };
        let mut sum = Integrals::default();
        for outcome in parts(bounds, |coordinate| self.margin(&with(coordinate)))? {
            let rebounds = self.margin(&with(middle(outcome)))? > 0.0;
            for part in parts(outcome, |coordinate| self.excess_slip(&with(coordinate), rebounds))? {
                let slides = self.excess_slip(&with(middle(part)), rebounds)? > 0.0;
                let [low, high] = part.map(|coordinate| distribution.value(coordinate));
                sum.values[class(rebounds, slides)] += distribution.part(low, high);
            }
            if rebounds && self.with_powers {
                self.add_powers(&mut sum, distribution, outcome, &with)?;
            }
        }
        Ok(sum)
    }

    /// Adds the powers of the restitution of rebounds.
    fn add_powers(
        &self,
        sum: &mut Integrals,
        distribution: &Distribution,
        bounds: [f64; 2],
        with: &impl Fn(f64) -> [f64; VARIABLES],
    ) -> Result<(), PopulationError> {
        let mut found = [Integrals::default(); 2];
        for (rule, found) in self.rules.iter().zip(&mut found) {
            for (coordinate, weight) in distribution.nodes_of_roots(bounds, rule) {
                let restitution = self.restitution(&with(coordinate))?;
                found.add(weight, &powers(restitution));
            }
        }
        let [coarse, mut fine] = found;
        fine.add_differences(&coarse);
        sum.add(1.0, &fine);
        Ok(())
    }
}

impl Point {
    fn integrals(&self) -> Integrals {
        let mut integrals = if self.rebounds { powers(self.restitution) } else { Integrals::default() };
        integrals.values[class(self.rebounds, self.slides)] = 1.0;
        integrals
    }
}

/// The first three powers of a restitution.
fn powers(restitution: f64) -> Integrals {
    let mut integrals = Integrals::default();
    for (power, value) in (1..).zip(&mut integrals.values[POWERS..]) {
        *value = restitution.powi(power);
    }
    integrals
}

/// Index of the class: rebound sliding, rebound rolling, captured sliding, captured rolling.
fn class(rebounds: bool, slides: bool) -> usize {
    2 * usize::from(!rebounds) + usize::from(!slides)
}

fn normal_speed(values: &[f64; VARIABLES]) -> f64 {
    values[SPEED] * values[ANGLE].cos()
}

fn middle([low, high]: [f64; 2]) -> f64 {
    0.5 * (low + high)
}

/// The parts of an interval within which a function does not change its sign.
fn parts(
    [low, high]: [f64; 2],
    mut function: impl FnMut(f64) -> Result<f64, PopulationError>,
) -> Result<Vec<[f64; 2]>, PopulationError> {
    let (mut parts, mut start) = (Vec::new(), low);
    let mut last = (low, function(low)?);
    for index in 1..=INTERVALS {
        // Close to the ends, where the restitution changes fast.
        let angle = std::f64::consts::PI * index as f64 / INTERVALS as f64;
        let place = if index == INTERVALS { high } else { low + 0.5 * (high - low) * (1.0 - angle.cos()) };
        let next = (place, function(place)?);
        if (next.1 > 0.0) != (last.1 > 0.0) {
            let root = root([last, next], WIDTH * (high - low), &mut function)?;
            parts.push([start, root]);
            start = root;
        }
        last = next;
    }
    parts.push([start, high]);
    Ok(parts)
}

/// The place between two others where a function changes its sign, by the method of Ridders (1979), which halves the interval
/// at least.
fn root(
    [mut low, mut high]: [(f64, f64); 2],
    width: f64,
    function: &mut impl FnMut(f64) -> Result<f64, PopulationError>,
) -> Result<f64, PopulationError> {
    let side = |value: f64| value > 0.0;
    let (start, mut last) = (side(low.1), low.0);
    for _ in 0..ITERATIONS {
        let half = 0.5 * (high.0 - low.0);
        let place = low.0 + half;
        let middle = (place, function(place)?);
        let (below, above) = (low, high);
        if side(middle.1) == start {
            low = middle
        } else {
            high = middle
        }
        let discriminant = (middle.1 * middle.1 - below.1 * above.1).sqrt();
        let sign = if start { 1.0 } else { -1.0 };
        let better = place + half * sign * middle.1 / discriminant;
        if better > low.0 && better < high.0 {
            let next = (better, function(better)?);
            if side(next.1) == start {
                low = next
            } else {
                high = next
            }
            if (better - last).abs() <= width {
                return Ok(better);
            }
            last = better;
        }
        if high.0 - low.0 <= width {
            break;
        }
    }
    Ok(0.5 * (low.0 + high.0))
}
