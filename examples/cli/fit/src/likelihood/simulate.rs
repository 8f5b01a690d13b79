//! Sets of rows as the likelihood describes them.

use fastrand::Rng;

use super::{Likelihood, Nuisance, OUTLIER_REACH, arrange};
use crate::scatter::deviate;

/// Draws until a sphere rebounds.
const MOST_DRAWS: u32 = 100;

/// Least approach speed that is drawn, in reference speeds.
const LEAST_SPEED: f64 = 1e-6;

impl Likelihood {
    /// The same spheres and speeds measured once more, if the curve of some parameters is true.
    pub fn simulated(&self, values: &[f64], random: &mut Rng) -> Option<Self> {
        let curve = self.curve(values)?;
        let (scatter, outlier) = (self.scatter(values), self.nuisance(values, Nuisance::Outlier));
        let mut data = self.data.clone();
        for datum in &mut data {
            let measured = *datum;
            let drawn = (0..MOST_DRAWS).find_map(|_| {
                let speed = measured.mean + self.approach_variance(&curve, &measured).sqrt() * deviate(random);
                let rebound = curve.rebound(speed, measured.size) + speed * scatter.draw(random);
                let rebound = if random.f64() < outlier { speed * OUTLIER_REACH * random.f64() } else { rebound };
                // Where captures are not recorded, only rebounds are seen.
                (speed > 0.0 && (rebound > 0.0 || self.captures > 0)).then_some((speed, rebound))
            });
            let Some((speed, rebound)) = drawn else {
                continue;
            };
            let error = measured.rebound.map_or(measured.variance, |(_, variance)| variance);
            datum.speed = (speed + measured.variance.sqrt() * deviate(random)).max(LEAST_SPEED);
            datum.rebound = (rebound > 0.0).then(|| (rebound + error.sqrt() * deviate(random), error));
        }
        arrange(&mut data);
        let captures = data.iter().filter(|datum| datum.rebound.is_none()).count();
        let mut simulated = Self {
            captures,
            straight: vec![None; data.len()],
            data,
            border: None,
            coordinates: self.coordinates.clone(),
            nuisances: self.nuisances.clone(),
            nodes: self.nodes.clone(),
            stop: self.stop.clone(),
            ..*self
        };
        simulated.keep_straight_rows(values);
        Some(simulated)
    }
}
