//! The numbers that an impact can be asked for.

/// What the contact simulation is asked for besides how an impact ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Asked {
    /// Nothing.
    End,
    /// Times and impulses.
    Times,
    /// All that it tells of a contact, which costs about as much again as the end.
    All,
}

impl Asked {
    /// What some quantities need.
    pub(crate) fn by(quantities: &[Quantity]) -> Self {
        quantities.iter().map(|quantity| quantity.asked()).max().unwrap_or(Self::End)
    }
}

/// Builds [`Quantity`] from one table: a line holds the variant, its name, and what the contact simulation is asked for to have it.
macro_rules! quantities {
    ($($(#[doc = $text:literal])+ $variant:ident: $name:literal, $asked:ident;)+) => {
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

            const fn asked(self) -> Asked {
                match self {
                    $(Self::$variant => Asked::$asked,)+
                }
            }
        }
    };
}

quantities! {
    /// Overall restitution e; zero for a capture.
    OverallRestitution: "overall_restitution", End;
    /// Rebound speed, m/s; zero for a capture.
    ReboundSpeed: "rebound_speed", End;
    /// Tangential velocity, m/s: after a rebound, or of a captured sphere when its slip has ended.
    SpeedTangentialOut: "speed_tangential_out", End;
    /// Spin, rad/s: after a rebound, or of a captured sphere when its slip has ended.
    SpinOut: "spin_out", End;
    /// Friction divided by the least friction that ends the slip: from one on, the sphere rolls. Not with a peeling moment or compliance,
    /// nor where `Collocation` or `RungeKuttaGill` is chosen at run time.
    FrictionOverLimit: "friction_over_limit", End;
    /// Peak indentation, m. Simulation.
    MaxIndentation: "max_indentation", End;
    /// Impulse ratio mu. Rigid body, and simulation with compliance.
    ImpulseRatioOut: "impulse_ratio_out", End;
    /// Impulse ratio mu_0 that ends the slip. Rigid body.
    RollingRatio: "rolling_ratio", End;
    /// Number of phases of stick and slip. Simulation with compliance.
    Phases: "phases", End;
    /// Velocity in space after the impact, m/s, component x.
    VelocityOutX: "velocity_out_x", End;
    /// Component y.
    VelocityOutY: "velocity_out_y", End;
    /// Component z.
    VelocityOutZ: "velocity_out_z", End;
    /// Spin in space after the impact, rad/s, component x.
    SpinOutX: "spin_out_x", End;
    /// Component y.
    SpinOutY: "spin_out_y", End;
    /// Component z.
    SpinOutZ: "spin_out_z", End;
    /// Velocity of the second of two spheres after the impact, m/s, component x.
    Velocity2OutX: "velocity_2_out_x", End;
    /// Component y.
    Velocity2OutY: "velocity_2_out_y", End;
    /// Component z.
    Velocity2OutZ: "velocity_2_out_z", End;
    /// Spin of the second of two spheres after the impact, rad/s, component x.
    Spin2OutX: "spin_2_out_x", End;
    /// Component y.
    Spin2OutY: "spin_2_out_y", End;
    /// Component z.
    Spin2OutZ: "spin_2_out_z", End;
    /// Indentation at which a captured sphere first turns back, m. Simulation.
    TurningIndentation: "turning_indentation", All;
    /// Time from first contact to the peak, s. Simulation.
    TimePeak: "time_peak", Times;
    /// Time from first contact to separation, s. Simulation of a rebound.
    ContactTime: "contact_time", Times;
    /// Time at which the slip ends, s; zero if there is none. Simulation of a sphere that rolls before it is at the end.
    TimeRoll: "time_roll", All;
    /// Impulse of the elastic force, N s. Simulation.
    ImpulseHertz: "impulse_hertz", Times;
    /// Impulse of adhesion on rebound, N s. Simulation.
    ImpulseAdhesionRebound: "impulse_adhesion_rebound", Times;
    /// Angle through which the sphere turns during contact, rad. Simulation.
    Rotation: "rotation", All;
    /// Distance of the centre along the surface during contact, m. Simulation.
    DisplacementTangential: "displacement_tangential", All;
    /// Work of the damping in the materials, J.
    WorkMaterial: "work_material", All;
    /// Work of adhesion or of its damping, J.
    WorkAdhesion: "work_adhesion", All;
    /// Work of friction, J. Rigid body, and simulation of a rebound.
    WorkFriction: "work_friction", All;
    /// Work of rolling dissipation or of a peeling moment, J. Rigid body, and simulation of a rebound.
    WorkRolling: "work_rolling", All;
    /// Kinetic energy before the impact, J: of the motion in its plane relative to the wall or, of two spheres, to each other. Rigid body,
    /// and simulation of a rebound.
    EnergyBefore: "energy_before", All;
    /// The same after the impact, J: the difference is what the impact takes. Rigid body, and simulation of a rebound.
    EnergyAfter: "energy_after", All;
}
