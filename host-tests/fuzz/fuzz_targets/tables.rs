//! Tables of critical speeds and of restitution, from stored values and from arbitrary sources. From this package's folder:
//!
//! ```text
//! cargo fuzz run --sanitizer none tables
//! ```
//!
//! Boundary tables come from serialized bytes, from parts, and from a source of critical speeds. Restitution tables cannot be
//! read from stored values: they come from a source alone. Checked:
//!
//! * nothing panics;
//! * the critical speed in an accepted table is a speed; slower spheres are captured and faster ones rebound, as the margin
//!   allows;
//! * one cell answers as the whole table does, and parts and serialized bytes give the same table again;
//! * each restitution is 0 to 1 with a finite error, or there is none.
#![no_main]

use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;
use microimpact::instrument::{Classifier, Tabulated};
use microimpact::table::{BoundarySlice, BoundaryTable, Lookup, RestitutionTable, Single, TableOutcome, TableRebound};
use microimpact::{Coulomb, CriticalSpeed, InputError, NoFriction, NormalMotion, Parameter, Sphere};
use microimpact_fuzz::{signed, size};

fuzz_target!(|data: &[u8]| {
    // Bytes never run out: zeros follow them.
    let _ = run(&mut Unstructured::new(data));
});

fn run(bytes: &mut Unstructured<'_>) -> Result<()> {
    match bytes.arbitrary::<u8>()? & 7 {
        0 => deserialize(bytes)?,
        1 => from_parts::<1>(bytes)?,
        2 => from_parts::<4>(bytes)?,
        3 => filled(bytes)?,
        4 | 5 => restitution::<f64>(bytes)?,
        _ => restitution::<f32>(bytes)?,
    }
    Ok(())
}

fn deserialize(bytes: &mut Unstructured<'_>) -> Result<()> {
    let impact = Impact::of(bytes)?;
    let stored = bytes.bytes(bytes.len())?;
    if let Ok(table) = postcard::from_bytes::<BoundaryTable<1>>(stored) {
        check_boundary(&table, &impact);
    }
    if let Ok(table) = postcard::from_bytes::<BoundaryTable<4>>(stored) {
        check_boundary(&table, &impact);
    }
    Ok(())
}

/// Cells of arbitrary coefficients or, more often, of ones that could belong to a table.
fn from_parts<const N: usize>(bytes: &mut Unstructured<'_>) -> Result<()> {
    let impact = Impact::of(bytes)?;
    let smallest = size(bytes, Parameter::Radius.range())? as f32;
    let margin = bytes.arbitrary::<u32>()? >> bytes.int_in_range(0..=31)?;
    let mut cells = [[0; 4]; N];
    // The logarithms of all critical speeds.
    let mut constant = bytes.int_in_range(690_000_000..=1_240_000_000)?;
    for cell in &mut cells {
        let shift = bytes.int_in_range(0..=31)?;
        let [linear, square, cube] = bytes.arbitrary::<[i32; 3]>()?.map(|coefficient| coefficient >> shift);
        *cell = if shift == 0 { bytes.arbitrary()? } else { [constant, linear, square, cube] };
        // The next cell begins near where this one ends, as it has to.
        constant = constant.wrapping_add(linear).wrapping_add(i32::from(bytes.arbitrary::<i8>()?));
    }
    if let Ok(table) = BoundaryTable::from_parts(smallest, margin, cells) {
        check_boundary(&table, &impact);
    }
    Ok(())
}

fn filled(bytes: &mut Unstructured<'_>) -> Result<()> {
    let impact = Impact::of(bytes)?;
    let smallest = size(bytes, Parameter::Radius.range())?;
    let source = Source::of(bytes)?;
    let count = bytes.int_in_range(0..=8)?;
    if let Ok(table) = BoundaryTable::<4>::new(smallest, source.critical_speeds(smallest)) {
        check_boundary(&table, &impact);
    }
    if let Ok(table) = BoundaryTable::<4>::new(smallest as f32, source.critical_speeds(smallest)) {
        check_boundary(&table, &impact);
    }
    let mut cells = vec![[0; 4]; count];
    if let Ok(table) = BoundarySlice::fill(smallest, &mut cells, source.critical_speeds(smallest)) {
        let _ = NormalMotion::new(impact.speed).map(|motion| table.classify(impact.radius, &motion));
    }
    Ok(())
}

