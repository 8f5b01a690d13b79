//! The methods that compete with this library's: that they solve the same impact, and how fast they converge.

use microimpact_scenes::methods::inputs::{Inputs, TABLE_1};
use microimpact_scenes::methods::ours::{FIXED_COST, PAPER};
use microimpact_scenes::methods::raw::{self, Raw};
use microimpact_scenes::methods::regularised::{LONGEST, Regularised, UNDAMPED_LENGTH};
use microimpact_scenes::methods::{Contestant, Extent, Number, Reply, Task, Visitor, visit, visit_fixed_point};
use reference::case;

/// Slope of the logarithm of the error, from the first to the last number of steps.
fn order(error: impl Fn(u32) -> f64, from: u32, to: u32) -> f64 {
    (error(from) / error(to)).ln() / (f64::from(to) / f64::from(from)).ln()
}

fn error_in_time(inputs: &Inputs, exact: f64, steps: u32) -> f64 {
    let [_, speed] = Raw::<f64>::new(inputs).solve(steps).unwrap();
    (-speed / inputs.approach - exact).abs()
}

#[test]
fn the_inputs_are_those_of_the_reference() {
    let case = case("table1");
    assert_eq!(TABLE_1.radius, case.number("radius_m"));
    assert_eq!(TABLE_1.density, case.number("density_kg_m3"));
    assert_eq!(TABLE_1.stiffness, case.number("stiffness_pa"));
    assert_eq!(TABLE_1.ring, case.number("adhesion_n_m"));
    assert_eq!(TABLE_1.material_damping, case.number("zeta_h"));
    assert_eq!(TABLE_1.ring_damping, case.number("zeta_a"));
    assert_eq!(TABLE_1.friction, case.number("friction"));
    assert_eq!(TABLE_1.approach, case.number("speed_normal_m_s"));
    assert_eq!(TABLE_1.tangential, case.number("speed_tangential_m_s"));
    assert_eq!(TABLE_1.spin, case.number("spin_rad_s"));
}

/// The forces are not smooth at first touch.
#[test]
fn order_in_time_is_three_halves() {
    let exact = case("table1").number("restitution");
    let order = order(|steps| error_in_time(&TABLE_1, exact, steps), 64, 65_536);
    assert!((1.35..1.65).contains(&order), "{order}");
}

/// In the contact radius they are.
#[test]
fn order_in_contact_radius_is_four() {
    let exact = case("table1").number("restitution");
    let (scene, motion) = TABLE_1.normal::<f64>().unwrap();
    let equations = Regularised::new(&scene.groups(&motion).unwrap());
    let error = |steps: u32| {
        let (end, ..) = equations.solve::<2>(UNDAMPED_LENGTH / f64::from(steps), steps * LONGEST).unwrap();
        (equations.restitution(&end) - exact).abs()
    };
    // Where the last steps fall changes the error from one number of steps to the next.
    let largest = |steps: u32| (steps..2 * steps).step_by(steps as usize / 16).map(error).fold(0.0, f64::max);
    let order = order(largest, 32, 1024);
    assert!((3.7..4.5).contains(&order), "{order}");
}

/// A sphere that comes straight down without spin rolls from the start, which is no event.
#[test]
fn friction_does_nothing_where_nothing_slides() {
    let straight = Raw::<f64>::new(&Inputs { spin: 0.0, ..TABLE_1 });
    let ([depth, speed], [_, with_friction, tangential, peripheral]) =
        (straight.solve(256).unwrap(), straight.solve(256).unwrap());
    assert!(depth.abs() < 1e-20);
    assert_eq!((with_friction, tangential, peripheral), (speed, 0.0, 0.0));
}

/// The largest error of each method and number type with its best setting.
#[derive(Default)]
struct Best(Vec<(Task, &'static str, &'static str, f64)>);

impl Visitor for Best {
    fn visit<T: Number>(&mut self, contestant: Contestant, mut run: impl FnMut() -> Option<Reply<T>> + 'static) {
        let case = case("table1");
        let Some(reply) = run() else { return };
        let mut error = (reply.restitution.value() - case.number("restitution")).abs();
        if let Some([velocity, spin]) = reply.surface {
            let relative = |value: T, column| (value.value() / case.number(column) - 1.0).abs();
            error = error.max(relative(velocity, "speed_tangential_out_m_s")).max(relative(spin, "spin_out_rad_s"));
        }
        assert_eq!(reply.surface.is_some(), contestant.task == Task::Oblique);
        let Contestant { task, method, .. } = contestant;
        match self.0.iter_mut().find(|best| (best.0, best.1, best.2) == (task, method, T::NAME)) {
            Some(best) => best.3 = best.3.min(error),
            None => self.0.push((task, method, T::NAME, error)),
        }
    }
}

/// No contestant is drawn slower than it is for a mistake in how it is used: each comes as close as its number type, or
/// the order of the method, lets it.
#[test]
fn every_method_reaches_the_solution() {
    let mut best = Best::default();
    let extent = Extent { most_steps: 16_384, sparse: false };
    visit::<f32>(&TABLE_1, extent, &mut best);
    visit::<f64>(&TABLE_1, extent, &mut best);
    visit_fixed_point(&TABLE_1, extent, &mut best);
    // Along the normal and with friction in both number types, and in fixed point.
    assert_eq!(best.0.len(), 2 * (8 + 5) + 2);
    for (task, method, scalar, error) in best.0 {
        let reached = match (scalar, method) {
            ("f64", PAPER | raw::NAME) => 1e-6,
            ("f64", FIXED_COST) => 1e-9,
            ("f64", _) => 1e-11,
            (_, PAPER | raw::NAME) => 1e-5,
            _ => 3e-6,
        };
        assert!(error < reached, "{task:?}, {method}, {scalar}: {error:.1e}");
    }
}
