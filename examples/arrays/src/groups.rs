//! Rows that are computed at once, each in a lane.

use microimpact::{InputError, Real};

use crate::impacts::{Part, Slot, fill_parts};
use crate::{Column, F64x4, Impacts, Quantity};

/// Rows that are computed at once.
pub(crate) const LANES: usize = 4;

/// Fills rows on all threads until `stop` is true. `group` puts the results of [`LANES`] rows from one on into their slots, or does not if
/// they cannot be computed at once; `row` puts the result of a row into its slot, or completes it if its group has put one there.
pub(crate) fn fill_groups(
    count: usize,
    quantities: &[Quantity],
    stop: impl Fn() -> bool + Sync,
    group: impl Fn(usize, &mut Part<'_>) -> Option<()> + Sync,
    row: impl Fn(usize, &mut Slot<'_, '_>, Option<()>) -> Result<(), InputError> + Sync,
) -> Impacts {
    fill_parts(count, quantities, |part| {
        let mut next = part.rows().start;
        while next < part.rows().end && !stop() {
            let solved = if next + LANES <= part.rows().end { group(next, part) } else { None };
            let rows = if solved.is_some() { LANES } else { 1 };
            for index in next..next + rows {
                part.fill(index, |slot| row(index, slot, solved));
            }
            next += rows;
        }
    })
}

/// The numbers of a column from a row on. Beyond its end they are NaN, which every model refuses.
#[inline]
pub(crate) fn in_lanes(column: &Column<'_>, first: usize) -> F64x4 {
    match column {
        Column::All(number) => F64x4::constant(*number),
        Column::Each(numbers) => numbers
            .get(first..)
            .and_then(|rest| rest.first_chunk())
            .map_or(F64x4::constant(f64::NAN), |numbers| F64x4::from(*numbers)),
    }
}
