//! What a Cortex-M does in its own way.

use core::arch::asm;

use cortex_m_rt::{ExceptionFrame, exception};
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
pub use cortex_m_semihosting::hprintln;

pub use counter::Counter;

mod counter;

/// Why there is no counter.
pub(crate) const NO_COUNTER: &str = "the timer does not follow the instructions; run this in QEMU with -icount shift=8";

/// Ends the emulation.
pub(crate) fn stop(success: bool) -> ! {
    debug::exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::nop();
    }
}

/// Fills so many bytes below the stack pointer with a word and returns the stack pointer.
// Inlined and in assembly: a frame of its own would be in the way of the paint.
#[inline(always)]
pub(crate) fn paint(word: u32, bytes: u32) -> u32 {
    let top: u32;
    // SAFETY: writes words of RAM below the stack pointer, where nothing lives. There
    // is no `nostack` in the options, so the compiler keeps nothing there either.
    unsafe {
        asm!(
            "mov {top}, sp",
            "subs {address}, {top}, {address}",
            "2: str {word}, [{address}]",
            "adds {address}, {address}, #4",
            "cmp {address}, {top}",
            "bne 2b",
            top = out(reg) top,
            address = inout(reg) bytes => _,
            word = in(reg) word,
        );
    }
    top
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    hprintln!("error: hard fault at {:#010x}", frame.pc());
    stop(false)
}
