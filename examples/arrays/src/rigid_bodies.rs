//! Rows by the rigid-body model.

use std::cell::OnceCell;

use microimpact::rigid::{
    AdhesionCoefficient, AnyAdhesion, AnyRestitution, AnyRigidBody, ElasticPlasticRestitution, EnergyLedger,
    PowerRestitution, SpeedAdhesion, SpeedRestitution, TangentialOutcome, WorkOfAdhesion,
};
use microimpact::{
    Class, ConstantRestitution, ContactClass, CriticalSpeed, Impact, InputError, Outcome, Parameter, Real, RigidBody,
    Sphere, TangentialImpact,
};
use rayon::prelude::*;

use crate::departure::Departure;
use crate::groups::{LANES, fill_groups, in_lanes};
use crate::impacts::{Answer, Part, Slot};
use crate::motions::{Arrival, Place, in_plane};
use crate::quantity::Asked;
use crate::{Column, F64x4, Impacts, Motions, Quantity, RowStatus};

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
        self.law(|column| column.at(row))
    }

    /// The law of the numbers that `at` takes from the columns: those of a row, or of several in lanes.
    #[inline]
    fn law<T: Real>(&self, at: impl Fn(&Column<'_>) -> T) -> Result<AnyRestitution<T>, InputError> {
        match self {
            Self::Constant(restitution) => ConstantRestitution::new(at(restitution)).map(Into::into),
            // The law of the paper needs no powers.
            Self::Power { speed, power } if at(power) == T::ONE => SpeedRestitution::new(at(speed)).map(Into::into),
            Self::Power { speed, power } => PowerRestitution::new(at(speed), at(power)).map(Into::into),
            Self::ElasticPlastic(speed) => ElasticPlasticRestitution::new(at(speed)).map(Into::into),
        }
    }
}

impl Adhesion<'_> {
    /// The adhesion of a row on its sphere.
    ///
    /// # Errors
    /// A number outside its range.
    pub fn at(&self, sphere: &Sphere<f64>, row: usize) -> Result<AnyAdhesion<f64>, InputError> {
        self.term(sphere, |column| column.at(row))
    }

    /// The adhesion of the numbers that `at` takes from the columns.
    #[inline]
    fn term<T: Real>(&self, sphere: &Sphere<T>, at: impl Fn(&Column<'_>) -> T) -> Result<AnyAdhesion<T>, InputError> {
        match self {
            Self::Coefficient(rho) => AdhesionCoefficient::new(at(rho)).map(Into::into),
            Self::Work(work) => WorkOfAdhesion::new(at(work), sphere).map(Into::into),
            Self::Speed { speed, power } => SpeedAdhesion::new(at(speed), at(power)).map(Into::into),
        }
    }
}

impl Default for RigidBodies<'_> {
    /// Solid spheres without adhesion and friction. Radius, density and restitution are NaN, which is refused: give them.
    fn default() -> Self {
        let missing = Column::All(f64::NAN);
        Self {
            radius: missing,
            density: missing,
            gyration_ratio: Column::All(0.4),
            restitution: Restitution::Constant(missing),
            adhesion: Adhesion::Coefficient(Column::All(0.0)),
            friction: Column::All(0.0),
            rolling_arm: Column::All(0.0),
        }
    }
}

