//! The scenes in which the impacts are classified as rigid bodies, with the sphere of Brach & Dunn (1995), Table 1: normal
//! impacts only, or friction and spin, each with adhesion given in either way, in f32 and in f64.

use core::fmt::LowerExp;
use core::hint::black_box;

use microimpact::contact::FixedCost;
use microimpact::rigid::{AdhesionCoefficient, ReboundAdhesion, WorkOfAdhesion};
use microimpact::{
    Class, Classification, ContactClass, Coulomb, InputError, NormalMotion, Outcome, PlanarMotion, Real, RigidBody,
    SpeedRestitution, Sphere,
};

use super::approximate::Approximate;
use super::contacts::NormalContacts;
use super::fixed_contacts::visit_fixed_contacts;
use super::impacts::{IMPACTS, Impact};
use super::table_1::{
    ADHESION_COEFFICIENT, DENSITY_KG_M3, FRICTION, RADIUS_M, RESTITUTION_SPEED_M_S, WORK_OF_ADHESION_J,
};
use super::tables::visit_tables;
use super::uncertain::visit_uncertain;

/// A number type of the comparison.
pub trait Number: Real + LowerExp {
    /// Its name in tables.
    const NAME: &'static str;
}

impl Number for f32 {
    const NAME: &'static str = "f32";
}

impl Number for f64 {
    const NAME: &'static str = "f64";
}

impl Number for Approximate {
    const NAME: &'static str = "micromath";
}

/// What an instrument measures before an impact.
#[derive(Debug, Clone, Copy)]
pub struct Measured<T> {
    /// Approach speed in m/s.
    pub approach_m_s: T,
    /// Tangential velocity in m/s.
    pub tangential_m_s: T,
    /// Spin in rad/s.
    pub spin_rad_s: T,
}

impl<T: Number> From<&Impact> for Measured<T> {
    fn from(impact: &Impact) -> Self {
        Self {
            approach_m_s: T::constant(impact.approach_m_s),
            tangential_m_s: T::constant(impact.tangential_m_s),
            spin_rad_s: T::constant(impact.spin_rad_s),
        }
    }
}

/// A verdict in the form in which the firmware prints it and the host compares it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer<T> {
    /// One word for how the impact ends.
    pub class: &'static str,
    /// Approach speed over critical speed, where there is one.
    pub speed_margin: Option<T>,
    /// Friction over the impulse ratio that ends sliding, where there is one.
    pub friction_margin: Option<T>,
    /// Overall restitution, where it has been simulated.
    pub restitution: Option<T>,
}

/// A scene, and the steps of its use.
pub trait Scene<T: Number>: Sized {
    /// Its name in tables.
    const NAME: &'static str;
    /// Whether it knows tangential motion and spin.
    const PLANAR: bool;
    /// A validated motion.
    type Motion;
    /// What the library says of an impact.
    type Verdict: Into<Answer<T>>;

    /// The scene, validated.
    fn new() -> Option<Self>;
    /// The validated motion.
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion>;
    /// The classification itself.
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict;

    /// Overall restitution to some twelve digits, where it is simulated.
    fn restitution(_impact: &Impact) -> Option<f64> {
        None
    }

    /// The impacts that suit this scene.
    fn impacts() -> impl Iterator<Item = &'static Impact> {
        IMPACTS.iter().filter(|impact| Self::PLANAR || impact.is_normal())
    }
}

/// Normal impacts only.
pub struct Normal<T, A>(pub(super) RigidBody<T, SpeedRestitution<T>, A>);

/// Friction and spin.
pub struct Planar<T, A>(pub(super) RigidBody<T, SpeedRestitution<T>, A, Coulomb<T>>);

impl<T: Number, A: Adhesion<T>> Scene<T> for Normal<T, A> {
    const NAME: &'static str = A::NORMAL_SCENE;
    const PLANAR: bool = false;
    type Motion = NormalMotion<T>;
    type Verdict = Classification<T, ()>;

    fn new() -> Option<Self> {
        A::scene().map(Self)
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s).ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.0.classify(motion)
    }
}

impl<T: Number, A: Adhesion<T>> Scene<T> for Planar<T, A> {
    const NAME: &'static str = A::PLANAR_SCENE;
    const PLANAR: bool = true;
    type Motion = PlanarMotion<T>;
    type Verdict = Classification<T, ContactClass<T>>;

    fn new() -> Option<Self> {
        A::scene()?.with_friction(given(FRICTION)).ok().map(Self)
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s)
            .and_then(|normal| normal.with_tangential(measured.tangential_m_s))
            .and_then(|oblique| oblique.with_spin(self.0.sphere(), measured.spin_rad_s))
            .ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.0.classify(motion)
    }
}

