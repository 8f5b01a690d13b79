//! Probabilities of the classes of an impact whose inputs have standard errors.
//!
//! # Method
//! Let z be the deviations of the inputs in standard errors: independent standard normal variables. The class depends on z
//! through three quantities: the ratio of the speed to the critical speed, the slip, and the slip that friction stops. The
//! critical speed is a smooth function of the inputs. The stopped slip is not: above the critical speed, it increases as a
//! root. At a given ratio of the speeds, however, it is a smooth function of the other inputs. So
//!
//! 1. each quantity is expanded into Hermite polynomials of each z up to the second degree. Ratios of positive quantities
//!    take the place of the quantities themselves, as products and powers of inputs are then nearly sums;
//! 2. the ratio of the speeds is written as a function of one normal variable zeta;
//! 3. the mean, variance and skewness of slip less stopped slip, given zeta, follow from the expansions (Cornish and
//!    Fisher 1938);
//! 4. the probability of sliding is integrated over zeta, above and below the critical speed.

use core::f64::consts::FRAC_1_SQRT_2;

use crate::contact::{Contact, ContactLaw, ErrorControl, Impulses};
use crate::rigid::{MicroforceTerm, ReboundAdhesion};
use crate::{
    Approach, Class, Coulomb, CriticalSpeed, Dual, InputError, NormalImpact, NormalMotion, Oblique, Outcome, Parameter, Real,
    RestitutionLaw, RigidBody, Sphere, rolling,
};

impl<T: Real, const N: usize> Dual<T, N> {
    /// Standard error of this result, from the standard `errors` of its inputs. The errors of the inputs are independent.
    ///
    /// ```
    /// use microimpact::Dual;
    ///
    /// let [a, b] = Dual::variables([10.0, 2.0]);
    /// assert_eq!((a * b).standard_error(&[1.5, 0.4]), 5.0);
    /// ```
    pub fn standard_error(&self, errors: &[T; N]) -> T {
        let parts = self.partials.iter().zip(errors).map(|(partial, error)| *partial * *error);
        parts.fold(T::ZERO, |sum, part| sum + part * part).sqrt()
    }
}

/// A number type that provides the normal distribution.
///
/// ```
/// use microimpact::measure::NormalDistribution;
///
/// assert!((1.96_f64.below() - 0.975).abs() < 1e-4);
/// ```
pub trait NormalDistribution: Real {
    /// Probability that a standard normal variable is below this number.
    ///
    /// ```
    /// use microimpact::measure::NormalDistribution;
    ///
    /// assert_eq!(0.0_f32.below(), 0.5);
    /// ```
    fn below(self) -> Self;
}

macro_rules! impl_normal_distribution {
    ($float:ident, $erfc:path) => {
        impl NormalDistribution for $float {
            fn below(self) -> Self {
                0.5 * $erfc(-self * FRAC_1_SQRT_2 as $float)
            }
        }
    };
}

impl_normal_distribution!(f32, libm::erfcf);
impl_normal_distribution!(f64, libm::erfc);

/// Density of the standard normal distribution.
fn density<T: Real>(x: T) -> T {
    const FRAC_1_SQRT_2PI: f64 = 0.398_942_280_401_432_7;
    T::constant(FRAC_1_SQRT_2PI) * (T::constant(-0.5) * x * x).exp()
}

/// Number of standard errors beyond which an outcome or a motion is certain: the probability of the other is 3e-6.
const CERTAIN: f64 = 4.5;

/// An input with its standard error.
///
/// The input is normally distributed about its value. Within a range, an input that lies beyond the range takes the nearest
/// value of the range.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Uncertain<T> {
    value: T,
    error: T,
    /// Bounds in standard errors from the value.
    bounds: (T, T),
    range: Option<(T, T)>,
}

impl<T: Real> Uncertain<T> {
    /// Creates an input.
    pub fn new(value: T, error: T) -> Result<Self, InputError> {
        let error = Parameter::StandardError.check(error)?;
        let far = T::constant(FAR);
        Ok(Self { value, error, bounds: (-far, far), range: None })
    }

