//! Scenes in SI units, and as 13 numbers.

use std::fmt;
use std::str::FromStr;

/// Names of the 13 numbers of a scene, in their order.
pub const INPUTS: [&str; 13] = [
    "radius",
    "density",
    "gyration ratio",
    "stiffness",
    "adhesion",
    "material damping",
    "adhesion damping",
    "friction",
    "peeling",
    "force",
    "speed",
    "tangential velocity",
    "spin",
];

/// An impact in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// r, m.
    pub radius: f64,
    /// Mean density, kg/m^3.
    pub density: f64,
    /// kappa = k^2/r^2.
    pub gyration_ratio: f64,
    /// K, Pa.
    pub stiffness: f64,
    /// f0, N/m.
    pub adhesion: f64,
    /// zeta_H
    pub material_damping: f64,
    /// zeta_A
    pub adhesion_damping: f64,
    /// f
    pub friction: f64,
    /// lambda, N m.
    pub peeling: f64,
    /// F, N, positive out of the surface.
    pub force: f64,
    /// Approach speed, m/s.
    pub speed: f64,
    /// v_t, m/s.
    pub tangential: f64,
    /// w, rad/s.
    pub spin: f64,
}

impl Scene {
    /// The scene of numbers in the order of [`INPUTS`].
    pub fn from_numbers(numbers: [f64; 13]) -> Self {
        let [radius, density, gyration_ratio, stiffness, adhesion, material_damping, adhesion_damping, ..] = numbers;
        let [.., friction, peeling, force, speed, tangential, spin] = numbers;
        Self {
            radius,
            density,
            gyration_ratio,
            stiffness,
            adhesion,
            material_damping,
            adhesion_damping,
            friction,
            peeling,
            force,
            speed,
            tangential,
            spin,
        }
    }

    /// The numbers in the order of [`INPUTS`].
    pub fn numbers(&self) -> [f64; 13] {
        [
            self.radius,
            self.density,
            self.gyration_ratio,
            self.stiffness,
            self.adhesion,
            self.material_damping,
            self.adhesion_damping,
            self.friction,
            self.peeling,
            self.force,
            self.speed,
            self.tangential,
            self.spin,
        ]
    }

    /// The scene of numbers that single precision holds.
    #[must_use]
    pub fn in_single_precision(&self) -> Self {
        Self::from_numbers(self.numbers().map(|number| f64::from(number as f32)))
    }
}

impl fmt::Display for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, number) in self.numbers().iter().enumerate() {
            let gap = if index == 0 { "" } else { " " };
            write!(f, "{gap}{number:e}")?;
        }
        Ok(())
    }
}

impl FromStr for Scene {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f64> = text
            .split_whitespace()
            .map(|word| word.parse().map_err(|_| format!("`{word}` is not a number")))
            .collect::<Result<_, _>>()?;
        let numbers = <[f64; 13]>::try_from(numbers);
        numbers.map(Self::from_numbers).map_err(|found| format!("{} numbers instead of 13", found.len()))
    }
}
