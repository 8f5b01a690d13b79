//! A restitution table as a constant for firmware.

use std::error::Error;
use std::io::Write;

use export::rounded_up;
use microimpact::contact::{Adaptive, AnyLaw, Contact, Impulses};
use microimpact::table::{BoundaryTable, RestitutionParts, RestitutionTable, TableRebound};
use microimpact::{InputError, NormalMotion, Parameter, Sphere};

/// Radii and speeds of the table: with these the error of the paper's table is a thousandth over one octave of radii, and .02 over six.
const RADII: usize = 12;
const SPEEDS: usize = 12;

/// Tolerance of the simulations.
const TOLERANCE: f64 = 1e-9;

/// What the table is for.
pub struct Subject {
    pub smallest_radius: f64,
    /// Largest speed, m/s.
    pub fastest: f64,
    pub density: f64,
    pub law: AnyLaw<f64>,
    /// In words.
    pub materials: String,
}

/// Writes the table with a number of cells.
pub fn write(to: &mut dyn Write, cells: u32, subject: &Subject) -> Result<(), Box<dyn Error>> {
    // The number of cells is part of the type of a table.
    macro_rules! of_length {
        ($($length:literal)*) => {
            match cells {
                $($length => subject.write::<$length>(to),)*
                other => {
                    let lengths = [$($length),*].map(|length: u32| length.to_string()).join(", ");
                    Err(format!("--cells {other} is refused: a restitution table has one of {lengths} cells").into())
                }
            }
        };
    }
    of_length!(4 8 12 16 24 32)
}

impl Subject {
    fn scene(&self, radius: f64) -> Result<Contact<f64, AnyLaw<f64>>, InputError> {
        Ok(Contact::new(Sphere::solid(radius, self.density)?, self.law))
    }

    fn table<const N: usize>(&self) -> Result<RestitutionTable<f32, N, RADII, SPEEDS>, InputError> {
        let method = Adaptive::new(TOLERANCE)?;
        let critical = |radius| self.scene(radius)?.critical_speed(&method);
        let boundary = BoundaryTable::<N>::new(self.smallest_radius, critical)?;
        // Of all spheres the largest have the smallest critical speed.
        let (_, largest) = boundary.radii::<f64>();
        let slowest = boundary.critical_speed(largest * (1.0 - f64::from(f32::EPSILON))).unwrap_or(self.fastest);
        let (least, most) = Parameter::SpeedRatio.range();
        let ratio = (self.fastest / slowest).clamp(least, most) as f32;
        RestitutionTable::new(boundary, ratio, |radius: f32, speed: f32| {
            let (scene, speed) = (self.scene(radius.into())?, f64::from(speed));
            let (impact, impulses) = scene.solve_for(&NormalMotion::new(speed)?, &method, Impulses)?;
            let impulse = impulses.elastic / (scene.sphere().mass() * speed);
            let restitution = impact.normal.overall_restitution();
            Ok(TableRebound { restitution: restitution as f32, impulse: impulse as f32 })
        })
    }

    fn write<const N: usize>(&self, to: &mut dyn Write) -> Result<(), Box<dyn Error>> {
        let table = self.table::<N>()?;
        let RestitutionParts { boundary, nodes, first, per_octave, per_root, end, .. } = table.parts();
        let RestitutionParts { error, impulse_error, near, impulse_over_restitution, .. } = table.parts();
        let (smallest, margin, cells) = boundary.parts();
        writeln!(to, "/// Restitution: {}; greatest error {:e}.", self.materials, rounded_up(error.into()))?;
        writeln!(to, "static RESTITUTION: microimpact::table::RestitutionTable<f32, {N}, {RADII}, {SPEEDS}> = {{")?;
        writeln!(to, "    use microimpact::table::{{BoundaryTable, RestitutionParts, RestitutionTable}};")?;
        writeln!(to, "    let Ok(boundary) = BoundaryTable::from_parts({smallest:e}, {margin}, [")?;
        for cell in cells {
            writeln!(to, "        {cell:?},")?;
        }
        writeln!(to, "    ]) else {{\n        panic!(\"no boundary table\")\n    }};")?;
        writeln!(
            to,
            "    let Ok(table) = RestitutionTable::<f32, {N}, {RADII}, {SPEEDS}>::from_parts(RestitutionParts {{"
        )?;
        writeln!(to, "        boundary,\n        nodes: [")?;
        for row in &nodes {
            writeln!(to, "            {row:?},")?;
        }
        writeln!(to, "        ],\n        first: {first},\n        per_octave: {per_octave:?},")?;
        writeln!(to, "        per_root: {per_root:?},\n        end: {end},\n        error: {error:?},")?;
        writeln!(to, "        impulse_error: {impulse_error:?},\n        near: {near:?},")?;
        writeln!(to, "        impulse_over_restitution: {impulse_over_restitution:?},")?;
        writeln!(to, "    }}) else {{\n        panic!(\"no restitution table\")\n    }};")?;
        writeln!(to, "    table\n}};")?;
        Ok(())
    }
}
