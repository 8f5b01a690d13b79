//! Classifies impacts with the rigid-body model.
//!
//! `cargo run --release --example classify` shows impacts of the paper;
//! `cargo run --release --example classify -- FILE.csv --format csv` adds the result to each row of a table.

mod sheet;

use std::error::Error;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};
use comfy_table::{Cell, CellAlignment, ContentArrangement, Table, presets};
use microimpact::rigid::ReboundAdhesion;
use microimpact::{
    Classification, ConstantRestitution, ContactClass, Impact, NormalMotion, Outcome, PlanarMotion, RestitutionLaw,
    RigidBody, SpeedRestitution, Sphere, SurfaceMotion, TangentialImpact,
};
use sheet::{Row, Scalar, Sheet};

const BUNDLED: &str = include_str!("impacts.csv");

/// Columns that are computed, in the order they are written.
const COMPUTED: [&str; 16] = [
    "outcome",
    "motion",
    "overall_restitution",
    "rebound_speed_m_s",
    "speed_tangential_out_m_s",
    "spin_out_rad_s",
    "impulse_ratio_out",
    "rolling_ratio",
    "speed_over_critical",
    "friction_over_limit",
    "energy_before_j",
    "work_material_j",
    "work_adhesion_j",
    "work_friction_j",
    "work_rolling_j",
    "error",
];

/// Classify impacts of microspheres: rebound sliding or rolling, or capture.
///
/// Columns read, in SI units:
///   radius_m, density_kg_m3, speed_normal_m_s (approach speed);
///   restitution (R) or restitution_speed_m_s (k of R = k/(k + v)).
/// Optional, with what an empty cell means:
///   gyration_ratio (k^2/r^2; 0.4, solid), speed_tangential_m_s (0), spin_rad_s (0),
///   adhesion_coefficient (rho) or work_of_adhesion_j (none),
///   friction (Coulomb's f; 0) or, before it, impulse_ratio (mu),
///   rolling_arm_m (mu_m a_c; none).
/// All other columns pass through; one that is named like a computed column is kept as input_NAME.
///
/// Exit status: 0, or 1 if a row was bad (its reason stands in the column `error`), or 2 if nothing could be read.
#[derive(Parser)]
#[command(name = "classify", verbatim_doc_comment)]
struct Options {
    /// Table of impacts; `-` for standard input. Without it, impacts of the paper.
    file: Option<PathBuf>,
    /// A table to read, or the whole result for a spreadsheet.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Number type to compute in.
    #[arg(long, value_enum, default_value_t = ScalarType::F64)]
    scalar: ScalarType,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Table,
    Csv,
}

#[derive(Clone, Copy, ValueEnum)]
enum ScalarType {
    F32,
    F64,
}

fn main() -> ExitCode {
    let options = Options::parse();
    let result = match options.scalar {
        ScalarType::F32 => run::<f32>(&options),
        ScalarType::F64 => run::<f64>(&options),
    };
    match result {
        Ok(0) => ExitCode::SUCCESS,
        Ok(bad_rows) => {
            eprintln!("classify: {bad_rows} bad rows; the column `error` says why");
            ExitCode::from(1)
        }
        Err(error) if is_broken_pipe(error.as_ref()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("classify: {error}");
            ExitCode::from(2)
        }
    }
}

