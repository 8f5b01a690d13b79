//! What can be wrong with an input, and the range each input must lie in.

use core::fmt;

use crate::Real;

/// A quantity that a caller supplies, with its unit and its valid range.
///
/// The range is one both number types can carry through every formula without overflow, and wide enough for
/// particles from a nanometre to centimetres.
///
/// ```
/// use microimpact::Parameter;
///
/// assert_eq!(Parameter::Radius.name(), "radius");
/// assert_eq!(Parameter::Radius.unit(), "m");
/// assert_eq!(Parameter::Radius.range(), (1e-10, 1.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Parameter {
    /// Outer radius r of a sphere, m.
    Radius,
    /// Contact radius of a resting sphere over its radius.
    ContactRadiusRatio,
    /// Wall of a hollow sphere or coating of a coated one, m; at most the radius.
    Thickness,
    /// Density of a material, kg/m^3.
    Density,
    /// kappa = k^2/r^2, the squared radius of gyration over the squared radius.
    GyrationRatio,
    /// Young's modulus E, Pa.
    YoungsModulus,
    /// Poisson's ratio nu.
    PoissonRatio,
    /// Hertz stiffness K (B2), Pa.
    Stiffness,
    /// Size of the normal velocity before the impact, m/s. Zero or less is a particle that does not approach.
    ApproachSpeed,
    /// Tangential velocity, m/s.
    TangentialVelocity,
    /// Spin, rad/s.
    Spin,
    /// Spin times radius: the velocity at which the sphere's surface turns, m/s.
    PeripheralVelocity,
    /// Normal velocity after the impact, m/s. Below zero the particle would have passed through the surface.
    ReboundSpeed,
    /// Standard error of the measured velocities, m/s.
    VelocityError,
    /// Standard error of any input, in its own unit.
    StandardError,
    /// Kinetic restitution R, without adhesion.
    Restitution,
    /// Speed k of the restitution law R = k/(k + v), m/s.
    RestitutionSpeed,
    /// Adhesion coefficient rho.
    AdhesionCoefficient,
    /// Work of adhesion W_A, J.
    WorkOfAdhesion,
    /// Coulomb's coefficient f.
    Friction,
    /// Impulse ratio mu.
    ImpulseRatio,
    /// Rolling-dissipation coefficient times its moment arm, mu_m a_c, m.
    RollingArm,
    /// Impulse of an external force during one phase of the impact, N s.
    ExternalImpulse,
    /// Change of velocity that an external impulse makes, m/s.
    VelocityChange,
    /// Constant external force, N.
    ExternalForce,
    /// Duration of a contact, s.
    Duration,
    /// Strength zeta_H of the damping in the materials.
    MaterialDamping,
    /// Strength f0 of the adhesion ring, N/m.
    AdhesionStrength,
    /// Strength zeta_A of the damping of adhesion.
    AdhesionDamping,
    /// Strength lambda of the peeling moment, N m.
    PeelingMoment,
    /// Tolerance of a simulation.
    Tolerance,
    /// Sweeps of a method of fixed cost for each phase.
    Sweeps,
    /// Energy of a captured sphere at rest, above the bottom of the well, over the depth of the well.
    RestEnergy,
    /// Turning points up to which a captured sphere is followed.
    TurningPoints,
    /// (5/3) of the equilibrium indentation over the peak indentation of Hertz's impact: adhesion against inertia.
    AdhesionRatio,
    /// External force over elastic force at the peak indentation, times 5/4.
    ForceRatio,
    /// Damping c_H U or c_A U: what the largest speed U of the undamped motion adds to a force, over that force.
    DampingRatio,
    /// Critical speed in a table, m/s. Too small where every speed rebounds, too large where none does.
    CriticalSpeed,
    /// Relative margin of a boundary table.
    BoundaryMargin,
    /// Largest speed of a restitution table over the critical speed.
    SpeedRatio,
    /// Elastic impulse over the momentum before the impact, I/(m v).
    ImpulseOverMomentum,
    /// Strength p of adhesion, given as such or for fixed point.
    DimensionlessAdhesion,
    /// Damping for the unit of speed, given as such or for fixed point.
    DimensionlessDamping,
    /// Unit of speed for fixed point, m/s.
    SpeedUnit,
    /// Approach speed over the unit of speed, for fixed point.
    SpeedInUnits,
    /// Any other velocity over the unit of speed, for fixed point; of a work of adhesion the rebound that it takes.
    VelocityInUnits,
    /// Speed k of the restitution law over the unit of speed, for fixed point.
    RestitutionSpeedInUnits,
    /// Coulomb's coefficient for fixed point.
    FixedPointFriction,
}

