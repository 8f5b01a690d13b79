//! Runs every method over the shared grid of impacts, and prints one line for each: method, number type, impacts, the most
//! instructions and the impact that takes them, the most bytes of stack and the impact that takes those, separated by semicolons.
//!
//! Counts are instructions, not cycles: a division or a square root counts 1, and
//! there are no wait states. Runs in QEMU, with `-icount`. `cargo qemu worst` writes the grid to the file that `MICROIMPACT_GRID`
//! names when this is built: numbers in f32, the least significant byte first.

#![no_std]
#![no_main]

use core::hint::black_box;

use measurement::{Measurement, fail, hprintln, stack};
use microimpact::contact::{
    Adaptive, Collocation, Contact, ErrorControl, FixedCost, Method, PaperScene, RungeKuttaGill, Slip,
};
use microimpact::{InputError, NormalMotion, ObliqueMotion, Real, Sphere, Stiffness};
use microimpact_firmware::entry;
use microimpact_firmware::scenes::Number;

/// Radius, stiffness, speed, damping of the materials, strength of the ring and damping of adhesion, in SI units.
type Impact = [f32; 6];

const GRID: &[u8] = include_bytes!(env!("MICROIMPACT_GRID"));

/// Density of all spheres, kg/m^3, and friction coefficient: those of the grid.
const DENSITY: f64 = 2600.0;
const FRICTION: f64 = 0.3;

/// Steps in the duration of Hertz's impact: few, because all take long.
const STEPS: u32 = 50;

#[entry]
fn main() -> ! {
    measurement::run(|measurement| {
        if let Err(error) = methods(&mut Grid(measurement)) {
            fail(error.parameter.name());
        }
    })
}

/// Every method, with the settings of the other measurements.
fn methods(grid: &mut Grid) -> Result<(), InputError> {
    let fixed = FixedCost::<4>::new(black_box(2))?;
    grid.normal::<f32>("FixedCost<4>, 2 iterations", &fixed);
    grid.normal::<f32>("FixedCost<5>, 3 iterations", &FixedCost::<5>::new(black_box(3))?);
    grid.normal::<f32>("FixedCost<7>, 3 iterations", &FixedCost::<7>::new(black_box(3))?);
    grid.oblique::<f32>("FixedCost<5, 7>, 3 iterations", &FixedCost::<5>::new(black_box(3))?.with_outputs::<7>());
    grid.oblique::<f32>("FixedCost<7, 9>, 3 iterations", &FixedCost::<7>::new(black_box(3))?.with_outputs::<9>());
    let (coarse, fine) = (Collocation::<5, f32>::new(black_box(3e-4))?, Collocation::<7, f32>::new(black_box(1e-6))?);
    grid.normal::<f32>("Collocation<5>, 3e-4", &coarse);
    grid.normal::<f32>("Collocation<7>, 1e-6", &fine);
    grid.normal::<f32>("Collocation<7>, 1e-6, 12 intervals", &fine.with_budget(black_box(12)));
    grid.sliding::<f32>("Collocation<7>, 1e-6", &fine);
    grid.critical::<f32>("Collocation<7>, 1e-6", &fine);
    let adaptive = Adaptive::new(black_box(1e-6_f32))?;
    grid.normal::<f32>("Adaptive, 1e-6", &adaptive);
    grid.sliding::<f32>("Adaptive, 1e-6", &adaptive);
    grid.normal::<f32>("RungeKuttaGill, 50 steps", &RungeKuttaGill::new(black_box(STEPS)));
    let double = Collocation::<9, f64>::new(black_box(1e-9))?;
    grid.normal::<f64>("Collocation<9>, 1e-9", &double);
    grid.sliding::<f64>("Collocation<9>, 1e-9", &double);
    Ok(())
}

/// Runs methods over the grid.
struct Grid<'a>(&'a mut Measurement);

impl Grid<'_> {
    /// The normal motion alone.
    fn normal<T: Number>(&mut self, method: &str, with: &impl Method<T>) {
        self.run(method, "normal", |scene: &Prepared<T>| {
            black_box(scene.contact.solve_normal(&scene.motion, black_box(with)).ok());
        });
    }

    /// Friction too.
    fn oblique<T: Number>(&mut self, method: &str, with: &impl Method<T>) {
        self.run(method, "oblique", |scene: &Prepared<T>| {
            black_box(scene.contact.solve(&scene.motion, black_box(with)).ok());
        });
    }

    /// Friction, and where slip ends.
    fn sliding<T: Number>(&mut self, method: &str, with: &impl Method<T>) {
        self.run(method, "oblique, with the end of slip", |scene: &Prepared<T>| {
            black_box(scene.contact.solve_for(&scene.motion, black_box(with), Slip).ok());
        });
    }

    /// The critical speed of the scene.
    fn critical<T: Number>(&mut self, method: &str, with: &impl ErrorControl<T>) {
        self.run(method, "critical speed", |scene: &Prepared<T>| {
            black_box(scene.contact.critical_speed(black_box(with)).ok());
        });
    }

    fn run<T: Number>(&mut self, method: &str, task: &str, solve: impl Fn(&Prepared<T>)) {
        let (mut impacts, mut instructions, mut bytes) = (0, Most::default(), Most::default());
        for (place, impact) in grid().enumerate() {
            let Ok(scene) = Prepared::new(&impact) else { continue };
            impacts += 1;
            let work = || call(&solve, black_box(&scene));
            instructions.take(self.0.counter.count(work), place);
            match stack::used(work) {
                Some(used) => bytes.take(used, place),
                None => fail("a simulation needs more stack than can be measured"),
            }
        }
        let (Most { value: most, place: slowest }, Most { value: deepest, place: deep }) = (instructions, bytes);
        hprintln!("{method};{task};{};{impacts};{most};{slowest};{deepest};{deep}", T::NAME);
    }
}

// Not inlined: a call, as an instrument's firmware would make it, is part of the count.
#[inline(never)]
fn call<T: Number>(solve: &impl Fn(&Prepared<T>), scene: &Prepared<T>) {
    solve(scene);
}

/// A largest value, and where it was found.
#[derive(Default)]
struct Most {
    value: u32,
    place: usize,
}

impl Most {
    fn take(&mut self, value: u32, place: usize) {
        if value > self.value {
            *self = Self { value, place };
        }
    }
}

/// A validated scene and motion.
struct Prepared<T> {
    contact: PaperScene<T>,
    motion: ObliqueMotion<T>,
}

impl<T: Real> Prepared<T> {
    fn new(impact: &Impact) -> Result<Self, InputError> {
        let [radius, stiffness, speed, zeta_h, strength, zeta_a] = impact.map(|value| T::constant(value.into()));
        let contact = Contact::hertz(Sphere::solid(radius, T::constant(DENSITY))?, Stiffness::new(stiffness)?)
            .with_damping(zeta_h)?
            .with_ring(strength, zeta_a)?
            .with_friction(T::constant(FRICTION))?;
        Ok(Self { contact, motion: NormalMotion::new(speed)?.with_tangential(speed)? })
    }
}

/// The impacts of the grid.
fn grid() -> impl Iterator<Item = Impact> {
    GRID.as_chunks::<{ size_of::<Impact>() }>().0.iter().map(|bytes| {
        let mut impact = [0.0; 6];
        for (value, bytes) in impact.iter_mut().zip(bytes.as_chunks::<4>().0) {
            *value = f32::from_le_bytes(*bytes);
        }
        impact
    })
}
