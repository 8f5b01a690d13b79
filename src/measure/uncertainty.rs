//! Probabilities of the classes of an impact whose inputs have standard errors.

use core::f64::consts::FRAC_1_SQRT_2;

use crate::contact::Nodes;
use crate::{Class, Coulomb, CriticalSpeed, Dual, InputError, Oblique, Parameter, Real, Sphere, rolling};

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
/// assert!((0.0_f64.both_below(0.0, 0.5) - 1.0 / 3.0).abs() < 1e-9);
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

    /// Probability that one standard normal variable is below this number and a second one below the `other` number.
    ///
    /// The variables have the given `correlation`, -1 to 1. The error is 1e-7, and 2e-4 for correlations beyond 0.9.
    ///
    /// ```
    /// use microimpact::measure::NormalDistribution;
    ///
    /// // Independent variables, and identical variables.
    /// assert!((1.0_f64.both_below(0.0, 0.0) - 1.0_f64.below() * 0.5).abs() < 1e-12);
    /// assert_eq!(1.0_f64.both_below(0.0, 1.0), 0.5);
    /// ```
    fn both_below(self, other: Self, correlation: Self) -> Self;
}

/// Number of standard errors beyond which a result is certain.
const CERTAIN: f64 = 30.0;

/// Correlation from which two variables count as identical. The integral below loses its accuracy there.
const ALIKE: f64 = 0.9999;

macro_rules! impl_normal_distribution {
    ($float:ident, $erfc:path, $asin:path, $sin:path, $exp:path) => {
        impl NormalDistribution for $float {
            fn below(self) -> Self {
                0.5 * $erfc(-self * FRAC_1_SQRT_2 as $float)
            }

            fn both_below(self, other: Self, correlation: Self) -> Self {
                let limit = CERTAIN as $float;
                let (h, k) = (self.clamp(-limit, limit), other.clamp(-limit, limit));
                if correlation > ALIKE as $float {
                    return h.min(k).below();
                }
                if correlation < -ALIKE as $float {
                    return (h.below() - (-k).below()).max(0.0);
                }
                // The derivative with respect to the correlation is the joint density. Its integral over the arc sine of the
                // correlation is smooth (Drezner and Wesolowsky 1990).
                let angle = $asin(correlation);
                let mut sum = 0.0;
                for (z, weight) in <$float as Nodes<16>>::Z.into_iter().zip(<$float as Nodes<16>>::WEIGHTS) {
                    let sine = $sin(angle * z);
                    let cosine_squared = (1.0 - sine) * (1.0 + sine);
                    sum += weight * $exp((h * k * sine - 0.5 * (h * h + k * k)) / cosine_squared);
                }
                let joint = h.below() * k.below() + angle * sum * (core::f64::consts::FRAC_1_PI * 0.5) as $float;
                joint.clamp(0.0, 1.0)
            }
        }
    };
}

impl_normal_distribution!(f32, libm::erfcf, libm::asinf, libm::sinf, libm::expf);
impl_normal_distribution!(f64, libm::erfc, libm::asin, libm::sin, libm::exp);

/// Largest slip that friction stops during an impact, f (1 + 1/kappa) P_n/m, in m/s. With a smaller slip, the sphere rolls at
/// separation (A27).
///
/// `velocity_change` is P_n/m in m/s, which is (1 + e) v for a rigid body. In a simulation, friction is proportional to the
/// elastic force alone (B8). There, it is the impulse of the elastic force divided by the mass.
///
/// ```
/// use microimpact::measure::stopped_slip;
/// use microimpact::{Coulomb, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// assert!((stopped_slip(&sphere, &Coulomb::new(0.1)?, 2.0) - 0.7_f64).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn stopped_slip<T: Real>(sphere: &Sphere<T>, friction: &Coulomb<T>, velocity_change: T) -> T {
    rolling::stopped_slip(friction.coefficient() * velocity_change, sphere.contact_inertia())
}

