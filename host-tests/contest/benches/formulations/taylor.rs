//! Taylor series with C coefficients in z of the regularised equations, with a variable step.
//!
//! With q = s^2 and w = B (1 - g y) - A q (1 + h y) the series of dy/dz = 2 q w take three products of series. Events
//! are zeros of the polynomials; the contact time follows from the series of s.

use std::hint::black_box;

use contest::contestant::{Answer, Contestant};
use contest::problem::{Equations, Problem};

/// Orders 15 and 19 with tolerances from loose to tight.
pub fn contestants(equations: Problem) -> Vec<Contestant> {
    (3..=16).flat_map(|digits| [contestant::<16>(equations, digits), contestant::<20>(equations, digits)]).collect()
}

fn contestant<const C: usize>(equations: Problem, digits: i32) -> Contestant {
    let tolerance = 10f64.powi(-digits);
    Contestant::new("Taylor series in z", format!("order {}", C - 1), format!("{tolerance:.0e}"), move || {
        solve::<C>(black_box(&equations), tolerance)
    })
}

const MOST_STEPS: usize = 1000;

fn solve<const C: usize>(problem: &Problem, tolerance: f64) -> Option<Answer> {
    let [mut s, mut y, mut time, _] = problem.start();
    let mut equations = **problem;
    for steps in 1..MOST_STEPS {
        let (radius, speed) = series::<C>(&equations, s, y);
        // Both the last two coefficients have to be small at the end of the step.
        let reach = |order: usize| {
            let size = radius[order].abs().max(speed[order].abs());
            (tolerance / size).powf(1.0 / order as f64)
        };
        let mut step = reach(C - 2).min(reach(C - 1));
        let event = if equations.rebound { &radius } else { &speed };
        let ends = value(event, step) <= 0.0;
        if ends {
            step = zero(event, step);
        }
        time += step * value(&std::array::from_fn::<f64, C, _>(|k| 2.0 * radius[k] / (k + 1) as f64), step);
        (s, y) = (value(&radius, step), value(&speed, step));
        if ends && equations.rebound {
            return Some(Answer {
                impulse: None,
                effort: Some((steps, "series")),
                ..problem.answer([s, y, time, 0.0], None)
            });
        }
        if ends {
            (y, equations) = (0.0, equations.on_rebound());
        }
    }
    None
}

/// Coefficients of s and y.
fn series<const C: usize>(equations: &Equations, s: f64, y: f64) -> ([f64; C], [f64; C]) {
    let lost = if equations.rebound { equations.adhesion * equations.adhesion_damping } else { 0.0 };
    let (mut radius, mut speed, mut square) = ([0.0; C], [0.0; C], [0.0; C]);
    let (mut damped, mut pull) = ([0.0; C], [0.0; C]);
    (radius[0], speed[0]) = (s, y);
    for k in 0..C - 1 {
        square[k] = product(&radius, &radius, k);
        damped[k] = f64::from(u8::from(k == 0)) + equations.material_damping * speed[k];
        let elastic = equations.elastic * product(&square, &damped, k);
        pull[k] = if k == 0 { equations.adhesion } else { 0.0 } - lost * speed[k] - elastic;
        radius[k + 1] = speed[k] / (k + 1) as f64;
        speed[k + 1] = 2.0 * product(&square, &pull, k) / (k + 1) as f64;
    }
    (radius, speed)
}

/// Coefficient k of a product.
fn product<const C: usize>(a: &[f64; C], b: &[f64; C], k: usize) -> f64 {
    a[..=k].iter().zip(b[..=k].iter().rev()).map(|(a, b)| a * b).sum()
}

fn value<const C: usize>(series: &[f64; C], step: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, coefficient| sum * step + coefficient)
}

/// Zero between 0 and a step behind it, by Newton's method held between bounds.
fn zero<const C: usize>(series: &[f64; C], step: f64) -> f64 {
    let slope: [f64; C] = std::array::from_fn(|k| if k + 1 < C { (k + 1) as f64 * series[k + 1] } else { 0.0 });
    let (mut low, mut high, mut place) = (0.0, step, step);
    for _ in 0..30 {
        let next = place - value(series, place) / value(&slope, place);
        let next = if next > low && next < high { next } else { 0.5 * (low + high) };
        if (next - place).abs() <= 1e-16 * step {
            break;
        }
        place = next;
        if value(series, place) > 0.0 {
            low = place;
        } else {
            high = place;
        }
    }
    place
}
