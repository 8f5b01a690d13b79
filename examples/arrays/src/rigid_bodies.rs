//! Rows by the rigid-body model.

use std::cell::OnceCell;

use microimpact::rigid::{
    AdhesionCoefficient, AnyAdhesion, AnyRestitution, ElasticPlasticRestitution, EnergyLedger, PowerRestitution,
    ReboundAdhesion, RollingDissipation, SpeedAdhesion, SpeedRestitution, TangentialOutcome, TangentialTerm,
    WorkOfAdhesion,
};
use microimpact::{
    Class, ConstantRestitution, ContactClass, CriticalSpeed, Impact, InputError, Outcome, Parameter, PlanarMotion,
    RestitutionLaw, RigidBody, Sphere, TangentialImpact,
};
use rayon::prelude::*;

use crate::departure::Departure;
use crate::impacts::{Answer, fill};
use crate::motions::{Arrival, Place, in_plane};
use crate::{Column, Impacts, Motions, Quantity, RowStatus};

/// Spheres and the physics of their impacts as rigid bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBodies<'a> {
    /// Radius, m.
    pub radius: Column<'a>,
    /// Density, kg/m^3.
    pub density: Column<'a>,
    /// Squared radius of gyration over the squared radius; 0.4 for a solid sphere.
    pub gyration_ratio: Column<'a>,
    /// Restitution without adhesion.
    pub restitution: Restitution<'a>,
    /// Adhesion.
    pub adhesion: Adhesion<'a>,
    /// Friction coefficient f.
    pub friction: Column<'a>,
    /// Rolling-dissipation coefficient times its moment arm, m. Only in a plane.
    pub rolling_arm: Column<'a>,
}

/// Restitution R without adhesion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Restitution<'a> {
    /// The same at every speed.
    Constant(Column<'a>),
    /// R = k^p/(k^p + v^p); with p = 1 the law of the paper.
    Power {
        /// Speed k, m/s.
        speed: Column<'a>,
        /// Power p.
        power: Column<'a>,
    },
    /// That of an elastic-plastic sphere (Thornton 1997), by the speed of first yield, m/s.
    ElasticPlastic(Column<'a>),
}

/// Adhesion of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Adhesion<'a> {
    /// Coefficient rho; zero for none.
    Coefficient(Column<'a>),
    /// Work W_A, J.
    Work(Column<'a>),
    /// A coefficient rho = l^q/(l^q + v^q).
    Speed {
        /// Speed l, m/s.
        speed: Column<'a>,
        /// Power q.
        power: Column<'a>,
    },
}

impl Restitution<'_> {
    /// The law of a row.
    ///
    /// # Errors
    /// A number outside its range.
    pub fn at(&self, row: usize) -> Result<AnyRestitution<f64>, InputError> {
        match self {
            Self::Constant(restitution) => ConstantRestitution::new(restitution.at(row)).map(Into::into),
            // The law of the paper needs no powers.
            Self::Power { speed, power } if power.at(row) == 1.0 => {
                SpeedRestitution::new(speed.at(row)).map(Into::into)
            }
            Self::Power { speed, power } => PowerRestitution::new(speed.at(row), power.at(row)).map(Into::into),
            Self::ElasticPlastic(speed) => ElasticPlasticRestitution::new(speed.at(row)).map(Into::into),
        }
    }
}

impl Adhesion<'_> {
    /// The adhesion of a row on its sphere.
    ///
    /// # Errors
    /// A number outside its range.
    pub fn at(&self, sphere: &Sphere<f64>, row: usize) -> Result<AnyAdhesion<f64>, InputError> {
        match self {
            Self::Coefficient(rho) => AdhesionCoefficient::new(rho.at(row)).map(Into::into),
            Self::Work(work) => WorkOfAdhesion::new(work.at(row), sphere).map(Into::into),
            Self::Speed { speed, power } => SpeedAdhesion::new(speed.at(row), power.at(row)).map(Into::into),
        }
    }
}

