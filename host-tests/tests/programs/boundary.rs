//! Tables of the critical speed: their certificate, what they say, and what they refuse.

use std::process::Command;

use microimpact::contact::{Collocation, Contact, Impulses, Nodes, RingScene};
use microimpact::table::{BoundarySlice, BoundaryTable, Lookup, RestitutionTable, Single, TableOutcome, TableRebound};
use microimpact::{
    Coulomb, CriticalSpeed, Fault, InputError, NormalMotion, Outcome, Parameter, Real, RigidBody, SpeedRestitution,
    Sphere, Stiffness, SurfaceMotion,
};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngSeed, TestRunner};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use reference::repetitions;

use crate::microimpact;

/// A surface and what the spheres are made of.
#[derive(Clone, Copy, Debug)]
struct Material {
    density: f64,
    stiffness: f64,
    adhesion: f64,
    zeta_h: f64,
    zeta_a: f64,
}

/// The paper's, with the halved damping of adhesion.
const PAPER: Material = Material { density: 2600.0, stiffness: 7.5e10, adhesion: 250.0, zeta_h: 10.5, zeta_a: 6.25 };

impl Material {
    fn scene<T: Real>(&self, radius: T) -> Result<RingScene<T>, InputError> {
        let sphere = Sphere::solid(radius, T::constant(self.density))?;
        Contact::hertz(sphere, Stiffness::new(T::constant(self.stiffness))?)
            .with_damping(T::constant(self.zeta_h))?
            .with_ring(T::constant(self.adhesion), T::constant(self.zeta_a))
    }

    fn critical<const N: usize, T: Nodes<N>>(&self, radius: T, tolerance: f64) -> Result<CriticalSpeed<T>, InputError> {
        self.scene(radius)?.critical_speed(&Collocation::<N, T>::new(T::constant(tolerance))?)
    }

    fn exact(&self, radius: f64) -> f64 {
        speed(self.critical::<9, f64>(radius, 1e-9))
    }

    fn table<const N: usize>(&self, smallest: f64) -> Result<BoundaryTable<N>, InputError> {
        BoundaryTable::new(smallest, |radius| self.critical::<9, f64>(radius, 1e-9))
    }
}

fn speed<T: std::fmt::Debug>(critical: Result<CriticalSpeed<T>, InputError>) -> T {
    match critical {
        Ok(CriticalSpeed::At(speed)) => speed,
        other => panic!("{other:?}"),
    }
}

fn classify<const N: usize, T: Single>(table: &BoundaryTable<N>, radius: T, speed: T) -> TableOutcome {
    table.classify(radius, &NormalMotion::new(speed).unwrap())
}

/// The largest relative error of a table, over `count` radii of even logarithms; and that each outcome holds.
fn largest_error<const N: usize>(table: &BoundaryTable<N>, material: &Material, count: u32) -> f64 {
    let (smallest, end) = table.radii::<f64>();
    let mut largest = 0.0_f64;
    for k in 0..count {
        let radius = smallest * (end / smallest).powf((f64::from(k) + 0.5) / f64::from(count));
        let exact = material.exact(radius);
        let found = table.critical_speed(radius).unwrap();
        largest = largest.max((found / exact - 1.0).abs());
        let margin = table.margin::<f64>();
        for (factor, wrong) in [(1.0 + 1e-7, TableOutcome::Capture), (1.0 - 1e-7, TableOutcome::Rebound)] {
            assert_ne!(classify(table, radius, exact * factor), wrong, "{material:?}, {radius:e}");
        }
        assert_eq!(
            classify(table, radius, exact * (1.0 + 2.1 * margin)),
            TableOutcome::Rebound,
            "{material:?}, {radius:e}"
        );
        assert_eq!(
            classify(table, radius, exact * (1.0 - 2.1 * margin)),
            TableOutcome::Capture,
            "{material:?}, {radius:e}"
        );
    }
    largest
}

#[test]
fn certificate_holds_for_the_paper() {
    // From 0.84 to 180 um in 504 bytes.
    let table = PAPER.table::<31>(0.84e-6).unwrap();
    assert!(size_of_val(&table) <= 512);
    let (smallest, end) = table.radii::<f64>();
    assert!(smallest <= 0.84e-6 && end >= 180e-6);
    let error = largest_error(&table, &PAPER, 4000);
    assert!(error <= table.margin::<f64>(), "{error:e}");
    assert!(table.margin::<f64>() <= 1e-4);
    // A margin that is far from the error would call too much too close.
    assert!(error >= 0.4 * table.margin::<f64>(), "{error:e}");
}

