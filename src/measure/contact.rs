//! One parameter of a simulated contact from one measured impact.

use super::{CalibrationError, Estimate, MeasuredRebound};
use crate::bodies::strength_at_rest;
use crate::contact::{Attraction, Contact, ContactLaw, Damping, HertzLaw, Method, Status};
use crate::numbers::root;
use crate::{Dual, InputError, NoAdhesion, NormalMotion, Parameter, Real, Sphere, Stiffness};

/// Largest number of steps to find a strength that slows the rebound enough. Each step multiplies the strength by four.
const MOST_STEPS: u32 = 20;

/// Finds the material damping zeta_H with which a `scene` rebounds as measured, to a relative `tolerance`.
///
/// The damping of the scene itself is ignored. If the scene has no adhesion, the restitution of `rebound` is R.
///
/// # Errors
/// A value is outside its range, the rebound is faster than without damping, or the sphere was captured.
///
/// ```
/// use microimpact::measure::{MeasuredRebound, material_damping};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{RestitutionLaw, SpeedRestitution, Sphere, Stiffness};
///
/// // At 13 m/s, adhesion is almost negligible. R of silver-coated glass on steel gives the value of the paper, 10.45.
/// let restitution = SpeedRestitution::new(130.0)?.restitution(13.0);
/// let scene = Contact::hertz(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let zeta = material_damping(&scene, &method, &MeasuredRebound { speed: 13.0, restitution }, 1e-9)?;
/// assert!((zeta - 10.5).abs() < 0.1);
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
pub fn material_damping<T, D, A, X, S>(
    scene: &Contact<T, HertzLaw<T, D, A, X>, S>,
    method: &impl Method<T>,
    rebound: &MeasuredRebound<T>,
    tolerance: T,
) -> Result<T, CalibrationError>
where
    T: Real,
    D: Copy,
    A: Attraction<T>,
    X: Attraction<T>,
    S: Copy,
{
    strength(Parameter::MaterialDamping, method, rebound, tolerance, |zeta| scene.with_damping(zeta))
}

/// Finds the adhesion damping zeta_A with which a `scene` rebounds as measured, to a relative `tolerance`.
///
/// The scene must not have adhesion. The function adds a ring with the strength `f0` (N/m).
///
/// # Errors
/// A value is outside its range, the rebound is faster than without this damping, or the sphere was captured.
///
/// ```
/// use microimpact::measure::{MeasuredRebound, adhesion_damping};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Sphere, Stiffness};
///
/// // The mean sphere of the paper. Its value of 12.5 is 6.25 here, because the program of the paper halves this damping.
/// let scene = Contact::hertz(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let zeta = adhesion_damping(&scene, 250.0, &method, &MeasuredRebound { speed: 2.8, restitution: 0.62 }, 1e-9)?;
/// assert!((zeta - 6.25).abs() < 0.05);
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
pub fn adhesion_damping<T, D, X, S>(
    scene: &Contact<T, HertzLaw<T, D, NoAdhesion, X>, S>,
    f0: T,
    method: &impl Method<T>,
    rebound: &MeasuredRebound<T>,
    tolerance: T,
) -> Result<T, CalibrationError>
where
    T: Real,
    D: Damping<T>,
    X: Attraction<T>,
    S: Copy,
{
    strength(Parameter::AdhesionDamping, method, rebound, tolerance, |zeta| scene.with_ring(f0, zeta))
}

/// Computes the strength f0 of the adhesion ring (N/m) from the contact radius a (m) of particles that rest on the surface.
///
/// The equilibrium of B6 gives f0 = K r (a/r)^2/(2 pi).
///
/// # Errors
/// The contact radius is not between zero and the radius of the sphere, or the strength is outside its range.
///
/// ```
/// use microimpact::measure::ring_strength;
/// use microimpact::{Sphere, Stiffness};
///
/// // The paper reports contact radii of 5 % to 10 % of the radius.
/// let (sphere, stiffness) = (Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let strength = |fraction: f64| ring_strength(&sphere, stiffness, fraction * sphere.radius());
/// assert!((strength(0.05)? - 128.3).abs() < 0.05);
/// assert!((strength(0.10)? - 513.3).abs() < 0.05);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn ring_strength<T: Real>(sphere: &Sphere<T>, stiffness: Stiffness<T>, contact_radius: T) -> Result<T, InputError> {
    let ratio = Parameter::ContactRadiusRatio.check(contact_radius / sphere.radius())?;
    Parameter::AdhesionStrength.check(strength_at_rest(sphere, stiffness, ratio))
}

