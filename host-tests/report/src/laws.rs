//! The laws of contact: an adhesive sphere by theory, by us and by LAMMPS, and the errors of every law and damping.

use std::collections::BTreeMap;
use std::error::Error;
use std::f64::consts::PI;
use std::process::Command;
use std::time::Duration;

use boards::process;
use microimpact::contact::{Adaptive, Contact, ContactLaw, JkrEnd, JkrLaw};
use microimpact::{InputError, NormalMotion, Sphere, Stiffness};
use reference::laws::{self, Row};

use crate::content::{Cell, Part, Run, Section, Table};
use crate::paper::{column, figure, spaced};
use crate::plot::{self, Axis, Line, Mark};

/// Impacts with the restitution that LAMMPS finds, as `impacts.py` prints them.
const STORED: &str = include_str!("../../data/lammps.csv");
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/lammps.csv");
const PROGRAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/src/laws/impacts.py");
const LIMIT: Duration = Duration::from_secs(120);

/// Tolerance of every simulation of this section.
const TOLERANCE: f64 = 1e-12;

/// Speeds of a curve over the critical speed.
const SPEEDS: (f64, f64, u32) = (0.5, 10.0, 401);
/// Of so many speeds of a curve one is drawn as a symbol.
const STRIDE: usize = 20;

const RATIO: &str = "approach speed over critical speed, v/V_s";

pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let parts = parts(run).map_err(|error| error.to_string())?;
    Ok(Section { title: "Laws of contact", name: "laws", parts, ..Section::default() })
}

fn parts(run: &Run) -> Result<Vec<Part>, Box<dyn Error>> {
    let (rows, source) = by_lammps(run)?;
    let elastic = Elastic::of(rows.first().ok_or("no impact by LAMMPS")?)?;
    let unit = elastic.critical(JkrEnd::SnapOff);
    Ok(vec![
        elastic.figure(&rows)?,
        damped(&rows, unit)?,
        Part::Fold("Errors of every law and damping".to_owned(), vec![errors()?]),
        Part::Fold("Every impact by LAMMPS".to_owned(), vec![Part::Text(source), comparison(&rows, unit)?]),
        Part::Fold("The two ends of an adhesive contact".to_owned(), vec![Part::Text(elastic.ends())]),
    ])
}

/// The impacts by LAMMPS, new ones where it is installed, and a sentence that says where they are from.
fn by_lammps(run: &Run) -> Result<(Vec<Row>, String), Box<dyn Error>> {
    let _progress = run.progress(1, "LAMMPS");
    let stored = laws::rows(STORED);
    let version = |rows: &[Row]| rows.first().map_or_else(String::new, |row| row.text("version").to_owned());
    let finished =
        process::run(Command::new("python3").args([PROGRAM, FILE]), LIMIT).map_err(|error| error.to_string());
    match finished.and_then(|finished| finished.succeeded("LAMMPS", 1)) {
        Ok(finished) => {
            let new = laws::rows(&finished.stdout);
            let pairs =
                new.iter().zip(&stored).map(|(new, stored)| Some((restitution(new)? - restitution(stored)?).abs()));
            let apart = pairs.collect::<Option<Vec<_>>>().ok_or("a restitution is missing")?;
            let (new_version, old) = (version(&new), version(&stored));
            let apart = apart.into_iter().fold(0.0, f64::max);
            let text = format!(
                "LAMMPS, version {new_version}, ran for this page. Its results differ from those of version {old} in \
                 `host-tests/data/lammps.csv` by at most {apart:.6} in e."
            );
            Ok((new, text))
        }
        Err(error) => {
            let text = format!(
                "The results of LAMMPS are those of version {} in `host-tests/data/lammps.csv`. Where Python has the package \
                 `lammps`, LAMMPS runs for this page. Here it did not: {error}",
                version(&stored)
            );
            Ok((stored, text))
        }
    }
}

