//! A scene for each law of contact and each damping, so that their costs can be compared: normal impacts in f32. Sphere and
//! stiffness are those of Brach & Dunn (1995), Table 1.

use core::marker::PhantomData;

use microimpact::contact::{
    Adaptive, ConstantDamping, Contact, ContactLaw, Dmt, FixedCost, HertzLaw, HystereticDamping, JkrLaw, Method,
    NoDamping, NoTension, NormalContact, Ring, ViscoelasticDamping,
};
use microimpact::{InputError, NoAdhesion, NormalMotion, Stiffness};

use super::contacts::exact_restitution;
use super::impacts::{CONTACTS, Impact};
use super::scenes::{Measured, Number, Scene, Visitor, given, sphere};
use super::table_1::{MATERIAL_DAMPING, RING_DAMPING, RING_N_M, STIFFNESS_PA};

/// With it the contact of Johnson, Kendall and Roberts captures the slowest sphere, as the ring of the paper does.
const WORK_OF_ADHESION_J_M2: f64 = 4.0;
const RELAXATION_TIME_S: f64 = 2e-10;
const NOMINAL_RESTITUTION: f64 = 0.95;

/// A law of contact and its parameters.
pub trait Law: ContactLaw<f32> {
    /// Names of its scenes, by method.
    const NAMES: [&'static str; 2];

    /// The law on the sphere, validated.
    fn scene() -> Result<Contact<f32, Self>, InputError>;
    /// Overall restitution to some twelve digits.
    fn restitution(impact: &Impact) -> Option<f64>;
}

/// A method that the compiler knows with its setting, as in most firmware: it leaves out what other settings need.
pub trait Solver {
    /// Its place among the names of a law's scenes.
    const PLACE: usize;

    /// The method, validated.
    fn method() -> Result<impl Method<f32>, InputError>;
}

/// `Adaptive` at the tolerance of f32.
pub struct Tolerance;

/// `FixedCost` by seven nodes.
pub struct Fixed;

impl Solver for Tolerance {
    const PLACE: usize = 0;

    #[inline(always)]
    fn method() -> Result<impl Method<f32>, InputError> {
        Adaptive::new(1e-6)
    }
}

impl Solver for Fixed {
    const PLACE: usize = 1;

    #[inline(always)]
    fn method() -> Result<impl Method<f32>, InputError> {
        FixedCost::<7>::new(3)
    }
}

/// Normal impacts with a law, solved by a method.
pub struct LawScene<L, M>(Contact<f32, L>, PhantomData<M>);

impl<L: Law, M: Solver> Scene<f32> for LawScene<L, M> {
    const NAME: &'static str = L::NAMES[M::PLACE];
    const PLANAR: bool = false;
    type Motion = NormalMotion<f32>;
    type Verdict = Result<NormalContact<f32>, InputError>;

    fn new() -> Option<Self> {
        Some(Self(L::scene().ok()?, PhantomData))
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<f32>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s).ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.0.solve_normal(motion, &M::method()?)
    }

    fn restitution(impact: &Impact) -> Option<f64> {
        L::restitution(impact)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| impact.is_normal())
    }
}

type Hertz<T, D> = HertzLaw<T, D, NoAdhesion>;
type WithoutTension<T, D> = HertzLaw<T, D, NoTension>;
type WithRing<T, D> = HertzLaw<T, D, Ring<T>>;
type WithDmt<T, D> = HertzLaw<T, D, Dmt<T>>;

/// A law a line: the name of its scenes, the methods that solve it, its type and how it is made.
macro_rules! laws {
    ($($name:literal by $($method:ident),+: $law:ty = $new:expr;)*) => {
        $(
            impl Law for $law {
                const NAMES: [&'static str; 2] = [concat!("law/", $name), concat!("law-fixed-cost/", $name)];

                fn scene() -> Result<Contact<f32, Self>, InputError> {
                    Ok(Contact::new(sphere()?, $new))
                }

                fn restitution(impact: &Impact) -> Option<f64> {
                    let scene = || Ok(Contact::new(sphere()?, $new));
                    exact_restitution(scene(), impact)
                }
            }
        )*

        /// The scenes of all laws: the name of each, and what a visitor does there.
        pub const fn laws<V: Visitor>() -> &'static [(&'static str, fn(&mut V))] {
            const { &[$($(law_scene!(V, $law, $method)),+),*] }
        }
    };
}

