//! Fit of the restitution law R = k/(k + v) and the work of adhesion W_A to many rebounds.
//!
//! The model is e^2 = R^2 - 2 W_A/(m v^2) (A34). With speeds in units of the largest speed, x, it is
//! e^2 = (1 + c x)^-2 - b/x^2. The fit starts with the curve through two rebounds that has the smallest median deviation of e.
//! Up to half of the data may be outliers (Rousseeuw 1984). Tukey's biweight then refines the curve (Yohai 1987).

use super::robust::{DEVIATION, Influence, MOST_PASSES, median, number};
use super::{CalibrationError, Estimate, MeasuredRebound};
use crate::rigid::WorkOfAdhesion;
use crate::{CriticalSpeed, Dual, InputError, NormalMotion, Parameter, Real, RigidBody, SpeedRestitution, Sphere};

/// Restitution law and work of adhesion, fitted to many rebounds of a sphere.
///
/// ```
/// use microimpact::measure::{MeasuredRebound, RestitutionFit};
/// use microimpact::{CriticalSpeed, NormalMotion, RigidBody, SpeedRestitution, Sphere};
///
/// // Rebounds that follow the law of the paper, except for two outliers.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = RigidBody::new(sphere, SpeedRestitution::new(130.0)?).with_work_of_adhesion(2.22e-12)?;
/// let mut rebounds = [MeasuredRebound { speed: 0.0, restitution: 0.0 }; 20];
/// for (rebound, speed) in rebounds.iter_mut().zip(2..) {
///     let speed = f64::from(speed);
///     *rebound = MeasuredRebound { speed, restitution: scene.impact(&NormalMotion::new(speed)?).normal.overall_restitution() };
/// }
/// rebounds[3].restitution = 0.2;
/// rebounds[12].restitution = 1.0;
///
/// let fit = RestitutionFit::of(&sphere, &rebounds)?;
/// assert!((fit.restitution_speed.value - 130.0).abs() < 1e-6);
/// assert!((fit.work_of_adhesion.value - 2.22e-12).abs() < 1e-20);
/// assert_eq!(fit.outliers, 2);
/// assert!(matches!(fit.critical_speed()?, CriticalSpeed::At(speed) if (speed.value - 1.8).abs() < 0.03));
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RestitutionFit<T> {
    /// Speed k of the restitution law, m/s.
    pub restitution_speed: Estimate<T>,
    /// Work of adhesion W_A, J.
    pub work_of_adhesion: Estimate<T>,
    /// Correlation of the errors of both parameters, -1 to 1.
    pub correlation: T,
    /// Standard deviation of one restitution about the curve.
    pub scale: T,
    /// Number of rebounds, without captures.
    pub rebounds: u32,
    /// Number of outliers: rebounds so far from the curve that they have no weight.
    pub outliers: u32,
    sphere: Sphere<T>,
}

/// Number of pairs of rebounds that are tried for a first curve. Even if half of the rebounds are outliers, some pair has
/// none.
const MOST_PAIRS: u32 = 128;

