//! Tables as classifiers: the class without a simulation.

use super::{ClassSet, Classifier, Rejection, Verdict};
use crate::boundary::{self, BoundarySlice, BoundaryTable, Reading, RestitutionTable, Single};
use crate::{Approach, Coulomb, NoFriction, Oblique, Sphere, SurfaceMotion};

/// A table and the spheres that are classified by it: `B` is a [`BoundaryTable`], a [`BoundarySlice`] or a
/// [`RestitutionTable`], the latter with friction or without.
///
/// What a table does not tell is a class of its own: too close to call, and outside the table.
///
/// ```
/// use microimpact::boundary::{self, BoundaryTable};
/// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins, Tabulated};
/// use microimpact::{CriticalSpeed, NoFriction, Sphere};
///
/// // A critical speed that falls with the radius, 1 m/s at 1 um.
/// let table = BoundaryTable::<4>::new(1e-6_f32, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
/// let classifier = Tabulated { table, sphere: Sphere::solid(1.25e-6, 2600.0)?, friction: NoFriction };
/// let mut instrument: Instrument<_, _, _, 4, 1> = Instrument::new(classifier, NoLines, SpeedBins::new([10.0])?);
/// let mut class = |approach| instrument.process(&NormalReading { approach }).map(|verdict| verdict.class);
/// assert_eq!(class(0.9), Ok(boundary::Verdict::Rebound));
/// assert_eq!(class(0.7), Ok(boundary::Verdict::Capture));
/// assert_eq!(class(0.8), Ok(boundary::Verdict::TooCloseToCall));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Tabulated<B, T, F = NoFriction> {
    /// The table.
    pub table: B,
    /// The spheres.
    pub sphere: Sphere<T>,
    /// Their friction.
    pub friction: F,
}

/// What a restitution table with friction tells apart. How a captured sphere moves on is not in it.
///
/// ```
/// use microimpact::instrument::{ClassSet, TabulatedClass};
///
/// assert_eq!(TabulatedClass::Capture.index(), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TabulatedClass {
    /// Leaves the surface while its contact point slips.
    ReboundSliding,
    /// Leaves the surface rolling.
    ReboundRolling,
    /// The surface holds the sphere.
    Capture,
    /// The speed is closer to the critical one than the error of the table.
    TooCloseToCall,
    /// The table does not reach there.
    OutsideTable,
}

impl ClassSet for TabulatedClass {
    const COUNT: usize = Self::ALL.len();
    const ALL: &'static [Self] =
        &[Self::ReboundSliding, Self::ReboundRolling, Self::Capture, Self::TooCloseToCall, Self::OutsideTable];

    #[inline]
    fn index(self) -> usize {
        match self {
            Self::ReboundSliding => 0,
            Self::ReboundRolling => 1,
            Self::Capture => 2,
            Self::TooCloseToCall => 3,
            Self::OutsideTable => 4,
        }
    }
}

impl<T: Single, M: Approach<T>> Classifier<T, M> for Tabulated<BoundarySlice<'_>, T> {
    type Class = boundary::Verdict;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, boundary::Verdict>, Rejection> {
        Ok(Verdict { class: self.table.classify(self.sphere.radius(), motion), restitution: None })
    }
}

impl<T: Single, M: Approach<T>, const N: usize> Classifier<T, M> for Tabulated<BoundaryTable<N>, T> {
    type Class = boundary::Verdict;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, boundary::Verdict>, Rejection> {
        Ok(Verdict { class: self.table.classify(self.sphere.radius(), motion), restitution: None })
    }
}

impl<T, M, const N: usize, const R: usize, const S: usize> Classifier<T, M>
    for Tabulated<RestitutionTable<T, N, R, S>, T>
where
    T: Single,
    M: Approach<T>,
{
    type Class = boundary::Verdict;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, boundary::Verdict>, Rejection> {
        let (class, restitution) = match self.table.read(self.sphere.radius(), motion) {
            Reading::Rebound { rebound, .. } => (boundary::Verdict::Rebound, Some(rebound.restitution)),
            Reading::Capture => (boundary::Verdict::Capture, Some(T::ZERO)),
            Reading::TooCloseToCall => (boundary::Verdict::TooCloseToCall, None),
            Reading::OutsideTable => (boundary::Verdict::OutsideTable, None),
        };
        Ok(Verdict { class, restitution })
    }
}

impl<T, M, const N: usize, const R: usize, const S: usize> Classifier<T, M>
    for Tabulated<RestitutionTable<T, N, R, S>, T, Coulomb<T>>
where
    T: Single,
    M: Oblique<T>,
{
    type Class = TabulatedClass;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, TabulatedClass>, Rejection> {
        let (class, restitution) = match self.table.read(self.sphere.radius(), motion) {
            Reading::Rebound { rebound, .. } => {
                let after = rebound.separation(&self.friction, self.sphere.gyration_ratio(), motion);
                let class = match after.motion {
                    SurfaceMotion::Sliding => TabulatedClass::ReboundSliding,
                    SurfaceMotion::Rolling | SurfaceMotion::Resting => TabulatedClass::ReboundRolling,
                };
                (class, Some(rebound.restitution))
            }
            Reading::Capture => (TabulatedClass::Capture, Some(T::ZERO)),
            Reading::TooCloseToCall => (TabulatedClass::TooCloseToCall, None),
            Reading::OutsideTable => (TabulatedClass::OutsideTable, None),
        };
        Ok(Verdict { class, restitution })
    }
}
