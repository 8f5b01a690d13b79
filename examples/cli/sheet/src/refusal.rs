//! What the library refuses, in terms of the table: the column, and the text of the cell.

use microimpact::{Fault, ImpactError, Parameter};

use crate::Row;

/// The columns that can give a parameter.
fn columns(parameter: Parameter) -> &'static [&'static str] {
    match parameter {
        Parameter::Radius => &["radius_m", "diameter_m"],
        Parameter::Density => &["density_kg_m3"],
        Parameter::GyrationRatio => &["gyration_ratio"],
        Parameter::Stiffness => &["stiffness_pa"],
        Parameter::ApproachSpeed => &["speed_normal_m_s"],
        Parameter::TangentialVelocity => &["speed_tangential_m_s", "speed_tangential_out_m_s"],
        Parameter::Spin | Parameter::PeripheralVelocity => &["spin_rad_s", "spin_out_rad_s"],
        Parameter::VelocityComponent => &["velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"],
        Parameter::NormalLength => &["normal_x", "normal_y", "normal_z"],
        Parameter::ReboundSpeed => &["rebound_speed_m_s"],
        Parameter::VelocityError => &["velocity_error_m_s"],
        Parameter::Restitution => &["restitution"],
        Parameter::RestitutionSpeed => &["restitution_speed_m_s"],
        Parameter::RestitutionPower => &["restitution_power"],
        Parameter::YieldSpeed => &["yield_speed_m_s"],
        Parameter::YieldPressure => &["yield_pressure_pa"],
        Parameter::AdhesionSpeed => &["adhesion_speed_m_s"],
        Parameter::AdhesionPower => &["adhesion_power"],
        Parameter::AdhesionCoefficient => &["adhesion_coefficient"],
        Parameter::WorkOfAdhesion => &["work_of_adhesion_j"],
        Parameter::Friction => &["friction"],
        Parameter::StiffnessRatio => &["stiffness_ratio"],
        Parameter::ImpulseRatio => &["impulse_ratio"],
        Parameter::RollingArm => &["rolling_arm_m"],
        Parameter::ExternalForce => &["external_force_n"],
        Parameter::MaterialDamping => &["zeta_h", "damping_value"],
        Parameter::RelaxationTime | Parameter::NominalRestitution => &["damping_value"],
        Parameter::AdhesionEnergy => &["work_of_adhesion_j_m2"],
        Parameter::AdhesionStrength => &["adhesion_n_m"],
        Parameter::AdhesionDamping => &["zeta_a"],
        Parameter::PeelingMoment => &["peeling_n_m"],
        _ => &[],
    }
}

impl Row<'_> {
    /// Why the library refuses this row. The text quotes the cell: the error holds its number only as f32, where 1e300 is
    /// infinite.
    pub fn reason(&self, error: impl Into<ImpactError>) -> String {
        let error = error.into();
        let message = error.to_string();
        let ImpactError::Input(input) = error else {
            return message;
        };
        // Of a vector no component is wrong by itself.
        if input.parameter == Parameter::NormalLength {
            return format!("{}: {message}", columns(input.parameter).join(", "));
        }
        if input.fault == Fault::Receding {
            let velocity = columns(Parameter::VelocityComponent).iter().copied();
            let given: Vec<_> = velocity.filter(|column| self.text(column).is_some()).collect();
            let given = if given.is_empty() { columns(input.parameter).to_vec() } else { given };
            return format!("{}: {message}", given.join(", "));
        }
        let read = |column: &&str| self.inputs.iter().any(|input| input.columns().contains(column));
        let given = columns(input.parameter).iter().copied().filter(read).filter_map(|column| {
            let number = self.number::<f64>(column).ok()??;
            Some((number.abs(), column, self.text(column)?))
        });
        // A range that two columns share is symmetric, so that the larger number is the one outside it.
        let largest = given.max_by(|(a, ..), (b, ..)| a.total_cmp(b));
        let (Some((_, column, text)), Some((_, demand))) = (largest, message.split_once(", but must ")) else {
            return message;
        };
        let name = input.parameter.name();
        if column == "diameter_m" {
            // The remedy for a radius in micrometres has the number of the radius.
            let range = demand.split_once(';').map_or(demand, |(range, _)| range);
            return format!("{column}: \"{text}\" is refused: half of it, the {name}, must {range}");
        }
        format!("{column}: \"{text}\" is refused: {name} must {demand}")
    }
}
