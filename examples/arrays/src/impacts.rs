//! Results of rows.

use std::ops::Range;

use microimpact::{Class, InputError};
use rayon::prelude::*;

use crate::Quantity;

/// How the computation of a row ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowStatus {
    /// There is a result. Its class may be undecided.
    Solved,
    /// The method did not converge; there is no result.
    NotConverged,
    /// The method cannot represent the law of contact; there is no result.
    Unsupported,
    /// A number is outside its range; there is no result.
    Refused(InputError),
}

/// The results of all rows, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Impacts {
    /// How the computation of each row ended.
    pub status: Vec<RowStatus>,
    /// The class of each row; `None` where there is no result.
    pub class: Vec<Option<Class>>,
    /// The quantities that were asked for, with a number for each row: NaN where an impact does not have it.
    pub quantities: Vec<(Quantity, Vec<f64>)>,
}

impl Impacts {
    /// The numbers of a quantity; `None` if it was not asked for.
    #[must_use]
    pub fn numbers(&self, quantity: Quantity) -> Option<&[f64]> {
        self.quantities.iter().find(|(asked, _)| *asked == quantity).map(|(_, numbers)| &numbers[..])
    }

    /// The first row without a result, and why it has none.
    #[must_use]
    pub fn first_failure(&self) -> Option<(usize, RowStatus)> {
        let failed = |(_, status): &(usize, RowStatus)| *status != RowStatus::Solved;
        self.status.iter().copied().enumerate().find(failed)
    }
}

/// The result of a row, from which the quantities that are asked for are taken.
pub(crate) trait Answer {
    fn status(&self) -> RowStatus;
    fn class(&self) -> Option<Class>;
    /// NaN where the impact does not have the quantity.
    fn number(&self, quantity: Quantity) -> f64;
}

/// Rows that a thread takes at a time: enough that the rows cost more than the change.
const ROWS: usize = 256;

/// Some rows of the results.
pub(crate) struct Part<'a> {
    first: usize,
    status: &'a mut [RowStatus],
    class: &'a mut [Option<Class>],
    quantities: Vec<(Quantity, &'a mut [f64])>,
}

impl<'a> Part<'a> {
    pub(crate) fn rows(&self) -> Range<usize> {
        self.first..self.first + self.status.len()
    }

    /// Puts the results of `N` rows from `first` on, which are solved, where they belong.
    #[inline]
    pub(crate) fn put_group<const N: usize>(
        &mut self,
        first: usize,
        class: [Class; N],
        numbers: impl Fn(Quantity) -> [f64; N],
    ) {
        let places = first - self.first..first - self.first + N;
        self.status[places.clone()].fill(RowStatus::Solved);
        self.class[places.clone()].copy_from_slice(&class.map(Some));
        for (quantity, column) in &mut self.quantities {
            column[places.clone()].copy_from_slice(&numbers(*quantity));
        }
    }

    /// Where the result of one of its rows belongs.
    #[inline]
    pub(crate) fn slot(&mut self, row: usize) -> Slot<'_, 'a> {
        Slot { place: row - self.first, part: self }
    }

    /// Fills the slot of a row, or says why it is refused.
    #[inline]
    pub(crate) fn fill(&mut self, row: usize, compute: impl FnOnce(&mut Slot<'_, '_>) -> Result<(), InputError>) {
        let mut slot = self.slot(row);
        if let Err(error) = compute(&mut slot) {
            slot.fail(RowStatus::Refused(error));
        }
    }
}

/// Where the result of a row belongs. Until there is one, the method did not converge.
pub(crate) struct Slot<'p, 'a> {
    part: &'p mut Part<'a>,
    place: usize,
}

impl Slot<'_, '_> {
    /// Takes from a result what was asked for.
    #[inline(always)]
    pub(crate) fn put(&mut self, answer: &impl Answer) {
        let (part, place) = (&mut *self.part, self.place);
        part.status[place] = answer.status();
        part.class[place] = answer.class();
        for (quantity, numbers) in &mut part.quantities {
            numbers[place] = answer.number(*quantity);
        }
    }

    /// There is no result.
    pub(crate) fn fail(&mut self, status: RowStatus) {
        let (part, place) = (&mut *self.part, self.place);
        part.status[place] = status;
        part.class[place] = None;
        for (_, numbers) in &mut part.quantities {
            numbers[place] = f64::NAN;
        }
    }

    /// Whether the sphere rebounds or is captured, beyond doubt.
    pub(crate) fn is_decided(&self) -> bool {
        self.part.class[self.place].is_some_and(|class| class != Class::Undecided)
    }
}

/// Fills rows on all threads; `row` puts the result of a row into its slot.
pub(crate) fn fill(
    count: usize,
    quantities: &[Quantity],
    row: impl Fn(usize, &mut Slot<'_, '_>) -> Result<(), InputError> + Sync,
) -> Impacts {
    fill_parts(count, quantities, |part| {
        for index in part.rows() {
            part.fill(index, |slot| row(index, slot));
        }
    })
}

/// Fills parts of the rows on all threads, each of which writes its rows where they belong.
pub(crate) fn fill_parts(count: usize, quantities: &[Quantity], compute: impl Fn(&mut Part<'_>) + Sync) -> Impacts {
    // A page of memory costs more to touch first than its rows cost to classify, and so all threads do it.
    let mut impacts = Impacts {
        status: rayon::iter::repeat_n(RowStatus::NotConverged, count).collect(),
        class: rayon::iter::repeat_n(None, count).collect(),
        quantities: quantities.iter().map(|quantity| (*quantity, vec![0.0; count])).collect(),
    };
    let mut columns: Vec<_> =
        impacts.quantities.iter_mut().map(|(quantity, numbers)| (*quantity, numbers.chunks_mut(ROWS))).collect();
    let rows = impacts.status.chunks_mut(ROWS).zip(impacts.class.chunks_mut(ROWS)).enumerate();
    let parts: Vec<Part<'_>> = rows
        .map(|(index, (status, class))| {
            let numbers = columns.iter_mut().filter_map(|(quantity, chunks)| Some((*quantity, chunks.next()?)));
            Part { first: index * ROWS, status, class, quantities: numbers.collect() }
        })
        .collect();
    parts.into_par_iter().for_each(|mut part| {
        part.quantities.iter_mut().for_each(|(_, numbers)| numbers.fill(f64::NAN));
        compute(&mut part);
    });
    impacts
}
