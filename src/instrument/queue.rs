//! Event queue from an interrupt to the main loop. It counts lost events.

use core::fmt;
#[cfg(not(feature = "portable-atomic"))]
use core::sync::atomic;
use core::sync::atomic::Ordering;

use heapless::spsc;
#[cfg(feature = "portable-atomic")]
use portable_atomic as atomic;

use atomic::AtomicU32;

/// A queue with one sender and one receiver, with room for `N - 1` events.
///
/// It is lock-free: neither side waits for the other, and no critical section is needed.
///
/// ```
/// use microimpact::instrument::Queue;
///
/// let mut queue = Queue::<u32, 3>::new();
/// let (mut interrupt, mut main_loop) = queue.split();
/// assert_eq!((interrupt.send(1), interrupt.send(2), interrupt.send(3)), (Ok(()), Ok(()), Err(3)));
/// assert_eq!((main_loop.receive(), main_loop.receive(), main_loop.receive()), (Some(1), Some(2), None));
/// assert_eq!(main_loop.lost(), 1);
/// ```
#[derive(Debug)]
pub struct Queue<E, const N: usize> {
    events: spsc::Queue<E, N>,
    lost: AtomicU32,
}

impl<E, const N: usize> Queue<E, N> {
    /// Creates an empty queue.
    ///
    /// ```
    /// use microimpact::instrument::Queue;
    ///
    /// const EMPTY: Queue<f32, 16> = Queue::new();
    /// assert!(EMPTY.is_empty());
    /// ```
    pub const fn new() -> Self {
        const { assert!(N > 1, "a queue must have room for at least one event") };
        Self { events: spsc::Queue::new(), lost: AtomicU32::new(0) }
    }

    /// Whether the queue is empty.
    ///
    /// ```
    /// assert!(microimpact::instrument::Queue::<u8, 2>::new().is_empty());
    /// ```
    pub fn is_empty(&self) -> bool {
        self.events.is_empty()
    }

    /// Splits the queue into the end for the interrupt and the end for the main loop.
    ///
    /// ```
    /// let mut queue = microimpact::instrument::Queue::<u8, 2>::new();
    /// let (mut sender, mut receiver) = queue.split();
    /// assert_eq!(sender.send(7), Ok(()));
    /// assert_eq!(receiver.receive(), Some(7));
    /// ```
    pub fn split(&mut self) -> (Sender<'_, E>, Receiver<'_, E>) {
        let Self { events, lost } = self;
        let (producer, consumer) = events.split();
        (Sender { producer, lost }, Receiver { consumer, lost })
    }
}

impl<E, const N: usize> Default for Queue<E, N> {
    fn default() -> Self {
        Self::new()
    }
}

/// The end of a [`Queue`] for the interrupt.
///
/// ```
/// use microimpact::instrument::{Queue, Sender};
///
/// fn interrupt(sender: &mut Sender<'_, f32>) -> bool {
///     sender.send(2.8).is_ok()
/// }
/// assert!(interrupt(&mut Queue::<_, 4>::new().split().0));
/// ```
pub struct Sender<'a, E> {
    producer: spsc::Producer<'a, E>,
    lost: &'a AtomicU32,
}

impl<E> Sender<'_, E> {
    /// Puts an event into the queue. If the queue is full, the event counts as lost.
    ///
    /// # Errors
    /// The event, if the queue is full.
    ///
    /// ```
    /// let mut queue = microimpact::instrument::Queue::<u8, 2>::new();
    /// let (mut sender, receiver) = queue.split();
    /// assert_eq!((sender.send(1), sender.send(2)), (Ok(()), Err(2)));
    /// assert_eq!(receiver.lost(), 1);
    /// ```
    #[inline]
    pub fn send(&mut self, event: E) -> Result<(), E> {
        self.producer.enqueue(event).inspect_err(|_| {
            // Only the sender writes this count. So a load and a store suffice on processors without atomic addition.
            self.lost.store(self.lost.load(Ordering::Relaxed).saturating_add(1), Ordering::Relaxed);
        })
    }
}