    /// Bounds the input by the range of a `parameter`.
    pub fn within(self, parameter: Parameter) -> Result<Self, InputError> {
        let value = parameter.check(self.value)?;
        let (smallest, largest) = parameter.range();
        let (smallest, largest) = (T::constant(smallest), T::constant(largest));
        let far = T::constant(FAR);
        let distance = |bound: T| {
            let distance = (bound - value).abs();
            if distance < far * self.error { distance / self.error } else { far }
        };
        Ok(Self { bounds: (-distance(smallest), distance(largest)), range: Some((smallest, largest)), ..self })
    }

    /// The input that deviates by a number of standard errors.
    fn at(&self, deviation: T) -> T {
        let value = self.value + deviation * self.error;
        match self.range {
            Some((smallest, largest)) => value.max(smallest).min(largest),
            None => value,
        }
    }
}

/// Distance of a bound, in standard errors, that no input reaches.
const FAR: f64 = 6.0;

/// What the classes of an impact follow from.
pub trait Classifiable<T: Real> {
    /// Approach speed, m/s.
    fn speed(&self) -> T;

    /// Critical speed.
    fn critical_speed(&self) -> Result<CriticalSpeed<T>, InputError>;

    /// Slip velocity before the impact, m/s.
    fn slip(&self) -> T;

    /// Largest slip that friction stops (m/s) if the sphere arrives with another `speed` (m/s) and has this `outcome`.
    /// `None` if friction stops every slip.
    fn stopped_slip(&self, speed: T, outcome: Outcome) -> Result<Option<T>, InputError>;
}

impl<T: Real> Classifiable<T> for (NormalMotion<T>, CriticalSpeed<T>) {
    fn speed(&self) -> T {
        self.0.speed()
    }

    fn critical_speed(&self) -> Result<CriticalSpeed<T>, InputError> {
        Ok(self.1)
    }

    fn slip(&self) -> T {
        T::ZERO
    }

    fn stopped_slip(&self, _speed: T, _outcome: Outcome) -> Result<Option<T>, InputError> {
        Ok(None)
    }
}

impl<T, L, A, X, M> Classifiable<T> for (RigidBody<T, L, A, Coulomb<T>, X>, M)
where
    T: Real,
    L: RestitutionLaw<T>,
    A: ReboundAdhesion<T>,
    X: MicroforceTerm<T>,
    M: Oblique<T>,
{
    fn speed(&self) -> T {
        self.1.normal().speed()
    }

    fn critical_speed(&self) -> Result<CriticalSpeed<T>, InputError> {
        Ok(self.0.critical_speed())
    }

    fn slip(&self) -> T {
        self.1.slip()
    }

    fn stopped_slip(&self, speed: T, outcome: Outcome) -> Result<Option<T>, InputError> {
        let RigidBody { sphere, restitution, adhesion, surface, microforce } = &self.0;
        let normal = NormalImpact::of(restitution, adhesion, microforce, &NormalMotion::new(speed)?);
        let change = if outcome == Outcome::Capture { speed } else { normal.impulse() };
        Ok(Some(rolling::stopped_slip(surface.coefficient() * change, sphere.contact_inertia())))
    }
}

