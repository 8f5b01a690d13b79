//! Parameters of a simulated contact from one measured impact.

use core::f64::consts::PI;

use super::root::root;
use super::{CalibrationError, Estimate, Rebound};
use crate::contact::{Attraction, Contact, ContactLaw, Damping, HertzLaw, Method, Status};
use crate::{Dual, InputError, NoAdhesion, NormalMotion, Parameter, Real, Sphere, Stiffness};

/// Steps, each four times the one before, in which a strength is sought that slows the rebound enough.
const MOST_STEPS: u32 = 20;

/// Strength zeta_H of the damping in the materials with which a `scene` rebounds as measured, to a relative `tolerance`;
/// the scene's own damping does not count.
///
/// A scene without adhesion takes R for the restitution of `rebound`.
///
/// # Errors
/// A value outside its range, a rebound faster than without damping, or a capture.
///
/// ```
/// use microimpact::calibrate::{Rebound, material_damping};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{RestitutionLaw, SpeedRestitution, Sphere, Stiffness};
///
/// // R of silver-coated glass on steel at 13 m/s, where adhesion hardly counts, gives the paper's 10.45.
/// let restitution = SpeedRestitution::new(130.0)?.restitution(13.0);
/// let scene = Contact::hertz(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let zeta = material_damping(&scene, &method, &Rebound { speed: 13.0, restitution }, 1e-9)?;
/// assert!((zeta - 10.5).abs() < 0.1);
/// # Ok::<(), microimpact::calibrate::CalibrationError>(())
/// ```
pub fn material_damping<T, D, A, X, S>(
    scene: &Contact<T, HertzLaw<T, D, A, X>, S>,
    method: &impl Method<T>,
    rebound: &Rebound<T>,
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

/// Strength zeta_A of the damping of a ring of strength `f0` (N/m) with which a `scene`, given without adhesion,
/// rebounds as measured, to a relative `tolerance`.
///
/// # Errors
/// A value outside its range, a rebound faster than without this damping, or a capture.
///
/// ```
/// use microimpact::calibrate::{Rebound, adhesion_damping};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Sphere, Stiffness};
///
/// // The paper's mean sphere; its program halves this damping, so that its 12.5 is 6.25 here.
/// let scene = Contact::hertz(Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let zeta = adhesion_damping(&scene, 250.0, &method, &Rebound { speed: 2.8, restitution: 0.62 }, 1e-9)?;
/// assert!((zeta - 6.25).abs() < 0.05);
/// # Ok::<(), microimpact::calibrate::CalibrationError>(())
/// ```
pub fn adhesion_damping<T, D, X, S>(
    scene: &Contact<T, HertzLaw<T, D, NoAdhesion, X>, S>,
    f0: T,
    method: &impl Method<T>,
    rebound: &Rebound<T>,
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

/// Strength f0 of the adhesion ring, N/m, from the contact radius a (m) of particles that rest on the surface:
/// the equilibrium of B6, f0 = K r (a/r)^2/(2 pi).
///
/// # Errors
/// A contact radius that is not between zero and that of the sphere, or a strength outside its range.
///
/// ```
/// use microimpact::calibrate::ring_strength;
/// use microimpact::{Sphere, Stiffness};
///
/// // The paper sees contacts of some 5 % to 10 % of the radius.
/// let (sphere, stiffness) = (Sphere::solid(4.3e-6, 2600.0)?, Stiffness::new(7.5e10)?);
/// let strength = |share: f64| ring_strength(&sphere, stiffness, share * sphere.radius());
/// assert!((strength(0.05)? - 128.3).abs() < 0.05);
/// assert!((strength(0.10)? - 513.3).abs() < 0.05);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn ring_strength<T: Real>(sphere: &Sphere<T>, stiffness: Stiffness<T>, contact_radius: T) -> Result<T, InputError> {
    let share = Parameter::ContactRadiusRatio.check(contact_radius / sphere.radius())?;
    let strength = stiffness.pascals() * sphere.radius() * T::constant(0.5 / PI) * share * share;
    Parameter::AdhesionStrength.check(strength)
}

/// The value, between those of `bracket`, of any parameter of a scene with which it rebounds as measured, to a relative
/// `tolerance`: of the radius, say, or of f0. `scene` makes the scene of a value.
///
/// Where the restitution is not monotonic between them this finds one of its roots; both ends have to lie on different
/// sides of the measured restitution.
///
/// # Errors
/// A value outside its range, a restitution that is not between those at the ends, or a capture.
///
/// ```
/// use microimpact::calibrate::{Rebound, parameter};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Sphere, Stiffness};
///
/// // The radius that explains the rebound of Table 1.
/// let scene = |radius| {
///     Contact::hertz(Sphere::solid(radius, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)
/// };
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let radius = parameter((2e-6, 20e-6), scene, &method, &Rebound { speed: 2.8, restitution: 0.746 }, 1e-9)?;
/// assert!((radius - 5.06e-6).abs() < 0.005e-6);
/// # Ok::<(), microimpact::calibrate::CalibrationError>(())
/// ```
pub fn parameter<T: Real, L: ContactLaw<T>, S>(
    bracket: (T, T),
    scene: impl Fn(T) -> Result<Contact<T, L, S>, InputError>,
    method: &impl Method<T>,
    rebound: &Rebound<T>,
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

/// A parameter that was found from a rebound, with its standard error: by how much the errors of all that was measured move it.
///
/// `restitution` is that of the scene with this parameter, which is the first of the inputs of the [`Dual`] numbers. In
/// `errors` the standard error of the measured restitution comes first, and those of the other inputs follow in their order.
///
/// # Errors
/// A standard error outside its range, or a restitution that does not depend on the parameter.
///
/// ```
/// use microimpact::calibrate::{Rebound, adhesion_damping, estimate};
/// use microimpact::contact::{Collocation, Contact};
/// use microimpact::{Dual, NormalMotion, Sphere, Stiffness};
///
/// // zeta_A of Table 1, where e, the speed and the radius have errors of 1 %.
/// let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?).with_damping(10.5)?;
/// let method = Collocation::<9, f64>::new(1e-9)?;
/// let zeta = adhesion_damping(&scene, 250.0, &method, &Rebound { speed: 2.8, restitution: 0.746 }, 1e-9)?;
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
/// assert!((1.0..1.2).contains(&found.standard_error)); // one digit of zeta_A
/// # Ok::<(), microimpact::calibrate::CalibrationError>(())
/// ```
pub fn estimate<T: Real, const N: usize>(
    parameter: T,
    restitution: Dual<T, N>,
    errors: &[T; N],
) -> Result<Estimate<T>, CalibrationError> {
    let mut squares = T::ZERO;
    for (index, (partial, error)) in restitution.partials.iter().zip(errors).enumerate() {
        let error = Parameter::StandardError.check(*error)?;
        // The theorem of implicit functions: e(p, x) - e = 0, so that dp de/dp = d(e) - sum of dx de/dx.
        let share = if index == 0 { error } else { *partial * error };
        squares = squares + share * share;
    }
    let slope = restitution.partials.first().map_or(T::ZERO, |partial| partial.abs());
    if slope == T::ZERO {
        return Err(CalibrationError::Undetermined);
    }
    let standard_error = squares.sqrt().saturating_div(slope);
    Ok(Estimate { value: parameter, standard_error })
}

/// The search for a value with which a scene rebounds as measured.
struct Search<'a, T, C, M> {
    /// Makes the scene of a value.
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
    fn new(scene: C, method: &'a M, rebound: &Rebound<T>, tolerance: T) -> Result<Self, CalibrationError> {
        let tolerance = Parameter::Tolerance.check(tolerance)?;
        let (motion, measured) = rebound.checked()?;
        if measured > T::ZERO {
            Ok(Self { scene, method, motion, measured, tolerance })
        } else {
            Err(CalibrationError::Captured)
        }
    }

    /// How far e^2 of a value's scene, which is smooth down to capture where e is not, lies above the measured one.
    fn excess(&self, value: T) -> Result<T, CalibrationError> {
        let contact = (self.scene)(value)?.solve_normal(&self.motion, self.method)?;
        if contact.status() != Status::Solved {
            return Err(CalibrationError::BudgetSpent);
        }
        let restitution = contact.overall_restitution();
        Ok(restitution * restitution - self.measured)
    }

    /// The value between two at which the excess, given with each, differs in sign.
    fn between(&self, first: (T, T), last: (T, T)) -> Result<T, CalibrationError> {
        root(first, last, self.tolerance, |value| self.excess(value))
    }
}

/// The strength of a loss that grows from zero: the restitution falls with it.
fn strength<T: Real, L: ContactLaw<T>, S>(
    limits: Parameter,
    method: &impl Method<T>,
    rebound: &Rebound<T>,
    tolerance: T,
    scene: impl Fn(T) -> Result<Contact<T, L, S>, InputError>,
) -> Result<T, CalibrationError> {
    let search = Search::new(scene, method, rebound, tolerance)?;
    let mut weaker = (T::ZERO, search.excess(T::ZERO)?);
    if weaker.1 <= T::ZERO {
        // A rebound that loses nothing is met up to the error of the method.
        let lossless = weaker.1.abs() <= search.tolerance.max(T::constant(32.0) * T::EPSILON);
        return if lossless { Ok(T::ZERO) } else { Err(CalibrationError::ReboundTooFast) };
    }
    let strongest = T::constant(limits.range().1);
    let mut value = T::constant(1e-2);
    for _ in 0..MOST_STEPS {
        let stronger = (value, search.excess(value)?);
        if stronger.1 <= T::ZERO {
            return search.between(weaker, stronger);
        }
        weaker = stronger;
        value = (value * T::constant(4.0)).min(strongest);
    }
    Err(CalibrationError::ReboundTooSlow)
}