/// Probability that a sphere rebounds, from its speed and the critical speed with their derivatives, and from the standard
/// `errors` of the inputs.
///
/// # Errors
/// A standard error is outside its range.
///
/// ```
/// use microimpact::measure::rebound_probability;
/// use microimpact::{Dual, NormalMotion, RigidBody, Real, SpeedRestitution, Sphere};
///
/// // The speed is 5 % above the critical speed. Its standard error is 0.1 m/s, and that of W_A is 10 %.
/// let [speed, work] = Dual::variables([1.9_f64, 2.22e-12]);
/// let sphere = Sphere::solid(Dual::constant(5.06e-6), Dual::constant(2600.0))?;
/// let scene = RigidBody::new(sphere, SpeedRestitution::new(Dual::constant(130.0))?).with_work_of_adhesion(work)?;
/// let probability = rebound_probability(speed, &scene.critical_speed(), &[0.1, 0.22e-12])?;
/// assert!((0.7..0.8).contains(&probability));
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn rebound_probability<T: NormalDistribution, const N: usize>(
    speed: Dual<T, N>,
    critical: &CriticalSpeed<Dual<T, N>>,
    errors: &[T; N],
) -> Result<T, InputError> {
    Ok(Margin::of_speed(speed, critical, &checked(errors)?).ratio.below())
}

/// Probabilities of the classes of an impact. Their sum is one.
///
/// ```
/// use microimpact::measure::{ClassProbabilities, stopped_slip};
/// use microimpact::{Approach, Class, Coulomb, Dual, NormalMotion, Real, RigidBody, SpeedRestitution, Sphere};
///
/// // The scene of Table 1. Both velocities, the spin and the friction coefficient have standard errors.
/// let [speed, tangential, peripheral, friction] = Dual::variables([2.8_f64, 0.0, 0.739, 0.1]);
/// let sphere = Sphere::solid(Dual::constant(5.06e-6), Dual::constant(2600.0))?;
/// let scene = RigidBody::new(sphere, SpeedRestitution::new(Dual::constant(130.0))?)
///     .with_work_of_adhesion(Dual::constant(2.22e-12))?;
/// let motion = NormalMotion::new(speed)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
/// let normal = scene.impact(&motion.normal()).normal;
/// let stopped = stopped_slip(&sphere, &Coulomb::new(friction)?, speed + normal.rebound_speed());
///
/// let errors = [0.05, 0.05, 0.3, 0.03];
/// let probabilities = ClassProbabilities::new(&motion, &scene.critical_speed(), stopped, &errors)?;
/// assert!(probabilities.of(Class::ReboundRolling) > 0.9);
/// assert!(probabilities.of(Class::ReboundSliding) > 0.01);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ClassProbabilities<T> {
    rebound: T,
    sliding: T,
    /// Probability of rebound and sliding together.
    both: T,
}

