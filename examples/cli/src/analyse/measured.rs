//! One measured impact: its coefficients with their standard errors, and its class.

use microimpact::rigid::{Departure, EnergyLedger, infer, infer_assuming_rolling, infer_with_spins};
use microimpact::{
    ConstantRestitution, Dual, Impact, ImpactError, NormalMotion, Oblique, Parameter, Real, RestitutionLaw, Sphere,
    TangentialImpact,
};
use sheet::{Input, Row};

use super::verdict::{POSSIBLE, Verdict};
use crate::command::Number;
use crate::inputs::{
    DENSITY_INPUT, GYRATION_INPUT, POWER_INPUT, RESTITUTION_COLUMNS, SIZE_INPUT, radius, restitution_law,
};

/// Results with their derivatives by the six measured velocities: normal, tangential and peripheral, before and after.
pub type Inputs<T> = Dual<T, 6>;

/// A measured impact and what follows from it.
pub struct Measured<T: Real> {
    pub sphere: Sphere<Inputs<T>>,
    pub impact: Impact<Inputs<T>, TangentialImpact<Inputs<T>>>,
    pub verdict: Verdict,
    /// Measured rebound speed over the approach speed.
    restitution: Inputs<T>,
    before: [f64; 2],
    spin_is_measured: bool,
    /// Whether R is given, so that what the body and what adhesion took can be told apart.
    pub has_law: bool,
    errors: [T; 6],
}

/// The numbers of a measured impact.
pub const INPUTS: [Input; 13] = [
    SIZE_INPUT,
    DENSITY_INPUT,
    GYRATION_INPUT,
    Input::optional(&RESTITUTION_COLUMNS, "not known"),
    POWER_INPUT,
    Input::required(&["speed_normal_m_s"]),
    Input::optional(&["speed_tangential_m_s"], "0 m/s"),
    Input::optional(&["spin_rad_s"], "that of a sphere that rolls at separation"),
    Input::required(&["rebound_speed_m_s"]),
    Input::required(&["speed_tangential_out_m_s"]),
    Input::optional(&["spin_out_rad_s"], "that which friction alone gives"),
    Input::optional(&["velocity_error_m_s"], "0.01 m/s"),
    Input::further(&ERRORS),
];

/// Columns of the standard errors of single velocities: normal, tangential and spin, before and after.
const ERRORS: [&str; 6] = [
    "speed_normal_error_m_s",
    "speed_tangential_error_m_s",
    "spin_error_rad_s",
    "rebound_speed_error_m_s",
    "speed_tangential_out_error_m_s",
    "spin_out_error_rad_s",
];

/// Standard error of a velocity where the row names none, m/s.
const VELOCITY_ERROR: f64 = 0.01;

