//! Probabilities of the classes of an impact whose inputs have standard errors.
//!
//! # Method
//! Let z be the deviations of the inputs in standard errors: independent standard normal variables. The class depends on z
//! through three quantities: the ratio of the speed to the critical speed, the slip, and the slip that friction stops. The
//! critical speed is a smooth function of the inputs. The stopped slip is not: above the critical speed, it rises as a root.
//! At a given ratio of the speeds, however, it is a smooth function of the inputs. So
//!
//! 1. each quantity is expanded into Hermite polynomials of each z up to the second degree (`expansion`). Relative differences
//!    take the place of positive quantities, as products and powers of inputs are then nearly sums;
//! 2. the ratio of the speeds becomes a function of one normal variable zeta (`integrals`);
//! 3. the expansions give the mean, the variance and the skewness of the slip less the stopped slip at a given zeta
//!    (`excess`);
//! 4. the probability of sliding is integrated over zeta, above and below the critical speed (`panels`).
//!
//! An input with a bound takes the value of the bound beyond it. The probabilities with that value are weighted with the
//! probability to be beyond. Where the input dominates the ratio of the speeds, the rest is the integral over the part of zeta that
//! goes with the input within the bound (`normal::Cut`); elsewhere the input within the bound is one with another mean, variance
//! and skewness.

mod excess;
mod expansion;
mod integrals;
mod normal;
mod panels;

use core::f64::consts::FRAC_1_SQRT_2;

use self::expansion::{Expanded, STOPPED};
use self::integrals::{MIDDLE, REMAINDERS, bounded, multiple};
use self::normal::CERTAIN;
use crate::contact::{Contact, ContactLaw, ErrorControl, Impulses};
use crate::numbers::norm;
use crate::rigid::{MicroforceTerm, ReboundAdhesion};
use crate::{
    Class, Coulomb, CriticalSpeed, Dual, Fault, InputError, NormalImpact, NormalMotion, Oblique, Outcome, Parameter,
    Real, RestitutionLaw, RigidBody, rolling,
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
        norm(self.partials.iter().zip(errors).map(|(partial, error)| *partial * *error))
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

/// An input with its standard error. It is normally distributed about its value.
///
/// ```
/// use microimpact::Parameter;
/// use microimpact::measure::Uncertain;
///
/// let restitution = Uncertain::new(0.98_f64, 0.03)?.within(Parameter::Restitution)?;
/// assert!(Uncertain::new(1.02, 0.03)?.within(Parameter::Restitution).is_err());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Uncertain<T> {
    value: T,
    error: T,
    /// Distances of the bounds from the value, in standard errors.
    bounds: [T; 2],
    range: Option<[T; 2]>,
}

/// Distance of a bound, in standard errors, that no input reaches.
const FAR: f64 = 6.0;

/// Largest standard error over the width of the range.
const WIDEST: f64 = 50.0;

/// Largest standard error of a quantity that is never negative, over its value. Probabilities are expansions about the values: with errors
/// up to this one they are within 0.04, with 0.5 of the friction or the work of adhesion within 0.08, with 1 no better than a guess.
const LARGEST_RELATIVE_ERROR: f64 = 0.3;

impl<T: Real> Uncertain<T> {
    /// Creates an input from its value and its standard error.
    ///
    /// # Errors
    /// The standard error is outside its range.
    ///
    /// ```
    /// use microimpact::Parameter;
    /// use microimpact::measure::Uncertain;
    ///
    /// assert!(Uncertain::new(2.8_f32, 0.1).is_ok());
    /// let refused = Uncertain::new(2.8_f32, 1e30).unwrap_err();
    /// assert_eq!(refused.parameter, Parameter::StandardError);
    /// ```
    pub fn new(value: T, error: T) -> Result<Self, InputError> {
        let error = Parameter::StandardError.check(error)?;
        Ok(Self { value, error, bounds: [T::constant(FAR); 2], range: None })
    }

