//! Results of rows.

use std::ops::Range;

use microimpact::space::{Departing, SpatialMotion};
use microimpact::{Class, InputError};
use rayon::prelude::*;

use crate::Quantity;
use crate::motions::Arrival;

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

/// The result of a row with every quantity.
pub(crate) struct Record {
    status: RowStatus,
    class: Option<Class>,
    numbers: [f64; Quantity::COUNT],
}

impl Record {
    /// No result.
    pub(crate) fn without(status: RowStatus) -> Self {
        Self { status, class: None, numbers: [f64::NAN; Quantity::COUNT] }
    }

    /// A class, and no numbers so far.
    pub(crate) fn of(class: Class) -> Self {
        Self { class: Some(class), ..Self::without(RowStatus::Solved) }
    }

    /// Whether the sphere rebounds or is captured, beyond doubt.
    pub(crate) fn is_decided(&self) -> bool {
        self.class.is_some_and(|class| class != Class::Undecided)
    }

    pub(crate) fn put(&mut self, quantity: Quantity, number: f64) {
        self.numbers[quantity as usize] = number;
    }

    pub(crate) fn put_some(&mut self, quantity: Quantity, number: Option<f64>) {
        self.put(quantity, number.unwrap_or(f64::NAN));
    }

    /// The motions in space after an impact, if it takes place there.
    pub(crate) fn put_departure(&mut self, arrival: &Arrival, impact: &impl Departing<f64>) {
        let bodies = arrival.after(impact);
        for quantity in DEPARTURES.into_iter().flatten() {
            self.put(quantity, departure(&bodies, quantity));
        }
    }
}

impl Answer for Record {
    fn status(&self) -> RowStatus {
        self.status
    }

    fn class(&self) -> Option<Class> {
        self.class
    }

    fn number(&self, quantity: Quantity) -> f64 {
        self.numbers[quantity as usize]
    }
}

/// Velocity and spin of one sphere, and of the second of two.
const DEPARTURES: [[Quantity; 6]; 2] = [
    [
        Quantity::VelocityOutX,
        Quantity::VelocityOutY,
        Quantity::VelocityOutZ,
        Quantity::SpinOutX,
        Quantity::SpinOutY,
        Quantity::SpinOutZ,
    ],
    [
        Quantity::Velocity2OutX,
        Quantity::Velocity2OutY,
        Quantity::Velocity2OutZ,
        Quantity::Spin2OutX,
        Quantity::Spin2OutY,
        Quantity::Spin2OutZ,
    ],
];

/// A component of velocity or spin of one sphere or two after an impact; NaN if there is no such sphere.
pub(crate) fn departure(bodies: &[SpatialMotion<f64>], quantity: Quantity) -> f64 {
    let found = bodies.iter().zip(DEPARTURES).find_map(|(body, quantities)| {
        let place = quantities.into_iter().position(|other| other == quantity)?;
        body.velocity().into_iter().chain(body.spin()).nth(place)
    });
    found.unwrap_or(f64::NAN)
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
    fn rows(&self) -> Range<usize> {
        self.first..self.first + self.status.len()
    }

    fn slot(&mut self, row: usize) -> Slot<'_, 'a> {
        Slot { place: row - self.first, part: self }
    }

    fn refuse(&mut self, row: usize, error: InputError) {
        self.status[row - self.first] = RowStatus::Refused(error);
    }
}

/// Where the result of a row belongs.
pub(crate) struct Slot<'p, 'a> {
    part: &'p mut Part<'a>,
    place: usize,
}

impl Slot<'_, '_> {
    /// Takes from a result what was asked for.
    pub(crate) fn put(self, answer: &impl Answer) {
        let Self { part, place } = self;
        part.status[place] = answer.status();
        part.class[place] = answer.class();
        for (quantity, numbers) in &mut part.quantities {
            numbers[place] = answer.number(*quantity);
        }
    }
}

/// Computes rows on all threads.
pub(crate) fn gather<A: Answer>(
    count: usize,
    quantities: &[Quantity],
    row: impl Fn(usize) -> Result<A, InputError> + Sync,
) -> Impacts {
    fill(count, quantities, |index, slot| {
        slot.put(&row(index)?);
        Ok(())
    })
}

/// Computes ranges of rows on all threads; `compute` hands the answers of its rows over in their order.
pub(crate) fn gather_ranges<A: Answer>(
    count: usize,
    quantities: &[Quantity],
    compute: impl Fn(Range<usize>, &mut dyn FnMut(Result<A, InputError>)) + Sync,
) -> Impacts {
    fill_parts(count, quantities, |part| {
        let mut rows = part.rows();
        compute(part.rows(), &mut |answer| match (rows.next(), answer) {
            (Some(row), Ok(answer)) => part.slot(row).put(&answer),
            (Some(row), Err(error)) => part.refuse(row, error),
            (None, _) => {}
        });
    })
}

/// Fills rows on all threads; `row` puts the result of a row into its slot.
pub(crate) fn fill(
    count: usize,
    quantities: &[Quantity],
    row: impl Fn(usize, Slot<'_, '_>) -> Result<(), InputError> + Sync,
) -> Impacts {
    fill_parts(count, quantities, |part| {
        for index in part.rows() {
            if let Err(error) = row(index, part.slot(index)) {
                part.refuse(index, error);
            }
        }
    })
}

/// Fills parts of the rows on all threads, each of which writes its rows where they belong.
fn fill_parts(count: usize, quantities: &[Quantity], compute: impl Fn(&mut Part<'_>) + Sync) -> Impacts {
    let mut impacts = Impacts {
        status: vec![RowStatus::NotConverged; count],
        class: vec![None; count],
        quantities: quantities.iter().map(|quantity| (*quantity, vec![f64::NAN; count])).collect(),
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
    parts.into_par_iter().for_each(|mut part| compute(&mut part));
    impacts
}