/// The answers of the reference, to 20 digits.
#[test]
fn reference_is_classified() {
    let table = PAPER.table::<31>(0.84e-6).unwrap();
    let mut reader = csv::Reader::from_reader(include_str!("../../data/critical.csv").as_bytes());
    let mut of_the_paper = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        if number(5) != PAPER.zeta_h {
            continue;
        }
        of_the_paper += 1;
        let (radius, exact) = (number(1), number(7));
        let [above, below] = [1.0 + 2.1 * table.margin::<f64>(), 1.0 - 2.1 * table.margin::<f64>()];
        assert_eq!(classify(&table, radius, exact * above), TableOutcome::Rebound);
        assert_eq!(classify(&table, radius, exact * below), TableOutcome::Capture);
        assert_eq!(classify(&table, radius as f32, (exact * above) as f32), TableOutcome::Rebound);
        assert_eq!(classify(&table, radius as f32, (exact * below) as f32), TableOutcome::Capture);
        assert!((table.critical_speed(radius).unwrap() / exact - 1.0).abs() <= table.margin::<f64>());
    }
    assert_eq!(of_the_paper, 6);
}

#[test]
fn certificate_holds_for_random_materials() {
    let mut runner = TestRunner::new(ProptestConfig { rng_seed: RngSeed::Fixed(1995), ..ProptestConfig::default() });
    let decades = |from: f64, to: f64| (from..to).prop_map(|power| 10_f64.powf(power));
    let materials = (
        decades(2.7, 4.0),
        decades(9.0, 11.5),
        decades(0.0, 3.0),
        decades(-1.0, 1.5),
        decades(-1.0, 1.5),
        decades(-7.0, -4.0),
    );
    let (mut tables, mut narrow, mut refused) = (0, 0, 0);
    while tables < 200 {
        let (density, stiffness, adhesion, zeta_h, zeta_a, smallest) =
            materials.new_tree(&mut runner).unwrap().current();
        let material = Material { density, stiffness, adhesion, zeta_h, zeta_a };
        match material.table::<8>(smallest) {
            Ok(table) => {
                let error = largest_error(&table, &material, 60);
                assert!(
                    error <= table.margin::<f64>(),
                    "{material:?}, {smallest:e}: {error:e} of {:e}",
                    table.margin::<f64>()
                );
                tables += 1;
                narrow += u32::from(table.margin::<f64>() <= 1e-4);
            }
            Err(error) => {
                assert!([Parameter::CriticalSpeed, Parameter::BoundaryMargin].contains(&error.parameter), "{error}");
                refused += 1;
            }
        }
    }
    println!("{narrow} of {tables} tables with a margin up to 1e-4; {refused} refused");
    assert!(narrow > tables / 2);
    assert!(refused > 0);
}

/// Made on a device without double precision, the table errs by no more than the critical speeds it is made from.
#[test]
fn tables_are_made_in_single_precision() {
    let table = BoundaryTable::<16>::new(1e-6_f32, |radius| PAPER.critical::<8, f32>(radius, 1e-6)).unwrap();
    let error = largest_error(&table, &PAPER, 500);
    assert!(error <= table.margin::<f64>(), "{error:e}");
    assert!(table.margin::<f32>() <= 1e-4);
}

/// W_A proportional to the area of contact: the rigid-body model, whose critical speed is an equation.
#[test]
fn certificate_holds_for_the_rigid_body() {
    let scene = |radius: f64| {
        let body = RigidBody::new(Sphere::solid(radius, 2600.0)?, SpeedRestitution::new(130.0)?);
        body.with_work_of_adhesion(2e-12 * (radius / 5e-6).powi(2))
    };
    let table = BoundaryTable::<24>::new(1e-6, |radius| Ok(scene(radius)?.critical_speed())).unwrap();
    assert!(table.margin::<f64>() <= 1e-4);
    let (smallest, end) = table.radii::<f64>();
    for k in 0..3000 {
        let radius = smallest * (end / smallest).powf((f64::from(k) + 0.5) / 3000.0);
        let scene = scene(radius).unwrap();
        let exact = speed(Ok(scene.critical_speed()));
        assert!((table.critical_speed(radius).unwrap() / exact - 1.0).abs() <= table.margin::<f64>());
        for factor in [0.5, 0.999, 1.001, 2.0] {
            let motion = NormalMotion::new(exact * factor).unwrap();
            let expected = match scene.classify(&motion).outcome {
                Outcome::Rebound => TableOutcome::Rebound,
                Outcome::Capture => TableOutcome::Capture,
                Outcome::Undecided => unreachable!("the rigid-body model decides"),
            };
            assert_eq!(table.classify(radius, &motion), expected);
        }
    }
}

