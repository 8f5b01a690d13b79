//! The scenes over which errors, refusals and worst cases are stated, in one place for all measurements: planes and lines
//! through the space of scenes, random scenes, and the cases of the reference with mild damping.

use std::f64::consts::PI;
use std::iter;

use microimpact::contact::{Collocation, Contact, PaperScene};
use microimpact::{CriticalSpeed, Hertz, InputError, NormalMotion, ObliqueMotion, Real, Sphere, Stiffness};
use microimpact_scenes::table_1;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use crate::{Case, cases};

/// Density of all spheres of the grids, kg/m^3.
pub const DENSITY: f64 = 2600.0;

const FRICTION: f64 = 0.3;

/// An impact at 45 degrees, in SI units; every method and number type takes it over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// r
    pub radius: f64,
    /// K
    pub stiffness: f64,
    /// Along the normal, and as much along the surface.
    pub speed: f64,
    /// Damping of the materials.
    pub zeta_h: f64,
    /// Strength f0 of the ring.
    pub strength: f64,
    /// Damping of adhesion.
    pub zeta_a: f64,
}

impl Impact {
    /// Table 1 of the paper.
    pub const PAPER: Self = Self {
        radius: table_1::RADIUS_M,
        stiffness: table_1::STIFFNESS_PA,
        speed: table_1::APPROACH_M_S,
        zeta_h: table_1::MATERIAL_DAMPING,
        strength: table_1::RING_N_M,
        zeta_a: table_1::RING_DAMPING,
    };

    /// An impact with a ratio q of adhesion to inertia, (5/3) of the equilibrium indentation over that of Hertz's impact, and
    /// with the groups h and g of the damping.
    ///
    /// # Errors
    /// A value outside its range.
    pub fn of_groups(ratio: f64, material: f64, adhesion: f64) -> Result<Self, InputError> {
        let unit = Self { radius: 5e-6, stiffness: 1e10, speed: 1.0, zeta_h: 1.0, strength: 0.0, zeta_a: 1.0 };
        let sphere = Sphere::solid(unit.radius, DENSITY)?;
        let depth = Hertz::new(&sphere, Stiffness::new(unit.stiffness)?, &NormalMotion::new(unit.speed)?).indentation;
        let unit = Self { strength: 0.6 * ratio * depth * unit.stiffness / (2.0 * PI), ..unit };
        let groups = unit.scene::<f64>()?.groups(&unit.motion()?)?;
        Ok(Self { zeta_h: material / groups.material_damping, zeta_a: adhesion / groups.adhesion_damping, ..unit })
    }

    /// The impact that single precision sees.
    #[must_use]
    pub fn in_single_precision(&self) -> Self {
        let rounded = |value: f64| f64::from(value as f32);
        Self {
            radius: rounded(self.radius),
            stiffness: rounded(self.stiffness),
            speed: rounded(self.speed),
            zeta_h: rounded(self.zeta_h),
            strength: rounded(self.strength),
            zeta_a: rounded(self.zeta_a),
        }
    }

    /// The scene, with friction.
    ///
    /// # Errors
    /// A value outside its range.
    pub fn scene<T: Real>(&self) -> Result<PaperScene<T>, InputError> {
        let c = T::constant;
        Contact::hertz(Sphere::solid(c(self.radius), c(DENSITY))?, Stiffness::new(c(self.stiffness))?)
            .with_damping(c(self.zeta_h))?
            .with_ring(c(self.strength), c(self.zeta_a))?
            .with_friction(c(FRICTION))
    }

    /// The motion before the impact.
    ///
    /// # Errors
    /// A value outside its range.
    pub fn motion<T: Real>(&self) -> Result<ObliqueMotion<T>, InputError> {
        NormalMotion::new(T::constant(self.speed))?.with_tangential(T::constant(self.speed))
    }

    /// p, from 0 without adhesion to 1 where it dominates.
    pub fn adhesion_strength(&self) -> Option<f64> {
        let groups = self.scene::<f64>().ok()?.groups(&self.motion().ok()?).ok()?;
        // A and B over the same speed, where the elastic force is (5/4) s^3 and adhesion (3/4) p s.
        Some((groups.adhesion / 0.75) / (groups.elasticity / 1.25))
    }

    /// The stronger of both damping groups, h and g; `None` outside the range of the library.
    pub fn damping(&self) -> Option<f64> {
        let groups = self.scene::<f64>().ok()?.groups(&self.motion().ok()?).ok()?;
        Some(groups.material_damping.max(groups.adhesion_damping))
    }

