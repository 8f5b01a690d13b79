//! Materials with their constants and sources, and what follows for a sphere of one on a surface of another.
//!
//! `cargo microimpact materials "soda-lime glass" steel`

use std::error::Error;

use clap::Args;
use microimpact::{KnownMaterial, MATERIALS, Sourced, Stiffness};
use sheet::Value;

use crate::Streams;
use crate::command::{Format, exit_status, write_records};

/// List materials with their constants and sources, or what two of them give for a sphere on a surface
#[derive(Args)]
#[command(
    after_help = "\
Example: the stiffness of glass on steel
  cargo microimpact materials 'soda-lime glass' steel",
    after_long_help = "\
Numbers of real samples differ from these, surface energies by factors. They serve a first estimate. Of two materials the command \
gives Hertz's stiffness (B2) and, where both surface energies are known, the work of adhesion 2 sqrt(gamma_1 gamma_2) of dispersion \
forces (Girifalco and Good 1957)."
)]
pub struct Options {
    /// Material of the sphere [default: all materials are listed]
    sphere: Option<String>,
    /// Material of the surface
    surface: Option<String>,
    /// Format of the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// The columns that the command writes.
pub const COLUMNS: [&str; 9] = [
    "name",
    "density_kg_m3",
    "youngs_modulus_pa",
    "poisson_ratio",
    "surface_energy_j_m2",
    "yield_pressure_pa",
    "stiffness_pa",
    "work_of_adhesion_j_m2",
    "sources",
];

/// How many columns of a material, and of a pair, are written.
const OF_MATERIAL: [usize; 7] = [0, 1, 2, 3, 4, 5, 8];
const OF_PAIR: [usize; 4] = [0, 1, 6, 7];

impl Options {
    /// Runs the command; its exit status.
    pub fn run(&self, streams: &mut Streams<'_>) -> u8 {
        exit_status("materials", self.list(streams).map(|()| 0), streams.errors)
    }

    fn list(&self, streams: &mut Streams<'_>) -> Result<(), Box<dyn Error>> {
        let (columns, records): (&[usize], _) = match (&self.sphere, &self.surface) {
            (None, _) => (&OF_MATERIAL, MATERIALS.iter().map(record).collect()),
            (Some(name), None) => (&OF_MATERIAL, vec![record(named(name)?)]),
            (Some(sphere), Some(surface)) => (&OF_PAIR, vec![pair(named(sphere)?, named(surface)?)?]),
        };
        let names: Vec<_> = columns.iter().map(|index| COLUMNS[*index]).collect();
        Ok(write_records(self.format, &names, 1, records, streams.output)?)
    }
}

/// The material with a name, in capitals or not.
fn named(name: &str) -> Result<&'static KnownMaterial, String> {
    KnownMaterial::named(&name.trim().to_lowercase()).ok_or_else(|| {
        let names: Vec<_> = MATERIALS.iter().map(|material| material.name).collect();
        format!("no material \"{name}\"; choose one of: {}", names.join(", "))
    })
}

fn record(material: &KnownMaterial) -> Vec<Value> {
    let KnownMaterial { name, youngs_modulus, poisson_ratio, density, surface_energy, yield_pressure } = material;
    let number = |sourced: &Option<Sourced>| Value::from(sourced.map(|sourced| sourced.value));
    let stated = [Some(*density), Some(*youngs_modulus), Some(*poisson_ratio), *surface_energy, *yield_pressure];
    let mut sources: Vec<_> = stated.iter().flatten().map(|sourced| sourced.source).collect();
    sources.dedup();
    vec![
        (*name).into(),
        Value::Double(density.value),
        Value::Double(youngs_modulus.value),
        Value::Double(poisson_ratio.value),
        number(surface_energy),
        number(yield_pressure),
        sources.join("; ").into(),
    ]
}

fn pair(sphere: &KnownMaterial, surface: &KnownMaterial) -> Result<Vec<Value>, Box<dyn Error>> {
    let stiffness = Stiffness::<f64>::between(&sphere.elastic()?, &surface.elastic()?)?;
    let energies = sphere.surface_energy.zip(surface.surface_energy);
    let work = energies.map(|(sphere, surface)| 2.0 * (sphere.value * surface.value).sqrt());
    Ok(vec![
        format!("{} on {}", sphere.name, surface.name).into(),
        Value::Double(sphere.density.value),
        Value::Double(stiffness.pascals()),
        work.into(),
    ])
}
