//! The board, LM3S6965 evaluation kit: what changes on another one.

use core::convert::Infallible;

use embedded_hal::digital::{ErrorType, OutputPin};
use microimpact_firmware::station::CLASSES;

/// A register, which the processor reads and writes as one word.
#[derive(Clone, Copy)]
struct Register(usize);

impl Register {
    fn read(self) -> u32 {
        // SAFETY: an address of this file, of a register that is aligned and there on this board.
        unsafe { (self.0 as *const u32).read_volatile() }
    }

    fn write(self, value: u32) {
        // SAFETY: as for reading; the registers here steer ports and the UART, not memory.
        unsafe { (self.0 as *mut u32).write_volatile(value) }
    }

    fn set(self, bits: u32) {
        self.write(self.read() | bits);
    }
}

// System control: clocks of the UART and of ports A and B.
const CLOCK_SOURCE: Register = Register(0x400f_e060);
const CLOCK_UARTS: Register = Register(0x400f_e104);
const CLOCK_PORTS: Register = Register(0x400f_e108);

// Port A: receiver and transmitter on the lowest two pins.
const PORT_A_FUNCTION: Register = Register(0x4000_4420);
const PORT_A_DIGITAL: Register = Register(0x4000_451c);

// Port B: the class lines on the lowest pins. Address bits 2 to 9 say which pins a write is meant for.
const PORT_B_DATA: usize = 0x4000_5000;
const PORT_B_DIRECTION: Register = Register(0x4000_5400);
const PORT_B_DIGITAL: Register = Register(0x4000_551c);

// UART 0, a PL011.
const DATA: Register = Register(0x4000_c000);
const FLAGS: Register = Register(0x4000_c018);
const BAUD_WHOLE: Register = Register(0x4000_c024);
const BAUD_64THS: Register = Register(0x4000_c028);
const LINE_CONTROL: Register = Register(0x4000_c02c);
const CONTROL: Register = Register(0x4000_c030);
const INTERRUPTS: Register = Register(0x4000_c038);
const INTERRUPT_CLEAR: Register = Register(0x4000_c044);
const RECEIVER_EMPTY: u32 = 1 << 4;
const TRANSMITTER_FULL: u32 = 1 << 5;
/// A filling receiver, and one that has stood still with bytes in it.
const RECEIVED: u32 = 1 << 4 | 1 << 6;

/// The receiving half of the UART.
pub(crate) struct SerialInput(());

/// The sending half of the UART.
pub(crate) struct SerialOutput(());

/// A pin of port B.
pub(crate) struct Line {
    data: Register,
}

/// Starts clocks, lines and the UART: 115200 baud, 8 bits, no parity, from the crystal of 8 MHz.
pub(crate) fn start() -> (SerialInput, SerialOutput, [Line; CLASSES]) {
    let pins = (1 << CLASSES) - 1;
    // Main oscillator without the PLL.
    CLOCK_SOURCE.write((CLOCK_SOURCE.read() & !0x0040_07f1) | 0x0000_0b80);
    CLOCK_UARTS.set(1);
    CLOCK_PORTS.set(0b11);
    // A clock that has just been started takes some cycles to arrive.
    CLOCK_PORTS.read();
    PORT_A_FUNCTION.set(0b11);
    PORT_A_DIGITAL.set(0b11);
    PORT_B_DIRECTION.set(pins);
    PORT_B_DIGITAL.set(pins);
    // Off, and without its buffer: what is left in it from before a reset is not for this run.
    CONTROL.write(0);
    LINE_CONTROL.write(0);
    BAUD_WHOLE.write(4);
    BAUD_64THS.write(22);
    LINE_CONTROL.write(0b0111_0000);
    INTERRUPTS.write(RECEIVED);
    CONTROL.write(0b11_0000_0001);
    let lines = core::array::from_fn(|pin| Line { data: Register(PORT_B_DATA + (4 << pin)) });
    (SerialInput(()), SerialOutput(()), lines)
}

impl SerialInput {
    /// Ends the interrupt that has been served.
    pub(crate) fn acknowledge(&mut self) {
        INTERRUPT_CLEAR.write(RECEIVED);
    }

    /// A byte, if one waits. One that was damaged or lost on the line makes its frame's checksum fail.
    pub(crate) fn read(&mut self) -> Option<u8> {
        (FLAGS.read() & RECEIVER_EMPTY == 0).then(|| DATA.read() as u8)
    }
}

impl SerialOutput {
    /// Sends bytes, and waits where the line is slower.
    pub(crate) fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            while FLAGS.read() & TRANSMITTER_FULL != 0 {}
            DATA.write(byte.into());
        }
    }
}

impl ErrorType for Line {
    type Error = Infallible;
}

impl OutputPin for Line {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.data.write(0);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.data.write(u32::MAX);
        Ok(())
    }
}
