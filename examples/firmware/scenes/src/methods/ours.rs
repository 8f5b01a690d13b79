//! The methods of this library, the paper's among them, from a scene and a motion in SI units.

use core::hint::black_box;

use microimpact::contact::{
    Adaptive, AdaptiveNodes, Collocation, FixedCost, Method, Nodes, PhaseSamples, RungeKuttaGill, Slip, Status,
};
use microimpact::{FixedPoint, Real};

use super::inputs::Inputs;
use super::{Amount, Contestant, Extent, Number, Reply, Task, Variant, Visitor};

/// Name of the method that chooses by itself.
pub const ADAPTIVE: &str = "Adaptive";
/// Name of collocation in intervals.
pub const COLLOCATION: &str = "Collocation";
/// Name of the method of fixed cost.
pub const FIXED_COST: &str = "FixedCost";
/// Name of the paper's method.
pub const PAPER: &str = "the paper's method";

/// A number type with the tables of all methods.
pub trait Tables:
    Number
    + AdaptiveNodes
    + Nodes<5>
    + PhaseSamples<4, 9>
    + PhaseSamples<5, 7>
    + PhaseSamples<5, 9>
    + PhaseSamples<7, 9>
    + PhaseSamples<9, 9>
    + PhaseSamples<9, 11>
    + PhaseSamples<13, 9>
{
}

impl<T> Tables for T where
    T: Number
        + AdaptiveNodes
        + Nodes<5>
        + PhaseSamples<4, 9>
        + PhaseSamples<5, 7>
        + PhaseSamples<5, 9>
        + PhaseSamples<7, 9>
        + PhaseSamples<9, 9>
        + PhaseSamples<9, 11>
        + PhaseSamples<13, 9>
{
}

/// Numbers of iterations that are worth their cost.
fn iterations(extent: Extent) -> impl Iterator<Item = u32> {
    (2..=8).step_by(if extent.sparse { 2 } else { 1 })
}

/// The motion along the normal.
pub fn normal<T: Tables>(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    let double = T::ROUNDING < 1e-10;
    for iterations in iterations(extent) {
        fixed_cost::<T, 4>(inputs, iterations, visitor);
        fixed_cost::<T, 5>(inputs, iterations, visitor);
        fixed_cost::<T, 7>(inputs, iterations, visitor);
        fixed_cost::<T, 9>(inputs, iterations, visitor);
        if double {
            fixed_cost::<T, 13>(inputs, iterations, visitor);
        }
    }
    for tolerance in extent.tolerances::<T>() {
        collocation::<T, 5>(inputs, tolerance, visitor);
        collocation::<T, 7>(inputs, tolerance, visitor);
        if double {
            collocation::<T, 9>(inputs, tolerance, visitor);
            collocation::<T, 12>(inputs, tolerance, visitor);
        }
        let Ok(method) = Adaptive::new(T::constant(tolerance)) else { continue };
        visit_normal(inputs, ADAPTIVE, Variant::Only, Amount::Tolerance(tolerance), method, visitor);
    }
    for steps in extent.steps(16) {
        let method = RungeKuttaGill::new(steps);
        visit_normal::<T, _>(inputs, PAPER, Variant::Only, Amount::Steps(steps), method, visitor);
    }
}

/// The same with friction and spin, for velocities along the surface.
pub fn oblique<T: Tables>(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    let double = T::ROUNDING < 1e-10;
    for iterations in iterations(extent) {
        oblique_fixed_cost::<T, 5, 7>(inputs, iterations, visitor);
        oblique_fixed_cost::<T, 7, 9>(inputs, iterations, visitor);
        if double {
            oblique_fixed_cost::<T, 9, 11>(inputs, iterations, visitor);
        }
    }
    for tolerance in extent.tolerances::<T>() {
        oblique_collocation::<T, 7>(inputs, tolerance, visitor);
        if double {
            oblique_collocation::<T, 9>(inputs, tolerance, visitor);
            oblique_collocation::<T, 12>(inputs, tolerance, visitor);
        }
        let Ok(method) = Adaptive::new(T::constant(tolerance)) else { continue };
        visit_oblique(inputs, ADAPTIVE, Variant::Only, Amount::Tolerance(tolerance), visitor, method);
    }
    let Ok((scene, motion)) = inputs.oblique::<T>() else { return };
    for steps in extent.steps(16) {
        let contestant =
            Contestant { task: Task::Oblique, method: PAPER, variant: Variant::Only, amount: Amount::Steps(steps) };
        let method = RungeKuttaGill::new(steps);
        visitor.visit::<T>(contestant, move || {
            let (impact, slip) = black_box(&scene).solve_for(black_box(&motion), black_box(&method), Slip).ok()?;
            let surface = Some([slip.velocity, slip.spin]);
            solved(impact.normal.overall_restitution(), surface, impact.run.status)
        });
    }
}

