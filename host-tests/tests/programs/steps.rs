//! Tables made in steps: each keeps its budget, none loses what was done, and the table is the one that is made at once.

use microimpact::contact::{Collocation, Contact, Impulses, RingScene};
use microimpact::table::{
    BoundarySlice, BoundarySliceMaker, BoundaryTable, BoundaryTableMaker, RestitutionTable, RestitutionTableMaker,
    TableRebound,
};
use microimpact::{CriticalSpeed, InputError, NormalMotion, Parameter, Sphere, Stiffness};

const SMALLEST: f32 = 2e-6;
const LARGEST_RATIO: f32 = 10.0;
const BUDGETS: [usize; 6] = [1, 2, 5, 7, 8, 1000];

fn scene(radius: f32) -> Result<RingScene<f32>, InputError> {
    let sphere = Sphere::solid(radius, 2600.0)?;
    Contact::hertz(sphere, Stiffness::new(7.5e10)?).with_damping(10.5)?.with_ring(250.0, 6.25)
}

fn critical(radius: f32) -> Result<CriticalSpeed<f32>, InputError> {
    scene(radius)?.critical_speed(&Collocation::<7, f32>::new(1e-6)?)
}

fn rebound(radius: f32, speed: f32) -> Result<TableRebound<f32>, InputError> {
    let (scene, method) = (scene(radius)?, Collocation::<7, f32>::new(1e-6)?);
    let (impact, impulses) = scene.solve_for(&NormalMotion::new(speed)?, &method, Impulses)?;
    let impulse = impulses.elastic / (scene.sphere().mass() * speed);
    Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
}

fn boundary() -> BoundaryTable<3> {
    BoundaryTable::new(SMALLEST, critical).unwrap()
}

/// Steps with a budget until something is made. Each makes all the calls that it may, except the last, which makes those that are left.
fn in_steps<M>(budget: usize, all: usize, mut step: impl FnMut(usize, &mut usize) -> Option<M>) -> M {
    let mut done = 0;
    loop {
        let mut calls = 0;
        let made = step(budget, &mut calls);
        assert_eq!(calls, budget.min(all - done), "{done} of {all} calls were done");
        done += calls;
        match made {
            Some(made) => {
                assert_eq!(done, all);
                return made;
            }
            None => assert!(done < all),
        }
    }
}

#[test]
fn boundaries_of_steps_are_those_made_at_once() {
    let expected = boundary();
    for budget in BUDGETS {
        let (mut maker, all) = (BoundaryTableMaker::<3>::new(SMALLEST).unwrap(), BoundaryTableMaker::<3>::CALLS);
        let made = in_steps(budget, all, |budget, calls| {
            let made = maker.step(budget, |radius| {
                *calls += 1;
                critical(radius)
            });
            made.unwrap().copied()
        });
        assert_eq!(made, expected);
        // Asked again, the maker says the same without a call.
        assert_eq!(maker.step(budget, |_: f32| unreachable!()), Ok(Some(&expected)));
        assert_eq!(maker.calls(), all);
    }
}

#[test]
fn cells_that_are_stored_elsewhere_are_filled_in_steps() {
    let expected = boundary();
    for budget in BUDGETS {
        let mut cells = [[i32::MAX; 4]; 3];
        let mut maker = BoundarySliceMaker::new(SMALLEST).unwrap();
        while maker.step(&mut cells, budget, critical).unwrap().is_none() {}
        assert_eq!(maker.step(&mut cells, 0, critical), Ok(Some(expected.as_slice())));
        let (smallest, margin, _) = expected.parts();
        assert_eq!(BoundarySlice::from_parts(smallest, margin, &cells), Ok(expected.as_slice()));
    }
}

#[test]
fn restitution_tables_of_steps_are_those_made_at_once() {
    type Maker = RestitutionTableMaker<f32, 3, 3, 5>;
    let expected = RestitutionTable::new(boundary(), LARGEST_RATIO, rebound).unwrap();
    for budget in BUDGETS {
        let (mut maker, all) = (Maker::new(boundary(), LARGEST_RATIO).unwrap(), Maker::CALLS);
        let made = in_steps(budget, all, |budget, calls| {
            let made = maker.step(budget, |radius, speed| {
                *calls += 1;
                rebound(radius, speed)
            });
            made.unwrap().copied()
        });
        assert_eq!(made, expected);
        assert_eq!(maker.step(budget, |_, _| unreachable!()), Ok(Some(&expected)));
        assert_eq!(maker.calls(), all);
    }
}

/// A source may fail for a while: a busy bus, a sensor that is not ready.
#[test]
fn what_was_done_before_an_error_is_kept() {
    let refused = || Parameter::Density.check(-1.0).unwrap_err();
    let mut maker = BoundaryTableMaker::<3>::new(SMALLEST).unwrap();
    let mut calls = 0;
    let made = loop {
        let made = maker.step(4, |radius| {
            calls += 1;
            if calls % 3 == 0 { Err(refused()) } else { critical(radius) }
        });
        match made {
            Ok(Some(made)) => break *made,
            Ok(None) => {}
            Err(error) => assert_eq!(error.parameter, Parameter::Density),
        }
    };
    assert_eq!(made, boundary());
    let mut maker = RestitutionTableMaker::<f32, 3, 3, 5>::new(made, LARGEST_RATIO).unwrap();
    let made = loop {
        let made = maker.step(50, |radius, speed| {
            calls += 1;
            if calls % 7 == 0 { Err(refused()) } else { rebound(radius, speed) }
        });
        match made {
            Ok(Some(made)) => break *made,
            Ok(None) => {}
            Err(error) => assert_eq!(error.parameter, Parameter::Density),
        }
    };
    assert_eq!(made, RestitutionTable::new(boundary(), LARGEST_RATIO, rebound).unwrap());
}

/// No cubic follows a jump; nothing makes a table of it, however often it is asked.
#[test]
fn a_refused_table_stays_refused() {
    let jump = |radius: f64| Ok(CriticalSpeed::At(if radius < 1.525_878_9e-6 { 1.0 } else { 2.0 }));
    let expected = BoundaryTable::<8>::new(1e-6, jump).unwrap_err();
    let mut maker = BoundaryTableMaker::<8>::new(1e-6).unwrap();
    assert_eq!(maker.step(BoundaryTableMaker::<8>::CALLS - 1, jump), Ok(None));
    for _ in 0..3 {
        assert_eq!(maker.step(1, jump), Err(expected));
    }
}
