//! The numbers that an impact can be asked for.

/// Builds [`Quantity`] from one table: a line holds the variant, its name, and whether the contact simulation must follow the whole
/// contact for it.
macro_rules! quantities {
    ($($(#[doc = $text:literal])+ $variant:ident: $name:literal, $followed:literal;)+) => {
        /// A number that an impact can be asked for, in SI units. An impact that does not have it, has NaN in its place.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Quantity {
            $($(#[doc = $text])+ $variant,)+
        }

        impl Quantity {
            pub(crate) const COUNT: usize = [$(Self::$variant),+].len();

            /// Every quantity.
            pub const ALL: [Self; Self::COUNT] = [$(Self::$variant),+];

            /// Its name, which is that of the column of a table without the unit.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }

            /// Whether the contact simulation must follow the whole contact for it, which costs about as much again.
            pub(crate) const fn is_followed(self) -> bool {
                match self {
                    $(Self::$variant => $followed,)+
                }
            }
        }
    };
}

quantities! {
    /// Overall restitution e; zero for a capture.
    OverallRestitution: "overall_restitution", false;
    /// Rebound speed, m/s; zero for a capture.
    ReboundSpeed: "rebound_speed", false;
    /// Tangential velocity, m/s: after a rebound, or of a captured sphere when its slip has ended.
    SpeedTangentialOut: "speed_tangential_out", false;
    /// Spin, rad/s: after a rebound, or of a captured sphere when its slip has ended.
    SpinOut: "spin_out", false;
    /// Friction over the least that ends the slip: the sphere rolls from one on. Not with a peeling moment or compliance.
    FrictionOverLimit: "friction_over_limit", false;
    /// Peak indentation, m. Simulation.
    MaxIndentation: "max_indentation", false;
    /// Impulse ratio mu. Rigid body, and simulation with compliance.
    ImpulseRatioOut: "impulse_ratio_out", false;
    /// Impulse ratio mu_0 that ends the slip. Rigid body.
    RollingRatio: "rolling_ratio", false;
    /// Number of phases of stick and slip. Simulation with compliance.
    Phases: "phases", false;
    /// Velocity in space after the impact, m/s, component x.
    VelocityOutX: "velocity_out_x", false;
    /// Component y.
    VelocityOutY: "velocity_out_y", false;
    /// Component z.
    VelocityOutZ: "velocity_out_z", false;
    /// Spin in space after the impact, rad/s, component x.
    SpinOutX: "spin_out_x", false;
    /// Component y.
    SpinOutY: "spin_out_y", false;
    /// Component z.
    SpinOutZ: "spin_out_z", false;
    /// Velocity of the second of two spheres after the impact, m/s, component x.
    Velocity2OutX: "velocity_2_out_x", false;
    /// Component y.
    Velocity2OutY: "velocity_2_out_y", false;
    /// Component z.
    Velocity2OutZ: "velocity_2_out_z", false;
    /// Spin of the second of two spheres after the impact, rad/s, component x.
    Spin2OutX: "spin_2_out_x", false;
    /// Component y.
    Spin2OutY: "spin_2_out_y", false;
    /// Component z.
    Spin2OutZ: "spin_2_out_z", false;
    /// Indentation at which a captured sphere first turns back, m. Simulation.
    TurningIndentation: "turning_indentation", true;
    /// Time from first contact to the peak, s. Simulation.
    TimePeak: "time_peak", true;
    /// Time from first contact to separation, s. Simulation of a rebound.
    ContactTime: "contact_time", true;
    /// Time at which the slip ends, s; zero if there is none. Simulation of a sphere that rolls before it is at the end.
    TimeRoll: "time_roll", true;
    /// Impulse of the elastic force, N s. Simulation.
    ImpulseHertz: "impulse_hertz", true;
    /// Impulse of adhesion on rebound, N s. Simulation.
    ImpulseAdhesionRebound: "impulse_adhesion_rebound", true;
    /// Angle through which the sphere turns during contact, rad. Simulation.
    Rotation: "rotation", true;
    /// Distance of the centre along the surface during contact, m. Simulation.
    DisplacementTangential: "displacement_tangential", true;
    /// Work of the damping in the materials, J.
    WorkMaterial: "work_material", true;
    /// Work of adhesion or of its damping, J.
    WorkAdhesion: "work_adhesion", true;
    /// Work of friction, J. Rigid body, and simulation of a rebound.
    WorkFriction: "work_friction", true;
    /// Work of rolling dissipation or of a peeling moment, J. Rigid body, and simulation of a rebound.
    WorkRolling: "work_rolling", true;
    /// Kinetic energy before the impact, J, of the motion in its plane. Rigid body, and simulation of a rebound.
    EnergyBefore: "energy_before", true;
    /// Kinetic energy after the impact, J, of the motion in its plane. Rigid body, and simulation of a rebound.
    EnergyAfter: "energy_after", true;
}
