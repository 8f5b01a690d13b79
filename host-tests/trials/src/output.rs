//! What is compared: outputs of a simulation, and the scales of their errors.

use reference::scenes::mass;
use truth::{Double, Outcome, Scene, Truth};

/// An output of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// e^2
    RestitutionSquared,
    /// Largest indentation.
    Peak,
    /// Indentation at which a captured sphere first turns back.
    Turning,
    /// Time of the peak.
    PeakTime,
    /// Time of separation.
    ContactTime,
    /// Time at which the slip ends.
    RollTime,
    /// Impulse of the elastic force.
    ElasticImpulse,
    /// Impulse of adhesion on rebound.
    AdhesionImpulse,
    /// Work of the damping of the materials.
    MaterialWork,
    /// Work of the damping of adhesion.
    AdhesionWork,
    /// V_t from the impulses.
    Velocity,
    /// W from the impulses.
    Spin,
    /// V_t of the slip history.
    SlipVelocity,
    /// W of the slip history.
    SlipSpin,
    /// Rotation during contact.
    Rotation,
    /// Displacement during contact.
    Displacement,
}

/// Number of outputs.
pub const COUNT: usize = 16;

impl Output {
    /// All outputs; those of a capture are the first four.
    pub const ALL: [Self; COUNT] = [
        Self::RestitutionSquared,
        Self::Peak,
        Self::Turning,
        Self::PeakTime,
        Self::ContactTime,
        Self::RollTime,
        Self::ElasticImpulse,
        Self::AdhesionImpulse,
        Self::MaterialWork,
        Self::AdhesionWork,
        Self::Velocity,
        Self::Spin,
        Self::SlipVelocity,
        Self::SlipSpin,
        Self::Rotation,
        Self::Displacement,
    ];

    /// Outputs of a capture.
    pub const OF_CAPTURES: usize = 4;

    /// In tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RestitutionSquared => "e^2",
            Self::Peak => "peak",
            Self::Turning => "turning",
            Self::PeakTime => "peak time",
            Self::ContactTime => "contact time",
            Self::RollTime => "roll time",
            Self::ElasticImpulse => "elastic impulse",
            Self::AdhesionImpulse => "adhesion impulse",
            Self::MaterialWork => "material work",
            Self::AdhesionWork => "adhesion work",
            Self::Velocity => "V_t",
            Self::Spin => "W",
            Self::SlipVelocity => "V_t (slip)",
            Self::SlipSpin => "W (slip)",
            Self::Rotation => "rotation",
            Self::Displacement => "displacement",
        }
    }

    /// The true value; `None` where the quantity does not exist.
    pub fn of(self, truth: &Truth) -> Option<Double> {
        let rebound = truth.outcome == Some(Outcome::Rebound);
        match self {
            Self::RestitutionSquared => Some(truth.restitution_squared),
            Self::Peak => truth.peak,
            Self::Turning => truth.turning,
            Self::PeakTime => truth.peak_time,
            Self::ContactTime => rebound.then_some(truth.time),
            Self::RollTime => truth.roll_time,
            Self::ElasticImpulse => Some(truth.elastic_impulse),
            Self::AdhesionImpulse => Some(truth.adhesion_impulse),
            Self::MaterialWork => Some(truth.material_work),
            Self::AdhesionWork => Some(truth.adhesion_work),
            Self::Velocity | Self::SlipVelocity => Some(truth.velocity),
            Self::Spin | Self::SlipSpin => Some(truth.spin),
            Self::Rotation => Some(truth.rotation),
            Self::Displacement => Some(truth.displacement),
        }
    }

    /// The scale of an error: one for e^2, otherwise the natural size of the quantity, or its own size where that is
    /// larger.
    pub fn scale(self, scene: &Scene, truth: &Truth) -> f64 {
        let time = truth.peak_time.map_or(truth.time, |peak| peak.max(truth.time)).to_f64();
        let momentum = mass(scene) * scene.speed;
        let natural = match self {
            Self::RestitutionSquared => return 1.0,
            Self::Peak | Self::Turning => truth.peak.map_or(0.0, Double::to_f64),
            Self::PeakTime => 0.0,
            Self::ContactTime | Self::RollTime => time,
            Self::ElasticImpulse | Self::AdhesionImpulse => momentum,
            Self::MaterialWork | Self::AdhesionWork => momentum * scene.speed,
            Self::Velocity | Self::SlipVelocity => scene.speed,
            Self::Spin | Self::SlipSpin => scene.speed / scene.radius,
            Self::Rotation => scene.speed / scene.radius * time,
            Self::Displacement => scene.speed * time,
        };
        self.of(truth).map_or(natural, |value| natural.max(value.to_f64().abs()))
    }
}
