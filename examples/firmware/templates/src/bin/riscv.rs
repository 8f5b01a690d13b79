//! A firmware for RISC-V without atomic instructions (RV32IMC): the interrupt of a timer reads the sensor, the main loop classifies and
//! counts.

#![no_std]
#![no_main]

use core::cell::{Cell, RefCell};

use critical_section::Mutex;
use microimpact::Class;
use microimpact::instrument::{ClassSet, PlanarReading, Queue, Sender};
use microimpact_templates::{READINGS, counter, read_sensor};
use panic_halt as _;
// Its features choose what takes the place of atomic instructions.
use portable_atomic as _;
use riscv::interrupt::{self, Interrupt};
use riscv_rt::{core_interrupt, entry};
use riscv_semihosting::{debug, hprintln};
use static_cell::ConstStaticCell;

static QUEUE: ConstStaticCell<Queue<PlanarReading<f32>, 16>> = ConstStaticCell::new(Queue::new());

/// The interrupt's end of the queue.
static SENDER: Mutex<RefCell<Option<Sender<'static, PlanarReading<f32>>>>> = Mutex::new(RefCell::new(None));

/// The number of the next reading.
static NUMBER: Mutex<Cell<u32>> = Mutex::new(Cell::new(0));

/// Ticks of the timer between two readings.
const PERIOD: u32 = 200;

/// The timer of QEMU's board `virt`, and the time of its next interrupt; look up those of your processor.
const TIME: *const u32 = 0x0200_bff8 as *const u32;
const NEXT: *mut u32 = 0x0200_4000 as *mut u32;

/// Lets the timer interrupt after a period. The upper halves of both times stay zero for minutes.
fn wait() {
    // SAFETY: both are registers of the timer, which nothing else touches.
    unsafe {
        NEXT.add(1).write_volatile(0);
        NEXT.write_volatile(TIME.read_volatile().wrapping_add(PERIOD));
    }
}

/// Your sensor's interrupt.
#[core_interrupt(Interrupt::MachineTimer)]
fn timer() {
    critical_section::with(|section| {
        let number = NUMBER.borrow(section).get();
        if number < READINGS {
            // A reading that finds the queue full is counted by it.
            let reading = read_sensor(number);
            let _ = SENDER.borrow(section).borrow_mut().as_mut().map(|sender| sender.send(reading).is_ok());
            NUMBER.borrow(section).set(number + 1);
        }
    });
    wait();
}

#[entry]
fn main() -> ! {
    let (Ok(mut counter), Some(queue)) = (counter(), QUEUE.try_take()) else {
        panic!("a value of the scene is outside its range");
    };
    let (sender, mut receiver) = queue.split();
    critical_section::with(|section| SENDER.borrow(section).replace(Some(sender)));
    wait();
    // SAFETY: the interrupt shares with this function only what is in `Mutex`.
    unsafe {
        interrupt::enable_interrupt(Interrupt::MachineTimer);
        interrupt::enable();
    }

    let mut received = 0;
    while received + receiver.lost() < READINGS {
        match receiver.receive() {
            Some(reading) => {
                // A reading that is refused is counted by the tally.
                let _ = counter.process(&reading);
                received += 1;
            }
            // An interrupt that comes between the question and the sleep ends the sleep at once, although it runs after it.
            None => interrupt::free(|| {
                if receiver.is_empty() {
                    riscv::asm::wfi();
                }
            }),
        }
    }
    for &class in Class::ALL {
        hprintln!("{}: {}", class, counter.tally().count(class));
    }
    hprintln!("refused: {}", counter.tally().rejections().total());
    hprintln!("lost: {}", receiver.lost());
    loop {
        // Ends QEMU; without a debugger or QEMU leave out all output.
        debug::exit(debug::EXIT_SUCCESS);
    }
}
