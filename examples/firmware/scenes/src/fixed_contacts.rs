//! The scenes in fixed point, with the sphere and surface of Brach & Dunn (1995), Table 1: rigid bodies and a simulated
//! contact, set up in f32 and then in integers.

use core::hint::black_box;

use microimpact::contact::{DimensionlessContact, DimensionlessImpact, FixedCost, RingScene};
use microimpact::rigid::WorkOfAdhesion;
use microimpact::{
    Classification, ContactClass, Coulomb, FixedPoint, InFixedPoint, NormalMotion, Outcome, PlanarMotion, RigidBody,
    SpeedRestitution,
};

use super::contacts::{exact_restitution, surface};
use super::impacts::{CONTACTS, Impact};
use super::scenes::{Answer, Measured, Normal, Planar, Scene, UNDECIDED, Visitor};

/// Unit of speed of the rigid bodies.
const UNIT_M_S: f32 = 4.0;

/// A rigid body with normal impacts only.
pub struct FixedPointNormal {
    wide: Normal<f32, WorkOfAdhesion<f32>>,
    scene: RigidBody<FixedPoint, SpeedRestitution<FixedPoint>, WorkOfAdhesion<FixedPoint>>,
}

/// A rigid body with friction and spin.
pub struct FixedPointPlanar {
    wide: Planar<f32, WorkOfAdhesion<f32>>,
    scene: RigidBody<FixedPoint, SpeedRestitution<FixedPoint>, WorkOfAdhesion<FixedPoint>, Coulomb<FixedPoint>>,
}

macro_rules! rigid_scene {
    ($scene:ident, $wide:ident, $name:literal, $planar:literal, $motion:ident, $contact:ty) => {
        impl Scene<f32> for $scene {
            const NAME: &'static str = $name;
            const PLANAR: bool = $planar;
            type Motion = $motion<FixedPoint>;
            type Verdict = Classification<FixedPoint, $contact>;

            fn new() -> Option<Self> {
                let wide = $wide::new()?;
                let scene = wide.0.in_fixed_point(black_box(UNIT_M_S)).ok()?;
                Some(Self { wide, scene })
            }

            fn motion(&self, measured: &Measured<f32>) -> Option<Self::Motion> {
                self.wide.motion(measured)?.in_fixed_point(black_box(UNIT_M_S)).ok()
            }

            // What is counted is the library, not a second call around it.
            #[inline(always)]
            fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
                self.scene.classify(motion)
            }
        }

        impl From<Classification<FixedPoint, $contact>> for Answer<f32> {
            fn from(verdict: Classification<FixedPoint, $contact>) -> Self {
                let Answer { class, speed_margin, friction_margin, restitution } = Answer::<FixedPoint>::from(verdict);
                let [speed_margin, friction_margin, restitution] = [speed_margin, friction_margin, restitution]
                    .map(|number| number.map(|value| value.to_f64() as f32));
                Self { class, speed_margin, friction_margin, restitution }
            }
        }
    };
}

rigid_scene!(FixedPointNormal, Normal, "normal/work-fixed-point", false, NormalMotion, ());
rigid_scene!(FixedPointPlanar, Planar, "planar/work-fixed-point", true, PlanarMotion, ContactClass<FixedPoint>);

/// A simulated contact with normal impacts only.
pub struct FixedPointContacts {
    scene: RingScene<f32>,
    method: FixedCost<4>,
}

impl Scene<f32> for FixedPointContacts {
    const NAME: &'static str = "simulation/fixed-point";
    const PLANAR: bool = false;
    type Motion = DimensionlessImpact<FixedPoint>;
    type Verdict = DimensionlessContact<FixedPoint>;

    fn new() -> Option<Self> {
        Some(Self { scene: surface().ok()?, method: FixedCost::new(black_box(2)).ok()? })
    }

    fn motion(&self, measured: &Measured<f32>) -> Option<Self::Motion> {
        let motion = NormalMotion::new(measured.approach_m_s).ok()?;
        self.scene.dimensionless(&motion).and_then(|impact| impact.in_fixed_point()).ok()
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        motion.solve(&self.method)
    }

    fn restitution(impact: &Impact) -> Option<f64> {
        exact_restitution(surface(), impact)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| impact.is_normal())
    }
}

impl From<DimensionlessContact<FixedPoint>> for Answer<f32> {
    fn from(contact: DimensionlessContact<FixedPoint>) -> Self {
        let class = match contact.outcome {
            Some(Outcome::Rebound) => "rebound",
            Some(Outcome::Capture) => "captured",
            Some(Outcome::Undecided) | None => UNDECIDED,
        };
        let restitution = Some(contact.overall_restitution().to_f64() as f32);
        Self { class, speed_margin: None, friction_margin: None, restitution }
    }
}

/// Goes through the scenes.
pub(super) fn visit_fixed_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f32, FixedPointNormal>();
    visitor.visit::<f32, FixedPointPlanar>();
    visitor.visit::<f32, FixedPointContacts>();
}
