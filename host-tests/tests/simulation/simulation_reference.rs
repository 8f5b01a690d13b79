//! The contact simulation against solutions to 20 digits.

use crate::everything::{Impact, solve_case};
use microimpact::contact::{Collocation, Nodes, Status};
use microimpact::{InputError, Outcome, Real, SurfaceMotion};
use reference::{Case, cases};

/// Family, with the near-critical cases divided by their distance from the critical speed.
fn family(case: &Case) -> String {
    match case.text("name").split_once("_vc") {
        Some((_, distance)) => format!("critical {distance}"),
        None => case.text("family").to_owned(),
    }
}

fn simulate<const N: usize, T: Nodes<N>>(case: &Case, tolerance: f64) -> Result<Impact<T>, InputError> {
    solve_case(case, &Collocation::<N, T>::new(T::constant(tolerance))?)
}

/// Outputs by name, with the columns of their reference; those after the first two are of a rebound.
fn outputs<T: Real>((impact, everything): &Impact<T>) -> [(&'static str, &'static str, Option<T>); 15] {
    let (normal, tangential) = (&impact.normal, &impact.tangential);
    let (times, impulses, works, slip) = everything;
    [
        ("peak", "max_indentation_m", normal.peak_indentation()),
        ("turning", "turning_indentation_m", normal.turning_indentation()),
        ("contact time", "contact_time_s", times.contact),
        ("peak time", "time_peak_s", times.peak),
        ("impulse", "impulse_hertz_n_s", Some(impulses.elastic)),
        ("adhesion impulse", "impulse_adhesion_rebound_n_s", Some(impulses.adhesion_rebound)),
        ("material work", "work_material_j", Some(works.material)),
        ("adhesion work", "work_adhesion_j", Some(works.adhesion)),
        ("V_t", "speed_tangential_out_m_s", Some(slip.velocity)),
        ("W", "spin_out_rad_s", Some(slip.spin)),
        ("V_t of the impulse", "speed_tangential_out_m_s", Some(tangential.velocity())),
        ("W of the impulse", "spin_out_rad_s", Some(tangential.spin())),
        ("rotation", "rotation_rad", Some(slip.rotation)),
        ("displacement", "displacement_tangential_m", Some(slip.displacement)),
        // The reference has -1 where the slip does not end.
        ("roll time", "time_roll_s", Some(slip.rolls_from.unwrap_or(T::constant(-1.0)))),
    ]
}

/// An error: of e^2 absolute, of all else relative.
struct Error {
    case: Case,
    output: &'static str,
    size: f64,
}

fn errors<const N: usize, T: Nodes<N>>(tolerance: f64, double: impl Fn(T) -> f64) -> (Vec<Error>, Vec<String>) {
    let (mut errors, mut wrong) = (Vec::new(), Vec::new());
    for case in cases() {
        let name = case.text("name").to_owned();
        let solved = match simulate::<N, T>(&case, tolerance) {
            Ok(solved) => solved,
            Err(error) => {
                wrong.push(format!("{name}: {error}"));
                continue;
            }
        };
        let (impact, (.., slip)) = &solved;
        let rebounds = case.text("outcome") == "rebound";
        let rolls = case.text("motion") == "rolling";
        if impact.normal.outcome() == Some(Outcome::Undecided) {
            // Where e^2 is within twice its bound; of a capture, near the critical speed.
            let near = case.number("restitution").powi(2) <= 2.0 * double(impact.run.error_bound);
            if !near || case.text("family") != "near_critical" {
                wrong.push(format!("{name}: undecided, {:?}", impact.run));
            }
            continue;
        }
        let found = impact.normal.outcome() == Some(Outcome::Rebound);
        if impact.run.status != Status::Solved || found != rebounds {
            wrong.push(format!("{name}: {:?}, {:?}", impact.normal.outcome(), impact.run));
            continue;
        }
        if rebounds && ((impact.tangential.motion() == SurfaceMotion::Rolling) != rolls || slip.slides == rolls) {
            wrong.push(format!("{name}: {:?}, {slip:?}", impact.tangential.motion()));
        }
        let mut note = |output, size| errors.push(Error { case: case.clone(), output, size });
        let outputs = outputs(&solved);
        for (output, column, value) in &outputs[..if rebounds { outputs.len() } else { 2 }] {
            let exact = case.number(column);
            match value.map(&double) {
                Some(value) if exact.is_finite() && exact != 0.0 => note(output, (value / exact - 1.0).abs()),
                Some(value) if exact == 0.0 => note(output, value.abs()),
                Some(_) => wrong.push(format!("{name}: {output} should not exist")),
                None if exact.is_nan() => {}
                None => wrong.push(format!("{name}: {output} is missing")),
            }
        }
        if rebounds {
            let e = double(impact.normal.overall_restitution());
            note("e^2", (e * e - case.number("restitution").powi(2)).abs());
        }
    }
    (errors, wrong)
}

