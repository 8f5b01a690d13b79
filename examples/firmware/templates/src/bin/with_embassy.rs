//! A firmware within Embassy: the interrupt of a timer reads the sensor and wakes the task that classifies and counts.

#![no_std]
#![no_main]

use core::cell::RefCell;
use core::future::poll_fn;
use core::task::Poll;

use cortex_m::interrupt::Mutex;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m::{Peripherals, interrupt, singleton};
use cortex_m_rt::exception;
use cortex_m_semihosting::{debug, hprintln};
use embassy_executor::Spawner;
use embassy_sync::waitqueue::AtomicWaker;
use microimpact::Class;
use microimpact::instrument::{ClassSet, PlanarReading, Queue, Receiver, Sender};
use microimpact_templates::{READINGS, counter, read_sensor};
use panic_halt as _;

/// The interrupt's end of the queue.
static SENDER: Mutex<RefCell<Option<Sender<'static, PlanarReading<f32>>>>> = Mutex::new(RefCell::new(None));

/// What the task waits by.
static ARRIVED: AtomicWaker = AtomicWaker::new();

/// Ticks of the timer between two readings.
const PERIOD: u32 = 20_000;

/// Your sensor's interrupt.
#[exception]
fn SysTick() {
    static mut NUMBER: u32 = 0;
    if *NUMBER < READINGS {
        let reading = read_sensor(*NUMBER);
        // A reading that finds the queue full is counted by it.
        interrupt::free(|section| {
            SENDER.borrow(section).borrow_mut().as_mut().map(|sender| sender.send(reading).is_ok())
        });
        ARRIVED.wake();
        *NUMBER += 1;
    }
}

/// The next reading; other tasks run until it arrives.
async fn next(receiver: &mut Receiver<'static, PlanarReading<f32>>) -> PlanarReading<f32> {
    poll_fn(|context| {
        // Before the question, so that no reading arrives unnoticed between the two.
        ARRIVED.register(context.waker());
        receiver.receive().map_or(Poll::Pending, Poll::Ready)
    })
    .await
}

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let (Ok(mut counter), Some(queue), Some(Peripherals { SYST: mut timer, .. })) =
        (counter(), singleton!(: Queue<PlanarReading<f32>, 16> = Queue::new()), Peripherals::take())
    else {
        panic!("a value of the scene is outside its range");
    };
    let (sender, mut receiver) = queue.split();
    interrupt::free(|section| SENDER.borrow(section).replace(Some(sender)));
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload(PERIOD);
    timer.clear_current();
    timer.enable_counter();
    timer.enable_interrupt();

    let mut received = 0;
    while received + receiver.lost() < READINGS {
        // A reading that is refused is counted by the tally.
        let _ = counter.process(&next(&mut receiver).await);
        received += 1;
    }
    for &class in Class::ALL {
        hprintln!("{}: {}", class, counter.tally().count(class));
    }
    hprintln!("refused: {}", counter.tally().rejections().total());
    hprintln!("lost: {}", receiver.lost());
    // Ends QEMU; without a debugger or QEMU leave out all output.
    debug::exit(debug::EXIT_SUCCESS);
}
