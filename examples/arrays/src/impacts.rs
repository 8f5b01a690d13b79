//! Results of rows.

use std::ops::Range;

use microimpact::space::Departing;
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

/// The result of a row.
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
        for (after, quantities) in arrival.after(impact).into_iter().zip(DEPARTURES) {
            let numbers = after.velocity().into_iter().chain(after.spin());
            quantities.into_iter().zip(numbers).for_each(|(quantity, number)| self.put(quantity, number));
        }
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

/// Rows that a thread takes at a time: enough that the rows cost more than the change.
const ROWS: usize = 256;

/// Computes rows on all threads.
pub(crate) fn gather(
    count: usize,
    quantities: &[Quantity],
    row: impl Fn(usize) -> Result<Record, InputError> + Sync,
) -> Impacts {
    gather_ranges(count, quantities, |rows| rows.map(&row).collect())
}

/// Computes ranges of rows on all threads.
pub(crate) fn gather_ranges(
    count: usize,
    quantities: &[Quantity],
    compute: impl Fn(Range<usize>) -> Vec<Result<Record, InputError>> + Sync,
) -> Impacts {
    let part = |part: usize| compute(part * ROWS..count.min((part + 1) * ROWS));
    let numbers = || Vec::with_capacity(count);
    let mut impacts = Impacts {
        status: Vec::with_capacity(count),
        class: Vec::with_capacity(count),
        quantities: quantities.iter().map(|quantity| (*quantity, numbers())).collect(),
    };
    // In rounds, so that the records of all rows are never in memory at once.
    let parts: Vec<usize> = (0..count.div_ceil(ROWS)).collect();
    for round in parts.chunks(PARTS) {
        let records: Vec<Vec<_>> = round.par_iter().map(|index| part(*index)).collect();
        for record in records.into_iter().flatten() {
            let record = record.unwrap_or_else(|error| Record::without(RowStatus::Refused(error)));
            impacts.status.push(record.status);
            impacts.class.push(record.class);
            for (quantity, numbers) in &mut impacts.quantities {
                numbers.push(record.numbers[*quantity as usize]);
            }
        }
    }
    impacts
}

/// Parts of a round.
const PARTS: usize = 256;
