//! What a RISC-V processor does in its own way.

use core::arch::asm;

use riscv::register::{mcause, mepc};
use riscv_rt::TrapFrame;
use riscv_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
pub use riscv_semihosting::hprintln;

pub use counter::Counter;

mod counter;

/// Why there is no counter.
pub(crate) const NO_COUNTER: &str = "minstret does not count instructions; run this in QEMU with -icount shift=0";

/// Ends the emulation.
pub(crate) fn stop(success: bool) -> ! {
    debug::exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        riscv::asm::nop();
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
            "mv {top}, sp",
            "sub {address}, {top}, {address}",
            "2: sw {word}, 0({address})",
            "addi {address}, {address}, 4",
            "bne {address}, {top}, 2b",
            top = out(reg) top,
            address = inout(reg) bytes => _,
            word = in(reg) word,
        );
    }
    top
}

// SAFETY: the runtime knows the handler by this name; no other symbol has it.
#[unsafe(export_name = "ExceptionHandler")]
fn exception(_: &TrapFrame) -> ! {
    hprintln!("error: exception {} at {:#010x}", mcause::read().code(), mepc::read());
    stop(false)
}
