//! Scenes that differ by one term each, so that the difference of their costs is the price of that term: as rigid bodies,
//! simulated by one method of fixed cost, and simulated to a tolerance. All are on the surface of Brach & Dunn (1995),
//! Table 1.

use core::hint::black_box;

use microimpact::contact::{
    Collocation, ConstantForce, Contact, FixedCost, HertzLaw, HertzScene, HystereticDamping, Method, NormalContact,
    PaperScene, Peeling, PhaseSamples, Recording, Ring, RingScene, SimulatedImpact, TangentialVelocities, Trajectory,
};
use microimpact::rigid::{RollingDissipation, WorkOfAdhesion};
use microimpact::{
    Classification, ContactClass, Coulomb, InputError, NoAdhesion, NoFriction, NormalMotion, ObliqueMotion,
    PlanarMotion, RigidBody, SpeedRestitution, Sphere,
};

use super::contacts::{elastic, exact_restitution, surface};
use super::impacts::{CONTACTS, IMPACTS, Impact};
use super::scenes::{Answer, Measured, Number, Scene, Visitor, bare_scene, given};
use super::table_1::{FRICTION, MATERIAL_DAMPING, WORK_OF_ADHESION_J};

const ROLLING_ARM_M: f64 = 2e-8;
const EXTERNAL_FORCE_N: f64 = -1e-5;
const PEELING_N_M: f64 = 2.5e-12;

/// A motion of so many components, and the impacts that have no others.
pub trait Components<T: Number>: Sized {
    /// Whether it knows tangential motion.
    const PLANAR: bool;

    /// The validated motion.
    fn of(measured: &Measured<T>, sphere: &Sphere<T>) -> Result<Self, InputError>;
    /// Whether an impact has no other components.
    fn suit(impact: &Impact) -> bool;
}

impl<T: Number> Components<T> for NormalMotion<T> {
    const PLANAR: bool = false;

    #[inline(always)]
    fn of(measured: &Measured<T>, _: &Sphere<T>) -> Result<Self, InputError> {
        Self::new(measured.approach_m_s)
    }

    fn suit(impact: &Impact) -> bool {
        impact.is_normal()
    }
}

impl<T: Number> Components<T> for ObliqueMotion<T> {
    const PLANAR: bool = true;

    #[inline(always)]
    fn of(measured: &Measured<T>, _: &Sphere<T>) -> Result<Self, InputError> {
        NormalMotion::new(measured.approach_m_s)?.with_tangential(measured.tangential_m_s)
    }

    fn suit(impact: &Impact) -> bool {
        impact.spin_rad_s == 0.0
    }
}

impl<T: Number> Components<T> for PlanarMotion<T> {
    const PLANAR: bool = true;

    #[inline(always)]
    fn of(measured: &Measured<T>, sphere: &Sphere<T>) -> Result<Self, InputError> {
        ObliqueMotion::of(measured, sphere)?.with_spin(sphere, measured.spin_rad_s)
    }

    fn suit(_: &Impact) -> bool {
        true
    }
}

/// A rigid body with adhesion `A` and what happens along the surface, `S`.
type Body<T, A = WorkOfAdhesion<T>, S = NoFriction> = RigidBody<T, SpeedRestitution<T>, A, S>;

/// A damped and adhesive sphere that an external force pulls to the surface.
type Pulled<T> = Contact<T, HertzLaw<T, HystereticDamping<T>, Ring<T>, ConstantForce<T>>>;

/// A scene with a name, from its parts.
macro_rules! variant {
    (
        $(#[$documentation:meta])*
        $name:ident: $label:literal,
        scene: $scene:ty = $new:expr,
        $(by $method:ident: $type:ty = $make:expr,)?
        $(for $output:expr,)?
        impacts: $impacts:ident as $motion:ty,
        $classify:ident -> $verdict:ty,
        $(exact: $exact:expr,)?
        $(where T: $($bound:tt)+)?
    ) => {
        $(#[$documentation])*
        pub struct $name<T $(: $($bound)+)?> {
            scene: $scene,
            $($method: $type,)?
        }

        impl<T: Number $(+ $($bound)+)?> Scene<T> for $name<T> {
            const NAME: &'static str = $label;
            const PLANAR: bool = <$motion as Components<T>>::PLANAR;
            type Motion = $motion;
            type Verdict = $verdict;

            fn new() -> Option<Self> {
                Some(Self { scene: $new.ok()?, $($method: $make.ok()?,)? })
            }

            // What is counted is the library, not a second call around it.
            #[inline(always)]
            fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
                Components::of(measured, self.scene.sphere()).ok()
            }

            #[inline(always)]
            fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
                self.scene.$classify(motion $(, &self.$method)? $(, $output)?)
            }

            $(
                fn restitution(impact: &Impact) -> Option<f64> {
                    exact_restitution($exact, impact)
                }
            )?

            fn impacts() -> impl Iterator<Item = &'static Impact> {
                $impacts.iter().filter(|impact| <$motion as Components<T>>::suit(impact))
            }
        }
    };
}

