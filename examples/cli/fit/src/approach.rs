//! True approach speeds, given the measured ones.
//!
//! A measured speed u has a normal error. Where true speeds are more frequent on one side of u, the true speed is rather there: its
//! mean is u + s^2 (ln f)'(u), with the density f of measured speeds (Tweedie's formula; Efron 2011, J. Am. Stat. Assoc. 106:1602).
//! The density is estimated by a Poisson regression on counts (Lindsey's method).

use nalgebra::{Matrix3, Vector3};

/// Cells of the counts.
const CELLS: usize = 16;

/// Rounds of the regression, which converges in five.
const ROUNDS: usize = 25;

/// Derivative of the logarithm of the density of positive measured speeds, at each of them.
pub fn log_density_slopes(speeds: &[f64]) -> Vec<f64> {
    let logs: Vec<f64> = speeds.iter().map(|speed| speed.ln()).collect();
    let (low, high) = logs.iter().fold((f64::MAX, f64::MIN), |(low, high), log| (low.min(*log), high.max(*log)));
    let width = high - low;
    // Speeds within a tenth are one speed, whose density is not known.
    if width < 0.1 {
        return vec![0.0; speeds.len()];
    }
    let scaled = |log: f64| 2.0 * (log - low) / width - 1.0;
    let mut counts = [0.0; CELLS];
    for log in &logs {
        let cell = (0.5 * (scaled(*log) + 1.0) * CELLS as f64) as usize;
        counts[cell.min(CELLS - 1)] += 1.0;
    }
    let Some(coefficients) = regression(&counts) else {
        return vec![0.0; speeds.len()];
    };
    let slope = |(speed, log): (&f64, &f64)| {
        let by_log = (coefficients[1] + 2.0 * coefficients[2] * scaled(*log)) * 2.0 / width;
        // The density of speeds is that of logarithms over the speed.
        (by_log - 1.0) / speed
    };
    speeds.iter().zip(&logs).map(slope).collect()
}

/// Poisson regression of counts on 1, z, z^2, with z from -1 to 1.
fn regression(counts: &[f64; CELLS]) -> Option<Vector3<f64>> {
    let mean = counts.iter().sum::<f64>() / CELLS as f64;
    let mut beta = Vector3::new(mean.ln(), 0.0, 0.0);
    for _ in 0..ROUNDS {
        let (mut information, mut score) = (Matrix3::zeros(), Vector3::zeros());
        for (cell, count) in counts.iter().enumerate() {
            let z = (2.0 * cell as f64 + 1.0) / CELLS as f64 - 1.0;
            let x = Vector3::new(1.0, z, z * z);
            let expected = beta.dot(&x).exp();
            information += expected * x * x.transpose();
            score += (count - expected) * x;
        }
        // A weak prior keeps the density bounded where few speeds were measured.
        for index in 1..3 {
            information[(index, index)] += PRIOR;
            score[index] -= PRIOR * beta[index];
        }
        let step = information.cholesky()?.solve(&score);
        let size = step.amax();
        beta += step * (1.0_f64).min(2.0 / size.max(1e-12));
        if size < 1e-8 {
            break;
        }
    }
    beta.iter().all(|value| value.is_finite()).then_some(beta)
}

/// Precision of the prior on both coefficients: a standard deviation of ten.
const PRIOR: f64 = 0.01;

#[cfg(test)]
mod tests {
    use super::log_density_slopes;

    #[test]
    fn uniform_speeds_have_no_slope_and_logarithmic_ones_have_one_over_speed() {
        let uniform: Vec<f64> = (0..4000).map(|i| 2.0 + 10.0 * (f64::from(i) + 0.5) / 4000.0).collect();
        let logarithmic: Vec<f64> = (0..4000).map(|i| 2.0 * 6.0_f64.powf((f64::from(i) + 0.5) / 4000.0)).collect();
        for (speeds, power) in [(uniform, 0.0), (logarithmic, -1.0)] {
            for (speed, slope) in speeds.iter().zip(log_density_slopes(&speeds)) {
                assert!((slope * speed - power).abs() < 0.15, "{speed}: {}", slope * speed);
            }
        }
    }
}