impl<T, L, M, E> Classifiable<T> for (Contact<T, L, Coulomb<T>>, M, &E)
where
    T: Real,
    L: ContactLaw<T>,
    M: Oblique<T>,
    E: ErrorControl<T>,
{
    fn speed(&self) -> T {
        self.1.normal().speed()
    }

    fn critical_speed(&self) -> Result<CriticalSpeed<T>, InputError> {
        self.0.critical_speed(self.2)
    }

    fn slip(&self) -> T {
        self.1.slip()
    }

    fn stopped_slip(&self, speed: T, outcome: Outcome) -> Result<Option<T>, InputError> {
        let (scene, _, method) = self;
        let friction = scene.surface.coefficient();
        // The surface goes on to press on a captured sphere.
        if outcome == Outcome::Capture {
            return Ok(if friction > T::ZERO { None } else { Some(T::ZERO) });
        }
        let motion = NormalMotion::new(speed)?.with_tangential(T::ZERO)?;
        let (_, impulses) = scene.solve_for(&motion, *method, Impulses)?;
        let sphere = scene.sphere();
        let change = impulses.elastic / sphere.mass();
        Ok(Some(rolling::stopped_slip(friction * change, sphere.contact_inertia())))
    }
}

/// Probabilities of the classes of an impact. Their sum is one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ClassProbabilities<T> {
    rebound: T,
    /// Probabilities of sliding together with rebound and with capture.
    sliding: [T; 2],
}

/// Distance of the points of the expansion from the value, in standard errors: with it, means are exact for polynomials of
/// the fifth degree (Gauss and Hermite).
const STEP: f64 = 1.732_050_807_568_877_2;

/// Number of rebounds for which the stopped slip is computed.
const REBOUNDS: usize = 3;

/// The energies of these rebounds: e/R as a fraction of the largest one.
const FRACTIONS: [f64; REBOUNDS] = [0.1, 0.55, 1.0];

/// Largest curvature of a Cornish-Fisher expansion. With it, the expansion increases up to five standard errors.
const LARGEST_CURVATURE: f64 = 0.1;

/// Difference of two numbers, relative to their mean. It is nearly the logarithm of their ratio, and lies between -2 and 2.
fn relative<T: Real>(value: T, reference: T) -> T {
    let sum = value + reference;
    if sum > T::ZERO { (value - reference) / sum * T::constant(2.0) } else { T::ZERO }
}

/// Inverse of [`relative`].
fn absolute<T: Real>(relative: T, reference: T) -> T {
    let two = T::constant(2.0);
    let bounded = relative.max(T::constant(-1.9)).min(T::constant(1.9));
    reference * (two + bounded) / (two - bounded)
}

/// The normal variable x for which x + curvature (x^2 - 1) is `value`.
fn quantile<T: Real>(value: T, curvature: T) -> T {
    let shifted = value + curvature;
    let root = (T::ONE + T::constant(4.0) * curvature * shifted).max(T::ZERO).sqrt();
    T::constant(2.0) * shifted / (T::ONE + root)
}

/// The points at which an input is varied, and the moments of the clipped normal variable u.
struct Stencil<T> {
    centre: T,
    step: T,
    /// Means of u and u^2 over the Hermite polynomials 1, z and (z^2 - 1)/2.
    first: [T; 3],
    second: [T; 3],
}

impl<T: NormalDistribution> Stencil<T> {
    fn new((low, high): (T, T)) -> Self {
        let half = T::constant(0.5);
        let step = T::constant(STEP).min(half * (high - low));
        let centre = T::ZERO.max(low + step).min(high - step);
        let far = T::constant(FAR);
        if low <= -far && high >= far {
            let (zero, one) = (T::ZERO, T::ONE);
            return Self { centre, step, first: [zero, one, zero], second: [one, zero, one] };
        }
        let (below, above) = (low.below(), (-high).below());
        let (at_low, at_high) = (density(low), density(high));
        let inside = T::ONE - below - above;
        let square_inside = inside + low * at_low - high * at_high;
        let first = [at_low - at_high + low * below + high * above, inside, half * (at_low - at_high)];
        let second = [
            square_inside + low * low * below + high * high * above,
            T::constant(2.0) * (at_low - at_high),
            square_inside,
        ];
        Self { centre, step, first, second }
    }

