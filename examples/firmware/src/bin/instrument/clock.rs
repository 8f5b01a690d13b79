//! How long the processor was awake, in ticks of SysTick.

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

const MASK: u32 = 0x00ff_ffff;

/// A sum of ticks, which must be brought up to date before the timer has gone round.
pub(crate) struct Clock {
    awake: u64,
    latest: u32,
}

impl Clock {
    /// Starts the timer, which this clock alone reads.
    pub(crate) fn new(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(MASK);
        timer.clear_current();
        timer.enable_counter();
        Self { awake: 0, latest: SYST::get_current() }
    }

    /// Ticks until now that the processor was awake.
    pub(crate) fn awake(&mut self) -> u64 {
        self.tick();
        self.awake
    }

    /// Brings the sum up to date.
    pub(crate) fn tick(&mut self) {
        let now = SYST::get_current();
        // The timer counts down.
        self.awake += u64::from(self.latest.wrapping_sub(now) & MASK);
        self.latest = now;
    }

    /// A sleep that does not count.
    pub(crate) fn pause(&mut self, sleep: impl FnOnce()) {
        self.tick();
        sleep();
        self.latest = SYST::get_current();
    }
}
