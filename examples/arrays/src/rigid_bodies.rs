//! Rows by the rigid-body model.

use std::cell::OnceCell;

use microimpact::rigid::{
    AdhesionCoefficient, AnyAdhesion, AnyRestitution, ElasticPlasticRestitution, EnergyLedger, PowerRestitution,
    ReboundAdhesion, RollingDissipation, SpeedAdhesion, SpeedRestitution, TangentialOutcome, WorkOfAdhesion,
};
use microimpact::space::SpatialMotion;
use microimpact::{
    Class, ConstantRestitution, ContactClass, CriticalSpeed, Impact, InputError, Outcome, Parameter, RestitutionLaw,
    RigidBody, Sphere, TangentialImpact,
};
use rayon::prelude::*;

use crate::impacts::{Answer, departure, fill};
use crate::motions::Arrival;
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
    fn sphere(&self, row: usize) -> Result<Sphere<f64>, InputError> {
        Sphere::new(self.radius.at(row), self.density.at(row), self.gyration_ratio.at(row))
    }

    /// The body of a row with laws of any type.
    fn body<R, A>(&self, sphere: Sphere<f64>, restitution: R, adhesion: A, row: usize) -> Result<Body<R, A>, InputError>
    where
        R: RestitutionLaw<f64>,
        A: ReboundAdhesion<f64>,
    {
        RigidBody::new(sphere, restitution)
            .with_adhesion(adhesion)
            .with_friction(self.friction.at(row))?
            .with_rolling_dissipation(self.rolling_arm.at(row))
    }

    /// Classifies the impacts of `count` rows on all threads. The result of a row is that of a single call.
    pub fn classify(&self, motions: &Motions<'_>, count: usize, quantities: &[Quantity]) -> Impacts {
        match (self.restitution, self.adhesion) {
            // The laws of the paper by their types: a row whose laws are chosen takes a quarter more time.
            (Restitution::Power { speed, power: Column::All(1.0) }, Adhesion::Work(work)) => {
                let restitution = |row| SpeedRestitution::new(speed.at(row));
                let adhesion = |sphere: &_, row| WorkOfAdhesion::new(work.at(row), sphere);
                self.classify_by(motions, count, quantities, restitution, adhesion)
            }
            (restitution, adhesion) => {
                let (restitution, adhesion) = (|row| restitution.at(row), |sphere: &_, row| adhesion.at(sphere, row));
                self.classify_by(motions, count, quantities, restitution, adhesion)
            }
        }
    }

    fn classify_by<R: RestitutionLaw<f64>, A: ReboundAdhesion<f64>>(
        &self,
        motions: &Motions<'_>,
        count: usize,
        quantities: &[Quantity],
        restitution: impl Fn(usize) -> Result<R, InputError> + Sync,
        adhesion: impl Fn(&Sphere<f64>, usize) -> Result<A, InputError> + Sync,
    ) -> Impacts {
        fill(count, quantities, |row, slot| {
            // By reference, because both are large.
            let arrival = motions.arrival(self.sphere(row)?, row);
            let arrival = arrival.as_ref().map_err(|error| *error)?;
            arrival.check_about_one_axis(Parameter::RollingArm, self.rolling_arm.at(row))?;
            let body = self.body(arrival.sphere, restitution(row)?, adhesion(&arrival.sphere, row)?, row);
            let body = body.as_ref().map_err(|error| *error)?;
            slot.put(&Answered::new(arrival, body.impact(&arrival.motion)));
            Ok(())
        })
    }

    /// The critical speed of each of `count` rows.
    pub fn critical_speeds(&self, count: usize) -> Vec<Result<CriticalSpeed<f64>, InputError>> {
        let of = |row: usize| {
            let sphere = self.sphere(row)?;
            let body = self.body(sphere, self.restitution.at(row)?, self.adhesion.at(&sphere, row)?, row)?;
            Ok(body.critical_speed())
        };
        (0..count).into_par_iter().map(of).collect()
    }
}

/// The rigid body of a row.
type Body<R, A> = RigidBody<f64, R, A, RollingDissipation<f64>>;

/// The impact of a row. What follows from it is computed where it is asked for.
struct Answered<'a> {
    arrival: &'a Arrival,
    impact: Impact<f64, TangentialImpact<f64>>,
    outcome: Outcome,
    contact: ContactClass<f64>,
    /// Empty until they are asked for.
    ledger: OnceCell<EnergyLedger<f64>>,
    departure: OnceCell<Vec<SpatialMotion<f64>>>,
}

impl<'a> Answered<'a> {
    #[inline]
    fn new(arrival: &'a Arrival, impact: Impact<f64, TangentialImpact<f64>>) -> Self {
        // Its margin is no quantity, so that no critical speed is computed.
        let outcome = if impact.normal.is_capture() { Outcome::Capture } else { Outcome::Rebound };
        let contact = impact.tangential.classify(outcome);
        Self { arrival, impact, outcome, contact, ledger: OnceCell::new(), departure: OnceCell::new() }
    }

    fn ledger(&self) -> &EnergyLedger<f64> {
        self.ledger.get_or_init(|| self.impact.energy(&self.arrival.sphere))
    }
}

impl Answer for Answered<'_> {
    fn status(&self) -> RowStatus {
        RowStatus::Solved
    }

    fn class(&self) -> Option<Class> {
        Some(Class::of(self.outcome, self.arrival.motion_after(self.contact.motion)))
    }

    fn number(&self, quantity: Quantity) -> f64 {
        let Impact { normal, tangential } = &self.impact;
        match quantity {
            Quantity::OverallRestitution => normal.overall_restitution(),
            Quantity::ReboundSpeed => normal.rebound_speed(),
            Quantity::SpeedTangentialOut => tangential.velocity(),
            Quantity::SpinOut => tangential.spin(&self.arrival.sphere),
            Quantity::FrictionOverLimit => self.contact.friction_over_limit.unwrap_or(f64::NAN),
            Quantity::ImpulseRatioOut => tangential.impulse_ratio(),
            Quantity::RollingRatio => tangential.rolling_ratio(),
            Quantity::WorkMaterial => self.ledger().material,
            Quantity::WorkAdhesion => self.ledger().adhesion,
            Quantity::WorkFriction => self.ledger().friction,
            Quantity::WorkRolling => self.ledger().rolling,
            Quantity::EnergyBefore => self.ledger().before,
            Quantity::EnergyAfter => self.ledger().after,
            other => departure(self.departure.get_or_init(|| self.arrival.after(&self.impact)), other),
        }
    }
}