impl<T: Real> RestitutionFit<T> {
    /// Fits the law to `rebounds` of one `sphere`. Captures, whose restitution is zero, are ignored.
    ///
    /// If the best fit has a negative work of adhesion, the work is set to zero.
    ///
    /// # Errors
    /// A speed or a restitution is outside its range, there are fewer than four rebounds, the rebounds do not determine both
    /// parameters, or the restitution does not decrease with speed.
    ///
    /// ```
    /// use microimpact::Sphere;
    /// use microimpact::measure::{CalibrationError, MeasuredRebound, RestitutionFit};
    ///
    /// let alike = [MeasuredRebound { speed: 2.0, restitution: 0.7_f32 }; 9];
    /// let fit = RestitutionFit::of(&Sphere::solid(1e-6, 2600.0)?, &alike);
    /// assert_eq!(fit, Err(CalibrationError::Undetermined));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn of(sphere: &Sphere<T>, rebounds: &[MeasuredRebound<T>]) -> Result<Self, CalibrationError> {
        let mut cloud = Cloud { rebounds, fastest: T::ZERO, count: 0 };
        for rebound in rebounds {
            let (motion, square) = rebound.checked()?;
            if square > T::ZERO {
                cloud.fastest = cloud.fastest.max(motion.speed());
                cloud.count += 1;
            }
        }
        if cloud.count < 4 {
            return Err(CalibrationError::TooFew);
        }
        let mut curve = cloud.start().ok_or(CalibrationError::Undetermined)?;
        let mut scale = T::ZERO;
        for _ in 0..2 {
            scale = cloud.scale(&curve);
            cloud.refine(&mut curve, scale)?;
        }
        if curve.loss <= T::constant(16.0) * T::EPSILON {
            return Err(CalibrationError::NoMaterialLoss);
        }
        let Spread { loss, pull, correlation, outliers } = cloud.spread(&curve, scale)?;
        let speed = Parameter::RestitutionSpeed.check(cloud.fastest / curve.loss)?;
        let energy = T::constant(0.5) * sphere.mass() * cloud.fastest * cloud.fastest;
        let work = Parameter::WorkOfAdhesion.check(energy * curve.pull)?;
        Ok(Self {
            restitution_speed: Estimate { value: speed, standard_error: speed * (loss / curve.loss) },
            work_of_adhesion: Estimate { value: work, standard_error: energy * pull },
            // k decreases with c, which changes the sign of the correlation.
            correlation: -correlation,
            scale,
            rebounds: cloud.count,
            outliers,
            sphere: *sphere,
        })
    }

    /// Critical speed, m/s, with its standard error.
    ///
    /// # Errors
    /// A value is outside its range.
    ///
    /// ```
    /// use microimpact::measure::{MeasuredRebound, RestitutionFit};
    /// use microimpact::{CriticalSpeed, Sphere};
    ///
    /// // Without adhesion, R = 60/(60 + v), every sphere rebounds.
    /// let at = |speed: f64| MeasuredRebound { speed, restitution: 60.0 / (60.0 + speed) };
    /// let fit = RestitutionFit::of(&Sphere::solid(1e-6, 2600.0)?, &[at(1.0), at(4.0), at(9.0), at(20.0), at(30.0)])?;
    /// assert!(match fit.critical_speed()? {
    ///     CriticalSpeed::At(speed) => speed.value < 1e-3,
    ///     other => other == CriticalSpeed::AlwaysRebounds,
    /// });
    /// # Ok::<(), microimpact::measure::CalibrationError>(())
    /// ```
    pub fn critical_speed(&self) -> Result<CriticalSpeed<Estimate<T>>, InputError> {
        Ok(match self.scene()?.critical_speed() {
            CriticalSpeed::At(speed) => CriticalSpeed::At(self.estimate(speed)),
            CriticalSpeed::AlwaysRebounds => CriticalSpeed::AlwaysRebounds,
            CriticalSpeed::NeverRebounds => CriticalSpeed::NeverRebounds,
        })
    }

    /// Adhesion coefficient rho = 1 - e/R at an approach `speed` (m/s). For a capture, it is one with the standard error zero.
    ///
    /// # Errors
    /// The speed is outside its range.
    ///
    /// ```
    /// use microimpact::measure::{MeasuredRebound, RestitutionFit};
    /// use microimpact::Sphere;
    ///
    /// // Values like those of Table 1. The fit gives rho = 0.24 at 2.8 m/s.
    /// let at = |speed, restitution| MeasuredRebound { speed, restitution };
    /// let rebounds = [at(2.1, 0.510), at(2.8, 0.747), at(5.0, 0.894), at(9.0, 0.914), at(20.0, 0.862), at(40.0, 0.763)];
    /// let fit = RestitutionFit::of(&Sphere::solid(5.06e-6, 2600.0)?, &rebounds)?;
    /// let adhesion: microimpact::measure::Estimate<f64> = fit.adhesion_coefficient(2.8)?;
    /// assert!((adhesion.value - 0.237).abs() < 0.01 && adhesion.standard_error < 0.01);
    /// # Ok::<(), microimpact::measure::CalibrationError>(())
    /// ```
    pub fn adhesion_coefficient(&self, speed: T) -> Result<Estimate<T>, InputError> {
        let motion = NormalMotion::new(Dual::fixed(speed))?;
        Ok(self.estimate(self.scene()?.impact(&motion).normal.adhesion_coefficient()))
    }

    /// The scene in dual numbers, with k and W_A as the inputs.
    fn scene(
        &self,
    ) -> Result<RigidBody<Dual<T, 2>, SpeedRestitution<Dual<T, 2>>, WorkOfAdhesion<Dual<T, 2>>>, InputError> {
        let [speed, work] = Dual::variables([self.restitution_speed.value, self.work_of_adhesion.value]);
        let [radius, density] = [self.sphere.radius(), self.sphere.density()].map(Dual::fixed);
        let sphere = Sphere::new(radius, density, Dual::fixed(self.sphere.gyration_ratio()))?;
        RigidBody::new(sphere, SpeedRestitution::new(speed)?).with_work_of_adhesion(work)
    }

    /// A result with the standard error that follows from those of k and W_A.
    fn estimate(&self, result: Dual<T, 2>) -> Estimate<T> {
        let [by_speed, by_work] = result.partials;
        let first = by_speed * self.restitution_speed.standard_error;
        let second = by_work * self.work_of_adhesion.standard_error;
        let variance = first * first + second * second + T::constant(2.0) * self.correlation * first * second;
        Estimate { value: result.value, standard_error: variance.max(T::ZERO).sqrt() }
    }
}

