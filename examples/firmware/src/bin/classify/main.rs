//! Classifies every impact in every scene and prints one line for each, with
//! class, margins, restitution and cost: `word key=value key=value ...`.
//!
//! Counts are instructions, not cycles: a division or a square root counts 1, and
//! there are no wait states. Runs in QEMU, with `-icount shift=8`.

#![no_std]
#![no_main]

use core::fmt::{self, Display, LowerExp};
use core::hint::black_box;
use core::panic::PanicInfo;

use cortex_m_rt::{ExceptionFrame, entry, exception};
use cortex_m_semihosting::debug::{self, EXIT_FAILURE, EXIT_SUCCESS};
use cortex_m_semihosting::hprintln;
use microimpact_firmware::scenes::{Answer, Measured, Number, Scene, Visitor, visit_scenes};

use counter::Counter;

mod counter;
mod stack;

#[entry]
fn main() -> ! {
    let Some(counter) = cortex_m::Peripherals::take().and_then(|board| Counter::new(board.SYST)) else {
        fail("the timer does not follow the instructions; run this in QEMU with -icount shift=8");
    };
    visit_scenes(&mut Measurement { counter });
    hprintln!("done");
    stop(true)
}

struct Measurement {
    counter: Counter,
}

impl Visitor for Measurement {
    fn visit<T: Number, S: Scene<T>>(&mut self) {
        let Some(scene) = S::new() else {
            fail(S::NAME);
        };
        let mut deepest = 0;
        for impact in S::impacts() {
            let measured = Measured::from(impact);
            let Some(motion) = scene.motion(&measured) else {
                fail(impact.name);
            };
            let classification = || classify(black_box(&scene), black_box(&motion));
            let with_set_up = || set_up_and_classify(black_box(&scene), black_box(&measured));

            let answer: Answer<T> = scene.classify(&motion).into();
            hprintln!(
                "impact scene={} scalar={} impact={} class={} speed_margin={} friction_margin={} \
                 restitution={} instructions={} with_set_up={}",
                S::NAME,
                T::NAME,
                impact.name,
                answer.class,
                Digits(answer.speed_margin),
                Digits(answer.friction_margin),
                Digits(answer.restitution),
                self.counter.count(classification),
                self.counter.count(with_set_up),
            );
            match stack::used(classification) {
                Some(bytes) => deepest = bytes.max(deepest),
                None => fail("a classification needs more stack than can be measured"),
            }
        }
        hprintln!("stack scene={} scalar={} bytes={}", S::NAME, T::NAME, deepest);
    }
}

// Not inlined: a call, as an instrument's firmware would make it, is part of the count.
#[inline(never)]
fn classify<T: Number, S: Scene<T>>(scene: &S, motion: &S::Motion) {
    let verdict = scene.classify(motion);
    black_box(&verdict);
}

#[inline(never)]
fn set_up_and_classify<T: Number, S: Scene<T>>(scene: &S, measured: &Measured<T>) {
    if let Some(motion) = scene.motion(measured) {
        let verdict = scene.classify(&motion);
        black_box(&verdict);
    }
}

/// A number with all its digits, so that the host can compare the last bit.
struct Digits<T>(Option<T>);

impl<T: LowerExp> Display for Digits<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Some(number) => number.fmt(f),
            None => f.write_str("none"),
        }
    }
}

fn fail(reason: &str) -> ! {
    hprintln!("error: {reason}");
    stop(false)
}

fn stop(success: bool) -> ! {
    debug::exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    loop {
        cortex_m::asm::nop();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    hprintln!("error: {info}");
    stop(false)
}

#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    hprintln!("error: hard fault at {:#010x}", frame.pc());
    stop(false)
}
