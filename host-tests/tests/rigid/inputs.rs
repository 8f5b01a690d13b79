//! Every input has a range, and every value outside it is an error that names the input.

use microimpact::contact::{Adaptive, Collocation, Compliance, Contact, DimensionlessImpact, FixedCost, RestCriterion};
use microimpact::instrument::sensor::{
    ChargedParticle, Clock, Doppler, ImageCharge, ImpulseSensor, Transit, radius_from_impulse,
};
use microimpact::instrument::{Confident, DriftAlarm, Rejection, corrected_rate};
use microimpact::measure::ring_strength;
use microimpact::measure::{Estimate, NormalDistribution, Uncertain};
use microimpact::rigid::{
    AdhesionCoefficient, Departure, ElasticPlasticRestitution, PowerRestitution, SpeedAdhesion, TabulatedRestitution,
    WorkOfAdhesion, image_charge_energy, infer, infer_with_spins,
};
use microimpact::space::{SpatialMotion, Wall};
use microimpact::table::{BoundaryTable, RestitutionTable, Single, TableRebound};
use microimpact::{
    AdhesionRegime, Approach, ConstantRestitution, Coulomb, CriticalSpeed, Fault, Hertz, ImpactError, InFixedPoint,
    InputError, Material, NormalMotion, Parameter, PlanarMotion, Real, RigidBody, SpeedRestitution, Sphere, Sticking,
    Stiffness,
};

type Checked = Result<(), ImpactError>;

fn sphere<T: Real>() -> Sphere<T> {
    Sphere::solid(T::constant(5e-4), T::constant(2600.0)).unwrap()
}

fn stiffness<T: Real>() -> Stiffness<T> {
    Stiffness::new(T::constant(1e9)).unwrap()
}

fn motion<T: Real>() -> PlanarMotion<T> {
    let oblique = NormalMotion::new(T::ONE).unwrap().with_tangential(T::ONE).unwrap();
    oblique.with_peripheral_velocity(T::ZERO).unwrap()
}

fn perfect<T: Real>() -> ConstantRestitution<T> {
    ConstantRestitution::new(T::ONE).unwrap()
}

/// A table of impacts that keep all of their speed.
fn restitution_table<T: Single>(ratio: T, impulse: T) -> Result<(), InputError> {
    let micrometre = T::constant(1e-6);
    let boundary = BoundaryTable::<1>::new(micrometre, |_| Ok(CriticalSpeed::At(micrometre)))?;
    let source = |_, _| Ok(TableRebound { restitution: T::ONE, impulse });
    RestitutionTable::<T, 1, 3, 4>::new(boundary, ratio, source).map(drop)
}