    /// Coefficients of 1, z and z^2 - 1 of a function, from its values at the centre less a step, the centre, and the centre
    /// plus a step.
    fn coefficients(&self, [below, centre, above]: [T; 3]) -> [T; 3] {
        let (half, two) = (T::constant(0.5), T::constant(2.0));
        let square = half * (above - two * centre + below) / (self.step * self.step);
        let slope = half * (above - below) / self.step - two * square * self.centre;
        let constant = centre - (slope + square * self.centre) * self.centre;
        let [[a, b, c], [d, e, f]] = [self.first, self.second];
        [constant + slope * a + square * d, slope * b + square * e, slope * c + square * f]
    }
}

/// A quantity as a sum of Hermite polynomials of the deviations z, up to the second degree.
#[derive(Clone, Copy)]
struct Expansion<T, const N: usize> {
    mean: T,
    /// Coefficients of z and of z^2 - 1.
    linear: [T; N],
    square: [T; N],
}

impl<T: NormalDistribution, const N: usize> Expansion<T, N> {
    fn constant(mean: T) -> Self {
        Self { mean, linear: [T::ZERO; N], square: [T::ZERO; N] }
    }

    /// Adds what one input contributes, given the value without deviations.
    fn add(&mut self, input: usize, stencil: &Stencil<T>, value: T, values: [T; 3]) {
        let [mean, linear, square] = stencil.coefficients(values);
        self.mean = self.mean + mean - value;
        if let (Some(l), Some(s)) = (self.linear.get_mut(input), self.square.get_mut(input)) {
            (*l, *s) = (linear, square);
        }
    }
}

fn dot<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| sum + *a * *b)
}

/// Sum of a b c.
fn triple<T: Real, const N: usize>(a: &[T; N], b: &[T; N], c: &[T; N]) -> T {
    a.iter().zip(b).zip(c).fold(T::ZERO, |sum, ((a, b), c)| sum + *a * *b * *c)
}

/// The slip that friction stops: its value without deviations, and the expansion of the [`relative`] difference to it.
#[derive(Clone, Copy)]
struct Stopped<T, const N: usize> {
    value: T,
    relative: Expansion<T, N>,
}

/// The normal variable zeta on which the ratio of the speeds depends:
/// zeta = sum of direction z + bend (z^2 - 1), less curvature (zeta^2 - 1).
struct Margin<T, const N: usize> {
    direction: [T; N],
    bend: [T; N],
    curvature: T,
}

impl<T: NormalDistribution, const N: usize> Margin<T, N> {
    /// A variable on which nothing depends.
    fn none() -> Self {
        Self { direction: [T::ZERO; N], bend: [T::ZERO; N], curvature: T::ZERO }
    }

    /// The normal variable that is above zero for slip beyond the stopped slip, in the direction of `sign`, at this zeta:
    /// the probability of sliding in this direction is that of a standard normal variable below the score.
    fn score(&self, zeta: T, sign: T, slip: &Expansion<T, N>, stopped: &Stopped<T, N>) -> T {
        let (half, two) = (T::constant(0.5), T::constant(2.0));
        let Self { direction: beta, bend, curvature } = self;
        let relative = &stopped.relative;
        let y = absolute(relative.mean, stopped.value);
        // The excess is g z + z H z/2 with H = 2 h - y a a'. A product of inputs is the exponential of the sum of their
        // logarithms, which gives a a'.
        let a = &relative.linear;
        let (mut g, mut h) = (slip.linear, slip.square);
        for ((g, h), (a, d)) in g.iter_mut().zip(&mut h).zip(a.iter().zip(&relative.square)) {
            *g = sign * *g - y * *a;
            *h = sign * *h - y * *d;
        }
        let mean = sign * slip.mean - y * (T::ONE + half * dot(a, a));
        let along = dot(&g, beta);
        let a_along = dot(a, beta);
        let bend_along = two * triple(bend, &g, beta) - two * *curvature * along;
        let second = half * (two * triple(&h, beta, beta) - y * a_along * a_along) + bend_along;
        let mut across = g;
        for (across, beta) in across.iter_mut().zip(beta) {
            *across = *across - along * *beta;
        }
        let a_across = dot(a, &across);
        let bent = two * triple(bend, &across, &across);
        let mixed = two * triple(&h, beta, &across) - y * a_along * a_across - along * two * triple(bend, beta, &across);
        let constant = dot(&across, &across);
        let variance = (constant + zeta * (two * mixed + bent)).max(T::constant(0.25) * constant);
        let third = two * triple(&h, &across, &across) - y * a_across * a_across - along * bent;
        let expected = mean + along * zeta + second * (zeta * zeta - T::ONE);
        let far = T::constant(FAR);
        let error = variance.sqrt();
        if error <= T::ZERO {
            return if expected > T::ZERO { far } else { -far };
        }
        let bound = T::constant(LARGEST_CURVATURE);
        let skew = (half * third).saturating_div(variance * error).max(-bound).min(bound);
        -quantile((-expected).saturating_div(error).max(-far - far).min(far + far), skew)
    }

