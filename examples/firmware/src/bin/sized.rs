//! An instrument that measures the size of each particle. Its interrupt handles integers alone: the ticks between two light
//! beams, and the samples of a piezo sensor. The main loop makes speed, size and class of them.
//!
//! `cargo run --release --features sized --bin sized` runs it in QEMU, with a timer in the place of the sensors.

#![no_std]
#![no_main]

use core::cell::RefCell;

use cortex_m::interrupt::Mutex;
use cortex_m::{Peripherals, interrupt, singleton};
use cortex_m_rt::{entry, exception};
use cortex_m_semihosting::{debug, hprintln};
use microimpact::instrument::sensor::{Clock, ImpulseSensor, PulseSum, Transit, radius_from_impulse};
use microimpact::instrument::{
    Arrival, ClassSet, Confident, EventCounter, Instrument, NoLines, Queue, Rejection, Sender, SizeBins, SizedTally,
    SpeedBins, Stamped, UncertainReading, corrected_rate,
};
use microimpact::measure::Estimate;
use microimpact::rigid::WorkOfAdhesion;
use microimpact::{Class, InputError, PlanarMotion, RigidBody, SpeedRestitution, Sphere};
use panic_halt as _;

/// What the interrupt stores: ticks between the beams, and a pulse.
type Event = Stamped<(u32, PulseSum)>;

/// The interrupt's end of the queue.
static SENDER: Mutex<RefCell<Option<Sender<'static, Event>>>> = Mutex::new(RefCell::new(None));

/// Stands for both sensors.
#[exception]
fn SysTick() {
    static mut EVENTS: u32 = 0;
    *EVENTS += 1;
    let random = EVENTS.wrapping_mul(2_654_435_769) >> 22;
    let mut pulse = PulseSum::new(2048);
    (0..32).for_each(|_| pulse.add(2068 + (random >> 5) as i32));
    // The queue counts an event for which it has no room.
    let event = Stamped { ticks: EVENTS.wrapping_mul(PERIOD), reading: (6000 + 16 * random, pulse) };
    interrupt::free(|section| SENDER.borrow(section).borrow_mut().as_mut().map(|sender| sender.send(event).is_ok()));
}

/// Ticks between two events.
const PERIOD: u32 = 100_000;
const CLOCK: f32 = 72e6;
const DENSITY: Estimate<f32> = Estimate { value: 2600.0, standard_error: 20.0 };
/// A velocity that is not measured: its mean and its spread.
const UNKNOWN: Estimate<f32> = Estimate { value: 0.0, standard_error: 0.1 };

/// Glass of any size on steel. The work of adhesion is proportional to the radius.
fn scene(radius: f32) -> Result<RigidBody<f32, SpeedRestitution<f32>, WorkOfAdhesion<f32>>, InputError> {
    RigidBody::new(Sphere::solid(radius, DENSITY.value)?, SpeedRestitution::new(130.0)?)
        .with_work_of_adhesion(4.4e-7 * radius)
}

#[entry]
fn main() -> ! {
    debug::exit(run().map_err(|_| hprintln!("the set-up or a reading is refused")));
    loop {
        cortex_m::asm::wfi();
    }
}

fn run() -> Result<(), Rejection> {
    let clock = Clock::new(&Estimate { value: CLOCK, standard_error: 720.0 }, 2.0)?;
    let beams = Transit::new(&Estimate { value: 280e-6, standard_error: 1e-6 }, clock)?;
    let piezo = ImpulseSensor::new(&Estimate { value: 2e-15, standard_error: 3e-17 }, 2.0, 0.05)?;
    let impact = |radius, motion: PlanarMotion<f32>| Ok((scene(radius)?.with_friction(0.1)?, motion));
    let (sizes, speeds) = (SizeBins::new([4e-6, 5e-6, 6e-6])?, SpeedBins::new([1.5, 2.0, 4.0])?);
    let mut instrument: Instrument<_, _, f32, 6, 3> = Instrument::new(Confident::new(0.9, impact)?, NoLines, speeds);
    let (mut tally, mut counter) = (SizedTally::<f32, 6, 3, 3>::new(sizes, speeds), EventCounter::new(0, 1000, 100));

    let Some(queue) = singleton!(: Queue<Event, 16> = Queue::new()) else { return Ok(()) };
    let Some(Peripherals { SYST: mut timer, .. }) = Peripherals::take() else { return Ok(()) };
    let (sender, mut receiver) = queue.split();
    interrupt::free(|section| SENDER.borrow(section).replace(Some(sender)));
    timer.set_reload(PERIOD);
    timer.enable_counter();
    timer.enable_interrupt();
    while counter.counts().recorded < 200 {
        let Some(event) = receiver.receive() else { continue };
        if counter.arrive(event.ticks) != Arrival::Recorded {
            continue;
        }
        let (transit, pulse) = event.reading;
        let approach = beams.speed(transit)?;
        let radius = radius_from_impulse(&piezo.impulse(&pulse)?, &approach, &DENSITY, scene)?.radius;
        let reading = UncertainReading { approach, tangential: UNKNOWN, peripheral: UNKNOWN, radius };
        if let Ok(verdict) = instrument.process(&reading) {
            tally.record(radius.value, approach.value, verdict.class, None)?;
        }
    }
    let dead_time = Estimate { value: 1000.0 / CLOCK, standard_error: 0.0 };
    let rate = corrected_rate(counter.counts().recorded, counter.elapsed() as f32 / CLOCK, &dead_time)?.rate;
    hprintln!("{} +- {} events/s, {} found no room", rate.value, rate.standard_error, receiver.lost());
    for &class in Class::ALL {
        let by_size = [0, 1, 2].map(|size| tally.cell(size, 1).map_or(0, |cell| cell.count(class)));
        hprintln!("{}: {} particles; by size at 1.5 to 2 m/s: {:?}", class, tally.total().count(class), by_size);
    }
    Ok(())
}