impl RigidBodies<'_> {
    /// The sphere of the numbers that `at` takes from the columns: those of a row, or of several in lanes.
    #[inline]
    fn sphere<T: Real>(&self, at: impl Fn(&Column<'_>) -> T) -> Result<Sphere<T>, InputError> {
        Sphere::new(at(&self.radius), at(&self.density), at(&self.gyration_ratio))
    }

    /// The body of the same, without rolling dissipation.
    #[inline]
    fn body<T: Real>(&self, sphere: Sphere<T>, at: impl Fn(&Column<'_>) -> T) -> Result<AnyRigidBody<T>, InputError> {
        RigidBody::new(sphere, self.restitution.law(&at)?)
            .with_adhesion(self.adhesion.term(&sphere, &at)?)
            .with_friction(at(&self.friction))
    }

    /// Classifies the impacts of `count` rows on all threads. The result of a row is that of a single call.
    ///
    /// Four rows are computed at a time where spheres move in a plane, without rolling dissipation, and where no quantity is a work or
    /// an energy.
    pub fn classify(&self, motions: &Motions<'_>, count: usize, quantities: &[Quantity]) -> Impacts {
        let in_lanes = Asked::by(quantities) != Asked::All;
        let group =
            |first: usize, part: &mut Part<'_>| if in_lanes { self.put_group(motions, first, part) } else { None };
        fill_groups(
            count,
            quantities,
            || false,
            group,
            |row, slot, solved| {
                if solved.is_some() { Ok(()) } else { self.put_row(motions, row, slot) }
            },
        )
    }

    /// Puts the results of the rows from `first` on into their slots, if they can be computed at once.
    #[inline]
    fn put_group(&self, motions: &Motions<'_>, first: usize, part: &mut Part<'_>) -> Option<()> {
        let at = |column: &Column<'_>| in_lanes(column, first);
        let Motions::Planar { speed_normal, speed_tangential, spin } = motions else {
            return None;
        };
        if at(&self.rolling_arm) != F64x4::ZERO {
            return None;
        }
        let sphere = self.sphere(at).ok()?;
        let before = in_plane([speed_normal, speed_tangential, spin], &sphere, at).ok()?;
        let impact = match (&self.restitution, &self.adhesion) {
            // The laws of the paper by their types: a row whose laws are chosen takes half as much time again.
            (Restitution::Power { speed, power: Column::All(1.0) }, Adhesion::Work(work)) => {
                RigidBody::new(sphere, SpeedRestitution::new(at(speed)).ok()?)
                    .with_adhesion(WorkOfAdhesion::new(at(work), &sphere).ok()?)
                    .with_friction(at(&self.friction))
                    .ok()?
                    .impact(&before)
            }
            _ => self.body(sphere, at).ok()?.impact(&before),
        };
        // Of constant lanes: numbers stay in registers.
        let lane = |lane: usize| contact_class(&impact.lane(|numbers| <[f64; LANES]>::from(numbers)[lane]));
        let class = |(outcome, contact): (Outcome, ContactClass<f64>)| Class::of(outcome, contact.motion);
        part.put_group(first, [lane(0), lane(1), lane(2), lane(3)].map(class), |quantity| {
            match quantity {
                // Computed again where it is asked for, so that no row divides for it elsewhere.
                Quantity::FrictionOverLimit => [lane(0), lane(1), lane(2), lane(3)]
                    .map(|(_, contact)| contact.friction_over_limit.unwrap_or(f64::NAN)),
                _ => number(quantity, &sphere, &impact).map_or([f64::NAN; LANES], Into::into),
            }
        });
        Some(())
    }

    /// Puts the result of a row into its slot.
    fn put_row(&self, motions: &Motions<'_>, row: usize, slot: &mut Slot<'_, '_>) -> Result<(), InputError> {
        let at = |column: &Column<'_>| column.at(row);
        let Arrival { sphere, motion, place } = motions.arrival(self.sphere(at)?, row)?;
        let arm = self.rolling_arm.at(row);
        place.check_about_one_axis(Parameter::RollingArm, arm)?;
        let body = self.body(sphere, at)?;
        let impact =
            if arm == 0.0 { body.impact(&motion) } else { body.with_rolling_dissipation(arm)?.impact(&motion) };
        slot.put(&Answered::new(&sphere, &place, &impact));
        Ok(())
    }

    /// The critical speed of each of `count` rows.
    pub fn critical_speeds(&self, count: usize) -> Vec<Result<CriticalSpeed<f64>, InputError>> {
        let of = |row: usize| {
            let at = |column: &Column<'_>| column.at(row);
            Ok(self.body(self.sphere(at)?, at)?.critical_speed())
        };
        (0..count).into_par_iter().map(of).collect()
    }
}

/// How an impact ends. Its margin is no quantity, so that no critical speed is computed.
#[inline]
fn contact_class(impact: &Impact<f64, TangentialImpact<f64>>) -> (Outcome, ContactClass<f64>) {
    let outcome = if impact.normal.is_capture() { Outcome::Capture } else { Outcome::Rebound };
    (outcome, impact.tangential.classify(outcome))
}

/// A quantity that an impact has, or several in lanes; `None` for one that is computed from more than it.
#[inline]
fn number<T: Real>(
    quantity: Quantity,
    sphere: &Sphere<T>,
    Impact { normal, tangential }: &Impact<T, TangentialImpact<T>>,
) -> Option<T> {
    match quantity {
        Quantity::OverallRestitution => Some(normal.overall_restitution()),
        Quantity::ReboundSpeed => Some(normal.rebound_speed()),
        Quantity::SpeedTangentialOut => Some(tangential.velocity()),
        Quantity::SpinOut => Some(tangential.spin(sphere)),
        Quantity::ImpulseRatioOut => Some(tangential.impulse_ratio()),
        Quantity::RollingRatio => Some(tangential.rolling_ratio()),
        _ => None,
    }
}

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
        let (outcome, contact) = contact_class(impact);
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
        match quantity {
            Quantity::FrictionOverLimit => self.contact.friction_over_limit.unwrap_or(f64::NAN),
            _ => number(quantity, self.sphere, self.impact).unwrap_or_else(|| self.computed(quantity)),
        }
    }
}