impl<T: Number> Measured<T> {
    /// The impact of a row.
    pub fn of(row: &Row<'_>) -> Result<Self, String> {
        let has_law = RESTITUTION_COLUMNS.iter().any(|column| row.text(column).is_some());
        let law = if has_law {
            restitution_law(row, Dual::fixed)?
        } else {
            // Whatever is lost along the normal is then lost to one of both.
            ConstantRestitution::new(Dual::fixed(T::ONE)).map_err(|error| row.reason(error))?.into()
        };
        let sphere = sphere(row)?;
        let radius = sphere.radius().value;
        let errors = errors(row, radius)?;
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
        let after = Departure {
            normal: possible(normal_out, law.restitution(normal) * normal, &errors),
            tangential: tangential_out,
        };
        // The slip after the impact is V_t (1 + 1/kappa) - v_t/kappa - r w.
        let inverse = T::ONE / sphere.gyration_ratio().value;
        let [_, tangential_error, turning_error, _, out_error, _] = errors;
        let terms = [(T::ONE + inverse) * out_error, inverse * tangential_error, turning_error];
        let slip_error = terms.into_iter().fold(T::ZERO, |sum, term| sum + term * term).sqrt();
        let tolerance = Dual::fixed(T::constant(POSSIBLE) * slip_error);
        let spinning = before.with_peripheral_velocity(turning).map_err(|error| row.reason(error))?;
        let impact = match (spin, spin_out) {
            (None, None) => infer_assuming_rolling(&sphere, &law, &before, &after),
            (None, Some(_)) => {
                return Err("spin_out_rad_s: not without spin_rad_s; give both or leave spin_out_rad_s empty".into());
            }
            (Some(_), None) => infer(&sphere, &law, &spinning, &after, tolerance),
            (Some(_), Some(_)) => {
                infer_with_spins(&sphere, &law, &spinning, &after, turning_out / sphere.radius(), tolerance)
            }
        }
        .map_err(|error| match error {
            ImpactError::ReboundExceedsRestitution if !has_law => {
                "rebound_speed_m_s: the sphere leaves faster than it came, by more than its errors explain; check both speeds".into()
            }
            error => row.reason(error),
        })?;
        let slip = impact.tangential.slip();
        let measured_slip = spin.map(|_| (slip.value.into(), slip.standard_error(&errors).into()));
        let slip_before = (tangential.value - turning.value).into();
        let verdict = Verdict::new((normal_out.value.into(), errors[3].into()), measured_slip, slip_before);
        let before = [spinning.tangential().value.into(), normal.value.into()];
        let (restitution, spin_is_measured) = (normal_out / normal, spin.is_some());
        Ok(Self { sphere, impact, verdict, restitution, before, spin_is_measured, has_law, errors })
    }

    /// Standard errors of the normal velocities before and after the impact, m/s.
    pub fn normal_errors(&self) -> (T, T) {
        (self.errors[0], self.errors[3])
    }

    /// Overall restitution e.
    pub fn restitution(&self) -> Inputs<T> {
        self.restitution
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
        (!self.spin_is_measured).then(|| self.impact.tangential.spin_before(&self.sphere).value)
    }

    /// Where the energy went.
    pub fn energy(&self) -> EnergyLedger<Inputs<T>> {
        self.impact.energy(&self.sphere)
    }
}

/// Standard errors of the six velocities, m/s: each from its own column, or that of all velocities.
fn errors<T: Number>(row: &Row<'_>, radius: T) -> Result<[T; 6], String> {
    let error = |column: &str| -> Result<Option<T>, String> {
        let check = |error: T| Parameter::StandardError.check(error).map_err(|error| format!("{column}: {error}"));
        row.number(column)?.map(check).transpose()
    };
    let mut errors = [error("velocity_error_m_s")?.unwrap_or(T::constant(VELOCITY_ERROR)); 6];
    for (velocity, column) in errors.iter_mut().zip(ERRORS) {
        if let Some(own) = error(column)? {
            *velocity = if column.ends_with("rad_s") { radius * own } else { own };
        }
    }
    Ok(errors)
}

/// The rebound speed that an impact can have, where the measured one differs from it by no more than its error explains: from zero to
/// that which the body's restitution allows.
fn possible<T: Number>(measured: Inputs<T>, largest: Inputs<T>, errors: &[T; 6]) -> Inputs<T> {
    let error = |speed: Inputs<T>| T::constant(POSSIBLE) * speed.standard_error(errors);
    if measured.value < T::ZERO && -measured.value <= error(measured) {
        Dual::fixed(T::ZERO)
    } else if measured.value > largest.value && measured.value - largest.value <= error(measured - largest) {
        largest
    } else {
        measured
    }
}

fn sphere<T: Number>(row: &Row<'_>) -> Result<Sphere<Inputs<T>>, String> {
    let radius = radius::<T>(row)?;
    let kappa = row.number("gyration_ratio")?.unwrap_or(T::constant(0.4));
    Sphere::new(Dual::fixed(radius), Dual::fixed(row.required("density_kg_m3")?), Dual::fixed(kappa))
        .map_err(|error| row.reason(error))
}