#[test]
fn queries_outside_the_table_say_so() {
    let table = PAPER.table::<4>(2e-6).unwrap();
    let (smallest, end) = table.radii::<f32>();
    let outcome = |radius: f32| classify(&table, radius, 1.0_f32);
    assert_eq!(outcome(smallest), TableOutcome::Capture);
    assert_eq!(outcome(end.next_down()), TableOutcome::Capture);
    for radius in [smallest.next_down(), end, 0.0, -0.0, -3e-6, f32::MIN_POSITIVE, 1e-45, f32::MAX] {
        assert_eq!(outcome(radius), TableOutcome::OutsideTable, "{radius:e}");
        assert_eq!(table.critical_speed(radius), None);
    }
    for radius in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -f32::NAN, f32::MIN, -1e-45, f32::from_bits(u32::MAX)] {
        assert_eq!(outcome(radius), TableOutcome::OutsideTable, "{radius:e}");
    }
    for radius in [f64::NAN, f64::MIN_POSITIVE, f64::MAX, f64::NEG_INFINITY, -3e-6] {
        assert_eq!(classify(&table, radius, 1.0), TableOutcome::OutsideTable, "{radius:e}");
    }
    // The slowest and the fastest speed there are.
    assert_eq!(classify(&table, 2.5e-6, 1e-12), TableOutcome::Capture);
    assert_eq!(classify(&table, 2.5e-6, 1e6), TableOutcome::Rebound);
}

/// What is wrong with an input, whatever its value.
fn kind(error: InputError) -> (Parameter, Fault) {
    (error.parameter, error.fault)
}

#[test]
fn tables_that_cannot_be_made_are_refused() {
    let fault = |parameter, fault| Some((parameter, fault));
    let constant = |critical| move |_: f64| Ok(critical);
    let made = |critical| BoundaryTable::<4>::new(1e-6, constant(critical)).err().map(kind);
    assert_eq!(made(CriticalSpeed::At(1.0)), None);
    assert_eq!(made(CriticalSpeed::AlwaysRebounds), fault(Parameter::CriticalSpeed, Fault::TooSmall));
    assert_eq!(made(CriticalSpeed::NeverRebounds), fault(Parameter::CriticalSpeed, Fault::TooLarge));
    assert_eq!(made(CriticalSpeed::At(f64::NAN)), fault(Parameter::CriticalSpeed, Fault::NotFinite));
    let source_fails = BoundaryTable::<4>::new(1e-6, |_: f64| Err(Parameter::Density.check(-1.0).unwrap_err()));
    assert_eq!(source_fails.err().map(kind), fault(Parameter::Density, Fault::TooSmall));
    let beyond = BoundaryTable::<8>::new(0.5, constant(CriticalSpeed::At(1.0)));
    assert_eq!(beyond.err().map(kind), fault(Parameter::Radius, Fault::TooLarge));
    // What no cubic can follow.
    let jump = |radius: f64| Ok(CriticalSpeed::At(if radius < 1.525_878_9e-6 { 1.0 } else { 2.0 }));
    assert_eq!(BoundaryTable::<8>::new(1e-6, jump).err().map(kind), fault(Parameter::BoundaryMargin, Fault::TooLarge));
}

#[test]
fn parts_that_are_no_table_are_refused() {
    let table = PAPER.table::<4>(2e-6).unwrap();
    let (smallest, margin, cells) = table.parts();
    let remade = |smallest, margin, cells| BoundaryTable::<4>::from_parts(smallest, margin, cells).err().map(kind);
    let fault = |parameter, fault| Some((parameter, fault));
    assert_eq!(BoundaryTable::from_parts(smallest, margin, *cells), Ok(table));
    for (radius, expected) in [(f32::NAN, Fault::NotFinite), (-1e-6, Fault::TooSmall), (2.0, Fault::TooLarge)] {
        assert_eq!(remade(radius, margin, *cells), fault(Parameter::Radius, expected));
    }
    assert_eq!(remade(smallest, 0, *cells), fault(Parameter::BoundaryMargin, Fault::TooSmall));
    for margin in [600_000, u32::MAX] {
        assert_eq!(remade(smallest, margin, *cells), fault(Parameter::BoundaryMargin, Fault::TooLarge));
    }
    // A digit wrong in any cell tears it from its neighbours, or is no speed.
    for (cell, part) in (0..4).flat_map(|cell| (0..3).map(move |part| (cell, part))) {
        let mut wrong = *cells;
        wrong[cell][part] += 100_000;
        assert_eq!(remade(smallest, margin, wrong), fault(Parameter::BoundaryMargin, Fault::TooSmall), "{cell} {part}");
    }
    for (constant, expected) in [(0, Fault::TooSmall), (i32::MAX, Fault::TooLarge), (i32::MIN, Fault::TooSmall)] {
        let wrong = [[constant, 0, 0, 0]; 4];
        assert_eq!(remade(smallest, margin, wrong), fault(Parameter::CriticalSpeed, expected));
    }
}