    /// Bounds the input by the range of a `parameter`.
    ///
    /// If the input would lie beyond the range, it takes the nearest value of the range. Do this for each input that is a
    /// parameter of the scene, so that no deviation makes the scene invalid.
    ///
    /// # Errors
    /// The value is outside the range of the parameter, or the standard error of a parameter that is never negative is above three tenths
    /// of the value.
    ///
    /// ```
    /// use microimpact::measure::{ClassProbabilities, Uncertain};
    /// use microimpact::{Class, ConstantRestitution, NormalMotion, Parameter, RigidBody, Sphere};
    ///
    /// // R is between 0.93 and 1, and one with a probability of one half.
    /// let restitution = Uncertain::new(1.0_f64, 0.03)?.within(Parameter::Restitution)?;
    /// let sphere = Sphere::solid(1e-6, 1000.0)?;
    /// let probabilities = ClassProbabilities::new(&[restitution], |[restitution]| {
    ///     let scene = RigidBody::new(sphere, ConstantRestitution::new(restitution)?)
    ///         .with_work_of_adhesion(0.5 * sphere.mass())?
    ///         .with_friction(0.1)?;
    ///     Ok((scene, NormalMotion::new(1.001)?.with_tangential(0.0)?))
    /// })?;
    /// assert!((probabilities.of(Class::ReboundRolling) - 0.5).abs() < 0.02);
    ///
    /// let refused = Uncertain::new(2e-6, 1e-6)?.within(Parameter::Radius).unwrap_err();
    /// assert_eq!(refused.to_string(), "radius is 2e-6 m, but must have a standard error of at most three tenths of it");
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn within(self, parameter: Parameter) -> Result<Self, InputError> {
        let value = parameter.check(self.value)?;
        let (smallest, largest) = parameter.range();
        if smallest >= 0.0 && self.error > T::constant(LARGEST_RELATIVE_ERROR) * value {
            return Err(InputError { parameter, fault: Fault::TooUncertain, value: value.to_f64() as f32 });
        }
        let far = T::constant(FAR);
        // With a larger error, the input is practically always at a bound too.
        let widest = T::constant(WIDEST) * T::constant(largest - smallest);
        let error = self.error.min(widest);
        let bounds = [value - T::constant(smallest), T::constant(largest) - value]
            .map(|distance| if distance < far * error { distance / error } else { far });
        Ok(Self { value, error, bounds, range: Some([T::constant(smallest), T::constant(largest)]) })
    }

    /// The input that deviates by a number of standard errors. Rounding does not move it out of the range.
    fn at(&self, deviation: T) -> T {
        let value = self.value + deviation * self.error;
        self.range.map_or(value, |[smallest, largest]| value.max(smallest).min(largest))
    }
}