/// A way to give the adhesion of a scene.
pub trait Adhesion<T: Number>: ReboundAdhesion<T> + Sized {
    /// Name of the scene with normal impacts only.
    const NORMAL_SCENE: &'static str;
    /// Name of the scene with friction and spin.
    const PLANAR_SCENE: &'static str;

    /// The scene with nothing but this adhesion.
    fn scene() -> Option<RigidBody<T, SpeedRestitution<T>, Self>>;
}

impl<T: Number> Adhesion<T> for AdhesionCoefficient<T> {
    const NORMAL_SCENE: &'static str = "normal/coefficient";
    const PLANAR_SCENE: &'static str = "planar/coefficient";

    fn scene() -> Option<RigidBody<T, SpeedRestitution<T>, Self>> {
        bare_scene().and_then(|scene| scene.with_adhesion_coefficient(given(ADHESION_COEFFICIENT))).ok()
    }
}

impl<T: Number> Adhesion<T> for WorkOfAdhesion<T> {
    const NORMAL_SCENE: &'static str = "normal/work";
    const PLANAR_SCENE: &'static str = "planar/work";

    fn scene() -> Option<RigidBody<T, SpeedRestitution<T>, Self>> {
        bare_scene().and_then(|scene| scene.with_work_of_adhesion(given(WORK_OF_ADHESION_J))).ok()
    }
}

pub(super) fn bare_scene<T: Number>() -> Result<RigidBody<T, SpeedRestitution<T>>, InputError> {
    Ok(RigidBody::new(sphere()?, SpeedRestitution::new(given(RESTITUTION_SPEED_M_S))?))
}

pub(super) fn sphere<T: Number>() -> Result<Sphere<T>, InputError> {
    Sphere::solid(given(RADIUS_M), given(DENSITY_KG_M3))
}

/// A number that the compiler does not know, as if it were read from a configuration:
/// without this it would do the work of the scene beforehand and measure nothing.
pub(super) fn given<T: Number>(number: f64) -> T {
    black_box(T::constant(number))
}

/// The class where a method does not converge or decide.
pub const UNDECIDED: &str = "undecided";

impl<T> From<Classification<T, ()>> for Answer<T> {
    fn from(verdict: Classification<T, ()>) -> Self {
        Self {
            class: match verdict.outcome {
                Outcome::Rebound => "rebound",
                Outcome::Capture => "captured",
                Outcome::Undecided => UNDECIDED,
            },
            speed_margin: verdict.speed_over_critical,
            friction_margin: None,
            restitution: None,
        }
    }
}

impl<T> From<Classification<T, ContactClass<T>>> for Answer<T> {
    fn from(verdict: Classification<T, ContactClass<T>>) -> Self {
        Self {
            class: name(verdict.class()),
            speed_margin: verdict.speed_over_critical,
            friction_margin: verdict.contact.friction_over_limit,
            restitution: None,
        }
    }
}

/// Name of the class of an oblique impact.
pub(super) fn name(class: Class) -> &'static str {
    match class {
        Class::ReboundSliding => "rebound-sliding",
        Class::ReboundRolling => "rebound-rolling",
        Class::CapturedSliding => "captured-sliding",
        Class::CapturedRolling => "captured-rolling",
        Class::CapturedResting => "captured-resting",
        Class::Undecided => UNDECIDED,
    }
}

/// Work to do for every scene and number type.
pub trait Visitor {
    /// Does it for one of them.
    fn visit<T: Number, S: Scene<T>>(&mut self);
}

/// Goes through the scenes of the rigid body in both number types, and those of fixed point, of tables and of class
/// probabilities.
pub fn visit_scenes(visitor: &mut impl Visitor) {
    visit_scenes_of::<f32>(visitor);
    visit_scenes_of::<f64>(visitor);
    visit_fixed_contacts(visitor);
    visit_tables(visitor);
    visit_uncertain(visitor);
    visit_approximate(visitor);
}

/// Goes through the scenes that show what approximate functions would save.
fn visit_approximate(visitor: &mut impl Visitor) {
    visitor.visit::<Approximate, Planar<Approximate, WorkOfAdhesion<Approximate>>>();
    visitor.visit::<Approximate, NormalContacts<Approximate, FixedCost<4>>>();
}

fn visit_scenes_of<T: Number>(visitor: &mut impl Visitor) {
    visitor.visit::<T, Normal<T, AdhesionCoefficient<T>>>();
    visitor.visit::<T, Normal<T, WorkOfAdhesion<T>>>();
    visitor.visit::<T, Planar<T, AdhesionCoefficient<T>>>();
    visitor.visit::<T, Planar<T, WorkOfAdhesion<T>>>();
}