variant! {
    /// Restitution alone.
    RigidBare: "rigid/bare",
    scene: Body<T, NoAdhesion> = bare_scene(),
    impacts: IMPACTS as NormalMotion<T>,
    classify -> Classification<T, ()>,
}

variant! {
    /// Adhesion too.
    RigidAdhesion: "rigid/adhesion",
    scene: Body<T> = adhesive(),
    impacts: IMPACTS as NormalMotion<T>,
    classify -> Classification<T, ()>,
}

variant! {
    /// Friction, for spheres that do not spin.
    RigidFriction: "rigid/friction",
    scene: Body<T, WorkOfAdhesion<T>, Coulomb<T>> = adhesive().and_then(|scene| scene.with_friction(given(FRICTION))),
    impacts: IMPACTS as ObliqueMotion<T>,
    classify -> Classification<T, ContactClass<T>>,
}

variant! {
    /// Friction and spin.
    RigidSpin: "rigid/spin",
    scene: Body<T, WorkOfAdhesion<T>, Coulomb<T>> = adhesive().and_then(|scene| scene.with_friction(given(FRICTION))),
    impacts: IMPACTS as PlanarMotion<T>,
    classify -> Classification<T, ContactClass<T>>,
}

variant! {
    /// Rolling dissipation too.
    RigidRolling: "rigid/rolling-dissipation",
    scene: Body<T, WorkOfAdhesion<T>, RollingDissipation<T>> = adhesive()
        .and_then(|scene| scene.with_friction(given(FRICTION)))
        .and_then(|scene| scene.with_rolling_dissipation(given(ROLLING_ARM_M))),
    impacts: IMPACTS as PlanarMotion<T>,
    classify -> Classification<T, ContactClass<T>>,
}

