//! Run times of impacts in lanes and one by one.

use std::array;
use std::error::Error;
use std::hint::black_box;

use impact_arrays::{F32x8, F64x4};
use microimpact::contact::{Contact, FixedCost, HertzLaw, HystereticDamping, Impulses, Ring, Times};
use microimpact::{InputError, NormalMotion, Real, Sphere, Stiffness};

use crate::least;

/// Impacts of one measurement.
const IMPACTS: usize = 512;

/// Their repetitions.
const RUNS: u32 = 8;

/// What is measured in lanes and one by one, in the order of [`measure`]: number type, lanes, and results.
pub const TASKS: [&str; 6] = [
    "f64 in 4, e",
    "f32 in 8, e",
    "f64 in 4, e and velocities",
    "f32 in 8, e and velocities",
    "f64 in 4, e, times and impulses",
    "f32 in 8, e, times and impulses",
];

/// A scene of Table 1 with another radius.
fn scene<T: Real>(radius: T) -> Result<Contact<T, HertzLaw<T, HystereticDamping<T>, Ring<T>>>, InputError> {
    Contact::hertz(Sphere::solid(radius, T::constant(2600.0))?, Stiffness::new(T::constant(7.5e10))?)
        .with_damping(T::constant(10.5))?
        .with_ring(T::constant(250.0), T::constant(6.25))
}

/// Nodes for times and impulses: three more than those of a phase.
const NODES: usize = 10;

/// Solves one impact or those of lanes for a task.
macro_rules! solve {
    (e, $solve:ident $solve_for:ident, $radius:expr, $speed:expr, $method:expr) => {
        scene($radius)?.$solve(&NormalMotion::new($speed)?, $method)?
    };
    (velocities, $solve:ident $solve_for:ident, $radius:expr, $speed:expr, $method:expr) => {{
        let friction = Real::constant(0.1);
        let before = NormalMotion::new($speed)?.with_tangential(friction)?;
        scene($radius)?.with_friction(friction)?.$solve(&before, $method)?
    }};
    (times, $solve:ident $solve_for:ident, $radius:expr, $speed:expr, $method:expr) => {
        scene($radius)?.$solve_for(&NormalMotion::new($speed)?, &$method.with_outputs::<NODES>(), (Times, Impulses))?
    };
}

/// A number that depends on all results of an impact that a task asks for.
macro_rules! result {
    (times, $solved:expr) => {{
        let (impact, (times, impulses)) = $solved;
        impact.normal.overall_restitution() + times.contact.unwrap_or(0.0) + impulses.elastic
    }};
    ($task:ident, $impact:expr) => {
        $impact.normal.overall_restitution()
    };
}

/// Seconds for all impacts, one by one and in lanes.
macro_rules! compare {
    ($task:ident, $number:ident, $lanes:ident, $count:literal) => {{
        let method = FixedCost::<7>::new(3)?;
        // Spheres near and far from the critical speed next to each other: lanes take what their most expensive impact takes.
        let place = |index: usize| (index * 37 % IMPACTS) as $number / IMPACTS as $number;
        let radii: Vec<$number> = (0..IMPACTS).map(|index| 4e-6 + 3e-6 * place(index)).collect();
        let speeds: Vec<$number> = (0..IMPACTS).map(|index| 2.8 + 5.0 * place(index / 8 + 11 * index)).collect();
        let mut results = vec![0.0; IMPACTS];
        let mut alone = || -> Result<(), InputError> {
            let inputs = black_box(&radii).iter().zip(black_box(&speeds));
            for (result, (radius, speed)) in results.iter_mut().zip(inputs) {
                *result = result!($task, solve!($task, solve solve_for, *radius, *speed, &method));
            }
            black_box(&results);
            Ok(())
        };
        alone()?;
        let alone = least(RUNS, alone);
        let mut together = || -> Result<(), InputError> {
            let inputs = black_box(&radii).chunks_exact($count).zip(black_box(&speeds).chunks_exact($count));
            for (results, (radii, speeds)) in results.chunks_exact_mut($count).zip(inputs) {
                let of = |numbers: &[$number]| $lanes::from(array::from_fn::<_, $count, _>(|lane| numbers[lane]));
                let impacts: [_; $count] =
                    solve!($task, solve_lanes solve_lanes_for, of(radii), of(speeds), &method);
                for (result, impact) in results.iter_mut().zip(impacts) {
                    *result = result!($task, impact);
                }
            }
            black_box(&results);
            Ok(())
        };
        together()?;
        [alone, least(RUNS, together)]
    }};
}

/// Least seconds of each task, one by one and in lanes.
pub fn measure() -> Result<Vec<f64>, Box<dyn Error>> {
    let e = [compare!(e, f64, F64x4, 4), compare!(e, f32, F32x8, 8)];
    let velocities = [compare!(velocities, f64, F64x4, 4), compare!(velocities, f32, F32x8, 8)];
    let times = [compare!(times, f64, F64x4, 4), compare!(times, f32, F32x8, 8)];
    Ok(e.into_iter().chain(velocities).chain(times).flatten().collect())
}
