//! The course of a simulated impact.

use microimpact::contact::{self, Recording, Slip, Trajectory};

use crate::error::Error;
use crate::memory;
use crate::simulation::{Contact, ContactScene};
use crate::status::{Failure, Motion, Status, finish, followed};

/// Least room for a trajectory: first touch, peak, beginning of rolling and end.
pub const SMALLEST_TRAJECTORY: usize = 4;

/// Room that is always enough: no trajectory has more samples.
pub const LARGEST_TRAJECTORY: usize = 64;

/// A moment of a simulated impact.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time from first touch, s.
    pub time: f32,
    /// Indentation, m.
    pub indentation: f32,
    /// Its rate, m/s: positive on the way in, negative on the way out, zero at the peak.
    pub velocity: f32,
    /// Normal force of the surface on the sphere, N, positive where it repels.
    pub force: f32,
    /// Its elastic part, N.
    pub elastic: f32,
}

impl From<contact::Sample<f32>> for Sample {
    fn from(sample: contact::Sample<f32>) -> Self {
        let contact::Sample { time, indentation, velocity, force, elastic } = sample;
        Self { time, indentation, velocity, force, elastic }
    }
}

/// Simulates one impact, and writes its trajectory into a buffer with room for `capacity` samples, in the order of time, and how
/// many there are: at most as many as there is room for, and never more than MICROIMPACT_LARGEST_TRAJECTORY. In less room,
/// samples are left out evenly over time; first touch, peak, beginning of rolling and end are always there. In less than
/// MICROIMPACT_SMALLEST_TRAJECTORY there is no trajectory. Where this fails, there are no samples and no result. The error may
/// be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the samples to room for `capacity` of them, and nobody else uses them
/// during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_simulate_trajectory(
    scene: *const ContactScene,
    motion: *const Motion,
    samples: *mut Sample,
    capacity: usize,
    written: *mut usize,
    result: *mut Contact,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; indices stay below the capacity.
    unsafe {
        let simulated = || -> Result<(), Failure> {
            followed(memory::write(written, 0))?;
            if capacity < SMALLEST_TRAJECTORY {
                return Err(Failure::Status(Status::Capacity));
            }
            followed(memory::room(samples))?;
            let (scene, method) = followed(memory::read(scene))?.check()?;
            let motion = followed(memory::read(motion))?.check()?;
            let (impact, (_, trajectory)) =
                scene.solve_for(&motion, &method, (Slip, Recording::<LARGEST_TRAJECTORY>))?;
            followed(memory::write(result, Contact::of(&impact)?))?;
            let mut done = 0;
            let mut thinning = Thinning::new(&trajectory, capacity);
            for sample in trajectory.samples().filter(|sample| thinning.keeps(sample)).take(capacity) {
                followed(memory::write(memory::element_mut(samples, done), sample.into()))?;
                done += 1;
            }
            followed(memory::write(written, done))
        };
        finish(simulated(), error)
    }
}

/// What decides which samples of a trajectory are kept where there is room for fewer.
struct Thinning {
    /// First touch, peak, beginning of rolling and end, each until it has come.
    marked: [Option<contact::Sample<f32>>; SMALLEST_TRAJECTORY],
    /// Intervals of time of which one other sample is kept each, to the second; none where there is room for all.
    rate: Option<f32>,
    /// The first interval of which none has been kept.
    next: usize,
    /// How many there are.
    intervals: usize,
}

impl Thinning {
    fn new(trajectory: &Trajectory<f32, LARGEST_TRAJECTORY>, capacity: usize) -> Self {
        let samples = trajectory.samples();
        let has_room = samples.len() <= capacity;
        let (first, last) = (trajectory.samples().next(), trajectory.samples().last());
        let duration = last.map_or(0.0, |last| last.time);
        let intervals = capacity.saturating_sub(SMALLEST_TRAJECTORY);
        Self {
            marked: [first, trajectory.peak(), trajectory.roll(), last],
            rate: (!has_room).then_some(intervals as f32 / duration),
            next: 0,
            intervals,
        }
    }

    fn keeps(&mut self, sample: &contact::Sample<f32>) -> bool {
        let Some(rate) = self.rate else { return true };
        if self.marked.iter_mut().any(|marked| marked.take_if(|marked| marked == sample).is_some()) {
            return true;
        }
        let interval = (sample.time * rate) as usize;
        let keeps = self.next <= interval && interval < self.intervals;
        if keeps {
            self.next = interval + 1;
        }
        keeps
    }
}
