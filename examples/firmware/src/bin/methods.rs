//! Runs every method with every setting on the impact of Brach & Dunn (1995), Table 1, and prints one line for each:
//! task, method, setting, number type, restitution, tangential velocity, spin and instructions, separated by
//! semicolons.
//!
//! Counts are instructions, not cycles: a division or a square root counts 1, and
//! there are no wait states. Runs in QEMU, with `-icount`.

#![no_std]
#![no_main]

use core::fmt::{self, Display};
use core::hint::black_box;

use microimpact_firmware::entry;
use microimpact_firmware::methods::inputs::TABLE_1;
use microimpact_firmware::methods::{Contestant, Extent, Number, Reply, Visitor, visit, visit_fixed_point};

use measurement::{Measurement, hprintln};

/// As many steps as the counter holds where a division takes hundreds of instructions.
const EXTENT: Extent = Extent { most_steps: 1024, sparse: false };

#[entry]
fn main() -> ! {
    measurement::run(|measurement| {
        let counted = &mut Counted(measurement);
        visit::<f32>(&TABLE_1, EXTENT, counted);
        visit::<f64>(&TABLE_1, EXTENT, counted);
        visit_fixed_point(&TABLE_1, EXTENT, counted);
    })
}

/// Counts the instructions of every method.
struct Counted<'a>(&'a mut Measurement);

impl Visitor for Counted<'_> {
    fn visit<T: Number>(&mut self, contestant: Contestant, mut run: impl FnMut() -> Option<Reply<T>> + 'static) {
        let reply = run().map(|reply| (reply.restitution.value(), reply.surface.map(|surface| surface.map(T::value))));
        let instructions = self.0.counter.count(|| call(&mut run));
        print(&contestant, T::NAME, reply, instructions);
    }
}

// Not inlined: a call, as an instrument's firmware would make it, is part of the count.
#[inline(never)]
fn call<T: Number>(run: &mut impl FnMut() -> Option<Reply<T>>) {
    black_box(run());
}

/// The line of a contestant, with nothing where there is no number.
#[inline(never)]
fn print(contestant: &Contestant, scalar: &str, reply: Option<(f64, Option<[f64; 2]>)>, instructions: u32) {
    let restitution = Digits(reply.map(|(restitution, _)| restitution));
    let [velocity, spin] = match reply {
        Some((_, Some(surface))) => surface.map(|value| Digits(Some(value))),
        _ => [Digits(None), Digits(None)],
    };
    let (task, method) = (contestant.task.name(), contestant.method);
    hprintln!("{task};{method};{contestant};{scalar};{restitution};{velocity};{spin};{instructions}");
}

/// A number with all its digits, or nothing.
struct Digits(Option<f64>);

impl Display for Digits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |number| write!(f, "{number:e}"))
    }
}
