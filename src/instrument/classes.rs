//! Sets of classes.

use crate::table::TableOutcome;
use crate::{Class, Outcome};

/// A set of classes with indices from zero.
///
/// [`Outcome`] is the set without friction, [`Class`] with friction, and [`TableOutcome`] that of a boundary table.
///
/// ```
/// use microimpact::instrument::ClassSet;
/// use microimpact::{Class, Outcome};
///
/// assert_eq!((Outcome::COUNT, Class::COUNT), (3, 6));
/// assert!(Class::ALL.iter().enumerate().all(|(index, class)| class.index() == index));
/// ```
pub trait ClassSet: Copy + Eq + 'static {
    /// Number of classes.
    const COUNT: usize;
    /// All classes, in the order of their indices.
    const ALL: &'static [Self];

    /// Index of this class, below [`COUNT`](Self::COUNT).
    fn index(self) -> usize;
}

impl ClassSet for Outcome {
    const COUNT: usize = Self::ALL.len();
    const ALL: &'static [Self] = &[Self::Rebound, Self::Capture, Self::Undecided];

    #[inline]
    fn index(self) -> usize {
        match self {
            Self::Rebound => 0,
            Self::Capture => 1,
            Self::Undecided => 2,
        }
    }
}

impl ClassSet for Class {
    const COUNT: usize = Self::ALL.len();
    const ALL: &'static [Self] = &[
        Self::ReboundSliding,
        Self::ReboundRolling,
        Self::CapturedSliding,
        Self::CapturedRolling,
        Self::CapturedResting,
        Self::Undecided,
    ];

    #[inline]
    fn index(self) -> usize {
        match self {
            Self::ReboundSliding => 0,
            Self::ReboundRolling => 1,
            Self::CapturedSliding => 2,
            Self::CapturedRolling => 3,
            Self::CapturedResting => 4,
            Self::Undecided => 5,
        }
    }
}

impl ClassSet for TableOutcome {
    const COUNT: usize = Self::ALL.len();
    const ALL: &'static [Self] = &[Self::Rebound, Self::Capture, Self::TooCloseToCall, Self::OutsideTable];

    #[inline]
    fn index(self) -> usize {
        match self {
            Self::Rebound => 0,
            Self::Capture => 1,
            Self::TooCloseToCall => 2,
            Self::OutsideTable => 3,
        }
    }
}
