//! Synthetic measurements whose truth is known.

use impact_fit::{MeasuredSphere, Observation, Response};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal};

/// Density of the spheres, kg/m^3, and their mean diameter, m: silver-coated glass (Table 1 of the paper).
pub const DENSITY: f64 = 2600.0;
const DIAMETER: f64 = 1.012e-5;

/// Natural scatter of the restitution.
#[derive(Clone, Copy, Debug)]
pub enum Natural {
    None,
    /// Normal, with a standard deviation.
    Normal(f64),
    /// That of glass beads on acrylic.
    Glass,
}

/// What is simulated: R = k/(k + v) with a work of adhesion (A34), measured with errors.
#[derive(Clone, Copy, Debug)]
pub struct Configuration {
    pub name: &'static str,
    /// k, m/s.
    pub restitution_speed: f64,
    /// W_A, J.
    pub work: f64,
    /// Standard error of both speeds, m/s.
    pub error: f64,
    /// Range of the approach speeds, m/s, in which they are uniform.
    pub speeds: (f64, f64),
    /// Rows, or rebounds if the rows are drawn until there are as many.
    pub rows: usize,
    pub count_rebounds: bool,
    /// Relative standard deviation of the diameters, which are measured.
    pub diameters: f64,
    /// Fraction of the rebounds that are outliers.
    pub outliers: f64,
    pub natural: Natural,
}

const BASE: Configuration = Configuration {
    name: "base",
    restitution_speed: 130.0,
    work: 2.22e-12,
    error: 0.03,
    speeds: (1.4, 12.0),
    rows: 400,
    count_rebounds: false,
    diameters: 0.0,
    outliers: 0.0,
    natural: Natural::None,
};

/// All configurations.
pub const ALL: [Configuration; 11] = [
    BASE,
    Configuration { name: "error 0.01 m/s", error: 0.01, ..BASE },
    Configuration { name: "2.5 to 12 m/s", speeds: (2.5, 12.0), ..BASE },
    Configuration { name: "W_A a tenth, error 0.1", work: 2.22e-13, error: 0.1, speeds: (2.0, 12.0), ..BASE },
    Configuration { name: "diameters 10 +- 0.5 um", diameters: 0.05, ..BASE },
    Configuration { name: "12 rebounds", rows: 12, count_rebounds: true, ..BASE },
    Configuration { name: "50 rebounds", rows: 50, count_rebounds: true, ..BASE },
    Configuration { name: "10 % outliers", outliers: 0.1, ..BASE },
    Configuration { name: "half captured", speeds: (0.6, 3.0), ..BASE },
    Configuration { name: "scatter of glass", natural: Natural::Glass, ..BASE },
    Configuration { name: "normal scatter 0.02", natural: Natural::Normal(0.02), ..BASE },
];

/// Restitutions of glass beads on acrylic.
fn glass() -> Vec<f64> {
    let text = include_str!("../../data/glass_on_acrylic.csv");
    let mut values: Vec<f64> = text.lines().filter_map(|line| line.parse().ok()).collect();
    values.sort_by(f64::total_cmp);
    values
}

impl Configuration {
    fn mass(diameter: f64) -> f64 {
        std::f64::consts::PI / 6.0 * diameter.powi(3) * DENSITY
    }

    /// The critical speed of a sphere of some mass, m/s.
    pub fn critical_speed_of(&self, mass: f64) -> f64 {
        let without = (2.0 * self.work / mass).sqrt();
        self.restitution_speed * without / (self.restitution_speed - without)
    }

    /// A set of measurements.
    pub fn set(&self, seed: u64) -> Vec<Observation> {
        let mut random = StdRng::seed_from_u64(seed);
        let glass = glass();
        let median = 0.5 * (glass[(glass.len() - 1) / 2] + glass[glass.len() / 2]);
        let normal = |deviation: f64, random: &mut StdRng| {
            Normal::new(0.0, deviation).map_or(0.0, |distribution| distribution.sample(random))
        };
        let mut rows = Vec::new();
        let mut counted = 0;
        while counted < self.rows {
            let speed = random.random_range(self.speeds.0..self.speeds.1);
            let mass = Self::mass(DIAMETER * (1.0 + normal(self.diameters, &mut random)));
            let r = self.restitution_speed / (self.restitution_speed + speed);
            let square = r * r - 2.0 * self.work / (mass * speed * speed);
            let scatter = match self.natural {
                Natural::None => 0.0,
                Natural::Normal(deviation) => normal(deviation, &mut random),
                Natural::Glass => glass[random.random_range(0..glass.len())] - median,
            };
            let restitution = if square > 0.0 { square.sqrt() + scatter } else { 0.0 };
            let outlier = random.random_bool(self.outliers);
            let restitution = if outlier { random.random_range(0.0..1.0) } else { restitution };
            let measured = speed + normal(self.error, &mut random);
            let response = if restitution > 0.0 {
                let speed = restitution * speed + normal(self.error, &mut random);
                Response::Rebound { speed, error: self.error }
            } else {
                Response::Capture
            };
            counted += usize::from(!self.count_rebounds || restitution > 0.0);
            let sphere = Some(MeasuredSphere { mass, relative_error: 0.0 });
            rows.push(Observation { speed: measured, speed_error: self.error, response, sphere });
        }
        rows
    }
}
