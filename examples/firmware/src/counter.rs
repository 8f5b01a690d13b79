//! Exact instruction counts in an emulator whose clock advances by a fixed time
//! per instruction (QEMU with `-icount shift=8`).
//!
//! These are instructions, not cycles: a division or a square root counts 1, and
//! there are no wait states.

use core::arch::asm;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// Turns of the loop that shows how many ticks an instruction takes. So many that
/// a tick more or less there is nothing in a count of a hundred thousand.
const CALIBRATION_TURNS: u32 = 1 << 16;
const INSTRUCTIONS_PER_TURN: u32 = 2;

/// A counter of instructions, made from the ticks of SysTick.
pub struct Counter {
    /// Ticks of a measurement with nothing in it.
    empty: u32,
    /// Ticks of [`CALIBRATION_TURNS`].
    calibration: u32,
}

impl Counter {
    /// Starts SysTick and finds out how many of its ticks an instruction takes.
    ///
    /// `None` where ticks do not follow instructions (on real hardware, or in an
    /// emulator without `-icount`), and where an instruction takes less than two
    /// ticks: too few to tell two counts apart for certain.
    pub fn new(mut timer: SYST) -> Option<Self> {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(TIMER_MASK);
        timer.clear_current();
        timer.enable_counter();

        let counter = Self { empty: ticks(|| ()), calibration: loop_ticks(CALIBRATION_TURNS) };
        let resolved = counter.calibration > 2 * INSTRUCTIONS_PER_TURN * CALIBRATION_TURNS;
        let exact = [1, 10, 100, 1000, 10_000]
            .iter()
            .all(|&turns| counter.instructions(loop_ticks(turns)) == INSTRUCTIONS_PER_TURN * turns);
        (resolved && exact).then_some(counter)
    }

    /// Instructions that `work` takes, up to some hundred thousand.
    ///
    /// `work` must pass its inputs and its result through
    /// [`black_box`](core::hint::black_box), or the compiler may take it out of
    /// the measurement.
    pub fn count(&self, work: impl FnOnce()) -> u32 {
        self.instructions(ticks(work).saturating_sub(self.empty))
    }

    /// The nearest whole number of instructions.
    fn instructions(&self, ticks: u32) -> u32 {
        let calibration = u64::from(self.calibration);
        let product = u64::from(ticks) * u64::from(INSTRUCTIONS_PER_TURN * CALIBRATION_TURNS);
        ((product + calibration / 2) / calibration) as u32
    }
}

/// Ticks of `turns` turns of a loop, without what leads to it and away from it.
fn loop_ticks(turns: u32) -> u32 {
    looping(turns + 1).saturating_sub(looping(1))
}

// One machine code for every number of turns, so that the difference is turns alone.
#[inline(never)]
fn looping(turns: u32) -> u32 {
    ticks(|| {
        // SAFETY: counts a register down and touches nothing else.
        unsafe {
            asm!(
                "2: subs {turns}, {turns}, #1",
                "bne 2b",
                turns = inout(reg) turns => _,
                options(nomem, nostack),
            );
        }
    })
}

const TIMER_MASK: u32 = 0x00ff_ffff;

fn ticks(work: impl FnOnce()) -> u32 {
    let start = now();
    work();
    let end = now();
    // The timer counts down, modulo 2^24.
    start.wrapping_sub(end) & TIMER_MASK
}

// A call, so that the way to the timer's register is the same in every measurement.
#[inline(never)]
fn now() -> u32 {
    SYST::get_current()
}