/// An impact whose class has probabilities: a scene with the motion of the sphere.
///
/// It is implemented for
/// - a [`RigidBody`] with Coulomb friction, and an oblique motion: `(scene, motion)`;
/// - a [`Contact`] with Coulomb friction, an oblique motion and a method: `(scene, motion, &method)`;
/// - a motion along the normal and the critical speed of any model: `(motion, critical)`. Friction stops every slip.
///
/// ```
/// use microimpact::measure::Classifiable;
/// use microimpact::{ConstantRestitution, NormalMotion, Outcome, RigidBody, Sphere};
///
/// let sphere = Sphere::solid(1e-6, 1000.0)?;
/// let scene = RigidBody::new(sphere, ConstantRestitution::new(1.0)?).with_friction(0.1)?;
/// let impact = (scene, NormalMotion::new(1.0)?.with_tangential(0.5)?);
/// // f (1 + 1/kappa) (1 + e) v
/// let stopped: Option<f64> = impact.stopped_slip(2.0, Outcome::Rebound)?;
/// assert!((stopped.unwrap() - 0.1 * 3.5 * 2.0 * 2.0).abs() < 1e-12);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub trait Classifiable<T: Real> {
    /// Approach speed, m/s.
    ///
    /// ```
    /// use microimpact::measure::Classifiable;
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// assert_eq!((NormalMotion::new(2.8)?, CriticalSpeed::At(1.8)).speed(), 2.8);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    fn speed(&self) -> T;

    /// Critical speed, m/s.
    ///
    /// # Errors
    /// The model cannot represent the scene.
    ///
    /// ```
    /// use microimpact::measure::Classifiable;
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// let impact = (NormalMotion::new(2.8)?, CriticalSpeed::At(1.8));
    /// assert_eq!(impact.critical_speed(), Ok(CriticalSpeed::At(1.8)));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    fn critical_speed(&self) -> Result<CriticalSpeed<T>, InputError>;

    /// Slip velocity v_ct before the impact, m/s.
    ///
    /// ```
    /// use microimpact::measure::Classifiable;
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// assert_eq!((NormalMotion::new(2.8)?, CriticalSpeed::At(1.8)).slip(), 0.0);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    fn slip(&self) -> T;

    /// Largest slip (m/s) that friction stops if the sphere arrives with this `speed` (m/s) and has this `outcome` (A27).
    ///
    /// It is f (1 + 1/kappa) times the normal impulse per unit mass: (1 + e) v in the rigid-body model. In a simulation,
    /// friction is proportional to the elastic force alone (B8). `None` if friction stops every slip, as in a simulated
    /// capture, because the surface continues to press on the sphere.
    ///
    /// # Errors
    /// The model cannot represent the impact.
    ///
    /// ```
    /// use microimpact::measure::Classifiable;
    /// use microimpact::{CriticalSpeed, NormalMotion, Outcome};
    ///
    /// let impact = (NormalMotion::new(2.8)?, CriticalSpeed::At(1.8));
    /// assert_eq!(impact.stopped_slip(2.0, Outcome::Rebound), Ok(None));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
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
///
/// For inputs with standard errors of up to 10 % and a critical speed, the probabilities of a rigid body and of a simulation
/// differ by about 0.001 on the average from those of simulated random inputs, and by less than 0.01 in the scenes of the tests,
/// where both boundaries between the classes are close; those include scenes in which one input near the bound of its range, as a
/// restitution near one, alone decides whether the sphere rebounds. In a few scenes the error may be 0.03: where slip just ends, and the
/// slowest of the likely motions end in capture; with standard errors of up to 30 % it is less than 0.04 in the scenes of the tests.
/// [Larger errors](Uncertain::within) of quantities that are never negative are refused. Random inputs beyond the range of their
/// [parameter](Uncertain::within) take the nearest value of the range. If the inputs without errors have no critical speed, their
/// outcome counts as certain.
///
/// ```
/// use microimpact::measure::{ClassProbabilities, Uncertain};
/// use microimpact::{Class, NormalMotion, Parameter, RigidBody, SpeedRestitution, Sphere};
///
/// // The scene of Table 1. Both velocities, the spin and the friction coefficient have standard errors.
/// let inputs = [
///     Uncertain::new(2.8_f64, 0.05)?.within(Parameter::ApproachSpeed)?,
///     Uncertain::new(0.0, 0.05)?.within(Parameter::TangentialVelocity)?,
///     Uncertain::new(0.739, 0.3)?.within(Parameter::PeripheralVelocity)?,
///     Uncertain::new(0.1, 0.03)?.within(Parameter::Friction)?,
/// ];
/// let probabilities = ClassProbabilities::new(&inputs, |[speed, tangential, peripheral, friction]| {
///     let scene = RigidBody::new(Sphere::solid(5.06e-6, 2600.0)?, SpeedRestitution::new(130.0)?)
///         .with_work_of_adhesion(2.22e-12)?
///         .with_friction(friction)?;
///     let motion = NormalMotion::new(speed)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
///     Ok((scene, motion))
/// })?;
/// assert!(probabilities.of(Class::ReboundRolling) > 0.9);
/// assert!(probabilities.of(Class::ReboundSliding) > 0.01);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ClassProbabilities<T> {
    rebound: T,
    /// Probabilities of sliding together with rebound and with capture.
    sliding: [T; 2],
}

