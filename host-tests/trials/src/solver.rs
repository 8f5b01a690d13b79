//! Methods with number types, and their answers.

use microimpact::contact::{
    Adaptive, Collocation, Contact, ContactImpulses, ContactTimes, ContactWorks, ErrorControl, FixedCost, Impulses,
    Method, RungeKuttaGill, SimulatedImpact, Slip, SlipHistory, Status, TangentialVelocities, Times, Works,
};
use microimpact::{
    FixedPoint, InputError, NormalMotion, Outcome, PlanarMotion, Real, Sphere, Stiffness, SurfaceMotion,
};
use truth::Scene;

use crate::output::COUNT;

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// f64
    Double,
    /// f32
    Single,
    /// 32 bits without a floating point.
    Fixed,
}

impl Number {
    /// In tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Double => "f64",
            Self::Single => "f32",
            Self::Fixed => "fixed",
        }
    }

    /// One unit in the last place of one.
    pub fn unit(self) -> f64 {
        match self {
            Self::Double => f64::EPSILON,
            Self::Single => f64::from(f32::EPSILON),
            Self::Fixed => FixedPoint::EPSILON.to_f64(),
        }
    }
}

/// What a solver says of a scene.
#[derive(Clone, Debug)]
pub enum Answer {
    /// The inputs are outside a range, or the scene has a term that the solver does not know.
    Refused,
    /// No solution.
    Unsolved,
    /// The status is *solved*.
    Solved {
        /// Rebound, capture or undecided.
        outcome: Outcome,
        /// Error of e^2 that the method states: its tolerance, or its own bound where that is larger.
        stated_error: f64,
        /// Evaluations of a speed or of the forces; none in fixed point, whose methods all cost the same.
        evaluations: Option<u32>,
        /// How the contact point moves, by the velocities after the impact and by the slip history.
        motion: Option<(SurfaceMotion, bool)>,
        /// In the order of [`Output::ALL`](crate::Output::ALL); `None` where a quantity does not exist.
        outputs: Box<[Option<f64>; COUNT]>,
    },
}

/// A method with a number type.
pub struct Solver {
    /// Of the method.
    pub name: &'static str,
    /// Number type.
    pub number: Number,
    /// What the method promises: of e^2, and relative of other outputs.
    pub tolerance: f64,
    /// Whether the answer has all outputs; otherwise it has e^2 alone.
    pub all_outputs: bool,
    /// Whether the method follows a captured sphere until it turns back.
    pub follows_captures: bool,
    solve: Box<dyn Fn(&Scene) -> Answer + Send + Sync>,
}

impl Solver {
    /// The answer to a scene; `None` where the number type does not hold the numbers of the scene.
    pub fn solve(&self, scene: &Scene) -> Option<Answer> {
        let holds = self.number == Number::Double || *scene == scene.in_single_precision();
        holds.then(|| (self.solve)(scene))
    }

    fn new<T: Real>(
        name: &'static str,
        number: Number,
        tolerance: f64,
        method: Result<impl Method<T> + Send + Sync + 'static, InputError>,
    ) -> Self {
        let method = method.expect("the parameters of the methods are in their ranges");
        let solve = move |scene: &Scene| everything(scene, &method, tolerance).unwrap_or(Answer::Refused);
        Self { name, number, tolerance, all_outputs: true, follows_captures: false, solve: Box::new(solve) }
    }

    /// A method that controls its error; only these follow captured spheres.
    fn controlled<T: Real>(
        name: &'static str,
        number: Number,
        method: Result<impl ErrorControl<T> + Send + Sync + 'static, InputError>,
    ) -> Self {
        let tolerance = method.as_ref().map_or(0.0, |method| method.tolerance().to_f64());
        Self { follows_captures: true, ..Self::new(name, number, tolerance, method) }
    }