impl Parameter {
    /// All of them.
    ///
    /// ```
    /// use microimpact::Parameter;
    ///
    /// assert!(Parameter::ALL.iter().all(|parameter| parameter.range().0 < parameter.range().1));
    /// ```
    pub const ALL: [Self; 48] = [
        Self::Radius,
        Self::ContactRadiusRatio,
        Self::Thickness,
        Self::Density,
        Self::GyrationRatio,
        Self::YoungsModulus,
        Self::PoissonRatio,
        Self::Stiffness,
        Self::ApproachSpeed,
        Self::TangentialVelocity,
        Self::Spin,
        Self::PeripheralVelocity,
        Self::ReboundSpeed,
        Self::VelocityError,
        Self::StandardError,
        Self::Restitution,
        Self::RestitutionSpeed,
        Self::AdhesionCoefficient,
        Self::WorkOfAdhesion,
        Self::Friction,
        Self::ImpulseRatio,
        Self::RollingArm,
        Self::ExternalImpulse,
        Self::VelocityChange,
        Self::ExternalForce,
        Self::Duration,
        Self::MaterialDamping,
        Self::AdhesionStrength,
        Self::AdhesionDamping,
        Self::PeelingMoment,
        Self::Tolerance,
        Self::Sweeps,
        Self::RestEnergy,
        Self::TurningPoints,
        Self::AdhesionRatio,
        Self::ForceRatio,
        Self::DampingRatio,
        Self::CriticalSpeed,
        Self::BoundaryMargin,
        Self::SpeedRatio,
        Self::ImpulseOverMomentum,
        Self::DimensionlessAdhesion,
        Self::DimensionlessDamping,
        Self::SpeedUnit,
        Self::SpeedInUnits,
        Self::VelocityInUnits,
        Self::RestitutionSpeedInUnits,
        Self::FixedPointFriction,
    ];

