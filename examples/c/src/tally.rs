//! Counts of the classes of an instrument, and the restitution of its rebounds by speed.

use microimpact::Parameter;
use microimpact::instrument::{self, ClassSet, Rejection, SpeedBins, Statistics, Verdict};

use crate::error::Error;
use crate::memory;
use crate::scene::SceneImpact;
use crate::status::{Failure, Status, finish, followed};

/// Number of bins of speed of a tally.
pub const TALLY_BINS: usize = 8;

/// Number of bins with that of faster impacts.
pub const TALLY_RANGES: usize = 9;

/// Number of classes.
pub const CLASSES: usize = 6;

const _: () = assert!(CLASSES == microimpact::Class::COUNT);

/// Room for a tally, which microimpact_tally_init makes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Tally {
    /// What is in it concerns the library alone.
    pub words: [u64; 41],
}

#[derive(Clone, Copy)]
struct Made {
    mark: u64,
    tally: instrument::Tally<f32, CLASSES, TALLY_BINS>,
}

/// Tells a tally from memory in which none was made.
const MARK: u64 = 0x6d69_7461_6c6c_7900;

const _: () = assert!(size_of::<Made>() == size_of::<Tally>());
const _: () = assert!(align_of::<Made>() <= align_of::<Tally>());

/// What a tally has counted.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TallyReport {
    /// Impacts of each class, in the order of MicroimpactClass.
    pub classes: [u64; CLASSES],
    /// Readings with a number outside its range.
    pub refused: u64,
    /// Motions that the method did not solve.
    pub unsolved: u64,
    /// Rebounds in each bin of speed; the last number is of those beyond the last bin.
    pub rebounds: [u64; TALLY_RANGES],
    /// Mean of their overall restitution; zero without rebounds.
    pub mean: [f32; TALLY_RANGES],
    /// Variance of it; negative with fewer than two rebounds.
    pub variance: [f32; TALLY_RANGES],
    /// Upper edges of the bins of speed, m/s; a speed equal to an edge counts in the bin above it.
    pub edges: [f32; TALLY_BINS],
}

/// Makes an empty tally with the upper edges of eight bins of speed, m/s, which rise. If they are refused, the tally
/// stays as it was. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the edges to eight, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_tally_init(tally: *mut Tally, edges: *const f32, error: *mut Error) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the tally is room for a `Made`.
    unsafe {
        let made = || -> Result<(), Failure> {
            let bins = SpeedBins::new(followed(memory::read(edges.cast::<[f32; TALLY_BINS]>()))?)?;
            followed(memory::write(tally.cast(), Made { mark: MARK, tally: instrument::Tally::new(bins) }))
        };
        finish(made(), error)
    }
}

/// Counts an impact, by how it was classified: `status` is what that function has returned, and the impact counts if it is
/// MICROIMPACT_STATUS_OK. MICROIMPACT_STATUS_INPUT counts as refused, any other status as unsolved; the impact may then be null. An impact with a speed or
/// a restitution that is none is not counted, and gives MICROIMPACT_STATUS_INPUT. Not re-entrant: a tally belongs to the main loop, or to one interrupt.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_tally_record(
    tally: *mut Tally,
    approach: f32,
    status: u32,
    impact: *const SceneImpact,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`. A class is looked at as the number that it is, since
    // C may have written any.
    unsafe {
        let recorded = || -> Result<(), Failure> {
            let mut made = made(tally)?;
            if status == Status::Ok as u32 {
                followed(memory::room(impact.cast_mut()))?;
                let class = followed(memory::read((&raw const (*impact).impact_class).cast::<u32>()))?;
                let restitution = followed(memory::read(&raw const (*impact).restitution))?;
                let class = microimpact::Class::ALL.get(class as usize).ok_or(Failure::Status(Status::Choice))?;
                Parameter::ApproachSpeed.check(approach)?;
                let rebounds = matches!(class, microimpact::Class::ReboundSliding | microimpact::Class::ReboundRolling);
                let restitution = rebounds.then(|| Parameter::Restitution.check(restitution)).transpose()?;
                made.tally.record(approach, &Verdict { class: *class, restitution });
            } else if status == Status::Input as u32 {
                made.tally.reject(&REFUSED);
            } else {
                made.tally.reject(&Rejection::Unsolved);
            }
            followed(memory::write(tally.cast(), made))
        };
        finish(recorded(), core::ptr::null_mut())
    }
}

/// A refusal of any number: the tally counts all of them together.
const REFUSED: Rejection = Rejection::Input(microimpact::InputError {
    parameter: Parameter::ApproachSpeed,
    fault: microimpact::Fault::NotFinite,
    value: 0.0,
});

/// The tally in its room.
///
/// # Safety
/// As for [`memory::read`].
unsafe fn made(tally: *const Tally) -> Result<Made, Failure> {
    // SAFETY: the contract of this function; `Made` is plain numbers.
    let made: Made = followed(unsafe { memory::read(tally.cast()) })?;
    if made.mark == MARK { Ok(made) } else { Err(Failure::Status(Status::Unmade)) }
}

/// Writes what a tally has counted. Not re-entrant with microimpact_tally_record of the same tally.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_tally_read(tally: *const Tally, report: *mut TallyReport) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let read = || -> Result<(), Failure> {
            let Made { tally, .. } = made(tally)?;
            let mut classes = [0; CLASSES];
            for (count, class) in classes.iter_mut().zip(microimpact::Class::ALL) {
                *count = tally.count(*class);
            }
            let mut found = TallyReport {
                classes,
                refused: tally.rejections().input,
                unsolved: tally.rejections().unsolved,
                rebounds: [0; TALLY_RANGES],
                mean: [0.0; TALLY_RANGES],
                variance: [-1.0; TALLY_RANGES],
                edges: *tally.bins().edges(),
            };
            let statistics = tally.restitution().iter().chain([tally.restitution_beyond()]);
            let columns = found.rebounds.iter_mut().zip(&mut found.mean).zip(&mut found.variance);
            for (((rebounds, mean), variance), of_bin) in columns.zip(statistics) {
                let of_bin: &Statistics<f32> = of_bin;
                *rebounds = of_bin.count();
                *mean = of_bin.mean();
                *variance = of_bin.variance().unwrap_or(-1.0);
            }
            followed(memory::write(report, found))
        };
        finish(read(), core::ptr::null_mut())
    }
}
