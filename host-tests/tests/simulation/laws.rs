//! Laws of contact that are defined outside the library, solved by every method that can carry them.

mod attraction;
mod jkr;
mod outputs;
mod random;
mod reference;
mod spring;

use microimpact::contact::{Contact, ContactLaw, Method, Status};
use microimpact::{NormalMotion, Real};

/// That a method refuses a law instead of answering wrongly.
fn assert_refused<T: Real, L: ContactLaw<T>>(scene: &Contact<T, L>, speed: T, method: &impl Method<T>) {
    let impact = scene.solve(&NormalMotion::new(speed).unwrap(), method).unwrap();
    assert_eq!((impact.run.status, impact.normal.status()), (Status::Unsupported, Status::Unsupported));
    assert_eq!((impact.normal.outcome(), impact.normal.peak_indentation()), (None, None));
    assert_eq!(impact.normal.overall_restitution(), T::ZERO);
}
