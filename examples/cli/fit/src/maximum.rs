//! The maximum of a likelihood, by the method of scoring with the outer product of the rows' gradients (Berndt, Hall, Hall and
//! Hausman 1974), damped as by Levenberg and Marquardt, within bounds.

use nalgebra::{DMatrix, DVector};

use crate::law::{Coordinate, Law};
use crate::likelihood::Likelihood;
use crate::observation::Observation;

/// A maximum.
#[derive(Clone, Debug)]
pub struct Maximum {
    /// The parameters.
    pub values: Vec<f64>,
    /// Logarithm of the likelihood, with the prior.
    pub value: f64,
    /// Information: the outer products of the gradients.
    pub information: DMatrix<f64>,
}

impl Maximum {
    /// Covariance of the parameters that are not at a bound, or among `wanted`, and the indices of its rows.
    fn covariance(&self, wanted: &[usize], bounds: &[(f64, f64)]) -> Option<(DMatrix<f64>, Vec<usize>)> {
        let inside = |index: &usize| self.values[*index] > bounds[*index].0 && self.values[*index] < bounds[*index].1;
        let free: Vec<usize> = (0..self.values.len()).filter(|index| wanted.contains(index) || inside(index)).collect();
        // Scaled to unit diagonal, so that units do not matter; a small ridge keeps what the data do not determine finite.
        let scale: Vec<f64> = free.iter().map(|index| self.information[(*index, *index)].max(1e-300).sqrt()).collect();
        let scaled = DMatrix::from_fn(free.len(), free.len(), |i, j| {
            self.information[(free[i], free[j])] / (scale[i] * scale[j]) + if i == j { RIDGE } else { 0.0 }
        });
        let inverse = scaled.try_inverse()?;
        Some((DMatrix::from_fn(free.len(), free.len(), |i, j| inverse[(i, j)] / (scale[i] * scale[j])), free))
    }

    /// Standard error of a parameter.
    pub fn standard_error(&self, index: usize, bounds: &[(f64, f64)]) -> Option<f64> {
        let (covariance, free) = self.covariance(&[index], bounds)?;
        let place = free.iter().position(|other| *other == index)?;
        let error = covariance[(place, place)].max(0.0).sqrt();
        (error.is_finite() && error > 0.0).then_some(error)
    }

    /// Root (Cholesky) of the covariance of the first parameters.
    pub fn root_of_covariance(&self, count: usize, bounds: &[(f64, f64)]) -> Option<DMatrix<f64>> {
        let wanted: Vec<usize> = (0..count).collect();
        let (covariance, _) = self.covariance(&wanted, bounds)?;
        Some(covariance.view((0, 0), (count, count)).into_owned().cholesky()?.l())
    }
}

/// Ridge of the scaled information.
const RIDGE: f64 = 1e-9;

/// Fisher's information on the two parameters of a law at their true values, where errors are all of the scatter: the bound of Cramer
/// and Rao is its inverse. It is estimated from the rows themselves.
#[must_use]
pub fn information(observations: &[Observation], law: Law, adhesion: Coordinate, values: [f64; 2]) -> [[f64; 2]; 2] {
    let mut likelihood = Likelihood::new(observations, law);
    likelihood.set_parameters(adhesion, &[]);
    let units = likelihood.reference;
    let (mut before, mut after) = (vec![0.0; likelihood.len()], vec![0.0; likelihood.len()]);
    let values = match law {
        Law::SpeedRestitution => {
            [units / values[0], values[1] / if adhesion == Coordinate::Work { units * units } else { units }]
        }
        _ => values,
    };
    let mut gradient = |index: usize| {
        let mut at = values;
        let step = 1e-5 * values[index];
        at[index] -= step;
        likelihood.rows(&at, &mut before);
        at[index] += 2.0 * step;
        likelihood.rows(&at, &mut after);
        // By the relative change of the parameter, so that units do not matter.
        before.iter().zip(&after).map(|(before, after)| (after - before) / 2e-5).collect::<Vec<f64>>()
    };
    let gradients = [gradient(0), gradient(1)];
    std::array::from_fn(|i| std::array::from_fn(|j| gradients[i].iter().zip(&gradients[j]).map(|(a, b)| a * b).sum()))
}

/// Gain of the likelihood below which the search ends: intervals need it to a hundredth.
const LEAST_GAIN: f64 = 1e-4;

/// Most iterations, each with as many curves as parameters.
const MOST_ITERATIONS: u32 = 60;

/// Smallest and largest steps of a difference quotient, relative to the parameter.
const LEAST_STEP: f64 = 1e-7;
const LARGEST_STEP: f64 = 1e-3;

