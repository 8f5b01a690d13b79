//! The body of the binaries that measure: classifies every impact in every scene of a list and prints one line for each,
//! with class, margins, restitution and cost: `word key=value key=value ...`.
//!
//! Counts are instructions, not cycles: a division or a square root counts 1, and
//! there are no wait states. Runs in QEMU, with `-icount`.

#![no_std]

use core::fmt::{self, Display, LowerExp};
use core::hint::black_box;
use core::panic::PanicInfo;

use microimpact_scenes::scenes::{Answer, Measured, Number, Scene, Visitor};

#[cfg(target_arch = "arm")]
use arm as processor;
pub use processor::{Counter, hprintln};
use processor::{NO_COUNTER, stop};
#[cfg(target_arch = "riscv32")]
use riscv32 as processor;

#[cfg(target_arch = "arm")]
mod arm;
mod calibration;
#[cfg(target_arch = "riscv32")]
mod riscv32;
pub mod stack;

/// Measures the scenes that `visit` goes through, and ends the emulation.
pub fn run(visit: impl FnOnce(&mut Measurement)) -> ! {
    let Some(counter) = Counter::new() else {
        fail(NO_COUNTER);
    };
    visit(&mut Measurement { counter });
    hprintln!("done");
    stop(true)
}

/// What measures a scene, or a calibration.
pub struct Measurement {
    /// Counts the instructions of a call.
    pub counter: Counter,
}

impl Measurement {
    /// Counts the instructions of one classification, and prints them.
    pub fn count<T: Number, S: Scene<T>>(&mut self, impact: &str) {
        let impact = S::impacts().find(|known| known.name == impact);
        let motion = set_up::<T, S>().zip(impact).and_then(|(scene, impact)| {
            let motion = scene.motion(&Measured::from(impact))?;
            Some((scene, impact, motion))
        });
        let Some((scene, impact, motion)) = motion else {
            fail(S::NAME);
        };
        let instructions = self.counter.count(|| classify(black_box(&scene), black_box(&motion)));
        hprintln!("{};{};{};{}", S::NAME, T::NAME, impact.name, instructions);
    }
}

impl Visitor for Measurement {
    fn visit<T: Number, S: Scene<T>>(&mut self) {
        let Some(scene) = set_up::<T, S>() else {
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
        let code: fn(&Measured<T>) = code::<T, S>;
        hprintln!("code scene={} scalar={} address={}", S::NAME, T::NAME, black_box(code) as usize);
    }
}

#[inline(never)]
fn set_up<T: Number, S: Scene<T>>() -> Option<S> {
    S::new()
}

/// Never called: what it refers to is the code of a scene. The address of a function that is counted must not be taken, or the
/// compiler would have to leave it a plain interface.
#[inline(never)]
fn code<T: Number, S: Scene<T>>(measured: &Measured<T>) {
    if let Some(scene) = set_up::<T, S>() {
        set_up_and_classify(black_box(&scene), measured);
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

/// Ends the emulation for a reason.
pub fn fail(reason: &str) -> ! {
    hprintln!("error: {}", reason);
    stop(false)
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    hprintln!("error: {}", info);
    stop(false)
}
