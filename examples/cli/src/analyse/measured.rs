//! One measured impact: its coefficients with their standard errors, its class, and the confidence in the class.

use microimpact::rigid::{Departure, EnergyLedger, infer, infer_assuming_rolling, infer_with_spins};
use microimpact::{
    Classification, ContactClass, Dual, Impact, NormalMotion, Oblique, Outcome, Real, RigidBody, Sphere, SurfaceMotion,
    TangentialImpact,
};
use sheet::{Input, Row};

use crate::command::Number;
use crate::inputs::{
    DENSITY_INPUT, GYRATION_INPUT, POWER_INPUT, RESTITUTION_INPUT, SIZE_INPUT, radius, restitution_law,
};

/// Results with their derivatives by the six measured velocities: normal, tangential and peripheral, before and after.
pub type Inputs<T> = Dual<T, 6>;

/// A measured impact and what follows from it.
pub struct Measured<T: Real> {
    pub sphere: Sphere<Inputs<T>>,
    pub impact: Impact<Inputs<T>, TangentialImpact<Inputs<T>>>,
    pub classification: Classification<Inputs<T>, ContactClass<Inputs<T>>>,
    /// Probability that the class is right.
    pub confidence: T,
    before: [f64; 2],
    spin_measured: bool,
    errors: [T; 6],
}

/// The numbers of a measured impact.
pub const INPUTS: [Input; 12] = [
    SIZE_INPUT,
    DENSITY_INPUT,
    GYRATION_INPUT,
    RESTITUTION_INPUT,
    POWER_INPUT,
    Input::required(&["speed_normal_m_s"]),
    Input::optional(&["speed_tangential_m_s"], "0 m/s"),
    Input::optional(&["spin_rad_s"], "that of a sphere that rolls at separation"),
    Input::required(&["rebound_speed_m_s"]),
    Input::required(&["speed_tangential_out_m_s"]),
    Input::optional(&["spin_out_rad_s"], "that which friction alone gives"),
    Input::optional(&["velocity_error_m_s"], "0.01 m/s"),
];

/// Standard error of a velocity where the row names none, m/s.
const VELOCITY_ERROR: f64 = 0.01;

/// Standard errors within which a slip counts as none.
const ROLLING: f64 = 3.0;

impl<T: Number> Measured<T> {
    /// The impact of a row.
    pub fn of(row: &Row<'_>) -> Result<Self, String> {
        let law = restitution_law(row, Dual::fixed)?;
        let sphere = sphere(row)?;
        let radius = sphere.radius().value;
        let error = row.number("velocity_error_m_s")?.unwrap_or(T::constant(VELOCITY_ERROR));
        let (spin, spin_out) = (row.number::<T>("spin_rad_s")?, row.number::<T>("spin_out_rad_s")?);
        let peripheral = |spin: Option<T>| radius * spin.unwrap_or(T::ZERO);
        let [normal, tangential, turning, normal_out, tangential_out, turning_out] = Dual::variables([
            row.required("speed_normal_m_s")?,
            row.or_zero("speed_tangential_m_s")?,
            peripheral(spin),
            row.required("rebound_speed_m_s")?,
            row.required("speed_tangential_out_m_s")?,
            peripheral(spin_out),
        ]);
        let before = NormalMotion::new(normal)
            .and_then(|motion| motion.with_tangential(tangential))
            .map_err(|error| row.reason(error))?;
        let after = Departure { normal: normal_out, tangential: tangential_out };
        // The slip after the impact is V_t (1 + 1/kappa) - v_t/kappa - r w.
        let inverse = T::ONE / sphere.gyration_ratio().value;
        let slip_error = error * (T::constant(2.0) * (T::ONE + inverse + inverse * inverse)).sqrt();
        let tolerance = T::constant(ROLLING) * slip_error;
        let spinning = before.with_peripheral_velocity(turning).map_err(|error| row.reason(error))?;
        let impact = match (spin, spin_out) {
            (None, None) => infer_assuming_rolling(&sphere, &law, &before, &after),
            (None, Some(_)) => {
                return Err("spin_out_rad_s: not without spin_rad_s; give both or leave spin_out_rad_s empty".into());
            }
            (Some(_), None) => infer(&sphere, &law, &spinning, &after, Dual::fixed(tolerance)),
            (Some(_), Some(_)) => {
                let spin_out = turning_out / sphere.radius();
                infer_with_spins(&sphere, &law, &spinning, &after, spin_out, Dual::fixed(tolerance))
            }
        }
        .map_err(|error| row.reason(error))?;
        let errors = [error; 6];
        let classification = RigidBody::new(sphere, law).classify_impact(&impact);
        let mut confidence = T::ONE;
        if classification.outcome == Outcome::Rebound && error > T::ZERO {
            confidence = (normal_out.value / error).below();
        }
        let slip = impact.tangential.slip();
        let error = slip.standard_error(&errors);
        if error > T::ZERO {
            let rolls = ((tolerance - slip.value) / error).below() - ((-tolerance - slip.value) / error).below();
            let slides = classification.contact.motion == SurfaceMotion::Sliding;
            confidence = confidence * if slides { T::ONE - rolls } else { rolls };
        }
        let before = [spinning.tangential().value.into(), normal.value.into()];
        Ok(Self { sphere, impact, classification, confidence, before, spin_measured: spin.is_some(), errors })
    }

    /// Standard error of each velocity, m/s.
    pub fn velocity_error(&self) -> T {
        self.errors[0]
    }

    /// Overall restitution e.
    pub fn restitution(&self) -> Inputs<T> {
        self.impact.normal.overall_restitution()
    }

    /// Its standard error.
    pub fn restitution_error(&self) -> T {
        self.restitution().standard_error(&self.errors)
    }

    /// Impulse ratio mu.
    pub fn impulse_ratio(&self) -> Inputs<T> {
        self.impact.tangential.impulse_ratio()
    }

    /// Its standard error.
    pub fn impulse_ratio_error(&self) -> T {
        self.impulse_ratio().standard_error(&self.errors)
    }

    /// Angle between the surface and the path before the impact, degrees: 90 at normal incidence.
    pub fn incidence(&self) -> f64 {
        let [tangential, normal] = self.before;
        normal.atan2(tangential.abs()).to_degrees()
    }

    /// Tangential and normal approach velocity, m/s.
    pub fn velocities(&self) -> [f64; 2] {
        self.before
    }

    /// Spin before the impact that rolling at separation implies, rad/s, where it was not measured.
    pub fn implied_spin(&self) -> Option<T> {
        (!self.spin_measured).then(|| self.impact.tangential.spin_before(&self.sphere).value)
    }

    /// Where the energy went.
    pub fn energy(&self) -> EnergyLedger<Inputs<T>> {
        self.impact.energy(&self.sphere)
    }
}

fn sphere<T: Number>(row: &Row<'_>) -> Result<Sphere<Inputs<T>>, String> {
    let radius = radius::<T>(row)?;
    let kappa = row.number("gyration_ratio")?.unwrap_or(T::constant(0.4));
    Sphere::new(Dual::fixed(radius), Dual::fixed(row.required("density_kg_m3")?), Dual::fixed(kappa))
        .map_err(|error| row.reason(error))
}
