//! The scene in which contact is simulated in fixed point, on the surface of Brach & Dunn (1995), Table 1: the set-up in f32,
//! the motion in integers.

use core::hint::black_box;

use microimpact::simulation::{DimensionlessContact, DimensionlessImpact, FixedCost};
use microimpact::{FixedPoint, NormalMotion, Outcome};

use super::contacts::{Surface, UNDECIDED, surface};
use super::impacts::{CONTACTS, Impact};
use super::scenes::{Answer, Measured, Scene, Visitor};

/// Normal impacts only.
pub struct FixedPointContacts {
    scene: Surface<f32>,
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

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| impact.is_normal())
    }
}

impl From<DimensionlessContact<FixedPoint>> for Answer<f32> {
    fn from(contact: DimensionlessContact<FixedPoint>) -> Self {
        let class = match contact.outcome {
            Some(Outcome::Rebound) => "rebound",
            Some(Outcome::Capture) => "captured",
            None => UNDECIDED,
        };
        let restitution = Some(contact.overall_restitution().to_f64() as f32);
        Self { class, speed_margin: None, friction_margin: None, restitution }
    }
}

/// Goes through the scene.
pub(super) fn visit_fixed_contacts(visitor: &mut impl Visitor) {
    visitor.visit::<f32, FixedPointContacts>();
}