    fn fixed<const N: usize>(name: &'static str, iterations: u32, tolerance: f64) -> Self
    where
        FixedCost<N>: Method<FixedPoint>,
    {
        let method = FixedCost::<N>::new(iterations).expect("the number of iterations is in its range");
        let solve = move |scene: &Scene| in_fixed_point(scene, &method, tolerance).unwrap_or(Answer::Refused);
        Self {
            name,
            number: Number::Fixed,
            tolerance,
            all_outputs: false,
            follows_captures: false,
            solve: Box::new(solve),
        }
    }
}

/// All solvers that are compared.
///
/// Methods that control their error have their tolerance. Those of fixed cost have the error that their documentation
/// states for mild damping.
pub fn solvers() -> Vec<Solver> {
    use Number::{Double, Single};
    vec![
        Solver::controlled("Adaptive 1e-4", Double, Adaptive::new(1e-4_f64)),
        Solver::controlled("Adaptive 1e-6", Double, Adaptive::new(1e-6_f64)),
        Solver::controlled("Adaptive 1e-9", Double, Adaptive::new(1e-9_f64)),
        Solver::controlled("Adaptive 1e-12", Double, Adaptive::new(1e-12_f64)),
        Solver::controlled("Collocation 5, 3e-4", Double, Collocation::<5, f64>::new(3e-4)),
        Solver::controlled("Collocation 7, 1e-6", Double, Collocation::<7, f64>::new(1e-6)),
        Solver::controlled("Collocation 9, 1e-9", Double, Collocation::<9, f64>::new(1e-9)),
        Solver::controlled("Collocation 12, 1e-12", Double, Collocation::<12, f64>::new(1e-12)),
        Solver::new::<f64>("FixedCost 5 x 3", Double, 1e-5, five(3)),
        Solver::new::<f64>("FixedCost 5 x 12", Double, 1e-5, five(12)),
        Solver::new::<f64>("FixedCost 7 x 3", Double, 1e-6, seven(3)),
        Solver::new::<f64>("FixedCost 7 x 12", Double, 1e-6, seven(12)),
        Solver::new::<f64>("FixedCost 7 x 40", Double, 1e-6, seven(40)),
        Solver::new::<f64>("FixedCost 9 x 6", Double, 1e-7, nine(6)),
        Solver::new::<f64>("FixedCost 9 x 20", Double, 1e-7, nine(20)),
        Solver::new::<f64>("RungeKuttaGill 50", Double, 1e-2, Ok(RungeKuttaGill::new(50))),
        Solver::new::<f64>("RungeKuttaGill 2000", Double, 1e-4, Ok(RungeKuttaGill::new(2000))),
        Solver::controlled("Adaptive 1e-4", Single, Adaptive::new(1e-4_f32)),
        Solver::controlled("Adaptive 1e-6", Single, Adaptive::new(1e-6_f32)),
        Solver::controlled("Collocation 7, 1e-6", Single, Collocation::<7, f32>::new(1e-6)),
        Solver::new::<f32>("FixedCost 5 x 3", Single, 1e-5, five(3)),
        Solver::new::<f32>("FixedCost 7 x 3", Single, 1e-6, seven(3)),
        Solver::new::<f32>("FixedCost 7 x 12", Single, 1e-6, seven(12)),
        Solver::new::<f32>("RungeKuttaGill 5000", Single, 1e-4, Ok(RungeKuttaGill::new(5000))),
        Solver::fixed::<4>("FixedCost 4 x 2", 2, 1e-4),
        Solver::fixed::<5>("FixedCost 5 x 4", 4, 1e-4),
    ]
}

fn five(iterations: u32) -> Result<FixedCost<5>, InputError> {
    FixedCost::<5>::new(iterations)
}

fn seven(iterations: u32) -> Result<FixedCost<7, 12>, InputError> {
    Ok(FixedCost::<7>::new(iterations)?.with_outputs::<12>())
}

fn nine(iterations: u32) -> Result<FixedCost<9, 16>, InputError> {
    Ok(FixedCost::<9>::new(iterations)?.with_outputs::<16>())
}

const EVERYTHING: (Times, Impulses, Works, Slip) = (Times, Impulses, Works, Slip);

type Everything<T> = (ContactTimes<T>, ContactImpulses<T>, ContactWorks<T>, SlipHistory<T>);

/// The answer with all outputs.
fn everything<T: Real>(scene: &Scene, method: &impl Method<T>, tolerance: f64) -> Result<Answer, InputError> {
    let number = T::constant;
    let sphere = Sphere::new(number(scene.radius), number(scene.density), number(scene.gyration_ratio))?;
    let contact = Contact::hertz(sphere, Stiffness::new(number(scene.stiffness))?)
        .with_damping(number(scene.material_damping))?
        .with_ring(number(scene.adhesion), number(scene.adhesion_damping))?
        .with_friction(number(scene.friction))?;
    let motion: PlanarMotion<T> = NormalMotion::new(number(scene.speed))?
        .with_tangential(number(scene.tangential))?
        .with_spin(&sphere, number(scene.spin))?;
    let (force, peeling) = (number(scene.force), number(scene.peeling));
    let (impact, outputs) = match (scene.force != 0.0, scene.peeling != 0.0) {
        (false, false) => contact.solve_for(&motion, method, EVERYTHING),
        (false, true) => contact.with_peeling(peeling)?.solve_for(&motion, method, EVERYTHING),
        (true, false) => contact.with_external_force(force)?.solve_for(&motion, method, EVERYTHING),
        (true, true) => {
            contact.with_external_force(force)?.with_peeling(peeling)?.solve_for(&motion, method, EVERYTHING)
        }
    }?;
    Ok(answer(&impact, &outputs, tolerance))
}

fn answer<T: Real>(
    impact: &SimulatedImpact<T, TangentialVelocities<T>>,
    outputs: &Everything<T>,
    tolerance: f64,
) -> Answer {
    let SimulatedImpact { normal, tangential, run } = impact;
    let (times, impulses, works, slip) = outputs;
    let Some(outcome) = normal.outcome().filter(|_| run.status == Status::Solved) else {
        return Answer::Unsolved;
    };
    let e = normal.overall_restitution().to_f64();
    let some = |value: T| Some(value.to_f64());
    Answer::Solved {
        outcome,
        stated_error: tolerance.max(run.error_bound.to_f64()),
        evaluations: Some(run.evaluations),
        motion: Some((tangential.motion(), slip.slides)),
        outputs: Box::new([
            Some(e * e),
            normal.peak_indentation().and_then(some),
            normal.turning_indentation().and_then(some),
            times.peak.and_then(some),
            times.contact.and_then(some),
            slip.rolls_from.and_then(some),
            some(impulses.elastic),
            some(impulses.adhesion_rebound),
            some(works.material),
            some(works.adhesion),
            some(tangential.velocity()),
            some(tangential.spin()),
            some(slip.velocity),
            some(slip.spin),
            some(slip.rotation),
            some(slip.displacement),
        ]),
    }
}

/// The answer in fixed point, from dimensionless numbers of single precision.
fn in_fixed_point(scene: &Scene, method: &impl Method<FixedPoint>, tolerance: f64) -> Result<Answer, InputError> {
    if scene.force != 0.0 {
        return Ok(Answer::Refused);
    }
    let number = |value: f64| value as f32;
    let sphere = Sphere::new(number(scene.radius), number(scene.density), number(scene.gyration_ratio))?;
    let contact = Contact::hertz(sphere, Stiffness::new(number(scene.stiffness))?)
        .with_damping(number(scene.material_damping))?
        .with_ring(number(scene.adhesion), number(scene.adhesion_damping))?;
    let contact = contact.dimensionless(&NormalMotion::new(number(scene.speed))?)?.in_fixed_point()?.solve(method);
    let Some(outcome) = contact.outcome.filter(|_| contact.status == Status::Solved) else {
        return Ok(Answer::Unsolved);
    };
    let mut outputs = Box::new([None; COUNT]);
    outputs[0] = Some(contact.restitution_squared.to_f64());
    let stated_error = tolerance.max(contact.error_bound.to_f64());
    Ok(Answer::Solved { outcome, stated_error, evaluations: None, motion: None, outputs })
}
