//! How much of an error the inputs account for, because a number type rounds them.

use truth::{Double, INPUTS, Scene, Truth, solve_changed};

use crate::output::{COUNT, Output};

/// Changes of the truth when each input changes by one unit of the number type, added over the inputs.
#[derive(Clone, Debug)]
pub struct Allowance {
    /// Of each output, in its own unit; infinite where it ceases to exist.
    pub outputs: [f64; COUNT],
    /// Of the margin of the motion along the surface.
    pub slip: f64,
}

/// Several roundings of an input, as a method makes them.
const ROUNDINGS: f64 = 4.0;

impl Allowance {
    /// Of a scene with its truth for a unit.
    pub fn new(scene: &Scene, truth: &Truth, unit: f64, steps: u32) -> Self {
        let mut allowance = Self { outputs: [0.0; COUNT], slip: 0.0 };
        let numbers = scene.numbers();
        for number in (0..INPUTS.len()).filter(|number| numbers[*number] != 0.0) {
            let changed = solve_changed(scene, number, unit, steps);
            let same = changed.outcome == truth.outcome;
            for (sum, output) in allowance.outputs.iter_mut().zip(Output::ALL) {
                *sum += ROUNDINGS * change(output.of(truth), output.of(&changed), same);
            }
            allowance.slip += ROUNDINGS * change(truth.slip_margin, changed.slip_margin, same);
        }
        allowance
    }
}

fn change(before: Option<Double>, after: Option<Double>, same_outcome: bool) -> f64 {
    match (before, after) {
        (Some(before), Some(after)) if same_outcome => (after - before).to_f64().abs(),
        (None, None) => 0.0,
        _ => f64::INFINITY,
    }
}
