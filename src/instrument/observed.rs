//! An impact of which both legs are measured, compared with the prediction of a model.

use crate::measure::{Estimate, NormalDistribution};
use crate::numbers::norm;
use crate::rigid::Departure;
use crate::{InputError, NormalMotion, Parameter, PlanarMotion, Real};

/// Velocities of a particle before and after an impact, with independent standard errors, m/s.
///
/// A [rigid body](crate::rigid::infer) gives the energies and the class of such an impact.
///
/// ```
/// use microimpact::instrument::{ObservedRebound, Scatter};
/// use microimpact::measure::Estimate;
/// use microimpact::rigid::Departure;
/// use microimpact::{InputError, RigidBody, SpeedRestitution, Sphere};
///
/// let scene = RigidBody::new(Sphere::solid(5.06e-6, 2600.0)?, SpeedRestitution::new(130.0)?)
///     .with_work_of_adhesion(2.22e-12)?
///     .with_friction(0.1)?;
/// let velocity = |value| Estimate { value, standard_error: 0.02 };
/// let observed = ObservedRebound {
///     approach: velocity(2.8),
///     tangential: velocity(0.0),
///     peripheral: velocity(0.739),
///     rebound: velocity(2.09),
///     tangential_after: velocity(0.21),
/// };
/// let comparison = observed.compare(&Scatter { restitution: 0.0, impulse_ratio: 0.0 }, |before| {
///     let impact = scene.impact(before);
///     let (normal, tangential) = (impact.normal.rebound_speed(), impact.tangential.velocity());
///     Ok::<_, InputError>(Departure { normal, tangential })
/// })?;
/// assert!((comparison.restitution.measured.value - 0.746_f64).abs() < 0.001);
/// assert!((comparison.impulse_ratio.measured.value - 0.043).abs() < 0.001);
/// // The impact of the paper's Table 1 agrees with its model.
/// assert!(comparison.restitution.probability().is_some_and(|probability| probability > 0.5));
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ObservedRebound<T> {
    /// Approach speed -v_n.
    pub approach: Estimate<T>,
    /// Tangential velocity v_t before the impact.
    pub tangential: Estimate<T>,
    /// Peripheral velocity r w before the impact.
    pub peripheral: Estimate<T>,
    /// Rebound speed V_n.
    pub rebound: Estimate<T>,
    /// Tangential velocity V_t after the impact.
    pub tangential_after: Estimate<T>,
}

/// Standard deviations of e and mu from impact to impact that are not errors of the velocities: roughness, patches of other
/// adhesion, particles that are no perfect spheres. Zero if the model is exact.
///
/// ```
/// use microimpact::instrument::Scatter;
///
/// assert!(Scatter { restitution: 0.03, impulse_ratio: 0.02 }.restitution > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Scatter<T> {
    /// Standard deviation of the overall restitution e.
    pub restitution: T,
    /// Standard deviation of the impulse ratio mu.
    pub impulse_ratio: T,
}

/// An observed rebound compared with its prediction.
///
/// ```
/// use microimpact::instrument::{Agreement, Comparison};
/// use microimpact::measure::Estimate;
///
/// let exact = Agreement { measured: Estimate { value: 0.7, standard_error: 0.01 }, predicted: 0.7, error: 0.01 };
/// let comparison = Comparison { restitution: exact, impulse_ratio: exact };
/// assert_eq!(comparison.restitution.residual(), Some(0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Comparison<T> {
    /// Overall restitution e = -V_n/v_n.
    pub restitution: Agreement<T>,
    /// Impulse ratio mu = P_t/P_n = (V_t - v_t)/(V_n - v_n).
    pub impulse_ratio: Agreement<T>,
}

/// A measured quantity, its prediction, and how well both agree.
///
/// ```
/// use microimpact::instrument::Agreement;
/// use microimpact::measure::Estimate;
///
/// let measured = Estimate { value: 0.74, standard_error: 0.01 };
/// let agreement = Agreement { measured, predicted: 0.70, error: 0.02 };
/// assert!(agreement.residual().is_some_and(|residual| (residual - 2.0_f64).abs() < 1e-9));
/// assert!(agreement.probability().is_some_and(|probability| (probability - 0.0455).abs() < 1e-4));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Agreement<T> {
    /// The measured value and its standard error.
    pub measured: Estimate<T>,
    /// The predicted value.
    pub predicted: T,
    /// Standard error of the difference. It contains the errors of the inputs of the prediction, and the scatter.
    pub error: T,
}

impl<T: Real> Agreement<T> {
    /// Standardised residual: measured less predicted value, divided by the standard error of the difference. `None` if all errors
    /// are zero.
    ///
    /// ```
    /// use microimpact::instrument::Agreement;
    /// use microimpact::measure::Estimate;
    ///
    /// let measured = Estimate { value: 0.7, standard_error: 0.0 };
    /// assert_eq!(Agreement { measured, predicted: 0.7, error: 0.0 }.residual(), None);
    /// ```
    pub fn residual(&self) -> Option<T> {
        (self.error > T::ZERO).then(|| (self.measured.value - self.predicted).saturating_div(self.error))
    }

    /// Probability of a residual that is at least as large, of either sign, if the model and the errors are right.
    ///
    /// ```
    /// use microimpact::instrument::Agreement;
    /// use microimpact::measure::Estimate;
    ///
    /// let measured = Estimate { value: 0.7, standard_error: 0.01 };
    /// assert_eq!(Agreement { measured, predicted: 0.7, error: 0.01 }.probability(), Some(1.0));
    /// ```
    pub fn probability(&self) -> Option<T>
    where
        T: NormalDistribution,
    {
        self.residual().map(|residual| T::constant(2.0) * (-residual.abs()).below())
    }
}

