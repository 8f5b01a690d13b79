//! Figures of the simulation: 6, 7, 8 and 9.

use microimpact::contact::{Recording, RingScene, RungeKuttaGill, Status};
use microimpact::{InputError, NormalMotion, RigidBody, SpeedRestitution};

use super::{LAW_SPEED, MEAN_RADIUS, Outcome, RADIUS, SPEED, WORK, column, contact, figure, glass, method, spaced};
use crate::content::Part;
use crate::plot::{self, Axis, Line, Mark};

/// Radii of the curves of figure 6, m: those of the two curves of the paper, which names the diameters, and between them that of
/// the mean sphere, whose restitution is in its text.
const RADII: [f64; 3] = [2.5e-6, MEAN_RADIUS, 6.5e-6];
/// Samples of a motion in time.
const SAMPLES: usize = 1024;
/// Largest displacement of figure 8, m.
const DISPLACEMENT: f64 = 4.243e-8;
/// Rebound speed of Table 1, m/s.
const REBOUND: f64 = 2.09;

pub(super) fn parts() -> Outcome<[Part; 4]> {
    let [seventh, eighth, ninth] = figures_in_time()?;
    Ok([figure_6()?, seventh, eighth, ninth])
}

fn figure_6() -> Outcome<Part> {
    let method = method()?;
    let rigid = RigidBody::new(glass(RADIUS)?, SpeedRestitution::new(LAW_SPEED)?).with_work_of_adhesion(WORK)?;
    let [small, mean, large] = [contact(RADII[0])?, contact(RADII[1])?, contact(RADII[2])?];
    let row = |speed| {
        let motion = NormalMotion::new(speed)?;
        let simulated = |scene: &RingScene<f64>| Ok(scene.solve_normal(&motion, &method)?.overall_restitution());
        let rigid = rigid.impact(&motion).normal.overall_restitution();
        Ok([speed, simulated(&small)?, simulated(&mean)?, simulated(&large)?, rigid])
    };
    let rows = spaced(0.5, 100.0, 401).map(row).collect::<Result<Vec<_>, InputError>>()?;
    let lines = [
        Line::new("simulation, 5 µm", Mark::Dashed, column(&rows, 1)),
        Line::new("simulation, 8.6 µm", Mark::Dashed, column(&rows, 2)),
        Line::new("simulation, 13 µm", Mark::Dashed, column(&rows, 3)),
        Line::new("rigid body, 10.12 µm", Mark::Solid, column(&rows, 4)),
        Line::new("paper", Mark::Points, vec![(SPEED, 0.62), (SPEED, 0.746), (5.0, 0.0)]),
    ];
    let x = Axis::logarithmic("approach speed", "v", "m/s");
    let y = Axis::linear("velocity ratio", "V/v", "1").between(0.0, 1.0);
    Ok(figure(
        "Figure 6: velocity ratio against speed",
        plot::chart(&x, &y, &lines)?,
        "figure-6",
        "Figure 6: restitution of silver-coated glass on steel, with the critical speed of each curve. Points, from the \
         paper's text: 0.62 at 8.6 µm, its mean sphere, by which zeta_A is chosen; 0.746 at 10.12 µm, in Table 1; and the \
         capture at 5 µm and about 5 m/s. The paper gives none of its measured points as numbers.",
        [
            "approach speed, m/s",
            "e, simulation, 5 um",
            "e, simulation, 8.6 um",
            "e, simulation, 13 um",
            "e, rigid body, 10.12 um",
        ],
        rows,
    ))
}