/// Finds any parameter with which a scene rebounds as measured, to a relative `tolerance`: for example the radius, or f0.
///
/// The function `scene` creates the scene from a value of the parameter. The value is sought in the `bracket`. The measured
/// restitution must be between the restitutions at both ends. If the restitution is not monotonic in the bracket, the function
/// finds one of the solutions.
///
/// # Errors
/// A value is outside its range, the measured restitution is not between those at the ends, or the sphere was captured.
///
/// ```
/// use microimpact::measure::{MeasuredRebound, parameter};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Sphere, Stiffness};
///
/// // The radius with which the scene rebounds as in Table 1.
/// let scene = |radius| {
///     Contact::hertz(Sphere::solid(radius, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)
/// };
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let radius = parameter((2e-6, 20e-6), scene, &method, &MeasuredRebound { speed: 2.8, restitution: 0.746 }, 1e-9)?;
/// assert!((radius - 5.06e-6).abs() < 0.005e-6);
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
pub fn parameter<T: Real, L: ContactLaw<T>, S>(
    bracket: (T, T),
    scene: impl Fn(T) -> Result<Contact<T, L, S>, InputError>,
    method: &impl Method<T>,
    rebound: &MeasuredRebound<T>,
    tolerance: T,
) -> Result<T, CalibrationError> {
    let search = Search::new(scene, method, rebound, tolerance)?;
    let (first, last) = (search.excess(bracket.0)?, search.excess(bracket.1)?);
    for (end, excess) in [(bracket.0, first), (bracket.1, last)] {
        if excess == T::ZERO {
            return Ok(end);
        }
    }
    if (first > T::ZERO) != (last > T::ZERO) {
        return search.between((bracket.0, first), (bracket.1, last));
    }
    Err(if first > T::ZERO { CalibrationError::ReboundTooSlow } else { CalibrationError::ReboundTooFast })
}

/// Gives a parameter that was found from a rebound its standard error.
///
/// `restitution` is the restitution of the scene with this parameter, computed with [`Dual`] numbers. The parameter is their
/// first input. The first of the `errors` is the standard error of the measured restitution. The standard errors of the other
/// inputs follow in the order of the inputs.
///
/// # Errors
/// A standard error is outside its range, or the restitution does not depend on the parameter.
///
/// ```
/// use microimpact::measure::{MeasuredRebound, adhesion_damping, estimate};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Dual, NormalMotion, Sphere, Stiffness};
///
/// // zeta_A of Table 1. The errors of e, the speed and the radius are 1 %.
/// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let zeta = adhesion_damping(&scene, 250.0, &method, &MeasuredRebound { speed: 2.8, restitution: 0.746 }, 1e-9)?;
///
/// let [zeta_a, speed, radius] = Dual::variables([zeta, 2.8, 5.06e-6]);
/// let fixed = Dual::<f64, 3>::fixed;
/// let scene = Contact::hertz(Sphere::solid(radius, fixed(2600.0))?, Stiffness::new(fixed(7.5e10))?)
///     .with_damping(fixed(10.5))?
///     .with_ring(fixed(250.0), zeta_a)?;
/// let method = Collocation::<9, Dual<f64, 3>>::new(fixed(1e-9))?;
/// let restitution = scene.solve_normal(&NormalMotion::new(speed)?, &method)?.overall_restitution();
/// let found = estimate(zeta, restitution, &[0.0075, 0.028, 0.05e-6])?;
/// assert!((found.value - 6.25).abs() < found.standard_error);
/// assert!((1.0..1.2).contains(&found.standard_error)); // one significant digit of zeta_A
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
pub fn estimate<T: Real, const N: usize>(
    parameter: T,
    restitution: Dual<T, N>,
    errors: &[T; N],
) -> Result<Estimate<T>, CalibrationError> {
    let mut squares = T::ZERO;
    for (index, (partial, error)) in restitution.partials.iter().zip(errors).enumerate() {
        let error = Parameter::StandardError.check(*error)?;
        // By the implicit function theorem, e(p, x) = e gives de/dp dp = de - sum of de/dx dx.
        let part = if index == 0 { error } else { *partial * error };
        squares = squares + part * part;
    }
    let slope = restitution.partials.first().map_or(T::ZERO, |partial| partial.abs());
    if slope == T::ZERO {
        return Err(CalibrationError::Undetermined);
    }
    let standard_error = squares.sqrt().saturating_div(slope);
    Ok(Estimate { value: parameter, standard_error })
}

