//! The joint fit on synthetic clouds: it finds the truth within the intervals that it states.

use joint_fit::{COUNT, FitError, Impact, JointFit, Known, NAMES, Parameters, restitution};
use microimpact::Parameter;
use microimpact_cli::joint_fit::figures;
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution, Normal, StandardNormal};

use crate::{Output, microimpact};

/// The paper's parameters and mean sphere, with a spread of 6 %.
const TRUTH: Parameters = [250.0, 10.5, 6.25, 8.6e-6, 0.06];

const NOISE: f64 = 0.005;
const DIAMETER_ERROR: f64 = 2e-7;

/// A cloud of impacts at some speeds, and the mean diameter as it was measured.
fn cloud(random: &mut StdRng, repeats: usize) -> (Known, Vec<Impact>) {
    let measured = Normal::new(TRUTH[3], DIAMETER_ERROR).unwrap().sample(random);
    let known = Known { stiffness: 7.5e10, density: 2600.0, noise: NOISE, diameter: (measured, DIAMETER_ERROR) };
    let [f0, zeta_h, zeta_a, mean, spread] = TRUTH;
    let mut impacts = Vec::new();
    for step in 0..24 {
        let speed = 2.9 * 1.12_f64.powi(step);
        for _ in 0..repeats {
            let [deviate, error]: [f64; 2] = [StandardNormal.sample(random), StandardNormal.sample(random)];
            let diameter = mean * (spread * deviate - 0.5 * spread * spread).exp();
            let exact = restitution(&known, [f0, zeta_h, zeta_a, diameter], speed).unwrap();
            impacts.push(Impact { speed, restitution: exact + NOISE * error });
        }
    }
    (known, impacts)
}

/// Far from the truth: the fit has to find its way.
fn first(known: &Known) -> Parameters {
    [200.0, 8.0, 8.0, known.diameter.0, 0.1]
}

#[test]
fn intervals_of_95_percent_hold_the_truth() {
    const SETS: usize = 200;
    let mut random = StdRng::seed_from_u64(17);
    let (mut held, mut together) = ([0; COUNT], 0);
    let mut widths = [0.0; COUNT];
    for _ in 0..SETS {
        let (known, impacts) = cloud(&mut random, 40);
        let fit = JointFit::of(&known, &impacts, first(&known)).unwrap();
        for index in 0..COUNT {
            let (low, high) = fit.interval(index);
            held[index] += usize::from((low..=high).contains(&TRUTH[index]));
            widths[index] += (high / low).ln() / SETS as f64;
        }
        together += usize::from(fit.region_holds((0, TRUTH[0]), (2, TRUTH[2])));
    }
    for (name, held) in NAMES.into_iter().zip(held) {
        let share = held as f64 / SETS as f64;
        assert!((0.90..=0.99).contains(&share), "{}: {share}", name.0);
    }
    let share = together as f64 / SETS as f64;
    assert!((0.90..=0.99).contains(&share), "region: {share}");
    // The intervals say something: f0 to 12 % in all, zeta_H to 5 %, the spread to 12 %.
    for (index, width) in [(0, 0.15), (1, 0.07), (3, 0.12), (4, 0.15)] {
        assert!(widths[index] < width, "{}: {}", NAMES[index].0, widths[index]);
    }
}

/// The deviations of all impacts from their means are as large as diameters and noise together make them.
#[test]
fn residuals_have_their_variance() {
    let (known, impacts) = cloud(&mut StdRng::seed_from_u64(3), 40);
    let fit = JointFit::of(&known, &impacts, first(&known)).unwrap();
    let square = fit.residuals().map(|(_, residual)| residual * residual).sum::<f64>() / impacts.len() as f64;
    assert!((square - 1.0).abs() < 0.15, "{square}");
}

/// Impacts tell f0 over diameter only: without a measured diameter both are uncertain, and their ratio is not.
#[test]
fn only_the_ratio_of_adhesion_and_diameter_is_seen() {
    let (known, impacts) = cloud(&mut StdRng::seed_from_u64(5), 40);
    let blurred = Known { diameter: (known.diameter.0, 0.5 * known.diameter.0), ..known };
    let [sharp, blurred] = [known, blurred].map(|known| JointFit::of(&known, &impacts, first(&known)).unwrap());
    let error = |fit: &JointFit, index: usize| fit.covariance[(index, index)].sqrt();
    assert!(error(&blurred, 0) > 5.0 * error(&sharp, 0));
    let ratio = |fit: &JointFit| {
        let c = &fit.covariance;
        (c[(0, 0)] + c[(3, 3)] - 2.0 * c[(0, 3)]).sqrt()
    };
    assert!((ratio(&blurred) / ratio(&sharp) - 1.0).abs() < 0.1, "{} {}", ratio(&blurred), ratio(&sharp));
}

