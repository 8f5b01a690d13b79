//! How much of an error small changes of the inputs account for.

use truth::{Double, INPUTS, Scene, Truth, solve_changed};

use crate::output::{COUNT, Output};

/// Changes of the truth with its inputs.
#[derive(Clone, Debug)]
pub struct Allowance {
    /// Of each output, in its own unit; infinite where the outcome changes or the output ceases to exist.
    pub outputs: [f64; COUNT],
    /// Of the margin of the motion along the surface.
    pub slip: f64,
    /// Of the margin of the outcome.
    pub margin: f64,
}

/// Several roundings of an input, as a method makes them.
const ROUNDINGS: f64 = 4.0;

/// Places of the friction and of the approach speed among the numbers of a scene.
const FRICTION: usize = 7;
const SPEED: usize = 10;

impl Allowance {
    /// What the rounding of the inputs accounts for: each changes by one unit of the number type, and the changes of
    /// the truth are added.
    pub fn of_rounding(scene: &Scene, truth: &Truth, unit: f64, steps: u32) -> Self {
        let numbers = scene.numbers();
        let inputs = (0..INPUTS.len()).filter(|number| numbers[*number] != 0.0);
        Self::of_changes(scene, truth, inputs.map(|number| (number, unit)), ROUNDINGS, steps)
    }

    /// What a tolerance accounts for: the solution of a scene whose inputs are wrong by that much (its backward error).
    /// Close to the critical speed times change far more than energies, and so do the end of a slip close to separation
    /// and the peak of a sphere that nearly creeps.
    pub fn of_tolerance(scene: &Scene, truth: &Truth, tolerance: f64, steps: u32) -> Self {
        let numbers = scene.numbers();
        let inputs = (0..INPUTS.len()).filter(|number| numbers[*number] != 0.0);
        let upwards = inputs.map(|number| (number, tolerance));
        // Where an outcome or a slip ends on one side alone.
        let downwards = [(SPEED, -tolerance), (FRICTION, -tolerance)];
        Self::of_changes(scene, truth, upwards.chain(downwards), 1.0, steps)
    }

    fn of_changes(
        scene: &Scene,
        truth: &Truth,
        changes: impl Iterator<Item = (usize, f64)>,
        factor: f64,
        steps: u32,
    ) -> Self {
        let mut allowance = Self { outputs: [0.0; COUNT], slip: 0.0, margin: 0.0 };
        for (number, size) in changes {
            let changed = solve_changed(scene, number, size, steps);
            let same = changed.outcome == truth.outcome;
            for (sum, output) in allowance.outputs.iter_mut().zip(Output::ALL) {
                *sum += factor * change(output.of(truth), output.of(&changed), same);
            }
            allowance.margin += factor * change(truth.margin, changed.margin, true);
            allowance.slip += factor * change(truth.slip_margin, changed.slip_margin, same);
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
