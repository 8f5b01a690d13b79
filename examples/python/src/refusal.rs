//! Errors of inputs in the names of Python's arguments.

use microimpact::{InputError, Parameter};
use pyo3::PyErr;
use pyo3::exceptions::PyValueError;

/// The argument that gives a parameter, or those that together do.
pub(crate) fn keyword(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Radius => "radius",
        Parameter::Density => "density",
        Parameter::GyrationRatio => "gyration_ratio",
        Parameter::Stiffness => "stiffness",
        Parameter::ApproachSpeed => "speed_normal",
        Parameter::TangentialVelocity => "speed_tangential",
        Parameter::Spin | Parameter::PeripheralVelocity => "spin",
        Parameter::VelocityComponent => "velocity",
        Parameter::NormalLength => "normal",
        Parameter::Restitution => "restitution",
        Parameter::RestitutionSpeed => "restitution_speed",
        Parameter::RestitutionPower => "restitution_power",
        Parameter::YieldSpeed => "yield_speed",
        Parameter::AdhesionSpeed => "adhesion_speed",
        Parameter::AdhesionPower => "adhesion_power",
        Parameter::AdhesionCoefficient => "adhesion_coefficient",
        Parameter::WorkOfAdhesion | Parameter::AdhesionEnergy => "work_of_adhesion",
        Parameter::Friction => "friction",
        Parameter::StiffnessRatio => "stiffness_ratio",
        Parameter::RollingArm => "rolling_arm",
        Parameter::ExternalForce => "external_force",
        Parameter::MaterialDamping => "zeta_h",
        Parameter::RelaxationTime | Parameter::NominalRestitution => "damping_value",
        Parameter::AdhesionStrength => "adhesion",
        Parameter::AdhesionDamping => "zeta_a",
        Parameter::PeelingMoment => "peeling",
        Parameter::Tolerance => "tolerance",
        Parameter::Iterations => "iterations",
        Parameter::SpeedRatio => "speed_ratio",
        Parameter::DampingRatio => "stiffness, zeta_h, zeta_a, speed_normal",
        Parameter::AdhesionRatio => "stiffness, adhesion, work_of_adhesion, speed_normal",
        Parameter::ForceRatio => "stiffness, external_force, speed_normal",
        // Of the scene, and not of one argument.
        other => other.name(),
    }
}

/// The arguments that give the second of two spheres.
pub(crate) const OF_SECOND: [(Parameter, &str); 3] = [
    (Parameter::Radius, "radius_2"),
    (Parameter::Density, "density_2"),
    (Parameter::GyrationRatio, "gyration_ratio_2"),
];

/// What is wrong with an argument.
pub(crate) fn message_of(keyword: &str, error: InputError) -> String {
    if keyword == error.parameter.name() { error.to_string() } else { format!("{keyword}: {error}") }
}

/// What is wrong, after the name of the argument if there is one.
pub(crate) fn message(error: InputError) -> String {
    message_of(keyword(error.parameter), error)
}

/// The exception for an error of an input.
pub(crate) fn refused(error: InputError) -> PyErr {
    PyValueError::new_err(message(error))
}
