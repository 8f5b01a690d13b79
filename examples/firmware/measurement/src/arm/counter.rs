//! Exact instruction counts in an emulator whose clock advances by a fixed time
//! per instruction (QEMU with `-icount shift=8`).
//!
//! These are instructions, not cycles: a division or a square root counts 1, and
//! there are no wait states.

use core::arch::{asm, naked_asm};
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// Turns of the loop that shows how many ticks an instruction takes. So many that
/// a tick more or less there is nothing in a count of ten millions.
const CALIBRATION_TURNS: u32 = 1 << 22;
const INSTRUCTIONS_PER_TURN: u32 = 2;

/// How often the timer, which has 24 bits only, has started anew.
static ROUNDS: AtomicU32 = AtomicU32::new(0);
/// Instructions of [`SysTick`], which are taken off a count.
const INSTRUCTIONS_PER_ROUND: u32 = 5;

/// The exception of SysTick, in assembly so that the number of its instructions is known.
// SAFETY: the runtime knows the exception by this name; no other symbol has it.
#[unsafe(no_mangle)]
#[unsafe(naked)]
extern "C" fn SysTick() {
    naked_asm!(
        "ldr r0, 2f",
        "ldr r1, [r0]",
        "adds r1, #1",
        "str r1, [r0]",
        "bx lr",
        ".p2align 2",
        "2: .word {rounds}",
        rounds = sym ROUNDS,
    )
}

/// A counter of instructions, made from the ticks of SysTick.
pub struct Counter {
    timer: SYST,
    /// Ticks of a measurement with nothing in it.
    empty: u32,
    /// Ticks of some instructions, and how many those are.
    calibration: (u32, u32),
}

/// What the timer shows after a piece of work.
#[derive(Clone, Copy)]
struct Reading {
    ticks: u32,
    rounds: u32,
}

impl Counter {
    /// Starts SysTick and finds out how many of its ticks an instruction takes; once.
    ///
    /// `None` where ticks do not follow instructions (on real hardware, or in an
    /// emulator without `-icount`), and where an instruction takes less than two
    /// ticks: too few to tell two counts apart for certain.
    pub fn new() -> Option<Self> {
        let mut timer = Peripherals::take()?.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(TIMER_MASK);
        timer.clear_current();
        timer.enable_counter();

        let mut counter = Self { timer, empty: 0, calibration: (1, 1) };
        counter.empty = counter.read(|| ()).ticks;
        let Reading { ticks, rounds } = counter.looped(CALIBRATION_TURNS);
        let instructions = INSTRUCTIONS_PER_TURN * CALIBRATION_TURNS + INSTRUCTIONS_PER_ROUND * rounds;
        counter.calibration = (ticks, instructions);

        let resolved = ticks > 2 * instructions;
        let exact = [1, 10, 100, 1000, 10_000, 3_000_000].iter().all(|&turns| {
            let reading = counter.looped(turns);
            counter.instructions(reading) == INSTRUCTIONS_PER_TURN * turns
        });
        (resolved && exact).then_some(counter)
    }

    /// Instructions that `work` takes, up to some ten millions.
    ///
    /// `work` must pass its inputs and its result through
    /// [`black_box`](core::hint::black_box), or the compiler may take it out of
    /// the measurement.
    pub fn count(&mut self, work: impl FnOnce()) -> u32 {
        let Reading { ticks, rounds } = self.read(work);
        self.instructions(Reading { ticks: ticks.saturating_sub(self.empty), rounds })
    }

    /// The nearest whole number of instructions, without those that count rounds.
    fn instructions(&self, reading: Reading) -> u32 {
        let (ticks, instructions) = (u64::from(self.calibration.0), u64::from(self.calibration.1));
        let total = (u64::from(reading.ticks) * instructions + ticks / 2) / ticks;
        (total as u32).saturating_sub(INSTRUCTIONS_PER_ROUND * reading.rounds)
    }

    /// `turns` turns of a loop, without what leads to it and away from it.
    fn looped(&mut self, turns: u32) -> Reading {
        let around = self.looping(1).ticks;
        let Reading { ticks, rounds } = self.looping(turns + 1);
        Reading { ticks: ticks.saturating_sub(around), rounds }
    }

    // One machine code for every number of turns, so that the difference is turns alone.
    #[inline(never)]
    fn looping(&mut self, turns: u32) -> Reading {
        self.read(|| {
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

    /// Ticks and rounds of a piece of work; outside of it the timer interrupts nothing.
    fn read(&mut self, work: impl FnOnce()) -> Reading {
        ROUNDS.store(0, Ordering::Relaxed);
        self.timer.clear_current();
        self.timer.enable_interrupt();
        let start = now();
        work();
        let end = now();
        self.timer.disable_interrupt();
        let rounds = ROUNDS.load(Ordering::Relaxed);
        // The timer counts down, modulo 2^24.
        let part = start.wrapping_sub(end) & TIMER_MASK;
        Reading { ticks: rounds * (TIMER_MASK + 1) + part, rounds }
    }
}

const TIMER_MASK: u32 = 0x00ff_ffff;

// A call, so that the way to the timer's register is the same in every measurement.
#[inline(never)]
fn now() -> u32 {
    SYST::get_current()
}
