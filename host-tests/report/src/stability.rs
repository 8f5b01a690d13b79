//! Stability: errors over all of the space of scenes, counts over random scenes, and the energy balance.

mod independent;
mod lead;
mod ledger;
mod maps;
mod solution;
mod statistics;
mod trial;

use reference::grids::{Impact, dampings};

use crate::content::{Part, Run, Section};
use maps::Map;
use solution::{STEPS, TOLERANCE};
use trial::{MOST_INTERVALS, Method};

pub(crate) fn section(run: &Run) -> Result<Section, String> {
    let maps = Map::all(run);
    let (lead, counts) = lead::picture(&maps)?;
    let first = maps.first().ok_or("there is no map")?;
    let mut parts = vec![Part::Table(counts), first.error(Method::Double)?, first.error(Method::Paper)?];
    for map in &maps {
        // The first map has shown two of its pictures.
        let shown: &[Method] = if std::ptr::eq(map, first) { &[Method::Double, Method::Paper] } else { &[] };
        let mut pictures = vec![Part::Text(map.plane.text.to_owned()), map.restitution()?];
        for method in Method::ALL.into_iter().filter(|method| !shown.contains(method)) {
            pictures.push(map.error(method)?);
        }
        parts.push(Part::Fold(format!("Maps: {}", map.plane.title), pictures));
    }
    parts.extend([
        Part::Fold("Random scenes, by method and kind".to_owned(), statistics::parts(run)),
        Part::Fold("Energy balance".to_owned(), ledger::parts(&maps)?),
        Part::Fold("How it is measured".to_owned(), vec![Part::Text(introduction()), Part::Text(confirmation(&maps)?)]),
    ]);
    Ok(Section { title: "Stability", name: "stability", lead: Some(lead), left_out: None, parts })
}

fn introduction() -> String {
    format!(
        "Adaptive in f64 has a tolerance of {TOLERANCE:.0e}; its bounds are an error of three times that, {MOST_INTERVALS} intervals \
         and the right outcome. Collocation with eight nodes in f32 has a tolerance of 1e-6 and an error bound of 2e-6. FixedCost \
         with four nodes and two iterations in fixed point may err in e by 1e-5 more than the same method in f64, where e exceeds \
         0.2 and adhesion does not dominate (p < 0.95); elsewhere it has no bound. The paper's method, Runge-Kutta-Gill with \
         {STEPS} steps in the duration of Hertz's impact and at most 64 times as many in all, counts as failed where its error \
         exceeds 1e-3. An error is that of e^2 or, if larger, the relative error of the peak indentation; in fixed point it is \
         what fixed point adds to e. The reference is Collocation with 14 nodes and a tolerance of 1e-13. Single precision is \
         compared with the solution for its rounded inputs. An answer is undecided where the approach speed is closer to the \
         critical one than the error."
    )
}

/// What confirms the solutions that the errors are measured by.
fn confirmation(maps: &[Map]) -> Result<String, String> {
    let unlike: Vec<_> = maps.iter().flat_map(Map::points).filter_map(|point| point.unlike).collect();
    let points = maps.iter().flat_map(Map::points).filter(|point| point.restitution.is_some()).count();
    let largest = unlike.iter().copied().fold(0.0, f64::max);
    let known = maps.iter().filter_map(|map| Some((map, map.plane.rebounds?)));
    let sides: Vec<_> = known
        .flat_map(|(map, rebounds)| map.points().filter_map(move |point| Some((point.restitution? > 0.0) == rebounds)))
        .collect();
    let wrong = sides.iter().filter(|right| !**right).count();
    let mut of_form = 0.0_f64;
    for damping in dampings() {
        let unit = Impact { strength: 0.0, zeta_a: 0.0, ..Impact::PAPER };
        let impact = Impact { zeta_h: damping / (unit.damping_unit() * unit.speed), ..unit };
        let found = solution::exactly(&impact).map_err(|error| error.to_string())?;
        let square = found.solution.ok_or("a reference without a solution")?.square;
        of_form = of_form.max((square - independent::without_adhesion(damping).powi(2)).abs());
    }
    Ok(format!(
        "Independent solutions confirm the reference of the errors. At {} of {points} points the classical Runge-Kutta \
         method on the equations in the contact radius converges to 1e-12 within its steps; the other points are stiff or \
         dominated by adhesion. There both differ by at most {largest:.1e} in e^2. Without adhesion, e follows from \
         d (1 + e) = ln((1 + d)/(1 - e d)); the error of e^2 is at most {of_form:.1e} for d from 1e-4 to 1e6. Of {} \
         outcomes beside the critical speed, down to a billionth of it, {wrong} contradict that speed. The test \
         `simulation_reference` compares with solutions to 20 digits.",
        unlike.len(),
        sides.len()
    ))
}