/// Restitution and elastic impulse of the simulation.
fn rebound(material: &Material, radius: f64, speed: f64) -> Result<TableRebound<f64>, InputError> {
    let scene = material.scene(radius)?;
    let method = Collocation::<9, f64>::new(1e-9)?;
    let (impact, impulses) = scene.solve_for(&NormalMotion::new(speed)?, &method, Impulses)?;
    let impulse = impulses.elastic / (scene.sphere().mass() * speed);
    Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
}

type Surface = RestitutionTable<f64, 12, 7, 10>;

/// Radii of 2 to 15 um, up to ten times the critical speed.
fn surface() -> Surface {
    let boundary = PAPER.table(2e-6).unwrap();
    RestitutionTable::new(boundary, 10.0, |radius, speed| rebound(&PAPER, radius, speed)).unwrap()
}

/// Places of a table: radius and speed, from just above the critical one to ten times it, evenly in the root of the excess.
fn places(table: &Surface, count: u32) -> impl Iterator<Item = (f64, f64)> {
    let (smallest, end) = table.boundary().radii::<f64>();
    (0..count).flat_map(move |k| {
        let radius = smallest * (end / smallest).powf((f64::from(k) + 0.5) / f64::from(count));
        let critical = PAPER.exact(radius);
        let root = move |l: u32| 10_f64.log2().sqrt() * (f64::from(l) + 0.5) / f64::from(count);
        (0..count).map(move |l| (radius, critical * (root(l) * root(l)).exp2()))
    })
}

#[test]
fn certificate_of_the_restitution_holds() {
    let table = surface();
    assert!(table.error() <= 1e-3, "{:e}", table.error());
    // With adhesion the elastic impulse is up to nine times the momentum.
    assert!(table.impulse_error() <= 3e-2, "{:e}", table.impulse_error());
    let (mut of_bound, mut far, mut impulse, mut read) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
    for (radius, speed) in places(&table, 70) {
        let exact = rebound(&PAPER, radius, speed).unwrap();
        let lookup = table.look_up(radius, &NormalMotion::new(speed).unwrap());
        match lookup {
            Lookup::Rebound { rebound: found, error } => {
                let off = (found.restitution - exact.restitution).abs();
                of_bound = of_bound.max(off / error);
                let of_impulse = (found.impulse - exact.impulse).abs();
                assert!(of_impulse <= table.impulse_error_of(&lookup).unwrap(), "{radius:e}, {speed}: {of_impulse:e}");
                if speed > 1.02 * PAPER.exact(radius) {
                    far = far.max(off);
                    impulse = impulse.max(of_impulse);
                }
                read += 1;
            }
            other => assert_eq!(other, Lookup::TooCloseToCall, "{radius:e}, {speed}"),
        }
    }
    assert!(read >= 4830, "{read} of 4900 are far enough from the boundary");
    assert!(of_bound <= 1.0, "{of_bound} of the bound");
    assert!(far <= 1e-3, "{far:e}");
    assert!(impulse <= table.impulse_error(), "{impulse:e} of {:e}", table.impulse_error());
    // Bounds that are far from the errors would be of little use.
    assert!(of_bound >= 0.2 && impulse >= 0.2 * table.impulse_error(), "{of_bound}, {impulse:e}");
}

/// What readings of random tables found.
#[derive(Default)]
struct Found {
    tables: u32,
    readings: u32,
    /// Errors over the stated ones.
    restitution: f64,
    impulse: f64,
}

