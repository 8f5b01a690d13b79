//! The scenes in which contact is simulated, on the surface of Brach & Dunn (1995), Table 1: with damping
//! and a ring, and then with friction and spin too.

use core::hint::black_box;

use microimpact::simulation::{
    Collocation, FixedCost, HystereticDamping, Nodes, NormalContact, NormalMethod, Ring, SimulatedImpact, Simulation,
    TangentialContact,
};
use microimpact::{
    Coulomb, InputError, NoFriction, NormalMotion, Outcome, PlanarMotion, Sphere, Stiffness, SurfaceMotion,
};

use super::impacts::{CONTACTS, Impact};
use super::scenes::{Answer, DENSITY_KG_M3, FRICTION, Measured, Number, RADIUS_M, Scene, Visitor, given};

const STIFFNESS_PA: f64 = 7.5e10;
const MATERIAL_DAMPING: f64 = 10.5;
const RING_N_M: f64 = 250.0;
const RING_DAMPING: f64 = 6.25;

/// The class of an impact that the library refuses.
pub const REFUSED: &str = "refused";

/// A method and how exactly it is to solve a scene.
pub trait Method: Sized {
    /// Name of the scene with normal impacts only.
    const NORMAL_SCENE: &'static str = "simulation/normal";

    /// The method, validated.
    fn new() -> Option<Self>;
}

impl Method for Collocation<7, f32> {
    fn new() -> Option<Self> {
        Self::new(given(1e-6)).ok()
    }
}

impl Method for Collocation<9, f64> {
    fn new() -> Option<Self> {
        Self::new(given(1e-9)).ok()
    }
}

impl Method for Collocation<5, f32> {
    const NORMAL_SCENE: &'static str = "simulation/normal-1e-5";

    fn new() -> Option<Self> {
        Self::new(given(1e-5)).ok()
    }
}

impl Method for FixedCost<5> {
    const NORMAL_SCENE: &'static str = "simulation/fixed-1e-5";

    fn new() -> Option<Self> {
        Self::new(black_box(3)).ok()
    }
}

impl Method for FixedCost<7> {
    const NORMAL_SCENE: &'static str = "simulation/fixed-1e-6";

    fn new() -> Option<Self> {
        Self::new(black_box(4)).ok()
    }
}

type Surface<T, F = NoFriction> = Simulation<T, HystereticDamping<T>, Ring<T>, F>;

/// Normal impacts only.
pub struct NormalContacts<T, M> {
    scene: Surface<T>,
    method: M,
}

/// Friction and spin.
pub struct ObliqueContacts<T, M> {
    scene: Surface<T, Coulomb<T>>,
    method: M,
}

impl<T: Number, M: Method + NormalMethod<T>> Scene<T> for NormalContacts<T, M> {
    const NAME: &'static str = M::NORMAL_SCENE;
    const PLANAR: bool = false;
    type Motion = NormalMotion<T>;
    type Verdict = Result<NormalContact<T>, InputError>;

    fn new() -> Option<Self> {
        Some(Self { scene: surface().ok()?, method: M::new()? })
    }

    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s).ok()
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.scene.normal_impact(&self.method, motion)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| impact.is_normal())
    }
}

impl<const N: usize, T> Scene<T> for ObliqueContacts<T, Collocation<N, T>>
where
    T: Number + Nodes<N>,
    Collocation<N, T>: Method,
{
    const NAME: &'static str = "simulation/oblique";
    const PLANAR: bool = true;
    type Motion = PlanarMotion<T>;
    type Verdict = Result<SimulatedImpact<T, TangentialContact<T>, ()>, InputError>;

    fn new() -> Option<Self> {
        let scene = surface().and_then(|surface| surface.with_friction(given(FRICTION))).ok()?;
        Some(Self { scene, method: Method::new()? })
    }

    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s)
            .and_then(|normal| normal.with_tangential(measured.tangential_m_s))
            .and_then(|oblique| oblique.with_spin(self.scene.sphere(), measured.spin_rad_s))
            .ok()
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.scene.observe(&self.method, motion)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| !impact.is_normal())
    }
}

fn surface<T: Number>() -> Result<Surface<T>, InputError> {
    let sphere = Sphere::solid(given(RADIUS_M), given(DENSITY_KG_M3))?;
    Simulation::new(sphere, Stiffness::new(given(STIFFNESS_PA))?)
        .with_damping(given(MATERIAL_DAMPING))?
        .with_ring(given(RING_N_M), given(RING_DAMPING))
}

impl<T: Number> From<Result<NormalContact<T>, InputError>> for Answer<T> {
    fn from(verdict: Result<NormalContact<T>, InputError>) -> Self {
        let class = verdict.map_or(REFUSED, |contact| match contact.outcome() {
            Outcome::Rebound => "rebound",
            Outcome::Capture => "captured",
        });
        answer(class, verdict.ok())
    }
}

impl<T: Number> From<Result<SimulatedImpact<T, TangentialContact<T>, ()>, InputError>> for Answer<T> {
    fn from(verdict: Result<SimulatedImpact<T, TangentialContact<T>, ()>, InputError>) -> Self {
        let class = verdict.map_or(REFUSED, |impact| match (impact.normal.outcome(), impact.tangential.motion()) {
            (Outcome::Rebound, SurfaceMotion::Sliding) => "rebound-sliding",
            (Outcome::Rebound, SurfaceMotion::Rolling | SurfaceMotion::Resting) => "rebound-rolling",
            (Outcome::Capture, SurfaceMotion::Sliding) => "captured-sliding",
            (Outcome::Capture, SurfaceMotion::Rolling) => "captured-rolling",
            (Outcome::Capture, SurfaceMotion::Resting) => "captured-resting",
        });
        answer(class, verdict.ok().map(|impact| impact.normal))
    }
}

fn answer<T: Number>(class: &'static str, contact: Option<NormalContact<T>>) -> Answer<T> {
    let restitution = contact.map(|contact| contact.overall_restitution());
    Answer { class, speed_margin: None, friction_margin: None, restitution }
}

/// Goes through the scenes of the simulation in both number types.
pub(super) fn visit_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f32, NormalContacts<f32, FixedCost<5>>>();
    visitor.visit::<f32, NormalContacts<f32, FixedCost<7>>>();
    visitor.visit::<f32, NormalContacts<f32, Collocation<5, f32>>>();
    visitor.visit::<f32, NormalContacts<f32, Collocation<7, f32>>>();
    visitor.visit::<f32, ObliqueContacts<f32, Collocation<7, f32>>>();
    visitor.visit::<f64, NormalContacts<f64, Collocation<9, f64>>>();
    visitor.visit::<f64, ObliqueContacts<f64, Collocation<9, f64>>>();
}