/// Supplies a value where the parameter is asked for; all other inputs are valid.
fn supply<T: Single + NormalDistribution + Into<f64>>(parameter: Parameter, value: T) -> Checked {
    let c = T::constant;
    let scene = RigidBody::new(sphere(), perfect());
    let departure = |normal, tangential| Departure { normal, tangential };
    let checked: Result<(), InputError> = match parameter {
        Parameter::Radius => Sphere::solid(value, c(2600.0)).map(drop),
        Parameter::Thickness => Sphere::coated(c(1.0), value, c(1000.0), c(2600.0)).map(drop),
        Parameter::Density => Sphere::coated(c(1e-6), c(1e-7), c(1000.0), value).map(drop),
        Parameter::GyrationRatio => Sphere::new(c(1e-6), c(1000.0), value).map(drop),
        Parameter::YoungsModulus => Material::new(value, c(0.3)).map(drop),
        Parameter::PoissonRatio => Material::new(c(1e9), value).map(drop),
        Parameter::Stiffness => Stiffness::new(value).map(drop),
        Parameter::ApproachSpeed => NormalMotion::from_velocity(-value).map(drop),
        Parameter::TangentialVelocity => NormalMotion::new(c(1.0)).unwrap().with_tangential(value).map(drop),
        Parameter::Spin => {
            // The smallest sphere: with others the peripheral velocity leaves its range first.
            let sphere = Sphere::solid(c(1e-10), c(2600.0)).unwrap();
            let oblique = NormalMotion::new(c(1.0)).unwrap().with_tangential(c(1.0)).unwrap();
            oblique.with_spin(&sphere, value).map(drop)
        }
        Parameter::VelocityComponent => SpatialMotion::new([value, c(0.0), c(0.0)], [c(0.0); 3]).map(drop),
        Parameter::NormalLength => Wall::new([c(0.0), value, c(0.0)]).map(drop),
        Parameter::PeripheralVelocity => {
            let oblique = NormalMotion::new(c(1.0)).unwrap().with_tangential(c(1.0)).unwrap();
            oblique.with_peripheral_velocity(value).map(drop)
        }
        Parameter::ReboundSpeed => {
            // The fastest approach, so that no valid rebound exceeds it.
            let before = NormalMotion::new(c(1e6)).unwrap().with_tangential(c(0.0)).unwrap();
            let before = before.with_peripheral_velocity(c(0.0)).unwrap();
            return infer(&sphere(), &perfect(), &before, &departure(value, c(0.0)), c(0.0)).map(drop);
        }
        Parameter::VelocityError => {
            return infer(&sphere(), &perfect(), &motion(), &departure(c(1.0), c(1.0)), value).map(drop);
        }
        Parameter::Restitution => ConstantRestitution::new(value).map(drop),
        Parameter::RestitutionSpeed => SpeedRestitution::new(value).map(drop),
        Parameter::RestitutionPower => PowerRestitution::new(c(1.0), value).map(drop),
        Parameter::YieldSpeed => ElasticPlasticRestitution::new(value).map(drop),
        Parameter::YieldPressure => Hertz::yield_speed(&sphere(), stiffness(), value).map(drop),
        Parameter::AdhesionSpeed => SpeedAdhesion::new(value, c(1.0)).map(drop),
        Parameter::AdhesionPower => SpeedAdhesion::new(c(1.0), value).map(drop),
        Parameter::Charge => image_charge_energy(&sphere(), value).map(drop),
        Parameter::AdhesionCoefficient => AdhesionCoefficient::new(value).map(drop),
        Parameter::WorkOfAdhesion => WorkOfAdhesion::new(value, &sphere()).map(drop),
        Parameter::Friction => Coulomb::new(value).map(drop),
        Parameter::StiffnessRatio => Compliance::new(Coulomb::new(c(0.1)).unwrap(), value).map(drop),
        Parameter::ImpulseRatio => {
            // Fast sliding the one way or the other, so that no valid ratio exceeds mu_0.
            let slip = if value > T::ZERO { c(-1e7) } else { c(1e7) };
            let motion = NormalMotion::new(c(1.0)).unwrap().with_tangential(slip).unwrap();
            return scene.impact_with_ratio(&motion, value).map(drop);
        }
        Parameter::RollingArm => {
            scene.with_friction(c(0.1)).and_then(|scene| scene.with_rolling_dissipation(value)).map(drop)
        }
        Parameter::ExternalImpulse => {
            let sphere = Sphere::solid(c(1.0), c(1e6)).unwrap();
            RigidBody::new(sphere, perfect()).with_external_impulses(value, c(0.0)).map(drop)
        }
        Parameter::VelocityChange => scene.with_external_impulses(value * sphere::<T>().mass(), c(0.0)).map(drop),
        Parameter::ExternalForce => {
            let sphere = Sphere::solid(c(1.0), c(1e6)).unwrap();
            RigidBody::new(sphere, perfect()).with_external_force(value, c(1e-3)).map(drop)
        }
        Parameter::Duration => scene.with_external_force(c(0.0), value).map(drop),
        Parameter::MaterialDamping => Contact::hertz(sphere(), stiffness()).with_damping(value).map(drop),
        Parameter::AdhesionStrength => Contact::hertz(sphere(), stiffness()).with_ring(value, c(1.0)).map(drop),
        Parameter::AdhesionDamping => Contact::hertz(sphere(), stiffness()).with_ring(c(1.0), value).map(drop),
        Parameter::RelaxationTime => Contact::hertz(sphere(), stiffness()).with_viscoelastic_damping(value).map(drop),
        Parameter::NominalRestitution => Contact::hertz(sphere(), stiffness()).with_constant_damping(value).map(drop),
        Parameter::AdhesionEnergy => Sticking::new(&sphere(), stiffness(), value).map(drop),
        Parameter::AtomicSpacing => AdhesionRegime::of(&sphere(), stiffness(), c(0.1), value).map(drop),
        Parameter::PeelingMoment => Contact::hertz(sphere(), stiffness())
            .with_ring(c(1.0), c(1.0))
            .and_then(|scene| scene.with_friction(c(0.1)))
            .and_then(|scene| scene.with_peeling(value))
            .map(drop),
        Parameter::Tolerance => Collocation::<12, T>::new(value).map(drop),
        Parameter::ContactRadiusRatio => {
            let sphere = sphere::<T>();
            ring_strength(&sphere, stiffness(), value * sphere.radius()).map(drop)
        }
        Parameter::StandardError => Uncertain::new(T::ONE, value).map(drop),
        Parameter::RestEnergy => RestCriterion::new(value, 100).map(drop),
        Parameter::CriticalSpeed => BoundaryTable::<1>::new(c(1e-6), |_| Ok(CriticalSpeed::At(value))).map(drop),
        Parameter::SpeedRatio => restitution_table(value, T::ONE),
        Parameter::ImpulseOverMomentum => restitution_table(c(10.0), value),
        Parameter::DimensionlessAdhesion => DimensionlessImpact::new(value, T::ZERO, T::ZERO).map(drop),
        Parameter::DimensionlessDamping => DimensionlessImpact::new(T::ZERO, T::ZERO, value).map(drop),
        Parameter::SpeedUnit => scene.in_fixed_point(value).map(drop),
        instrumental => of_an_instrument(instrumental, value),
    };
    Ok(checked?)
}

