//! Friction coefficient from sliding impacts, and spin from rolling impacts.

use super::{CalibrationError, Location};
use crate::rigid::{Departure, infer_assuming_rolling};
use crate::{
    Approach, ConstantRestitution, ImpactError, Oblique, ObliqueMotion, Parameter, PlanarMotion, Real, Sphere,
    TangentialImpact,
};

/// Impulse ratio of a measured impact, and the impulse ratio at which it would have rolled.
///
/// ```
/// use microimpact::measure::ImpulseRatios;
/// use microimpact::rigid::{Departure, infer};
/// use microimpact::{ConstantRestitution, NormalMotion, Sphere};
///
/// let sphere = Sphere::solid(5e-6, 2600.0)?;
/// let before = NormalMotion::new(2.0)?.with_tangential(4.0)?.with_spin(&sphere, 0.0)?;
/// let after = Departure { normal: 1.5, tangential: 3.5 };
/// let impact = infer(&sphere, &ConstantRestitution::new(0.9_f64)?, &before, &after, 0.01)?;
/// let ratios = ImpulseRatios::from(&impact.tangential);
/// assert!(ratios.measured.abs() < ratios.rolling.abs()); // it slides
/// # Ok::<(), microimpact::ImpactError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImpulseRatios<T> {
    /// Measured impulse ratio mu = P_t/P_n.
    pub measured: T,
    /// Impulse ratio mu_0 at which the sphere rolls at separation (A27).
    pub rolling: T,
}

impl<T: Real> From<&TangentialImpact<T>> for ImpulseRatios<T> {
    fn from(impact: &TangentialImpact<T>) -> Self {
        Self { measured: impact.impulse_ratio(), rolling: impact.rolling_ratio() }
    }
}

/// A sphere slides with certainty if |mu_0| exceeds the friction coefficient by this factor.
const CLEAR: f64 = 1.25;

/// Estimates Coulomb's friction coefficient f from the impacts that slide.
///
/// For sliding impacts, |mu| is constant and equal to f. An impact counts as sliding if |mu_0| clearly exceeds f. The estimate
/// of f decides about this, and not the measured mu: the errors of mu would select impacts with small mu.
///
/// # Errors
/// A ratio is outside its range, or fewer than three impacts slide.
///
/// ```
/// use microimpact::measure::{ImpulseRatios, friction};
///
/// // |mu| = min(f, |mu_0|) with f = 0.2, up to grazing incidence.
/// let impacts = [0.05, 0.1, 0.15, 0.3, 0.6, 0.9, 1.2, 1.5, 2.0].map(|rolling: f64| ImpulseRatios {
///     measured: -rolling.min(0.2),
///     rolling: -rolling,
/// });
/// let plateau = friction(&impacts)?;
/// assert!((plateau.estimate.value - 0.2).abs() < 1e-12);
/// assert_eq!(plateau.count, 6);
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
pub fn friction<T: Real>(impacts: &[ImpulseRatios<T>]) -> Result<Location<T>, CalibrationError> {
    for ratios in impacts {
        Parameter::ImpulseRatio.check(ratios.measured)?;
        Parameter::ImpulseRatio.check(ratios.rolling)?;
    }
    let clear = T::constant(CLEAR);
    let plateau = |slides: &dyn Fn(T, T) -> bool| {
        let sizes = impacts.iter().map(|ratios| (ratios.measured.abs(), ratios.rolling.abs()));
        Location::of(Parameter::Friction, sizes.filter(|(mu, rolling)| slides(*mu, *rolling)).map(|(mu, _)| mu))
    };
    let mut found = plateau(&|mu, rolling| clear * mu < rolling)?;
    for _ in 0..20 {
        let least = clear * found.estimate.value;
        let next = plateau(&|_, rolling| rolling > least)?;
        let converged = next.count == found.count && next.estimate == found.estimate;
        found = next;
        if converged {
            break;
        }
    }
    Ok(found)
}

/// Motion before an impact, with the spin that a measured `impulse_ratio` mu implies for a sphere that rolls at separation
/// (mu = mu_0, eq. 1).
///
/// [`Location::of`] the peripheral velocities of many impacts gives the mean spin and its standard error.
///
/// # Errors
/// A value is outside its range.
///
/// ```
/// use microimpact::measure::rolling_motion;
/// use microimpact::{NormalMotion, Oblique, Sphere};
///
/// // Figure 4 of the paper: at normal incidence, a ratio of 0.12 implies the spin r w = 1.54 m/s.
/// let sphere = Sphere::solid(25e-6, 7800.0)?;
/// let before = NormalMotion::new(2.3)?.with_tangential(0.0)?;
/// let motion = rolling_motion(&sphere, &before, 0.601, 0.12)?;
/// assert!((motion.peripheral() - 1.54_f64).abs() < 0.01);
/// # Ok::<(), microimpact::ImpactError>(())
/// ```
pub fn rolling_motion<T: Real>(
    sphere: &Sphere<T>,
    before: &ObliqueMotion<T>,
    restitution: T,
    impulse_ratio: T,
) -> Result<PlanarMotion<T>, ImpactError> {
    let restitution = Parameter::Restitution.check(restitution)?;
    let ratio = Parameter::ImpulseRatio.check(impulse_ratio)?;
    let approach = before.normal().speed();
    let tangential = before.tangential() + ratio * (T::ONE + restitution) * approach;
    let after = Departure { normal: restitution * approach, tangential };
    let impact = infer_assuming_rolling(sphere, &ConstantRestitution::new(T::ONE)?, before, &after)?;
    Ok(before.with_spin(sphere, impact.tangential.spin_before(sphere))?)
}
