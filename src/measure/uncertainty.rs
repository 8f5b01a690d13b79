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

    /// Adds the effect of an input, from its values at the deviations `centre` less `step`, `centre`, `centre` plus `step`.
    fn add(&mut self, input: usize, centre: T, step: T, [below, middle, above]: [T; 3]) {
        let half = T::constant(0.5);
        let curvature = half * (above - middle - (middle - below)) / (step * step);
        let slope = half * (above - below) / step - T::constant(2.0) * curvature * centre;
        // From the value without deviations to the mean.
        self.mean = self.mean + curvature;
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
}

impl<T: Real, const N: usize> Excess<T, N> {
    fn new(zeta: &Zeta<T, N>, slip: &Expansion<T, N>) -> Self {
        let two = T::constant(2.0);
        let mut parts = [Part { zeta: T::ZERO, bend: T::ZERO, slip: T::ZERO, slip_bend: T::ZERO }; N];
        let mut along = T::ZERO;
        for (((part, zeta), bend), slip) in parts.iter_mut().zip(zeta.direction).zip(zeta.bend).zip(slip.linear) {
            (part.zeta, part.bend) = (zeta, bend);
            along = along + zeta * slip;
        }
        let mut second = T::constant(-0.5) * zeta.curvature * along;
        let (mut variance, mut slope, mut third) = (T::ZERO, T::ZERO, T::ZERO);
        for ((part, slip), square) in parts.iter_mut().zip(slip.linear).zip(slip.square) {
            let Part { zeta, bend, .. } = *part;
            let across = slip - along * zeta;
            let curved = two * (square - along * bend);
            (part.slip, part.slip_bend) = (across, curved);
            second = second + bend * slip * zeta + T::constant(0.25) * curved * zeta * zeta;
            variance = variance + across * across;
            slope = slope + across * (curved * zeta + bend * across);
            third = third + across * curved * across;
        }
        let variance = [variance, two * slope];
        Self { parts, curvature: zeta.curvature, mean: slip.mean, along, second: two * second, variance, third: T::constant(3.0) * third }
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
        for ((Part { zeta, bend, slip, slip_bend }, g), square) in self.parts.iter().zip(linear).zip(square) {
            let across = *g - along * *zeta;
            let curved = two * (*square - along * *bend);
            let (by_slip, by_y) = (*slip_bend * across, curved * across);
            bent = bent + *bend * *g * *zeta;
            second = second + curved * *zeta * *zeta;
            y = y + across * across;
            y_slope = y_slope + by_y * *zeta + *bend * across * across;
            mixed = mixed + across * *slip;
            mixed_slope = mixed_slope + (by_slip + curved * *slip) * *zeta + two * *bend * *slip * across;
            ssy = ssy + by_slip * *slip;
            sys = sys + curved * *slip * *slip;
            syy = syy + by_y * *slip;
            yys = yys + by_slip * across;
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
    /// For rebounds at multiples of the critical speed, divided by the multiple; then for captures at the critical speed.
    /// `None` if friction stops every slip.
    stopped: [Option<Stopped<T, N>>; STOPPED],
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
            expanded.speeds.add(input, centre, step, speeds);
            expanded.slip.add(input, centre, step, slips);
            for (expansion, relief) in expanded.stopped.iter_mut().zip(reliefs) {
                if let Some(expansion) = expansion {
                    expansion.relative.add(input, centre, step, relief);
                }
            }
        }
        Ok(expanded)
    }

    /// The expansions for a given deviation of one input.
    fn with(self, input: usize, z: T) -> Self {
        Self {
            speeds: self.speeds.with(input, z),
            slip: self.slip.with(input, z),
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
        let excess = Excess::new(&variable, &self.slip);
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
        let excess = Excess::new(&variable, &self.slip);
        let [stopped, ..] = self.stopped;
        let sliding = stopped.map_or(T::ZERO, |stopped| {
            let [up, down] = excess.scores(T::ZERO, excess.moments(&stopped));
            normal(up).0 + normal(down).0
        });
        if outcome == Outcome::Rebound { [T::ONE, sliding, T::ZERO] } else { [T::ZERO, T::ZERO, sliding] }
    }
}

/// Adds the effect of the bounds of the inputs.
///
/// Beyond its bound, an input has the value of the bound. The probability beyond it is taken from there, where two points have
/// its mean and its variance, and given to the bound.
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
            let (below, density) = normal(-distance);
            let mean = density / below;
            let spread = (T::ONE + distance * mean - mean * mean).max(T::ZERO).sqrt();
            let half = T::constant(-0.5);
            for (weight, z) in [(T::ONE, distance), (half, mean - spread), (half, mean + spread)] {
                let part = probabilities(&expanded.with(input, sign * z));
                for (sum, part) in sum.iter_mut().zip(part) {
                    *sum = *sum + below * weight * part;
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