/// The same for the parameters of an instrument and of its sensors.
fn of_an_instrument<T: Single + NormalDistribution + Into<f64>>(
    parameter: Parameter,
    value: T,
) -> Result<(), InputError> {
    let c = T::constant;
    let exact = |value| Estimate { value, standard_error: T::ZERO };
    let clock = |frequency, edge_error| Clock::new(&exact(frequency), edge_error);
    let usual = clock(c(1e6), T::ZERO)?;
    match parameter {
        Parameter::ObservationTime => corrected_rate(0, value, &exact(T::ZERO)).map(drop),
        Parameter::Probability => DriftAlarm::new(c(2.0), c(100.0))?.observe(true, value).map(drop),
        Parameter::Confidence => {
            let impact = |_, motion: PlanarMotion<T>| Ok((motion.normal(), CriticalSpeed::At(T::ONE)));
            Confident::new(value, impact).map(drop)
        }
        Parameter::OddsRatio => DriftAlarm::new(value, c(100.0)).map(drop),
        Parameter::FalseAlarmInterval => DriftAlarm::new(c(2.0), value).map(drop),
        Parameter::SensorLength => Transit::new(&exact(value), usual).map(drop),
        Parameter::ClockFrequency => clock(value, T::ZERO).map(drop),
        Parameter::EdgeError => clock(c(1e6), value).map(drop),
        Parameter::FrequencyShift => Doppler::new(&exact(c(1e-6)), value, usual).map(drop),
        Parameter::Sensitivity => ImpulseSensor::new(&exact(value), T::ONE, T::ZERO).map(drop),
        Parameter::SignalNoise => ImageCharge::new(&exact(T::ONE), &exact(T::ONE), value, usual).map(drop),
        Parameter::AcceleratingVoltage => {
            // A radius of a millimetre at a voltage of one, so that no voltage makes one out of range.
            let particle = ChargedParticle { charge: exact(c(1e-3)), speed: exact(c(22.0)) };
            particle.radius(&exact(value), &exact(c(1000.0))).map(drop)
        }
        Parameter::MeasuredImpulse => {
            // The speed that makes a millimetre of it; the bounds of the impulse come first.
            let speed = (value / c(4e-6)).max(c(1e-12)).min(c(1e6));
            let sized = radius_from_impulse(&exact(value), &exact(speed), &exact(c(1000.0)), |radius| {
                Ok(RigidBody::new(Sphere::solid(radius, c(1000.0))?, perfect()))
            });
            match sized {
                Err(Rejection::Input(error)) if error.parameter == parameter => Err(error),
                _ => Ok(()),
            }
        }
        other => panic!("{other:?} is not tested"),
    }
}

