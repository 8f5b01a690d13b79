//! The scenes of class probabilities: a rigid body whose velocities, spin and parameters all have standard errors.

use core::marker::PhantomData;

use microimpact::measure::{ClassProbabilities, Uncertain};
use microimpact::{
    Class, ConstantRestitution, InputError, NormalMotion, Parameter, PlanarMotion, RestitutionLaw, RigidBody,
    SpeedRestitution, Sphere,
};

use super::impacts::Impact;
use super::scenes::{Answer, Measured, Number, Scene, Visitor, given};
use super::table_1::{DENSITY_KG_M3, FRICTION, RADIUS_M, RESTITUTION_SPEED_M_S, WORK_OF_ADHESION_J};

/// Standard errors of the velocities, m/s, and of the other inputs, relative to them.
const VELOCITY_ERROR_M_S: f64 = 0.05;
const PERIPHERAL_ERROR_M_S: f64 = 0.3;
const RELATIVE_ERROR: f64 = 0.05;

/// A coefficient of restitution that its bound of one limits, and its standard error.
const RESTITUTION: f64 = 0.98;
const RESTITUTION_ERROR: f64 = 0.02;

/// Impacts close to both boundaries, and to one or none of them. The critical speed is 1.8 m/s.
static IMPACTS: [Impact; 6] = [
    Impact { name: "both-close", approach_m_s: 1.85, tangential_m_s: 0.75, spin_rad_s: 0.0 },
    Impact { name: "just-captured", approach_m_s: 1.75, tangential_m_s: 0.65, spin_rad_s: 0.0 },
    Impact { name: "backspin", approach_m_s: 1.85, tangential_m_s: 0.2, spin_rad_s: -1.0e5 },
    Impact { name: "either-way", approach_m_s: 1.82, tangential_m_s: 0.0, spin_rad_s: 0.0 },
    Impact { name: "just-slides", approach_m_s: 2.8, tangential_m_s: 1.75, spin_rad_s: 0.0 },
    Impact { name: "rolls-on", approach_m_s: 1.2, tangential_m_s: 0.2, spin_rad_s: 0.0 },
];

/// A law of restitution with an uncertain parameter.
pub trait UncertainLaw<T: Number>: RestitutionLaw<T> + Sized {
    /// Name of the scene.
    const NAME: &'static str;
    /// The parameter, with its standard error.
    fn parameter() -> Result<Uncertain<T>, InputError>;
    /// The law.
    fn of(parameter: T) -> Result<Self, InputError>;
}

impl<T: Number> UncertainLaw<T> for SpeedRestitution<T> {
    const NAME: &'static str = "uncertain/speed";

    fn parameter() -> Result<Uncertain<T>, InputError> {
        relative(RESTITUTION_SPEED_M_S, Parameter::RestitutionSpeed)
    }

    fn of(parameter: T) -> Result<Self, InputError> {
        Self::new(parameter)
    }
}

impl<T: Number> UncertainLaw<T> for ConstantRestitution<T> {
    const NAME: &'static str = "uncertain/bounded";

    fn parameter() -> Result<Uncertain<T>, InputError> {
        Uncertain::new(given(RESTITUTION), given(RESTITUTION_ERROR))?.within(Parameter::Restitution)
    }

    fn of(parameter: T) -> Result<Self, InputError> {
        Self::new(parameter)
    }
}

fn relative<T: Number>(value: f64, parameter: Parameter) -> Result<Uncertain<T>, InputError> {
    Uncertain::new(given(value), given(RELATIVE_ERROR * value))?.within(parameter)
}

/// Friction coefficient, work of adhesion, parameter of the restitution and radius.
pub struct Probabilities<T, L> {
    parameters: [Uncertain<T>; 4],
    law: PhantomData<L>,
}

impl<T: Number, L: UncertainLaw<T>> Scene<T> for Probabilities<T, L> {
    const NAME: &'static str = L::NAME;
    const PLANAR: bool = true;
    type Motion = [Uncertain<T>; 3];
    type Verdict = Result<ClassProbabilities<T>, InputError>;

    fn new() -> Option<Self> {
        let parameters = [
            relative(FRICTION, Parameter::Friction).ok()?,
            relative(WORK_OF_ADHESION_J, Parameter::WorkOfAdhesion).ok()?,
            L::parameter().ok()?,
            relative(RADIUS_M, Parameter::Radius).ok()?,
        ];
        Some(Self { parameters, law: PhantomData })
    }

    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        let input = |value, error, parameter| {
            Uncertain::new(value, T::constant(error)).and_then(|input| input.within(parameter))
        };
        let peripheral = measured.spin_rad_s * T::constant(RADIUS_M);
        Some([
            input(measured.approach_m_s, VELOCITY_ERROR_M_S, Parameter::ApproachSpeed).ok()?,
            input(measured.tangential_m_s, VELOCITY_ERROR_M_S, Parameter::TangentialVelocity).ok()?,
            input(peripheral, PERIPHERAL_ERROR_M_S, Parameter::PeripheralVelocity).ok()?,
        ])
    }

    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        let ([approach, tangential, peripheral], [friction, work, law, radius]) = (*motion, self.parameters);
        let inputs = [approach, tangential, peripheral, friction, work, law, radius];
        ClassProbabilities::new(&inputs, |[approach, tangential, peripheral, friction, work, law, radius]| {
            let body = RigidBody::new(Sphere::solid(radius, given(DENSITY_KG_M3))?, L::of(law)?);
            let motion: PlanarMotion<T> =
                NormalMotion::new(approach)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
            Ok((body.with_work_of_adhesion(work)?.with_friction(friction)?, motion))
        })
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        IMPACTS.iter()
    }
}

/// The most probable class.
impl<T: Number> From<Result<ClassProbabilities<T>, InputError>> for Answer<T> {
    fn from(found: Result<ClassProbabilities<T>, InputError>) -> Self {
        let classes = [
            (Class::ReboundSliding, "rebound-sliding"),
            (Class::ReboundRolling, "rebound-rolling"),
            (Class::CapturedSliding, "captured-sliding"),
            (Class::CapturedRolling, "captured-rolling"),
        ];
        let class = found.map_or("refused", |found| {
            let of = |(class, name)| (found.of(class), name);
            classes.map(of).into_iter().fold((T::ZERO, ""), |most, next| if next.0 > most.0 { next } else { most }).1
        });
        Self { class, speed_margin: None, friction_margin: None, restitution: None }
    }
}

/// Goes through the scenes of class probabilities.
pub(super) fn visit_uncertain(visitor: &mut impl Visitor) {
    visitor.visit::<f32, Probabilities<f32, SpeedRestitution<f32>>>();
    visitor.visit::<f32, Probabilities<f32, ConstantRestitution<f32>>>();
}
