//! Every law with every damping and end of contact, against solutions to 20 digits.

use csv::{Reader, StringRecord};
use microimpact::contact::{Adaptive, AnyLaw, Contact, JkrEnd, Times};
use microimpact::{CriticalSpeed, Dual, InputError, NormalMotion, Outcome, Real, Sphere, Stiffness};

const IMPACTS: &str = include_str!("../../../data/laws.csv");
const CRITICAL: &str = include_str!("../../../data/laws_critical.csv");

/// A row with its names.
struct Row {
    header: StringRecord,
    cells: StringRecord,
}

fn rows(text: &str) -> Vec<Row> {
    let mut reader = Reader::from_reader(text.as_bytes());
    let header = reader.headers().unwrap().clone();
    reader.records().map(|cells| Row { header: header.clone(), cells: cells.unwrap() }).collect()
}

/// Columns that a result depends on.
const INPUTS: [&str; 8] = [
    "radius_m",
    "density_kg_m3",
    "stiffness_pa",
    "work_of_adhesion_j_m2",
    "adhesion_n_m",
    "zeta_a",
    "damping_value",
    "speed_normal_m_s",
];

impl Row {
    fn text(&self, column: &str) -> &str {
        self.header.iter().position(|name| name == column).map_or("", |place| &self.cells[place])
    }

    /// `None` where the cell is empty.
    fn number(&self, column: &str) -> Option<f64> {
        Some(self.text(column)).filter(|text| !text.is_empty()).map(|text| text.parse().unwrap())
    }

    fn inputs(&self) -> [f64; 8] {
        INPUTS.map(|column| self.number(column).unwrap_or(0.0))
    }

    fn scene<T: Real>(&self, inputs: [T; 8]) -> Result<Contact<T, AnyLaw<T>>, InputError> {
        let [radius, density, stiffness, work, strength, zeta_a, damping, _] = inputs;
        let stiffness = Stiffness::new(stiffness)?;
        let law = match (self.text("law"), self.text("end_rule")) {
            ("hertz", "no-indentation") => AnyLaw::hertz(stiffness),
            ("hertz", "no-force") => AnyLaw::without_tension(stiffness),
            ("ring", "no-indentation") => AnyLaw::ring(stiffness, strength, zeta_a)?,
            ("dmt", "no-indentation") => AnyLaw::dmt(stiffness, work)?,
            ("jkr", "snap-off") => AnyLaw::jkr(stiffness, work, JkrEnd::SnapOff)?,
            ("jkr", "pull-off") => AnyLaw::jkr(stiffness, work, JkrEnd::PullOff)?,
            other => panic!("{other:?}"),
        };
        let law = match self.text("damping") {
            "none" => law,
            "hysteretic" => law.with_damping(damping)?,
            "viscoelastic" => law.with_viscoelastic_damping(damping)?,
            "constant" => law.with_constant_damping(damping)?,
            other => panic!("{other}"),
        };
        Ok(Contact::new(Sphere::solid(radius, density)?, law))
    }
}

/// Outcome, then e^2, peak indentation, its time, contact time.
fn solve<T: Real>(
    row: &Row,
    inputs: [T; 8],
    method: &impl microimpact::contact::ErrorControl<T>,
) -> (Option<Outcome>, [Option<T>; 4]) {
    let scene = row.scene(inputs).unwrap();
    let (impact, times) = scene.solve_for(&NormalMotion::new(inputs[7]).unwrap(), method, Times).unwrap();
    let e = impact.normal.overall_restitution();
    let indentation = impact.normal.peak_indentation();
    (impact.normal.outcome(), [Some(e * e), indentation, times.peak, times.contact])
}

#[test]
fn impacts() {
    let rows = rows(IMPACTS);
    assert_eq!(rows.len(), 69);
    let mut faults = String::new();
    for row in rows {
        let (outcome, found) = solve(&row, row.inputs(), &Adaptive::new(1e-12).unwrap());
        let (_, derivatives) =
            solve(&row, Dual::variables(row.inputs()), &Adaptive::new(Dual::constant(1e-12)).unwrap());
        let name = format!("{} {}", row.text("family"), row.text("name"));
        let expected = if row.text("outcome") == "rebound" { Outcome::Rebound } else { Outcome::Capture };
        if outcome != Some(expected) {
            faults += &format!("{name}: {outcome:?}\n");
            continue;
        }
        let columns = ["restitution", "max_indentation_m", "time_peak_s", "contact_time_s"];
        for (index, column) in columns.into_iter().enumerate() {
            let Some(exact) = row.number(column) else { continue };
            let (exact, allowed) = if index == 0 { (exact * exact, 1e-12) } else { (exact, 1e-9 * exact) };
            let change = derivatives[index].map_or(0.0, |output| {
                let parts = output.partials.iter().zip(row.inputs());
                parts.map(|(partial, input)| (partial * input).abs()).sum::<f64>() * f64::EPSILON
            });
            let error = found[index].map_or(f64::INFINITY, |found| (found - exact).abs());
            if error > allowed.max(4.0 * change) {
                faults += &format!("{name} {column}: {:e} of {:e}\n", error / exact, allowed.max(4.0 * change) / exact);
            }
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

#[test]
fn critical_speeds() {
    let rows = rows(CRITICAL);
    assert_eq!(rows.len(), 10);
    for row in rows {
        let found = row.scene(row.inputs()).unwrap().critical_speed(&Adaptive::new(1e-10).unwrap()).unwrap();
        let exact = row.number("critical_speed_m_s").unwrap();
        let CriticalSpeed::At(found) = found else { panic!("{}: {found:?}", row.text("name")) };
        assert!((found / exact - 1.0).abs() < 1e-9, "{}: {found:e} {exact:e}", row.text("name"));
    }
}
