//! The crates numeris and multicalc on the regularised equations, which they are given ready to solve.
//!
//! Neither finds events without an allocator. They are told a place short of each event, at one of several distances,
//! and take the rest with the event's own variable as the independent one (Henon 1982).

use core::hint::black_box;

use microimpact::Real;
use multicalc::Numeric;
use multicalc::ode::Rk45;
use numeris::FloatScalar;
use numeris::ode::{AdaptiveSettings, RKAdaptive, RKTS54, RKV87};

use super::inputs::Inputs;
use super::regularised::{LONGEST, Regularised, UNDAMPED_LENGTH};
use super::{Amount, Contestant, Extent, Number, Reply, Task, Variant, Visitor};

/// A number type of both crates.
pub trait PeerNumber: Number + FloatScalar + Numeric {
    /// The defaults of numeris.
    fn settings() -> AdaptiveSettings<Self>;
}

impl PeerNumber for f32 {
    fn settings() -> AdaptiveSettings<Self> {
        AdaptiveSettings::default()
    }
}

impl PeerNumber for f64 {
    fn settings() -> AdaptiveSettings<Self> {
        AdaptiveSettings::default()
    }
}

/// How far towards an event a solver goes that has none, before it changes the variable.
pub const FRACTIONS: [f64; 3] = [0.97, 0.85, 0.7];

/// Steps after which a solver gives up.
const MOST_STEPS: usize = 10_000;

/// Tolerances, for each distance from an event.
pub fn visit<T: PeerNumber>(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    let Some(groups) = inputs.normal::<T>().ok().and_then(|(scene, motion)| scene.groups(&motion).ok()) else { return };
    let equations = Regularised::new(&groups);
    let steps = 256;
    let step = <T as Real>::constant(UNDAMPED_LENGTH / f64::from(steps));
    let Some((_, events, _)) = equations.solve::<2>(step, steps * LONGEST) else { return };
    for fraction in FRACTIONS {
        let places = events.map(|event| <T as Real>::constant(fraction) * event);
        for tolerance in extent.tolerances::<T>() {
            let contestant = |method, algorithm| Contestant {
                task: Task::Normal,
                method,
                variant: Variant::Algorithm(algorithm, fraction),
                amount: Amount::Tolerance(tolerance),
            };
            let tolerance = <T as Real>::constant(tolerance);
            visitor.visit::<T>(contestant("numeris", "RKTS54"), move || {
                numeris::<T, RKTS54, 7, 4>(black_box(equations), places, black_box(tolerance))
            });
            if T::ROUNDING < 1e-10 {
                visitor.visit::<T>(contestant("numeris", "RKV87"), move || {
                    numeris::<T, RKV87, 17, 7>(black_box(equations), places, black_box(tolerance))
                });
            }
            visitor.visit::<T>(contestant("multicalc", "Rk45"), move || {
                multicalc(black_box(equations), places, black_box(tolerance))
            });
        }
    }
}

fn numeris<T, A, const STAGES: usize, const NI: usize>(
    equations: Regularised<T>,
    places: [T; 2],
    tolerance: T,
) -> Option<Reply<T>>
where
    T: PeerNumber,
    A: RKAdaptive<STAGES, NI>,
{
    let end = equations.without_events(places, |system, from, state: [T; 2], to| {
        let rates = |_, state: &numeris::Vector<T, 2>| numeris::Vector::from_array(system.rates([state[0], state[1]]));
        let settings = AdaptiveSettings {
            abs_tol: tolerance,
            rel_tol: tolerance,
            min_step: <T as Real>::constant(1e-12),
            max_steps: MOST_STEPS,
            ..T::settings()
        };
        let solution = A::integrate(from, to, &numeris::Vector::from_array(state), rates, &settings).ok()?;
        Some([solution.y[0], solution.y[1]])
    })?;
    Some(Reply::normal(equations.restitution(&end)))
}

fn multicalc<T: PeerNumber>(equations: Regularised<T>, places: [T; 2], tolerance: T) -> Option<Reply<T>> {
    let end = equations.without_events(places, |system, from, state: [T; 2], to| {
        let rates = |_: T, state: &multicalc::Vector<2, T>| multicalc::Vector::new(system.rates(state.into_array()));
        let solver = Rk45::default().with_rtol(tolerance).with_atol(tolerance).with_max_steps(MOST_STEPS);
        Some(solver.solve(&rates, from, &multicalc::Vector::new(state), to).ok()?.into_array())
    })?;
    Some(Reply::normal(equations.restitution(&end)))
}