    /// Probability of sliding in either direction.
    fn scores(&self, zeta: T, slip: &Expansion<T, N>, stopped: &Stopped<T, N>) -> [T; 2] {
        [T::ONE, -T::ONE].map(|sign| self.score(zeta, sign, slip, stopped))
    }
}

/// The integrand at an edge of a panel.
struct Edge<T> {
    zeta: T,
    below: T,
    density: T,
    /// Score, probability below it, and density there, for both directions of the slip.
    sliding: [(T, T, T); 2],
}

impl<T: NormalDistribution> Edge<T> {
    fn new(zeta: T, scores: [T; 2]) -> Self {
        let certain = T::constant(CERTAIN);
        let sliding = scores.map(|score| {
            if score <= -certain {
                (-certain, T::ZERO, T::ZERO)
            } else if score >= certain {
                (certain, T::ONE, T::ZERO)
            } else {
                (score, score.below(), density(score))
            }
        });
        Self { zeta, below: zeta.below(), density: density(zeta), sliding }
    }

    /// Probability of sliding between this edge and the next one.
    ///
    /// Between the edges, the score is linear, and so is the density of zeta. The integral is exact for any slope of the
    /// score, so that steps of the probability are integrated too.
    fn panel(&self, next: &Self) -> T {
        let width = next.zeta - self.zeta;
        let mass = next.below - self.below;
        // The first moment about the middle.
        let tilt = self.density - next.density - T::constant(0.5) * (self.zeta + next.zeta) * mass;
        let mut sum = T::ZERO;
        for (&(x, below, density), &(next_x, next_below, next_density)) in self.sliding.iter().zip(&next.sliding) {
            let step = next_x - x;
            let half = T::constant(0.5);
            if step.abs() < T::constant(0.3) {
                // The closed form would lose digits.
                let bend = (next_x * next_density - x * density) * T::ZERO;
                let mean = half * (below + next_below) + step * step * bend;
                sum = sum + mass * mean + tilt * (next_below - below) / width;
                continue;
            }
            // Repeated integrals of the normal distribution.
            let once = |x: T, below: T, density: T| x * below + density;
            let twice = |x: T, below: T, density: T| half * ((x * x + T::ONE) * below + x * density);
            let (a, next_a) = (once(x, below, density), once(next_x, next_below, next_density));
            let rise = twice(next_x, next_below, next_density) - twice(x, below, density);
            let mean = (next_a - a) / step;
            let slope = T::constant(12.0) * (half * step * (a + next_a) - rise) / (step * step * width);
            sum = sum + mass * mean + tilt * slope;
        }
        sum
    }
}

/// Edges of the panels above the critical speed, as distances in zeta. They are close where the rebound speed rises as a root.
const REBOUND_EDGES: [f64; 13] = [0.04, 0.16, 0.36, 0.64, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.5, 9.0];

/// The same below the critical speed.
const CAPTURE_EDGES: [f64; 10] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.5, 9.0];

