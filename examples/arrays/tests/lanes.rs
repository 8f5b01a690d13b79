//! Lanes give the results of single calls, each with its own status.

use std::array;

use impact_arrays::{
    Adhesion, Column, Contacts, Damping, F32x8, F64x4, Law, Motions, Quantity, Restitution, RigidBodies, RowStatus,
    Surface,
};
use microimpact::contact::{Adaptive, AnyLaw, Contact, FixedCost, Impulses, Status, Times};
use microimpact::{
    Class, Impact, InputError, NormalMotion, Real, RigidBody, SpeedRestitution, Sphere, Stiffness, TangentialImpact,
};

/// Numbers of the van der Corput sequence, evenly between two bounds on a logarithmic scale.
fn between(low: f64, high: f64, place: u32) -> f64 {
    low * (high / low).powf(f64::from(place.reverse_bits()) / f64::from(u32::MAX))
}

/// A law with numbers from `number`, which takes bounds.
fn law<T: Real>(kind: usize, mut number: impl FnMut(f64, f64) -> T) -> Result<AnyLaw<T>, InputError> {
    let stiffness = Stiffness::new(number(1e9, 1e11))?;
    let law = match kind % 3 {
        0 => AnyLaw::hertz(stiffness),
        1 => AnyLaw::ring(stiffness, number(1.0, 1e3), number(0.1, 20.0))?,
        _ => AnyLaw::dmt(stiffness, number(0.01, 1.0))?,
    };
    match kind / 3 {
        0 => Ok(law),
        1 => law.with_damping(number(0.1, 300.0)),
        2 => law.with_viscoelastic_damping(number(1e-12, 1e-9)),
        _ => law.with_constant_damping(number(0.3, 0.999)),
    }
}

/// Compares scenes in lanes with the same scenes one by one.
macro_rules! compare {
    ($number:ty, $lanes:ty, $count:literal) => {{
        let method = FixedCost::<7>::new(3)?;
        let (mut solved, mut captured, mut unsolved) = (0, 0, 0);
        for group in 0..12 * 40 {
            let (kind, start) = (group % 12, 1 + (group as u32 / 12) * $count);
            // Each number of a scene takes its place in the sequence from another lane.
            let number = |low: f64, high: f64, turn: u32| -> [$number; $count] {
                array::from_fn(|lane| between(low, high, start + (lane as u32 + 3 * turn) % $count) as $number)
            };
            let (radius, speed) = (number(5e-7, 5e-5, 0), number(0.05, 50.0, 1));
            let scene = |radius, speed, law, constant: f64| -> Result<_, InputError> {
                let scene = Contact::new(Sphere::solid(radius, Real::constant(2600.0))?, law);
                let motion = NormalMotion::new(speed)?.with_tangential(Real::constant(constant))?;
                Ok((scene.with_friction(Real::constant(0.1))?, motion))
            };
            let mut turn = 1;
            let in_lanes = law(kind, |low, high| {
                turn += 1;
                <$lanes>::from(number(low, high, turn))
            })?;
            let (together, motions) = scene(<$lanes>::from(radius), <$lanes>::from(speed), in_lanes, 2.0)?;
            let impacts = together.solve_lanes::<$number, _, 7, 9, $count>(&motions, &method)?;
            let outputs = (Times, Impulses);
            let followed = together.solve_lanes_for::<$number, _, _, 7, 9, $count>(&motions, &method, outputs)?;
            for (lane, impact) in impacts.iter().enumerate() {
                let mut turn = 1;
                let alone = law(kind, |low, high| {
                    turn += 1;
                    number(low, high, turn)[lane]
                })?;
                let scene = Contact::new(Sphere::solid(radius[lane], 2600.0)?, alone).with_friction(0.1)?;
                let motion = NormalMotion::new(speed[lane])?.with_tangential(2.0)?;
                assert_eq!(followed[lane], scene.solve_for(&motion, &method, outputs)?);
                let single = scene.solve(&motion, &method)?;
                match single.class() {
                    Some(Class::ReboundSliding | Class::ReboundRolling) => solved += 1,
                    Some(Class::CapturedRolling | Class::CapturedSliding | Class::CapturedResting) => captured += 1,
                    _ => unsolved += 1,
                }
                assert_eq!(*impact, single);
            }
        }
        assert!(solved > 300 && captured > 100 && unsolved > 50, "{solved} {captured} {unsolved}");
        Ok(())
    }};
}

