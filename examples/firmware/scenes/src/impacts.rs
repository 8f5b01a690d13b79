//! The impacts that the firmware classifies and simulates: plain numbers in SI units.

use super::table_1::{APPROACH_M_S, SPIN_RAD_S};

/// A motion before the impact.
#[derive(Debug, Clone, Copy)]
pub struct Impact {
    /// One word to recognise it by.
    pub name: &'static str,
    /// Approach speed in m/s.
    pub approach_m_s: f64,
    /// Tangential velocity in m/s.
    pub tangential_m_s: f64,
    /// Spin in rad/s.
    pub spin_rad_s: f64,
}

impl Impact {
    const fn new(name: &'static str, approach_m_s: f64, tangential_m_s: f64, spin_rad_s: f64) -> Self {
        Self { name, approach_m_s, tangential_m_s, spin_rad_s }
    }

    /// Whether the sphere comes straight down without spin.
    pub fn is_normal(&self) -> bool {
        self.tangential_m_s == 0.0 && self.spin_rad_s == 0.0
    }
}

/// That of Brach & Dunn (1995), Table 1.
pub const TABLE_1: Impact = Impact::new("table-1", APPROACH_M_S, 0.0, SPIN_RAD_S);

/// Every way in which an impact can end, with some of them close to another class.
///
/// The names say what becomes of the sphere where adhesion is given by its work; where
/// it is given by a coefficient below one, every sphere rebounds.
pub static IMPACTS: [Impact; 9] = [
    Impact::new("straight", 2.8, 0.0, 0.0),
    TABLE_1,
    Impact::new("oblique", 2.8, 20.0, 0.0),
    Impact::new("just-slides", 2.8, 1.75, 0.0),
    Impact::new("backspin", 2.8, 1.0, -5.0e5),
    Impact::new("just-rebounds", 1.85, 0.0, 0.0),
    Impact::new("rests", 0.5, 0.0, 0.0),
    Impact::new("rolls-on", 1.75, 0.2, 0.0),
    Impact::new("slides-on", 1.0, 5.0, 0.0),
];

/// Impacts for the contact simulation, few because each takes long where numbers are computed in software: every
/// way in which a simulated impact can end, in some of them after an interval that did not converge.
pub static CONTACTS: [Impact; 6] = [
    Impact::new("straight", 2.8, 0.0, 0.0),
    Impact::new("just-rebounds", 1.5, 0.0, 0.0),
    Impact::new("rests", 0.5, 0.0, 0.0),
    TABLE_1,
    Impact::new("oblique", 2.8, 20.0, 0.0),
    Impact::new("slides-on", 0.5, 20.0, 0.0),
];