fn restitution<T: Single>(bytes: &mut Unstructured<'_>) -> Result<()> {
    let impact = Impact::of(bytes)?;
    let smallest = size(bytes, (1e-9, 0.1))?;
    let (boundary, source) = (Source::of(bytes)?, Source::of(bytes)?);
    let ratio = T::constant(size(bytes, Parameter::SpeedRatio.range())?);
    let impulse = size(bytes, (1e-2, 10.0))?;
    if let Ok(table) = BoundaryTable::<2>::new(T::constant(smallest), boundary.critical_speeds(smallest)) {
        check_boundary(&table, &impact);
        let coarse = RestitutionTable::<T, 2, 3, 4>::new(table, ratio, source.rebounds(&table, impulse));
        let _ = coarse.map(|table| check_restitution(&table, &impact));
        let fine = RestitutionTable::<T, 2, 4, 7>::new(table, ratio, source.rebounds(&table, impulse));
        let _ = fine.map(|table| check_restitution(&table, &impact));
    }
    Ok(())
}

/// What is looked up.
struct Impact {
    radius: f64,
    speed: f64,
    tangential: f64,
    friction: f64,
    /// A place in the table, 0 to 1.
    place: f64,
    /// A speed over the critical one.
    over_critical: f64,
}

impl Impact {
    fn of(bytes: &mut Unstructured<'_>) -> Result<Self> {
        Ok(Self {
            radius: size(bytes, Parameter::Radius.range())?,
            speed: size(bytes, Parameter::ApproachSpeed.range())?,
            tangential: signed(bytes, (1e-6, 1e3))?,
            friction: size(bytes, (1e-3, 10.0))?,
            place: f64::from(bytes.arbitrary::<u32>()?) / f64::from(u32::MAX),
            over_critical: size(bytes, (0.5, 100.0))?,
        })
    }

    /// The radius in the table, and the one that may be anywhere.
    fn radii<T: Single, const N: usize>(&self, table: &BoundaryTable<N>) -> [T; 2] {
        let (smallest, end) = table.radii::<f64>();
        [smallest + (end - smallest) * self.place, self.radius].map(T::constant)
    }
}

/// A function of the radius or of the speed: a power with noise.
struct Source {
    first: f64,
    power: f64,
    noise: [u8; 8],
    /// How small the noise is.
    exponent: u8,
}

impl Source {
    fn of(bytes: &mut Unstructured<'_>) -> Result<Self> {
        let first = size(bytes, (1e-6, 1e3))?;
        let power = f64::from(bytes.arbitrary::<i8>()?) / 32.0;
        Ok(Self { first, power, noise: bytes.arbitrary()?, exponent: bytes.arbitrary()? })
    }

    /// The factor of a call.
    fn factor(&self, call: usize) -> f64 {
        1.0 + f64::from(self.noise[call % self.noise.len()]) * 0.5_f64.powi(i32::from(self.exponent & 63))
    }

    fn critical_speeds<T: Single>(
        &self,
        smallest: f64,
    ) -> impl FnMut(T) -> std::result::Result<CriticalSpeed<T>, InputError> {
        let mut calls = 0;
        move |radius: T| {
            calls += 1;
            Ok(match self.exponent {
                255 => CriticalSpeed::AlwaysRebounds,
                254 => CriticalSpeed::NeverRebounds,
                _ => {
                    let growth = (radius.to_f64() / smallest).powf(self.power);
                    CriticalSpeed::At(T::constant(self.first * growth * self.factor(calls)))
                }
            })
        }
    }

    /// Restitution and impulse of speeds beyond those of a table.
    fn rebounds<T: Single, const N: usize>(
        &self,
        table: &BoundaryTable<N>,
        impulse: f64,
    ) -> impl FnMut(T, T) -> std::result::Result<TableRebound<T>, InputError> {
        let mut calls = 0;
        move |radius: T, speed: T| {
            calls += 1;
            let critical = table.critical_speed(radius).map_or(f64::NAN, |critical| critical.to_f64());
            let e = (1.0 - (critical / speed.to_f64()).powi(2)).max(0.0).sqrt();
            let restitution = if self.exponent & 64 == 0 { e } else { self.first };
            let [restitution, impulse] = [restitution, impulse * (1.0 + e)].map(|value| value * self.factor(calls));
            let least = if self.exponent & 128 == 0 { 1.0 } else { f64::INFINITY };
            Ok(TableRebound { restitution: T::constant(restitution.min(least)), impulse: T::constant(impulse) })
        }
    }
}