/// The end of a [`Queue`] for the main loop.
///
/// ```
/// use microimpact::instrument::{Queue, Receiver};
///
/// fn main_loop(receiver: &mut Receiver<'_, f32>) -> Option<f32> {
///     receiver.receive()
/// }
/// assert_eq!(main_loop(&mut Queue::<_, 4>::new().split().1), None);
/// ```
pub struct Receiver<'a, E> {
    consumer: spsc::Consumer<'a, E>,
    lost: &'a AtomicU32,
}

impl<E> Receiver<'_, E> {
    /// Takes the oldest event from the queue; `None` if the queue is empty.
    ///
    /// ```
    /// let mut queue = microimpact::instrument::Queue::<u8, 2>::new();
    /// assert_eq!(queue.split().1.receive(), None);
    /// ```
    #[inline]
    pub fn receive(&mut self) -> Option<E> {
        self.consumer.dequeue()
    }

    /// Whether the queue is empty.
    ///
    /// ```
    /// let mut queue = microimpact::instrument::Queue::<u8, 2>::new();
    /// assert!(queue.split().1.is_empty());
    /// ```
    #[inline]
    pub fn is_empty(&self) -> bool {
        !self.consumer.ready()
    }

    /// Number of lost events since the queue was created. The count saturates.
    ///
    /// ```
    /// let mut queue = microimpact::instrument::Queue::<u8, 2>::new();
    /// assert_eq!(queue.split().1.lost(), 0);
    /// ```
    #[inline]
    pub fn lost(&self) -> u32 {
        self.lost.load(Ordering::Relaxed)
    }
}

impl<E> fmt::Debug for Sender<'_, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sender").field("waiting", &self.producer.len()).finish()
    }
}

impl<E> fmt::Debug for Receiver<'_, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Receiver").field("waiting", &self.consumer.len()).field("lost", &self.lost()).finish()
    }
}

#[cfg(feature = "defmt")]
impl<E, const N: usize> defmt::Format for Queue<E, N> {
    fn format(&self, f: defmt::Formatter<'_>) {
        let lost = self.lost.load(Ordering::Relaxed);
        defmt::write!(f, "Queue {{ waiting: {=usize}, lost: {=u32} }}", self.events.len(), lost);
    }
}

#[cfg(feature = "defmt")]
impl<E> defmt::Format for Sender<'_, E> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "Sender {{ waiting: {=usize} }}", self.producer.len());
    }
}

#[cfg(feature = "defmt")]
impl<E> defmt::Format for Receiver<'_, E> {
    fn format(&self, f: defmt::Formatter<'_>) {
        defmt::write!(f, "Receiver {{ waiting: {=usize}, lost: {=u32} }}", self.consumer.len(), self.lost());
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use core::iter;
    use std::thread;
    use std::vec::Vec;

    use super::Queue;

    /// Two threads in place of an interrupt and a main loop. Miri looks for data races in fewer events.
    #[test]
    fn events_cross_threads_in_order_or_are_counted_as_lost() {
        const EVENTS: u32 = if cfg!(miri) { 300 } else { 1_000_000 };
        let mut queue = Queue::<u32, 8>::new();
        let (mut interrupt, mut main_loop) = queue.split();
        let (received, refused) = thread::scope(|scope| {
            let sender = scope.spawn(move || (0..EVENTS).filter(|&event| interrupt.send(event).is_err()).count());
            let mut received = Vec::new();
            while !sender.is_finished() {
                match main_loop.receive() {
                    Some(event) => received.push(event),
                    None => thread::yield_now(),
                }
            }
            let refused = sender.join();
            // Only now is all certain to be seen that the other thread has sent.
            received.extend(iter::from_fn(|| main_loop.receive()));
            (received, refused)
        });
        assert!(received.is_sorted_by(|earlier, later| earlier < later));
        assert_eq!(refused.ok(), Some(EVENTS as usize - received.len()));
        assert_eq!(main_loop.lost() as usize, EVENTS as usize - received.len());
        assert!(main_loop.is_empty());
    }
}