/// Search for a value with which a scene rebounds as measured.
struct Search<'a, T, C, M> {
    /// Creates the scene from a value.
    scene: C,
    method: &'a M,
    motion: NormalMotion<T>,
    /// The square of the measured restitution.
    measured: T,
    tolerance: T,
}

impl<'a, T, L, S, C, M> Search<'a, T, C, M>
where
    T: Real,
    L: ContactLaw<T>,
    C: Fn(T) -> Result<Contact<T, L, S>, InputError>,
    M: Method<T>,
{
    fn new(scene: C, method: &'a M, rebound: &MeasuredRebound<T>, tolerance: T) -> Result<Self, CalibrationError> {
        let tolerance = Parameter::Tolerance.check(tolerance)?;
        let (motion, measured) = rebound.checked()?;
        if measured > T::ZERO {
            Ok(Self { scene, method, motion, measured, tolerance })
        } else {
            Err(CalibrationError::Captured)
        }
    }

    /// Difference between e^2 of the scene with a value and the measured e^2. Close to capture, e^2 is smooth but e is not.
    fn excess(&self, value: T) -> Result<T, CalibrationError> {
        let contact = (self.scene)(value)?.solve_normal(&self.motion, self.method)?;
        if contact.status() != Status::Solved {
            return Err(CalibrationError::NotConverged);
        }
        let restitution = contact.overall_restitution();
        Ok(restitution * restitution - self.measured)
    }

    /// Finds the value between two values whose excesses, given with them, have different signs.
    fn between(&self, first: (T, T), last: (T, T)) -> Result<T, CalibrationError> {
        root(first, last, self.tolerance, |value| self.excess(value))
    }
}

/// Finds the strength of a loss. The restitution decreases with the strength.
fn strength<T: Real, L: ContactLaw<T>, S>(
    limits: Parameter,
    method: &impl Method<T>,
    rebound: &MeasuredRebound<T>,
    tolerance: T,
    scene: impl Fn(T) -> Result<Contact<T, L, S>, InputError>,
) -> Result<T, CalibrationError> {
    let search = Search::new(scene, method, rebound, tolerance)?;
    let mut weaker = (T::ZERO, search.excess(T::ZERO)?);
    if weaker.1 <= T::ZERO {
        // Without the loss, the scene may miss a lossless rebound by the error of the method.
        let lossless = weaker.1.abs() <= search.tolerance.max(T::constant(32.0) * T::EPSILON);
        return if lossless { Ok(T::ZERO) } else { Err(CalibrationError::ReboundTooFast) };
    }
    let strongest = T::constant(limits.range().1);
    let mut value = T::constant(1e-2);
    for _ in 0..MOST_STEPS {
        let excess = match search.excess(value) {
            // Beyond what the method solves: a smaller step may do.
            Err(CalibrationError::NotConverged) if weaker.0 > T::ZERO => {
                value = (weaker.0 * value).sqrt();
                continue;
            }
            excess => excess?,
        };
        let stronger = (value, excess);
        if stronger.1 <= T::ZERO {
            return search.between(weaker, stronger);
        }
        weaker = stronger;
        value = (value * T::constant(4.0)).min(strongest);
    }
    Err(CalibrationError::ReboundTooSlow)
}
