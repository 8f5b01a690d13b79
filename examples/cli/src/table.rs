//! Makes a table of critical speeds by the contact simulation, for firmware that does not compute it itself.
//!
//! `cargo microimpact table` writes a Rust constant for the paper's surface, `--format restitution-rust` one with restitution;
//! `cargo microimpact table --format c` an array for C, with the function that reads it;
//! `cargo microimpact table --format fluent`, or another simulation program, the restitution against the approach speed.

use std::error::Error;
use std::io::{self, Write};

use clap::{Args, ValueEnum};
use export::rounded_up;
use microimpact::contact::{AnyLaw, Collocation, Contact};
use microimpact::table::BoundaryTable;
use microimpact::{InputError, Sphere};
use sheet::Value;

use crate::Streams;
use crate::command::{Format, exit_status, say, write_records};
use crate::law_options::{FURTHER, LawOptions};
use crate::restitution_constant::{self, Subject};
use crate::restitution_table::{self, Program, RestitutionOptions};

/// Make a table of critical speeds for firmware, or of restitution for programs that simulate particles
///
/// Options default to the values of the paper (zeta_A = 6.25 is half of the printed value, as in the paper's program). Cells
/// divide each octave of radii into four; the table starts with the cell that contains the smallest radius.
#[derive(Args)]
#[command(
    allow_negative_numbers = true,
    after_help = format!("{FURTHER}\n{EXAMPLE}")
)]
pub struct Options {
    /// Smallest radius, m
    #[arg(long, default_value_t = 1e-6)]
    smallest_radius: f64,
    /// Number of cells, four for each octave of radii
    #[arg(long, default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=MOST_CELLS as i64))]
    cells: u32,
    /// Density of the spheres, kg/m^3
    #[arg(long, default_value_t = 2600.0)]
    density: f64,
    #[command(flatten)]
    law: LawOptions,
    /// Language of the table
    #[arg(long, value_enum, default_value_t = Language::Rust)]
    format: Language,
    #[command(flatten)]
    restitution: RestitutionOptions,
}

const EXAMPLE: &str = "\
Example: a table for C
  cargo microimpact table --format c
Exit status: 0 on success; 2 if there is no such table (standard error says why).";

/// Language of the table.
#[derive(Clone, Copy, ValueEnum)]
enum Language {
    // A constant.
    Rust,
    // The same with restitution.
    RestitutionRust,
    // Constants and a function for C99.
    C,
    // A row for each cell, in one of the formats of the other commands.
    Table,
    Csv,
    Json,
    // Restitution against approach speed.
    Fluent,
    Acutrace,
    Comsol,
    Openfoam,
    RestitutionCsv,
}

/// What a format holds.
enum Content {
    CriticalSpeeds(Written),
    RestitutionConstant,
    Restitution(Program),
}

/// How a table of critical speeds is written.
enum Written {
    Rust,
    C,
    Rows(Format),
}

impl Language {
    fn content(self) -> Content {
        match self {
            Self::Rust => Content::CriticalSpeeds(Written::Rust),
            Self::RestitutionRust => Content::RestitutionConstant,
            Self::C => Content::CriticalSpeeds(Written::C),
            Self::Table => Content::CriticalSpeeds(Written::Rows(Format::Table)),
            Self::Csv => Content::CriticalSpeeds(Written::Rows(Format::Csv)),
            Self::Json => Content::CriticalSpeeds(Written::Rows(Format::Json)),
            Self::Fluent => Content::Restitution(Program::Fluent),
            Self::Acutrace => Content::Restitution(Program::AcuTrace),
            Self::Comsol => Content::Restitution(Program::Comsol),
            Self::Openfoam => Content::Restitution(Program::OpenFoam),
            Self::RestitutionCsv => Content::Restitution(Program::Any),
        }
    }
}

/// Eight octaves.
const MOST_CELLS: usize = 32;
const CELLS_OF_OCTAVE: f64 = 4.0;

