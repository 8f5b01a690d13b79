//! Exact instruction counts in an emulator whose register `minstret` follows its clock, if an instruction takes 1 ns
//! (QEMU with `-icount shift=0`).
//!
//! These are instructions, not cycles: a division counts 1, and there are no wait states.

use core::arch::asm;

use riscv::register::minstret;

const INSTRUCTIONS_PER_TURN: u32 = 2;

/// A counter of instructions, made from the processor's own.
pub struct Counter {
    /// What a measurement with nothing in it shows.
    empty: u32,
}

impl Counter {
    /// Finds out what a measurement itself takes, and whether counts are exact.
    ///
    /// `None` where they are not, as in an emulator without `-icount shift=0`.
    pub fn new() -> Option<Self> {
        let around = looping(1);
        let exact = [1, 10, 100, 1000, 10_000, 3_000_000].iter().all(|&turns| {
            let more = looping(turns + 1).wrapping_sub(around);
            more == INSTRUCTIONS_PER_TURN * turns
        });
        exact.then(|| Self { empty: read(|| ()) })
    }

    /// Instructions that `work` takes, up to 2^32.
    ///
    /// `work` must pass its inputs and its result through
    /// [`black_box`](core::hint::black_box), or the compiler may take it out of
    /// the measurement.
    pub fn count(&mut self, work: impl FnOnce()) -> u32 {
        read(work).saturating_sub(self.empty)
    }
}

// One machine code for every number of turns, so that the difference is turns alone.
#[inline(never)]
fn looping(turns: u32) -> u32 {
    read(|| {
        // SAFETY: counts a register down and touches nothing else.
        unsafe {
            asm!(
                "2: addi {turns}, {turns}, -1",
                "bnez {turns}, 2b",
                turns = inout(reg) turns => _,
                options(nomem, nostack),
            );
        }
    })
}

fn read(work: impl FnOnce()) -> u32 {
    let start = now();
    work();
    now().wrapping_sub(start)
}

// A call, so that the way to the register is the same in every measurement.
#[inline(never)]
fn now() -> u32 {
    minstret::read() as u32
}