fn restitution(row: &Row) -> Option<f64> {
    row.number("restitution")
}

/// A sphere whose contact is elastic and adhesive.
struct Elastic {
    sphere: Sphere<f64>,
    stiffness: Stiffness<f64>,
    /// Of adhesion, G in J/m^2.
    work: f64,
}

impl Elastic {
    /// That of an impact, without its damping.
    fn of(row: &Row) -> Result<Self, Box<dyn Error>> {
        let [radius, density, stiffness, work, ..] = row.inputs();
        Ok(Self { sphere: Sphere::solid(radius, density)?, stiffness: Stiffness::new(stiffness)?, work })
    }

    /// V_s = sqrt(2 W/m) with the work W of the contact from the radius a_0 of first contact to its end. From the force of
    /// Johnson, Kendall and Roberts (1971), W = pi G a_0^2 (3/5 + x^2 - (8/3) x^(7/2) + (16/15) x^5) at the radius x a_0, with
    /// a_0^3 = 2 pi G r^2/E*; x^3 is 1/16 at snap-off and 9/16 at pull-off.
    fn critical(&self, end: JkrEnd) -> f64 {
        let cube: f64 = match end {
            JkrEnd::SnapOff => 1.0 / 16.0,
            JkrEnd::PullOff => 9.0 / 16.0,
        };
        let modulus = 0.75 * self.stiffness.pascals();
        let first = (2.0 * PI * self.work * self.sphere.radius().powi(2) / modulus).cbrt();
        let square = cube.cbrt().powi(2);
        let work = 0.6 + square * (1.0 - 8.0 / 3.0 * cube.sqrt() + 16.0 / 15.0 * cube);
        (2.0 * PI * self.work * first * first * work / self.sphere.mass()).sqrt()
    }

    fn exact(&self, end: JkrEnd, speed: f64) -> f64 {
        (1.0 - (self.critical(end) / speed).powi(2)).max(0.0).sqrt()
    }

    fn ours(&self, end: JkrEnd, speed: f64) -> Result<f64, InputError> {
        let law = JkrLaw::new(self.stiffness, self.work)?.ending_at(end);
        restitution_at(&Contact::new(self.sphere, law), speed)
    }

    /// How both ends of contact differ.
    fn ends(&self) -> String {
        let ratio = self.critical(JkrEnd::PullOff) / self.critical(JkrEnd::SnapOff);
        format!(
            "The sphere has a radius of {:e} m, a density of {} kg/m^3, a stiffness K of {:e} Pa and a work of adhesion of {} J/m^2. \
             In theory the contact ends at snap-off (Thornton and Ning 1998). `jkr` of LAMMPS ends it at pull-off, where the \
             tension is largest. At pull-off an undamped sphere has lost {:.1} % of the energy that it loses at snap-off, and it is \
             captured up to {ratio:.3} of the critical speed.",
            self.sphere.radius(),
            self.sphere.density(),
            self.stiffness.pascals(),
            self.work,
            100.0 * ratio * ratio
        )
    }

