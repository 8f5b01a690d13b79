//! Errors of inputs, and the valid range of each input.

use core::fmt;
use core::hash::{Hash, Hasher};

use crate::Real;

/// Builds [`Parameter`] from one table: a line holds the name of the variant, the name of the quantity, its unit and its
/// range.
macro_rules! parameters {
    (
        physics {$(
            $(#[doc = $text:literal])+
            $physical:ident: $name:literal, $unit:literal, $smallest:literal to $largest:literal;
        )+}
        settings {$(
            $(#[doc = $note:literal])+
            $setting:ident: $label:literal, $least:literal to $most:literal;
        )+}
        instruments {$(
            $(#[doc = $remark:literal])+
            $instrumental:ident: $title:literal, $measure:literal, $lowest:literal to $highest:literal;
        )+}
    ) => {
        /// A quantity that a caller supplies, with its unit and its valid range.
        ///
        /// Most parameters are physical quantities. Others are settings of a solver or of a table
        /// ([`is_setting`](Self::is_setting)). The last ones belong to instruments and their sensors, and need the feature
        /// `instrument`. The ranges cover particles from a nanometre to centimetres, and within them
        /// neither f32 nor f64 overflows in any formula.
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
            $(
                $(#[doc = $text])+
                #[doc = concat!("\n\nRange: ", $smallest, " to ", $largest, ", unit ", $unit, ".")]
                $physical,
            )+
            $(
                $(#[doc = $note])+
                #[doc = concat!("\n\nRange: ", $least, " to ", $most, ".")]
                $setting,
            )+
            $(
                $(#[doc = $remark])+
                #[doc = concat!("\n\nRange: ", $lowest, " to ", $highest, ", unit ", $measure, ".")]
                #[cfg(feature = "instrument")]
                $instrumental,
            )+
        }

        impl Parameter {
            const COUNT: usize = [
                $(Self::$physical,)+
                $(Self::$setting,)+
                $(#[cfg(feature = "instrument")] Self::$instrumental,)+
            ].len();

            /// Every parameter.
            ///
            /// ```
            /// use microimpact::Parameter;
            ///
            /// assert!(Parameter::ALL.iter().all(|parameter| parameter.range().0 < parameter.range().1));
            /// ```
            pub const ALL: [Self; Self::COUNT] = [
                $(Self::$physical,)+
                $(Self::$setting,)+
                $(#[cfg(feature = "instrument")] Self::$instrumental,)+
            ];

            /// Whether this is a setting of a solver or of a table, and not a physical quantity.
            ///
            /// ```
            /// use microimpact::Parameter;
            ///
            /// assert!(Parameter::Tolerance.is_setting());
            /// assert!(!Parameter::Radius.is_setting());
            /// ```
            pub const fn is_setting(self) -> bool {
                matches!(self, $(Self::$setting)|+)
            }

            /// Name, unit and range.
            // Inlined, a range is two constants, for which a microcontroller may need more flash.
            #[cfg_attr(feature = "std", inline)]
            const fn describe(self) -> (&'static str, &'static str, (f64, f64)) {
                match self {
                    $(Self::$physical => ($name, $unit, ($smallest, $largest)),)+
                    $(Self::$setting => ($label, "1", ($least, $most)),)+
                    $(#[cfg(feature = "instrument")] Self::$instrumental => ($title, $measure, ($lowest, $highest)),)+
                }
            }
        }
    };
}

parameters! {
    physics {
        /// Outer radius r of a sphere.
        Radius: "radius", "m", 1e-10 to 1.0;
        /// Contact radius of a resting sphere, divided by its radius.
        ContactRadiusRatio: "contact radius over radius", "1", 0.0 to 1.0;
        /// Wall thickness of a hollow sphere or coating thickness of a coated one; at most the radius.
        Thickness: "thickness", "m", 1e-12 to 1.0;
        /// Density of a material.
        Density: "density", "kg/m^3", 1e-2 to 1e6;
        /// Gyration ratio kappa = k^2/r^2: the squared radius of gyration divided by the squared radius.
        GyrationRatio: "gyration ratio", "1", 1e-3 to 1.0;
        /// Young's modulus E.
        YoungsModulus: "Young's modulus", "Pa", 1.0 to 1e16;
        /// Poisson's ratio nu.
        PoissonRatio: "Poisson's ratio", "1", -0.999 to 0.5;
        /// Hertz stiffness K (B2).
        Stiffness: "stiffness", "Pa", 1.0 to 1e16;
        /// Normal velocity towards the surface before the impact, a positive number.
        ApproachSpeed: "approach speed", "m/s", 1e-12 to 1e6;
        /// Tangential velocity.
        TangentialVelocity: "tangential velocity", "m/s", -1e7 to 1e7;
        /// Spin.
        Spin: "spin", "rad/s", -1e17 to 1e17;
        /// Peripheral velocity of a spinning sphere: spin times radius.
        PeripheralVelocity: "peripheral velocity", "m/s", -1e7 to 1e7;
        /// A component of a velocity in space.
        VelocityComponent: "component of the velocity", "m/s", -1e7 to 1e7;
        /// Length of the normal of a wall, or from one sphere to another.
        NormalLength: "length of the normal", "1", 0.999 to 1.001;
        /// Normal velocity away from the surface after the impact.
        ReboundSpeed: "rebound speed", "m/s", 0.0 to 1e6;
        /// Standard error of the measured velocities.
        VelocityError: "velocity error", "m/s", 0.0 to 1e6;
        /// Standard error of any input, in the unit of that input.
        StandardError: "standard error", "in the unit of its quantity", 0.0 to 1e18;
        /// Kinetic restitution R, without adhesion.
        Restitution: "restitution", "1", 0.0 to 1.0;
        /// Speed k of the restitution law R = k/(k + v).
        RestitutionSpeed: "restitution speed", "m/s", 1e-6 to 1e12;
        /// Power p of the restitution law R = k^p/(k^p + v^p).
        RestitutionPower: "power of the restitution law", "1", 0.01 to 1.0;
        /// Speed v_y of an elastic impact in which a material starts to yield.
        YieldSpeed: "yield speed", "m/s", 1e-9 to 1e9;
        /// Contact pressure p_y at which a material starts to yield.
        YieldPressure: "contact yield pressure", "Pa", 1.0 to 1e13;
        /// Adhesion coefficient rho.
        AdhesionCoefficient: "adhesion coefficient", "1", 0.0 to 1.0;
        /// Speed l of the adhesion coefficient rho = l^q/(l^q + v^q).
        AdhesionSpeed: "adhesion speed", "m/s", 1e-9 to 1e9;
        /// Power q of that coefficient.
        AdhesionPower: "power of the adhesion coefficient", "1", 0.01 to 16.0;
        /// Electric charge of a sphere.
        Charge: "charge", "C", -1.0 to 1.0;
        /// Work of adhesion W_A.
        WorkOfAdhesion: "work of adhesion", "J", 0.0 to 1e6;
        /// Coulomb's friction coefficient f.
        Friction: "friction coefficient", "1", 0.0 to 1e3;
        /// Stiffness ratio chi: the tangential stiffness of a contact divided by (3/2) K a, with the contact radius a.
        StiffnessRatio: "stiffness ratio", "1", 1e-3 to 1e3;
        /// Impulse ratio mu.
        ImpulseRatio: "impulse ratio", "1", -1e3 to 1e3;
        /// Rolling-dissipation coefficient times its moment arm, mu_m a_c.
        RollingArm: "rolling-dissipation arm", "m", 0.0 to 1.0;
        /// Impulse of an external force during one phase of the impact.
        ExternalImpulse: "external impulse", "N s", -1e6 to 1e6;
        /// Change of velocity by an external impulse.
        VelocityChange: "velocity change by an external impulse", "m/s", -1e7 to 1e7;
        /// Constant external force.
        ExternalForce: "external force", "N", -1e6 to 1e6;
        /// Duration of a contact.
        Duration: "duration", "s", 0.0 to 1.0;
        /// Strength zeta_H of the material damping.
        MaterialDamping: "material damping", "1", 0.0 to 1e9;
        /// Strength f0 of the adhesion ring.
        AdhesionStrength: "adhesion strength", "N/m", 0.0 to 1e9;
        /// Relaxation time A of a viscoelastic material.
        RelaxationTime: "relaxation time", "s", 0.0 to 1.0;
        /// Restitution e that constant damping leaves without adhesion.
        NominalRestitution: "nominal restitution", "1", 1e-3 to 1.0;
        /// Work of adhesion G per area: twice the surface energy of equal materials.
        AdhesionEnergy: "work of adhesion per area", "J/m^2", 0.0 to 1e6;
        /// Distance between the atoms of two surfaces in contact, z_0.
        AtomicSpacing: "atomic spacing", "m", 1e-11 to 1e-7;
        /// Strength zeta_A of the adhesion damping.
        AdhesionDamping: "adhesion damping", "1", 0.0 to 1e9;
        /// Strength lambda of the peeling moment.
        PeelingMoment: "peeling moment", "N m", 0.0 to 1e3;
        /// Adhesion relative to inertia: 5/3 of the equilibrium indentation, divided by the peak indentation of Hertz's
        /// impact. For DMT's adhesion, 5/4 of the force, divided by the elastic force at that peak.
        AdhesionRatio: "adhesion over inertia", "1", 0.0 to 1e10;
        /// External force relative to elasticity: 5/4 of the force, divided by the elastic force at the peak indentation.
        ForceRatio: "external force over elasticity", "1", -1e6 to 1e6;
        /// Damping relative to elasticity: c_H U or c_A U, where U is the largest speed of the undamped motion. The product
        /// is the damping force divided by the force that it accompanies.
        DampingRatio: "damping over elasticity", "1", 0.0 to 1e9;
        /// Critical speed of a radius in a table. It is too small if every speed rebounds, and too large if no speed does.
        CriticalSpeed: "critical speed", "m/s", 1e-12 to 1e6;
        /// Elastic impulse divided by the momentum before the impact, I/(m v).
        ImpulseOverMomentum: "elastic impulse over momentum", "1", 0.0 to 1e6;
        /// Dimensionless strength p of adhesion.
        DimensionlessAdhesion: "dimensionless strength of adhesion", "1", 0.0 to 0.999;
        /// Dimensionless damping, at the unit of speed.
        DimensionlessDamping: "dimensionless damping", "1", 0.0 to 0.5;
        /// Approach speed divided by the unit of speed, in fixed point.
        SpeedInUnits: "approach speed over the unit of speed", "1", 0.004 to 8.0;
        /// Any other velocity divided by the unit of speed, in fixed point. For a work of adhesion, it is the rebound speed
        /// whose energy equals that work.
        VelocityInUnits: "velocity over the unit of speed", "1", -8.0 to 8.0;
        /// Approach speed of a simulated contact divided by the unit of speed, in fixed point.
        ContactSpeedInUnits: "approach speed of a contact over the unit of speed", "1", 0.1 to 8.0;
        /// A velocity along the surface divided by the largest normal one, in fixed point.
        VelocityRatio: "velocity along the surface over the normal one", "1", -50.0 to 50.0;
        /// Speed k of the restitution law divided by the unit of speed, in fixed point.
        RestitutionSpeedInUnits: "restitution speed over the unit of speed", "1", 0.01 to 100.0;
        /// Gyration ratio in fixed point.
        FixedPointGyration: "gyration ratio in fixed point", "1", 0.2 to 1.0;
        /// Coulomb's friction coefficient in fixed point.
        FixedPointFriction: "friction coefficient in fixed point", "1", 0.0 to 7.0;
        /// Unit of speed for fixed point.
        SpeedUnit: "unit of speed", "m/s", 1e-12 to 1e6;
    }
    settings {
        /// Tolerance of a solver or of a search.
        Tolerance: "tolerance", 1e-13 to 1e-2;
        /// Number of iterations that a method of fixed cost spends on each phase.
        Iterations: "number of iterations", 1.0 to 40.0;
        /// Energy at which a captured sphere counts as resting: the energy above the bottom of the potential well, divided
        /// by the depth of the well.
        RestEnergy: "energy at rest over depth of the well", 1e-12 to 0.5;
        /// Largest number of turning points that are computed for a captured sphere.
        TurningPoints: "number of turning points", 1.0 to 1e5;
        /// Relative error margin of a boundary table.
        BoundaryMargin: "margin of a boundary table", 0.0 to 0.05;
        /// Largest speed of a restitution table, divided by the critical speed.
        SpeedRatio: "largest over critical speed", 1.1 to 1e4;
    }
    instruments {
        /// Index of a material in the table of an instrument.
        MaterialIndex: "index of the material", "1", 0.0 to 255.0;
        /// Time during which an instrument counted events.
        ObservationTime: "observation time", "s", 1e-9 to 1e12;
        /// Fraction of the observation time in which an instrument was dead. The rate of the events is then corrected by up to
        /// a factor of ten.
        DeadFraction: "dead fraction of the time", "1", 0.0 to 0.9;
        /// Probability that a model predicts for a class.
        Probability: "probability", "1", 0.0 to 1.0;
        /// Smallest probability for which a class is stated.
        Confidence: "confidence", "1", 0.5 to 1.0;
        /// Change of the odds of a class that a drift alarm is to find: the odds afterwards divided by the odds before.
        OddsRatio: "odds ratio", "1", 1.01 to 100.0;
        /// Smallest mean number of readings between two false alarms.
        FalseAlarmInterval: "readings between false alarms", "1", 10.0 to 1e12;
        /// Distance between two light beams, spacing of interference fringes, or length of a tube.
        SensorLength: "length of the sensor", "m", 1e-9 to 10.0;
        /// Frequency of a clock.
        ClockFrequency: "clock frequency", "Hz", 1.0 to 1e12;
        /// Number of ticks of a clock between two edges of a signal.
        Ticks: "number of clock ticks", "1", 1.0 to 4294967295.0;
        /// Standard error of the time of one edge of a signal, in ticks of the clock.
        EdgeError: "error of an edge in clock ticks", "1", 0.0 to 1e6;
        /// Number of periods of a signal.
        SignalCycles: "number of signal periods", "1", 1.0 to 4294967295.0;
        /// Frequency by which light of one beam is shifted.
        FrequencyShift: "frequency shift", "Hz", -1e12 to 1e12;
        /// Quantity that one count of a converter stands for.
        Sensitivity: "sensitivity", "in the unit of its quantity per count", 1e-30 to 1e6;
        /// Standard deviation of a signal, in counts of a converter.
        SignalNoise: "noise of the signal in counts", "1", 0.0 to 1e9;
        /// Voltage that accelerated a charged particle.
        AcceleratingVoltage: "accelerating voltage", "V", 1e-3 to 1e9;
        /// Impulse of an impact on a sensor.
        MeasuredImpulse: "measured impulse", "N s", 1e-30 to 1e6;
        /// Standard error of a result divided by the result. Beyond the range, first-order propagation of errors does not hold.
        RelativeError: "relative standard error", "1", 0.0 to 0.2;
    }
}

impl Parameter {
    /// Name of the quantity, as in the literature.
    ///
    /// ```
    /// assert_eq!(microimpact::Parameter::Friction.name(), "friction coefficient");
    /// ```
    pub const fn name(self) -> &'static str {
        self.describe().0
    }

    /// Unit; "1" for a ratio.
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
    #[cfg_attr(feature = "std", inline)]
    pub const fn range(self) -> (f64, f64) {
        self.describe().2
    }

    /// Returns the value if it is in the range of this parameter.
    ///
    /// # Errors
    /// The value is not a number or is outside the range. The error names this parameter and contains the value.
    ///
    /// ```
    /// use microimpact::{Fault, Parameter};
    ///
    /// assert_eq!(Parameter::Density.check(2600.0), Ok(2600.0));
    /// assert_eq!(Parameter::Density.check(f64::NAN).unwrap_err().fault, Fault::NotFinite);
    /// assert_eq!(Parameter::Density.check(0.0).unwrap_err().fault, Fault::TooSmall);
    /// ```
    // A part of its caller, where the range is a constant: fixed point would convert it by floating point in software.
    #[inline(always)]
    pub fn check<T: Real>(self, value: T) -> Result<T, InputError> {
        let (smallest, largest) = self.range();
        // If the number type rounds the lower bound to zero, it would accept zero. Then no value is valid.
        let represented = smallest <= 0.0 || T::constant(smallest) > T::ZERO;
        // Both comparisons fail for NaN.
        if represented && value >= T::constant(smallest) && value <= T::constant(largest) {
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
        InputError { parameter: self, fault, value: value.to_f64() as f32 }
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
// As wide as the value of an error, which then takes no slot of two numbers in a result: the compiler would keep the code of
// errors that nobody looks at.
#[repr(u32)]
pub enum Fault {
    /// The value is NaN or infinite.
    NotFinite,
    /// The value is below the smallest valid value.
    TooSmall,
    /// The value is above the largest valid value.
    TooLarge,
    /// The thickness exceeds the radius of its sphere.
    ExceedsRadius,
    /// The tolerance is below what the rounding of the number type allows. Fixed point allows none.
    BelowPrecision,
    /// The tolerance is below what the number of nodes can keep.
    TooFewNodes,
    /// The law of contact does not go with this quantity.
    OtherLaw,
    /// The value does not rise from point to point.
    OutOfOrder,
    /// The quantity acts on one body, and two meet.
    TwoBodies,
    /// The bodies move apart along the normal, or stay as they are.
    Receding,
    /// The table has no such entry.
    #[cfg(feature = "instrument")]
    NotInTable,
    /// The standard error of the value is above three tenths of it.
    TooUncertain,
}

/// An invalid input: the parameter, the value found, and how the value misses its range.
///
/// The message also gives the range with its unit and, for common mistakes, the remedy. Two errors are equal if their values
/// are equal bit by bit, so that an error with NaN is equal to itself.
///
/// ```
/// use microimpact::{NormalMotion, Parameter};
///
/// let error = NormalMotion::new(-2.8).unwrap_err();
/// assert_eq!((error.parameter, error.value), (Parameter::ApproachSpeed, -2.8));
/// let message = "approach speed is -2.8 m/s, but must be 1e-12 to 1e6 m/s; enter -2.8 m/s as 2.8";
/// assert_eq!(error.to_string(), message);
/// ```
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct InputError {
    /// The parameter that is invalid.
    pub parameter: Parameter,
    /// How the value misses its range.
    pub fault: Fault,
    /// The value found, in the unit of the parameter, rounded to f32.
    pub value: f32,
}

impl PartialEq for InputError {
    fn eq(&self, other: &Self) -> bool {
        (self.parameter, self.fault, self.value.to_bits()) == (other.parameter, other.fault, other.value.to_bits())
    }
}

impl Eq for InputError {}

impl Hash for InputError {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.parameter, self.fault, self.value.to_bits()).hash(state);
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { parameter, fault, value } = *self;
        let (smallest, largest) = parameter.range();
        let unit = Unit(parameter.unit());
        // Rounding to f32 may move a value onto the bound that it misses.
        let value = match fault {
            Fault::TooSmall if value == smallest as f32 && f64::from(value) >= smallest => value.next_down(),
            Fault::TooLarge if value == largest as f32 && f64::from(value) <= largest => value.next_up(),
            _ => value,
        };
        write!(f, "{} is {}", parameter.name(), Number(value))?;
        if value.is_finite() {
            write!(f, "{unit}")?;
        }
        f.write_str(", but must ")?;
        match fault {
            Fault::ExceedsRadius => f.write_str("not exceed the radius of the sphere"),
            Fault::BelowPrecision => {
                f.write_str("be at least 1e-6 in single and 1e-13 in double precision; in fixed point use `FixedCost`")
            }
            Fault::TooFewNodes => f.write_str(
                "be at least 1e-3 with four nodes, 3e-4 with five, 1e-5 with six, 1e-7 with seven, 1e-9 with eight and 1e-11 \
                 with nine; use more nodes or `Adaptive`",
            ),
            Fault::OtherLaw if self.parameter == Parameter::StiffnessRatio => f.write_str(
                "only be given with Hertz's contact without adhesion and external force, with hysteretic damping or none",
            ),
            Fault::OtherLaw => f.write_str("be zero with this law or end of contact; choose another"),
            Fault::Receding => f.write_str(
                "be positive, so that the bodies approach; the normal points from the wall to the sphere, or from the second sphere to the \
                 first",
            ),
            #[cfg(feature = "instrument")]
            Fault::NotInTable => f.write_str("be the index of an entry of the table; the first entry has the index 0"),
            Fault::TooUncertain => f.write_str("have a standard error of at most three tenths of it"),
            Fault::TwoBodies => f.write_str("be zero where two spheres meet; it acts on one of them"),
            Fault::OutOfOrder if parameter == Parameter::ReboundSpeed => {
                f.write_str("not be below that of the point before; R v never falls with the speed v")
            }
            Fault::OutOfOrder => f.write_str("be above that of the point before; sort the points by speed"),
            Fault::NotFinite => write!(f, "be a number from {} to {}{unit}", Number(smallest), Number(largest)),
            Fault::TooSmall | Fault::TooLarge => {
                write!(f, "be {} to {}{unit}", Number(smallest), Number(largest))?;
                self.remedy(f)
            }
        }
    }
}

impl InputError {
    /// What to do about a common mistake: a wrong sign, or micrometres instead of metres.
    fn remedy(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = Number(self.value);
        let unit = Unit(self.parameter.unit());
        let (smallest, largest) = self.parameter.range();
        match self.parameter {
            Parameter::ApproachSpeed | Parameter::WorkOfAdhesion | Parameter::RollingArm | Parameter::PeelingMoment
                if (smallest..=largest).contains(&-f64::from(self.value)) =>
            {
                write!(f, "; enter {value}{unit} as {}", Number(-self.value))
            }
            Parameter::NormalLength if self.value > 0.0 => write!(f, "; divide each component by {value}"),
            Parameter::NormalLength => f.write_str("; give the direction of the normal"),
            Parameter::AdhesionRatio => f.write_str("; the approach speed is too small for this adhesion"),
            Parameter::DimensionlessAdhesion => {
                f.write_str("; fixed point needs faster impacts, or a larger unit of speed")
            }
            Parameter::DimensionlessDamping => {
                f.write_str("; fixed point needs slower impacts, or a smaller unit of speed")
            }
            Parameter::ForceRatio => f.write_str("; the approach speed is too small for this external force"),
            Parameter::Radius | Parameter::Thickness
                if self.fault == Fault::TooLarge && (0.0..1e4).contains(&self.value) =>
            {
                write!(f, "; enter {value} um as {value}e-6")
            }
            _ => Ok(()),
        }
    }
}

impl core::error::Error for InputError {}

/// A number as a person writes it: with an exponent if it is very large or very small.
struct Number<T>(T);

impl<T: Real + fmt::Display + fmt::LowerExp> fmt::Display for Number<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs().to_f64();
        if size == 0.0 || (1e-3..1e4).contains(&size) || !size.is_finite() {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// A unit after a number; nothing for a ratio.
struct Unit(&'static str);

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 == "1" { Ok(()) } else { write!(f, " {}", self.0) }
    }
}

/// A measured impact that contradicts the model, or an invalid input.
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
    /// An input is outside its range.
    Input(InputError),
    /// The rebound is faster than the kinetic restitution R allows. The adhesion coefficient would be negative.
    ReboundExceedsRestitution,
    /// The impulse ratio is outside its bounds, 0 to mu_0. Friction would increase or reverse the slip.
    ImpulseRatioOutsideBounds,
    /// The kinetic energy is larger after the impact than before it.
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
                "rebound speed exceeds R times the approach speed, but the adhesion coefficient must be 0 to 1; check both \
                 speeds and the restitution law"
            }
            Self::ImpulseRatioOutsideBounds => {
                "impulse ratio is outside its bounds, 0 to mu_0; check the tangential velocities and the spin, and the velocity \
                 error of a measured impact"
            }
            Self::EnergyGained => {
                "kinetic energy after the impact exceeds that before it, but their ratio must be at most 1; check the \
                 velocities and the spins"
            }
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
