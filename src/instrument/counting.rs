//! Events in time: what an instrument loses while it is dead, and how often particles coincide.

use crate::measure::Estimate;
use crate::{InputError, Parameter, Real};

/// What happens to an event that arrives.
///
/// ```
/// use microimpact::instrument::{Arrival, EventCounter};
///
/// let mut counter = EventCounter::new(0, 100, 20);
/// assert_eq!([10, 25, 60, 110].map(|ticks| counter.arrive(ticks)), [
///     Arrival::Recorded,
///     Arrival::Coincident,
///     Arrival::Dead,
///     Arrival::Recorded,
/// ]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Arrival {
    /// The event is to be classified.
    Recorded,
    /// The event lies within the coincidence window of the recorded event before it. Both signals overlap, so that the reading
    /// of the recorded event is doubtful too.
    Coincident,
    /// The event lies within the dead time of the recorded event before it.
    Dead,
}

/// Counts of events by what happened to them.
///
/// ```
/// use microimpact::instrument::{EventCounter, EventCounts};
///
/// let mut counter = EventCounter::new(0, 100, 20);
/// counter.arrive(5);
/// counter.arrive(50);
/// assert_eq!(counter.counts(), EventCounts { recorded: 1, coincident: 0, dead: 1 });
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventCounts {
    /// [`Arrival::Recorded`].
    pub recorded: u64,
    /// [`Arrival::Coincident`].
    pub coincident: u64,
    /// [`Arrival::Dead`].
    pub dead: u64,
}

/// Counts events by their time stamps, with integers alone. It imposes a dead time that does not grow with events that
/// arrive in it (non-paralysable).
///
/// A detector has a dead time of its own, which may vary. An imposed dead time that is longer is known exactly, so that
/// [`corrected_rate`] is exact too. The counter of the clock may wrap around between two calls once.
///
/// ```
/// use microimpact::instrument::{Arrival, EventCounter};
///
/// let mut counter = EventCounter::new(u32::MAX - 9, 100, 0);
/// assert_eq!(counter.arrive(u32::MAX), Arrival::Recorded);
/// assert_eq!(counter.arrive(89), Arrival::Dead); // 90 ticks later
/// assert_eq!(counter.elapsed(), 99);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventCounter {
    dead_ticks: u32,
    window_ticks: u32,
    latest: u32,
    elapsed: u64,
    recorded_at: Option<u64>,
    counts: EventCounts,
}

impl EventCounter {
    /// Creates a counter that observes from the time `start` on, with a dead time and a coincidence window in ticks.
    ///
    /// A coincident event is not recorded, so that the longer of both is the dead time for [`corrected_rate`].
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::EventCounter::new(7, 100, 20).elapsed(), 0);
    /// ```
    pub const fn new(start: u32, dead_ticks: u32, window_ticks: u32) -> Self {
        let counts = EventCounts { recorded: 0, coincident: 0, dead: 0 };
        Self { dead_ticks, window_ticks, latest: start, elapsed: 0, recorded_at: None, counts }
    }

    /// Observes until the time `ticks` without an event. Call it at least once while the clock's counter goes around.
    ///
    /// ```
    /// let mut counter = microimpact::instrument::EventCounter::new(0, 100, 20);
    /// for ticks in [1 << 31, 0, 1 << 31] {
    ///     counter.wait(ticks);
    /// }
    /// assert_eq!(counter.elapsed(), 3 << 31);
    /// ```
    #[inline]
    pub fn wait(&mut self, ticks: u32) {
        self.elapsed = self.elapsed.saturating_add(u64::from(ticks.wrapping_sub(self.latest)));
        self.latest = ticks;
    }

    /// Counts an event that arrives at the time `ticks`. Events must arrive in the order of their times.
    ///
    /// ```
    /// use microimpact::instrument::{Arrival, EventCounter};
    ///
    /// assert_eq!(EventCounter::new(0, 100, 20).arrive(1), Arrival::Recorded);
    /// ```
    #[inline]
    pub fn arrive(&mut self, ticks: u32) -> Arrival {
        self.wait(ticks);
        let since = self.recorded_at.map_or(u64::MAX, |recorded_at| self.elapsed - recorded_at);
        let (arrival, count) = if since < u64::from(self.window_ticks) {
            (Arrival::Coincident, &mut self.counts.coincident)
        } else if since < u64::from(self.dead_ticks) {
            (Arrival::Dead, &mut self.counts.dead)
        } else {
            self.recorded_at = Some(self.elapsed);
            (Arrival::Recorded, &mut self.counts.recorded)
        };
        *count = count.saturating_add(1);
        arrival
    }

    /// Ticks since the start of the observation.
    ///
    /// ```
    /// let mut counter = microimpact::instrument::EventCounter::new(10, 100, 20);
    /// counter.arrive(25);
    /// assert_eq!(counter.elapsed(), 15);
    /// ```
    #[inline]
    pub fn elapsed(&self) -> u64 {
        self.elapsed
    }

    /// Counts of all events.
    ///
    /// ```
    /// assert_eq!(microimpact::instrument::EventCounter::new(0, 100, 20).counts().recorded, 0);
    /// ```
    #[inline]
    pub fn counts(&self) -> EventCounts {
        self.counts
    }
}