    /// Name, in the words of the field.
    ///
    /// ```
    /// assert_eq!(microimpact::Parameter::Friction.name(), "friction coefficient");
    /// ```
    pub const fn name(self) -> &'static str {
        self.describe().0
    }

    /// Unit; "1" where the quantity is a ratio.
    ///
    /// ```
    /// assert_eq!(microimpact::Parameter::Stiffness.unit(), "Pa");
    /// ```
    pub const fn unit(self) -> &'static str {
        self.describe().1
    }

    /// Smallest and largest valid value, both included.
    ///
    /// ```
    /// assert_eq!(microimpact::Parameter::Restitution.range(), (0.0, 1.0));
    /// ```
    pub const fn range(self) -> (f64, f64) {
        self.describe().2
    }

    const fn describe(self) -> (&'static str, &'static str, (f64, f64)) {
        match self {
            Self::Radius => ("radius", "m", (1e-10, 1.0)),
            Self::ContactRadiusRatio => ("contact radius over radius", "1", (0.0, 1.0)),
            Self::Thickness => ("thickness", "m", (1e-12, 1.0)),
            Self::Density => ("density", "kg/m^3", (1e-2, 1e6)),
            Self::GyrationRatio => ("gyration ratio", "1", (1e-3, 1.0)),
            Self::YoungsModulus => ("Young's modulus", "Pa", (1.0, 1e16)),
            Self::PoissonRatio => ("Poisson's ratio", "1", (-0.999, 0.5)),
            Self::Stiffness => ("stiffness", "Pa", (1.0, 1e16)),
            Self::ApproachSpeed => ("approach speed", "m/s", (1e-12, 1e6)),
            Self::TangentialVelocity => ("tangential velocity", "m/s", (-1e7, 1e7)),
            Self::Spin => ("spin", "rad/s", (-1e17, 1e17)),
            Self::PeripheralVelocity => ("peripheral velocity", "m/s", (-1e7, 1e7)),
            Self::ReboundSpeed => ("rebound speed", "m/s", (0.0, 1e6)),
            Self::VelocityError => ("velocity error", "m/s", (0.0, 1e6)),
            Self::StandardError => ("standard error", "in the unit of its quantity", (0.0, 1e30)),
            Self::Restitution => ("restitution", "1", (0.0, 1.0)),
            Self::RestitutionSpeed => ("restitution speed", "m/s", (1e-6, 1e12)),
            Self::AdhesionCoefficient => ("adhesion coefficient", "1", (0.0, 1.0)),
            Self::WorkOfAdhesion => ("work of adhesion", "J", (0.0, 1e6)),
            Self::Friction => ("friction coefficient", "1", (0.0, 1e3)),
            Self::ImpulseRatio => ("impulse ratio", "1", (-1e3, 1e3)),
            Self::RollingArm => ("rolling-dissipation arm", "m", (0.0, 1.0)),
            Self::ExternalImpulse => ("external impulse", "N s", (-1e6, 1e6)),
            Self::VelocityChange => ("velocity change by an external impulse", "m/s", (-1e7, 1e7)),
            Self::ExternalForce => ("external force", "N", (-1e6, 1e6)),
            Self::Duration => ("duration", "s", (0.0, 1.0)),
            Self::MaterialDamping => ("material damping", "1", (0.0, 1e9)),
            Self::AdhesionStrength => ("adhesion strength", "N/m", (0.0, 1e9)),
            Self::AdhesionDamping => ("adhesion damping", "1", (0.0, 1e9)),
            Self::PeelingMoment => ("peeling moment", "N m", (0.0, 1e3)),
            Self::Tolerance => ("tolerance", "1", (1e-13, 1e-2)),
            Self::Sweeps => ("number of sweeps", "1", (1.0, 40.0)),
            Self::RestEnergy => ("energy at rest over depth of the well", "1", (1e-12, 0.5)),
            Self::TurningPoints => ("number of turning points", "1", (1.0, 1e5)),
            Self::AdhesionRatio => ("adhesion over inertia", "1", (0.0, 1e10)),
            Self::ForceRatio => ("external force over elasticity", "1", (-1e6, 1e6)),
            Self::DampingRatio => ("damping over elasticity", "1", (0.0, 1e9)),
            Self::CriticalSpeed => ("critical speed", "m/s", (1e-12, 1e6)),
            Self::BoundaryMargin => ("margin of a boundary table", "1", (0.0, 0.05)),
            Self::ImpulseOverMomentum => ("elastic impulse over momentum", "1", (0.0, 1e6)),
            Self::DimensionlessAdhesion => ("dimensionless strength of adhesion", "1", (0.0, 0.999)),
            Self::DimensionlessDamping => ("dimensionless damping", "1", (0.0, 0.5)),
            Self::SpeedUnit => ("unit of speed", "m/s", (1e-12, 1e6)),
            Self::SpeedInUnits => ("approach speed over the unit of speed", "1", (0.004, 8.0)),
            Self::VelocityInUnits => ("velocity over the unit of speed", "1", (-8.0, 8.0)),
            Self::RestitutionSpeedInUnits => ("restitution speed over the unit of speed", "1", (0.01, 100.0)),
            Self::FixedPointFriction => ("friction coefficient in fixed point", "1", (0.0, 7.0)),
            Self::SpeedRatio => ("largest over critical speed", "1", (1.1, 1e4)),
        }
    }

    /// The value itself when it lies in the parameter's range.
    ///
    /// # Errors
    /// [`InputError`] naming the parameter when the value is not a number or outside the range.
    ///
    /// ```
    /// use microimpact::{Fault, Parameter};
    ///
    /// assert_eq!(Parameter::Density.check(2600.0), Ok(2600.0));
    /// assert_eq!(Parameter::Density.check(f64::NAN).unwrap_err().fault, Fault::NotFinite);
    /// assert_eq!(Parameter::Density.check(0.0).unwrap_err().fault, Fault::TooSmall);
    /// ```
    #[inline]
    pub fn check<T: Real>(self, value: T) -> Result<T, InputError> {
        let (smallest, largest) = self.range();
        // A number type that has no number as small as the range begins with would take zero for valid.
        let held = smallest <= 0.0 || T::constant(smallest) > T::ZERO;
        // Both comparisons fail for NaN.
        if held && value >= T::constant(smallest) && value <= T::constant(largest) {
            Ok(value)
        } else {
            Err(self.refuse(value, T::constant(smallest)))
        }
    }

    #[cold]
    fn refuse<T: Real>(self, value: T, smallest: T) -> InputError {
        let fault = if !value.is_finite() {
            Fault::NotFinite
        } else if value < smallest {
            Fault::TooSmall
        } else {
            Fault::TooLarge
        };
        InputError { parameter: self, fault }
    }
}

