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
    /// Distances of the bounds from the value, in standard errors.
    bounds: [T; 2],
}

impl<T: Real> Uncertain<T> {
    /// Creates an input.
    pub fn new(value: T, error: T) -> Result<Self, InputError> {
        let error = Parameter::StandardError.check(error)?;
        Ok(Self { value, error, bounds: [T::constant(FAR); 2] })
    }

    /// Bounds the input by the range of a `parameter`.
    pub fn within(self, parameter: Parameter) -> Result<Self, InputError> {
        let value = parameter.check(self.value)?;
        let (smallest, largest) = parameter.range();
        let far = T::constant(FAR);
        let bounds = [value - T::constant(smallest), T::constant(largest) - value]
            .map(|distance| if distance < far * self.error { distance / self.error } else { far });
        Ok(Self { bounds, ..self })
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
        let normal = NormalImpact::of(restitution, adhesion, microforce, &NormalMotion { speed });
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


/// Distance of the points of an expansion from its centre, in standard errors: with it, means are exact for polynomials of
/// the fifth degree (Gauss and Hermite).
const STEP: f64 = 1.732_050_807_568_877_2;

/// Number of rebounds for which the stopped slip is computed.
const REBOUNDS: usize = 3;

/// These rebounds: the square root of the part of the energy that remains, without the loss of the material. The last one is
/// that of 1.7 times the critical speed.
const REMAINDERS: [f64; REBOUNDS] = [0.08, 0.44, 0.8];

/// Stopped slips: those of the rebounds, then that of a capture.
const STOPPED: usize = REBOUNDS + 1;

/// Distance of a bound, in standard errors, from which on it has no effect: the probability to be beyond is 2e-3.
const BEYOND: f64 = 2.9;

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

/// Probability that a standard normal variable is below `x`, with an error of 1e-7, and its density there.
///
/// Both take one exponential function (Hastings 1955; Abramowitz and Stegun 26.2.17), where `erfc` takes two more.
fn normal<T: Real>(x: T) -> (T, T) {
    const FRAC_1_SQRT_2PI: f64 = 0.398_942_280_401_432_7;
    const SCALE: f64 = 0.231_641_9;
    const COEFFICIENTS: [f64; 5] = [1.330_274_429, -1.821_255_978, 1.781_477_937, -0.356_563_782, 0.319_381_530];
    let density = T::constant(FRAC_1_SQRT_2PI) * (T::constant(-0.5) * x * x).exp();
    let t = T::ONE / (T::ONE + T::constant(SCALE) * x.abs());
    let tail = density * COEFFICIENTS.iter().fold(T::ZERO, |sum, c| (sum + T::constant(*c)) * t);
    (if x < T::ZERO { tail } else { T::ONE - tail }, density)
}

/// A quantity as a sum of Hermite polynomials of the deviations z, up to the second degree.
#[derive(Clone, Copy)]
struct Expansion<T, const N: usize> {
    mean: T,
    /// Coefficients of z and of z^2 - 1.
    linear: [T; N],
    square: [T; N],
}

impl<T: Real, const N: usize> Expansion<T, N> {
    fn constant(mean: T) -> Self {
        Self { mean, linear: [T::ZERO; N], square: [T::ZERO; N] }
    }

    /// Adds the effect of an input, from the `value` without deviations and the values at the deviations `centre` less `step`,
    /// `centre`, and `centre` plus `step`.
    fn add(&mut self, input: usize, centre: T, step: T, value: T, [below, middle, above]: [T; 3]) {
        let half = T::constant(0.5);
        let curvature = half * (above - middle - (middle - below)) / (step * step);
        let slope = half * (above - below) / step - T::constant(2.0) * curvature * centre;
        // The mean of the parabola.
        self.mean = self.mean + (middle - value) - (slope + curvature * centre) * centre + curvature;
        if let (Some(linear), Some(square)) = (self.linear.get_mut(input), self.square.get_mut(input)) {
            (*linear, *square) = (slope, curvature);
        }
    }

    /// The expansion for a given deviation of one input.
    fn with(mut self, input: usize, z: T) -> Self {
        if let (Some(linear), Some(square)) = (self.linear.get_mut(input), self.square.get_mut(input)) {
            self.mean = self.mean + *linear * z + *square * (z * z - T::ONE);
            (*linear, *square) = (T::ZERO, T::ZERO);
        }
        self
    }
}

fn squares<T: Real, const N: usize>(a: &[T; N]) -> T {
    a.iter().fold(T::ZERO, |sum, a| sum + *a * *a)
}

/// The normal variable zeta on which the ratio of the speeds depends:
/// zeta = direction z + bend (z^2 - 1) - curvature (zeta^2 - 1).
struct Zeta<T, const N: usize> {
    direction: [T; N],
    bend: [T; N],
    curvature: T,
}

/// The effect of one input.
#[derive(Clone, Copy)]
struct Part<T> {
    /// Derivative of zeta, and half of the second derivative.
    zeta: T,
    bend: T,
    /// Derivative of the slip for a given zeta, and the second derivative.
    slip: T,
    slip_bend: T,
    /// Products of all second derivatives of the slip with the derivatives of zeta and of the slip.
    bent_zeta: T,
    bent_slip: T,
}

/// What the slip that friction stops contributes to the moments of the excess slip: the stopped slip, the three coefficients
/// of its mean, its variance and covariance with the slip and their derivatives, and three third cumulants. All but the first
/// are for a stopped slip of one.
const MOMENTS: usize = 11;

/// Moments of the excess slip, the slip less the stopped slip, for a given zeta.
///
/// The mean of a quantity is mean + along zeta + second (zeta^2 - 1). To the second degree in the deviations, the variance is
/// linear in zeta, and the third cumulant is constant.
struct Excess<T, const N: usize> {
    parts: [Part<T>; N],
    curvature: T,
    mean: T,
    along: T,
    second: T,
    variance: [T; 2],
    third: T,
    /// Mixed second derivatives of the slip.
    mixed: Option<[[T; N]; N]>,
}

/// Product of the mixed derivatives with a vector.
fn product<T: Real, const N: usize>(mixed: &Option<[[T; N]; N]>, vector: [T; N]) -> [T; N] {
    mixed.map_or([T::ZERO; N], |rows| {
        rows.map(|row| row.iter().zip(&vector).fold(T::ZERO, |sum, (a, b)| sum + *a * *b))
    })
}

impl<T: Real, const N: usize> Excess<T, N> {
    fn new(zeta: &Zeta<T, N>, slip: &Expansion<T, N>, mixed: &Option<[[T; N]; N]>) -> Self {
        let two = T::constant(2.0);
        let zero = T::ZERO;
        let part = Part { zeta: zero, bend: zero, slip: zero, slip_bend: zero, bent_zeta: zero, bent_slip: zero };
        let mut parts = [part; N];
        let mut along = T::ZERO;
        for (((part, zeta), bend), slip) in parts.iter_mut().zip(zeta.direction).zip(zeta.bend).zip(slip.linear) {
            (part.zeta, part.bend) = (zeta, bend);
            along = along + zeta * slip;
        }
        let mut second = T::constant(-0.5) * zeta.curvature * along;
        let (mut variance, mut slope, mut third) = (T::ZERO, T::ZERO, T::ZERO);
        for ((part, slip), square) in parts.iter_mut().zip(slip.linear).zip(slip.square) {
            let Part { zeta, bend, .. } = *part;
            part.slip = slip - along * zeta;
            part.slip_bend = two * (square - along * bend);
            second = second + bend * slip * zeta;
        }
        let mixed_zeta = product(mixed, zeta.direction);
        let mixed_slip = product(mixed, parts.map(|part| part.slip));
        for ((part, by_zeta), by_slip) in parts.iter_mut().zip(mixed_zeta).zip(mixed_slip) {
            let Part { zeta, bend, slip, slip_bend, .. } = *part;
            (part.bent_zeta, part.bent_slip) = (slip_bend * zeta + by_zeta, slip_bend * slip + by_slip);
            second = second + T::constant(0.25) * part.bent_zeta * zeta;
            variance = variance + slip * slip;
            slope = slope + slip * (part.bent_zeta + bend * slip);
            third = third + slip * part.bent_slip;
        }
        let variance = [variance, two * slope];
        let (second, third) = (two * second, T::constant(3.0) * third);
        Self { parts, curvature: zeta.curvature, mean: slip.mean, along, second, variance, third, mixed: *mixed }
    }

    /// Moments of a stopped slip, which is a product of powers of the inputs: its second derivatives are the products of the
    /// first ones, and those of its logarithm.
    fn moments(&self, stopped: &Stopped<T, N>) -> [T; MOMENTS] {
        let (half, two, three) = (T::constant(0.5), T::constant(2.0), T::constant(3.0));
        let Expansion { mean, linear, square } = &stopped.relative;
        let along = self.parts.iter().zip(linear).fold(T::ZERO, |sum, (part, g)| sum + part.zeta * *g);
        let (mut bent, mut second) = (T::ZERO, T::ZERO);
        let (mut y, mut y_slope, mut mixed, mut mixed_slope) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        let (mut ssy, mut sys, mut syy, mut yys, mut yyy) = (T::ZERO, T::ZERO, T::ZERO, T::ZERO, T::ZERO);
        let mut across = *linear;
        for (across, part) in across.iter_mut().zip(&self.parts) {
            *across = *across - along * part.zeta;
        }
        let mixed_y = product(&self.mixed, across);
        for ((((part, g), square), across), mixed_y) in
            self.parts.iter().zip(linear).zip(square).zip(across).zip(mixed_y)
        {
            let Part { zeta, bend, slip, slip_bend, bent_zeta, bent_slip } = part;
            let curved = two * (*square - along * *bend);
            let by_y = curved * across;
            bent = bent + *bend * *g * *zeta;
            second = second + curved * *zeta * *zeta;
            y = y + across * across;
            y_slope = y_slope + by_y * *zeta + *bend * across * across;
            mixed = mixed + across * *slip;
            mixed_slope = mixed_slope + *bent_zeta * across + curved * *slip * *zeta + two * *bend * *slip * across;
            ssy = ssy + *bent_slip * across;
            sys = sys + curved * *slip * *slip;
            syy = syy + by_y * *slip;
            yys = yys + (*slip_bend * across + mixed_y) * across;
            yyy = yyy + by_y * across;
        }
        [
            absolute(*mean, stopped.value),
            T::ONE + half * (along * along + y),
            along,
            half * (second + along * along) + two * bent - self.curvature * along,
            y,
            two * (y_slope + along * y),
            mixed,
            mixed_slope + along * mixed,
            two * ssy + sys + mixed * mixed,
            two * (syy + y * mixed) + yys,
            three * (yyy + y * y),
        ]
    }

    /// Scores for both directions of the slip: the probability of sliding is that of a normal variable below the score.
    fn scores(&self, zeta: T, stopped: [T; MOMENTS]) -> [T; 2] {
        let [value, mean, along, second, y, y_slope, mixed, mixed_slope, ssy, syy, yyy] = stopped;
        let curved = zeta * zeta - T::ONE;
        let (two, three) = (T::constant(2.0), T::constant(3.0));
        let stopped = value * (mean + along * zeta + second * curved);
        let slip = self.mean + self.along * zeta + self.second * curved;
        let [s, s_slope] = self.variance;
        let variance = s + value * value * y;
        let variance_slope = s_slope + value * value * y_slope;
        [T::ONE, -T::ONE].map(|sign| {
            let twice = sign * two * value;
            let constant = variance - twice * mixed;
            let variance = (constant + zeta * (variance_slope - twice * mixed_slope)).max(T::constant(0.25) * constant);
            let third = sign * (self.third + three * value * value * syy) - value * (three * ssy + value * value * yyy);
            score(sign * slip - stopped, variance, third)
        })
    }
}

/// Standard normal variable below which a variable with these moments is positive (Cornish and Fisher 1938).
fn score<T: Real>(mean: T, variance: T, third: T) -> T {
    let far = T::constant(FAR);
    let error = variance.max(T::ZERO).sqrt();
    // Beyond, no skew matters.
    if mean.abs() >= T::constant(2.0) * far * error {
        return if mean > T::ZERO { far } else { -far };
    }
    let bound = T::constant(LARGEST_CURVATURE);
    let curvature = (third / T::constant(6.0)).saturating_div(variance * error).max(-bound).min(bound);
    T::ZERO - quantile(T::ZERO - mean / error, curvature)
}

/// The integrand at an edge of a panel.
struct Edge<T> {
    /// Coordinate in which the score is nearly linear.
    position: T,
    /// Probability of a smaller zeta.
    below: T,
    /// Density of the coordinate.
    density: T,
    /// Score, probability of sliding, and density of the score, for both directions of the slip.
    sliding: [(T, (T, T)); 2],
}

impl<T: Real> Edge<T> {
    fn new(zeta: T, position: T, stretch: T, scores: [T; 2]) -> Self {
        let certain = T::constant(CERTAIN);
        let sliding = scores.map(|score| {
            if score <= -certain {
                (-certain, (T::ZERO, T::ZERO))
            } else if score >= certain {
                (certain, (T::ONE, T::ZERO))
            } else {
                (score, normal(score))
            }
        });
        let (below, density) = normal(zeta);
        Self { position, below, density: density * stretch, sliding }
    }

    /// Integral of the probability of sliding between this edge and the next one.
    ///
    /// Between the edges, the score is linear, and so is the density of zeta. The integral is exact for any slope of the
    /// score, so that steps of the probability are integrated too.
    fn panel(&self, next: &Self) -> T {
        let half = T::constant(0.5);
        let width = next.position - self.position;
        let mass = next.below - self.below;
        // First moment about the middle.
        let tilt = (next.density - self.density) * width * width * T::constant(1.0 / 12.0);
        let mut sum = T::ZERO;
        for (&(x, (below, density)), &(next_x, (next_below, next_density))) in self.sliding.iter().zip(&next.sliding) {
            let step = next_x - x;
            let (mean, slope) = if step.abs() < T::constant(0.3) {
                // The closed form would lose digits.
                (half * (below + next_below), (next_below - below) / width)
            } else {
                // Repeated integrals of the normal distribution.
                let once = |x: T, below: T, density: T| x * below + density;
                let twice = |x: T, below: T, density: T| half * ((x * x + T::ONE) * below + x * density);
                let (a, b) = (once(x, below, density), once(next_x, next_below, next_density));
                let rise = twice(next_x, next_below, next_density) - twice(x, below, density);
                let slope = T::constant(12.0) * (half * step * (a + b) - rise) / (step * step * width);
                ((b - a) / step, slope)
            };
            sum = sum + mass * mean + tilt * slope;
        }
        sum
    }
}

/// Distances in zeta of the edges of panels from the critical speed.
const REBOUND_EDGES: [f64; 12] = [0.16, 0.64, 1.3, 2.0, 2.7, 3.4, 4.1, 4.8, 5.5, 6.2, 7.0, 9.0];

/// The same from the critical speed downwards.
const CAPTURE_EDGES: [f64; 7] = [1.0, 2.0, 3.0, 4.2, 5.5, 7.0, 9.0];

/// Integral of the probability of sliding from `zeta` upwards over panels. The score changes as a root at first.
fn above<T: Real>(critical: T, scores: impl Fn(T) -> [T; 2]) -> T {
    integral(critical, REBOUND_EDGES.map(|distance| T::constant(distance)), |distance| {
        let root = distance.sqrt();
        let zeta = critical + distance;
        Edge::new(zeta, root, root + root, scores(zeta))
    })
}

fn under<T: Real>(critical: T, scores: impl Fn(T) -> [T; 2]) -> T {
    -integral(-critical, CAPTURE_EDGES.map(|distance| T::constant(distance)), |distance| {
        let zeta = critical - distance;
        Edge::new(zeta, distance, -T::ONE, scores(zeta))
    })
}

fn integral<T: Real, const M: usize>(start: T, distances: [T; M], edge_at: impl Fn(T) -> Edge<T>) -> T {
    let largest = T::constant(CERTAIN) - start;
    let mut edge = edge_at(T::ZERO);
    let mut sum = T::ZERO;
    for distance in distances {
        let next = edge_at(distance.min(largest));
        sum = sum + edge.panel(&next);
        if distance >= largest {
            break;
        }
        edge = next;
    }
    sum
}

/// The slip that friction stops: its value without deviations, and the expansion of the [`relative`] difference to it.
#[derive(Clone, Copy)]
struct Stopped<T, const N: usize> {
    value: T,
    relative: Expansion<T, N>,
}

/// Expansions of what decides the class.
#[derive(Clone, Copy)]
struct Expanded<T, const N: usize> {
    /// Ratio of the speed to the critical speed without deviations, and the [`relative`] difference to it.
    ratio: T,
    speeds: Expansion<T, N>,
    slip: Expansion<T, N>,
    /// Mixed second derivatives of the slip, if two inputs have any.
    mixed: Option<[[T; N]; N]>,
    /// For rebounds at multiples of the critical speed, divided by the multiple; then for captures at the critical speed.
    /// `None` if friction stops every slip.
    stopped: [Option<Stopped<T, N>>; STOPPED],
}

/// Mixed second derivatives of the slip with respect to the deviations of the inputs. `None` if all are zero.
///
/// The slip is a difference, so that no function of it is nearly a sum of functions of the inputs.
fn mixed_derivatives<T: Real, const N: usize>(
    inputs: &[Uncertain<T>; N],
    expansion: &Expansion<T, N>,
    slip: T,
    slip_at: impl Fn([T; N]) -> Result<T, InputError>,
) -> Result<Option<[[T; N]; N]>, InputError> {
    let values = inputs.map(|input| input.value);
    let mut derivatives = [[T::ZERO; N]; N];
    let mut any = false;
    // Deviation in the direction of the farther bound, and the change of the slip with it.
    let single = |index: usize| {
        let (Uncertain { value, error, bounds: [low, high] }, linear, square) =
            (inputs.get(index)?, *expansion.linear.get(index)?, *expansion.square.get(index)?);
        let z = if high < low { -T::ONE } else { T::ONE };
        (linear != T::ZERO).then_some((z, *value + z * *error, linear * z + square))
    };
    for first in 0..N {
        let Some((z, value, change)) = single(first) else { continue };
        for second in first + 1..N {
            let Some((other_z, other_value, other_change)) = single(second) else { continue };
            let mut values = values;
            if let Some(place) = values.get_mut(first) {
                *place = value;
            }
            if let Some(place) = values.get_mut(second) {
                *place = other_value;
            }
            let together = slip_at(values)? - slip;
            let mixed = (together - change - other_change) * z * other_z;
            // Not more than rounding.
            if mixed.abs() <= T::constant(64.0) * T::EPSILON * (together.abs() + slip.abs()) {
                continue;
            }
            any = true;
            for (row, column) in [(first, second), (second, first)] {
                if let Some(entry) = derivatives.get_mut(row).and_then(|row| row.get_mut(column)) {
                    *entry = mixed;
                }
            }
        }
    }
    Ok(any.then_some(derivatives))
}

/// Square root of the part of the energy that remains at a multiple of the critical speed, without the loss of the material.
fn remainder<T: Real>(multiple: T) -> T {
    let held = T::ONE / multiple;
    (T::ONE - held * held).max(T::ZERO).sqrt()
}

/// Inverse of [`remainder`].
fn multiple<T: Real>(remainder: T) -> T {
    T::ONE / (T::ONE - remainder * remainder).sqrt()
}

impl<T: Real, const N: usize> Expanded<T, N> {
    /// Expands the quantities that `quantities` computes: the speed, the slip, and the stopped slips.
    fn new<C: Classifiable<T>>(
        inputs: &[Uncertain<T>; N],
        impact: &impl Fn([T; N]) -> Result<C, InputError>,
        nominal: &C,
        quantities: impl Fn(&C) -> Result<(Option<T>, [Option<T>; STOPPED]), InputError>,
    ) -> Result<Self, InputError> {
        let zero = Expansion::constant(T::ZERO);
        let (ratio, stopped) = quantities(nominal)?;
        let ratio = ratio.unwrap_or(T::ONE);
        let slip = nominal.slip();
        let mut expanded = Self {
            ratio,
            speeds: zero,
            slip: Expansion::constant(slip),
            mixed: None,
            stopped: stopped.map(|value| value.map(|value| Stopped { value, relative: zero })),
        };
        let values = inputs.map(|input| input.value);
        for (input, Uncertain { value, error, bounds: [low, high] }) in inputs.iter().enumerate() {
            let step = T::constant(STEP).min(T::constant(0.5) * (*low + *high));
            let centre = T::ZERO.max(step - *low).min(*high - step);
            if *error <= T::ZERO {
                continue;
            }
            let (mut speeds, mut slips, mut reliefs) = ([T::ZERO; 3], [slip; 3], [[T::ZERO; 3]; STOPPED]);
            for place in 0..3 {
                let deviation = centre + step * T::constant(place as f64 - 1.0);
                if deviation == T::ZERO {
                    continue;
                }
                let mut values = values;
                if let Some(varied) = values.get_mut(input) {
                    *varied = *value + deviation * *error;
                }
                let impact = impact(values)?;
                let (speed, stopped) = quantities(&impact)?;
                if let (Some(place), Some(speed)) = (speeds.get_mut(place), speed) {
                    *place = relative(speed, ratio);
                }
                if let Some(place) = slips.get_mut(place) {
                    *place = impact.slip();
                }
                for ((relief, expansion), stopped) in reliefs.iter_mut().zip(&expanded.stopped).zip(stopped) {
                    if let (Some(place), Some(expansion), Some(stopped)) = (relief.get_mut(place), expansion, stopped) {
                        *place = relative(stopped, expansion.value);
                    }
                }
            }
            expanded.speeds.add(input, centre, step, T::ZERO, speeds);
            expanded.slip.add(input, centre, step, slip, slips);
            for (expansion, relief) in expanded.stopped.iter_mut().zip(reliefs) {
                if let Some(expansion) = expansion {
                    expansion.relative.add(input, centre, step, T::ZERO, relief);
                }
            }
        }
        expanded.mixed = mixed_derivatives(inputs, &expanded.slip, slip, |values| Ok(impact(values)?.slip()))?;
        Ok(expanded)
    }

    /// The expansions for a given deviation of one input.
    fn with(self, input: usize, z: T) -> Self {
        let mut slip = self.slip.with(input, z);
        let mixed = self.mixed.map(|mut rows| {
            if let Some(row) = rows.get_mut(input) {
                for (linear, mixed) in slip.linear.iter_mut().zip(row) {
                    *linear = *linear + *mixed * z;
                    *mixed = T::ZERO;
                }
            }
            for entry in rows.iter_mut().filter_map(|row| row.get_mut(input)) {
                *entry = T::ZERO;
            }
            rows
        });
        if let Some(linear) = slip.linear.get_mut(input) {
            *linear = T::ZERO;
        }
        Self {
            speeds: self.speeds.with(input, z),
            slip,
            mixed,
            stopped: self.stopped.map(|stopped| {
                stopped.map(|stopped| Stopped { relative: stopped.relative.with(input, z), ..stopped })
            }),
            ..self
        }
    }

    /// The variable zeta, its value at the critical speed, and the standard error of the ratio of the speeds.
    fn zeta(&self) -> (Zeta<T, N>, T, T) {
        let Self { ratio, speeds, .. } = self;
        let square = squares(&speeds.linear);
        let error = (square + T::constant(2.0) * squares(&speeds.square)).sqrt();
        let at_critical = relative(T::ONE, *ratio) - speeds.mean;
        let limit = T::constant(CERTAIN);
        let none = [T::ZERO; N];
        if square <= T::ZERO || at_critical.abs() >= T::constant(2.0) * limit * error {
            let critical = if at_critical > T::ZERO { limit } else { -limit };
            return (Zeta { direction: none, bend: none, curvature: T::ZERO }, critical, error);
        }
        let root = square.sqrt();
        let direction = speeds.linear.map(|part| part / root);
        let bend = speeds.square.map(|part| part / error);
        let bound = T::constant(LARGEST_CURVATURE);
        let curvature = direction.iter().zip(&bend).fold(T::ZERO, |sum, (beta, bend)| sum + *beta * *beta * *bend);
        let curvature = curvature.max(-bound).min(bound);
        let critical = quantile(at_critical / error, curvature).max(-limit).min(limit);
        (Zeta { direction, bend, curvature }, critical, error)
    }

    fn probabilities(&self) -> [T; 3] {
        let (variable, critical, error) = self.zeta();
        let excess = Excess::new(&variable, &self.slip, &self.mixed);
        let ratio_at = |zeta: T| {
            let step = zeta + variable.curvature * (zeta * zeta - T::ONE);
            absolute(self.speeds.mean + error * step, self.ratio)
        };
        let [a, b, c, captured] = self.stopped.map(|stopped| stopped.map(|stopped| excess.moments(&stopped)));
        let (mut both, mut other) = (T::ZERO, T::ZERO);
        if let (Some(a), Some(b), Some(c)) = (a, b, c) {
            let [p, q, r] = REMAINDERS.map(T::constant);
            both = above(critical, |zeta| {
                let x = remainder(ratio_at(zeta).max(T::ONE));
                let (to_b, to_c) = ((x - p) / (q - p), (x - p) / (r - p));
                let bend = (x - q) / (r - q) * to_c;
                let first = to_b - bend * ((r - p) / (q - p));
                let mut moments = a;
                for ((a, b), c) in moments.iter_mut().zip(b).zip(c) {
                    *a = *a + first * (b - *a) + bend * (c - *a);
                }
                excess.scores(zeta, moments)
            });
        }
        if let Some(captured) = captured {
            other = under(critical, |zeta| excess.scores(zeta, captured));
        }
        [normal(T::ZERO - critical).0, both, other]
    }

    /// The probabilities if the outcome is the same for all deviations.
    fn certain(&self, outcome: Outcome) -> [T; 3] {
        let variable = Zeta { direction: [T::ZERO; N], bend: [T::ZERO; N], curvature: T::ZERO };
        let excess = Excess::new(&variable, &self.slip, &self.mixed);
        let [stopped, ..] = self.stopped;
        let sliding = stopped.map_or(T::ZERO, |stopped| {
            let [up, down] = excess.scores(T::ZERO, excess.moments(&stopped));
            normal(up).0 + normal(down).0
        });
        if outcome == Outcome::Rebound { [T::ONE, sliding, T::ZERO] } else { [T::ZERO, T::ZERO, sliding] }
    }
}

/// Probability that a normal variable is beyond a bound at this distance, and weights with which the value at the bound takes
/// the place of the mean of a function beyond it.
///
/// The mean is that of a rule by Gauss and Radau: the bound and two more points, with the right first four moments.
fn beyond<T: Real>(distance: T) -> (T, [(T, T); 3]) {
    let (half, two, three) = (T::constant(0.5), T::constant(2.0), T::constant(3.0));
    let (below, density) = normal(T::ZERO - distance);
    // Means of the powers of the distance from the bound.
    let first = density / below - distance;
    let second = T::ONE - distance * first;
    let third = two * first - distance * second;
    let fourth = three * second - distance * third;
    // The points are the roots of x^2 - 2 middle x + product, which is orthogonal to x and x^2.
    let determinant = first * third - second * second;
    let middle = half * (first * fourth - second * third) / determinant;
    let product = (second * fourth - third * third) / determinant;
    let spread = (middle * middle - product).max(T::ZERO).sqrt();
    let (near, far) = (middle - spread, middle + spread);
    // Weights that have the first two moments.
    let weight = |x: T, other: T| (second - other * first) / (x * (x - other));
    let (at_near, at_far) = (weight(near, far), weight(far, near));
    let nodes = [(at_near + at_far, distance), (-at_near, distance + near), (-at_far, distance + far)];
    (below, nodes)
}

/// Adds the effect of the bounds of the inputs: beyond its bound, an input has the value of the bound.
fn bounded<T: Real, const N: usize>(
    inputs: &[Uncertain<T>; N],
    expanded: &Expanded<T, N>,
    probabilities: impl Fn(&Expanded<T, N>) -> [T; 3],
) -> [T; 3] {
    let mut sum = probabilities(expanded);
    for (input, uncertain) in inputs.iter().enumerate() {
        let [low, high] = uncertain.bounds;
        for (sign, distance) in [(-T::ONE, low), (T::ONE, high)] {
            if distance >= T::constant(BEYOND) {
                continue;
            }
            let (beyond, nodes) = beyond(distance);
            for (weight, z) in nodes {
                let part = probabilities(&expanded.with(input, sign * z));
                for (sum, part) in sum.iter_mut().zip(part) {
                    *sum = *sum + beyond * weight * part;
                }
            }
        }
    }
    sum
}

impl<T: Real> ClassProbabilities<T> {
    /// Computes the probabilities.
    pub fn new<const N: usize, C: Classifiable<T>>(
        inputs: &[Uncertain<T>; N],
        impact: impl Fn([T; N]) -> Result<C, InputError>,
    ) -> Result<Self, InputError> {
        let nominal = impact(inputs.map(|input| input.value))?;
        let critical = match nominal.critical_speed()? {
            CriticalSpeed::At(critical) => critical,
            CriticalSpeed::AlwaysRebounds => return Self::certain(inputs, &impact, &nominal, Outcome::Rebound),
            CriticalSpeed::NeverRebounds => return Self::certain(inputs, &impact, &nominal, Outcome::Capture),
        };
        let multiples = REMAINDERS.map(|remainder| multiple(T::constant(remainder)));
        let expanded = Expanded::new(inputs, &impact, &nominal, |impact| {
            let (ratio, critical) = match impact.critical_speed()? {
                CriticalSpeed::At(critical) => (impact.speed().saturating_div(critical), critical),
                CriticalSpeed::AlwaysRebounds => (T::ONE / T::EPSILON, critical),
                CriticalSpeed::NeverRebounds => (T::ZERO, critical),
            };
            let mut slips = [None; STOPPED];
            for (slip, multiple) in slips.iter_mut().zip(multiples) {
                let speed = critical * multiple;
                *slip = impact.stopped_slip(speed, Outcome::Rebound)?.map(|slip| slip / speed * impact.speed());
            }
            if let Some(slip) = slips.last_mut() {
                *slip = impact.stopped_slip(critical, Outcome::Capture)?.map(|slip| slip / critical * impact.speed());
            }
            Ok((Some(ratio), slips))
        })?;
        let (_, zeta, _) = expanded.zeta();
        if zeta.abs() >= T::constant(CERTAIN) {
            let outcome = if zeta < T::ZERO { Outcome::Rebound } else { Outcome::Capture };
            return Self::certain(inputs, &impact, &nominal, outcome);
        }
        Ok(Self::from_sums(bounded(inputs, &expanded, Expanded::probabilities)))
    }

    fn from_sums([rebound, both, other]: [T; 3]) -> Self {
        let rebound = rebound.max(T::ZERO).min(T::ONE);
        Self { rebound, sliding: [both.max(T::ZERO).min(rebound), other.max(T::ZERO).min(T::ONE - rebound)] }
    }

    /// The probabilities if the outcome is certain.
    fn certain<const N: usize, C: Classifiable<T>>(
        inputs: &[Uncertain<T>; N],
        impact: &impl Fn([T; N]) -> Result<C, InputError>,
        nominal: &C,
        outcome: Outcome,
    ) -> Result<Self, InputError> {
        let expanded = Expanded::new(inputs, impact, nominal, |impact| {
            let stopped = impact.stopped_slip(impact.speed(), outcome)?;
            Ok((None, [stopped, None, None, None]))
        })?;
        Ok(Self::from_sums(bounded(inputs, &expanded, |expanded| expanded.certain(outcome))))
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
