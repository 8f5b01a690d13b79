//! The contact simulation against solutions to 20 digits.

use std::collections::BTreeMap;

use microimpact::simulation::{Collocation, Nodes, SimulatedImpact, Simulation, Status, TangentialContact};
use microimpact::{InputError, NormalMotion, Outcome, Real, Sphere, Stiffness, SurfaceMotion};

const CASES: &str = include_str!("../data/cases.csv");

/// A row of the reference.
struct Case {
    names: csv::StringRecord,
    cells: csv::StringRecord,
}

impl Case {
    fn text(&self, column: &str) -> &str {
        let index = self.names.iter().position(|name| name == column).unwrap();
        &self.cells[index]
    }

    fn number(&self, column: &str) -> f64 {
        self.text(column).parse().unwrap()
    }

    /// Family, with the near-critical cases divided by their distance from the critical speed.
    fn family(&self) -> String {
        match self.text("name").split_once("_vc") {
            Some((_, distance)) => format!("critical {distance}"),
            None => self.text("family").to_owned(),
        }
    }

    fn simulate<const N: usize, T: Nodes<N>>(
        &self,
        tolerance: f64,
    ) -> Result<SimulatedImpact<T, TangentialContact<T>>, InputError> {
        let number = |column: &str| T::constant(self.number(column));
        let sphere = Sphere::solid(number("radius_m"), number("density_kg_m3"))?;
        let motion = NormalMotion::new(number("speed_normal_m_s"))?
            .with_tangential(number("speed_tangential_m_s"))?
            .with_spin(&sphere, number("spin_rad_s"))?;
        let method = Collocation::<N, T>::new(T::constant(tolerance))?;
        let scene = Simulation::new(sphere, Stiffness::new(number("stiffness_pa"))?)
            .with_damping(number("zeta_h"))?
            .with_ring(number("adhesion_n_m"), number("zeta_a"))?
            .with_friction(number("friction"))?;
        if self.number("peeling_n_m") > 0.0 {
            scene.with_peeling(number("peeling_n_m"))?.impact(&method, &motion)
        } else {
            scene.impact(&method, &motion)
        }
    }
}

fn cases() -> Vec<Case> {
    let mut reader = csv::Reader::from_reader(CASES.as_bytes());
    let names = reader.headers().unwrap().clone();
    reader.records().map(|cells| Case { names: names.clone(), cells: cells.unwrap() }).collect()
}

/// Largest errors by family and output; e^2 absolute, all else relative.
type Errors = BTreeMap<(String, &'static str), f64>;

fn errors<const N: usize, T: Nodes<N>>(tolerance: f64, double: impl Fn(T) -> f64) -> (Errors, Vec<String>) {
    let (mut errors, mut wrong) = (Errors::new(), Vec::new());
    for case in cases() {
        let name = case.text("name").to_owned();
        let impact = match case.simulate::<N, T>(tolerance) {
            Ok(impact) => impact,
            Err(error) => {
                wrong.push(format!("{name}: {error}"));
                continue;
            }
        };
        let rebounds = case.text("outcome") == "rebound";
        let rolls = case.text("motion") == "rolling";
        let found = impact.normal.outcome() == Outcome::Rebound;
        if impact.run.status != Status::Solved || found != rebounds {
            wrong.push(format!("{name}: {:?}, {:?}", impact.normal.outcome(), impact.run));
            continue;
        }
        if rebounds && (impact.tangential.motion() == SurfaceMotion::Rolling) != rolls {
            wrong.push(format!("{name}: {:?}", impact.tangential.motion()));
        }
        let mut note = |output: &'static str, error: f64| {
            let largest = errors.entry((case.family(), output)).or_insert(0.0);
            if !(error <= *largest) {
                *largest = error;
            }
        };
        let mut compare = |output: &'static str, value: Option<T>, column: &str| {
            let exact = case.number(column);
            match value {
                Some(value) if exact.is_finite() && exact != 0.0 => note(output, (double(value) / exact - 1.0).abs()),
                Some(value) if exact == 0.0 => note(output, double(value).abs()),
                Some(_) => wrong.push(format!("{name}: {output} should not exist")),
                None if exact.is_nan() => {}
                None => wrong.push(format!("{name}: {output} is missing")),
            }
        };
        compare("peak", impact.normal.peak_indentation(), "max_indentation_m");
        compare("turning", impact.normal.turning_indentation(), "turning_indentation_m");
        if !rebounds {
            continue;
        }
        compare("contact time", impact.outputs.times.contact, "contact_time_s");
        compare("peak time", impact.outputs.times.peak, "time_peak_s");
        compare("impulse", Some(impact.outputs.impulses.elastic), "impulse_hertz_n_s");
        compare("adhesion impulse", Some(impact.outputs.impulses.adhesion_rebound), "impulse_adhesion_rebound_n_s");
        compare("material work", Some(impact.outputs.works.material), "work_material_j");
        compare("adhesion work", Some(impact.outputs.works.adhesion), "work_adhesion_j");
        compare("V_t", Some(impact.tangential.velocity()), "speed_tangential_out_m_s");
        compare("W", Some(impact.tangential.spin()), "spin_out_rad_s");
        compare("rotation", Some(impact.tangential.rotation()), "rotation_rad");
        compare("displacement", Some(impact.tangential.displacement()), "displacement_tangential_m");
        match impact.tangential.rolls_from() {
            Some(time) => compare("roll time", Some(time), "time_roll_s"),
            None => assert_eq!(case.number("time_roll_s"), -1.0, "{name}"),
        }
        let e = double(impact.normal.overall_restitution());
        note("e^2", (e * e - case.number("restitution").powi(2)).abs());
    }
    (errors, wrong)
}

fn table(errors: &Errors) -> String {
    let mut lines = BTreeMap::<&str, Vec<String>>::new();
    for ((family, output), error) in errors {
        lines.entry(family).or_default().push(format!("{output} {error:.0e}"));
    }
    lines.iter().map(|(family, errors)| format!("{family}: {}\n", errors.join(", "))).collect()
}

#[test]
fn explore() {
    let (errors12, wrong) = errors::<12, f64>(1e-12, |x| x);
    println!("{}{wrong:#?}", table(&errors12));
    let (errors9, wrong) = errors::<9, f64>(1e-9, |x| x);
    println!("{}{wrong:#?}", table(&errors9));
    let (errors7, wrong) = errors::<7, f64>(1e-6, |x| x);
    println!("{}{wrong:#?}", table(&errors7));
    let (errors8, wrong) = errors::<8, f32>(1e-6, f64::from);
    println!("{}{wrong:#?}", table(&errors8));
}