/// Integral of the probability of sliding from `zeta` on over panels.
fn integral<T: NormalDistribution>(zeta: T, steps: &[f64], sign: T, scores: impl Fn(T) -> [T; 2]) -> T {
    let limit = T::constant(CERTAIN);
    let mut edge = Edge::new(zeta, scores(zeta));
    let mut sum = T::ZERO;
    for step in steps {
        let next = (zeta + sign * T::constant(*step)).max(-limit).min(limit);
        let next = Edge::new(next, scores(next));
        sum = sum + sign * if sign > T::ZERO { edge.panel(&next) } else { edge.panel(&next) };
        if next.zeta.abs() >= limit {
            break;
        }
        edge = next;
    }
    sum
}

/// Ratio of the speed to the critical speed, relative to a reference.
fn relative_speed<T: Real>(speed: T, critical: CriticalSpeed<T>, reference: T) -> T {
    match critical {
        CriticalSpeed::At(critical) => relative(speed.saturating_div(critical), reference),
        CriticalSpeed::AlwaysRebounds => T::constant(2.0),
        CriticalSpeed::NeverRebounds => T::constant(-2.0),
    }
}

/// The inputs without deviations, except one.
fn varied<T: Real, const N: usize>(inputs: &[Uncertain<T>; N], input: usize, deviation: T) -> [T; N] {
    let mut count = 0;
    inputs.map(|uncertain| {
        let deviation = if count == input { deviation } else { T::ZERO };
        count += 1;
        uncertain.at(deviation)
    })
}

