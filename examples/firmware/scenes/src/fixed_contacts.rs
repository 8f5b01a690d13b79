//! The scenes in fixed point, with the sphere and surface of Brach & Dunn (1995), Table 1: rigid bodies and a simulated
//! contact, set up in f32 and then in integers.

use core::hint::black_box;

use microimpact::contact::{
    DimensionlessContact, DimensionlessImpact, FixedCost, RingScene, SimulatedImpact, TangentialVelocities,
};
use microimpact::rigid::WorkOfAdhesion;
use microimpact::{
    Classification, ContactClass, Coulomb, FixedPoint, InFixedPoint, InputError, NormalMotion, Outcome, PlanarMotion,
    RigidBody, SpeedRestitution,
};

use super::contacts::{REFUSED, exact_restitution, surface};
use super::impacts::{CONTACTS, Impact};
use super::scenes::{Answer, Measured, Normal, Planar, Scene, UNDECIDED, Visitor, given, name};
use super::table_1::FRICTION;

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

/// A simulated contact with friction and spin, in integers from the measured velocities on.
pub struct FixedPointObliqueContacts {
    wide: RingScene<f32, Coulomb<f32>>,
    scene: RingScene<FixedPoint, Coulomb<FixedPoint>>,
    method: FixedCost<4, 6>,
}

impl Scene<f32> for FixedPointObliqueContacts {
    const NAME: &'static str = "simulation/fixed-point-oblique";
    const PLANAR: bool = true;
    type Motion = PlanarMotion<FixedPoint>;
    type Verdict = Result<SimulatedImpact<FixedPoint, TangentialVelocities<FixedPoint>>, InputError>;

    fn new() -> Option<Self> {
        let wide = surface().and_then(|surface| surface.with_friction(given(FRICTION))).ok()?;
        let scene = wide.in_fixed_point(black_box(UNIT_M_S)).ok()?;
        Some(Self { wide, scene, method: FixedCost::new(black_box(2)).ok()?.with_outputs() })
    }

    fn motion(&self, measured: &Measured<f32>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s)
            .and_then(|normal| normal.with_tangential(measured.tangential_m_s))
            .and_then(|oblique| oblique.with_spin(self.wide.sphere(), measured.spin_rad_s))
            .and_then(|motion| motion.in_fixed_point(black_box(UNIT_M_S)))
            .ok()
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        self.scene.solve(motion, &self.method)
    }

    fn restitution(impact: &Impact) -> Option<f64> {
        exact_restitution(surface(), impact)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| !impact.is_normal())
    }
}

impl From<Result<SimulatedImpact<FixedPoint, TangentialVelocities<FixedPoint>>, InputError>> for Answer<f32> {
    fn from(verdict: Result<SimulatedImpact<FixedPoint, TangentialVelocities<FixedPoint>>, InputError>) -> Self {
        let Ok(impact) = verdict else {
            return Self { class: REFUSED, speed_margin: None, friction_margin: None, restitution: None };
        };
        let narrow = |value: FixedPoint| value.to_f64() as f32;
        Self {
            class: impact.class().map_or(UNDECIDED, name),
            speed_margin: None,
            friction_margin: impact.tangential.friction_over_limit().map(narrow),
            restitution: Some(narrow(impact.normal.overall_restitution())),
        }
    }
}

/// Goes through the scenes that are set up in floating point, the units of each impact too.
pub(super) fn visit_fixed_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f32, FixedPointNormal>();
    visitor.visit::<f32, FixedPointPlanar>();
    visitor.visit::<f32, FixedPointContacts>();
}

/// Goes through those that are in integers from the measured velocities on.
pub fn visit_oblique_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f32, FixedPointObliqueContacts>();
}
