//! Events from an interrupt to the main loop.

use core::sync::atomic::{AtomicU32, Ordering};

use crate::event::Event;
use crate::memory;
use crate::status::{Failure, Status, followed};

/// A queue of events with one sender, which may be an interrupt, and one receiver, which may be the main loop. Neither waits for the
/// other. Its memory is the caller's; only the functions of the queue may touch it once it is made.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Queue {
    /// Room of the caller for events.
    pub events: *mut Event,
    /// Number of events that there is room for.
    pub capacity: u32,
    /// Place of the oldest event, below twice the capacity. The receiver alone writes it.
    pub first: u32,
    /// Place behind the youngest event, below twice the capacity. The sender alone writes it.
    pub end: u32,
    /// Events that found the queue full. The sender alone writes it; it saturates.
    pub lost: u32,
}

/// Most events that a queue has room for: places go round at twice as many.
pub const LARGEST_QUEUE: u32 = 0x4000_0000;

/// The fields of a queue that both ends see.
///
/// # Safety
/// The pointer is one to a queue, or null or misaligned.
unsafe fn shared<'a>(queue: *const Queue) -> Option<Shared<'a>> {
    // The fields are read one by one, since the other end may write to some meanwhile.
    memory::room(queue.cast_mut())?;
    // SAFETY: there is a queue by the contract of this function. Its places and its count have the size and the alignment of atomic
    // numbers, and after microimpact_queue_init they are used as such alone. What is not atomic, neither end writes.
    let shared = unsafe {
        Shared {
            events: (&raw const (*queue).events).read(),
            capacity: (&raw const (*queue).capacity).read(),
            first: AtomicU32::from_ptr((&raw const (*queue).first).cast_mut()),
            end: AtomicU32::from_ptr((&raw const (*queue).end).cast_mut()),
            lost: AtomicU32::from_ptr((&raw const (*queue).lost).cast_mut()),
        }
    };
    (1..=LARGEST_QUEUE).contains(&shared.capacity).then_some(shared)
}

struct Shared<'a> {
    events: *mut Event,
    capacity: u32,
    first: &'a AtomicU32,
    end: &'a AtomicU32,
    lost: &'a AtomicU32,
}

impl Shared<'_> {
    /// How many events wait, by the places of both ends; a place that cannot be is none at all.
    fn waiting(&self, first: u32, end: u32) -> Option<u32> {
        let round = 2 * self.capacity;
        if first >= round || end >= round {
            return None;
        }
        let waiting = if end >= first { end - first } else { end + round - first };
        (waiting <= self.capacity).then_some(waiting)
    }

    fn next(&self, place: u32) -> u32 {
        if place + 1 == 2 * self.capacity { 0 } else { place + 1 }
    }

    fn slot(&self, place: u32) -> *mut Event {
        let index = if place >= self.capacity { place - self.capacity } else { place };
        memory::element_mut(self.events, index as usize)
    }
}

/// Makes an empty queue with room for `capacity` events, 1 to MICROIMPACT_LARGEST_QUEUE, in memory of the caller. Else it is
/// MICROIMPACT_STATUS_CAPACITY. Not re-entrant: call it before the interrupt is enabled.
///
/// # Safety
/// Each pointer is null or points to what its type says, the events to room for `capacity` of them, for as long as the queue is used.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_queue_init(queue: *mut Queue, events: *mut Event, capacity: usize) -> Status {
    let capacity = u32::try_from(capacity).ok().filter(|capacity| (1..=LARGEST_QUEUE).contains(capacity));
    // SAFETY: the contract of this function is that of the functions in `memory`.
    let made = || unsafe {
        let capacity = capacity.ok_or(Failure::Status(Status::Capacity))?;
        followed(memory::room(events))?;
        followed(memory::write(queue, Queue { events, capacity, first: 0, end: 0, lost: 0 }))
    };
    ended(made())
}

/// Puts an event into a queue; one that finds it full is counted as lost, and MICROIMPACT_STATUS_CAPACITY. No floating point is used,
/// and there is no loop. For an interrupt, while microimpact_queue_pop runs in the main loop; no two senders at once.
///
/// # Safety
/// Each pointer is null or points to what its type says, the queue to one that microimpact_queue_init has made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_queue_push(queue: *mut Queue, event: *const Event) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`. The slot is one that the receiver does not read: it is
    // behind the youngest event, and the receiver comes to it when `end` has been written.
    let pushed = || unsafe {
        let queue = shared(queue).ok_or(Failure::Status(Status::Pointer))?;
        let event = followed(memory::read(event))?;
        let end = queue.end.load(Ordering::Relaxed);
        let waiting = queue.waiting(queue.first.load(Ordering::Acquire), end);
        if waiting.ok_or(Failure::Status(Status::Unmade))? == queue.capacity {
            // Only the sender writes this count, so that processors without atomic addition have it too.
            queue.lost.store(queue.lost.load(Ordering::Relaxed).saturating_add(1), Ordering::Relaxed);
            return Err(Failure::Status(Status::Capacity));
        }
        followed(memory::write(queue.slot(end), event))?;
        queue.end.store(queue.next(end), Ordering::Release);
        Ok(())
    };
    ended(pushed())
}

/// Takes the oldest event from a queue; from an empty one it is MICROIMPACT_STATUS_CAPACITY. For the main loop, while
/// microimpact_queue_push runs in an interrupt; no two receivers at once.
///
/// # Safety
/// Each pointer is null or points to what its type says, the queue to one that microimpact_queue_init has made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_queue_pop(queue: *mut Queue, event: *mut Event) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`. The slot holds a whole event, which the sender does not
    // write to before `first` has been written.
    let popped = || unsafe {
        let queue = shared(queue).ok_or(Failure::Status(Status::Pointer))?;
        followed(memory::room(event))?;
        let first = queue.first.load(Ordering::Relaxed);
        let waiting = queue.waiting(first, queue.end.load(Ordering::Acquire));
        if waiting.ok_or(Failure::Status(Status::Unmade))? == 0 {
            return Err(Failure::Status(Status::Capacity));
        }
        followed(memory::write(event, followed(memory::read(queue.slot(first)))?))?;
        queue.first.store(queue.next(first), Ordering::Release);
        Ok(())
    };
    ended(popped())
}

/// Number of events that found a queue full since it was made; it saturates. Re-entrant.
///
/// # Safety
/// The pointer is null or points to a queue that microimpact_queue_init has made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_queue_lost(queue: *const Queue) -> u32 {
    // SAFETY: the contract of this function.
    unsafe { shared(queue) }.map_or(0, |queue| queue.lost.load(Ordering::Relaxed))
}

fn ended(result: Result<(), Failure>) -> Status {
    match result {
        Ok(()) => Status::Ok,
        Err(Failure::Status(status)) => status,
        Err(Failure::Input(_) | Failure::Index { .. }) => Status::Input,
    }
}
