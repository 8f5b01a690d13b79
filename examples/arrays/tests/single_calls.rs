//! Rows agree with single calls of the library, and each row has a status of its own.

use impact_arrays::{
    Adhesion, Column, Contacts, Damping, Law, Motions, Quantity, Restitution, RigidBodies, RowStatus, Surface,
};
use methods::{MethodChoice, Refusal};
use microimpact::contact::{Adaptive, Collocation, Contact, FixedCost, JkrEnd, Method, RungeKuttaGill, Slip, Times};
use microimpact::space::{Pair, SpatialMotion, Wall};
use microimpact::{
    Class, CriticalSpeed, InputError, NormalMotion, Outcome, Parameter, RigidBody, SpeedRestitution, Sphere, Stiffness,
};

/// More rows than a thread takes at a time.
const ROWS: usize = 700;
const TOLERANCE: f64 = 1e-9;

fn between(low: f64, high: f64, row: usize) -> f64 {
    low * (high / low).powf(row as f64 / (ROWS - 1) as f64)
}

fn column(low: f64, high: f64) -> Vec<f64> {
    (0..ROWS).map(|row| between(low, high, row)).collect()
}

fn spheres<'a>(radius: &'a [f64]) -> Contacts<'a> {
    Contacts {
        radius: Column::Each(radius),
        density: Column::All(2600.0),
        stiffness: Column::All(7.5e10),
        damping: Damping::Hysteretic(Column::All(10.5)),
        surface: Surface::Coulomb { friction: Column::All(0.1) },
        ..Contacts::default()
    }
}

fn planar<'a>(speed_normal: &'a [f64], speed_tangential: f64) -> Motions<'a> {
    let (speed_tangential, spin) = (Column::All(speed_tangential), Column::All(1e5));
    Motions::Planar { speed_normal: Column::Each(speed_normal), speed_tangential, spin }
}

/// The typed scenes of the library, not those that the package builds.
#[test]
fn contacts_agree_with_typed_scenes() -> Result<(), InputError> {
    let (radius, speed) = (column(1e-6, 2e-5), column(0.05, 50.0));
    let method = Adaptive::new(TOLERANCE)?;
    let work = Column::All(0.4);
    let laws = [
        Law::Hertz,
        Law::Ring { strength: Column::All(250.0), damping: Column::All(6.25) },
        Law::Dmt { work },
        Law::Jkr { work, end: JkrEnd::PullOff },
    ];
    let quantities =
        [Quantity::OverallRestitution, Quantity::SpeedTangentialOut, Quantity::ContactTime, Quantity::Rotation];
    for law in laws {
        let contacts = Contacts { law, ..spheres(&radius) };
        let impacts = contacts.simulate(&planar(&speed, 3.0), ROWS, &method, &quantities);
        let quick = contacts.simulate(&planar(&speed, 3.0), ROWS, &method, &quantities[..2]);
        let mut captures = 0;
        for row in 0..ROWS {
            let sphere = Sphere::solid(radius[row], 2600.0)?;
            let before = NormalMotion::new(speed[row])?.with_tangential(3.0)?.with_spin(&sphere, 1e5)?;
            let stiffness = Stiffness::new(7.5e10)?;
            let hertz = Contact::hertz(sphere, stiffness).with_damping(10.5)?;
            let outputs = (Times, Slip);
            let (impact, (times, slip)) = match law {
                Law::Ring { .. } => {
                    hertz.with_ring(250.0, 6.25)?.with_friction(0.1)?.solve_for(&before, &method, outputs)
                }
                Law::Dmt { .. } => hertz.with_dmt(0.4)?.with_friction(0.1)?.solve_for(&before, &method, outputs),
                Law::Jkr { .. } => {
                    let law = microimpact::contact::JkrLaw::new(stiffness, 0.4)?.ending_at(JkrEnd::PullOff);
                    Contact::new(sphere, law.with_damping(10.5)?)
                        .with_friction(0.1)?
                        .solve_for(&before, &method, outputs)
                }
                _ => hertz.with_friction(0.1)?.solve_for(&before, &method, outputs),
            }?;
            assert_eq!(impacts.status[row], RowStatus::Solved);
            assert_eq!(impacts.class[row], impact.class(), "{law:?}, row {row}");
            assert_eq!(quick.class[row], impact.class(), "{law:?}, row {row}");
            if impact.class() == Some(Class::Undecided) {
                continue;
            }
            captures += u32::from(impact.normal.outcome() == Some(Outcome::Capture));
            let number = |quantity| impacts.numbers(quantity).map_or(f64::NAN, |numbers| numbers[row]);
            let e = impact.normal.overall_restitution();
            assert_eq!(number(Quantity::OverallRestitution), e);
            assert!(
                (quick.numbers(Quantity::OverallRestitution).unwrap()[row].powi(2) - e * e).abs() < 2.0 * TOLERANCE
            );
            assert_eq!(number(Quantity::SpeedTangentialOut), impact.tangential.velocity());
            match times.contact {
                Some(time) => {
                    assert_eq!(number(Quantity::ContactTime), time);
                    assert_eq!(number(Quantity::Rotation), slip.rotation);
                }
                None => assert!(number(Quantity::ContactTime).is_nan()),
            }
        }
        assert_eq!(captures == 0, law == Law::Hertz, "{law:?}: {captures} captures");
    }
    Ok(())
}

