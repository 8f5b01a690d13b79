//! Measured restitutions as a law.

use crate::{Fault, InputError, Parameter, Real, RestitutionLaw};

/// A restitution law through `N` points of your own.
///
/// Between two points the rebound speed R(v) v is a straight line. Below the first and above the last point R is constant.
///
/// ```
/// use microimpact::{RestitutionLaw, rigid::TabulatedRestitution};
///
/// // Speed in m/s, R.
/// let law = TabulatedRestitution::new([(1.0, 0.9), (2.0, 0.8), (5.0, 0.7)])?;
/// assert_eq!(law.restitution(0.1), 0.9);
/// assert!((law.restitution(1.5) * 1.5 - 1.25_f64).abs() < 1e-15);
/// assert!((law.approach_speed(1.25).unwrap() - 1.5).abs() < 1e-15);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(bound = "T: serde::Serialize + Copy"))]
pub struct TabulatedRestitution<T, const N: usize> {
    /// Approach and rebound speed of each point.
    #[cfg_attr(feature = "serde", serde(serialize_with = "in_one_row"))]
    points: [(T, T); N],
}

#[cfg(feature = "serde")]
fn in_one_row<T: serde::Serialize, S: serde::Serializer>(points: &[(T, T)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(points)
}

impl<T: Real, const N: usize> TabulatedRestitution<T, N> {
    /// Creates a law from points of approach speed (m/s) and R, in the order of rising speeds.
    ///
    /// # Errors
    /// A value is outside its range, a speed is not above the one before, or a rebound speed R v is below the one before.
    ///
    /// ```
    /// use microimpact::rigid::TabulatedRestitution;
    ///
    /// let error = TabulatedRestitution::new([(2.0, 0.8), (1.0, 0.9)]).unwrap_err();
    /// let message = "approach speed is 1 m/s, but must be above that of the point before; sort the points by speed";
    /// assert_eq!(error.to_string(), message);
    /// ```
    pub fn new(points: [(T, T); N]) -> Result<Self, InputError> {
        const { assert!(N > 0, "a table of restitutions needs a point") };
        let refuse =
            |parameter, value: T| Err(InputError { parameter, fault: Fault::OutOfOrder, value: value.to_f64() as f32 });
        let mut before = (T::ZERO, T::ZERO);
        let mut rebounds = points;
        for (speed, value) in &mut rebounds {
            Parameter::ApproachSpeed.check(*speed)?;
            let rebound = Parameter::Restitution.check(*value)? * *speed;
            if *speed <= before.0 {
                return refuse(Parameter::ApproachSpeed, *speed);
            }
            if rebound < before.1 {
                return refuse(Parameter::ReboundSpeed, rebound);
            }
            *value = rebound;
            before = (*speed, rebound);
        }
        Ok(Self { points: rebounds })
    }

    /// The coordinate `of` a point on the polygon through the origin and all points, the last where its coordinate `by` has a value;
    /// from the last point on along the line from the origin.
    fn interpolate(&self, value: T, by: impl Fn(&(T, T)) -> T, of: impl Fn(&(T, T)) -> T) -> T {
        let mut before = (T::ZERO, T::ZERO);
        for point in &self.points {
            if value < by(point) {
                let fraction = (value - by(&before)) / (by(point) - by(&before));
                return of(&before) + fraction * (of(point) - of(&before));
            }
            before = *point;
        }
        value * (of(&before).saturating_div(by(&before)))
    }
}

impl<T: Real, const N: usize> RestitutionLaw<T> for TabulatedRestitution<T, N> {
    fn restitution(&self, speed: T) -> T {
        match (self.points.first(), self.points.last()) {
            (Some(first), _) if speed <= first.0 => first.1 / first.0,
            (_, Some(last)) if speed >= last.0 => last.1 / last.0,
            _ => self.interpolate(speed, |point| point.0, |point| point.1) / speed,
        }
    }

    fn approach_speed(&self, body_rebound: T) -> Option<T> {
        let returns = self.points.last().is_some_and(|last| last.1 > T::ZERO);
        (returns || body_rebound <= T::ZERO).then(|| self.interpolate(body_rebound, |point| point.1, |point| point.0))
    }
}