/// What a case is computed from, each rounded by a number type.
const INPUTS: [&str; 11] = [
    "radius_m",
    "density_kg_m3",
    "stiffness_pa",
    "adhesion_n_m",
    "zeta_h",
    "zeta_a",
    "friction",
    "peeling_n_m",
    "speed_normal_m_s",
    "speed_tangential_m_s",
    "spin_rad_s",
];

/// Condition number of an output: the sum of the relative changes that each input makes, over that of the input; from
/// solutions in double precision at its best.
fn condition(case: &Case, output: &str) -> f64 {
    // Far less than the distance of any case from its critical speed, and far more than rounding.
    const STEP: f64 = 1e-8;
    let logarithm = |case: &Case| {
        let outputs = outputs(&simulate::<14, f64>(case, 1e-13).unwrap());
        let (.., value) = outputs.iter().find(|(name, ..)| *name == output).unwrap();
        value.unwrap().abs().ln()
    };
    let inputs = INPUTS.iter().filter(|column| case.number(column) != 0.0);
    let slopes = inputs.map(|column| {
        let [above, below] = [1.0 + STEP, 1.0 - STEP].map(|factor| logarithm(&case.scaled(column, factor)));
        ((above - below) / (2.0 * STEP)).abs()
    });
    slopes.sum()
}

/// Roundings of each input that change an output as much as its error may be, where that is more than its bound.
const ROUNDINGS: f64 = 3.0;

/// What a setting of the method is allowed: e^2, indentations, and all other outputs.
struct Allowed {
    restitution: f64,
    indentation: f64,
    others: f64,
    /// Family and output with a bound of its own.
    exceptions: &'static [(&'static str, &'static str, f64)],
    /// Family and output that the inputs, rounded to a relative error of `rounding`, do not determine to their bound.
    ill_conditioned: &'static [(&'static str, &'static str)],
    rounding: f64,
}

impl Allowed {
    fn of(&self, Error { case, output, .. }: &Error) -> f64 {
        let family = family(case);
        let exception = self.exceptions.iter().find(|(f, o, _)| *f == family && o == output);
        let bound = match (exception, *output) {
            (Some((.., bound)), _) => *bound,
            (None, "e^2") => self.restitution,
            (None, "peak" | "turning") => self.indentation,
            (None, _) => self.others,
        };
        if self.ill_conditioned.contains(&(family.as_str(), output)) {
            bound.max(ROUNDINGS * self.rounding * condition(case, output))
        } else {
            bound
        }
    }
}

fn assert_within((errors, wrong): &(Vec<Error>, Vec<String>), allowed: &Allowed) {
    assert!(wrong.is_empty(), "{wrong:#?}");
    let mut beyond = Vec::new();
    for error in errors {
        let bound = allowed.of(error);
        if error.size.is_nan() || error.size > bound {
            let name = error.case.text("name");
            beyond.push(format!("{name}, {}: {:.1e}, allowed {bound:.1e}", error.output, error.size));
        }
    }
    let largest = |family: &str, output: &str| {
        let of_both = errors.iter().filter(|error| self::family(&error.case) == family && error.output == output);
        of_both.map(|error| error.size).fold(0.0, f64::max)
    };
    for (family, output, bound) in allowed.exceptions {
        let error = largest(family, output);
        if error < bound / 30.0 {
            beyond.push(format!("{family}, {output}: an exception of {bound:.0e} is not needed for {error:.1e}"));
        }
    }
    for (family, output) in allowed.ill_conditioned {
        let error = largest(family, output);
        let plain = if *output == "turning" { allowed.indentation } else { allowed.others };
        if error <= plain {
            beyond.push(format!("{family}, {output}: {error:.1e} is within the bound as it is"));
        }
    }
    assert!(beyond.is_empty(), "{beyond:#?}");
}

/// Just below the critical speed the turning point moves with the third root of the square of an energy that is the small
/// difference of what the sphere brings and what it loses.
#[test]
fn double_precision_at_its_best() {
    let allowed = Allowed {
        restitution: 1e-14,
        indentation: 1e-11,
        others: 1e-10,
        exceptions: &[],
        ill_conditioned: &[("critical -1e-06", "turning")],
        rounding: f64::EPSILON / 2.0,
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
        ill_conditioned: &[],
        rounding: f64::EPSILON / 2.0,
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
        ill_conditioned: &[],
        rounding: f64::EPSILON / 2.0,
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
        ill_conditioned: &[],
        rounding: f64::EPSILON / 2.0,
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
        exceptions: &[("figure6", "turning", 1e-5)],
        ill_conditioned: &[("critical -0.001", "turning")],
        rounding: f64::from(f32::EPSILON) / 2.0,
    };
    assert_within(&errors::<8, f32>(1e-6, f64::from), &allowed);
}