/// The value next to a bound, away from or into the range.
fn beyond(bound: f64, outwards: bool) -> f64 {
    let step = 1e-5 * bound.abs().max(1e-3);
    if outwards { bound + step } else { bound - step }
}

/// Parameters that follow from others, or are counted: tested one by one below, the margin with its tables, what fixed
/// point holds with the scenes in it, and the last five with the instrument and its sensors.
const DERIVED: [Parameter; 18] = [
    Parameter::AdhesionRatio,
    Parameter::ForceRatio,
    Parameter::DampingRatio,
    Parameter::Iterations,
    Parameter::TurningPoints,
    Parameter::BoundaryMargin,
    Parameter::SpeedInUnits,
    Parameter::ContactSpeedInUnits,
    Parameter::VelocityRatio,
    Parameter::VelocityInUnits,
    Parameter::RestitutionSpeedInUnits,
    Parameter::FixedPointGyration,
    Parameter::FixedPointFriction,
    Parameter::MaterialIndex,
    Parameter::DeadFraction,
    Parameter::Ticks,
    Parameter::SignalCycles,
    Parameter::RelativeError,
];

fn assert_bounds_hold<T: Single + NormalDistribution + Into<f64>>(not_a_number: [T; 3]) {
    for parameter in Parameter::ALL.into_iter().filter(|parameter| !DERIVED.contains(parameter)) {
        let (smallest, largest) = parameter.range();
        let fault = |value: T, fault| {
            let error = supply(parameter, value).unwrap_err();
            let ImpactError::Input(error) = error else { panic!("{parameter:?}: {error}") };
            assert_eq!((error.parameter, error.fault), (parameter, fault), "{value:?}");
            assert!(!(parameter.range().0..=parameter.range().1).contains(&f64::from(error.value)), "{error:?}");
        };
        for value in not_a_number {
            // The impulse itself is checked before the change of velocity that it makes.
            if parameter != Parameter::VelocityChange {
                fault(value, Fault::NotFinite);
            }
        }
        fault(T::constant(beyond(smallest, false)), Fault::TooSmall);
        fault(T::constant(beyond(largest, true)), Fault::TooLarge);
        let least = if parameter == Parameter::Tolerance { smallest.max(8.0 * T::EPSILON.into()) } else { smallest };
        for value in [least, largest, (smallest + largest) / 2.0] {
            // Rounding may carry the product of mass and velocity across the bound; a hair inside it may not.
            let value = if parameter == Parameter::VelocityChange { value * (1.0 - 1e-5) } else { value };
            assert_eq!(supply(parameter, T::constant(value)), Ok(()), "{parameter:?} = {value:e}");
        }
    }
}

