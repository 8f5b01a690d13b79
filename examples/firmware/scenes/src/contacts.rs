//! The scenes in which contact is simulated, on the surface of Brach & Dunn (1995), Table 1: with damping
//! and a ring, and then with friction and spin too.

use core::hint::black_box;

use microimpact::contact::{
    Collocation, Contact, ContactLaw, FixedCost, HertzLaw, Method, NormalContact, Output, RingScene, SimulatedImpact,
    Slip, Surface, TangentialVelocities,
};
use microimpact::{Coulomb, InputError, NormalMotion, Outcome, PlanarMotion, Sphere, Stiffness};

use super::impacts::{CONTACTS, Impact};
use super::scenes::{Answer, Measured, Number, Scene, UNDECIDED, Visitor, given, name};
use super::table_1::{DENSITY_KG_M3, FRICTION, MATERIAL_DAMPING, RADIUS_M, RING_DAMPING, RING_N_M, STIFFNESS_PA};

/// The class of an impact that the library refuses.
pub const REFUSED: &str = "refused";

/// A method and how exactly it is to solve a scene.
pub trait Setting: Sized {
    /// Name of the scene, without or with friction.
    const SCENE: &'static str;

    /// The method, validated.
    fn new() -> Option<Self>;
}

/// A method for scenes with friction.
pub struct Oblique<S>(S);

macro_rules! setting {
    ($method:ty, $scene:literal, $new:expr) => {
        impl Setting for $method {
            const SCENE: &'static str = $scene;

            fn new() -> Option<Self> {
                $new
            }
        }
    };
}

setting!(FixedCost<4>, "simulation/fixed-class", Self::new(black_box(2)).ok());
setting!(FixedCost<5>, "simulation/fixed-1e-5", Self::new(black_box(3)).ok());
setting!(FixedCost<7>, "simulation/fixed-1e-6", Self::new(black_box(3)).ok());
setting!(Collocation<5, f32>, "simulation/normal-3e-4", Self::new(given(3e-4)).ok());
setting!(Collocation<7, f32>, "simulation/normal", Self::new(given(1e-6)).ok());
setting!(Collocation<9, f64>, "simulation/normal", Self::new(given(1e-9)).ok());
setting!(
    Oblique<FixedCost<5, 7>>,
    "simulation/fixed-oblique-1e-5",
    FixedCost::new(black_box(3)).ok().map(|method| Self(method.with_outputs()))
);
setting!(
    Oblique<FixedCost<7, 9>>,
    "simulation/fixed-oblique-1e-6",
    FixedCost::new(black_box(3)).ok().map(|method| Self(method.with_outputs()))
);
setting!(Oblique<Collocation<7, f32>>, "simulation/oblique", Setting::new().map(Self));
setting!(Oblique<Collocation<9, f64>>, "simulation/oblique", Setting::new().map(Self));

/// Normal impacts only.
pub struct NormalContacts<T, M> {
    scene: RingScene<T>,
    method: M,
}

/// Friction and spin, with an output `O`.
pub struct ObliqueContacts<T, M, O> {
    scene: RingScene<T, Coulomb<T>>,
    method: Oblique<M>,
    output: O,
}

impl<T: Number, M: Setting + Method<T>> Scene<T> for NormalContacts<T, M> {
    const NAME: &'static str = M::SCENE;
    const PLANAR: bool = false;
    type Motion = NormalMotion<T>;
    type Verdict = Result<NormalContact<T>, InputError>;

    fn new() -> Option<Self> {
        Some(Self { scene: surface().ok()?, method: M::new()? })
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s).ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.scene.solve_normal(motion, &self.method)
    }

    fn restitution(impact: &Impact) -> Option<f64> {
        exact_restitution(surface(), impact)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| impact.is_normal())
    }
}

impl<T: Number, M: Method<T>, O> Scene<T> for ObliqueContacts<T, M, O>
where
    Oblique<M>: Setting,
    O: Output<T, <Coulomb<T> as Surface<T, PlanarMotion<T>>>::Start> + Copy + Default,
{
    const NAME: &'static str = Oblique::<M>::SCENE;
    const PLANAR: bool = true;
    type Motion = PlanarMotion<T>;
    type Verdict = Result<(SimulatedImpact<T, TangentialVelocities<T>>, O::Result), InputError>;

    fn new() -> Option<Self> {
        let scene = surface().and_then(|surface| surface.with_friction(given(FRICTION))).ok()?;
        Some(Self { scene, method: Setting::new()?, output: O::default() })
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s)
            .and_then(|normal| normal.with_tangential(measured.tangential_m_s))
            .and_then(|oblique| oblique.with_spin(self.scene.sphere(), measured.spin_rad_s))
            .ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.scene.solve_for(motion, &self.method.0, self.output)
    }

    fn restitution(impact: &Impact) -> Option<f64> {
        exact_restitution(surface(), impact)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| !impact.is_normal())
    }
}