impl Found {
    /// Makes a table of a random material and a random range of speeds, and reads it at random places: anywhere, at the edges
    /// of cells, in the middle of cells, close to the critical speed and close to the largest speed.
    fn read<const N: usize, const R: usize, const S: usize>(&mut self, random: &mut StdRng, readings: u32) {
        let mut decades = |from: f64, to: f64| 10_f64.powf(random.random_range(from..to));
        let material = Material {
            density: decades(2.7, 4.0),
            stiffness: decades(9.0, 11.5),
            adhesion: decades(0.0, 3.0),
            zeta_h: decades(-1.0, 1.5),
            zeta_a: decades(-1.0, 1.5),
        };
        let (smallest, ratio) = (decades(-7.0, -4.0), decades(0.1, 2.5));
        let mut calls = 0;
        let made = material.table::<N>(smallest).and_then(|boundary| {
            RestitutionTable::<f64, N, R, S>::new(boundary, ratio, |radius, speed| {
                calls += 1;
                rebound(&material, radius, speed)
            })
        });
        let table = match made {
            Ok(table) => table,
            Err(error) => {
                let known = [Parameter::CriticalSpeed, Parameter::BoundaryMargin, Parameter::ApproachSpeed];
                assert!(known.contains(&error.parameter), "{material:?}: {error}");
                return;
            }
        };
        self.tables += 1;
        assert!(calls >= 195 && calls <= 300.max(6 * R * S), "{R} x {S} nodes: {calls} calls");
        let (smallest, end) = table.boundary().radii::<f64>();
        for reading in 0..readings {
            let rows = (R - 1) as f64;
            let row = match reading % 3 {
                0 => random.random_range(0.0..rows),
                1 => random.random_range(0.0..rows).floor(),
                _ => random.random_range(0.0..rows).floor() + 0.5,
            };
            let radius = smallest * (end / smallest).powf(row / rows);
            // Nodes are half a step from the critical speed, where the root is zero.
            let columns = S as f64 - 0.5;
            let column = match reading % 5 {
                0 => random.random_range(0.0..columns),
                1 => random.random_range(0.0..columns).round() - 0.5,
                2 => random.random_range(0.0..columns).floor(),
                3 => random.random_range(0.0..0.7_f64).powi(2),
                _ => columns - random.random_range(0.0..0.5),
            };
            let root = ratio.log2().sqrt() * column.max(0.0) / columns;
            let speed = material.exact(radius) * (root * root).exp2();
            let exact = rebound(&material, radius, speed).unwrap();
            let what =
                || format!("{material:?}, {R} x {S} nodes, ratio {ratio}, row {row}, column {column}: {exact:?}");
            let lookup = table.look_up(radius, &NormalMotion::new(speed).unwrap());
            match lookup {
                Lookup::Rebound { rebound: found, error } => {
                    assert!((0.0..=1.0).contains(&found.restitution), "{found:?}, {}", what());
                    let restitution = (found.restitution - exact.restitution).abs() / error;
                    let impulse = (found.impulse - exact.impulse).abs() / table.impulse_error_of(&lookup).unwrap();
                    assert!(restitution <= 1.0 && impulse <= 1.0, "{restitution} {impulse} {found:?}, {}", what());
                    self.restitution = self.restitution.max(restitution);
                    self.impulse = self.impulse.max(impulse);
                    self.readings += 1;
                }
                other => {
                    assert!([Lookup::TooCloseToCall, Lookup::OutsideTable].contains(&other), "{other:?}, {}", what())
                }
            }
        }
    }
}

/// Poor and fine resolutions, over a quarter of an octave of radii to eight octaves.
#[test]
fn certificates_hold_for_random_tables() {
    let mut random = StdRng::seed_from_u64(1995);
    let mut found: [Found; 7] = Default::default();
    for _ in 0..repetitions(200, 8) {
        found[0].read::<1, 3, 4>(&mut random, 150);
        found[1].read::<4, 3, 4>(&mut random, 150);
        found[2].read::<12, 3, 4>(&mut random, 150);
        found[3].read::<8, 4, 6>(&mut random, 150);
        found[4].read::<31, 8, 7>(&mut random, 150);
        found[5].read::<12, 7, 10>(&mut random, 150);
        found[6].read::<4, 5, 24>(&mut random, 150);
    }
    for (number, found) in found.iter().enumerate() {
        let Found { tables, readings, restitution, impulse } = found;
        let numbers = format!("shape {number}: {tables} tables, {readings} readings, {restitution:.2} {impulse:.2}");
        println!("{numbers} of the stated errors");
        assert!(*readings >= 100 * tables && *tables >= 5, "{numbers}");
        // Bounds that are far from the errors would be of little use.
        let least = if number == 6 { 0.1 } else { 0.3 };
        assert!(restitution.min(*impulse) >= least, "{numbers}");
    }
}