/// e^2 = (1 + c x)^-2 - b/x^2.
#[derive(Clone, Copy, Debug)]
struct Curve<T> {
    /// c: the largest speed divided by k.
    loss: T,
    /// b: 2 W_A/m divided by the square of the largest speed.
    pull: T,
}

impl<T: Real> Curve<T> {
    fn square(&self, x: T) -> T {
        let r = T::ONE / (T::ONE + self.loss * x);
        r * r - self.pull / (x * x)
    }

    fn restitution(&self, x: T) -> T {
        self.square(x).max(T::ZERO).sqrt()
    }

    /// Derivatives of e^2 with respect to c and b.
    fn slopes(&self, x: T) -> [T; 2] {
        let r = T::ONE / (T::ONE + self.loss * x);
        [T::constant(-2.0) * x * r * r * r, -(T::ONE / (x * x))]
    }

    /// The curve through two points of different speeds. `None` if no curve with c >= 0 passes through both.
    fn through(slow: (T, T), fast: (T, T)) -> Option<Self> {
        let body = |(x, _): (T, T), loss: T| x / (T::ONE + loss * x);
        let square = |x: T| x * x;
        // Adhesion takes the same work from both rebounds, so that it cancels in the difference.
        let target = square(fast.0 * fast.1) - square(slow.0 * slow.1);
        if target <= T::ZERO {
            return None;
        }
        let mut loss = T::ZERO;
        // The difference is a convex, decreasing function of c, so that Newton's method converges from below.
        for _ in 0..60 {
            let (high, low) = (body(fast, loss), body(slow, loss));
            let excess = square(high) - square(low) - target;
            let slope = T::constant(2.0) * (high * high * high - low * low * low);
            if excess <= T::constant(4.0) * T::EPSILON || slope <= T::ZERO {
                break;
            }
            loss = loss + excess / slope;
        }
        let pull = square(body(fast, loss)) - square(fast.0 * fast.1);
        Some(Self { loss, pull: pull.max(T::ZERO) })
    }
}

/// The rebounds among the data.
struct Cloud<'a, T> {
    rebounds: &'a [MeasuredRebound<T>],
    /// Largest speed, m/s.
    fastest: T,
    count: u32,
}

/// Standard errors of c and b, the correlation of their errors, and the number of outliers.
struct Spread<T> {
    loss: T,
    pull: T,
    correlation: T,
    outliers: u32,
}