/// How a value misses its range.
///
/// ```
/// use microimpact::{ConstantRestitution, Fault};
///
/// assert_eq!(ConstantRestitution::new(1.5).unwrap_err().fault, Fault::TooLarge);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Fault {
    /// NaN or infinite.
    NotFinite,
    /// Below the smallest valid value.
    TooSmall,
    /// Above the largest valid value.
    TooLarge,
    /// A thickness that exceeds the radius of its sphere.
    ExceedsRadius,
}

/// An input that is not valid: which one, and how.
///
/// ```
/// use microimpact::{Parameter, Sphere};
///
/// let error = Sphere::solid(-1e-6, 2600.0).unwrap_err();
/// assert_eq!(error.parameter, Parameter::Radius);
/// assert_eq!(error.to_string(), "radius is below its range, 1e-10 to 1 m");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InputError {
    /// The quantity at fault.
    pub parameter: Parameter,
    /// What is wrong with it.
    pub fault: Fault,
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (smallest, largest) = self.parameter.range();
        let fault = match self.fault {
            Fault::NotFinite => "is not a finite number",
            Fault::TooSmall => "is below its range",
            Fault::TooLarge => "is above its range",
            Fault::ExceedsRadius => "exceeds the radius",
        };
        write!(f, "{} {fault}, {} to {}", self.parameter.name(), Bound(smallest), Bound(largest))?;
        match self.parameter.unit() {
            "1" => Ok(()),
            unit => write!(f, " {unit}"),
        }
    }
}

impl core::error::Error for InputError {}

/// A bound of a range as a person writes it: with an exponent where it is far from one.
struct Bound(f64);

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.abs() {
            size if size == 0.0 || (1e-3..1e4).contains(&size) => write!(f, "{}", self.0),
            _ => write!(f, "{:e}", self.0),
        }
    }
}

/// Velocities that no impact can have, or an input that is not valid at all.
///
/// ```
/// use microimpact::{ConstantRestitution, ImpactError, NormalImpact, NormalMotion};
///
/// let law = ConstantRestitution::new(0.9)?;
/// let before = NormalMotion::new(2.0)?;
/// assert_eq!(
///     NormalImpact::from_measurement(&law, &before, 1.9),
///     Err(ImpactError::ReboundExceedsRestitution)
/// );
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ImpactError {
    /// An input lies outside its range.
    Input(InputError),
    /// The rebound is faster than the kinetic restitution R allows: the adhesion coefficient would be negative.
    ReboundExceedsRestitution,
    /// The impulse ratio lies outside its bounds, 0 to mu_0: friction would drive the slip or reverse it.
    ImpulseRatioOutsideBounds,
    /// The kinetic energy after the impact exceeds that before it.
    EnergyGained,
}

impl From<InputError> for ImpactError {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

impl fmt::Display for ImpactError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Input(error) => return error.fmt(f),
            Self::ReboundExceedsRestitution => {
                "rebound speed exceeds R times the approach speed: the adhesion coefficient would lie outside 0 to 1"
            }
            Self::ImpulseRatioOutsideBounds => "impulse ratio lies outside its bounds, 0 to mu_0",
            Self::EnergyGained => "kinetic energy after the impact exceeds that before it, ratio above 1",
        })
    }
}

impl core::error::Error for ImpactError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Input(error) => Some(error),
            _ => None,
        }
    }
}
