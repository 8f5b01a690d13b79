//! An impact in numbers that every method takes over, and the reference to compare its solution with.

use std::f64::consts::PI;

use microimpact::contact::{HystereticDamping, Ring, Contact};
use microimpact::{Coulomb, Hertz, InputError, NormalMotion, ObliqueMotion, Real, Sphere, Stiffness};
use microimpact_scenes::table_1;

/// A scene with all terms but a peeling moment and an external force.
pub(super) type Scene<T> = Simulation<T, HystereticDamping<T>, Ring<T>, Coulomb<T>>;

pub(super) const DENSITY: f64 = 2600.0;
const FRICTION: f64 = 0.3;

/// An oblique impact at 45 degrees, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Impact {
    pub(super) radius: f64,
    pub(super) stiffness: f64,
    /// Along the normal, and as much along the surface.
    pub(super) speed: f64,
    /// zeta_H.
    pub(super) material: f64,
    /// f0.
    pub(super) strength: f64,
    /// zeta_A.
    pub(super) adhesion: f64,
}

impl Impact {
    /// Table 1 of the paper.
    pub(super) const PAPER: Self = Self {
        radius: table_1::RADIUS_M,
        stiffness: table_1::STIFFNESS_PA,
        speed: table_1::APPROACH_M_S,
        material: table_1::MATERIAL_DAMPING,
        strength: table_1::RING_N_M,
        adhesion: table_1::RING_DAMPING,
    };

    /// An impact with a ratio q of adhesion to inertia, (5/3) of the equilibrium indentation over Hertz's, and with the
    /// groups h and g of the damping.
    pub(super) fn of_groups(ratio: f64, material: f64, adhesion: f64) -> Result<Self, InputError> {
        let unit = Self { radius: 5e-6, stiffness: 1e10, speed: 1.0, material: 1.0, strength: 0.0, adhesion: 1.0 };
        let sphere = Sphere::solid(unit.radius, DENSITY)?;
        let depth = Hertz::new(&sphere, Stiffness::new(unit.stiffness)?, &NormalMotion::new(unit.speed)?).indentation;
        let unit = Self { strength: 0.6 * ratio * depth * unit.stiffness / (2.0 * PI), ..unit };
        let groups = unit.scene::<f64>()?.groups(&unit.motion()?)?;
        Ok(Self { material: material / groups.material_damping, adhesion: adhesion / groups.adhesion_damping, ..unit })
    }

    /// The impact that single precision sees.
    pub(super) fn in_single_precision(&self) -> Self {
        let rounded = |value: f64| f64::from(value as f32);
        Self {
            radius: rounded(self.radius),
            stiffness: rounded(self.stiffness),
            speed: rounded(self.speed),
            material: rounded(self.material),
            strength: rounded(self.strength),
            adhesion: rounded(self.adhesion),
        }
    }

    pub(super) fn scene<T: Real>(&self) -> Result<Scene<T>, InputError> {
        let c = T::constant;
        Contact::hertz(Sphere::solid(c(self.radius), c(DENSITY))?, Stiffness::new(c(self.stiffness))?)
            .with_damping(c(self.material))?
            .with_ring(c(self.strength), c(self.adhesion))?
            .with_friction(c(FRICTION))
    }

    pub(super) fn motion<T: Real>(&self) -> Result<ObliqueMotion<T>, InputError> {
        NormalMotion::new(T::constant(self.speed))?.with_tangential(T::constant(self.speed))
    }

    /// p, from 0 without adhesion to 1 where it dominates.
    pub(super) fn adhesion_strength(&self) -> Option<f64> {
        let groups = self.scene::<f64>().ok()?.groups(&self.motion().ok()?).ok()?;
        // A and B over the same speed, where the elastic force is (5/4) s^3 and adhesion (3/4) p s.
        Some((groups.adhesion / 0.75) / (groups.elasticity / 1.25))
    }

    pub(super) fn mass(&self) -> f64 {
        4.0 / 3.0 * PI * self.radius.powi(3) * DENSITY
    }

    /// C of the damping (B4), s/m.
    pub(super) fn damping_unit(&self) -> f64 {
        (self.mass() / (self.radius.powi(3) * self.stiffness * self.speed.sqrt())).powf(0.4)
    }

    /// Indentation at which the sphere can rest, m.
    pub(super) fn equilibrium(&self) -> f64 {
        2.0 * PI * self.strength / self.stiffness
    }

    /// Energy of an indentation (B6), J.
    pub(super) fn potential(&self, indentation: f64) -> f64 {
        let elastic = 0.4 * self.stiffness * indentation.powf(2.5);
        self.radius.sqrt() * (elastic - 4.0 / 3.0 * PI * self.strength * indentation.powf(1.5))
    }
}