#[test]
fn four_lanes_agree_with_single_calls() -> Result<(), InputError> {
    compare!(f64, F64x4, 4)
}

#[test]
fn eight_lanes_agree_with_single_calls() -> Result<(), InputError> {
    compare!(f32, F32x8, 8)
}

#[test]
fn an_external_force_is_unsupported() -> Result<(), InputError> {
    let all = F64x4::constant;
    let scene = Contact::hertz(Sphere::solid(all(1e-6), all(1e3))?, Stiffness::new(all(1e10))?)
        .with_external_force(all(1e-9))?;
    let impacts = scene.solve_lanes::<f64, _, 7, 9, 4>(&NormalMotion::new(all(1.0))?, &FixedCost::<7>::new(3)?)?;
    assert!(impacts.iter().all(|impact| impact.run.status == Status::Unsupported && impact.normal.outcome().is_none()));
    Ok(())
}

/// What [`Real`] asks of a number type, in every lane.
#[test]
fn arithmetic_is_that_of_each_lane() {
    let (a, b) = ([1.0, -2.0, f64::MAX, f64::NAN], [3.0, -2.5, 1e-9, 1.0]);
    let (wide_a, wide_b) = (F64x4::from(a), F64x4::from(b));
    let same = |wide: F64x4, each: fn(f64, f64) -> f64| {
        for (lane, number) in <[f64; 4]>::from(wide).into_iter().enumerate() {
            assert_eq!(number.to_bits(), each(a[lane], b[lane]).to_bits(), "lane {lane}");
        }
    };
    same(Real::min(wide_a, wide_b), Real::min);
    same(Real::max(wide_a, wide_b), Real::max);
    same(Real::abs(wide_a), |a, _| Real::abs(a));
    same(wide_a.saturating_div(wide_b), |a, b| a.saturating_div(b));
    same(wide_a.where_above(wide_b, wide_a, wide_b), |a, b| if a > b { a } else { b });
    let root = |number: f64| Real::two_fifths_power(number);
    assert_eq!(
        <[f64; 4]>::from(Real::two_fifths_power(F64x4::from([1.0, 2.0, 3.0, 4.0]))),
        [1.0, 2.0, 3.0, 4.0].map(root)
    );
    assert!(wide_a.any_above(wide_b) && !F64x4::ZERO.any_above(F64x4::ONE));
    // A comparison holds only if it does in all lanes.
    let mixed = F64x4::from([0.0, 2.0, 0.0, 0.0]);
    assert!(F64x4::ZERO < F64x4::ONE && mixed.partial_cmp(&F64x4::ONE).is_none() && mixed != F64x4::ZERO);
    assert!(!wide_a.is_finite() && wide_b.is_finite());
}

