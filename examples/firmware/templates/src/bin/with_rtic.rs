//! A firmware within RTIC: the interrupt of a timer reads the sensor, the idle task classifies and counts.

#![no_std]
#![no_main]

use panic_halt as _;

/// In place of `lm3s6965` the device crate of your processor.
#[rtic::app(device = lm3s6965, peripherals = false)]
mod app {
    use cortex_m::peripheral::syst::SystClkSource;
    use cortex_m_semihosting::{debug, hprintln};
    use microimpact::Class;
    use microimpact::instrument::{ClassSet, PlanarReading, Queue, Receiver, Sender};
    use microimpact_templates::{Counter, READINGS, counter, read_sensor};

    /// Ticks of the timer between two readings.
    const PERIOD: u32 = 20_000;

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        sender: Sender<'static, PlanarReading<f32>>,
        receiver: Receiver<'static, PlanarReading<f32>>,
        counter: Counter,
    }

    #[init(local = [queue: Queue<PlanarReading<f32>, 16> = Queue::new()])]
    fn init(context: init::Context) -> (Shared, Local) {
        let Ok(counter) = counter() else { panic!("a value of the scene is outside its range") };
        let (sender, receiver) = context.local.queue.split();
        let mut timer = context.core.SYST;
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(PERIOD);
        timer.clear_current();
        timer.enable_counter();
        timer.enable_interrupt();
        (Shared {}, Local { sender, receiver, counter })
    }

    /// Your sensor's interrupt.
    #[task(binds = SysTick, local = [sender, number: u32 = 0], priority = 1)]
    fn sense(context: sense::Context) {
        let sense::LocalResources { sender, number, .. } = context.local;
        if *number < READINGS {
            // A reading that finds the queue full is counted by it.
            let _ = sender.send(read_sensor(*number));
            *number += 1;
        }
    }

    #[idle(local = [receiver, counter])]
    fn idle(context: idle::Context) -> ! {
        let idle::LocalResources { receiver, counter, .. } = context.local;
        let mut received = 0;
        while received + receiver.lost() < READINGS {
            match receiver.receive() {
                Some(reading) => {
                    // A reading that is refused is counted by the tally.
                    let _ = counter.process(&reading);
                    received += 1;
                }
                // An interrupt that comes between the question and the sleep ends the sleep at once, although it runs after it.
                None => cortex_m::interrupt::free(|_| {
                    if receiver.is_empty() {
                        cortex_m::asm::wfi();
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
}