macro_rules! law_scene {
    ($visitor:ty, $law:ty, $method:ty) => {
        (LawScene::<$law, $method>::NAME, <$visitor>::visit::<f32, LawScene<$law, $method>>)
    };
}

laws! {
    "hertz" by Tolerance, Fixed: Hertz<f32, NoDamping> = hertz()?;
    "hertz-hysteretic" by Tolerance, Fixed: Hertz<f32, HystereticDamping<f32>> =
        hertz()?.with_damping(given(MATERIAL_DAMPING))?;
    "hertz-viscoelastic" by Tolerance, Fixed: Hertz<f32, ViscoelasticDamping<f32>> =
        hertz()?.with_viscoelastic_damping(given(RELAXATION_TIME_S))?;
    "hertz-constant" by Tolerance, Fixed: Hertz<f32, ConstantDamping<f32>> =
        hertz()?.with_constant_damping(given(NOMINAL_RESTITUTION))?;
    "hertz-viscoelastic-without-tension" by Tolerance: WithoutTension<f32, ViscoelasticDamping<f32>> =
        hertz()?.with_viscoelastic_damping(given(RELAXATION_TIME_S))?.without_tension();
    "ring-hysteretic" by Tolerance, Fixed: WithRing<f32, HystereticDamping<f32>> =
        hertz()?.with_ring(given(RING_N_M), given(RING_DAMPING))?.with_damping(given(MATERIAL_DAMPING))?;
    "dmt" by Tolerance, Fixed: WithDmt<f32, NoDamping> = hertz()?.with_dmt(given(WORK_OF_ADHESION_J_M2))?;
    "dmt-viscoelastic" by Tolerance, Fixed: WithDmt<f32, ViscoelasticDamping<f32>> =
        hertz()?.with_dmt(given(WORK_OF_ADHESION_J_M2))?.with_viscoelastic_damping(given(RELAXATION_TIME_S))?;
    "jkr" by Tolerance: JkrLaw<f32, NoDamping> = jkr()?;
    "jkr-hysteretic" by Tolerance: JkrLaw<f32, HystereticDamping<f32>> = jkr()?.with_damping(given(MATERIAL_DAMPING))?;
    "jkr-viscoelastic" by Tolerance: JkrLaw<f32, ViscoelasticDamping<f32>> =
        jkr()?.with_viscoelastic_damping(given(RELAXATION_TIME_S))?;
    "jkr-constant" by Tolerance: JkrLaw<f32, ConstantDamping<f32>> =
        jkr()?.with_constant_damping(given(NOMINAL_RESTITUTION))?;
}

/// Goes through the scenes of all laws.
pub fn visit_laws<V: Visitor + 'static>(visitor: &mut V) {
    for (_, visit) in laws::<V>() {
        visit(visitor);
    }
}

/// What a visitor does in the scene at a place in their list, by its digits, or in the first.
pub const fn chosen<V: Visitor + 'static>(place: Option<&str>) -> fn(&mut V) {
    match place {
        Some(place) => match usize::from_str_radix(place, 10) {
            Ok(place) => laws()[place].1,
            Err(_) => panic!("the place is no number"),
        },
        None => laws()[0].1,
    }
}

fn hertz<T: Number>() -> Result<HertzLaw<T>, InputError> {
    stiffness().map(HertzLaw::new)
}

fn jkr<T: Number>() -> Result<JkrLaw<T>, InputError> {
    JkrLaw::new(stiffness()?, given(WORK_OF_ADHESION_J_M2))
}

fn stiffness<T: Number>() -> Result<Stiffness<T>, InputError> {
    Stiffness::new(given(STIFFNESS_PA))
}
