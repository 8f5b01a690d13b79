//! A table of restitution against approach speed, for programs that simulate the flow of particles.

use std::error::Error;
use std::io::Write;

use clap::Args;
use export::{Curve, Table, acutrace, comsol, csv, fluent, openfoam};
use microimpact::contact::{Adaptive, AnyLaw, Contact, Status};
use microimpact::{CriticalSpeed, NormalMotion, Outcome, Sphere};

/// Options of a table of restitution.
#[derive(Args)]
pub struct RestitutionOptions {
    /// Restitution: number of radii, of equal ratios [default: 25; 1 in acutrace and comsol]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=MOST_RADII))]
    radii: Option<u32>,
    /// Restitution: largest approach speed, m/s [default: 100]
    #[arg(long)]
    fastest: Option<f64>,
    /// Restitution: largest error between two speeds, 0.0001 to 0.1 [default: 0.002]
    #[arg(long, value_name = "ERROR")]
    restitution_error: Option<f64>,
}

impl RestitutionOptions {
    /// The largest approach speed, m/s.
    pub fn fastest(&self) -> f64 {
        self.fastest.unwrap_or(100.0)
    }

    fn error(&self) -> f64 {
        self.restitution_error.unwrap_or(0.002)
    }

    /// The first option that is given, if there is one.
    pub fn given(&self) -> Option<&'static str> {
        self.given_of_grid().or(self.fastest.map(|_| "--fastest"))
    }

    /// The same of those that a table without a grid of radii and speeds has no use for.
    pub fn given_of_grid(&self) -> Option<&'static str> {
        self.radii.map(|_| "--radii").or(self.restitution_error.map(|_| "--restitution-error"))
    }
}

const MOST_RADII: i64 = 64;
const RADII: u32 = 25;

/// Smallest and largest error that can be asked for: the simulation is far more accurate than the first, and a table with more
/// than the second is of no use.
const ERRORS: (f64, f64) = (1e-4, 0.1);

/// Tolerance of the squared restitution: what it leaves of a restitution of zero, its square root, is below the smallest error.
const TOLERANCE: f64 = 1e-9;

/// The largest approach speed that the simulation takes, m/s.
const FASTEST: f64 = 1e6;

/// The program that reads the table.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Program {
    Fluent,
    AcuTrace,
    Comsol,
    OpenFoam,
    /// Whatever reads CSV.
    Any,
}

impl Program {
    fn is_for_one_radius(self) -> bool {
        matches!(self, Self::AcuTrace | Self::Comsol)
    }
}

/// Writes the restitution of spheres of a density whose radii lie between two, by this law. Returns what the table covers, in words.
pub fn write(
    to: &mut dyn Write,
    program: Program,
    options: &RestitutionOptions,
    [smallest, largest]: [f64; 2],
    density: f64,
    law: AnyLaw<f64>,
    materials: String,
) -> Result<String, Box<dyn Error>> {
    let count = options.radii.unwrap_or(if program.is_for_one_radius() { 1 } else { RADII });
    if count > 1 && program.is_for_one_radius() {
        return Err(format!(
            "--radii {count} is refused: this format holds spheres of one radius; leave it out and choose the radius by \
             --smallest-radius"
        )
        .into());
    }
    let last = f64::from(count.max(2) - 1);
    let ratio = (largest / smallest).powf(last.recip());
    // The powers of a root have its rounding; the last radius is the one that was asked for.
    let spheres = |place: f64| {
        let radius = if place == last { largest } else { smallest * ratio.powf(place) };
        Spheres::new(radius, density, law)
    };
    let table = table(count, spheres, options, materials)?;
    match program {
        Program::Fluent => fluent::write(to, &table),
        Program::AcuTrace => acutrace::write(to, &table),
        Program::Comsol => comsol::write(to, &table),
        Program::OpenFoam => openfoam::write(to, &table),
        Program::Any => csv::write(to, &table),
    }?;
    Ok(table.range_in_words())
}