impl<T: Real> Cloud<'_, T> {
    /// Speed divided by the largest speed, and restitution, of each rebound.
    fn points(&self) -> impl Iterator<Item = (T, T)> + Clone {
        let fastest = self.fastest;
        let rebounds = self.rebounds.iter().filter(|rebound| rebound.restitution > T::ZERO);
        rebounds.map(move |rebound| (rebound.speed / fastest, rebound.restitution))
    }

    /// The curve through two points that has the smallest median deviation.
    fn start(&self) -> Option<Curve<T>> {
        let mut best: Option<(Curve<T>, T)> = None;
        let mut state = 1_u32;
        let mut draw = || {
            // The high bits of a linear congruential generator are random enough.
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % self.count
        };
        for _ in 0..MOST_PAIRS {
            let (first, second) = (self.points().nth(draw() as usize)?, self.points().nth(draw() as usize)?);
            let (slow, fast) = if first.0 < second.0 { (first, second) } else { (second, first) };
            if fast.0 - slow.0 < T::constant(0.02) * fast.0 {
                continue;
            }
            let Some(curve) = Curve::through(slow, fast) else {
                continue;
            };
            let deviations = self.points().map(|(x, e)| (e - curve.restitution(x)).abs());
            // One count rejects most curves.
            if let Some((_, least)) = best
                && 2 * deviations.clone().filter(|deviation| *deviation < least).count() <= self.count as usize
            {
                continue;
            }
            best = median(deviations).map(|median| (curve, median));
        }
        best.map(|(curve, _)| curve)
    }

    /// Standard deviation of e about a curve, from the median deviation.
    fn scale(&self, curve: &Curve<T>) -> T {
        let deviation = median(self.points().map(|(x, e)| (e - curve.restitution(x)).abs())).unwrap_or(T::ZERO);
        // The curve has two parameters.
        let freedom = number::<T>(self.count) / number(self.count - 2);
        (T::constant(DEVIATION) * freedom * deviation).max(T::constant(32.0) * T::EPSILON)
    }

    /// Deviations in units of their scale, with the derivatives of the curve in the same units.
    fn deviations(&self, curve: &Curve<T>, scale: T) -> impl Iterator<Item = (T, [T; 2])> + Clone {
        let (curve, least) = (*curve, T::constant(2.0) * scale);
        self.points().map(move |(x, e)| {
            let predicted = curve.restitution(x);
            // An error of e changes e^2 by (e + predicted) times that error. Close to capture, the scale is the lower limit.
            let unit = T::ONE / ((e + predicted).max(least) * scale);
            ((e - predicted) / scale, curve.slopes(x).map(|slope| slope * unit))
        })
    }

    /// Refines the curve by reweighted least squares (Gauss-Newton). Both parameters stay at zero or above.
    fn refine(&self, curve: &mut Curve<T>, scale: T) -> Result<(), CalibrationError> {
        for _ in 0..MOST_PASSES {
            let (mut normal, mut right) = (Symmetric::ZERO, [T::ZERO; 2]);
            for (deviation, slopes) in self.deviations(curve, scale) {
                let Influence { weight, psi, .. } = Influence::of(deviation);
                normal.add(weight, slopes);
                right = [right[0] + psi * slopes[0], right[1] + psi * slopes[1]];
            }
            let inverse = normal.inverse().ok_or(CalibrationError::Undetermined)?;
            let step = inverse.times(right);
            let mut next = Curve { loss: curve.loss + step[0], pull: curve.pull + step[1] };
            if next.pull < T::ZERO {
                next =
                    Curve { loss: curve.loss + (right[0] + normal.mixed * curve.pull) / normal.first, pull: T::ZERO };
            }
            if next.loss < T::ZERO {
                let pull = curve.pull + (right[1] + normal.mixed * curve.loss) / normal.second;
                next = Curve { loss: T::ZERO, pull: pull.max(T::ZERO) };
            }
            let rounding = T::constant(16.0) * T::EPSILON;
            let converged = (next.loss - curve.loss).abs() <= rounding * next.loss
                && (next.pull - curve.pull).abs() <= rounding * next.pull.max(rounding);
            *curve = next;
            if converged {
                break;
            }
        }
        Ok(())
    }

    /// Standard errors of the parameters: those of least squares, corrected for the loss of efficiency by the weights.
    fn spread(&self, curve: &Curve<T>, scale: T) -> Result<Spread<T>, CalibrationError> {
        let mut normal = Symmetric::ZERO;
        let (mut weights, mut squares, mut slopes, mut outliers) = (T::ZERO, T::ZERO, T::ZERO, 0);
        for (deviation, derivatives) in self.deviations(curve, scale) {
            let Influence { weight, psi, slope } = Influence::of(deviation);
            normal.add(weight, derivatives);
            weights = weights + weight;
            squares = squares + psi * psi;
            slopes = slopes + slope;
            outliers += u32::from(weight == T::ZERO);
        }
        let covariance = normal.inverse().ok_or(CalibrationError::Undetermined)?;
        if slopes <= T::ZERO {
            return Err(CalibrationError::Undetermined);
        }
        let freedom = number::<T>(self.count) / number(self.count - 2);
        let cost = freedom * squares / slopes * (weights / slopes);
        let [loss, pull] = [covariance.first, covariance.second].map(|variance| (cost * variance).sqrt());
        let correlation = covariance.mixed / (covariance.first.sqrt() * covariance.second.sqrt());
        Ok(Spread { loss, pull, correlation, outliers })
    }
}

/// A symmetric matrix of two rows.
#[derive(Clone, Copy)]
struct Symmetric<T> {
    first: T,
    mixed: T,
    second: T,
}

impl<T: Real> Symmetric<T> {
    const ZERO: Self = Self { first: T::ZERO, mixed: T::ZERO, second: T::ZERO };

    /// Adds a weight times the outer product of a vector with itself.
    fn add(&mut self, weight: T, [a, b]: [T; 2]) {
        self.first = self.first + weight * a * a;
        self.mixed = self.mixed + weight * a * b;
        self.second = self.second + weight * b * b;
    }

    fn times(&self, [a, b]: [T; 2]) -> [T; 2] {
        [self.first * a + self.mixed * b, self.mixed * a + self.second * b]
    }

    /// The inverse of a positive definite matrix. `None` if rounding makes it singular.
    fn inverse(&self) -> Option<Self> {
        let product = self.first * self.second;
        let determinant = product - self.mixed * self.mixed;
        let regular =
            self.first > T::ZERO && self.second > T::ZERO && determinant > T::constant(64.0) * T::EPSILON * product;
        regular.then(|| Self {
            first: self.second / determinant,
            mixed: -(self.mixed / determinant),
            second: self.first / determinant,
        })
    }
}
