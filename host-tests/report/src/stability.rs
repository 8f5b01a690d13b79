//! Stability: error, steps and status over all of the space of scenes, the order of convergence, the energy ledger, and
//! long ringing.

mod families;
mod impact;
mod independent;
mod ledger;
mod maps;
mod order;
mod regions;
mod ringing;
mod solution;
mod trial;

use crate::content::{Part, Run, Section};
use impact::Impact;
use maps::Map;
use solution::{STEPS, TOLERANCE};
use trial::MOST_STRETCHES;

pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let maps = Map::all(run);
    let mut parts = vec![Part::Text(introduction()), Part::Heading("Bounds, and where they fail".to_owned())];
    parts.extend(maps::bounds(&maps));
    parts.push(Part::Text(confirmation(&maps)?));
    for map in &maps {
        parts.extend(map.parts()?);
    }
    parts.extend(order::parts(run)?);
    parts.extend(ledger::parts(&maps)?);
    parts.extend(ringing::parts(run)?);
    Ok(Section { title: "Stability", name: "stability", parts })
}

fn introduction() -> String {
    format!(
        "Maps over the space of scenes: the adaptive method in f64 with a tolerance of {TOLERANCE:.0e}, held to three \
         times that, {MOST_STRETCHES} stretches and the right outcome; eight nodes in f32 with a tolerance of 1e-6, held to \
         2e-6; four nodes and two sweeps in fixed point, held to 1e-5 of e more than the same method has in f64, where e \
         exceeds 0.2; and beside them the paper's method, Runge-Kutta-Gill with {STEPS} steps in the duration of \
         Hertz's impact and at most 64 times as many in all, which counts as broken from an error of 1e-3. An error is \
         that of e^2 or, if larger, the relative one of the peak indentation, in fixed point that of e^2, against 14 nodes \
         with a tolerance of 1e-13; single precision is compared with the solution of the impact that it sees. Grey: \
         inputs outside the range of the library or of fixed point, or damped too strongly for a method of fixed cost, \
         which says so."
    )
}

/// What confirms the solutions that the errors are measured by.
fn confirmation(maps: &[Map]) -> Result<String, String> {
    let unlike: Vec<_> = maps.iter().flat_map(Map::points).filter_map(|point| point.unlike).collect();
    let points = maps.iter().flat_map(Map::points).filter(|point| point.restitution.is_some()).count();
    let largest = unlike.iter().copied().fold(0.0, f64::max);
    let known = maps.iter().filter_map(|map| Some((map, map.family.rebounds?)));
    let sides: Vec<_> = known
        .flat_map(|(map, rebounds)| map.points().filter_map(move |point| Some((point.restitution? > 0.0) == rebounds)))
        .collect();
    let wrong = sides.iter().filter(|right| !**right).count();
    let mut of_form = 0.0_f64;
    for step in 0..=40 {
        let damping = 10_f64.powf(0.2 * f64::from(step) - 4.0);
        let unit = Impact { strength: 0.0, adhesion: 0.0, ..Impact::PAPER };
        let impact = Impact { material: damping / (unit.damping_unit() * unit.speed), ..unit };
        let found = solution::exactly(&impact).map_err(|error| error.to_string())?;
        let square = found.solution.ok_or("a reference without a solution")?.square;
        of_form = of_form.max((square - independent::without_adhesion(damping).powi(2)).abs());
    }
    Ok(format!(
        "The solutions that errors are measured by are confirmed by others. At {} of {points} points the classical \
         Runge-Kutta method on the equations in the contact radius converges to 1e-12 within its steps (the others are \
         stiff or deep in adhesion); there both differ by at most {largest:.1e} in e^2. Without adhesion the closed form d (1 + e) \
         = ln((1 + d)/(1 - e d)) is met to {of_form:.1e} in e^2 for d from 1e-4 to 1e4. Of {} impacts beside the critical speed, \
         down to a billionth of it, {wrong} end otherwise than that speed says. The test `simulation_reference` \
         compares with solutions to 20 digits.",
        unlike.len(),
        sides.len()
    ))
}