impl<T: Real> ClassProbabilities<T> {
    /// Computes the probabilities of an impact that depends on the `inputs`.
    ///
    /// `impact` returns the scene and the motion for given values of the inputs. It is called about 2N + 1 times for N inputs.
    /// The errors of the inputs are independent; results of the same input, such as the velocities along the normal and along
    /// the surface of one angle, are correlated.
    ///
    /// # Errors
    /// `impact` or the model refuses a value within a few standard errors of an input.
    ///
    /// ```
    /// use microimpact::measure::{ClassProbabilities, Uncertain};
    /// use microimpact::{CriticalSpeed, NormalMotion, Parameter};
    ///
    /// // The speed is equal to the critical speed.
    /// let speed = Uncertain::new(2.0_f64, 0.1)?.within(Parameter::ApproachSpeed)?;
    /// let probabilities =
    ///     ClassProbabilities::new(&[speed], |[speed]| Ok((NormalMotion::new(speed)?, CriticalSpeed::At(2.0))))?;
    /// assert!((probabilities.rebound() - 0.5).abs() < 1e-3);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
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
        let mut expanded = Expanded::new(inputs, &impact, &nominal, |impact| {
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
        });
        let expanded = expanded.as_mut().map_err(|error| *error)?;
        let speed = critical * multiple(T::constant(MIDDLE));
        if let Some(middle) = nominal.stopped_slip(speed, Outcome::Rebound)? {
            expanded.bend_stopped(middle / speed * nominal.speed());
        }
        let (_, zeta, _) = expanded.zeta();
        if zeta.abs() >= T::constant(CERTAIN) {
            let outcome = if zeta < T::ZERO { Outcome::Rebound } else { Outcome::Capture };
            return Self::certain(inputs, &impact, &nominal, outcome);
        }
        Ok(Self::from_sums(bounded(inputs, expanded, Expanded::probabilities)))
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
            Ok((None, [stopped, None, None]))
        })?;
        Ok(Self::from_sums(bounded(inputs, &expanded, |expanded, _| expanded.certain(outcome))))
    }

    /// Probability of a class. A captured sphere that rests counts as rolling, because the probability of rest is zero.
    ///
    /// ```
    /// use microimpact::measure::{ClassProbabilities, Uncertain};
    /// use microimpact::{Class, ConstantRestitution, NormalMotion, RigidBody, Sphere};
    ///
    /// // The slip is equal to the slip that friction stops.
    /// let scene = RigidBody::new(Sphere::solid(1e-6, 1000.0)?, ConstantRestitution::new(1.0)?).with_friction(0.1)?;
    /// let probabilities = ClassProbabilities::new(&[Uncertain::new(0.7_f64, 0.1)?], |[tangential]| {
    ///     Ok((scene, NormalMotion::new(1.0)?.with_tangential(tangential)?))
    /// })?;
    /// assert!((probabilities.of(Class::ReboundSliding) - 0.5).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
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

    /// Probabilities of all classes, in the order [`ReboundSliding`](Class::ReboundSliding),
    /// [`ReboundRolling`](Class::ReboundRolling), [`CapturedSliding`](Class::CapturedSliding),
    /// [`CapturedRolling`](Class::CapturedRolling), [`CapturedResting`](Class::CapturedResting) and
    /// [`Undecided`](Class::Undecided). The last two are zero. All add up to one.
    ///
    /// ```
    /// use microimpact::measure::{ClassProbabilities, Uncertain};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// // The speed is equal to the critical speed, and friction stops every slip.
    /// let probabilities = ClassProbabilities::new(&[Uncertain::new(2.0_f64, 0.1)?], |[speed]| {
    ///     Ok((NormalMotion::new(speed)?, CriticalSpeed::At(2.0)))
    /// })?;
    /// let [_, rebound_rolling, _, captured_rolling, ..] = probabilities.by_class();
    /// assert!((rebound_rolling - 0.5).abs() < 1e-3 && (captured_rolling - 0.5).abs() < 1e-3);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn by_class(&self) -> [T; 6] {
        let [rebound_sliding, rebound_rolling, captured_sliding, captured_rolling] =
            [Class::ReboundSliding, Class::ReboundRolling, Class::CapturedSliding, Class::CapturedRolling]
                .map(|class| self.of(class));
        [rebound_sliding, rebound_rolling, captured_sliding, captured_rolling, T::ZERO, T::ZERO]
    }

    /// Probability of a rebound, sliding or rolling.
    ///
    /// ```
    /// use microimpact::measure::{ClassProbabilities, Uncertain};
    /// use microimpact::{CriticalSpeed, NormalMotion};
    ///
    /// // The speed is 5 % above the critical speed. Its standard error is 0.1 m/s, and that of the critical speed is 5 %.
    /// let inputs = [Uncertain::new(1.9_f64, 0.1)?, Uncertain::new(1.8, 0.09)?];
    /// let probabilities = ClassProbabilities::new(&inputs, |[speed, critical]| {
    ///     Ok((NormalMotion::new(speed)?, CriticalSpeed::At(critical)))
    /// })?;
    /// assert!((0.7..0.8).contains(&probabilities.rebound()));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn rebound(&self) -> T {
        self.rebound
    }
}