/// Every row is that of the method of fixed cost or, if it does not decide, of the other one.
#[test]
fn rows_in_lanes_agree_with_rows_one_by_one() -> Result<(), InputError> {
    const ROWS: usize = 1003;
    let numbers = |low, high, turn: usize| -> Vec<f64> {
        (0..ROWS).map(|row| between(low, high, ((row * 7 + turn) % ROWS) as u32 + 1)).collect()
    };
    let (radius, mut speed, damping) = (numbers(1e-6, 2e-5, 0), numbers(0.05, 50.0, 5), numbers(1.0, 3e3, 11));
    (speed[3], speed[400]) = (-1.0, f64::NAN);
    let (quick, sure) = (FixedCost::<7>::new(3)?, Adaptive::new(1e-9)?);
    let quantities = [
        Quantity::OverallRestitution,
        Quantity::ReboundSpeed,
        Quantity::SpeedTangentialOut,
        Quantity::SpinOut,
        Quantity::TimePeak,
        Quantity::ContactTime,
        Quantity::ImpulseHertz,
        Quantity::ImpulseAdhesionRebound,
    ];
    let laws = [Law::Ring { strength: Column::All(250.0), damping: Column::All(6.25) }, Law::WithoutTension];
    for (law, quantities) in laws.into_iter().flat_map(|law| [(law, &quantities[..4]), (law, &quantities[..])]) {
        let contacts = Contacts {
            radius: Column::Each(&radius),
            density: Column::All(2600.0),
            stiffness: Column::All(7.5e10),
            law,
            damping: Damping::Hysteretic(Column::Each(&damping)),
            surface: Surface::Coulomb { friction: Column::All(0.1) },
            ..Contacts::default()
        };
        let (speed_tangential, spin) = (Column::All(3.0), Column::All(1e5));
        let motions = Motions::Planar { speed_normal: Column::Each(&speed), speed_tangential, spin };
        let together = contacts.simulate_in_lanes(&motions, ROWS, &quick, &sure, quantities);
        let [by_quick, by_sure] = [
            contacts.simulate(&motions, ROWS, &quick, quantities),
            contacts.simulate(&motions, ROWS, &sure, quantities),
        ];
        let mut others = 0;
        for row in 0..ROWS {
            let decided = by_quick.class[row].is_some_and(|class| class != Class::Undecided);
            let single = if decided { &by_quick } else { &by_sure };
            others += usize::from(!decided);
            assert_eq!((together.status[row], together.class[row]), (single.status[row], single.class[row]), "{row}");
            for ((_, numbers), (_, expected)) in together.quantities.iter().zip(&single.quantities) {
                let (number, expected) = (numbers[row], expected[row]);
                assert_eq!(number.to_bits(), expected.to_bits(), "row {row}: {number:e} {expected:e}");
            }
        }
        let without_tension = law == Law::WithoutTension;
        assert!(if without_tension { others == ROWS } else { others > 50 && others < ROWS - 300 }, "{others}");
        assert!(matches!(together.status[400], RowStatus::Refused(_)));
        let solved = together.status.iter().filter(|status| **status == RowStatus::Solved).count();
        assert_eq!(solved, ROWS - 2);
    }
    Ok(())
}