/// The table of some radii, and its error halfway between them; `spheres` gives those at a place between the radii, the first of
/// which is at 0 and the next at 1.
fn table(
    count: u32,
    spheres: impl Fn(f64) -> Result<Spheres, Box<dyn Error>>,
    options: &RestitutionOptions,
    subject: String,
) -> Result<Table, Box<dyn Error>> {
    let (fastest, tolerance) = (options.fastest(), options.error());
    if !(ERRORS.0..=ERRORS.1).contains(&tolerance) {
        let (least, most) = ERRORS;
        return Err(format!("--restitution-error {tolerance} is refused: enter a number from {least} to {most}").into());
    }
    // A curve that ends at its critical speed would take any number.
    NormalMotion::new(fastest)?;
    let rows = (0..count).map(|k| spheres(f64::from(k))).collect::<Result<Vec<_>, _>>()?;
    if let Some(slowest) = rows.iter().min_by(|a, b| a.critical_speed.total_cmp(&b.critical_speed))
        && slowest.critical_speed >= fastest
    {
        let Spheres { radius, critical_speed, .. } = slowest;
        return Err(format!(
            "--fastest {fastest} is refused: spheres of radius {radius:e} m are captured up to {critical_speed:.4e} m/s, their critical \
             speed, and smaller ones up to higher speeds, so that the table would hold no rebound; choose a --fastest above it, m/s, or \
             larger spheres by --smallest-radius"
        )
        .into());
    }
    let curve = |k: usize| {
        // Between two radii both curves are read at the same multiple of the critical speed.
        let neighbours = [k.wrapping_sub(1), k + 1].into_iter().filter_map(|other| rows.get(other));
        let beyond = neighbours.map(|other| rows[k].critical_speed / other.critical_speed);
        let beyond = beyond.filter(|beyond| beyond.is_finite()).fold(1.0, f64::max);
        rows[k].curve((fastest * beyond).min(FASTEST), tolerance)
    };
    let curves = (0..rows.len()).map(curve).collect::<Result<_, _>>()?;
    let mut table = Table { subject, tolerance, fastest, curves, between_radii: None };
    for k in 1..count {
        let found = table.difference(&spheres(f64::from(k) - 0.5)?.curve(fastest, tolerance)?);
        table.between_radii = match (table.between_radii, found) {
            (Some(other), Some(found)) => Some(other.max(found)),
            (other, found) => found.or(other),
        };
    }
    Ok(table)
}

/// Spheres of one radius.
struct Spheres {
    radius: f64,
    contact: Contact<f64, AnyLaw<f64>>,
    method: Adaptive<f64>,
    /// Zero if they rebound from every speed.
    critical_speed: f64,
}

impl Spheres {
    fn new(radius: f64, density: f64, law: AnyLaw<f64>) -> Result<Self, Box<dyn Error>> {
        let contact = Contact::new(Sphere::solid(radius, density)?, law);
        let method = Adaptive::new(TOLERANCE)?;
        let critical_speed = match contact.critical_speed(&method)? {
            CriticalSpeed::At(speed) => speed,
            CriticalSpeed::AlwaysRebounds => 0.0,
            CriticalSpeed::NeverRebounds => {
                return Err(format!(
                    "spheres of radius {radius:e} m are captured at every speed up to 1e6 m/s, so that a table would hold \
                     nothing; choose a larger --smallest-radius, or less --adhesion or damping"
                )
                .into());
            }
        };
        Ok(Self { radius, contact, method, critical_speed })
    }

    fn restitution(&self, speed: f64) -> Result<f64, Box<dyn Error>> {
        let impact = self.contact.solve(&NormalMotion::new(speed)?, &self.method)?;
        if impact.run.status != Status::Solved {
            let radius = self.radius;
            return Err(format!(
                "the simulation does not solve an impact at {speed} m/s of a sphere of radius {radius:e} m"
            )
            .into());
        }
        // What the method does not decide has a restitution of less than the square root of its tolerance.
        let rebounds = impact.normal.outcome() == Some(Outcome::Rebound);
        Ok(if rebounds { impact.normal.overall_restitution() } else { 0.0 })
    }

    fn curve(&self, fastest: f64, tolerance: f64) -> Result<Curve, Box<dyn Error>> {
        Curve::new(self.radius, self.critical_speed, fastest, tolerance, |speed| self.restitution(speed))
    }
}