#[test]
fn rigid_bodies_agree_with_single_calls() -> Result<(), InputError> {
    let (radius, speed) = (column(1e-6, 2e-5), column(0.05, 50.0));
    let bodies = RigidBodies {
        radius: Column::Each(&radius),
        density: Column::All(2600.0),
        gyration_ratio: Column::All(0.4),
        restitution: Restitution::Power { speed: Column::All(130.0), power: Column::All(1.0) },
        adhesion: Adhesion::Work(Column::All(2.22e-12)),
        friction: Column::All(0.1),
        rolling_arm: Column::All(0.0),
    };
    let quantities = [Quantity::OverallRestitution, Quantity::SpinOut, Quantity::EnergyAfter];
    let impacts = bodies.classify(&planar(&speed, 3.0), ROWS, &quantities);
    let critical = bodies.critical_speeds(ROWS);
    for row in 0..ROWS {
        let sphere = Sphere::solid(radius[row], 2600.0)?;
        let scene = RigidBody::new(sphere, SpeedRestitution::new(130.0)?)
            .with_work_of_adhesion(2.22e-12)?
            .with_friction(0.1)?;
        let before = NormalMotion::new(speed[row])?.with_tangential(3.0)?.with_spin(&sphere, 1e5)?;
        let impact = scene.impact(&before);
        assert_eq!(impacts.class[row], Some(scene.classify(&before).class()));
        assert_eq!(critical[row], Ok(scene.critical_speed()));
        let number = |quantity| impacts.numbers(quantity).map_or(f64::NAN, |numbers| numbers[row]);
        assert_eq!(number(Quantity::OverallRestitution), impact.normal.overall_restitution());
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs().max(f64::MIN_POSITIVE);
        assert!(close(number(Quantity::SpinOut), impact.tangential.spin(&sphere)));
        assert!(close(number(Quantity::EnergyAfter), impact.energy(&sphere).after));
    }
    Ok(())
}

#[test]
fn motions_in_space_agree_with_a_wall() -> Result<(), InputError> {
    let (radius, speed) = (column(3e-6, 2e-5), column(0.5, 50.0));
    let fall: Vec<f64> = speed.iter().map(|speed| -speed).collect();
    let law = Law::Ring { strength: Column::All(250.0), damping: Column::All(6.25) };
    let contacts = Contacts { law, ..spheres(&radius) };
    let all = |vector: [f64; 3]| vector.map(Column::All);
    let (normal, wall_velocity, spin) = ([0.0, 0.6, 0.8], [0.1, 0.2, 0.3], [1e4, 2e4, -3e4]);
    let motions = Motions::Wall {
        velocity: [Column::All(2.0), Column::All(-1.0), Column::Each(&fall)],
        spin: all(spin),
        normal: all(normal),
        wall_velocity: all(wall_velocity),
    };
    let quantities = [Quantity::VelocityOutX, Quantity::VelocityOutY, Quantity::VelocityOutZ, Quantity::SpinOutY];
    let method = FixedCost::<7>::new(3)?;
    let impacts = contacts.simulate(&motions, ROWS, &method, &quantities);
    for row in 0..ROWS {
        let sphere = Sphere::solid(radius[row], 2600.0)?;
        let before = SpatialMotion::new([2.0, -1.0, fall[row]], spin)?;
        let before = Wall::moving(normal, wall_velocity)?.incidence(&sphere, &before)?;
        let scene = Contact::hertz(sphere, Stiffness::new(7.5e10)?)
            .with_damping(10.5)?
            .with_ring(250.0, 6.25)?
            .with_friction(0.1)?;
        let number = |index: usize| impacts.quantities[index].1[row];
        let after = before.after(&scene.solve(&before, &method)?).unwrap();
        let expected = [after.velocity()[0], after.velocity()[1], after.velocity()[2], after.spin()[1]];
        for (index, expected) in expected.into_iter().enumerate() {
            assert!(
                (number(index) - expected).abs() <= 1e-12 * expected.abs(),
                "row {row}: {} {expected}",
                number(index)
            );
        }
    }
    Ok(())
}