impl<T: NormalDistribution> ClassProbabilities<T> {
    /// Computes the probabilities for a sphere that arrives with `motion`.
    ///
    /// The contact has a `critical` speed. Its friction stops a slip of up to `stopped` (m/s, see [`stopped_slip`]). The
    /// standard `errors` are in the order of the inputs of the dual numbers.
    ///
    /// # Errors
    /// A standard error is outside its range.
    ///
    /// ```
    /// use microimpact::measure::ClassProbabilities;
    /// use microimpact::{Class, CriticalSpeed, Dual, NormalMotion, Real};
    ///
    /// // The slip is equal to the slip that friction stops, so that the sphere slides with a probability of one half.
    /// let [tangential] = Dual::variables([0.7_f64]);
    /// let motion = NormalMotion::new(Dual::constant(2.0))?.with_tangential(tangential)?;
    /// let stopped = Dual::constant(0.7);
    /// let probabilities = ClassProbabilities::new(&motion, &CriticalSpeed::AlwaysRebounds, stopped, &[0.1])?;
    /// assert!((probabilities.of(Class::ReboundSliding) - 0.5).abs() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new<const N: usize>(
        motion: &impl Oblique<Dual<T, N>>,
        critical: &CriticalSpeed<Dual<T, N>>,
        stopped: Dual<T, N>,
        errors: &[T; N],
    ) -> Result<Self, InputError> {
        let errors = checked(errors)?;
        let speed = Margin::of_speed(motion.normal().speed(), critical, &errors);
        let (mut sliding, mut both) = (T::ZERO, T::ZERO);
        // The sphere slides if the slip exceeds the stopped slip in either direction.
        for slip in [motion.slip(), -motion.slip()] {
            let beyond = Margin::of(slip - stopped, &errors);
            sliding = sliding + beyond.ratio.below();
            both = both + speed.ratio.both_below(beyond.ratio, speed.correlation(&beyond));
        }
        let rebound = speed.ratio.below();
        let sliding = sliding.min(T::ONE);
        // The joint probability is less accurate than the single probabilities, which bound it.
        let both = both.max(rebound + sliding - T::ONE).max(T::ZERO).min(sliding).min(rebound);
        Ok(Self { rebound, sliding, both })
    }

    /// Probability of a class. A captured sphere that rests counts as rolling, because the probability of rest is zero.
    ///
    /// ```
    /// use microimpact::measure::ClassProbabilities;
    /// use microimpact::{Class, CriticalSpeed, Dual, NormalMotion, Real};
    ///
    /// let [speed] = Dual::variables([2.0_f64]);
    /// let motion = NormalMotion::new(speed)?.with_tangential(Dual::ZERO)?;
    /// let critical = CriticalSpeed::At(Dual::constant(2.0));
    /// let probabilities = ClassProbabilities::new(&motion, &critical, Dual::constant(0.7), &[0.1])?;
    /// assert!((probabilities.of(Class::CapturedRolling) - 0.5).abs() < 1e-12);
    /// assert!(probabilities.of(Class::CapturedSliding) < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn of(&self, class: Class) -> T {
        let probability = match class {
            Class::ReboundSliding => self.both,
            Class::ReboundRolling => self.rebound - self.both,
            Class::CapturedSliding => self.sliding - self.both,
            Class::CapturedRolling | Class::CapturedResting => T::ONE - self.rebound - self.sliding + self.both,
            Class::Undecided => T::ZERO,
        };
        // Rounding must not make it negative.
        probability.max(T::ZERO)
    }

    /// Probability of a rebound, sliding or rolling.
    ///
    /// ```
    /// use microimpact::measure::ClassProbabilities;
    /// use microimpact::{CriticalSpeed, Dual, NormalMotion, Real};
    ///
    /// let motion = NormalMotion::new(Dual::<f64, 0>::constant(2.0))?.with_tangential(Dual::ZERO)?;
    /// let never = CriticalSpeed::NeverRebounds;
    /// assert!(ClassProbabilities::new(&motion, &never, Dual::ZERO, &[])?.rebound() < 1e-12);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn rebound(&self) -> T {
        self.rebound
    }
}

/// A margin of a class, which is positive on one side of the boundary.
struct Margin<T, const N: usize> {
    /// The margin divided by its standard error.
    ratio: T,
    /// Contributions of the inputs to the standard error, divided by it, with their signs.
    parts: [T; N],
}

impl<T: Real, const N: usize> Margin<T, N> {
    fn of(margin: Dual<T, N>, errors: &[T; N]) -> Self {
        let error = margin.standard_error(errors);
        let certain = T::constant(CERTAIN);
        if error <= T::ZERO {
            let ratio = if margin.value >= T::ZERO { certain } else { -certain };
            return Self { ratio, parts: [T::ZERO; N] };
        }
        let mut parts = margin.partials;
        for (part, input) in parts.iter_mut().zip(errors) {
            *part = *part * *input / error;
        }
        Self { ratio: margin.value.saturating_div(error).min(certain).max(-certain), parts }
    }

    /// The difference between a speed and the critical speed.
    fn of_speed(speed: Dual<T, N>, critical: &CriticalSpeed<Dual<T, N>>, errors: &[T; N]) -> Self {
        match critical {
            CriticalSpeed::At(critical) => Self::of(speed - *critical, errors),
            CriticalSpeed::AlwaysRebounds => Self::of(Dual::ONE, errors),
            CriticalSpeed::NeverRebounds => Self::of(-Dual::ONE, errors),
        }
    }

    fn correlation(&self, other: &Self) -> T {
        let products = self.parts.iter().zip(&other.parts).map(|(a, b)| *a * *b);
        products.fold(T::ZERO, |sum, product| sum + product).max(-T::ONE).min(T::ONE)
    }
}

fn checked<T: Real, const N: usize>(errors: &[T; N]) -> Result<[T; N], InputError> {
    for error in errors {
        Parameter::StandardError.check(*error)?;
    }
    Ok(*errors)
}