impl RigidBodies<'_> {
    /// The sphere of a row.
    #[inline]
    fn sphere(&self, row: usize) -> Result<Sphere<f64>, InputError> {
        Sphere::new(self.radius.at(row), self.density.at(row), self.gyration_ratio.at(row))
    }

    /// The body of a row.
    fn body(&self, sphere: Sphere<f64>, row: usize) -> Result<Body, InputError> {
        RigidBody::new(sphere, self.restitution.at(row)?)
            .with_adhesion(self.adhesion.at(&sphere, row)?)
            .with_friction(self.friction.at(row))?
            .with_rolling_dissipation(self.rolling_arm.at(row))
    }

    /// Classifies the impacts of `count` rows on all threads. The result of a row is that of a single call.
    pub fn classify(&self, motions: &Motions<'_>, count: usize, quantities: &[Quantity]) -> Impacts {
        match (self.restitution, self.adhesion, self.rolling_arm) {
            // The laws of the paper by their types: a row whose laws are chosen takes half as much time again.
            (Restitution::Power { speed, power: Column::All(1.0) }, Adhesion::Work(work), Column::All(0.0)) => self
                .classify_by(motions, count, quantities, |sphere, row| {
                    RigidBody::new(sphere, SpeedRestitution::new(speed.at(row))?)
                        .with_adhesion(WorkOfAdhesion::new(work.at(row), &sphere)?)
                        .with_friction(self.friction.at(row))
                }),
            _ => self.classify_by(motions, count, quantities, |sphere, row| self.body(sphere, row)),
        }
    }

    fn classify_by<R, A, S>(
        &self,
        motions: &Motions<'_>,
        count: usize,
        quantities: &[Quantity],
        body: impl Fn(Sphere<f64>, usize) -> Result<RigidBody<f64, R, A, S>, InputError> + Sync,
    ) -> Impacts
    where
        R: RestitutionLaw<f64>,
        A: ReboundAdhesion<f64>,
        S: TangentialTerm<f64, PlanarMotion<f64>, Impact = TangentialImpact<f64>>,
    {
        match motions {
            // Apart from motions in space, which are large.
            Motions::Planar { speed_normal, speed_tangential, spin } => fill(count, quantities, |row, slot| {
                let sphere = self.sphere(row)?;
                let before = in_plane([speed_normal, speed_tangential, spin], &sphere, |column| column.at(row))?;
                slot.put(&Answered::new(&sphere, &Place::Plane, &body(sphere, row)?.impact(&before)));
                Ok(())
            }),
            _ => fill(count, quantities, |row, slot| {
                let Arrival { sphere, motion, place } = motions.arrival(self.sphere(row)?, row)?;
                place.check_about_one_axis(Parameter::RollingArm, self.rolling_arm.at(row))?;
                slot.put(&Answered::new(&sphere, &place, &body(sphere, row)?.impact(&motion)));
                Ok(())
            }),
        }
    }

    /// The critical speed of each of `count` rows.
    pub fn critical_speeds(&self, count: usize) -> Vec<Result<CriticalSpeed<f64>, InputError>> {
        let of = |row: usize| {
            let sphere = self.sphere(row)?;
            Ok(self.body(sphere, row)?.critical_speed())
        };
        (0..count).into_par_iter().map(of).collect()
    }
}

/// The rigid body of a row, with laws of any type.
type Body = RigidBody<f64, AnyRestitution<f64>, AnyAdhesion<f64>, RollingDissipation<f64>>;

/// The impact of a row. What follows from it is computed where it is asked for.
struct Answered<'a> {
    sphere: &'a Sphere<f64>,
    place: &'a Place,
    impact: &'a Impact<f64, TangentialImpact<f64>>,
    outcome: Outcome,
    contact: ContactClass<f64>,
    /// Empty until they are asked for.
    ledger: OnceCell<EnergyLedger<f64>>,
    departure: Departure,
}

impl<'a> Answered<'a> {
    #[inline]
    fn new(sphere: &'a Sphere<f64>, place: &'a Place, impact: &'a Impact<f64, TangentialImpact<f64>>) -> Self {
        // Its margin is no quantity, so that no critical speed is computed.
        let outcome = if impact.normal.is_capture() { Outcome::Capture } else { Outcome::Rebound };
        let contact = impact.tangential.classify(outcome);
        Self { sphere, place, impact, outcome, contact, ledger: OnceCell::new(), departure: Departure::default() }
    }

    /// A quantity that is computed from the impact.
    #[inline(never)]
    fn computed(&self, quantity: Quantity) -> f64 {
        let ledger = || self.ledger.get_or_init(|| self.impact.energy(self.sphere));
        match quantity {
            Quantity::WorkMaterial => ledger().material,
            Quantity::WorkAdhesion => ledger().adhesion,
            Quantity::WorkFriction => ledger().friction,
            Quantity::WorkRolling => ledger().rolling,
            Quantity::EnergyBefore => ledger().before,
            Quantity::EnergyAfter => ledger().after,
            other => self.departure.number(other, self.place, self.impact).unwrap_or(f64::NAN),
        }
    }
}

impl Answer for Answered<'_> {
    #[inline]
    fn status(&self) -> RowStatus {
        RowStatus::Solved
    }

    #[inline]
    fn class(&self) -> Option<Class> {
        Some(Class::of(self.outcome, self.place.motion_after(self.contact.motion)))
    }

    #[inline]
    fn number(&self, quantity: Quantity) -> f64 {
        let Impact { normal, tangential } = self.impact;
        match quantity {
            Quantity::OverallRestitution => normal.overall_restitution(),
            Quantity::ReboundSpeed => normal.rebound_speed(),
            Quantity::SpeedTangentialOut => tangential.velocity(),
            Quantity::SpinOut => tangential.spin(self.sphere),
            Quantity::FrictionOverLimit => self.contact.friction_over_limit.unwrap_or(f64::NAN),
            Quantity::ImpulseRatioOut => tangential.impulse_ratio(),
            Quantity::RollingRatio => tangential.rolling_ratio(),
            other => self.computed(other),
        }
    }
}
