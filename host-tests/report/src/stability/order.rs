//! Order of convergence: how fast the error falls with the number of steps or nodes.

use microimpact::InputError;
use microimpact::contact::{Collocation, FixedCost, NormalContact, RungeKuttaGill, Status, Times};
use reference::grids::Impact;
use reference::{Case, cases};

use super::independent;
use crate::content::{Cell, Figure, Part, Run, Table};
use crate::plot::{self, Line, Mark};

/// Errors of e below this are rounding.
const ROUNDING: f64 = 2e-13;

/// A method on a scene, from coarse to fine.
struct Convergence {
    name: &'static str,
    scene: &'static str,
    /// Steps of the contact, or nodes of all its intervals or phases, and error of e.
    points: Vec<(f64, f64)>,
    /// Whether the error should fall with a power of their number.
    power: bool,
}

pub(super) fn parts(run: &Run) -> Result<Vec<Part>, String> {
    let most = if run.quick { 8192 } else { 65_536 };
    let [with, without] = [case("table1")?, case("mean_sphere_no_adhesion")?];
    let scenes = [("with adhesion", &with), ("without", &without)];
    let mut all = Vec::new();
    for (scene, case) in scenes {
        all.push(Convergence { name: "the paper's method", scene, points: by_the_paper(case, most)?, power: true });
    }
    for (scene, case) in scenes {
        let points = in_contact_radius(case, most);
        all.push(Convergence { name: "Runge-Kutta in the contact radius", scene, points, power: true });
    }
    for (scene, case) in scenes {
        all.push(Convergence { name: "FixedCost, 40 iterations", scene, points: whole_phases(case)?, power: false });
    }
    for (scene, case) in scenes {
        all.push(Convergence { name: "Collocation<7>", scene, points: intervals::<7>(case)?, power: false });
    }
    let caption = "Error of e of Table 1 and of the mean sphere without adhesion";
    let (x, y) = ("steps, or nodes of all intervals", "error of e");
    // The methods come in pairs, one for each scene.
    let line = |(index, one): (usize, &Convergence)| {
        let line = Line::new(&format!("{}, {}", one.name, one.scene), Mark::Joined, one.points.clone());
        if index % 2 == 0 { line.like(index / 2) } else { line.beside(index / 2) }
    };
    let lines: Vec<_> = all.iter().enumerate().map(line).collect();
    let points = all.iter().flat_map(|one| {
        one.points.iter().map(|at| vec![one.name.into(), one.scene.into(), Cell::from(at.0), Cell::from(at.1)])
    });
    let data = Table {
        name: "stability-convergence".to_owned(),
        caption: caption.to_owned(),
        columns: ["method", "scene", x, y].map(str::to_owned).to_vec(),
        rows: points.collect(),
    };
    let rows = all.iter().map(|one| {
        let above_rounding: Vec<_> = one.points.iter().copied().filter(|at| at.1 > ROUNDING).collect();
        let power = slope(above_rounding.iter().map(|at| (at.0.ln(), -at.1.ln())));
        let digits = slope(above_rounding.iter().map(|at| (at.0, -at.1.log10())));
        let (fewest, most) = (above_rounding.first().map(|at| at.0), above_rounding.last().map(|at| at.0));
        vec![
            one.name.into(),
            one.scene.into(),
            fewest.into(),
            most.into(),
            power.into(),
            digits.filter(|_| !one.power).into(),
            one.points.iter().map(|at| at.1).reduce(f64::min).into(),
        ]
    });
    let table = Table {
        name: "stability-orders".to_owned(),
        caption: "Order of convergence by least squares, above the rounding".to_owned(),
        columns: ["method", "scene", "from", "to, steps or nodes", "order", "digits per node", "smallest error"]
            .map(str::to_owned)
            .to_vec(),
        rows: rows.collect(),
    };
    let text = "The forces of the paper's equations contain the powers 1/2 and 3/2 of the indentation. At first contact \
                and at separation they are not smooth, and a method of order 4 reaches an order of only 3/2 with adhesion \
                and 5/2 without. In the contact radius the motion is smooth, and the classical Runge-Kutta method keeps \
                its order. With collocation over whole phases the number of correct digits is proportional to the \
                number of nodes, which is faster than any power. More intervals of seven nodes converge with a higher \
                order.";
    Ok(vec![
        Part::Heading("Order of convergence".to_owned()),
        Part::Text(text.to_owned()),
        Part::Table(table),
        Part::Figure(Figure { drawing: plot::log_log("Order of convergence", x, y, &lines)?, data }),
    ])
}

fn case(name: &str) -> Result<Case, String> {
    cases().into_iter().find(|case| case.text("name") == name).ok_or_else(|| format!("no reference of {name}"))
}

fn error(case: &Case, contact: &NormalContact<f64>) -> Option<f64> {
    let error = (contact.overall_restitution() - case.number("restitution")).abs();
    // Less than rounding is luck.
    (contact.status() == Status::Solved).then_some(error.max(f64::EPSILON))
}