#[test]
fn two_spheres_agree_with_a_pair() -> Result<(), InputError> {
    let (radius, speed) = (column(3e-6, 2e-5), column(0.5, 50.0));
    let contacts = Contacts { law: Law::Dmt { work: Column::All(0.4) }, ..spheres(&radius) };
    let all = |vector: [f64; 3]| vector.map(Column::All);
    let (normal, spins) = ([0.0, 0.6, 0.8], [[1e4, 2e4, -3e4], [0.0, 1e5, 0.0]]);
    let motions = Motions::Pair {
        velocities: [all([2.0, -1.0, -1.0]), [Column::All(0.5), Column::All(0.0), Column::Each(&speed)]],
        spins: spins.map(all),
        normal: all(normal),
        radius: Column::All(8e-6),
        density: Column::All(1000.0),
        gyration_ratio: Column::All(0.4),
    };
    let quantities = [
        Quantity::VelocityOutX,
        Quantity::SpinOutZ,
        Quantity::Velocity2OutX,
        Quantity::Velocity2OutZ,
        Quantity::Spin2OutY,
    ];
    let method = Adaptive::new(TOLERANCE)?;
    let impacts = contacts.simulate(&motions, ROWS, &method, &quantities);
    for row in 0..ROWS {
        let pair = Pair::new(Sphere::solid(radius[row], 2600.0)?, Sphere::solid(8e-6, 1000.0)?);
        let first = SpatialMotion::new([2.0, -1.0, -1.0], spins[0])?;
        let before = pair.incidence(normal, [&first, &SpatialMotion::new([0.5, 0.0, speed[row]], spins[1])?])?;
        let scene = Contact::hertz(pair.reduced(), Stiffness::new(7.5e10)?)
            .with_damping(10.5)?
            .with_dmt(0.4)?
            .with_friction(0.1)?;
        let [first, second] = before.after(&scene.solve(&before, &method)?).unwrap();
        let expected =
            [first.velocity()[0], first.spin()[2], second.velocity()[0], second.velocity()[2], second.spin()[1]];
        for ((quantity, numbers), expected) in impacts.quantities.iter().zip(expected) {
            let close = (numbers[row] - expected).abs() <= 1e-9 * expected.abs();
            assert!(close, "row {row}, {}: {} {expected}", quantity.name(), numbers[row]);
        }
    }
    let pulled = Contacts { external_force: Column::All(1e-9), ..contacts };
    let refused = pulled.simulate(&motions, 1, &method, &[]).status[0];
    assert!(matches!(refused, RowStatus::Refused(error) if error.parameter == Parameter::ExternalForce), "{refused:?}");
    Ok(())
}

#[test]
fn each_row_has_its_own_status() -> Result<(), InputError> {
    let (radius, mut speed) = (column(1e-6, 2e-5), column(0.05, 50.0));
    (speed[3], speed[400]) = (-1.0, f64::NAN);
    let contacts = spheres(&radius);
    // The column is shorter than the number of rows.
    let impacts =
        contacts.simulate(&planar(&speed, 0.0), ROWS + 1, &Adaptive::new(TOLERANCE)?, &[Quantity::OverallRestitution]);
    let refused: Vec<usize> = (0..=ROWS).filter(|row| impacts.status[*row] != RowStatus::Solved).collect();
    assert_eq!(refused, [3, 400, ROWS]);
    let parameter = |row: usize| match impacts.status[row] {
        RowStatus::Refused(error) => Some(error.parameter),
        _ => None,
    };
    assert_eq!((parameter(3), parameter(ROWS)), (Some(Parameter::ApproachSpeed), Some(Parameter::Radius)));
    assert_eq!(impacts.first_failure().map(|(row, _)| row), Some(3));
    assert!(impacts.class[3].is_none() && impacts.quantities[0].1[3].is_nan());

    // A method that does not converge says so in its rows alone.
    let damping: Vec<f64> = (0..ROWS).map(|row| if row % 2 == 0 { 1.0 } else { 1e4 }).collect();
    let contacts = Contacts { damping: Damping::Hysteretic(Column::Each(&damping)), ..spheres(&radius) };
    let speed = column(0.5, 5.0);
    let impacts = contacts.simulate(&planar(&speed, 0.0), ROWS, &FixedCost::<5>::new(3)?, &[]);
    for row in 0..ROWS {
        let expected = if row % 2 == 0 { RowStatus::Solved } else { RowStatus::NotConverged };
        assert_eq!(impacts.status[row], expected, "row {row}");
    }
    Ok(())
}

