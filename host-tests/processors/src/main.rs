//! Run times of builds for several processors of one family, as ratios to the default build.
//!
//! `cargo processors` builds this program once for each processor and lets the builds take turns. It fails if one is slower than the default
//! by more than a fifth. It also compares the throughput of impacts in lanes with that of single calls, and fails if lanes gain less than
//! expected where the processor has vectors for them.

mod lanes;

use std::error::Error;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

use comfy_table::Table;
use microimpact::contact::{Adaptive, Contact, FixedCost, Impulses, Times};
use microimpact::{NormalMotion, Sphere, Stiffness};

/// Names of processors as the compiler knows them; the first is what it builds for by default.
#[cfg(target_arch = "x86_64")]
const PROCESSORS: [&str; 3] = ["x86-64", "x86-64-v3", "native"];
#[cfg(not(target_arch = "x86_64"))]
const PROCESSORS: [&str; 2] = ["generic", "native"];

/// Largest run time over that of the default build.
const LARGEST_RATIO: f64 = 1.2;

/// Least throughput of lanes over that of single calls where vectors hold four f64.
const LEAST_GAIN: f64 = 1.8;

/// Turns that each build takes; the least time of each counts.
const TURNS: usize = 15;

/// Runs in each measurement, and measurements in each turn.
const RUNS: u32 = 2000;
const MEASUREMENTS: usize = 5;

/// The argument of a build that measures.
const MEASURE: &str = "--measure";

/// What is measured, in the order of [`measure`].
const TASKS: [&str; 4] = ["Adaptive, 1e-6", "Adaptive, 1e-9", "Adaptive, 1e-12", "FixedCost<7>, 3 iterations"];

fn main() -> Result<ExitCode, Box<dyn Error>> {
    if std::env::args().any(|argument| argument == MEASURE) {
        for seconds in measure()?.into_iter().chain(lanes::measure()?) {
            println!("{seconds:e}");
        }
        return Ok(ExitCode::SUCCESS);
    }
    let programs: Vec<PathBuf> =
        runnable().into_iter().map(|processor| build(processor)).collect::<Result<_, Box<dyn Error>>>()?;
    // Those of lanes come in pairs.
    let mut least = vec![[f64::INFINITY; TASKS.len() + 2 * lanes::TASKS.len()]; programs.len()];
    for _ in 0..TURNS {
        for (program, least) in programs.iter().zip(&mut least) {
            for (least, seconds) in least.iter_mut().zip(turn(program)?) {
                *least = least.min(seconds);
            }
        }
    }
    let mut table = Table::new();
    table.set_header(["method"].into_iter().chain(runnable()));
    let mut worst: f64 = 1.0;
    for (task, name) in TASKS.iter().enumerate() {
        let times = || least.iter().filter_map(|times| times.get(task).copied());
        let first = times().next().unwrap_or(f64::INFINITY);
        worst = times().fold(worst, |worst, seconds| worst.max(seconds / first));
        table.add_row([(*name).to_owned()].into_iter().chain(times().map(|seconds| format!("{:.2}", seconds / first))));
    }
    println!("Run times of Table 1 over those of the default build\n{table}\nlargest: {worst:.2}");
    let (table, gain) = in_lanes(&least);
    println!("Throughput of FixedCost<7>, 3 iterations, in lanes over that of single calls in the same build\n{table}");
    println!("smallest with vectors of four f64: {gain:.2}");
    Ok(if worst <= LARGEST_RATIO && gain >= LEAST_GAIN { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The table of gains by lanes, and the smallest of a build with vectors of four f64: of all but the first.
fn in_lanes(least: &[[f64; TASKS.len() + 2 * lanes::TASKS.len()]]) -> (Table, f64) {
    let mut table = Table::new();
    table.set_header(["lanes"].into_iter().chain(runnable()));
    let mut smallest = f64::INFINITY;
    for (task, name) in lanes::TASKS.iter().enumerate() {
        let place = TASKS.len() + 2 * task;
        let gains: Vec<f64> = least.iter().map(|times| times[place] / times[place + 1]).collect();
        let without_vectors = if has_v3() { 1 } else { gains.len() };
        smallest = gains.iter().skip(without_vectors).fold(smallest, |smallest, gain| smallest.min(*gain));
        table.add_row([(*name).to_owned()].into_iter().chain(gains.iter().map(|gain| format!("{gain:.2}"))));
    }
    (table, smallest)
}

/// Whether this machine runs code for x86-64-v3.
fn has_v3() -> bool {
    #[cfg(target_arch = "x86_64")]
    return is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") && is_x86_feature_detected!("bmi2");
    #[cfg(not(target_arch = "x86_64"))]
    false
}

/// The processors whose code this machine runs.
fn runnable() -> Vec<&'static str> {
    PROCESSORS.into_iter().filter(|name| has_v3() || *name != "x86-64-v3").collect()
}

/// This program for a processor.
fn build(processor: &str) -> Result<PathBuf, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let target = root.join("target/processors").join(processor);
    let cargo = std::env::var("CARGO").unwrap_or("cargo".into());
    let status = Command::new(cargo)
        .args(["build", "--release", "--locked", "--package", "processors", "--target-dir"])
        .arg(&target)
        .env("RUSTFLAGS", format!("-Ctarget-cpu={processor}"))
        .current_dir(&root)
        .status()?;
    if !status.success() {
        return Err(format!("the build for {processor} failed; the compiler's messages above say why").into());
    }
    Ok(target.join("release/processors"))
}

/// The times of one turn of a build, s.
fn turn(program: &Path) -> Result<Vec<f64>, Box<dyn Error>> {
    let output = Command::new(program).arg(MEASURE).output()?;
    Ok(String::from_utf8(output.stdout)?.lines().map(str::parse).collect::<Result<_, _>>()?)
}

/// Least seconds of each task.
fn measure() -> Result<[f64; TASKS.len()], Box<dyn Error>> {
    let scene = Contact::hertz(Sphere::solid(5.06e-6, 2600.0)?, Stiffness::new(7.5e10)?)
        .with_damping(10.5)?
        .with_ring(250.0, 6.25)?;
    let motion = NormalMotion::new(2.8)?;
    let adaptive = |tolerance: f64| -> Result<f64, Box<dyn Error>> {
        let method = Adaptive::new(tolerance)?;
        scene.solve_for(&motion, &method, (Times, Impulses))?;
        Ok(least(RUNS, || black_box(&scene).solve_for(black_box(&motion), &method, (Times, Impulses))))
    };
    let fixed = FixedCost::<7>::new(3)?;
    let of_fixed = least(RUNS, || black_box(&scene).solve(black_box(&motion), &fixed));
    Ok([adaptive(1e-6)?, adaptive(1e-9)?, adaptive(1e-12)?, of_fixed])
}

/// Least seconds of a run.
fn least<R>(runs: u32, mut run: impl FnMut() -> R) -> f64 {
    let times = (0..MEASUREMENTS).map(|_| {
        let start = Instant::now();
        for _ in 0..runs {
            black_box(run());
        }
        start.elapsed().as_secs_f64() / f64::from(runs)
    });
    times.fold(f64::INFINITY, f64::min)
}
