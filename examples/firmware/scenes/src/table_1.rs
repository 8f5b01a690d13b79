//! Brach & Dunn (1995), Table 1, and the parameters with which its impact is simulated. Firmware and host compile this
//! file.

/// Radius r, m.
pub const RADIUS_M: f64 = 5.06e-6;
/// Density of glass, kg/m^3.
pub const DENSITY_KG_M3: f64 = 2600.0;
/// Approach speed, m/s.
pub const APPROACH_M_S: f64 = 2.8;
/// Spin before the impact, rad/s.
pub const SPIN_RAD_S: f64 = 1.46e5;
/// Friction coefficient f.
pub const FRICTION: f64 = 0.1;
/// Adhesion coefficient rho.
pub const ADHESION_COEFFICIENT: f64 = 0.237;
/// Overall restitution e.
pub const OVERALL_RESTITUTION: f64 = 0.746;
/// Speed k of the restitution law R = k/(k + v), m/s.
pub const RESTITUTION_SPEED_M_S: f64 = 130.0;
/// Work of adhesion W_A with which A34 gives that e, J.
pub const WORK_OF_ADHESION_J: f64 = 2.22e-12;
/// Hertz stiffness K, Pa.
pub const STIFFNESS_PA: f64 = 7.5e10;
/// Strength f0 of the ring, N/m.
pub const RING_N_M: f64 = 250.0;
/// zeta_H.
pub const MATERIAL_DAMPING: f64 = 10.5;
/// zeta_A: the paper prints 12.5, and its program halves it.
pub const RING_DAMPING: f64 = 6.25;