impl<T: Real> ObservedRebound<T> {
    /// Compares e and mu with the velocities after the impact that `predict` returns for a motion before it.
    ///
    /// Errors are propagated to first order: by the differences over one standard error to both sides of each velocity. An error of
    /// the approach speed changes the measured and the predicted value together, so that it counts once. `predict` is called seven
    /// times.
    ///
    /// # Errors
    /// A velocity or an error is outside its range, the error of the approach speed exceeds a fifth of the speed, or `predict`
    /// fails.
    ///
    /// ```
    /// use microimpact::instrument::{ObservedRebound, Scatter};
    /// use microimpact::measure::Estimate;
    /// use microimpact::rigid::Departure;
    /// use microimpact::{Approach, InputError, Parameter};
    ///
    /// let [still, fast] = [0.0, 2.0].map(|value| Estimate { value, standard_error: 0.1 });
    /// let observed =
    ///     ObservedRebound { approach: fast, tangential: still, peripheral: still, rebound: fast, tangential_after: still };
    /// let exact = Scatter { restitution: 0.0, impulse_ratio: 0.0 };
    /// let comparison = observed.compare(&exact, |before| {
    ///     Ok::<_, InputError>(Departure { normal: before.normal().speed(), tangential: 0.0 })
    /// })?;
    /// // The error of e is sqrt(2) 0.1/2. That of the difference is the same, as the predicted e is always one.
    /// assert!((comparison.restitution.error - 0.0707_f64).abs() < 1e-4);
    /// # Ok::<(), InputError>(())
    /// ```
    pub fn compare<E: From<InputError>>(
        &self,
        scatter: &Scatter<T>,
        predict: impl Fn(&PlanarMotion<T>) -> Result<Departure<T>, E>,
    ) -> Result<Comparison<T>, E> {
        let values = [self.approach.value, self.tangential.value, self.peripheral.value];
        let [v_error, t_error, u_error, rebound_error, after_error] =
            [self.approach, self.tangential, self.peripheral, self.rebound, self.tangential_after]
                .map(|velocity| Parameter::StandardError.check(velocity.standard_error));
        let (v_error, t_error, u_error, rebound_error, after_error) =
            (v_error?, t_error?, u_error?, rebound_error?, after_error?);
        let rebound = Parameter::ReboundSpeed.check(self.rebound.value)?;
        let after = Parameter::TangentialVelocity.check(self.tangential_after.value)?;
        let predicted = |[approach, tangential, peripheral]: [T; 3]| {
            let before =
                NormalMotion::new(approach)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
            Ok::<_, E>(ratios(approach, tangential, &predict(&before)?))
        };
        let [v, t, u] = values;
        let [e_predicted, mu_predicted] = predicted(values)?;
        Parameter::RelativeError.check(v_error / v)?;
        // Changes of the prediction over one standard error of each velocity.
        let half_of_difference = |[e_above, mu_above]: [T; 2], [e_below, mu_below]: [T; 2]| {
            [T::constant(0.5) * (e_above - e_below), T::constant(0.5) * (mu_above - mu_below)]
        };
        let [e_by_v, mu_by_v] = half_of_difference(predicted([v + v_error, t, u])?, predicted([v - v_error, t, u])?);
        let [e_by_t, mu_by_t] = half_of_difference(predicted([v, t + t_error, u])?, predicted([v, t - t_error, u])?);
        let [e_by_u, mu_by_u] = half_of_difference(predicted([v, t, u + u_error])?, predicted([v, t, u - u_error])?);

        // Changes of e = V/v and of mu = (V_t - v_t)/(V + v) over the same errors, and over those of the second leg.
        let [e, mu] = ratios(v, t, &Departure { normal: rebound, tangential: after });
        let impulse = rebound + v;
        let (e_own, e_by_rebound) = (-e * v_error / v, rebound_error / v);
        let (mu_by_approach, mu_by_rebound) = (-mu * v_error / impulse, -mu * rebound_error / impulse);
        let (mu_by_tangential, mu_by_after) = (-t_error / impulse, after_error / impulse);
        let restitution = Agreement {
            measured: Estimate { value: e, standard_error: norm([e_own, e_by_rebound]) },
            predicted: e_predicted,
            error: norm([
                e_own - e_by_v,
                e_by_t,
                e_by_u,
                e_by_rebound,
                Parameter::StandardError.check(scatter.restitution)?,
            ]),
        };
        let impulse_ratio = Agreement {
            measured: Estimate {
                value: mu,
                standard_error: norm([mu_by_approach, mu_by_tangential, mu_by_rebound, mu_by_after]),
            },
            predicted: mu_predicted,
            error: norm([
                mu_by_approach - mu_by_v,
                mu_by_tangential - mu_by_t,
                mu_by_u,
                mu_by_rebound,
                mu_by_after,
                Parameter::StandardError.check(scatter.impulse_ratio)?,
            ]),
        };
        Ok(Comparison { restitution, impulse_ratio })
    }
}

/// Overall restitution and impulse ratio of velocities before and after an impact.
fn ratios<T: Real>(approach: T, tangential: T, after: &Departure<T>) -> [T; 2] {
    [after.normal / approach, (after.tangential - tangential) / (after.normal + approach)]
}
