//! Long ringing of a captured sphere: its energy from turning point to turning point, beside the energy by averaging.
//!
//! In units of the equilibrium indentation and of the stiffness there the potential is V = (2/5) s^5 - (2/3) s^3, and each
//! swing takes L(E), the integral of the damping along the undamped swing of energy E. The loss of a whole swing is
//! taken at the energy in its middle: the error is of the order of the square of the fraction that a swing takes.

use std::f64::consts::FRAC_PI_2;

use gauss_quad::GaussLegendre;
use microimpact::contact::{Collocation, Contact, Nodes, RestCriterion, Works};
use microimpact::{InputError, NormalMotion, Sphere, Stiffness};
use reference::grids::{DENSITY, Impact, RINGING};

use super::maps::in_parallel;
use crate::content::{Cell, Figure, Part, Run, Table};
use crate::plot::{self, Axis, Line, Mark};

/// Depth of the well.
const DEPTH: f64 = 4.0 / 15.0;

/// What is known after a number of turning points.
struct Swing {
    turning_points: u32,
    /// Energy above the bottom of the well over its depth.
    energy: f64,
    /// The same in f32.
    single: Option<f64>,
    averaged: f64,
    /// Energy balance error over the depth of the well.
    residual: f64,
}

pub(super) fn parts(run: &Run) -> Result<Vec<Part>, String> {
    let most = if run.quick { 2_000 } else { 100_000 };
    let counts: Vec<u32> = counts(most);
    let bar = run.progress(RINGING.len() * counts.len(), "ringing");
    let mut lines = [Vec::new(), Vec::new()];
    let (mut energies, mut differences, mut summary) = (Vec::new(), Vec::new(), Vec::new());
    for (place, impact) in RINGING.into_iter().enumerate() {
        let averaged = averaged(&impact, most);
        let solved = in_parallel(&counts, |turning_points| {
            let swing = Swing::after(&impact, *turning_points, averaged[*turning_points as usize]);
            bar.inc(1);
            swing
        });
        let swings: Vec<_> = solved.into_iter().collect::<Result<_, _>>().map_err(|error| error.to_string())?;
        // Close to rest the energy is less than the rounding of the indentation.
        let swings: Vec<_> = swings.into_iter().filter(|swing| swing.averaged > 1e-10).collect();
        let name = |what: &str| format!("{what}, zeta_H = {:.0e}", impact.zeta_h);
        let line = |what: &str, mark, value: &dyn Fn(&Swing) -> Option<f64>| {
            let at = |swing: &Swing| Some((f64::from(swing.turning_points), value(swing)?));
            Line::new(&name(what), mark, swings.iter().filter_map(at).collect())
        };
        lines[0].push(line("f64", Mark::Points, &|swing| Some(swing.energy)).like(place));
        lines[0].push(line("averaged", Mark::Solid, &|swing| Some(swing.averaged)).like(place));
        lines[1].push(line("f64", Mark::Joined, &|swing| Some(swing.drift())).like(place));
        lines[1].push(line("f32", Mark::Joined, &Swing::drift_in_single_precision).beside(place));
        let row = |swing: &Swing, values: &[Option<f64>]| {
            let place = [Cell::from(impact.zeta_h), Cell::Count(u64::from(swing.turning_points))];
            place.into_iter().chain(values.iter().map(|value| Cell::from(*value))).collect::<Vec<_>>()
        };
        energies.extend(swings.iter().map(|swing| row(swing, &[Some(swing.energy), Some(swing.averaged)])));
        differences.extend(
            swings.iter().map(|swing| {
                row(swing, &[Some(swing.drift()), swing.drift_in_single_precision(), Some(swing.residual)])
            }),
        );
        let largest = |value: &dyn Fn(&Swing) -> Option<f64>| swings.iter().filter_map(value).reduce(f64::max);
        summary.push(vec![
            Cell::from(impact.zeta_h),
            Cell::Count(u64::from(swings.last().map_or(0, |swing| swing.turning_points))),
            Cell::from(swings.last().map(|swing| swing.energy)),
            Cell::from(largest(&|swing| Some(swing.drift()))),
            Cell::from(largest(&Swing::drift_in_single_precision)),
            Cell::from(largest(&|swing| Some(swing.residual.abs()))),
        ]);
    }
    figures(&lines, energies, differences, summary)
}