#[test]
fn critical_speeds_are_those_of_the_paper() -> Result<(), InputError> {
    let law = Law::Ring { strength: Column::All(250.0), damping: Column::All(6.25) };
    // The first sphere is that of figure 6.
    let contacts = Contacts { law, ..spheres(&[2.5e-6, -1.0]) };
    assert!(contacts.critical_speeds(2, &Adaptive::new(TOLERANCE)?, || true).is_none());
    let found = contacts.critical_speeds(2, &Adaptive::new(TOLERANCE)?, || false).unwrap();
    assert!(matches!(found[0], Ok(CriticalSpeed::At(speed)) if (speed - 5.159_566_762).abs() < 1e-8));
    assert_eq!(found[1].map_err(|error| error.parameter), Err(Parameter::Radius));
    Ok(())
}

/// A method that is chosen at run time is that of the library's type, and says which laws it cannot represent.
#[test]
fn chosen_methods_agree_with_their_types() -> Result<(), Refusal> {
    fn compare(choice: MethodChoice<f64>, method: &impl Method<f64>) -> Result<(), Refusal> {
        let (radius, speed) = (column(1e-6, 2e-5), column(0.05, 50.0));
        let law = Law::Ring { strength: Column::All(250.0), damping: Column::All(6.25) };
        let contacts = Contacts { law, ..spheres(&radius) };
        let quantities = [Quantity::OverallRestitution, Quantity::SpinOut, Quantity::ContactTime];
        let impacts = contacts.simulate_by(choice, &planar(&speed, 3.0), ROWS, &quantities, || false)?;
        let mut rebounds = 0;
        for row in (0..ROWS).step_by(7) {
            let sphere = Sphere::solid(radius[row], 2600.0)?;
            let before = NormalMotion::new(speed[row])?.with_tangential(3.0)?.with_spin(&sphere, 1e5)?;
            let hertz = Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?;
            let scene = hertz.with_ring(250.0, 6.25)?.with_friction(0.1)?;
            // By the method that is compiled for it too, a scene without a moment.
            let (impact, times) = match choice {
                MethodChoice::Adaptive { .. } | MethodChoice::FixedCost { .. } => {
                    scene.solve_for(&before, method, Times)?
                }
                _ => scene.with_peeling(0.0)?.solve_for(&before, method, Times)?,
            };
            assert_eq!(impacts.class[row], impact.class(), "{choice:?}, row {row}");
            let Some(time) = times.contact else { continue };
            rebounds += 1;
            let numbers = impacts.quantities.iter().map(|(_, numbers)| numbers[row]);
            let expected = [impact.normal.overall_restitution(), impact.tangential.spin(), time];
            for (number, expected) in numbers.zip(expected) {
                let close = (number - expected).abs() <= 1e-12 * expected.abs();
                assert!(close, "{choice:?}, row {row}: {number:e} {expected:e}");
            }
        }
        assert!(rebounds > 30, "{choice:?}: {rebounds}");

        let jkr = Contacts { law: Law::Jkr { work: Column::All(0.4), end: JkrEnd::PullOff }, ..contacts };
        let represented = matches!(choice, MethodChoice::Adaptive { .. } | MethodChoice::Collocation { .. });
        let expected = if represented { RowStatus::Solved } else { RowStatus::Unsupported };
        assert_eq!(jkr.simulate_by(choice, &planar(&speed, 3.0), ROWS, &[], || false)?.status, [expected; ROWS]);
        let stopped = contacts.simulate_by(choice, &planar(&speed, 3.0), ROWS, &quantities, || true)?;
        assert_eq!(stopped.status, [RowStatus::NotConverged; ROWS]);

        let surface = Surface::Compliant { friction: Column::All(0.1), stiffness_ratio: Column::All(0.8) };
        let compliant = Contacts { surface, law: Law::Hertz, ..contacts };
        let expected = match choice {
            MethodChoice::Adaptive { .. } => RowStatus::Solved,
            _ => RowStatus::Unsupported,
        };
        assert_eq!(compliant.simulate_by(choice, &planar(&speed, 3.0), 1, &[], || false)?.status, [expected]);
        Ok(())
    }
    compare(MethodChoice::Adaptive { tolerance: 1e-6 }, &Adaptive::new(1e-6)?)?;
    compare(MethodChoice::Collocation { nodes: 6, tolerance: 1e-5 }, &Collocation::<6, f64>::new(1e-5)?)?;
    compare(MethodChoice::FixedCost { nodes: 7, iterations: 3 }, &FixedCost::<7>::new(3)?.with_outputs::<13>())?;
    compare(MethodChoice::RungeKuttaGill { steps: 300 }, &RungeKuttaGill::new(300))
}
