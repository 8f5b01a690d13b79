//! Runs a calibration and prints one line, with what it found and what that took: `calibration key=value key=value ...`.

use core::fmt::{self, Display, LowerExp};
use core::hint::black_box;

use microimpact::measure::CalibrationError;
use microimpact_scenes::calibrations::{Calibration, CalibrationVisitor};
use microimpact_scenes::scenes::Number;

use crate::{Measurement, fail, hprintln, stack};

impl CalibrationVisitor for Measurement {
    fn visit<T: Number, C: Calibration<T>>(&mut self) {
        let Some(measured) = set_up::<T, C>() else {
            fail(C::NAME);
        };
        let work = || {
            black_box(&calibrate(black_box(&measured)));
        };
        let Ok(answer) = calibrate(&measured) else {
            fail(C::NAME);
        };
        let Some(bytes) = stack::used(work) else {
            fail("a calibration needs more stack than can be measured");
        };
        hprintln!(
            "calibration scene={} scalar={} values={} instructions={} stack={}",
            C::NAME,
            T::NAME,
            Values(answer.as_ref()),
            self.counter.count(work),
            bytes,
        );
        let code: fn() = code::<T, C>;
        hprintln!("code scene={} scalar={} address={}", C::NAME, T::NAME, black_box(code) as usize);
    }
}

/// Never called: what it refers to is the code of a calibration.
#[inline(never)]
fn code<T: Number, C: Calibration<T>>() {
    if let Some(measured) = set_up::<T, C>() {
        black_box(&calibrate(black_box(&measured)));
    }
}

#[inline(never)]
fn set_up<T: Number, C: Calibration<T>>() -> Option<C> {
    C::new()
}

// Not inlined: a call, as an instrument's firmware would make it, is part of the count.
#[inline(never)]
fn calibrate<T: Number, C: Calibration<T>>(measured: &C) -> Result<C::Answer, CalibrationError> {
    measured.calibrate()
}

/// Numbers with all their digits.
struct Values<'a, T>(&'a [T]);

impl<T: LowerExp> Display for Values<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, value) in self.0.iter().enumerate() {
            if index > 0 {
                f.write_str(",")?;
            }
            value.fmt(f)?;
        }
        Ok(())
    }
}
