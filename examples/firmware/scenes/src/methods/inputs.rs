//! The inputs of an impact, as plain numbers in SI units.

use microimpact::contact::{Contact, PaperScene, RingScene};
use microimpact::{InputError, NormalMotion, PlanarMotion, Real, Sphere, Stiffness};

use crate::table_1::{
    APPROACH_M_S, DENSITY_KG_M3, FRICTION, MATERIAL_DAMPING, RADIUS_M, RING_DAMPING, RING_N_M, STIFFNESS_PA,
};

/// Sphere, surface and motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs {
    /// r, m.
    pub radius: f64,
    /// kg/m^3.
    pub density: f64,
    /// K, Pa.
    pub stiffness: f64,
    /// f0, N/m.
    pub ring: f64,
    /// zeta_H.
    pub material_damping: f64,
    /// zeta_A.
    pub ring_damping: f64,
    /// f.
    pub friction: f64,
    /// m/s.
    pub approach: f64,
    /// v_t, m/s.
    pub tangential: f64,
    /// w, rad/s.
    pub spin: f64,
}

/// The impact of Table 1, with the spin of the reference solution.
pub const TABLE_1: Inputs = Inputs {
    radius: RADIUS_M,
    density: DENSITY_KG_M3,
    stiffness: STIFFNESS_PA,
    ring: RING_N_M,
    material_damping: MATERIAL_DAMPING,
    ring_damping: RING_DAMPING,
    friction: FRICTION,
    approach: APPROACH_M_S,
    tangential: 0.0,
    spin: 1.454e5,
};

impl Inputs {
    /// The scene along the normal and its motion.
    ///
    /// # Errors
    /// A value outside its range.
    pub fn normal<T: Real>(&self) -> Result<(RingScene<T>, NormalMotion<T>), InputError> {
        let sphere = Sphere::solid(T::constant(self.radius), T::constant(self.density))?;
        let scene = Contact::hertz(sphere, Stiffness::new(T::constant(self.stiffness))?)
            .with_damping(T::constant(self.material_damping))?
            .with_ring(T::constant(self.ring), T::constant(self.ring_damping))?;
        Ok((scene, NormalMotion::new(T::constant(self.approach))?))
    }

    /// The scene with friction and its motion.
    ///
    /// # Errors
    /// A value outside its range.
    pub fn oblique<T: Real>(&self) -> Result<(PaperScene<T>, PlanarMotion<T>), InputError> {
        let (scene, motion) = self.normal()?;
        let motion =
            motion.with_tangential(T::constant(self.tangential))?.with_spin(scene.sphere(), T::constant(self.spin))?;
        Ok((scene.with_friction(T::constant(self.friction))?, motion))
    }
}
