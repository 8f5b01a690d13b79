//! The classes that a classifier tells apart.

use crate::boundary::Verdict;
use crate::{Class, Outcome};

/// A set of classes, counted from zero: [`Outcome`] without friction, [`Class`] with it, [`Verdict`] of a table.
///
/// ```
/// use microimpact::instrument::ClassSet;
/// use microimpact::{Class, Outcome};
///
/// assert_eq!((Outcome::COUNT, Class::COUNT), (2, 5));
/// assert!(Class::ALL.iter().enumerate().all(|(index, class)| class.index() == index));
/// ```
pub trait ClassSet: Copy + Eq + 'static {
    /// Number of classes.
    const COUNT: usize;
    /// All classes, each at its index.
    const ALL: &'static [Self];

    /// Place of this class in the set, below [`COUNT`](Self::COUNT).
    fn index(self) -> usize;
}

impl ClassSet for Outcome {
    const COUNT: usize = Self::ALL.len();
    const ALL: &'static [Self] = &[Self::Rebound, Self::Capture];

    #[inline]
    fn index(self) -> usize {
        match self {
            Self::Rebound => 0,
            Self::Capture => 1,
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
    ];

    #[inline]
    fn index(self) -> usize {
        match self {
            Self::ReboundSliding => 0,
            Self::ReboundRolling => 1,
            Self::CapturedSliding => 2,
            Self::CapturedRolling => 3,
            Self::CapturedResting => 4,
        }
    }
}

impl ClassSet for Verdict {
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
