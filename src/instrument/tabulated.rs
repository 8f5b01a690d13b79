//! Tables as classifiers.

use super::{ClassSet, Classifier, Rejection, Verdict};
use crate::table::{BoundarySlice, BoundaryTable, Lookup, RestitutionTable, Single, TableOutcome};
use crate::{Approach, Coulomb, NoFriction, Oblique, Sphere, SurfaceMotion};

/// A classifier that looks up the impacts of a sphere in a table.
///
/// `B` is the type of the table: [`BoundaryTable`], [`BoundarySlice`] or [`RestitutionTable`]. Only the last one can be
/// combined with friction. If the table does not determine the outcome, the class says so: too close to call, or outside the
/// table.
///
/// ```
/// use microimpact::table::{BoundaryTable, TableOutcome};
/// use microimpact::instrument::{Instrument, NoLines, NormalReading, SpeedBins, Tabulated};
/// use microimpact::{CriticalSpeed, NoFriction, Sphere};
///
/// // A critical speed proportional to 1/r, 1 m/s at 1 um.
/// let table = BoundaryTable::<4>::new(1e-6_f32, |radius| Ok(CriticalSpeed::At(1e-6 / radius)))?;
/// let classifier = Tabulated { table, sphere: Sphere::solid(1.25e-6, 2600.0)?, friction: NoFriction };
/// let mut instrument: Instrument<_, _, _, 4, 1> = Instrument::new(classifier, NoLines, SpeedBins::new([10.0])?);
/// let mut class = |approach| instrument.process(&NormalReading { approach }).map(|verdict| verdict.class);
/// assert_eq!(class(0.9), Ok(TableOutcome::Rebound));
/// assert_eq!(class(0.7), Ok(TableOutcome::Capture));
/// assert_eq!(class(0.8), Ok(TableOutcome::TooCloseToCall));
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Tabulated<B, T, F = NoFriction> {
    /// The table.
    pub table: B,
    /// The sphere.
    pub sphere: Sphere<T>,
    /// The friction between sphere and surface.
    pub friction: F,
}

/// Classes of a restitution table with friction. The table does not determine how a captured sphere moves.
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
    /// The sphere leaves the surface while its contact point slips.
    ReboundSliding,
    /// The sphere leaves the surface rolling.
    ReboundRolling,
    /// The surface holds the sphere.
    Capture,
    /// The speed is within the error margin of the critical speed.
    TooCloseToCall,
    /// The table does not cover this radius or this speed.
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
    type Class = TableOutcome;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, TableOutcome>, Rejection> {
        Ok(Verdict { class: self.table.classify(self.sphere.radius(), motion), restitution: None })
    }
}

impl<T: Single, M: Approach<T>, const N: usize> Classifier<T, M> for Tabulated<BoundaryTable<N>, T> {
    type Class = TableOutcome;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, TableOutcome>, Rejection> {
        Ok(Verdict { class: self.table.classify(self.sphere.radius(), motion), restitution: None })
    }
}

impl<T, M, const N: usize, const R: usize, const S: usize> Classifier<T, M>
    for Tabulated<RestitutionTable<T, N, R, S>, T>
where
    T: Single,
    M: Approach<T>,
{
    type Class = TableOutcome;

    #[inline]
    fn verdict(&self, motion: &M) -> Result<Verdict<T, TableOutcome>, Rejection> {
        let (class, restitution) = match self.table.look_up(self.sphere.radius(), motion) {
            Lookup::Rebound { rebound, .. } => (TableOutcome::Rebound, Some(rebound.restitution)),
            Lookup::Capture => (TableOutcome::Capture, Some(T::ZERO)),
            Lookup::TooCloseToCall => (TableOutcome::TooCloseToCall, None),
            Lookup::OutsideTable => (TableOutcome::OutsideTable, None),
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
        let (class, restitution) = match self.table.look_up(self.sphere.radius(), motion) {
            Lookup::Rebound { rebound, .. } => {
                let after = rebound.separation(&self.friction, self.sphere.gyration_ratio(), motion);
                let class = match after.motion {
                    SurfaceMotion::Sliding => TabulatedClass::ReboundSliding,
                    SurfaceMotion::Rolling | SurfaceMotion::Resting => TabulatedClass::ReboundRolling,
                };
                (class, Some(rebound.restitution))
            }
            Lookup::Capture => (TabulatedClass::Capture, Some(T::ZERO)),
            Lookup::TooCloseToCall => (TabulatedClass::TooCloseToCall, None),
            Lookup::OutsideTable => (TabulatedClass::OutsideTable, None),
        };
        Ok(Verdict { class, restitution })
    }
}