#[test]
fn bounds_hold_in_double_precision() {
    assert_bounds_hold([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
}

#[test]
fn bounds_hold_in_single_precision() {
    assert_bounds_hold([f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
}

/// What is wrong with an input, whatever its value.
fn kind(error: InputError) -> (Parameter, Fault) {
    (error.parameter, error.fault)
}

/// The ratios of a scene's forces have ranges too: outside them the motion could not be represented.
#[test]
fn ratios_of_forces() {
    let fault = |parameter, fault| Some((parameter, fault));
    let method = FixedCost::<5>::new(3).unwrap();
    let soft = Stiffness::new(1e3).unwrap();
    let sphere = Sphere::solid(1e-6, 1000.0).unwrap();
    let motion = |speed: f64| NormalMotion::new(speed).unwrap();
    let scene = Contact::hertz(sphere, soft);
    assert_eq!(
        scene.with_damping(1e9).unwrap().solve_normal(&motion(10.0), &method).err().map(kind),
        fault(Parameter::DampingRatio, Fault::TooLarge)
    );
    assert_eq!(
        scene.with_ring(1e-3, 1e9).unwrap().solve_normal(&motion(10.0), &method).err().map(kind),
        fault(Parameter::DampingRatio, Fault::TooLarge)
    );
    assert_eq!(
        scene.with_ring(1e9, 0.0).unwrap().solve_normal(&motion(1e-6), &method).err().map(kind),
        fault(Parameter::AdhesionRatio, Fault::TooLarge)
    );
    for (force, expected) in [(-1.0, Fault::TooLarge), (1.0, Fault::TooSmall)] {
        let pressed = scene.with_external_force(force).unwrap();
        assert_eq!(
            pressed.solve_normal(&motion(1e-6), &method).err().map(kind),
            fault(Parameter::ForceRatio, expected)
        );
    }
    assert!(scene.with_damping(1e3).unwrap().solve_normal(&motion(1.0), &method).is_ok());
    for (iterations, expected) in [(0, Fault::TooSmall), (41, Fault::TooLarge)] {
        assert_eq!(FixedCost::<5>::new(iterations).err().map(kind), fault(Parameter::Iterations, expected));
    }
    for (turning_points, expected) in [(0, Fault::TooSmall), (100_001, Fault::TooLarge)] {
        assert_eq!(RestCriterion::new(0.1, turning_points).err().map(kind), fault(Parameter::TurningPoints, expected));
    }
}

#[test]
fn tolerances_below_the_rounding_are_refused() {
    for tolerance in [1e-13_f32, 1e-9, 9e-7] {
        let error = Collocation::<7, f32>::new(tolerance).unwrap_err();
        assert_eq!((error.parameter, error.fault), (Parameter::Tolerance, Fault::BelowPrecision));
        assert_eq!(Adaptive::new(tolerance), Err(error));
    }
    assert!(Adaptive::new(1e-6_f32).is_ok() && Adaptive::new(1e-13).is_ok());
}

#[test]
fn layers_fit_into_their_sphere() {
    let error = InputError { parameter: Parameter::Thickness, fault: Fault::ExceedsRadius, value: 1.1e-6 };
    assert_eq!(error.to_string(), "thickness is 1.1e-6 m, but must not exceed the radius of the sphere");
    assert_eq!(Sphere::hollow(1e-6, 1.1e-6, 1000.0), Err(error));
    assert_eq!(Sphere::coated(1e-6, 1.1e-6, 1000.0, 2000.0), Err(error));
    let full = Sphere::coated(1e-6, 1e-6, 1000.0, 2000.0).unwrap();
    assert_eq!(full, Sphere::solid(1e-6, 2000.0).unwrap());
}

/// Two nearly rigid materials have a stiffness beyond its range.
#[test]
fn derived_values_are_checked_too() {
    let rigid = Material::new(1e16, -0.999).unwrap();
    let error = (Parameter::Stiffness, Fault::TooLarge);
    assert_eq!(Stiffness::between(&rigid, &rigid).map_err(kind), Err(error));
    let error = (Parameter::Density, Fault::TooSmall);
    assert_eq!(Sphere::hollow(1.0, 1e-9, 1.0).map_err(kind), Err(error));
    let error = (Parameter::PeripheralVelocity, Fault::TooLarge);
    let oblique = NormalMotion::new(1.0).unwrap().with_tangential(0.0).unwrap();
    assert_eq!(oblique.with_spin(&sphere(), 1e12).map_err(kind), Err(error));
}

#[test]
fn impossible_measurements() {
    let (sphere, before) = (sphere::<f64>(), motion());
    let law = ConstantRestitution::new(0.9).unwrap();
    let infer = |normal, tangential| infer(&sphere, &law, &before, &Departure { normal, tangential }, 1e-3);
    assert!(infer(0.8, 0.9).is_ok());
    assert_eq!(infer(0.91, 0.9), Err(ImpactError::ReboundExceedsRestitution));
    assert_eq!(infer(0.8, 1.01), Err(ImpactError::ImpulseRatioOutsideBounds));
    assert_eq!(infer(0.8, 0.7), Err(ImpactError::ImpulseRatioOutsideBounds));
    // Within the error of the velocities both bounds are met.
    assert!(infer(0.8, 1.0 + 5e-4).is_ok());
    assert!(infer(0.8, 5.0 / 7.0 - 1e-4).is_ok());
    let after = Departure { normal: 0.8, tangential: 0.9 };
    let spinning = infer_with_spins(&sphere, &law, &before, &after, -2.0 / sphere.radius(), 1e-3);
    assert_eq!(spinning, Err(ImpactError::EnergyGained));
}

#[test]
fn errors_name_the_parameter_its_range_and_unit() {
    for parameter in Parameter::ALL {
        let (smallest, largest) = parameter.range();
        for fault in [Fault::NotFinite, Fault::TooSmall, Fault::TooLarge] {
            let text = InputError { parameter, fault, value: -1.25e20 }.to_string();
            let start = format!("{} is -1.25e20", parameter.name());
            assert!(text.starts_with(&start), "{text}");
            let range = text.rsplit_once("but must be ").unwrap().1;
            let range = range.strip_prefix("a number from ").unwrap_or(range);
            // Before what to do.
            let range = range.split("; ").next().unwrap();
            let mut words = range.split(' ');
            assert_eq!(words.next().unwrap().parse(), Ok(smallest), "{text}");
            assert_eq!(words.next(), Some("to"), "{text}");
            assert_eq!(words.next().unwrap().parse(), Ok(largest), "{text}");
            let unit = words.collect::<Vec<_>>().join(" ");
            assert_eq!(if unit.is_empty() { "1" } else { &unit }, parameter.unit(), "{text}");
        }
    }
    // Common mistakes: a wrong sign, micrometres instead of metres, and no number at all.
    let message = |error: InputError| error.to_string();
    for speed in [NormalMotion::new(-2.8_f64).map(drop), NormalMotion::new(-2.8_f32).map(drop)] {
        let expected = "approach speed is -2.8 m/s, but must be 1e-12 to 1e6 m/s; enter -2.8 m/s as 2.8";
        assert_eq!(speed.map_err(message), Err(expected.into()));
    }
    assert_eq!(
        Sphere::solid(5.0_f32, 2600.0).map_err(message).map(drop),
        Err("radius is 5 m, but must be 1e-10 to 1 m; enter 5 um as 5e-6".into())
    );
    assert_eq!(
        ConstantRestitution::new(f32::NAN).map_err(message).map(drop),
        Err("restitution is NaN, but must be a number from 0 to 1".into())
    );
    for error in
        [ImpactError::ReboundExceedsRestitution, ImpactError::ImpulseRatioOutsideBounds, ImpactError::EnergyGained]
    {
        assert!(!error.to_string().is_empty());
    }
}

#[test]
fn points_of_a_table_are_in_order() {
    let refused = |points| kind(TabulatedRestitution::new(points).unwrap_err());
    assert_eq!(refused([(2.0, 0.5), (1.0, 0.5)]), (Parameter::ApproachSpeed, Fault::OutOfOrder));
    assert_eq!(refused([(1.0, 0.9), (2.0, 0.4)]), (Parameter::ReboundSpeed, Fault::OutOfOrder));
    assert_eq!(refused([(1.0, 0.9), (2.0, f64::NAN)]), (Parameter::Restitution, Fault::NotFinite));
    let error = TabulatedRestitution::new([(1.0, 0.9), (2.0, 0.4)]).unwrap_err();
    let message =
        "rebound speed is 0.8 m/s, but must not be below that of the point before; R v never falls with the speed v";
    assert_eq!(error.to_string(), message);
}