fn figures(
    lines: &[Vec<Line>; 2],
    energies: Vec<Vec<Cell>>,
    differences: Vec<Vec<Cell>>,
    summary: Vec<Vec<Cell>>,
) -> Result<Vec<Part>, String> {
    let text = "A sphere that arrives slowly is captured and swings in the potential well of adhesion. Damping takes from \
                some thousandths of the energy of a small swing down to next to nothing. The indentation at a turning \
                point gives the energy there, which is compared with an averaged energy: the loss of each swing is an \
                integral along the undamped swing of the same energy. Averaging neglects terms proportional to the \
                square of the loss of a swing. These explain the whole difference in f64; nothing drifts. In f32 the \
                decay stops where a swing takes less than the rounding of the contact radius at the turning point.";
    let x = Axis::logarithmic("turning points");
    let data = |name: &str, caption: &str, columns: &[&str], rows| Table {
        name: format!("stability-ringing{name}"),
        caption: caption.to_owned(),
        columns: columns.iter().map(|column| (*column).to_owned()).collect(),
        rows,
    };
    let captions = ["Energy of a captured sphere", "Difference from the averaged energy"];
    let y = ["energy over depth of the well", "difference over that depth"].map(Axis::logarithmic);
    let of_energy = ["zeta_H", "turning points", "energy over depth of the well", "averaged"];
    let of_difference =
        ["zeta_H", "turning points", "f64, over the depth of the well", "f32", "energy balance error, f64"];
    let summary_columns = [
        "zeta_H",
        "turning points",
        "remaining energy",
        "largest difference, f64",
        "largest difference, f32",
        "energy balance error",
    ];
    Ok(vec![
        Part::Heading("Long ringing".to_owned()),
        Part::Text(text.to_owned()),
        Part::Table(data("", "Energy at the last turning point, and largest differences", &summary_columns, summary)),
        Part::Figure(Figure {
            drawing: plot::chart(captions[0], &x, &y[0], &lines[0])?,
            data: data("-energy", captions[0], &of_energy, energies),
        }),
        Part::Figure(Figure {
            drawing: plot::chart(captions[1], &x, &y[1], &lines[1])?,
            data: data("-difference", captions[1], &of_difference, differences),
        }),
    ])
}

/// Numbers that grow by the fourth root of ten.
fn counts(most: u32) -> Vec<u32> {
    let all = (0..).map(|index| 10_f64.powf(0.25 * f64::from(index)).round() as u32);
    let mut counts: Vec<_> = all.take_while(|count| *count <= most).collect();
    counts.dedup();
    counts
}

impl Swing {
    fn after(impact: &Impact, turning_points: u32, averaged: f64) -> Result<Self, InputError> {
        let (energy, residual) = remaining::<14, f64>(impact, turning_points, 1e-13)?;
        let (single, _) = remaining::<8, f32>(impact, turning_points, 1e-6)?;
        Ok(Self {
            turning_points,
            energy,
            single: Some(single).filter(|energy| energy.is_finite()),
            averaged,
            residual,
        })
    }

    fn drift(&self) -> f64 {
        (self.energy - self.averaged).abs().max(f64::EPSILON)
    }

    fn drift_in_single_precision(&self) -> Option<f64> {
        self.single.map(|single| (single - self.averaged).abs().max(f64::EPSILON))
    }
}