/// Rigid bodies with all laws, of spheres of every class in the lanes of a group.
#[test]
fn rigid_bodies_in_lanes_agree_with_single_calls() -> Result<(), InputError> {
    const ROWS: usize = 1003;
    let numbers = |low, high, turn: usize| -> Vec<f64> {
        (0..ROWS).map(|row| between(low, high, ((row * 7 + turn) % ROWS) as u32 + 1)).collect()
    };
    let (radius, mut speed) = (numbers(1e-6, 2e-5, 0), numbers(0.05, 50.0, 5));
    (speed[3], speed[400]) = (-1.0, f64::NAN);
    // Some arrive without slip.
    let along = |step: usize| -> Vec<f64> { (0..ROWS).map(|row| (row % step) as f64).collect() };
    let (tangential, spin) = (along(3), along(2));
    let motions = Motions::Planar {
        speed_normal: Column::Each(&speed),
        speed_tangential: Column::Each(&tangential),
        spin: Column::Each(&spin),
    };
    let all = Column::All;
    let restitutions = [
        Restitution::Constant(all(0.9)),
        Restitution::Power { speed: all(130.0), power: all(1.0) },
        Restitution::Power { speed: all(130.0), power: all(0.7) },
        Restitution::ElasticPlastic(all(3.0)),
    ];
    let adhesions = [
        Adhesion::Coefficient(all(0.2)),
        Adhesion::Work(all(2.22e-12)),
        Adhesion::Speed { speed: all(1.0), power: all(2.0) },
    ];
    let quantities = [
        Quantity::OverallRestitution,
        Quantity::ReboundSpeed,
        Quantity::SpeedTangentialOut,
        Quantity::SpinOut,
        Quantity::FrictionOverLimit,
        Quantity::ImpulseRatioOut,
        Quantity::RollingRatio,
        Quantity::VelocityOutX,
    ];
    let mut classes = Vec::new();
    for (restitution, adhesion) in restitutions.iter().flat_map(|law| adhesions.map(|adhesion| (*law, adhesion))) {
        let bodies = RigidBodies {
            radius: Column::Each(&radius),
            density: all(2600.0),
            gyration_ratio: all(0.4),
            restitution,
            adhesion,
            friction: all(0.1),
            rolling_arm: all(0.0),
        };
        let impacts = bodies.classify(&motions, ROWS, &quantities);
        for row in 0..ROWS {
            let sphere = Sphere::new(radius[row], 2600.0, 0.4)?;
            let Ok(before) = NormalMotion::new(speed[row]) else {
                assert!(matches!(impacts.status[row], RowStatus::Refused(_)) && impacts.class[row].is_none());
                assert!(impacts.quantities.iter().all(|(_, numbers)| numbers[row].is_nan()));
                continue;
            };
            let before = before.with_tangential(tangential[row])?.with_spin(&sphere, spin[row])?;
            let scene = RigidBody::new(sphere, restitution.at(row)?)
                .with_adhesion(adhesion.at(&sphere, row)?)
                .with_friction(0.1)?;
            let (impact, class) = (scene.impact(&before), scene.classify(&before));
            assert_eq!(
                (impacts.status[row], impacts.class[row]),
                (RowStatus::Solved, Some(class.class())),
                "row {row}"
            );
            classes.push(class.class());
            let expected = [
                impact.normal.overall_restitution(),
                impact.normal.rebound_speed(),
                impact.tangential.velocity(),
                impact.tangential.spin(&sphere),
                class.contact.friction_over_limit.unwrap_or(f64::NAN),
                impact.tangential.impulse_ratio(),
                impact.tangential.rolling_ratio(),
                f64::NAN,
            ];
            for ((quantity, numbers), expected) in impacts.quantities.iter().zip(expected) {
                let number = numbers[row];
                assert_eq!(
                    number.to_bits(),
                    expected.to_bits(),
                    "row {row}, {}: {number:e} {expected:e}",
                    quantity.name()
                );
            }
        }
    }
    for class in [
        Class::ReboundSliding,
        Class::ReboundRolling,
        Class::CapturedSliding,
        Class::CapturedRolling,
        Class::CapturedResting,
    ] {
        assert!(classes.iter().filter(|other| **other == class).count() > 20, "{class}");
    }
    Ok(())
}

#[test]
fn eight_rigid_bodies_agree_with_single_calls() -> Result<(), InputError> {
    fn scene<T: Real>(radius: T, speed: T) -> Result<Impact<T, TangentialImpact<T>>, InputError> {
        let sphere = Sphere::solid(radius, T::constant(2600.0))?;
        let scene = RigidBody::new(sphere, SpeedRestitution::new(T::constant(130.0))?)
            .with_work_of_adhesion(T::constant(2.22e-12))?
            .with_friction(T::constant(0.1))?;
        Ok(scene.impact(&NormalMotion::new(speed)?.with_tangential(T::constant(2.0))?))
    }
    for group in 0..100 {
        let numbers = |low, high, turn: u32| -> [f32; 8] {
            array::from_fn(|lane| between(low, high, 1 + 8 * group + (lane as u32 + turn) % 8) as f32)
        };
        let (radius, speed) = (numbers(1e-6, 2e-5, 0), numbers(0.5, 50.0, 3));
        let together = scene(F32x8::from(radius), F32x8::from(speed))?;
        for lane in 0..8 {
            assert_eq!(together.lane(|numbers| <[f32; 8]>::from(numbers)[lane]), scene(radius[lane], speed[lane])?);
        }
    }
    Ok(())
}
