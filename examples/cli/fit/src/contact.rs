//! The curve of a contact simulation, tabulated over speed for three sizes.
//!
//! The restitution of a sphere on a surface with hysteretic damping depends on groups of the parameters only. A sphere of unit
//! radius, density and stiffness at a small unit speed therefore stands for any other; the strength of adhesion acts over the
//! radius.

use microimpact::contact::{Adaptive, AnyLaw, Contact, JkrEnd};
use microimpact::{CriticalSpeed, NormalMotion, Sphere, Stiffness};

use crate::law::{Law, Size};
use crate::monotone::Monotone;

/// Radius (m), density (kg/m^3) and stiffness (Pa) of the reference sphere, and the reference speed, m/s: a microsphere of glass.
const RADIUS: f64 = 5e-6;
const DENSITY: f64 = 2500.0;
const STIFFNESS: f64 = 5e10;
const SPEED: f64 = 10.0;

/// Tolerance of the simulation, far below the errors of measurements.
const TOLERANCE: f64 = 1e-8;

/// Speeds of a table.
const NODES: u32 = 24;

/// The curve, in reference speeds.
#[derive(Clone, Debug)]
pub struct ContactCurve {
    /// Tables at logarithms of the radius.
    tables: Vec<(f64, Table)>,
}

/// A rebound speed w against t, where v = v_c + span t^2: smooth at the critical speed, where w rises as a root.
#[derive(Clone, Debug)]
struct Table {
    critical: f64,
    span: f64,
    rebound: Monotone,
    inverse: Monotone,
}

/// A law with its strength of adhesion: f0, N/m, or G, J/m^2.
fn law(law: Law, strength: f64, damping: f64, ratio: f64) -> Option<AnyLaw<f64>> {
    let stiffness = Stiffness::new(STIFFNESS).ok()?;
    let sphere_mass = sphere()?.mass();
    let zeta = damping / (SPEED * (sphere_mass / (RADIUS.powi(3) * STIFFNESS * SPEED.sqrt())).powf(0.4));
    let plain = match law {
        Law::Ring => AnyLaw::ring(stiffness, strength, ratio * zeta),
        Law::Dmt => AnyLaw::dmt(stiffness, strength),
        _ => AnyLaw::jkr(stiffness, strength, JkrEnd::SnapOff),
    };
    plain.and_then(|law| law.with_damping(zeta)).ok()
}

fn sphere() -> Option<Sphere<f64>> {
    Sphere::solid(RADIUS, DENSITY).ok()
}

impl ContactCurve {
    /// The curve of a law with damping, critical speed of the median sphere, and zeta_A over zeta_H, in reference speeds.
    pub fn new(name: Law, values: &[f64], radii: (f64, f64), fastest: f64) -> Option<Self> {
        let (damping, critical, ratio) = (values[0], values[1], values.get(2).copied().unwrap_or(0.0));
        let strength = if critical > 0.0 { strength(name, damping, critical, ratio)? } else { 0.0 };
        // Adhesion acts over the radius: a larger sphere is one of the same size with less adhesion.
        let table = |log_radius: f64| {
            let law = law(name, strength / log_radius.exp(), damping, ratio)?;
            Some((log_radius, Table::new(&Contact::new(sphere()?, law), 1.05 * fastest)?))
        };
        let (low, high) = (radii.0.ln(), radii.1.ln());
        // Below a spread of one in a thousand, all are equal.
        let sizes = if high - low < 1e-3 { vec![0.0] } else { vec![low, 0.5 * (low + high), high] };
        Some(Self { tables: sizes.into_iter().map(table).collect::<Option<_>>()? })
    }

    /// Quadratic interpolation over the size.
    fn interpolate(&self, size: Size, at: impl Fn(&Table) -> (f64, f64)) -> (f64, f64) {
        if let [(_, only)] = &self.tables[..] {
            return at(only);
        }
        let mut sum = (0.0, 0.0);
        for (index, (node, table)) in self.tables.iter().enumerate() {
            let others = self.tables.iter().enumerate().filter(|(other, _)| *other != index);
            let weight: f64 = others.map(|(_, (other, _))| (size.log_radius - other) / (node - other)).product();
            let (value, slope) = at(table);
            sum = (sum.0 + weight * value, sum.1 + weight * slope);
        }
        sum
    }