pub(super) fn surface<T: Number>() -> Result<RingScene<T>, InputError> {
    surface_of(given(RADIUS_M))
}

/// The surface, and a sphere of the same material with another radius.
pub(super) fn surface_of<T: Number>(radius: T) -> Result<RingScene<T>, InputError> {
    elastic_of(radius)?.with_damping(given(MATERIAL_DAMPING))?.with_ring(given(RING_N_M), given(RING_DAMPING))
}

/// The same without damping and adhesion.
pub(super) fn elastic<T: Number>() -> Result<Contact<T, HertzLaw<T>>, InputError> {
    elastic_of(given(RADIUS_M))
}

fn elastic_of<T: Number>(radius: T) -> Result<Contact<T, HertzLaw<T>>, InputError> {
    let sphere = Sphere::solid(radius, given(DENSITY_KG_M3))?;
    Ok(Contact::hertz(sphere, Stiffness::new(given(STIFFNESS_PA))?))
}

/// Overall restitution in f64, by the most exact method.
pub(super) fn exact_restitution<L: ContactLaw<f64>>(
    scene: Result<Contact<f64, L>, InputError>,
    impact: &Impact,
) -> Option<f64> {
    let method = Collocation::<14, f64>::new(1e-13).ok()?;
    let contact = scene.ok()?.solve_normal(&NormalMotion::new(impact.approach_m_s).ok()?, &method).ok()?;
    Some(contact.overall_restitution())
}

impl<T: Number> From<Result<NormalContact<T>, InputError>> for Answer<T> {
    fn from(verdict: Result<NormalContact<T>, InputError>) -> Self {
        let class = verdict.map_or(REFUSED, |contact| match contact.outcome() {
            Some(Outcome::Rebound) => "rebound",
            Some(Outcome::Capture) => "captured",
            Some(Outcome::Undecided) | None => UNDECIDED,
        });
        answer(class, verdict.ok())
    }
}

impl<T: Number> From<Result<SimulatedImpact<T, TangentialVelocities<T>>, InputError>> for Answer<T> {
    fn from(verdict: Result<SimulatedImpact<T, TangentialVelocities<T>>, InputError>) -> Self {
        let class = verdict.as_ref().map_or(REFUSED, |impact| impact.class().map_or(UNDECIDED, name));
        answer(class, verdict.ok().map(|impact| impact.normal))
    }
}

impl<T: Number, V, O> From<Result<(SimulatedImpact<T, V>, O), InputError>> for Answer<T>
where
    Result<SimulatedImpact<T, V>, InputError>: Into<Self>,
{
    fn from(verdict: Result<(SimulatedImpact<T, V>, O), InputError>) -> Self {
        verdict.map(|(impact, _)| impact).into()
    }
}

fn answer<T: Number>(class: &'static str, contact: Option<NormalContact<T>>) -> Answer<T> {
    let restitution = contact.map(|contact| contact.overall_restitution());
    Answer { class, speed_margin: None, friction_margin: None, restitution }
}

/// Goes through the scenes of the simulation in single precision.
pub fn visit_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f32, NormalContacts<f32, FixedCost<4>>>();
    visitor.visit::<f32, NormalContacts<f32, FixedCost<5>>>();
    visitor.visit::<f32, NormalContacts<f32, FixedCost<7>>>();
    visitor.visit::<f32, ObliqueContacts<f32, FixedCost<5, 7>, ()>>();
    visitor.visit::<f32, ObliqueContacts<f32, FixedCost<7, 9>, ()>>();
    visitor.visit::<f32, NormalContacts<f32, Collocation<5, f32>>>();
    visitor.visit::<f32, NormalContacts<f32, Collocation<7, f32>>>();
    visitor.visit::<f32, ObliqueContacts<f32, Collocation<7, f32>, Slip>>();
}

/// Goes through the scenes of the simulation in double precision.
pub fn visit_double_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f64, NormalContacts<f64, Collocation<9, f64>>>();
    visitor.visit::<f64, ObliqueContacts<f64, Collocation<9, f64>, Slip>>();
}