/// The parts of a table whose length was chosen at run time.
struct Parts {
    smallest: f32,
    margin: u32,
    relative_margin: f64,
    cells: Vec<[i32; 4]>,
}

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status("table", run(self, streams).map(|()| 0), streams.errors)
    }

    fn parts<const N: usize>(&self, law: AnyLaw<f64>) -> Result<Parts, InputError> {
        let method = Collocation::<9, f64>::new(1e-9)?;
        let table = BoundaryTable::<N>::new(self.smallest_radius, |radius| {
            let sphere = Sphere::solid(radius, self.density)?;
            Contact::new(sphere, law).critical_speed(&method)
        })?;
        let (smallest, margin, cells) = table.parts();
        Ok(Parts { smallest, margin, relative_margin: table.margin(), cells: cells.to_vec() })
    }

    /// The table with the number of cells asked for, which is part of its type.
    fn table(&self, law: AnyLaw<f64>) -> Result<Parts, InputError> {
        macro_rules! of_length {
            ($($cells:literal)*) => {
                match self.cells {
                    $($cells => self.parts::<$cells>(law),)*
                    _ => self.parts::<MOST_CELLS>(law),
                }
            };
        }
        of_length!(1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31)
    }

    /// The materials in words.
    fn materials(&self) -> String {
        format!("density {} kg/m^3, {}", self.density, self.law.in_words())
    }
}

fn run(options: &Options, streams: &mut Streams<'_>) -> Result<(), Box<dyn Error>> {
    let (law, to) = (options.law.law()?, &mut *streams.output);
    let written = match options.format.content() {
        Content::CriticalSpeeds(written) => {
            if let Some(option) = options.restitution.given() {
                return Err(format!(
                    "{option} is refused: a table of critical speeds has no use for it; leave it out, or choose a --format of restitution"
                )
                .into());
            }
            written
        }
        Content::RestitutionConstant => {
            if let Some(option) = options.restitution.given_of_grid() {
                return Err(format!(
                    "{option} is refused: a table of restitution for firmware has cells, by --cells, and states its error; leave it out"
                )
                .into());
            }
            let subject = Subject {
                smallest_radius: options.smallest_radius,
                fastest: options.restitution.fastest(),
                density: options.density,
                law,
                materials: options.materials(),
            };
            return restitution_constant::write(to, options.cells, &subject);
        }
        Content::Restitution(program) => {
            let octaves = f64::from(options.cells) / CELLS_OF_OCTAVE;
            let radii = [options.smallest_radius, options.smallest_radius * octaves.exp2()];
            let (restitution, materials) = (&options.restitution, options.materials());
            let covered = restitution_table::write(to, program, restitution, radii, options.density, law, materials)?;
            say("table", Some(covered), streams.errors);
            return Ok(());
        }
    };
    let parts = options.table(law).map_err(|error| -> Box<dyn Error> {
        if error.value == f32::INFINITY {
            "spheres of some radii of the table are captured at every speed up to 1e6 m/s; choose a larger --smallest-radius, or less \
             adhesion or damping"
                .into()
        } else {
            error.into()
        }
    })?;
    let subject = format!("{}; greatest relative error {:e}", options.materials(), rounded_up(parts.relative_margin));
    match written {
        Written::Rust => rust(to, &parts, &subject),
        Written::C => c(to, &parts, &subject),
        Written::Rows(format) => rows(to, &parts, format),
    }?;
    Ok(())
}

fn rust(to: &mut dyn Write, parts: &Parts, subject: &str) -> io::Result<()> {
    let Parts { smallest, margin, cells, .. } = parts;
    let count = cells.len();
    writeln!(to, "/// Critical speeds: {subject}.")?;
    writeln!(to, "const BOUNDARY: microimpact::table::BoundaryTable<{count}> =")?;
    writeln!(to, "    match microimpact::table::BoundaryTable::from_parts({smallest:e}, {margin}, [")?;
    for [constant, linear, square, cube] in cells {
        writeln!(to, "        [{constant}, {linear}, {square}, {cube}],")?;
    }
    writeln!(to, "    ]) {{")?;
    writeln!(to, "        Ok(table) => table,")?;
    writeln!(to, "        Err(_) => panic!(\"no boundary table\"),")?;
    writeln!(to, "    }};")
}