/// The maximum from `start`, with the parameter `fixed` left as it is. `None` if there is no likelihood at the start.
pub fn maximise(likelihood: &Likelihood, start: &[f64], fixed: Option<usize>) -> Option<Maximum> {
    let bounds = likelihood.bounds();
    let (count, parameters) = (likelihood.len(), start.len());
    let clamp = |values: &mut [f64]| {
        for (index, (value, (low, high))) in values.iter_mut().zip(&bounds).enumerate() {
            if fixed != Some(index) {
                *value = value.clamp(*low, *high);
            }
        }
    };
    let mut values = start.to_vec();
    clamp(&mut values);
    let (mut rows, mut moved) = (vec![0.0; count], vec![0.0; count]);
    let total = |values: &[f64], rows: &mut [f64]| {
        likelihood.rows(values, rows).then(|| rows.iter().sum::<f64>() + likelihood.prior(values))
    };
    let mut value = total(&values, &mut rows)?;
    let mut information = DMatrix::zeros(parameters, parameters);
    let mut damping = 1e-3;
    let mut steps: Vec<f64> =
        values.iter().zip(&bounds).map(|(v, (low, high))| 1e-4 * v.abs().max(1e-3 * (high - low).min(1.0))).collect();
    for _ in 0..MOST_ITERATIONS {
        let mut gradients = DMatrix::zeros(count, parameters);
        let mut score = DVector::zeros(parameters);
        for index in (0..parameters).filter(|index| fixed != Some(*index)) {
            // Away from the nearer bound.
            let (low, high) = bounds[index];
            let step = if values[index] - low > high - values[index] { -steps[index] } else { steps[index] };
            let mut at = values.clone();
            at[index] += step;
            if !likelihood.rows(&at, &mut moved) {
                continue;
            }
            for row in 0..count {
                gradients[(row, index)] = (moved[row] - rows[row]) / step;
            }
            score[index] = gradients.column(index).sum() + (likelihood.prior(&at) - likelihood.prior(&values)) / step;
        }
        information = gradients.transpose() * &gradients;
        for index in 0..parameters {
            information[(index, index)] += likelihood.prior_information(&values, index);
        }
        let free: Vec<usize> = (0..parameters)
            .filter(|index| {
                let (low, high) = bounds[*index];
                let outward =
                    (values[*index] <= low && score[*index] <= 0.0) || (values[*index] >= high && score[*index] >= 0.0);
                fixed != Some(*index) && !outward && information[(*index, *index)] > 0.0
            })
            .collect();
        for index in &free {
            let error = 1.0 / information[(*index, *index)].sqrt();
            let size = values[*index].abs().max(error);
            steps[*index] = (0.01 * error).clamp(LEAST_STEP * size, LARGEST_STEP * size);
        }
        let mut gained = None;
        for _ in 0..14 {
            let Some((next, promise)) = step(&information, &score, &free, damping, &values) else {
                damping = (damping * 10.0_f64).max(1e-3);
                continue;
            };
            let mut next = next;
            clamp(&mut next);
            if promise < 0.1 * LEAST_GAIN {
                gained = Some(0.0);
                break;
            }
            match total(&next, &mut moved) {
                Some(higher) if higher > value => {
                    gained = Some(higher - value);
                    (values, value) = (next, higher);
                    std::mem::swap(&mut rows, &mut moved);
                    damping = (damping * 0.2).max(1e-9);
                    break;
                }
                _ => damping *= 6.0,
            }
        }
        match gained {
            Some(gain) if gain > LEAST_GAIN => {}
            _ => break,
        }
    }
    Some(Maximum { values, value, information })
}

/// The values after a damped step, and the gain that the local parabola promises.
fn step(
    information: &DMatrix<f64>,
    score: &DVector<f64>,
    free: &[usize],
    damping: f64,
    values: &[f64],
) -> Option<(Vec<f64>, f64)> {
    let scale: Vec<f64> = free.iter().map(|index| information[(*index, *index)].sqrt()).collect();
    let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| {
        let entry = information[(free[i], free[j])] / (scale[i] * scale[j]);
        if i == j { entry + damping } else { entry }
    });
    let right = DVector::from_fn(free.len(), |i, _| score[free[i]] / scale[i]);
    let solved = matrix.cholesky()?.solve(&right);
    let mut next = values.to_vec();
    for (place, index) in free.iter().enumerate() {
        next[*index] += solved[place] / scale[place];
    }
    Some((next, 0.5 * solved.dot(&right)))
}