/// Whether the reader of our output has gone away, as `head` does.
fn is_broken_pipe(error: &(dyn Error + 'static)) -> bool {
    let io_error = match error.downcast_ref::<csv::Error>().map(csv::Error::kind) {
        Some(csv::ErrorKind::Io(error)) => Some(error),
        _ => error.downcast_ref::<io::Error>(),
    };
    io_error.is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

/// Classifies all rows; the number of bad ones.
fn run<T: Scalar>(options: &Options) -> Result<usize, Box<dyn Error>> {
    let source: Box<dyn BufRead> = match &options.file {
        None => Box::new(BUNDLED.as_bytes()),
        Some(path) if path.as_os_str() == "-" => Box::new(io::stdin().lock()),
        Some(path) => {
            Box::new(BufReader::new(File::open(path).map_err(|error| format!("{}: {error}", path.display()))?))
        }
    };
    let sheet = Sheet::open(source)?;
    let sink = io::stdout().lock();
    match options.format {
        Format::Csv => write_csv::<T>(sheet, sink),
        Format::Table => write_table::<T>(sheet, sink),
    }
}

fn write_csv<T: Scalar>(mut sheet: Sheet<Box<dyn BufRead + '_>>, sink: impl Write) -> Result<usize, Box<dyn Error>> {
    let mut writer = sheet.writer(io::BufWriter::new(sink), &COMPUTED)?;
    let mut bad_rows = 0;
    while let Some(row) = sheet.next_row()? {
        let cells = match classify::<T>(&row) {
            Ok(result) => result.cells(&row),
            Err(reason) => {
                bad_rows += 1;
                let mut cells = vec![String::new(); COMPUTED.len() - 1];
                cells.push(reason);
                cells
            }
        };
        writer.write(&row, &cells)?;
    }
    writer.finish()?;
    Ok(bad_rows)
}

fn write_table<T: Scalar>(
    mut sheet: Sheet<Box<dyn BufRead + '_>>,
    mut sink: impl Write,
) -> Result<usize, Box<dyn Error>> {
    let header = [
        "impact",
        "class",
        "e",
        "V_n\nm/s",
        "V_t\nm/s",
        "spin\nrad/s",
        "mu",
        "mu_0",
        "speed over\ncritical",
        "friction\nover mu_0",
        "energy\nlost %",
    ];
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_content_arrangement(ContentArrangement::Dynamic);
    table.set_header(header);
    for column in table.column_iter_mut().skip(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    let (mut number, mut bad_rows) = (0, 0);
    while let Some(row) = sheet.next_row()? {
        number += 1;
        let name = row.text("name").unwrap_or_else(|| format!("row {number}"));
        match classify::<T>(&row) {
            Ok(result) => table.add_row(result.line(&name)),
            Err(reason) => {
                bad_rows += 1;
                table.add_row(vec![name, format!("bad row: {reason}")])
            }
        };
    }
    writeln!(sink, "{table}")?;
    Ok(bad_rows)
}

/// An impact and its class.
struct Classified<T> {
    sphere: Sphere<T>,
    impact: Impact<T, TangentialImpact<T>>,
    classification: Classification<T, ContactClass<T>>,
}

/// Reads a row, builds its scene and classifies the impact.
fn classify<T: Scalar>(row: &Row<'_>) -> Result<Classified<T>, String> {
    row.check()?;
    let required = |column: &str| row.number::<T>(column)?.ok_or_else(|| format!("{column}: missing"));
    let or_zero = |column: &str| Ok::<T, String>(row.number(column)?.unwrap_or(T::ZERO));

    let gyration_ratio = row.number("gyration_ratio")?.unwrap_or(T::constant(0.4));
    let sphere = Sphere::new(required("radius_m")?, required("density_kg_m3")?, gyration_ratio).map_err(reason)?;
    let (speed, tangential) = (required("speed_normal_m_s")?, or_zero("speed_tangential_m_s")?);
    let spin = or_zero("spin_rad_s")?;
    let before = NormalMotion::new(speed)
        .and_then(|motion| motion.with_tangential(tangential))
        .and_then(|motion| motion.with_spin(&sphere, spin))
        .map_err(reason)?;

    match (row.number("restitution")?, row.number("restitution_speed_m_s")?) {
        (Some(r), None) => with_law(row, sphere, &before, ConstantRestitution::new(r).map_err(reason)?),
        (None, Some(k)) => with_law(row, sphere, &before, SpeedRestitution::new(k).map_err(reason)?),
        (None, None) => Err("restitution: missing; give restitution or restitution_speed_m_s".into()),
        (Some(_), Some(_)) => Err("restitution: given twice, as restitution and restitution_speed_m_s".into()),
    }
}

/// Chooses the adhesion that the row gives.
fn with_law<T: Scalar>(
    row: &Row<'_>,
    sphere: Sphere<T>,
    before: &PlanarMotion<T>,
    law: impl RestitutionLaw<T> + Copy,
) -> Result<Classified<T>, String> {
    let scene = RigidBody::new(sphere, law);
    match (row.number("adhesion_coefficient")?, row.number("work_of_adhesion_j")?) {
        (None, None) => with_adhesion(row, before, scene),
        (Some(rho), None) => with_adhesion(row, before, scene.with_adhesion_coefficient(rho).map_err(reason)?),
        (None, Some(work)) => with_adhesion(row, before, scene.with_work_of_adhesion(work).map_err(reason)?),
        (Some(_), Some(_)) => Err("adhesion: given twice, as adhesion_coefficient and work_of_adhesion_j".into()),
    }
}

/// Chooses the tangential process that the row gives, and computes.
fn with_adhesion<T: Scalar>(
    row: &Row<'_>,
    before: &PlanarMotion<T>,
    scene: RigidBody<T, impl RestitutionLaw<T> + Copy, impl ReboundAdhesion<T> + Copy>,
) -> Result<Classified<T>, String> {
    let friction = row.number("friction")?.unwrap_or(T::ZERO);
    let impact = match (row.number("impulse_ratio")?, row.number("rolling_arm_m")?) {
        (Some(mu), None) => scene.impact_with_ratio(before, mu).map_err(reason)?,
        (None, None) => scene.with_friction(friction).map_err(reason)?.impact(before),
        (None, Some(arm)) => {
            let scene = scene.with_friction(friction).and_then(|scene| scene.with_rolling_dissipation(arm));
            scene.map_err(reason)?.impact(before)
        }
        (Some(_), Some(_)) => return Err("rolling_arm_m: not with impulse_ratio, which covers it".into()),
    };
    Ok(Classified { sphere: *scene.sphere(), classification: scene.classify_impact(&impact), impact })
}

fn reason(error: impl Error) -> String {
    error.to_string()
}

impl<T: Scalar> Classified<T> {
    /// The computed cells of a row.
    fn cells(&self, row: &Row<'_>) -> Vec<String> {
        let Self { sphere, impact: Impact { normal, tangential }, classification } = self;
        let ledger = self.impact.energy(sphere);
        let optional = |value: Option<T>| value.map(|value| row.cell(value)).unwrap_or_default();
        vec![
            outcome_name(classification.outcome).into(),
            motion_name(classification.contact.motion).into(),
            row.cell(normal.overall_restitution()),
            row.cell(normal.rebound_speed()),
            row.cell(tangential.tangential()),
            row.cell(tangential.spin(sphere)),
            row.cell(tangential.impulse_ratio()),
            row.cell(tangential.rolling_ratio()),
            optional(classification.speed_over_critical),
            optional(classification.contact.friction_over_limit),
            row.cell(ledger.before),
            row.cell(ledger.material),
            row.cell(ledger.adhesion),
            row.cell(ledger.friction),
            row.cell(ledger.rolling),
            String::new(),
        ]
    }

    /// The line of the readable table.
    fn line(&self, name: &str) -> Vec<Cell> {
        let Self { sphere, impact: Impact { normal, tangential }, classification } = self;
        let ledger = self.impact.energy(sphere);
        let optional = |value: Option<T>| value.map_or("-".into(), |value| format!("{value:.3}"));
        [
            name.into(),
            classification.class().to_string(),
            format!("{:.3}", normal.overall_restitution()),
            format!("{:.3}", normal.rebound_speed()),
            format!("{:.3}", tangential.tangential()),
            format!("{:.2e}", tangential.spin(sphere)),
            format!("{:.4}", tangential.impulse_ratio()),
            format!("{:.4}", tangential.rolling_ratio()),
            optional(classification.speed_over_critical),
            optional(classification.contact.friction_over_limit),
            format!("{:.1}", T::constant(100.0) * ledger.lost() / ledger.before),
        ]
        .into_iter()
        .map(Cell::new)
        .collect()
    }
}

fn outcome_name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Rebound => "rebound",
        Outcome::Capture => "capture",
    }
}

fn motion_name(motion: SurfaceMotion) -> &'static str {
    match motion {
        SurfaceMotion::Sliding => "sliding",
        SurfaceMotion::Rolling => "rolling",
        SurfaceMotion::Resting => "resting",
    }
}