impl<T: NormalDistribution> ClassProbabilities<T> {
    /// Computes the probabilities.
    pub fn new<const N: usize, C: Classifiable<T>>(
        inputs: &[Uncertain<T>; N],
        impact: impl Fn([T; N]) -> Result<C, InputError>,
    ) -> Result<Self, InputError> {
        let nominal = impact(inputs.map(|input| input.at(T::ZERO)))?;
        let (speed, slip) = (nominal.speed(), nominal.slip());
        let critical = match nominal.critical_speed()? {
            CriticalSpeed::At(critical) => critical,
            CriticalSpeed::AlwaysRebounds => return Self::certain(inputs, &impact, &nominal, Outcome::Rebound),
            CriticalSpeed::NeverRebounds => return Self::certain(inputs, &impact, &nominal, Outcome::Capture),
        };
        let ratio = speed.saturating_div(critical);
        let mut speeds = Expansion::<T, N>::constant(T::ZERO);
        // Critical speeds at the points of the expansion.
        let mut criticals = [[critical; 3]; N];
        for (input, (uncertain, criticals)) in inputs.iter().zip(&mut criticals).enumerate() {
            if uncertain.error <= T::ZERO {
                continue;
            }
            let stencil = Stencil::new(uncertain.bounds);
            let mut values = [T::ZERO; 3];
            for (place, (value, critical)) in values.iter_mut().zip(criticals).enumerate() {
                let deviation = stencil.centre + stencil.step * T::constant(place as f64 - 1.0);
                if deviation == T::ZERO {
                    continue;
                }
                let impact = impact(varied(inputs, input, deviation))?;
                let speed = impact.critical_speed()?;
                *value = relative_speed(impact.speed(), speed, ratio);
                if let CriticalSpeed::At(speed) = speed {
                    *critical = speed;
                }
            }
            speeds.add(input, &stencil, T::ZERO, values);
        }
        let square = dot(&speeds.linear, &speeds.linear);
        let deviation = (square + T::constant(2.0) * dot(&speeds.square, &speeds.square)).sqrt();
        let outcome = if ratio > T::ONE { Outcome::Rebound } else { Outcome::Capture };
        if square <= T::ZERO {
            return Self::certain(inputs, &impact, &nominal, outcome);
        }
        let root = square.sqrt();
        let mut margin = Margin {
            direction: speeds.linear.map(|part| part / root),
            bend: speeds.square.map(|part| part / deviation),
            curvature: T::ZERO,
        };
        let bound = T::constant(LARGEST_CURVATURE);
        margin.curvature = triple(&margin.direction, &margin.direction, &margin.bend).max(-bound).min(bound);
        let at_critical = (relative(T::ONE, ratio) - speeds.mean).saturating_div(deviation);
        let zeta = quantile(at_critical, margin.curvature);
        let limit = T::constant(CERTAIN);
        if zeta.abs() >= limit {
            return Self::certain(inputs, &impact, &nominal, outcome);
        }

        let ratio_at = |zeta: T| {
            let step = zeta + margin.curvature * (zeta * zeta - T::ONE);
            absolute(speeds.mean + deviation * step, ratio)
        };
        // e/R without a microforce.
        let remainder = |ratio: T| (T::ONE - (T::ONE / (ratio * ratio)).min(T::ONE)).sqrt();
        let largest = remainder(ratio_at((zeta + T::ONE).max(T::constant(3.0))));
        let fractions = FRACTIONS.map(|fraction| largest * T::constant(fraction));
        let speeds = fractions.map(|fraction| T::ONE / (T::ONE - fraction * fraction).max(T::EPSILON).sqrt());
        // Slip that friction stops at these multiples of the critical speed, over the multiple; then of a capture.
        let stopped = |impact: &C, critical: T| -> Result<[Option<T>; REBOUNDS + 1], InputError> {
            let mut slips = [None; REBOUNDS + 1];
            for (slip, multiple) in slips.iter_mut().zip(speeds) {
                *slip = impact.stopped_slip(critical * multiple, Outcome::Rebound)?.map(|slip| slip / multiple);
            }
            if let Some(slip) = slips.last_mut() {
                *slip = impact.stopped_slip(critical, Outcome::Capture)?;
            }
            Ok(slips)
        };
        let nominal_slips = stopped(&nominal, critical)?;
        let mut expansions =
            nominal_slips.map(|slip| slip.map(|value| Stopped { value, relative: Expansion::<T, N>::constant(T::ZERO) }));
        let mut slips = Expansion::<T, N>::constant(slip);
        for (input, (uncertain, criticals)) in inputs.iter().zip(criticals).enumerate() {
            if uncertain.error <= T::ZERO {
                continue;
            }
            let stencil = Stencil::new(uncertain.bounds);
            let mut values = [[T::ZERO; 3]; REBOUNDS + 1];
            let mut slip_values = [slip; 3];
            for (place, (slip, critical)) in slip_values.iter_mut().zip(criticals).enumerate() {
                let deviation = stencil.centre + stencil.step * T::constant(place as f64 - 1.0);
                if deviation == T::ZERO {
                    continue;
                }
                let impact = impact(varied(inputs, input, deviation))?;
                *slip = impact.slip();
                let slips = stopped(&impact, critical)?;
                for ((values, expansion), slip) in values.iter_mut().zip(&expansions).zip(slips) {
                    if let (Some(value), Some(expansion), Some(slip)) = (values.get_mut(place), expansion, slip) {
                        *value = relative(slip, expansion.value);
                    }
                }
            }
            slips.add(input, &stencil, slip, slip_values);
            for (expansion, values) in expansions.iter_mut().zip(values) {
                if let Some(expansion) = expansion {
                    expansion.relative.add(input, &stencil, T::ZERO, values);
                }
            }
        }
        let [first, second, third, captured] = expansions;
        let rebound = (-zeta).below();
        let mut sliding = [T::ZERO; 2];
        if let (Some(first), Some(second), Some(third)) = (first, second, third) {
            let [a, b, c] = fractions;
            let scores = |at: T| {
                let ratio = ratio_at(at).max(T::ONE);
                let x = remainder(ratio);
                let weights = [
                    (x - b) * (x - c) / ((a - b) * (a - c)),
                    (x - a) * (x - c) / ((b - a) * (b - c)),
                    (x - a) * (x - b) / ((c - a) * (c - b)),
                ];
                let [u, v, w] = weights;
                let mix = |first: T, second: T, third: T| u * first + v * second + w * third;
                let mut stopped = first;
                stopped.value = ratio * mix(first.value, second.value, third.value);
                let r = &mut stopped.relative;
                r.mean = mix(first.relative.mean, second.relative.mean, third.relative.mean);
                for ((part, second), third) in r.linear.iter_mut().zip(second.relative.linear).zip(third.relative.linear) {
                    *part = mix(*part, second, third);
                }
                for ((part, second), third) in r.square.iter_mut().zip(second.relative.square).zip(third.relative.square) {
                    *part = mix(*part, second, third);
                }
                margin.scores(at, &slips, &stopped)
            };
            sliding[0] = integral(zeta, &REBOUND_EDGES, T::ONE, scores);
        }
        if let Some(captured) = captured {
            let scores = |at: T| {
                let mut stopped = captured;
                stopped.value = ratio_at(at).min(T::ONE) * captured.value;
                margin.scores(at, &slips, &stopped)
            };
            sliding[1] = integral(zeta, &CAPTURE_EDGES, -T::ONE, scores);
        }
        let [both, other] = sliding;
        let sliding = [both.max(T::ZERO).min(rebound), other.max(T::ZERO).min(T::ONE - rebound)];
        Ok(Self { rebound, sliding })
    }

