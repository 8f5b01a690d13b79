//! Fit of the restitution law R = k/(k + v) and the work of adhesion W_A to many impacts.
//!
//! The model is e^2 = R^2 - 2 W_A/(m v^2) (A34). Both speeds have standard errors, e has a natural scatter, spheres may differ in size,
//! and captures are observations. The fit starts with the curve through two rebounds that has the smallest median deviation of e, since
//! up to half of the rebounds may be outliers (Rousseeuw 1984). It is then refined with bounded influence (Huber 1964), and the intervals
//! follow from the scatter of the rows themselves (Huber 1967).

mod curve;
mod estimate;
mod rows;
mod symmetric;

use self::estimate::{Cloud, Fitted, PARAMETERS};
use super::robust::number;
use super::{CalibrationError, Estimate, NormalDistribution};
use crate::{InputError, NormalMotion, Parameter, Real, Sphere};

/// A measured impact of one of many spheres of the same material.
///
/// ```
/// use microimpact::Sphere;
/// use microimpact::measure::{Estimate, MeasuredImpact};
///
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let speed = |value| Estimate { value, standard_error: 0.03 };
/// let rebound = MeasuredImpact { sphere, approach: speed(2.8), rebound: Some(speed(2.09)) };
/// let capture = MeasuredImpact { sphere, approach: speed(1.2), rebound: None };
/// assert!(rebound.rebound.is_some() && capture.rebound.is_none());
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeasuredImpact<T> {
    /// The sphere.
    pub sphere: Sphere<T>,
    /// Approach speed -v_n, m/s, with its standard error; zero if the error is not known.
    pub approach: Estimate<T>,
    /// Rebound speed, m/s, which errors may make negative; `None` for a capture.
    pub rebound: Option<Estimate<T>>,
}

/// A value with its interval of 95 %.
///
/// ```
/// use microimpact::measure::Interval;
///
/// let speed = Interval { value: 1.8, low: 1.7, high: 1.9 };
/// assert!(speed.holds(1.75) && !speed.holds(2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval<T> {
    /// The value.
    pub value: T,
    /// Lower end.
    pub low: T,
    /// Upper end.
    pub high: T,
}

impl<T: Real> Interval<T> {
    /// Whether a value is in the interval.
    ///
    /// ```
    /// use microimpact::measure::Interval;
    ///
    /// assert!(Interval { value: 130.0, low: 120.0, high: 142.0 }.holds(125.0));
    /// ```
    pub fn holds(&self, value: T) -> bool {
        self.low <= value && value <= self.high
    }

    fn of([value, low, high]: [T; 3]) -> Self {
        Self { value, low, high }
    }
}

/// Restitution law and work of adhesion, fitted to many impacts.
///
/// ```
/// use microimpact::measure::{Estimate, MeasuredImpact, RestitutionFit};
/// use microimpact::{NormalMotion, RigidBody, SpeedRestitution, Sphere};
///
/// // Rebounds that follow the law of the paper, except for two outliers.
/// let sphere = Sphere::solid(5.06e-6, 2600.0)?;
/// let scene = RigidBody::new(sphere, SpeedRestitution::new(130.0)?).with_work_of_adhesion(2.22e-12)?;
/// let measured = |value| Estimate { value, standard_error: 0.0 };
/// let blank = MeasuredImpact { sphere, approach: measured(1.0), rebound: None };
/// let mut impacts = [blank; 20];
/// for (impact, speed) in impacts.iter_mut().zip(2..) {
///     let speed = f64::from(speed);
///     impact.approach = measured(speed);
///     impact.rebound = Some(measured(scene.impact(&NormalMotion::new(speed)?).normal.rebound_speed()));
/// }
/// impacts[3].rebound = Some(measured(1.0));
/// impacts[12].rebound = Some(measured(14.0));
///
/// let fit = RestitutionFit::of(&impacts)?;
/// assert!(fit.fits && fit.outliers == 2);
/// assert!((fit.restitution_speed.value - 130.0).abs() < 0.01);
/// assert!((fit.work_of_adhesion.value - 2.22e-12).abs() < 1e-16);
/// assert!((fit.critical_speed.unwrap().value - 1.8).abs() < 0.03);
/// # Ok::<(), microimpact::measure::CalibrationError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RestitutionFit<T> {
    /// Whether the law fits: the impacts show no trend over speed that it does not have (p < 0.001), and few contradict the critical
    /// speed.
    pub fits: bool,
    /// Speed k of the restitution law, m/s. Its upper end is the largest speed of its range if the impacts show no loss.
    pub restitution_speed: Interval<T>,
    /// Work of adhesion W_A, J.
    pub work_of_adhesion: Interval<T>,
    /// Critical speed of the sphere of median mass, m/s; `None` if the law does not fit.
    pub critical_speed: Option<Interval<T>>,
    /// Median mass, kg.
    pub mass: T,
    /// Natural scatter of e: its standard deviation without the errors of the speeds.
    pub scatter: T,
    /// Number of rebounds.
    pub rebounds: u32,
    /// Number of captures.
    pub captures: u32,
    /// Number of rebounds so far from the curve that they have no weight.
    pub outliers: u32,
}