/// Rate of the events that arrived, and the number that was not recorded.
///
/// ```
/// use microimpact::instrument::corrected_rate;
/// use microimpact::measure::Estimate;
///
/// let rate = corrected_rate(1000, 10.0, &Estimate { value: 1e-3, standard_error: 0.0 })?;
/// assert!(rate.lost.value > rate.lost.standard_error);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EventRate<T> {
    /// Rate of all events, 1/s.
    pub rate: Estimate<T>,
    /// Number of events that were lost in dead times.
    pub lost: Estimate<T>,
}

/// Corrects the number of `recorded` events in an `observation` time (s) for a non-paralysable `dead_time` (s).
///
/// With the measured rate r = n/t, the rate of all events is r/(1 - r tau). Its relative standard error is 1/sqrt(n), and r/(1 - r
/// tau) times the error of tau (J. W. Müller, Nucl. Instrum. Methods 112:47, 1973). The events must arrive independently, at a
/// constant rate. A reading that found the [`Queue`](super::Queue) full was recorded: add [`lost`](super::Receiver::lost).
/// Without events, the standard error of the rate is 1/t.
///
/// # Errors
/// A value is outside its range, or the instrument was dead for more than 0.9 of the time.
///
/// ```
/// use microimpact::instrument::corrected_rate;
/// use microimpact::measure::Estimate;
///
/// // Dead for a tenth of the time.
/// let corrected = corrected_rate(1000, 10.0, &Estimate { value: 1e-3, standard_error: 0.0 })?;
/// assert!((corrected.rate.value - 100.0 / 0.9_f64).abs() < 1e-9);
/// assert!((corrected.lost.value - 1000.0 / 9.0).abs() < 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
pub fn corrected_rate<T: Real>(
    recorded: u64,
    observation: T,
    dead_time: &Estimate<T>,
) -> Result<EventRate<T>, InputError> {
    let observation = Parameter::ObservationTime.check(observation)?;
    let tau = Parameter::Duration.check(dead_time.value)?;
    let tau_error = Parameter::StandardError.check(dead_time.standard_error)?;
    let count = T::constant(recorded as f64);
    let measured = count / observation;
    let dead = Parameter::DeadFraction.check(measured * tau)?;
    let rate = measured / (T::ONE - dead);
    // Without events, the error of one event.
    let counting = rate.max(T::ONE / observation) / count.max(T::ONE).sqrt();
    let timing = rate * rate * tau_error;
    let lost = count * rate * tau;
    // Given n, the lost events are Poisson distributed, and their mean has the error of the rate.
    let spread = count * tau * counting;
    let lost_timing = timing * observation;
    Ok(EventRate {
        rate: Estimate { value: rate, standard_error: (counting * counting + timing * timing).sqrt() },
        lost: Estimate { value: lost, standard_error: (lost + spread * spread + lost_timing * lost_timing).sqrt() },
    })
}

/// Below this mean number of events, three terms of the series of 1 - exp(-x) have a relative error of 4e-8, and the difference
/// itself loses digits.
const SERIES_BELOW: f64 = 0.01;

impl<T: Real> EventRate<T> {
    /// Probability that another event follows within a `window` (s), so that both coincide: 1 - exp(-rate window).
    ///
    /// # Errors
    /// The window is outside the range of durations.
    ///
    /// ```
    /// use microimpact::instrument::corrected_rate;
    /// use microimpact::measure::Estimate;
    ///
    /// let rate = corrected_rate(1000, 10.0, &Estimate { value: 0.0, standard_error: 0.0 })?;
    /// assert!((rate.coincidence(1e-4)? - 0.00995_f64).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn coincidence(&self, window: T) -> Result<T, InputError> {
        let mean = self.rate.value * Parameter::Duration.check(window)?;
        if mean < T::constant(SERIES_BELOW) {
            let half = T::constant(0.5) * mean;
            return Ok(mean * (T::ONE - half * (T::ONE - mean / T::constant(3.0))));
        }
        Ok(T::ONE - (-mean).exp())
    }
}
