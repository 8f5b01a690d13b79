//! The paper: its numbers with ours beside them, its figures redrawn, and its two models side by side.

use std::error::Error;

use microimpact::simulation::{Adaptive, HystereticDamping, Ring, Simulation};
use microimpact::{InputError, NoFriction, NormalMotion, PlanarMotion, Sphere, Stiffness};

use crate::content::{Cell, Figure, Part, Run, Section, Table};

mod contact;
mod models;
mod numbers;
mod rigid;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Radius of the sphere of Table 1, m.
const RADIUS: f64 = 5.06e-6;
/// Mean radius of the experiment, m.
const MEAN_RADIUS: f64 = 4.3e-6;
/// Density of glass, kg/m^3.
const GLASS: f64 = 2600.0;
/// Approach speed of Table 1, m/s.
const SPEED: f64 = 2.80;
/// Spin before the impact in Table 1, rad/s.
const SPIN: f64 = 1.46e5;
/// The same where the paper runs its simulation, degrees/s.
const SPIN_DEGREES: f64 = 8.34e6;
/// Hertz stiffness K, Pa.
const STIFFNESS: f64 = 7.5e10;
/// Strength f0 of adhesion, N/m.
const ADHESION: f64 = 250.0;
/// Damping in the materials.
const ZETA_H: f64 = 10.5;
/// Damping of adhesion: the paper prints 12.5, and its program halves it.
const ZETA_A: f64 = 6.25;
/// Coefficient f of friction.
const FRICTION: f64 = 0.1;
/// Speed k of the restitution law R = k/(k + v), m/s.
const LAW_SPEED: f64 = 130.0;
/// Work of adhesion (J) with which A34 gives the restitution of Table 1.
const WORK: f64 = 2.22e-12;

/// Tolerance of every simulation of this section.
const TOLERANCE: f64 = 1e-10;

type Contact = Simulation<f64, HystereticDamping<f64>, Ring<f64>, NoFriction>;

pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let parts = || -> Outcome<Vec<Part>> {
        let mut parts = numbers::parts()?;
        parts.extend(rigid::parts()?);
        parts.extend(contact::parts()?);
        parts.extend(models::parts(run)?);
        Ok(parts)
    };
    Ok(Section { title: "The paper", name: "paper", parts: parts().map_err(|error| error.to_string())? })
}

fn glass(radius: f64) -> Result<Sphere<f64>, InputError> {
    Sphere::solid(radius, GLASS)
}

/// The contact of the paper for a sphere.
fn contact(radius: f64) -> Result<Contact, InputError> {
    Simulation::new(glass(radius)?, Stiffness::new(STIFFNESS)?).with_damping(ZETA_H)?.with_ring(ADHESION, ZETA_A)
}

fn method() -> Result<Adaptive<f64>, InputError> {
    Adaptive::new(TOLERANCE)
}

/// The motion of Table 1 with a spin in rad/s.
fn table_motion(spin: f64) -> Result<PlanarMotion<f64>, InputError> {
    NormalMotion::new(SPEED)?.with_tangential(0.0)?.with_spin(&glass(RADIUS)?, spin)
}

/// Numbers from `low` to `high` in equal ratios.
fn spaced(low: f64, high: f64, count: u32) -> impl Iterator<Item = f64> + Clone {
    let ratio = (high / low).ln();
    (0..count).map(move |index| low * (ratio * f64::from(index) / f64::from(count - 1)).exp())
}

/// A figure with a row of numbers for each abscissa.
fn figure<const N: usize>(
    drawing: String,
    name: &str,
    caption: &str,
    columns: [&str; N],
    rows: impl IntoIterator<Item = [f64; N]>,
) -> Part {
    let rows = rows.into_iter().map(|row| row.map(|number| Cell::Number(number.is_finite().then_some(number))).into());
    let data = Table {
        name: name.to_owned(),
        caption: caption.to_owned(),
        columns: columns.map(str::to_owned).into(),
        rows: rows.collect(),
    };
    Part::Figure(Figure { drawing, data })
}

/// Points of a column over the first.
fn column<const N: usize>(rows: &[[f64; N]], column: usize) -> Vec<(f64, f64)> {
    rows.iter().map(|row| (row[0], row[column])).collect()
}