/// A scene along the normal, simulated at a fixed cost.
macro_rules! fixed_cost {
    ($(#[$documentation:meta])* $name:ident: $label:literal, $scene:ty = $new:expr) => {
        variant! {
            $(#[$documentation])*
            $name: $label,
            scene: $scene = $new,
            by method: FixedCost<5> = FixedCost::new(black_box(3)),
            impacts: CONTACTS as NormalMotion<T>,
            solve_normal -> Result<NormalContact<T>, InputError>,
            exact: $new,
            where T: PhaseSamples<5, 9>
        }
    };
}

fixed_cost! {
    /// Hertz's force alone.
    FixedCostBare: "fixed-cost/bare", Contact<T, HertzLaw<T>> = elastic()
}

fixed_cost! {
    /// Damping too.
    FixedCostDamping: "fixed-cost/damping", HertzScene<T> = damped()
}

fixed_cost! {
    /// Damping and adhesion.
    FixedCostAdhesion: "fixed-cost/adhesion", RingScene<T> = surface()
}

fixed_cost! {
    /// A constant external force too.
    FixedCostForce: "fixed-cost/force", Pulled<T> = pulled()
}

variant! {
    /// Friction and spin in place of the force.
    FixedCostFriction: "fixed-cost/friction",
    scene: PaperScene<T> = surface().and_then(|scene| scene.with_friction(given(FRICTION))),
    by method: FixedCost<5, 7> = FixedCost::<5>::new(black_box(3)).map(FixedCost::with_outputs),
    impacts: CONTACTS as PlanarMotion<T>,
    solve -> Result<SimulatedImpact<T, TangentialVelocities<T>>, InputError>,
    exact: surface(),
    where T: PhaseSamples<5, 7>
}

/// How exactly a number type is to be simulated: with as many nodes as suit its tolerance.
pub trait Tolerated: Number {
    /// The method.
    type Method: Method<Self>;

    /// The method, validated.
    fn method() -> Result<Self::Method, InputError>;
}

impl Tolerated for f32 {
    type Method = Collocation<7, Self>;

    fn method() -> Result<Self::Method, InputError> {
        Collocation::new(given(1e-6))
    }
}

impl Tolerated for f64 {
    type Method = Collocation<9, Self>;

    fn method() -> Result<Self::Method, InputError> {
        Collocation::new(given(1e-9))
    }
}

variant! {
    /// Friction, spin and a peeling moment.
    CollocationPeeling: "collocation/peeling",
    scene: RingScene<T, Peeling<T>> = surface()
        .and_then(|scene| scene.with_friction(given(FRICTION)))
        .and_then(|scene| scene.with_peeling(given(PEELING_N_M))),
    by method: T::Method = T::method(),
    impacts: CONTACTS as PlanarMotion<T>,
    solve -> Result<SimulatedImpact<T, TangentialVelocities<T>>, InputError>,
    exact: surface(),
    where T: Tolerated
}

/// A scene along the normal, recorded.
macro_rules! recording {
    ($(#[$documentation:meta])* $name:ident: $label:literal, $samples:literal) => {
        variant! {
            $(#[$documentation])*
            $name: $label,
            scene: RingScene<T> = surface(),
            by method: T::Method = T::method(),
            for Recording::<$samples>,
            impacts: CONTACTS as NormalMotion<T>,
            solve_for -> Result<(SimulatedImpact<T, ()>, Trajectory<T, $samples>), InputError>,
            exact: surface(),
            where T: Tolerated
        }
    };
}

recording! {
    /// In 16 samples.
    CollocationRecording16: "collocation/recording-16", 16
}

recording! {
    /// In 32 samples.
    CollocationRecording32: "collocation/recording-32", 32
}

impl<T: Number> From<Result<SimulatedImpact<T, ()>, InputError>> for Answer<T> {
    fn from(verdict: Result<SimulatedImpact<T, ()>, InputError>) -> Self {
        verdict.map(|impact| impact.normal).into()
    }
}

fn adhesive<T: Number>() -> Result<Body<T>, InputError> {
    bare_scene()?.with_work_of_adhesion(given(WORK_OF_ADHESION_J))
}

fn damped<T: Number>() -> Result<HertzScene<T>, InputError> {
    elastic()?.with_damping(given(MATERIAL_DAMPING))
}

fn pulled<T: Number>() -> Result<Pulled<T>, InputError> {
    surface()?.with_external_force(given(EXTERNAL_FORCE_N))
}

/// Goes through the scenes of rigid bodies and of simulations at a fixed cost, in both number types.
pub fn visit_variants(visitor: &mut impl Visitor) {
    visit_variants_of::<f32>(visitor);
    visit_variants_of::<f64>(visitor);
}

fn visit_variants_of<T: Number + PhaseSamples<5, 7> + PhaseSamples<5, 9>>(visitor: &mut impl Visitor) {
    visitor.visit::<T, RigidBare<T>>();
    visitor.visit::<T, RigidAdhesion<T>>();
    visitor.visit::<T, RigidFriction<T>>();
    visitor.visit::<T, RigidSpin<T>>();
    visitor.visit::<T, RigidRolling<T>>();
    visitor.visit::<T, FixedCostBare<T>>();
    visitor.visit::<T, FixedCostDamping<T>>();
    visitor.visit::<T, FixedCostAdhesion<T>>();
    visitor.visit::<T, FixedCostForce<T>>();
    visitor.visit::<T, FixedCostFriction<T>>();
}

/// Goes through the scene with a term that only simulations to a tolerance take, in both number types.
pub fn visit_collocations(visitor: &mut impl Visitor) {
    visit_collocations_of::<f32>(visitor);
    visit_collocations_of::<f64>(visitor);
}

fn visit_collocations_of<T: Tolerated>(visitor: &mut impl Visitor) {
    visitor.visit::<T, CollocationPeeling<T>>();
}

/// Goes through the scenes that record the motion, in both number types.
pub fn visit_recordings(visitor: &mut impl Visitor) {
    visit_recordings_of::<f32>(visitor);
    visit_recordings_of::<f64>(visitor);
}

fn visit_recordings_of<T: Tolerated>(visitor: &mut impl Visitor) {
    visitor.visit::<T, CollocationRecording16<T>>();
    visitor.visit::<T, CollocationRecording32<T>>();
}