#[test]
fn what_cannot_be_fitted_says_why() {
    let (known, impacts) = cloud(&mut StdRng::seed_from_u64(9), 1);
    assert!(matches!(JointFit::of(&known, &impacts[..10], first(&known)), Err(FitError::TooFew)));
    let outside = Known { density: -1.0, ..known };
    assert!(matches!(JointFit::of(&outside, &impacts, first(&known)), Err(FitError::Input(_))));
    let at_fault = |known: &Known, impacts: &[Impact]| match JointFit::of(known, impacts, first(known)).err() {
        Some(FitError::Input(error)) => Some(error.parameter),
        _ => None,
    };
    assert_eq!(at_fault(&Known { noise: 0.0, ..known }, &impacts), Some(Parameter::StandardError));
    assert_eq!(at_fault(&Known { diameter: (8.6e-6, f64::NAN), ..known }, &impacts), Some(Parameter::StandardError));
    for (speed, restitution, parameter) in [
        (3.0, 1.5, Parameter::Restitution),
        (3.0, f64::NAN, Parameter::Restitution),
        (f64::NAN, 0.5, Parameter::ApproachSpeed),
        (-3.0, 0.5, Parameter::ApproachSpeed),
    ] {
        let wrong = [&impacts[..], &[Impact { speed, restitution }]].concat();
        assert_eq!(at_fault(&known, &wrong), Some(parameter), "{speed} {restitution}");
    }
    // One speed gives two numbers, a mean and a variance, for five parameters.
    let alike: Vec<_> = (0..40).map(|i| Impact { speed: 5.0, restitution: 0.8 + 0.001 * f64::from(i % 7) }).collect();
    let error = JointFit::of(&known, &alike, first(&known)).map(|fit| fit.covariance).unwrap_err();
    assert!(matches!(error, FitError::Singular | FitError::NotConverged(_)), "{error}");
    assert!(!error.to_string().is_empty());
}

#[test]
fn figures_show_every_impact() {
    let (known, impacts) = cloud(&mut StdRng::seed_from_u64(3), 20);
    let fit = JointFit::of(&known, &impacts, first(&known)).unwrap();
    let path = std::env::temp_dir().join(format!("microimpact-joint-fit-{}.svg", std::process::id()));
    figures::draw(&fit, &path).unwrap();
    let figure = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    // The cloud, predicted against measured, and the residuals within four deviations; the region has a centre.
    let within = fit.residuals().filter(|(_, residual)| residual.abs() <= 4.0).count();
    let circles = figure.matches("<circle").count();
    assert!(circles > 2 * impacts.len() + within, "{circles}");
    for caption in ["Cloud", "Predicted against measured", "Residuals", "Region of 95 %"] {
        assert!(figure.contains(caption), "{caption}");
    }
}

/// The program run on a table, with the paper's mean sphere.
fn run_on(name: &str, table: &[u8]) -> Output {
    let path = std::env::temp_dir().join(format!("microimpact-joint-fit-{name}-{}.csv", std::process::id()));
    std::fs::write(&path, table).unwrap();
    let (noise, error) = (NOISE.to_string(), DIAMETER_ERROR.to_string());
    let arguments = ["--noise", &noise, "--diameter", "8.6e-6", "--diameter-error", &error];
    let output = microimpact("joint-fit", &[&[path.to_str().unwrap()], &arguments[..]].concat(), b"");
    std::fs::remove_file(&path).unwrap();
    output
}

#[test]
fn tables_that_cannot_be_read_say_where() {
    let header = "Speed_normal_m_s;overall_restitution\n";
    for (name, table, sign) in [
        ("empty", String::new(), "the table is empty"),
        (
            "columns",
            "a,b\n1,2\n".into(),
            "lacks required columns: speed_normal_m_s, overall_restitution; the header is: a, b",
        ),
        ("cell", format!("{header}2,5;0,5\n3,5;\n"), "row 2: overall_restitution: missing"),
        ("marks", format!("{header}2,5;0,5\n3,5;0.5\n"), "overall_restitution: \"0.5\" in row 2 has a decimal point"),
        ("ambiguous", format!("{header}2;1\n2.500;1\n"), "speed_normal_m_s: \"2.500\" is ambiguous in row 2"),
        ("word", format!("{header}2,5;0,5\n\"3\";half\n"), "row 2: overall_restitution: \"half\" is not a number"),
        ("rows", header.into(), "the table has no rows below its header"),
        ("range", format!("{header}2,5;0,5\n1e300;0,5\n"), "row 2: speed_normal_m_s: \"1e300\" is refused"),
        ("few", format!("{header}2,5;0,5\n"), "needs 15 impacts"),
    ] {
        let output = run_on(name, table.as_bytes());
        let complaint = output.complaint();
        assert!(output.status == 2 && complaint.contains(sign), "{name}: {complaint}");
    }
}

/// The program reads a table, and its intervals hold the truth.
#[test]
fn from_a_table() {
    use std::fmt::Write;
    let (_, impacts) = cloud(&mut StdRng::seed_from_u64(21), 40);
    let mut table = String::from("speed_normal_m_s,overall_restitution\n");
    for impact in &impacts {
        writeln!(table, "{},{}", impact.speed, impact.restitution.max(0.0)).unwrap();
    }
    let output = run_on("cloud", table.as_bytes());
    assert_eq!(output.status, 0, "{}", output.complaint());
    let text = String::from_utf8(output.stdout).unwrap();
    for (index, (name, _)) in NAMES.into_iter().enumerate() {
        let line = text.lines().find(|line| line.contains(name)).unwrap();
        let numbers: Vec<f64> =
            line.split(|c: char| "|┆│".contains(c)).filter_map(|cell| cell.trim().parse().ok()).collect();
        assert!((numbers[1]..=numbers[2]).contains(&TRUTH[index]), "{line}");
    }
}