    fn figure(&self, lammps: &[Row]) -> Result<Part, Box<dyn Error>> {
        let unit = self.critical(JkrEnd::SnapOff);
        let row = |ratio| {
            let speed = ratio * unit;
            let both = |end| Ok([self.exact(end, speed), self.ours(end, speed)?]);
            let ([snap, our_snap], [pull, our_pull]) = (both(JkrEnd::SnapOff)?, both(JkrEnd::PullOff)?);
            Ok([ratio, snap, our_snap, pull, our_pull])
        };
        let rows = spaced(SPEEDS.0, SPEEDS.1, SPEEDS.2).map(row).collect::<Result<Vec<_>, InputError>>()?;
        let difference = rows.iter().flat_map(|row| [(row[1], row[2]), (row[3], row[4])]);
        let largest = difference.map(|(exact, ours)| (exact * exact - ours * ours).abs()).fold(0.0, f64::max);
        let symbols = |index| column(&rows, index).into_iter().step_by(STRIDE).collect();
        let lines = [
            Line::new("exact, snap-off", Mark::Solid, column(&rows, 1)),
            Line::new("ours, snap-off", Mark::Points, symbols(2)).like(0),
            Line::new("exact, pull-off", Mark::Dashed, column(&rows, 3)).like(1),
            Line::new("ours, pull-off", Mark::Points, symbols(4)).like(1),
            Line::new("LAMMPS, jkr", Mark::Points, points(lammps, ("jkr", "none"), unit)).beside(6),
        ];
        let caption = format!(
            "Without damping e^2 = 1 - (V_s/v)^2 is exact, with the critical speed V_s of each end of contact. The axis has \
             that of snap-off. Ours differ by at most {largest:.1e} in e^2."
        );
        Ok(figure(
            "Elastic contact with the adhesion of Johnson, Kendall and Roberts",
            plot::chart(&ratio_axis(), &restitution_axis(), &lines)?,
            "laws-jkr",
            &caption,
            [RATIO, "e, exact, snap-off", "e, ours, snap-off", "e, exact, pull-off", "e, ours, pull-off"],
            rows,
        ))
    }
}

fn ratio_axis() -> Axis {
    Axis::logarithmic("approach speed over critical speed", "v/V_s", "1").between(SPEEDS.0, SPEEDS.1)
}

fn restitution_axis() -> Axis {
    Axis::linear("restitution", "e", "1").between(0.0, 1.05)
}

/// Impacts by a law with a damping.
fn of<'a>(rows: &'a [Row], (law, damping): (&str, &str)) -> impl Iterator<Item = &'a Row> {
    rows.iter().filter(move |row| row.text("law") == law && row.text("damping") == damping)
}

/// Their speeds over `unit`, and restitutions.
fn points(rows: &[Row], law: (&str, &str), unit: f64) -> Vec<(f64, f64)> {
    of(rows, law).filter_map(|row| Some((row.number("speed_normal_m_s")? / unit, restitution(row)?))).collect()
}

/// Ours at a speed.
fn restitution_at(scene: &Contact<f64, impl ContactLaw<f64>>, speed: f64) -> Result<f64, InputError> {
    Ok(scene.solve_normal(&NormalMotion::new(speed)?, &Adaptive::new(TOLERANCE)?)?.overall_restitution())
}

/// The laws that LAMMPS has besides elastic contact, in the order of their colours.
const DAMPED: [(&str, &str); 3] = [("dmt", "none"), ("dmt", "viscoelastic"), ("jkr", "viscoelastic")];

fn damped(lammps: &[Row], unit: f64) -> Result<Part, Box<dyn Error>> {
    let [first, second, third] = DAMPED
        .map(|law| of(lammps, law).next().map(|row| row.scene(row.inputs())).ok_or("no impact by a law of LAMMPS"));
    let scenes = [first??, second??, third??];
    let row = |ratio| {
        let ours = |scene| restitution_at(scene, ratio * unit);
        let [first, second, third] = &scenes;
        Ok([ratio, ours(first)?, ours(second)?, ours(third)?])
    };
    let rows = spaced(SPEEDS.0, SPEEDS.1, SPEEDS.2).map(row).collect::<Result<Vec<_>, InputError>>()?;
    let lines: Vec<_> = DAMPED
        .iter()
        .enumerate()
        .flat_map(|(place, (law, damping))| {
            let name = |source| format!("{source}, {law}, {}", if *damping == "none" { "undamped" } else { damping });
            [
                Line::new(&name("ours"), Mark::Solid, column(&rows, place + 1)).like(place),
                Line::new(&name("LAMMPS"), Mark::Points, points(lammps, (law, damping), unit)).like(place),
            ]
        })
        .collect();
    Ok(figure(
        "The same laws in LAMMPS",
        plot::chart(&ratio_axis(), &restitution_axis(), &lines)?,
        "laws-damped",
        "The sphere of the figure beside it with the adhesion of Derjaguin, Muller and Toporov (dmt), where without damping e = 1, \
         and with viscoelastic damping. Both programs have the same law, damping and end of contact; that of jkr is pull-off.",
        [RATIO, "e, ours, dmt, undamped", "e, ours, dmt, viscoelastic", "e, ours, jkr, viscoelastic"],
        rows,
    ))
}

