//! Measurements from which a device calibrates itself, and what it makes of them: one parameter of the contact of Brach &
//! Dunn (1995), Table 1, from one impact, and restitution law, adhesion and friction from a few.

use core::marker::PhantomData;

use microimpact::Stiffness;
use microimpact::contact::{Collocation, Method};
use microimpact::measure::{
    CalibrationError, Estimate, ImpulseRatios, MeasuredImpact, MeasuredRebound, NormalDistribution, RestitutionFit,
    adhesion_damping, friction, material_damping, parameter, ring_strength,
};

use super::contacts::{Setting, elastic, surface_of};
use super::scenes::{Number, given, sphere};
use super::table_1::{APPROACH_M_S, MATERIAL_DAMPING, OVERALL_RESTITUTION, RADIUS_M, RING_N_M, STIFFNESS_PA};

/// A calibration, with what was measured for it.
pub trait Calibration<T: Number>: Sized {
    /// Its name in tables.
    const NAME: &'static str;
    /// The parameters that it finds, each with its standard error where there is one.
    type Answer: AsRef<[T]>;

    /// What was measured, validated as far as that does not depend on the calibration.
    fn new() -> Option<Self>;
    /// The calibration itself.
    fn calibrate(&self) -> Result<Self::Answer, CalibrationError>;
}

/// A parameter that one rebound of the sphere gives.
pub trait OfOneRebound {
    /// Name of the calibration.
    const NAME: &'static str;
    /// Approach speed (m/s) and restitution.
    const MEASURED: (f64, f64);

    /// The parameter, to a relative tolerance.
    fn find<T: Number>(
        rebound: &MeasuredRebound<T>,
        method: &impl Method<T>,
        tolerance: T,
    ) -> Result<T, CalibrationError>;
}

/// A measured rebound of the sphere, and the method and the tolerance with which it is explained by the parameter `P`.
pub struct OneRebound<T, M, P> {
    rebound: MeasuredRebound<T>,
    method: M,
    tolerance: T,
    parameter: PhantomData<P>,
}

impl<T: Number, M: Tolerant + Method<T>, P: OfOneRebound> Calibration<T> for OneRebound<T, M, P> {
    const NAME: &'static str = P::NAME;
    type Answer = [T; 1];

    fn new() -> Option<Self> {
        let (speed, restitution) = P::MEASURED;
        let rebound = MeasuredRebound { speed: given(speed), restitution: given(restitution) };
        Some(Self { rebound, method: M::new()?, tolerance: given(M::TOLERANCE), parameter: PhantomData })
    }

    #[inline(always)]
    fn calibrate(&self) -> Result<[T; 1], CalibrationError> {
        Ok([P::find(&self.rebound, &self.method, self.tolerance)?])
    }
}

/// A method, and how exactly a parameter is to be found with it.
pub trait Tolerant: Setting {
    /// Relative tolerance of the parameter.
    const TOLERANCE: f64;
}

impl Tolerant for Collocation<7, f32> {
    const TOLERANCE: f64 = 1e-5;
}

impl Tolerant for Collocation<9, f64> {
    const TOLERANCE: f64 = 1e-9;
}

/// zeta_H from R, at a speed where adhesion hardly counts.
pub struct MaterialDamping;

impl OfOneRebound for MaterialDamping {
    const NAME: &'static str = "calibrate/material-damping";
    const MEASURED: (f64, f64) = (13.0, 0.909);

    #[inline(always)]
    fn find<T: Number>(
        rebound: &MeasuredRebound<T>,
        method: &impl Method<T>,
        tolerance: T,
    ) -> Result<T, CalibrationError> {
        material_damping(&elastic()?, method, rebound, tolerance)
    }
}

/// zeta_A from e of Table 1.
pub struct AdhesionDamping;

impl OfOneRebound for AdhesionDamping {
    const NAME: &'static str = "calibrate/adhesion-damping";
    const MEASURED: (f64, f64) = (APPROACH_M_S, OVERALL_RESTITUTION);

    #[inline(always)]
    fn find<T: Number>(
        rebound: &MeasuredRebound<T>,
        method: &impl Method<T>,
        tolerance: T,
    ) -> Result<T, CalibrationError> {
        let damped = elastic()?.with_damping(given(MATERIAL_DAMPING))?;
        adhesion_damping(&damped, given(RING_N_M), method, rebound, tolerance)
    }
}

/// The radius from e of Table 1, between 2 um and 20 um.
pub struct Radius;

impl OfOneRebound for Radius {
    const NAME: &'static str = "calibrate/radius";
    const MEASURED: (f64, f64) = (APPROACH_M_S, OVERALL_RESTITUTION);

    #[inline(always)]
    fn find<T: Number>(
        rebound: &MeasuredRebound<T>,
        method: &impl Method<T>,
        tolerance: T,
    ) -> Result<T, CalibrationError> {
        parameter((given(2e-6), given(20e-6)), surface_of, method, rebound, tolerance)
    }
}