/// Fewest rebounds: fewer leave the intervals without meaning.
const LEAST_REBOUNDS: u32 = 12;

/// 97.5 % of a normal distribution are below this number of standard deviations.
const NORMAL: f64 = 1.959_963_984_540_054;

impl<T: Real + NormalDistribution> RestitutionFit<T> {
    /// Fits the law to measured `impacts`. From 30 rebounds on, the intervals hold the truth in 93 to 97 of 100 sets; in 90 if a tenth
    /// of the rebounds are outliers, or if the scatter is as skewed as that of glass beads on acrylic (`cargo coverage` measures this).
    ///
    /// # Errors
    /// A number is outside its range, there are fewer than twelve rebounds, or the impacts do not determine both parameters.
    ///
    /// ```
    /// use microimpact::Sphere;
    /// use microimpact::measure::{CalibrationError, Estimate, MeasuredImpact, RestitutionFit};
    ///
    /// let sphere = Sphere::solid(5e-6_f32, 2600.0)?;
    /// let speed = |value| Estimate { value, standard_error: 0.01_f32 };
    /// let alike = [MeasuredImpact { sphere, approach: speed(2.0), rebound: Some(speed(1.4)) }; 15];
    /// assert_eq!(RestitutionFit::of(&alike), Err(CalibrationError::Undetermined));
    /// assert_eq!(RestitutionFit::of(&alike[..9]), Err(CalibrationError::TooFew));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn of(impacts: &[MeasuredImpact<T>]) -> Result<Self, CalibrationError> {
        let mut cloud = Cloud { impacts, fastest: T::ZERO, mass: T::ONE, rebounds: 0, captures: 0 };
        for impact in impacts {
            let fastest = impact.checked()?;
            cloud.fastest = cloud.fastest.max(fastest);
            if impact.rebound.is_some() {
                cloud.rebounds += 1;
            } else {
                cloud.captures += 1;
            }
        }
        if cloud.rebounds < LEAST_REBOUNDS {
            return Err(CalibrationError::TooFew);
        }
        cloud.mass = median_mass(impacts).ok_or(CalibrationError::TooFew)?;
        let Fitted { curve, scatter, covariance, outliers, fits } = cloud.fit()?;
        let reach = multiple::<T>(cloud.rebounds + cloud.captures);
        let around =
            |value: T, variance: T| [T::ZERO, -reach, reach].map(|reach| value + reach * variance.max(T::ZERO).sqrt());
        let largest = T::constant(Parameter::RestitutionSpeed.range().1);
        // k falls where c rises.
        let [loss, less, more] = around(curve.loss, covariance.first);
        let speeds =
            [loss, more, less].map(|loss| if loss * largest > cloud.fastest { cloud.fastest / loss } else { largest });
        let energy = T::constant(0.5) * cloud.mass * cloud.fastest * cloud.fastest;
        let work = around(curve.pull, covariance.second).map(|pull| energy * pull.max(T::ZERO));
        let critical = curve.critical_square().filter(|_| fits).map(|(square, slopes)| {
            Interval::of(
                around(square, covariance.form(slopes)).map(|square| cloud.fastest * square.max(T::ZERO).sqrt()),
            )
        });
        Ok(Self {
            fits,
            restitution_speed: Interval::of(speeds),
            work_of_adhesion: Interval::of(work),
            critical_speed: critical,
            mass: cloud.mass,
            scatter,
            rebounds: cloud.rebounds,
            captures: cloud.captures,
            outliers,
        })
    }
}

/// Mass of a sphere that half of the others are lighter than, kg.
fn median_mass<T: Real>(impacts: &[MeasuredImpact<T>]) -> Option<T> {
    let masses = || impacts.iter().map(|impact| impact.sphere.mass());
    let half = impacts.len() / 2;
    masses().find(|mass| {
        let lighter = masses().filter(|other| other < mass).count();
        let equal = masses().filter(|other| other == mass).count();
        (lighter..lighter + equal).contains(&half)
    })
}

/// Half the width of an interval in standard errors, from Student's distribution by its expansion about the normal one (Fisher 1925).
fn multiple<T: Real>(rows: u32) -> T {
    let freedom = T::ONE / number(rows - PARAMETERS);
    let square = NORMAL * NORMAL;
    let first = 0.25 * NORMAL * (square + 1.0);
    let second = NORMAL * ((5.0 * square + 16.0) * square + 3.0) / 96.0;
    T::constant(NORMAL) + freedom * (T::constant(first) + freedom * T::constant(second))
}

impl<T: Real> MeasuredImpact<T> {
    /// The approach speed, if all numbers are in their ranges.
    fn checked(&self) -> Result<T, InputError> {
        let motion = NormalMotion::new(self.approach.value)?;
        Parameter::StandardError.check(self.approach.standard_error)?;
        if let Some(rebound) = &self.rebound {
            Parameter::ReboundSpeed.check(rebound.value.abs())?;
            Parameter::StandardError.check(rebound.standard_error)?;
        }
        Ok(motion.speed())
    }
}