fn check_boundary<const N: usize>(table: &BoundaryTable<N>, impact: &Impact) {
    let (smallest, margin, cells) = table.parts();
    assert_eq!(BoundaryTable::from_parts(smallest, margin, *cells), Ok(*table));
    let mut stored = [0; 512];
    let stored = postcard::to_slice(table, &mut stored).expect("a table of few cells has room");
    assert_eq!(postcard::from_bytes(stored), Ok(*table));
    check_speeds::<f64, N>(table, impact);
    check_speeds::<f32, N>(table, impact);
}

fn check_speeds<T: Single, const N: usize>(table: &BoundaryTable<N>, impact: &Impact) {
    let (smallest, margin, cells) = table.parts();
    // The lookup rounds to single precision, and the margin is one of logarithms.
    let bound = T::constant(1e-5) + T::constant(2.2) * table.margin();
    for radius in impact.radii::<T, N>(table) {
        let critical = table.critical_speed(radius);
        let sphere = Sphere::solid(radius, T::ONE).ok();
        for speed in [critical.map(|speed| speed * T::constant(impact.over_critical)), Some(T::constant(impact.speed))]
        {
            let Some(motion) = speed.and_then(|speed| NormalMotion::new(speed).ok()) else {
                continue;
            };
            let outcome = table.classify(radius, &motion);
            let what = || format!("{table:?}: {radius:?} {motion:?} {critical:?} {outcome:?}");
            assert_eq!(outcome, table.as_slice().classify(radius, &motion), "{}", what());
            let cell = BoundarySlice::cell(smallest, margin, cells, radius).expect("the cell of a table is one");
            assert_eq!(
                outcome,
                cell.map_or(TableOutcome::OutsideTable, |cell| cell.classify(radius, &motion)),
                "{}",
                what()
            );
            if let Some(sphere) = sphere {
                let verdict = Tabulated { table: *table, sphere, friction: NoFriction }.verdict(&motion);
                assert!(verdict.is_ok_and(|verdict| verdict.class == outcome && verdict.restitution.is_none()));
            }
            let Some(critical) = critical else {
                assert_eq!(outcome, TableOutcome::OutsideTable, "{}", what());
                continue;
            };
            // The interpolation may exceed the range slightly.
            assert!(critical >= T::constant(0.5e-12) && critical <= T::constant(2e6), "{}", what());
            let expected = match motion.speed() / critical {
                ratio if ratio > T::ONE + bound => TableOutcome::Rebound,
                ratio if ratio < T::ONE - bound => TableOutcome::Capture,
                _ => outcome,
            };
            assert_eq!(outcome, expected, "{}", what());
            assert_ne!(outcome, TableOutcome::OutsideTable, "{}", what());
        }
    }
}

fn check_restitution<T: Single, const N: usize, const R: usize, const S: usize>(
    table: &RestitutionTable<T, N, R, S>,
    impact: &Impact,
) {
    let is_error = |error: T| error >= T::ZERO && error.is_finite();
    assert!(is_error(table.error()) && is_error(table.impulse_error()), "{table:?}");
    for radius in impact.radii::<T, N>(table.boundary()) {
        let critical = table.boundary().critical_speed(radius).unwrap_or(T::ONE);
        for speed in [critical * T::constant(impact.over_critical), T::constant(impact.speed)] {
            let Ok(motion) = NormalMotion::new(speed) else {
                continue;
            };
            let lookup = table.look_up(radius, &motion);
            let outcome = table.boundary().classify(radius, &motion);
            let what = || format!("{table:?}: {radius:?} {motion:?} {lookup:?} {outcome:?}");
            match lookup {
                Lookup::Rebound { rebound, error } => {
                    assert!(rebound.restitution >= T::ZERO && rebound.restitution <= T::ONE, "{}", what());
                    assert!(is_error(error) && rebound.impulse.is_finite(), "{}", what());
                    assert!(table.impulse_error_of(&lookup).is_some_and(is_error), "{}", what());
                    assert_ne!(outcome, TableOutcome::Capture, "{}", what());
                }
                Lookup::Capture => assert_ne!(outcome, TableOutcome::Rebound, "{}", what()),
                Lookup::TooCloseToCall | Lookup::OutsideTable => (),
            }
            let (Ok(sphere), Ok(friction)) =
                (Sphere::solid(radius, T::ONE), Coulomb::new(T::constant(impact.friction)))
            else {
                continue;
            };
            if let Ok(motion) = motion.with_tangential(T::constant(impact.tangential)) {
                let verdict = Tabulated { table: *table, sphere, friction }.verdict(&motion);
                let e = verdict.ok().and_then(|verdict| verdict.restitution);
                assert!(e.is_none_or(|e| e >= T::ZERO && e <= T::ONE), "{}", what());
            }
        }
    }
}
