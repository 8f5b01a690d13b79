//! The emulated boards, one for each processor core; what builds and runs their firmware, and the figures it yields.

// Every error is a sentence for the person who runs the command.
#![allow(clippy::missing_errors_doc)]

pub mod absent;
pub mod emulator;
pub mod figures;
pub mod firmware;
pub mod footprint;
pub mod packages;
pub mod process;
pub mod reachable;
pub mod section;
pub mod symbols;
pub mod toolchain;
pub mod without;

use emulator::{ARM, Emulator, RISCV32};

/// An emulated board and what the firmware must be built for.
pub struct Board {
    /// The processor core.
    pub core: &'static str,
    /// What runs it.
    pub emulator: Emulator,
    /// QEMU's name of the board.
    pub machine: &'static str,
    /// Rust's name of the target.
    pub triple: &'static str,
    /// The processor to optimise for, where it offers more than the target assumes.
    pub cpu: Option<&'static str>,
}

/// The core for which the library's promises of size and speed hold.
pub const REFERENCE_CORE: &str = "Cortex-M4F";

/// Every board of a run, by architecture and from the smallest core to the largest.
pub const BOARDS: [Board; 6] = [
    Board { core: "Cortex-M0", emulator: ARM, machine: "microbit", triple: "thumbv6m-none-eabi", cpu: None },
    C_BOARD,
    Board { core: REFERENCE_CORE, emulator: ARM, machine: "mps2-an386", triple: "thumbv7em-none-eabihf", cpu: None },
    Board {
        core: "Cortex-M7",
        emulator: ARM,
        machine: "mps2-an500",
        triple: "thumbv7em-none-eabihf",
        // The target alone assumes single precision; this core also has double.
        cpu: Some("cortex-m7"),
    },
    Board { core: "Cortex-M33", emulator: ARM, machine: "mps2-an505", triple: "thumbv8m.main-none-eabihf", cpu: None },
    Board { core: "RV32IMAC", emulator: RISCV32, machine: "virt", triple: "riscv32imac-unknown-none-elf", cpu: None },
];

/// The board of the C example, with a processor whose arithmetic in software gives the host's results to the last bit.
pub const C_BOARD: Board =
    Board { core: "Cortex-M3", emulator: ARM, machine: "mps2-an385", triple: "thumbv7m-none-eabi", cpu: None };

/// The board of the instrument, which has ports and a UART that its interrupts are named after.
pub const INSTRUMENT_BOARD: Board = Board { machine: "lm3s6965evb", ..C_BOARD };

/// The board of a processor without atomic instructions. Its emulator has them, but nothing for this target contains them.
pub const NO_ATOMICS_BOARD: Board =
    Board { core: "RV32IMC", emulator: RISCV32, machine: "virt", triple: "riscv32imc-unknown-none-elf", cpu: None };