/// Sliding or rolling, and the velocities, are those of the simulation wherever the elastic impulse decides it clearly.
#[test]
fn tangential_motion_is_that_of_the_simulation() {
    let (table, friction, method) = (surface(), 0.1, Collocation::<9, f64>::new(1e-9).unwrap());
    let coulomb = Coulomb::new(friction).unwrap();
    let (mut slides, mut rolls) = (0, 0);
    for (radius, speed) in places(&table, 12) {
        let scene = PAPER.scene(radius).unwrap().with_friction(friction).unwrap();
        for slip in [-3.0, -0.71, -0.1, 0.0, 0.4, 0.68, 0.72, 2.0] {
            let motion = NormalMotion::new(speed).unwrap().with_tangential(0.3 * speed).unwrap();
            let motion = motion.with_peripheral_velocity((0.3 - slip) * speed).unwrap();
            let Lookup::Rebound { rebound, .. } = table.look_up(radius, &motion) else { continue };
            let after = rebound.separation(&coulomb, 0.4, &motion);
            let simulated = scene.solve(&motion, &method).unwrap().tangential;
            let allowed = speed * friction * table.impulse_error();
            assert!((after.velocity - simulated.velocity()).abs() <= allowed);
            assert!((after.peripheral - simulated.spin() * radius).abs() <= 2.5 * allowed);
            let over = friction * rebound.impulse * 3.5 - slip.abs();
            if over.abs() > friction * 3.5 * table.impulse_error() {
                assert_eq!(after.motion, simulated.motion(), "{radius:e}, {speed}, {slip}");
            }
            match after.motion {
                SurfaceMotion::Sliding => slides += 1,
                _ => rolls += 1,
            }
        }
    }
    assert!(slides > 100 && rolls > 100, "{slides} {rolls}");
}

#[test]
fn readings_outside_the_table_say_so() {
    let table = surface();
    let (smallest, end) = table.boundary().radii::<f64>();
    let read = |radius: f64, speed: f64| table.look_up(radius, &NormalMotion::new(speed).unwrap());
    for radius in [0.999 * smallest, end, 0.0, -3e-6, f64::NAN, f64::INFINITY] {
        assert_eq!(read(radius, 5.0), Lookup::OutsideTable, "{radius:e}");
    }
    let critical = PAPER.exact(3e-6);
    for (factor, expected) in [(1e-9, Lookup::Capture), (0.999, Lookup::Capture), (1.0, Lookup::TooCloseToCall)] {
        assert_eq!(read(3e-6, factor * critical), expected);
    }
    assert!(matches!(read(3e-6, 9.999 * critical), Lookup::Rebound { .. }));
    for factor in [10.001, 1e4] {
        assert_eq!(read(3e-6, factor * critical), Lookup::OutsideTable);
    }
    // The ends of the range of radii are read as well as its middle.
    for radius in [smallest, end * (1.0 - 1e-6)] {
        let exact = rebound(&PAPER, radius, 2.0 * PAPER.exact(radius)).unwrap();
        let Lookup::Rebound { rebound, error } = read(radius, 2.0 * PAPER.exact(radius)) else { panic!("{radius:e}") };
        assert!((rebound.restitution - exact.restitution).abs() <= error);
    }
}

#[test]
fn surfaces_that_cannot_be_made_are_refused() {
    let boundary = PAPER.table::<1>(2e-6).unwrap();
    let made = |ratio: f64, restitution: f64| {
        let source = |_, _| Ok(TableRebound { restitution, impulse: 2.0 });
        RestitutionTable::<f64, 1, 3, 4>::new(boundary, ratio, source).err().map(kind)
    };
    let fault = |parameter, fault| Some((parameter, fault));
    assert_eq!(made(10.0, 0.5), None);
    assert_eq!(made(10.0, f64::NAN), fault(Parameter::Restitution, Fault::NotFinite));
    assert_eq!(made(10.0, 1.1), fault(Parameter::Restitution, Fault::TooLarge));
    let fast = BoundaryTable::<1>::new(1e-6, |_: f64| Ok(CriticalSpeed::At(9e5))).unwrap();
    let source = |_, _| Ok(TableRebound { restitution: 0.5, impulse: 2.0 });
    let error = RestitutionTable::<f64, 1, 3, 4>::new(fast, 10.0, source).unwrap_err();
    assert_eq!(error.parameter, Parameter::ApproachSpeed);
}

