//! The contact simulation against solutions to 20 digits.

use std::collections::BTreeMap;

use host_tests::{Case, cases};
use microimpact::simulation::{Collocation, Nodes, SimulatedImpact, Status, TangentialContact};
use microimpact::{InputError, Outcome, SurfaceMotion};

/// Family, with the near-critical cases divided by their distance from the critical speed.
fn family(case: &Case) -> String {
    match case.text("name").split_once("_vc") {
        Some((_, distance)) => format!("critical {distance}"),
        None => case.text("family").to_owned(),
    }
}

fn simulate<const N: usize, T: Nodes<N>>(
    case: &Case,
    tolerance: f64,
) -> Result<SimulatedImpact<T, TangentialContact<T>>, InputError> {
    let (scene, motion) = (case.scene()?, case.motion()?);
    let method = Collocation::<N, T>::new(T::constant(tolerance))?;
    match case.peeling() {
        Some(lambda) => scene.with_peeling(lambda)?.impact(&method, &motion),
        None => scene.impact(&method, &motion),
    }
}

/// Largest errors by family and output; e^2 absolute, all else relative.
type Errors = BTreeMap<(String, &'static str), f64>;

fn errors<const N: usize, T: Nodes<N>>(tolerance: f64, double: impl Fn(T) -> f64) -> (Errors, Vec<String>) {
    let (mut errors, mut wrong) = (Errors::new(), Vec::new());
    for case in cases() {
        let name = case.text("name").to_owned();
        let impact = match simulate::<N, T>(&case, tolerance) {
            Ok(impact) => impact,
            Err(error) => {
                wrong.push(format!("{name}: {error}"));
                continue;
            }
        };
        let rebounds = case.text("outcome") == "rebound";
        let rolls = case.text("motion") == "rolling";
        let found = impact.normal.outcome() == Some(Outcome::Rebound);
        if impact.run.status != Status::Solved || found != rebounds {
            wrong.push(format!("{name}: {:?}, {:?}", impact.normal.outcome(), impact.run));
            continue;
        }
        if rebounds && (impact.tangential.motion() == SurfaceMotion::Rolling) != rolls {
            wrong.push(format!("{name}: {:?}", impact.tangential.motion()));
        }
        let mut note = |output: &'static str, error: f64| {
            let largest = errors.entry((family(&case), output)).or_insert(0.0);
            if error.is_nan() || error > *largest {
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

/// What a setting of the method is allowed: e^2, indentations, and all other outputs.
struct Allowed {
    restitution: f64,
    indentation: f64,
    others: f64,
    /// Family and output with a bound of its own.
    exceptions: &'static [(&'static str, &'static str, f64)],
}

impl Allowed {
    fn of(&self, family: &str, output: &str) -> f64 {
        let exception = self.exceptions.iter().find(|(f, o, _)| *f == family && *o == output);
        match (exception, output) {
            (Some((.., bound)), _) => *bound,
            (None, "e^2") => self.restitution,
            (None, "peak" | "turning") => self.indentation,
            (None, _) => self.others,
        }
    }
}

fn assert_within((errors, wrong): &(Errors, Vec<String>), allowed: &Allowed) {
    assert!(wrong.is_empty(), "{wrong:#?}");
    let mut beyond = Vec::new();
    for ((family, output), &error) in errors {
        let bound = allowed.of(family, output);
        if error.is_nan() || error > bound {
            beyond.push(format!("{family}, {output}: {error:.1e}, allowed {bound:.0e}"));
        }
    }
    for (family, output, bound) in allowed.exceptions {
        let error = errors[&((*family).to_owned(), *output)];
        if error < bound / 30.0 {
            beyond.push(format!("{family}, {output}: an exception of {bound:.0e} is not needed for {error:.1e}"));
        }
    }
    assert!(beyond.is_empty(), "{beyond:#?}");
}

/// Just below the critical speed the turning point moves with the third root of the energy's square: one unit in the
/// last place of the speed moves it by 1e-10.
#[test]
fn double_precision_at_its_best() {
    let allowed = Allowed {
        restitution: 1e-14,
        indentation: 1e-11,
        others: 1e-10,
        exceptions: &[("critical -1e-06", "turning", 1e-8)],
    };
    assert_within(&errors::<14, f64>(1e-13, |x| x), &allowed);
}

/// Just above the critical speed most of the contact time goes by where the sphere hardly moves.
#[test]
fn twelve_nodes() {
    let allowed = Allowed {
        restitution: 1e-12,
        indentation: 1e-9,
        others: 1e-9,
        exceptions: &[("critical -1e-06", "turning", 3e-8)],
    };
    assert_within(&errors::<12, f64>(1e-12, |x| x), &allowed);
}

#[test]
fn nine_nodes() {
    let allowed = Allowed {
        restitution: 1e-9,
        indentation: 3e-9,
        others: 3e-8,
        exceptions: &[
            ("critical +1e-06", "contact time", 3e-7),
            ("critical -0.001", "turning", 3e-8),
            ("critical -1e-06", "turning", 3e-5),
        ],
    };
    assert_within(&errors::<9, f64>(1e-9, |x| x), &allowed);
}

#[test]
fn seven_nodes() {
    let allowed = Allowed {
        restitution: 1e-6,
        indentation: 1e-6,
        others: 3e-5,
        exceptions: &[
            ("critical +1e-06", "contact time", 2e-3),
            ("critical -0.001", "turning", 1e-4),
            ("critical -1e-06", "turning", 0.1),
        ],
    };
    assert_within(&errors::<7, f64>(1e-6, |x| x), &allowed);
}

/// The turning point of a captured sphere lies where the potential is flat, close to where it would separate.
#[test]
fn single_precision() {
    let allowed = Allowed {
        restitution: 2e-6,
        indentation: 2e-6,
        others: 1e-5,
        exceptions: &[
            ("figure6", "turning", 3e-5),
            ("critical +0.001", "contact time", 3e-5),
            ("critical +1e-06", "contact time", 3e-2),
            ("critical +1e-06", "adhesion impulse", 3e-4),
            ("critical -0.001", "turning", 2e-3),
            ("critical -1e-06", "turning", 1.0),
        ],
    };
    assert_within(&errors::<8, f32>(1e-6, f64::from), &allowed);
}
