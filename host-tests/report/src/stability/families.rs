//! The planes through the space of scenes that the maps show.

use microimpact::CriticalSpeed;
use microimpact::contact::Collocation;

use super::impact::Impact;

/// A logarithmic axis.
pub(super) struct Coordinate {
    pub(super) description: &'static str,
    low: f64,
    high: f64,
}

impl Coordinate {
    const fn new(description: &'static str, low: f64, high: f64) -> Self {
        Self { description, low, high }
    }

    /// So many values from end to end.
    pub(super) fn values(&self, count: usize) -> Vec<f64> {
        let ratio = (self.high / self.low).ln() / (count.max(2) - 1) as f64;
        (0..count).map(|index| self.low * (ratio * index as f64).exp()).collect()
    }
}

/// A plane.
pub(super) struct Family {
    /// In file names.
    pub(super) name: &'static str,
    /// In tables and captions.
    pub(super) title: &'static str,
    pub(super) text: &'static str,
    pub(super) x: Coordinate,
    pub(super) y: Coordinate,
    /// Whether all impacts rebound, or none, by the critical speed.
    pub(super) rebounds: Option<bool>,
    /// The impact at a place; `None` where there is none.
    pub(super) impact: fn(f64, f64) -> Option<Impact>,
}

const MATERIAL: &str = "damping h of the materials";

/// Damping of adhesion over that of the materials in the paper.
const ADHESION_OVER_MATERIAL: f64 = Impact::PAPER.adhesion / Impact::PAPER.material;

/// q of the map of the dampings: weak adhesion, so that part of the plane rebounds.
const WEAK: f64 = 0.1;

pub(super) const FAMILIES: [Family; 6] = [
    Family {
        name: "damping",
        title: "h and g",
        text: "Damping h of the materials against damping g of adhesion, both in units of the largest speed of the \
               undamped motion, over eight decades; adhesion is weak, q = 0.1.",
        x: Coordinate::new(MATERIAL, 1e-4, 1e4),
        y: Coordinate::new("damping g of adhesion", 1e-4, 1e4),
        rebounds: None,
        impact: |material, adhesion| Impact::of_groups(WEAK, material, adhesion).ok(),
    },
    Family {
        name: "adhesion",
        title: "q and h",
        text: "Adhesion from next to none to dominant, as the ratio q of (5/3) of the equilibrium indentation to the \
               peak indentation of Hertz's impact, against damping; that of adhesion is half that of the materials.",
        x: Coordinate::new("adhesion over inertia q", 1e-4, 1e7),
        y: Coordinate::new(MATERIAL, 1e-4, 1e4),
        rebounds: None,
        impact: |ratio, material| Impact::of_groups(ratio, material, 0.5 * material).ok(),
    },
    Family {
        name: "above-critical",
        title: "above the critical speed",
        text: "The paper's sphere from a billionth above the speed that separates capture from rebound to a million \
               times that speed, with damping of zeta_H from 1e-4 to 1e4 and zeta_A in proportion.",
        x: Coordinate::new("speed over critical speed, less 1", 1e-9, 1e6),
        y: Coordinate::new("zeta_H", 1e-4, 1e4),
        rebounds: Some(true),
        impact: beside_critical,
    },
    Family {
        name: "below-critical",
        title: "below the critical speed",
        text: "The same from a billionth below the critical speed to half of it.",
        x: Coordinate::new("1 less speed over critical speed", 1e-9, 0.5),
        y: Coordinate::new("zeta_H", 1e-4, 1e4),
        rebounds: Some(false),
        impact: |distance, material| beside_critical(-distance, material),
    },
    Family {
        name: "size",
        title: "radius and speed",
        text: "Spheres of the paper's materials from a nanometre to a centimetre, from 1e-9 to 1e4 m/s.",
        x: Coordinate::new("radius, m", 1e-9, 1e-2),
        y: Coordinate::new("speed, m/s", 1e-9, 1e4),
        rebounds: None,
        impact: |radius, speed| Some(Impact { radius, speed, ..Impact::PAPER }),
    },
    Family {
        name: "stiffness",
        title: "stiffness and speed",
        text: "The paper's sphere on surfaces of any stiffness, from 1e-9 to 1e4 m/s.",
        x: Coordinate::new("stiffness K, Pa", 1e3, 1e14),
        y: Coordinate::new("speed, m/s", 1e-9, 1e4),
        rebounds: None,
        impact: |stiffness, speed| Some(Impact { stiffness, speed, ..Impact::PAPER }),
    },
];

fn beside_critical(distance: f64, material: f64) -> Option<Impact> {
    let impact = Impact { material, adhesion: ADHESION_OVER_MATERIAL * material, ..Impact::PAPER };
    let method = Collocation::<14, f64>::new(1e-13).ok()?;
    match impact.scene::<f64>().ok()?.critical_speed(&method).ok()? {
        CriticalSpeed::At(critical) => Some(Impact { speed: critical * (1.0 + distance), ..impact }),
        CriticalSpeed::AlwaysRebounds | CriticalSpeed::NeverRebounds => None,
    }
}