#[test]
fn single_precision_reads_the_same() {
    let double = surface();
    let boundary = *double.boundary();
    let single = RestitutionTable::<f32, 12, 7, 10>::new(boundary, 10.0, |radius, speed| {
        let TableRebound { restitution, impulse } = rebound(&PAPER, radius.into(), speed.into())?;
        Ok(TableRebound { restitution: restitution as f32, impulse: impulse as f32 })
    })
    .unwrap();
    for (radius, speed) in places(&double, 20) {
        let (one, other) = (
            double.look_up(radius, &NormalMotion::new(speed).unwrap()),
            single.look_up(radius as f32, &NormalMotion::new(speed as f32).unwrap()),
        );
        if let (Lookup::Rebound { rebound: one, .. }, Lookup::Rebound { rebound: other, .. }) = (one, other) {
            assert!((one.restitution - f64::from(other.restitution)).abs() <= 1e-5);
            assert!((one.impulse - f64::from(other.impulse)).abs() <= 1e-5);
        }
    }
}

const SMALL: [&str; 4] = ["--smallest-radius", "2e-6", "--cells", "4"];

fn written(format: &str) -> String {
    let output = microimpact("table", &[&SMALL[..], &["--format", format]].concat(), b"");
    assert_eq!(output.status, 0, "{}", output.complaint());
    String::from_utf8(output.stdout).unwrap()
}

/// Cells written as lines of four numbers.
fn cells_in<'a>(lines: impl Iterator<Item = &'a str>) -> [[i32; 4]; 4] {
    let numbers = |line: &str| line.split(", ").map(|number| number.parse().unwrap()).collect::<Vec<i32>>();
    let cells: Vec<[i32; 4]> = lines.map(|line| numbers(line).try_into().unwrap()).collect();
    cells.try_into().unwrap()
}

#[test]
fn command_writes_a_constant() {
    let table = PAPER.table::<4>(2e-6).unwrap();
    let (smallest, margin, cells) = table.parts();
    let text = written("rust");
    assert!(text.contains("BoundaryTable<4> =") && text.contains(&format!("from_parts({smallest:e}, {margin}, [")));
    let lines = text.lines().filter_map(|line| line.trim().strip_prefix('[')?.strip_suffix("],"));
    assert_eq!(cells_in(lines), *cells);
    let text = written("csv");
    let lines: Vec<String> =
        text.lines().skip(1).map(|line| line.split(',').skip(2).take(4).collect::<Vec<_>>().join(", ")).collect();
    assert_eq!(cells_in(lines.iter().map(String::as_str)), *cells);
}

/// The constant of the firmware is the one that the command writes.
#[test]
fn table_of_the_firmware_is_current() {
    let firmware = include_str!("../../../examples/firmware/scenes/src/tables.rs");
    let table = PAPER.table::<12>(2e-6).unwrap();
    let (smallest, margin, cells) = table.parts();
    let lines: Vec<&str> = firmware.lines().map(str::trim).collect();
    let at = lines.iter().position(|line| *line == format!("{smallest:e},")).unwrap();
    assert_eq!(lines[at + 1], format!("{margin},"));
    for (cell, line) in cells.iter().zip(&lines[at + 3..]) {
        assert_eq!(format!("{cell:?},"), *line);
    }
}

/// As firmware contains it.
mod constant {
    include!("../../data/restitution_constant.rs");

    pub(super) fn table() -> &'static microimpact::table::RestitutionTable<f32, 4, 12, 12> {
        &RESTITUTION
    }
}

/// The constant that the command writes is Rust, and holds what a simulation finds, within its error.
#[test]
fn command_writes_a_restitution_table() {
    assert_eq!(written("restitution-rust"), include_str!("../../data/restitution_constant.rs"));
    let mut rebounds = 0;
    for (radius, speed) in
        [2e-6, 2.7e-6, 3.1e-6, 3.7e-6].into_iter().flat_map(|radius| [9.0, 12.0, 20.0, 55.0].map(|v| (radius, v)))
    {
        let exact = rebound(&PAPER, radius, speed).unwrap();
        let motion = NormalMotion::new(speed as f32).unwrap();
        if let Lookup::Rebound { rebound, error } = constant::table().look_up(radius as f32, &motion) {
            assert!((f64::from(rebound.restitution) - exact.restitution).abs() <= f64::from(error));
            rebounds += 1;
        }
    }
    assert_eq!(rebounds, 16);
    let refused = microimpact("table", &["--format", "restitution-rust", "--cells", "5"], b"");
    assert_eq!(refused.status, 2);
    assert!(refused.complaint().contains("--cells 5 is refused: a restitution table has one of 4, 8,"));
}