/// f0 from the contact radius of a particle at rest, here 7 % of its own.
pub struct AdhesionStrength<T>(PhantomData<T>);

impl<T: Number> Calibration<T> for AdhesionStrength<T> {
    const NAME: &'static str = "calibrate/adhesion-strength";
    type Answer = [T; 1];

    fn new() -> Option<Self> {
        Some(Self(PhantomData))
    }

    #[inline(always)]
    fn calibrate(&self) -> Result<[T; 1], CalibrationError> {
        Ok([ring_strength(&sphere()?, Stiffness::new(given(STIFFNESS_PA))?, given(0.07 * RADIUS_M))?])
    }
}

/// k and W_A from approach and rebound speeds.
pub struct RestitutionLaw<T>([MeasuredImpact<T>; IMPACTS.len()]);

/// Approach and rebound speeds, m/s, with k = 130 m/s and W_A = 2.22e-12 J, two of them misread. Zero is a capture.
const IMPACTS: [(f64, f64); 16] = [
    (1.4, 0.0),
    (1.7, 0.0),
    (2.1, 1.06),
    (2.4, 1.56),
    (2.8, 2.10),
    (3.5, 2.91),
    (5.0, 4.48),
    (6.0, 2.40),
    (7.0, 6.40),
    (9.0, 8.23),
    (11.0, 9.98),
    (14.0, 12.52),
    (17.0, 14.96),
    (20.0, 17.25),
    (25.0, 24.75),
    (30.0, 24.31),
];

/// Standard error of each speed, m/s.
const SPEED_ERROR: f64 = 0.02;

impl<T: Number + NormalDistribution> Calibration<T> for RestitutionLaw<T> {
    const NAME: &'static str = "calibrate/restitution-law";
    type Answer = [T; 6];

    fn new() -> Option<Self> {
        let sphere = sphere().ok()?;
        let speed = |value: f64| Estimate { value: given(value), standard_error: given(SPEED_ERROR) };
        Some(Self(IMPACTS.map(|(approach, rebound)| {
            let rebound = (rebound > 0.0).then(|| speed(rebound));
            MeasuredImpact { sphere, approach: speed(approach), rebound }
        })))
    }

    #[inline(always)]
    fn calibrate(&self) -> Result<[T; 6], CalibrationError> {
        let fit = RestitutionFit::of(&self.0)?;
        let (k, work) = (fit.restitution_speed, fit.work_of_adhesion);
        Ok([k.value, k.low, k.high, work.value, work.low, work.high])
    }
}

/// The friction coefficient from impulse ratios mu, each with that which rolls.
pub struct Friction<T>([ImpulseRatios<T>; RATIOS.len()]);

/// |mu| = min(f, |mu_0|) with f = 0.1 and some noise, towards glancing incidence; one misread.
const RATIOS: [(f64, f64); 12] = [
    (-0.031, -0.03),
    (-0.058, -0.06),
    (-0.092, -0.09),
    (-0.101, -0.15),
    (-0.098, -0.20),
    (-0.103, -0.25),
    (-0.100, -0.30),
    (-0.250, -0.35),
    (-0.099, -0.40),
    (-0.104, -0.45),
    (-0.097, -0.50),
    (-0.102, -0.55),
];

impl<T: Number> Calibration<T> for Friction<T> {
    const NAME: &'static str = "calibrate/friction";
    type Answer = [T; 2];

    fn new() -> Option<Self> {
        Some(Self(
            RATIOS.map(|(measured, rolling)| ImpulseRatios { measured: given(measured), rolling: given(rolling) }),
        ))
    }

    #[inline(always)]
    fn calibrate(&self) -> Result<[T; 2], CalibrationError> {
        Ok(numbers(friction(&self.0)?.estimate))
    }
}

fn numbers<T>(Estimate { value, standard_error }: Estimate<T>) -> [T; 2] {
    [value, standard_error]
}

/// Work to do for every calibration and number type.
pub trait CalibrationVisitor {
    /// Does it for one of them.
    fn visit<T: Number, C: Calibration<T>>(&mut self);
}

/// Goes through all calibrations in single precision.
pub fn visit_calibrations(visitor: &mut impl CalibrationVisitor) {
    visit_calibrations_of::<f32, Collocation<7, f32>>(visitor);
}

/// The same in double precision.
pub fn visit_double_calibrations(visitor: &mut impl CalibrationVisitor) {
    visit_calibrations_of::<f64, Collocation<9, f64>>(visitor);
}

fn visit_calibrations_of<T: Number + NormalDistribution, M: Tolerant + Method<T>>(
    visitor: &mut impl CalibrationVisitor,
) {
    visitor.visit::<T, OneRebound<T, M, MaterialDamping>>();
    visitor.visit::<T, OneRebound<T, M, AdhesionDamping>>();
    visitor.visit::<T, AdhesionStrength<T>>();
    visitor.visit::<T, OneRebound<T, M, Radius>>();
    visitor.visit::<T, RestitutionLaw<T>>();
    visitor.visit::<T, Friction<T>>();
}