    /// Signed square of the rebound speed, and its derivative.
    pub fn square(&self, speed: f64, size: Size) -> (f64, f64) {
        self.interpolate(size, |table| table.square(speed))
    }

    /// Approach speed of a signed rebound speed, and its derivative.
    pub fn approach(&self, rebound: f64, size: Size) -> (f64, f64) {
        let (speed, slope) = self.interpolate(size, |table| table.approach(rebound));
        if speed > 0.0 { (speed, slope) } else { (0.0, 0.0) }
    }
}

/// The critical speed of a strength, in reference speeds.
fn critical_speed(name: Law, strength: f64, damping: f64, ratio: f64) -> Option<f64> {
    let scene = Contact::new(sphere()?, law(name, strength, damping, ratio)?);
    match scene.critical_speed(&Adaptive::new(TOLERANCE).ok()?).ok()? {
        CriticalSpeed::At(speed) => Some(speed / SPEED),
        CriticalSpeed::AlwaysRebounds => Some(0.0),
        CriticalSpeed::NeverRebounds => None,
    }
}

/// The strength that gives a critical speed, by the secant method in logarithms. The critical speed is nearly proportional to the
/// power 5/4 of the strength.
fn strength(name: Law, damping: f64, critical: f64, ratio: f64) -> Option<f64> {
    let target = critical.ln();
    let off = |log: f64| Some(critical_speed(name, log.exp(), damping, ratio)?.max(1e-300).ln() - target);
    // Strengths of microspheres.
    let mut last = match name {
        Law::Ring => 100.0_f64,
        Law::Dmt => 10.0,
        _ => 1.0,
    }
    .ln();
    let mut last_off = off(last)?;
    let mut next = last - 0.8 * last_off.clamp(-5.0, 5.0);
    for _ in 0..30 {
        let next_off = off(next)?;
        if next_off.abs() < 1e-8 {
            return Some(next.exp());
        }
        let slope = (next_off - last_off) / (next - last);
        let slope = if slope.is_finite() { slope.clamp(0.3, 4.0) } else { 1.25 };
        (last, last_off) = (next, next_off);
        next -= (next_off / slope).clamp(-3.0, 3.0);
    }
    None
}

impl Table {
    fn new(scene: &Contact<f64, AnyLaw<f64>>, fastest: f64) -> Option<Self> {
        let method = Adaptive::new(TOLERANCE).ok()?;
        let critical = match scene.critical_speed(&method).ok()? {
            CriticalSpeed::At(speed) => speed / SPEED,
            CriticalSpeed::AlwaysRebounds => 0.0,
            CriticalSpeed::NeverRebounds => return None,
        };
        let span = (fastest - critical).max(0.1 * critical);
        let (mut t, mut w) = (vec![0.0], vec![0.0]);
        for step in 1..=NODES {
            let part = f64::from(step) / f64::from(NODES);
            let speed = critical + span * part * part;
            let motion = NormalMotion::new(SPEED * speed).ok()?;
            let rebound = scene.solve_normal(&motion, &method).ok()?.rebound_speed() / SPEED;
            // Strong damping makes the rebound speed independent of the approach speed; the table must rise.
            w.push(rebound.max(w[w.len() - 1] + 1e-9));
            t.push(part);
        }
        Some(Self {
            critical,
            span,
            rebound: Monotone::through(t.clone(), w.clone()),
            inverse: Monotone::through(w, t),
        })
    }

    fn square(&self, speed: f64) -> (f64, f64) {
        let excess = (speed - self.critical) / self.span;
        if excess <= 0.0 {
            let slope = self.rebound.at(0.0).1.powi(2);
            return (slope * excess, slope / self.span);
        }
        let t = excess.sqrt();
        let (w, slope) = self.rebound.at(t);
        (w * w, w * slope / (t * self.span))
    }

    fn approach(&self, rebound: f64) -> (f64, f64) {
        if rebound <= 0.0 {
            let slope = self.rebound.at(0.0).1.powi(2);
            return (self.critical - self.span * rebound * rebound / slope, -2.0 * self.span * rebound / slope);
        }
        let (t, slope) = self.inverse.at(rebound);
        (self.critical + self.span * t * t, 2.0 * self.span * t * slope)
    }
}