/// Radii within and around a table, and speeds close to the critical one and far from it.
fn queries(table: &BoundaryTable<4>) -> Vec<(f32, f32)> {
    let mut queries = Vec::new();
    for k in 0..400 {
        let radius = 1.8e-6 * 1.004_f32.powi(k);
        let critical = table.critical_speed(radius).unwrap_or(1.0);
        let factors = [1e-12 / critical, 0.5, 0.999, 0.999_95, 1.0, 1.000_05, 1.001, 2.0, 1e5];
        queries.extend(factors.map(|factor| (radius, (critical * factor).clamp(1e-12, 1e6))));
    }
    queries.extend([0.0, -3e-6, f32::NAN, f32::INFINITY, 1e-45].map(|radius| (radius, 1.0)));
    queries
}

/// A cell that is read alone gives the outcomes of the table, and is refused if it is invalid.
#[test]
fn cells_say_what_the_table_says() {
    let table = PAPER.table::<4>(2e-6).unwrap();
    let (smallest, margin, cells) = table.parts();
    let alone = |cells: &[[i32; 4]], radius: f32, speed: f32| {
        let motion = NormalMotion::new(speed).unwrap();
        let cell = BoundarySlice::cell(smallest, margin, cells, radius).map_err(kind)?;
        Ok(cell.map_or(TableOutcome::OutsideTable, |cell| cell.classify(radius, &motion)))
    };
    for (radius, speed) in queries(&table) {
        assert_eq!(alone(cells, radius, speed), Ok(classify(&table, radius, speed)), "{radius:e} {speed:e}");
    }
    let mut spoilt = *cells;
    spoilt[1][0] = 0;
    let error = (Parameter::CriticalSpeed, Fault::TooSmall);
    assert_eq!(BoundarySlice::from_parts(smallest, margin, &spoilt).map_err(kind), Err(error));
    // Cells are linear in the radius within an octave.
    let second = smallest * 1.25..smallest * 1.5;
    for (radius, speed) in queries(&table) {
        let expected = if second.contains(&radius) { Err(error) } else { Ok(classify(&table, radius, speed)) };
        assert_eq!(alone(&spoilt, radius, speed), expected, "{radius:e}");
    }
}

/// The function in C gives the outcomes of the library, everywhere.
#[test]
fn command_writes_c_that_says_the_same() {
    let folder = std::env::temp_dir().join(format!("boundary-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let (source, program) = (folder.join("boundary.c"), folder.join("boundary"));
    let main = "#include <stdio.h>\n\
        int main(void) {\n\
            float radius, speed;\n\
            while (scanf(\"%f %f\", &radius, &speed) == 2) printf(\"%d\\n\", (int)boundary_classify(radius, speed));\n\
            return 0;\n\
        }\n";
    std::fs::write(&source, written("c") + main).unwrap();
    let options = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-o"];
    let built = Command::new("cc").args(options).arg(&program).arg(&source).status().unwrap();
    assert!(built.success());

    let table = PAPER.table::<4>(2e-6).unwrap();
    let queries = queries(&table);
    let input: String = queries.iter().map(|(radius, speed)| format!("{radius:e} {speed:e}\n")).collect();
    std::fs::write(folder.join("queries"), input).unwrap();
    let queried = std::fs::File::open(folder.join("queries")).unwrap();
    let output = Command::new(&program).stdin(queried).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let outcomes =
        [TableOutcome::Rebound, TableOutcome::Capture, TableOutcome::TooCloseToCall, TableOutcome::OutsideTable];
    let answers: Vec<TableOutcome> = text.lines().map(|line| outcomes[line.parse::<usize>().unwrap()]).collect();
    assert_eq!(answers.len(), queries.len());
    for ((radius, speed), answer) in queries.into_iter().zip(&answers) {
        assert_eq!(classify(&table, radius, speed), *answer, "{radius:e} {speed:e}");
    }
    for outcome in outcomes {
        assert!(answers.contains(&outcome), "{outcome:?}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn command_refuses_what_has_no_boundary_with_2() {
    for (arguments, word) in [
        (["--adhesion", "0"], "critical speed is 0 m/s, but must be 1e-12 to 1e6 m/s"),
        (["--smallest-radius", "-1"], "radius"),
        (["--cells", "33"], "cells"),
    ] {
        let output = microimpact("table", &arguments, b"");
        assert_eq!(output.status, 2);
        assert!(output.complaint().contains(word));
    }
}