    /// The probabilities if the outcome is certain.
    fn certain<const N: usize, C: Classifiable<T>>(
        inputs: &[Uncertain<T>; N],
        impact: &impl Fn([T; N]) -> Result<C, InputError>,
        nominal: &C,
        outcome: Outcome,
    ) -> Result<Self, InputError> {
        let rebound = if outcome == Outcome::Rebound { T::ONE } else { T::ZERO };
        let stopped = |impact: &C| impact.stopped_slip(impact.speed(), outcome);
        let mut sliding = T::ZERO;
        if let Some(value) = stopped(nominal)? {
            let mut slip = Expansion::<T, N>::constant(nominal.slip());
            let mut expansion = Stopped { value, relative: Expansion::<T, N>::constant(T::ZERO) };
            for (input, uncertain) in inputs.iter().enumerate() {
                if uncertain.error <= T::ZERO {
                    continue;
                }
                let stencil = Stencil::new(uncertain.bounds);
                let (mut slips, mut values) = ([nominal.slip(); 3], [T::ZERO; 3]);
                for (place, (slip, relation)) in slips.iter_mut().zip(&mut values).enumerate() {
                    let deviation = stencil.centre + stencil.step * T::constant(place as f64 - 1.0);
                    if deviation == T::ZERO {
                        continue;
                    }
                    let impact = impact(varied(inputs, input, deviation))?;
                    *slip = impact.slip();
                    *relation = relative(stopped(&impact)?.unwrap_or(value), value);
                }
                slip.add(input, &stencil, nominal.slip(), slips);
                expansion.relative.add(input, &stencil, T::ZERO, values);
            }
            let [up, down] = Margin::none().scores(T::ZERO, &slip, &expansion);
            sliding = (up.below() + down.below()).min(T::ONE);
        }
        Ok(Self { rebound, sliding: [rebound * sliding, (T::ONE - rebound) * sliding] })
    }

    /// Probability of a class. A captured sphere that rests counts as rolling, because the probability of rest is zero.
    pub fn of(&self, class: Class) -> T {
        let [both, other] = self.sliding;
        match class {
            Class::ReboundSliding => both,
            Class::ReboundRolling => self.rebound - both,
            Class::CapturedSliding => other,
            Class::CapturedRolling | Class::CapturedResting => T::ONE - self.rebound - other,
            Class::Undecided => T::ZERO,
        }
        .max(T::ZERO)
    }

    /// Probability of a rebound, sliding or rolling.
    pub fn rebound(&self) -> T {
        self.rebound
    }
}