    /// Mass, kg.
    pub fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3) * DENSITY
    }

    /// C of the damping (B4), s/m.
    pub fn damping_unit(&self) -> f64 {
        (self.mass() / (self.radius.powi(3) * self.stiffness * self.speed.sqrt())).powf(0.4)
    }

    /// Indentation at which the sphere can rest, m.
    pub fn equilibrium(&self) -> f64 {
        2.0 * PI * self.strength / self.stiffness
    }

    /// Energy of an indentation (B6), J.
    pub fn potential(&self, indentation: f64) -> f64 {
        let elastic = 0.4 * self.stiffness * indentation.powf(2.5);
        self.radius.sqrt() * (elastic - 4.0 / 3.0 * PI * self.strength * indentation.powf(1.5))
    }
}

/// A logarithmic axis of a plane.
pub struct Coordinate {
    /// In words.
    pub name: &'static str,
    /// In formulas.
    pub symbol: &'static str,
    /// 1 for a pure number.
    pub unit: &'static str,
    low: f64,
    high: f64,
}

impl Coordinate {
    const fn new([name, symbol, unit]: [&'static str; 3], low: f64, high: f64) -> Self {
        Self { name, symbol, unit, low, high }
    }

    /// So many values from end to end.
    pub fn values(&self, count: usize) -> Vec<f64> {
        let ratio = (self.high / self.low).ln() / (count.max(2) - 1) as f64;
        (0..count).map(|index| self.low * (ratio * index as f64).exp()).collect()
    }
}

/// A plane through the space of scenes.
pub struct Plane {
    /// In file names.
    pub name: &'static str,
    /// In tables and captions.
    pub title: &'static str,
    /// What the plane contains.
    pub text: &'static str,
    /// From left to right.
    pub x: Coordinate,
    /// From bottom to top.
    pub y: Coordinate,
    /// Whether all impacts rebound, or none, by the critical speed.
    pub rebounds: Option<bool>,
    /// The impact at a place; `None` where there is none.
    pub impact: fn(f64, f64) -> Option<Impact>,
}

const MATERIAL: [&str; 3] = ["damping of materials", "h", "1"];
const SPEED: [&str; 3] = ["speed", "v", "m/s"];
const ZETA_H: [&str; 3] = ["damping of materials", "ζ_H", "1"];

/// Damping of adhesion over that of the materials in the paper.
const ADHESION_OVER_MATERIAL: f64 = Impact::PAPER.zeta_a / Impact::PAPER.zeta_h;

/// q of the plane of the dampings: weak adhesion, so that part of the plane rebounds.
const WEAK: f64 = 0.1;

/// All planes.
pub const PLANES: [Plane; 6] = [
    Plane {
        name: "damping",
        title: "dampings h and g",
        text: "Damping h of the materials against damping g of adhesion, both in units of the largest speed of the \
               undamped motion, over eight decades. Adhesion is weak, q = 0.1.",
        x: Coordinate::new(MATERIAL, 1e-4, 1e4),
        y: Coordinate::new(["damping of adhesion", "g", "1"], 1e-4, 1e4),
        rebounds: None,
        impact: |material, adhesion| Impact::of_groups(WEAK, material, adhesion).ok(),
    },
    Plane {
        name: "adhesion",
        title: "adhesion q and damping h",
        text: "Adhesion against damping. The ratio q is (5/3) of the equilibrium indentation over the peak indentation of \
               Hertz's impact: adhesion is negligible at the left and dominates at the right. Its damping is half that \
               of the materials.",
        x: Coordinate::new(["adhesion over inertia", "q", "1"], 1e-4, 1e7),
        y: Coordinate::new(MATERIAL, 1e-4, 1e4),
        rebounds: None,
        impact: |ratio, material| Impact::of_groups(ratio, material, 0.5 * material).ok(),
    },
    Plane {
        name: "above-critical",
        title: "speeds above the critical speed",
        text: "The paper's sphere, at speeds from a billionth above the critical speed to a million times that speed. \
               zeta_H runs from 1e-4 to 1e4, zeta_A in proportion.",
        x: Coordinate::new(["speed over critical", "v/V_s - 1", "1"], 1e-9, 1e6),
        y: Coordinate::new(ZETA_H, 1e-4, 1e4),
        rebounds: Some(true),
        impact: beside_critical,
    },
    Plane {
        name: "below-critical",
        title: "speeds below the critical speed",
        text: "The same sphere, at speeds from a billionth below the critical speed to half of it.",
        x: Coordinate::new(["speed over critical", "1 - v/V_s", "1"], 1e-9, 0.5),
        y: Coordinate::new(ZETA_H, 1e-4, 1e4),
        rebounds: Some(false),
        impact: |distance, material| beside_critical(-distance, material),
    },
    Plane {
        name: "size",
        title: "radius and speed",
        text: "Spheres of the paper's materials from a nanometre to a centimetre, from 1e-9 to 1e4 m/s.",
        x: Coordinate::new(["radius", "r", "m"], 1e-9, 1e-2),
        y: Coordinate::new(SPEED, 1e-9, 1e4),
        rebounds: None,
        impact: |radius, speed| Some(Impact { radius, speed, ..Impact::PAPER }),
    },
    Plane {
        name: "stiffness",
        title: "stiffness and speed",
        text: "The paper's sphere on surfaces of any stiffness, from 1e-9 to 1e4 m/s.",
        x: Coordinate::new(["stiffness", "K", "Pa"], 1e3, 1e14),
        y: Coordinate::new(SPEED, 1e-9, 1e4),
        rebounds: None,
        impact: |stiffness, speed| Some(Impact { stiffness, speed, ..Impact::PAPER }),
    },
];

fn beside_critical(distance: f64, zeta_h: f64) -> Option<Impact> {
    let impact = Impact { zeta_h, zeta_a: ADHESION_OVER_MATERIAL * zeta_h, ..Impact::PAPER };
    Some(Impact { speed: critical_speed(&impact)? * (1.0 + distance), ..impact })
}

fn critical_speed(impact: &Impact) -> Option<f64> {
    let method = Collocation::<14, f64>::new(1e-13).ok()?;
    match impact.scene::<f64>().ok()?.critical_speed(&method).ok()? {
        CriticalSpeed::At(critical) => Some(critical),
        CriticalSpeed::AlwaysRebounds | CriticalSpeed::NeverRebounds => None,
    }
}

/// Numbers from 10^`low` to 10^`high` in equal ratios.
pub fn decades(low: i32, high: i32, in_each: u32) -> impl Iterator<Item = f64> {
    let step = f64::from(in_each).recip();
    (0..=(high - low).unsigned_abs() * in_each).map(move |index| 10_f64.powf(f64::from(low) + step * f64::from(index)))
}

/// Groups h of the damping of the materials, from next to none to a million.
pub fn dampings() -> impl Iterator<Item = f64> {
    decades(-4, 6, 20)
}

/// Random groups over all that fixed point holds: strength p of adhesion, and damping h of the materials and g of adhesion.
pub fn random_groups(seed: u64) -> impl Iterator<Item = [f64; 3]> {
    let mut random = StdRng::seed_from_u64(seed);
    iter::repeat_with(move || [0.999, 0.5, 0.5].map(|end| random.random_range(0.0..end)))
}

/// Random impacts over many decades of every input, and a tolerance from 1e-12 to 1e-3 for each.
pub fn random_impacts(seed: u64) -> impl Iterator<Item = (Impact, f64)> {
    let mut random = StdRng::seed_from_u64(seed);
    iter::repeat_with(move || {
        let mut decades = |from: f64, to: f64| 10_f64.powf(random.random_range(from..to));
        let (radius, stiffness, strength) = (decades(-9.0, -2.0), decades(3.0, 14.0), decades(-4.0, 5.0));
        let (zeta_h, zeta_a, speed) = (decades(-4.0, 4.0), decades(-4.0, 4.0), decades(-9.0, 4.0));
        (Impact { radius, stiffness, speed, zeta_h, strength, zeta_a }, decades(-12.0, -3.0))
    })
}

/// Random impacts with an adhesion over inertia q from 1e-3 to 1e3 and with groups h and g of the damping from 1e-6 to 30, as single
/// precision sees them. Every other one has a speed close to the critical one, down to a billionth of it above or below, if that is in its range.
pub fn impacts_of_random_groups(seed: u64) -> impl Iterator<Item = Impact> {
    let mut random = StdRng::seed_from_u64(seed);
    iter::repeat_with(move || {
        let mut decades = |from: f64, to: f64| 10_f64.powf(random.random_range(from..to));
        let (ratio, material, adhesion) = (decades(-3.0, 3.0), decades(-6.0, 1.5), decades(-6.0, 1.5));
        let (close, above): (bool, bool) = random.random();
        let distance = random.random_range(-9.0..0.0);
        let impact = Impact::of_groups(ratio, material, adhesion).ok()?;
        if !close {
            return Some(impact.in_single_precision());
        }
        let distance = 10_f64.powf(distance);
        let speed = critical_speed(&impact)? * if above { 1.0 + distance } else { 1.0 - 0.9 * distance };
        let impact = Impact { speed, ..impact }.in_single_precision();
        impact.motion::<f32>().is_ok().then_some(impact)
    })
    .flatten()
}

/// Largest group of the damping that fixed point holds.
const STRONGEST: f64 = 0.5;

/// The families of the reference that a method of fixed cost is meant for: those of the paper, of its figure 6, and random
/// scenes.
pub const MILD_FAMILIES: [&str; 3] = ["paper", "figure6", "random"];

/// Cases of those families.
pub fn mild_cases() -> impl Iterator<Item = Case> {
    cases().into_iter().filter(|case| MILD_FAMILIES.contains(&case.text("family")))
}

/// The rebounds among them whose damping fixed point holds.
pub fn mild_rebounds() -> impl Iterator<Item = Case> {
    let mild = |case: &Case| ["group_h", "group_g"].iter().all(|group| case.number(group) <= STRONGEST);
    mild_cases().filter(move |case| case.text("outcome") == "rebound" && mild(case))
}