fn c(to: &mut dyn Write, parts: &Parts, subject: &str) -> io::Result<()> {
    let Parts { smallest, margin, cells, .. } = parts;
    writeln!(to, "/* Critical speeds: {subject}. */")?;
    writeln!(to, "#include <stdint.h>\n#include <string.h>\n")?;
    writeln!(
        to,
        "/* With microimpact.h: {{BOUNDARY_SMALLEST_RADIUS, BOUNDARY_MARGIN, boundary, BOUNDARY_CELLS}} is a table. */"
    )?;
    writeln!(to, "#define BOUNDARY_CELLS {}u", cells.len())?;
    writeln!(to, "#define BOUNDARY_SMALLEST_RADIUS {smallest:e}f /* m */")?;
    writeln!(to, "#define BOUNDARY_FIRST {}u /* bits of the smallest radius */", smallest.to_bits())?;
    writeln!(to, "#define BOUNDARY_MARGIN {margin}u\n")?;
    writeln!(to, "static const int32_t boundary[BOUNDARY_CELLS][4] = {{")?;
    for [constant, linear, square, cube] in cells {
        writeln!(to, "    {{{constant}, {linear}, {square}, {cube}}},")?;
    }
    writeln!(to, "}};\n")?;
    write!(to, "{C_FUNCTION}")
}

/// The same arithmetic as that of the library; a test compares the two.
const C_FUNCTION: &str = "\
enum boundary_verdict { BOUNDARY_REBOUND, BOUNDARY_CAPTURE, BOUNDARY_TOO_CLOSE_TO_CALL, BOUNDARY_OUTSIDE_TABLE };

/* Radius in m; approach speed in m/s, from 1e-12 to 1e6. Right shifts of negative numbers keep the sign. */
static inline enum boundary_verdict boundary_classify(float radius, float speed)
{
    uint32_t r, v, from_first, f, q;
    memcpy(&r, &radius, sizeof r);
    memcpy(&v, &speed, sizeof v);
    from_first = r - BOUNDARY_FIRST;
    if ((from_first >> 21) >= BOUNDARY_CELLS || v < 0x2b8cbcccu || v > 0x49742400u)
        return BOUNDARY_OUTSIDE_TABLE;
    const int32_t *cell = boundary[from_first >> 21];
    int64_t place = (int64_t)((from_first >> 5) & 0xffffu) - 0x8000;
    int32_t edge = cell[3];
    for (int i = 2; i >= 0; i--)
        edge = cell[i] + (int32_t)((edge * place) >> 16);
    f = (v >> 7) & 0xffffu;
    q = 19455u - ((5918u * f) >> 16);
    q = 35020u - ((q * f) >> 16);
    q = 57923u - ((q * f) >> 16);
    int32_t excess = (int32_t)(v + ((((f * (0x10000u - f)) >> 14) * q) >> 12)) - edge;
    if (excess < 0)
        return BOUNDARY_CAPTURE;
    return (uint32_t)excess <= 2u * BOUNDARY_MARGIN ? BOUNDARY_TOO_CLOSE_TO_CALL : BOUNDARY_REBOUND;
}
";

/// The columns of a cell of the table.
const COLUMNS: [&str; 7] = ["radius_from_m", "radius_to_m", "constant", "linear", "square", "cube", "margin"];

fn rows(to: &mut dyn Write, parts: &Parts, format: Format) -> io::Result<()> {
    let records = parts.cells.iter().enumerate().map(|(k, cell)| {
        // Each cell spans 2^21 steps of the bits of a radius.
        let radius = |k: usize| Value::Single(f32::from_bits(parts.smallest.to_bits() + ((k as u32) << 21)));
        let coefficients = cell.map(|coefficient| Value::Integer(coefficient.into()));
        [radius(k), radius(k + 1)]
            .into_iter()
            .chain(coefficients)
            .chain([Value::Integer(parts.margin.into())])
            .collect()
    });
    write_records(format, &COLUMNS, 0, records, to)
}