/// Numbers that grow by the square root of two.
fn half_octaves(from: u32, to: u32) -> impl Iterator<Item = f64> {
    (0..)
        .map(move |index| (f64::from(from) * 2_f64.powf(0.5 * f64::from(index))).round())
        .take_while(move |count| *count <= f64::from(to))
}

fn by_the_paper(case: &Case, most: u32) -> Result<Vec<(f64, f64)>, String> {
    let text = |error: InputError| error.to_string();
    let (scene, motion) = (case.scene::<f64>().map_err(text)?, case.motion::<f64>().map_err(text)?);
    let at = |steps: f64| {
        let contact = scene.solve_normal(&motion, &RungeKuttaGill::new(steps as u32)).ok()?;
        Some((steps, error(case, &contact)?))
    };
    Ok(half_octaves(16, most).filter_map(at).collect())
}

fn in_contact_radius(case: &Case, most: u32) -> Vec<(f64, f64)> {
    let impact = Impact {
        radius: case.number("radius_m"),
        stiffness: case.number("stiffness_pa"),
        speed: case.number("speed_normal_m_s"),
        zeta_h: case.number("zeta_h"),
        strength: case.number("adhesion_n_m"),
        zeta_a: case.number("zeta_a"),
    };
    let at = |fineness: f64| {
        let (square, steps) = independent::restitution_squared(&impact, fineness)?;
        let error = (square.sqrt() - case.number("restitution")).abs().max(f64::EPSILON);
        (steps <= most).then_some((f64::from(steps), error))
    };
    half_octaves(8, 4096).filter_map(at).collect()
}

fn whole_phases(case: &Case) -> Result<Vec<(f64, f64)>, String> {
    let errors = [
        whole_phase::<3>(case),
        whole_phase::<4>(case),
        whole_phase::<5>(case),
        whole_phase::<6>(case),
        whole_phase::<7>(case),
        whole_phase::<8>(case),
        whole_phase::<10>(case),
        whole_phase::<12>(case),
    ];
    Ok(errors.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

/// Two phases of `N` nodes.
fn whole_phase<const N: usize>(case: &Case) -> Result<Option<(f64, f64)>, String> {
    let contact =
        case.scene::<f64>().and_then(|scene| scene.solve_normal(&case.motion::<f64>()?, &FixedCost::<N>::new(40)?));
    let contact = contact.map_err(|error| error.to_string())?;
    Ok(error(case, &contact).map(|error| (2.0 * N as f64, error)))
}

/// Intervals of `N` nodes, as many as a tolerance asks for, for all tolerances that so many nodes keep.
fn intervals<const N: usize>(case: &Case) -> Result<Vec<(f64, f64)>, String> {
    let at = |digits: i32| {
        let Ok(method) = Collocation::<N, f64>::new(10_f64.powf(-0.5 * f64::from(digits))) else { return Ok(None) };
        let (impact, _) = case.scene::<f64>()?.solve_for(&case.motion::<f64>()?, &method, Times)?;
        let nodes = f64::from(impact.run.steps) * N as f64;
        Ok(error(case, &impact.normal).map(|error| (nodes, error)))
    };
    let points: Result<Vec<_>, InputError> = (6..=26).map(at).collect();
    let mut points: Vec<_> = points.map_err(|error| error.to_string())?.into_iter().flatten().collect();
    // Of tolerances that take the same number of intervals the tightest.
    points.reverse();
    points.dedup_by_key(|at| at.0);
    points.reverse();
    Ok(points)
}

/// Slope of the line of least squares through points.
fn slope(points: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let points: Vec<_> = points.collect();
    let rows = points.iter().map(|(x, _)| nalgebra::RowVector2::new(1.0, *x)).collect::<Vec<_>>();
    if rows.len() < 2 {
        return None;
    }
    let matrix = nalgebra::MatrixXx2::from_rows(&rows);
    let values = nalgebra::DVector::from_iterator(points.len(), points.iter().map(|(_, y)| *y));
    let solution = matrix.svd(true, true).solve(&values, f64::EPSILON).ok()?;
    Some(solution[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slope_of_a_line_and_of_scattered_points() {
        let line = [(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)];
        assert!((slope(line.into_iter()).unwrap() - 2.0).abs() < 1e-12);
        // Least squares by hand: sum of xy over sum of xx about the means.
        let scattered = [(0.0, 0.0), (1.0, 2.0), (2.0, 1.0)];
        assert!((slope(scattered.into_iter()).unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(slope([(1.0, 1.0)].into_iter()), None);
    }

    /// What the section says of the orders.
    #[test]
    fn orders_are_those_of_the_text() {
        for (name, paper) in [("table1", 1.5), ("mean_sphere_no_adhesion", 2.5)] {
            let case = case(name).unwrap();
            let order = |points: Vec<(f64, f64)>| {
                slope(points.into_iter().filter(|at| at.1 > 1e-10).map(|at| (at.0.ln(), -at.1.ln()))).unwrap()
            };
            let found = order(by_the_paper(&case, 8192).unwrap());
            assert!((found - paper).abs() < 0.25, "{name}: {found}");
            let found = order(in_contact_radius(&case, 8192));
            assert!(found > 3.7, "{name}: {found}");
        }
    }
}