/// Remaining energy at a turning point, and the energy balance error, both over the depth of the well; NaN where the sphere
/// did not get so far.
fn remaining<const N: usize, T>(impact: &Impact, turning_points: u32, tolerance: f64) -> Result<(f64, f64), InputError>
where
    T: Nodes<N> + Into<f64>,
{
    let c = T::constant;
    let scene = Contact::hertz(Sphere::solid(c(impact.radius), c(DENSITY))?, Stiffness::new(c(impact.stiffness))?)
        .with_damping(c(impact.zeta_h))?
        .with_ring(c(impact.strength), c(impact.zeta_a))?;
    let method = Collocation::<N, T>::new(c(tolerance))?;
    let criterion = RestCriterion::new(c(1e-12), turning_points)?;
    let settled = scene.solve_to_rest(&NormalMotion::new(c(impact.speed))?, &method, &criterion, Works)?;
    let Some(motion) = settled.motion.filter(|motion| motion.turning_points == turning_points) else {
        return Ok((f64::NAN, f64::NAN));
    };
    let indentation: f64 = motion.indentation.into();
    let root = (indentation / impact.equilibrium()).sqrt();
    let works: [f64; 2] = [settled.outputs.material, settled.outputs.adhesion].map(Into::into);
    let lost = 0.5 * impact.mass() * impact.speed * impact.speed - impact.potential(indentation);
    let depth = -impact.potential(impact.equilibrium());
    Ok(((potential(root) + DEPTH) / DEPTH, (lost - works[0] - works[1]) / depth))
}

fn potential(s: f64) -> f64 {
    0.4 * s.powi(5) - 2.0 / 3.0 * s.powi(3)
}

/// Energy over the depth of the well at each turning point, the peak first, by averaging.
fn averaged(impact: &Impact, most: u32) -> Vec<f64> {
    let length = impact.equilibrium();
    let stiffness = (impact.radius * length).sqrt() * impact.stiffness;
    let time = (impact.mass() / stiffness).sqrt();
    let damping = impact.zeta_h * impact.damping_unit() * length / time;
    let speed = impact.speed * time / length;
    let rule = GaussLegendre::new(40.try_into().expect("there are nodes"));
    let loss = |energy: f64| {
        let [low, high] = turning_points(energy);
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        // With s = middle + half sin(angle) the ends are smooth.
        damping
            * rule.integrate(-FRAC_PI_2, FRAC_PI_2, |angle| {
                let s = middle + half * angle.sin();
                let speed = (2.0 * (energy - potential(s))).max(0.0).sqrt();
                2.0 * s.powi(4) * speed * half * angle.cos()
            })
    };
    let mut energy = 0.5 * speed * speed;
    let mut all = Vec::new();
    for _ in 0..=most {
        let first = loss(energy);
        energy -= loss(energy - 0.5 * first);
        all.push((energy + DEPTH) / DEPTH);
    }
    all
}

/// Contact radii between which an undamped sphere of this energy swings; first contact and the peak where it is free.
fn turning_points(energy: f64) -> [f64; 2] {
    let bisect = |mut inside: f64, mut outside: f64| {
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if potential(middle) < energy { inside = middle } else { outside = middle }
        }
        0.5 * (inside + outside)
    };
    let low = if energy < 0.0 { bisect(1.0, 0.0) } else { 0.0 };
    [low, bisect(1.0, 2.0)]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// Small swings: the loss of a swing over the energy is that of a linear oscillator, pi c.
    #[test]
    fn averaging_ends_as_a_linear_oscillator() {
        let impact = RINGING[0];
        let energies = averaged(&impact, 6000);
        let ratios: Vec<_> = energies.windows(2).map(|pair| pair[1] / pair[0]).collect();
        let length = impact.equilibrium();
        let time = (impact.mass() / ((impact.radius * length).sqrt() * impact.stiffness)).sqrt();
        let damping = impact.zeta_h * impact.damping_unit() * length / time;
        let at = energies.iter().position(|energy| *energy < 1e-4).unwrap();
        assert!((-ratios[at].ln() / (PI * damping) - 1.0).abs() < 1e-3, "{} {damping}", ratios[at]);
    }

    #[test]
    fn few_swings_agree() {
        let impact = RINGING[1];
        let energies = averaged(&impact, 1000);
        for turning_points in [1, 2, 30, 1000] {
            let swing = Swing::after(&impact, turning_points, energies[turning_points as usize]).unwrap();
            assert!(swing.drift() < 1e-9 && swing.residual.abs() < 1e-12, "{turning_points}: {}", swing.drift());
        }
    }
}