/// Motion along the normal in fixed point, from dimensionless numbers.
pub fn fixed_point(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    for iterations in iterations(extent).take(4) {
        in_fixed_point::<4>(inputs, iterations, visitor);
        in_fixed_point::<5>(inputs, iterations, visitor);
        in_fixed_point::<7>(inputs, iterations, visitor);
    }
}

fn in_fixed_point<const N: usize>(inputs: &Inputs, iterations: u32, visitor: &mut impl Visitor)
where
    FixedPoint: PhaseSamples<N, 9>,
{
    let impact = inputs.normal::<f32>().and_then(|(scene, motion)| scene.dimensionless(&motion)?.in_fixed_point());
    let (Ok(impact), Ok(method)) = (impact, FixedCost::<N>::new(iterations)) else { return };
    let contestant = Contestant {
        task: Task::Normal,
        method: FIXED_COST,
        variant: Variant::Nodes(N),
        amount: Amount::Iterations(iterations),
    };
    visitor.visit::<FixedPoint>(contestant, move || {
        let contact = black_box(&impact).solve(black_box(&method));
        solved(contact.overall_restitution(), None, contact.status)
    });
}

fn fixed_cost<T: Number + PhaseSamples<N, 9>, const N: usize>(
    inputs: &Inputs,
    iterations: u32,
    visitor: &mut impl Visitor,
) {
    let Ok(method) = FixedCost::<N>::new(iterations) else { return };
    visit_normal::<T, _>(inputs, FIXED_COST, Variant::Nodes(N), Amount::Iterations(iterations), method, visitor);
}

fn collocation<T: Number + Nodes<N>, const N: usize>(inputs: &Inputs, tolerance: f64, visitor: &mut impl Visitor) {
    let Ok(method) = Collocation::<N, T>::new(T::constant(tolerance)) else { return };
    visit_normal(inputs, COLLOCATION, Variant::Nodes(N), Amount::Tolerance(tolerance), method, visitor);
}

fn oblique_fixed_cost<T, const N: usize, const M: usize>(inputs: &Inputs, iterations: u32, visitor: &mut impl Visitor)
where
    T: Number + PhaseSamples<N, M>,
{
    let Ok(method) = FixedCost::<N>::new(iterations) else { return };
    let method = method.with_outputs::<M>();
    visit_oblique::<T, _>(inputs, FIXED_COST, Variant::Nodes(N), Amount::Iterations(iterations), visitor, method);
}

fn oblique_collocation<T: Number + Nodes<N>, const N: usize>(
    inputs: &Inputs,
    tolerance: f64,
    visitor: &mut impl Visitor,
) {
    let Ok(method) = Collocation::<N, T>::new(T::constant(tolerance)) else { return };
    visit_oblique(inputs, COLLOCATION, Variant::Nodes(N), Amount::Tolerance(tolerance), visitor, method);
}

fn visit_normal<T: Number, M: Method<T> + 'static>(
    inputs: &Inputs,
    name: &'static str,
    variant: Variant,
    amount: Amount,
    method: M,
    visitor: &mut impl Visitor,
) {
    let Ok((scene, motion)) = inputs.normal::<T>() else { return };
    visitor.visit::<T>(Contestant { task: Task::Normal, method: name, variant, amount }, move || {
        let contact = black_box(&scene).solve_normal(black_box(&motion), black_box(&method)).ok()?;
        solved(contact.overall_restitution(), None, contact.status())
    });
}

fn visit_oblique<T: Number, M: Method<T> + 'static>(
    inputs: &Inputs,
    name: &'static str,
    variant: Variant,
    amount: Amount,
    visitor: &mut impl Visitor,
    method: M,
) {
    let Ok((scene, motion)) = inputs.oblique::<T>() else { return };
    visitor.visit::<T>(Contestant { task: Task::Oblique, method: name, variant, amount }, move || {
        let impact = black_box(&scene).solve(black_box(&motion), black_box(&method)).ok()?;
        let surface = Some([impact.tangential.velocity(), impact.tangential.spin()]);
        solved(impact.normal.overall_restitution(), surface, impact.run.status)
    });
}

fn solved<T: Real>(restitution: T, surface: Option<[T; 2]>, status: Status) -> Option<Reply<T>> {
    (status == Status::Solved).then_some(Reply { restitution, surface })
}
