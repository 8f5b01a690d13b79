//! Everything that a scene with friction can be asked for.

use microimpact::contact::{
    ContactImpulses, ContactTimes, ContactWorks, Impulses, Method, PaperScene, SimulatedImpact, Slip, SlipHistory,
    TangentialVelocities, Times, Works,
};
use microimpact::{InputError, PlanarMotion, Real};
use reference::Case;

/// All outputs.
pub const EVERYTHING: (Times, Impulses, Works, Slip) = (Times, Impulses, Works, Slip);

/// What they are.
pub type Everything<T> = (ContactTimes<T>, ContactImpulses<T>, ContactWorks<T>, SlipHistory<T>);

/// An impact with all outputs.
pub type Impact<T> = (SimulatedImpact<T, TangentialVelocities<T>>, Everything<T>);

/// The impact of a scene, under a peeling moment if there is one.
pub fn solve<T: Real>(
    scene: &PaperScene<T>,
    peeling: Option<T>,
    motion: &PlanarMotion<T>,
    method: &impl Method<T>,
) -> Result<Impact<T>, InputError> {
    match peeling {
        Some(lambda) => scene.with_peeling(lambda)?.solve_for(motion, method, EVERYTHING),
        None => scene.solve_for(motion, method, EVERYTHING),
    }
}

/// The impact of a case of the reference.
pub fn solve_case<T: Real>(case: &Case, method: &impl Method<T>) -> Result<Impact<T>, InputError> {
    solve(&case.scene()?, case.peeling(), &case.motion()?, method)
}