/// Figures 7, 8 and 9: one impact in time, normalized as the paper does.
fn figures_in_time() -> Outcome<[Part; 3]> {
    let scene = contact(RADIUS)?;
    // Steps in time make many samples.
    let method = RungeKuttaGill::new(20_000);
    let (impact, trajectory) = scene.solve_for(&NormalMotion::new(SPEED)?, &method, Recording::<SAMPLES>)?;
    if impact.run.status != Status::Solved {
        return Err("the impact of Table 1 is not solved".into());
    }
    let rows: Vec<_> = trajectory
        .samples()
        .map(|sample| {
            let force = [sample.force, sample.elastic, sample.force - sample.elastic].map(|force| force / 1e-4);
            [sample.time / 1e-8, force[0], force[1], force[2], sample.indentation, -sample.velocity / SPEED]
        })
        .collect();
    let peak = trajectory.peak().ok_or("the impact of Table 1 has no peak")?;
    let last = trajectory.samples().last().ok_or("the impact of Table 1 has no end")?;
    let time = Axis::linear("time", "t", "10⁻⁸ s");

    let forces = [
        Line::new("normal force", Mark::Solid, column(&rows, 1)),
        Line::new("elastic part", Mark::Dashed, column(&rows, 2)),
        Line::new("adhesion and damping", Mark::Dashed, column(&rows, 3)),
    ];
    let seventh = figure(
        "Figure 7: force in time",
        plot::chart(&time, &Axis::linear("force", "F", "10⁻⁴ N"), &forces)?,
        "figure-7",
        "Figure 7: normal force on the sphere of Table 1, positive where the surface repels. Only the \
         units can be read from the paper's figure; ours adds the two parts that its text mentions.",
        ["time, 1e-8 s", "normal force, 1e-4 N", "elastic part, 1e-4 N", "adhesion and damping, 1e-4 N"],
        rows.iter().map(|row| [row[0], row[1], row[2], row[3]]),
    );

    let (deepest, end) = (peak.time / 1e-8, last.time / 1e-8);
    let motion = [
        Line::new("displacement", Mark::Solid, rows.iter().map(|row| (row[0], row[4] / DISPLACEMENT)).collect()),
        Line::new("velocity", Mark::Dashed, column(&rows, 5)),
        Line::new("paper", Mark::Points, vec![(0.0, -1.0), (deepest, 1.0), (end, REBOUND / SPEED)]),
    ];
    let eighth = figure(
        "Figure 8: motion in time",
        plot::chart(&time, &Axis::linear("over the largest value", "x, v", "1"), &motion)?,
        "figure-8",
        "Figure 8: displacement over 4.243e-8 m, the paper's largest, and velocity, positive out of the surface, over \
         2.8 m/s. Points: the paper's first velocity, largest displacement and last velocity, at our times, as it gives \
         none.",
        ["time, 1e-8 s", "displacement over 4.243e-8 m", "velocity over 2.8 m/s"],
        rows.iter().map(|row| [row[0], row[4] / DISPLACEMENT, row[5]]),
    );

    let displacement = |row: &[f64; 6]| row[4] / 1e-8;
    let low = rows.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min);
    let high = rows.iter().map(|row| row[1]).fold(f64::NEG_INFINITY, f64::max);
    let loop_ = [
        Line::new("normal force", Mark::Solid, rows.iter().map(|row| (displacement(row), row[1])).collect()),
        Line::new(
            "the paper's largest displacement",
            Mark::Dashed,
            vec![(DISPLACEMENT / 1e-8, low), (DISPLACEMENT / 1e-8, high)],
        ),
    ];
    let (x, y) = (Axis::linear("displacement", "x", "10⁻⁸ m"), Axis::linear("normal force", "F", "10⁻⁴ N"));
    let ninth = figure(
        "Figure 9: hysteresis",
        plot::chart(&x, &y, &loop_)?,
        "figure-9",
        "Figure 9: the loop encloses the energy that the impact of Table 1 loses. Only the units can be read from the paper's \
         figure and, from figure 8, the largest displacement.",
        ["displacement, 1e-8 m", "normal force, 1e-4 N"],
        rows.iter().map(|row| [displacement(row), row[1]]),
    );
    Ok([seventh, eighth, ninth])
}