/// Every impact by LAMMPS with ours.
fn comparison(lammps: &[Row], unit: f64) -> Result<Part, Box<dyn Error>> {
    let row = |row: &Row| -> Result<Vec<Cell>, Box<dyn Error>> {
        let speed = row.number("speed_normal_m_s").ok_or("an impact without its speed")?;
        let theirs = restitution(row).ok_or("an impact without its restitution")?;
        let ours = restitution_at(&row.scene(row.inputs())?, speed)?;
        let names = ["law", "end_rule", "damping"].map(|column| Cell::from(row.text(column)));
        let numbers = [speed / unit, theirs, ours, theirs * theirs - ours * ours].map(Cell::from);
        Ok(names.into_iter().chain(numbers).collect())
    };
    let columns = ["law", "end of contact", "damping", RATIO, "e, LAMMPS", "e, ours", "difference of e^2"];
    Ok(Part::Table(Table {
        name: "laws-lammps".to_owned(),
        caption: "Every impact by LAMMPS with ours. LAMMPS takes fixed steps in time, and ends a contact at the end of a step."
            .to_owned(),
        columns: columns.map(str::to_owned).into(),
        rows: lammps.iter().map(row).collect::<Result<_, _>>()?,
    }))
}

/// What is wrong with the impacts of one law and damping.
#[derive(Default)]
struct Errors {
    impacts: u64,
    outcomes: u64,
    /// Largest error of e^2, then relative ones of the peak indentation, its time, and the contact time.
    largest: [f64; 4],
}

fn errors() -> Result<Part, Box<dyn Error>> {
    let method = Adaptive::new(TOLERANCE)?;
    let rows = laws::impacts();
    let mut groups: BTreeMap<_, Errors> = BTreeMap::new();
    for row in &rows {
        let errors = groups.entry(["law", "end_rule", "damping"].map(|column| row.text(column))).or_default();
        let (outcome, found) = row.solve(row.inputs(), &method)?;
        errors.impacts += 1;
        errors.outcomes += u64::from(outcome != Some(row.outcome()));
        for (index, exact) in row.solution().into_iter().enumerate() {
            let Some(exact) = exact else { continue };
            let unit = if index == 0 { 1.0 } else { exact };
            let error = found[index].map_or(f64::INFINITY, |found| (found - exact).abs() / unit);
            errors.largest[index] = errors.largest[index].max(error);
        }
    }
    let row = |(names, errors): ([&str; 3], Errors)| {
        let counts = [errors.impacts, errors.outcomes].map(Cell::Count);
        let [square, indentation, _, contact] = errors.largest;
        names.map(Cell::from).into_iter().chain(counts).chain([square, contact, indentation].map(Cell::from)).collect()
    };
    let columns = [
        "law",
        "end of contact",
        "damping",
        "impacts",
        "wrong outcomes",
        "error of e^2",
        "relative error of contact time",
        "relative error of peak indentation",
    ];
    let caption = format!(
        "Largest errors of Adaptive in f64 with a tolerance of {TOLERANCE:.0e} over the {} impacts of host-tests/data/laws.csv, \
         solved to 20 digits. A rounded input changes the contact time most beside a critical speed.",
        rows.len()
    );
    Ok(Part::Table(Table {
        name: "laws-errors".to_owned(),
        caption,
        columns: columns.map(str::to_owned).into(),
        rows: groups.into_iter().map(row).collect(),
    }))
}
