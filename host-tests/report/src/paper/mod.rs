//! The paper: its numbers with ours beside them, its figures redrawn, and its two models side by side.

use std::error::Error;

use microimpact::contact::{Adaptive, Contact, RingScene};
use microimpact::{InputError, NormalMotion, PlanarMotion, Sphere, Stiffness};
use microimpact_scenes::table_1::{
    APPROACH_M_S as SPEED, DENSITY_KG_M3 as GLASS, FRICTION, MATERIAL_DAMPING as ZETA_H, RADIUS_M as RADIUS,
    RESTITUTION_SPEED_M_S as LAW_SPEED, RING_DAMPING as ZETA_A, RING_N_M as ADHESION, SPIN_RAD_S as SPIN,
    STIFFNESS_PA as STIFFNESS, WORK_OF_ADHESION_J as WORK,
};

use crate::content::{Cell, Figure, Part, Run, Section, Table};

mod contact;
mod models;
mod numbers;
mod rigid;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Mean radius of the experiment, m.
const MEAN_RADIUS: f64 = 4.3e-6;
/// Spin before the impact of Table 1 where the paper runs its simulation, degrees/s.
const SPIN_DEGREES: f64 = 8.34e6;

/// Tolerance of every simulation of this section.
const TOLERANCE: f64 = 1e-10;

pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let parts = || -> Outcome<Vec<Part>> {
        let (agreement, numbers) = numbers::parts()?;
        let [sixth, seventh, eighth, ninth] = contact::parts()?;
        Ok(vec![
            Part::Text(agreement),
            sixth,
            seventh,
            Part::Fold("Every number of the paper beside ours".to_owned(), numbers),
            Part::Fold("Figures 8 and 9: motion and hysteresis".to_owned(), vec![eighth, ninth]),
            Part::Fold("Figures 2, 4 and A2: the rigid-body model".to_owned(), rigid::parts()?),
            Part::Fold("Both models side by side".to_owned(), models::parts(run)?),
        ])
    };
    let section = |parts| Section { title: "The paper", name: "paper", parts, ..Section::default() };
    parts().map(section).map_err(|error| error.to_string())
}

fn glass(radius: f64) -> Result<Sphere<f64>, InputError> {
    Sphere::solid(radius, GLASS)
}

/// The contact of the paper for a sphere.
fn contact(radius: f64) -> Result<RingScene<f64>, InputError> {
    Contact::hertz(glass(radius)?, Stiffness::new(STIFFNESS)?).with_damping(ZETA_H)?.with_ring(ADHESION, ZETA_A)
}

fn method() -> Result<Adaptive<f64>, InputError> {
    Adaptive::new(TOLERANCE)
}

/// The motion of Table 1 with a spin in rad/s.
fn table_motion(spin: f64) -> Result<PlanarMotion<f64>, InputError> {
    NormalMotion::new(SPEED)?.with_tangential(0.0)?.with_spin(&glass(RADIUS)?, spin)
}

/// Numbers from `low` to `high` in equal ratios.
pub(crate) fn spaced(low: f64, high: f64, count: u32) -> impl Iterator<Item = f64> + Clone {
    let ratio = (high / low).ln();
    (0..count).map(move |index| low * (ratio * f64::from(index) / f64::from(count - 1)).exp())
}

/// A figure with a row of numbers for each abscissa.
pub(crate) fn figure<const N: usize>(
    title: &str,
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
    Part::Figure(Figure { title: title.to_owned(), drawing, data })
}

/// Points of a column over the first.
pub(crate) fn column<const N: usize>(rows: &[[f64; N]], column: usize) -> Vec<(f64, f64)> {
    rows.iter().map(|row| (row[0], row[column])).collect()
}
