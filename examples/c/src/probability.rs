//! Classes with a stated confidence, from the standard errors of a reading.

use microimpact::instrument::{ClassSet, Confident, Reading, UncertainReading};
use microimpact::measure::Estimate;
use microimpact::{AnyModel, InputError, PlanarMotion};

use crate::error::Error;
use crate::memory;
use crate::scene::{SceneConfig, SceneMethod};
use crate::status::{Class, Failure, Status, finish, followed};
use crate::tally::CLASSES;

/// A quantity with its standard error.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measured {
    /// The value.
    pub value: f32,
    /// Its standard error; zero if it is exact.
    pub standard_error: f32,
}

impl Measured {
    fn estimate(self) -> Estimate<f32> {
        Estimate { value: self.value, standard_error: self.standard_error }
    }
}

/// A motion before the impact and a radius, with independent standard errors.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct UncertainMotion {
    /// Approach speed, m/s.
    pub approach: Measured,
    /// Tangential velocity, m/s.
    pub tangential: Measured,
    /// Peripheral velocity, m/s.
    pub peripheral: Measured,
    /// Radius of the particle, m.
    pub radius: Measured,
}

/// Probabilities of the classes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UncertainClass {
    /// The class whose probability reaches the confidence, or MICROIMPACT_CLASS_UNDECIDED.
    pub impact_class: Class,
    /// Probability of each class, in the order of MicroimpactClass. A sphere that may rest counts as rolling.
    pub probabilities: [f32; CLASSES],
}

/// Probabilities of the classes of an uncertain motion, and the class if one reaches the confidence, 0.5 to 1. The scene is that of
/// microimpact_scene_init, whose radius does not count; a contact needs a tolerance, not iterations. A rigid body takes 12 thousand
/// instructions in single precision on a Cortex-M4F, and a contact millions. With standard errors of up to 10 % the error of a
/// probability is below 0.01, and below 0.04 for few motions that are close to capture and to the limit of slip at once, or
/// whose standard errors reach 30 %. Errors above three tenths of the approach speed or of the radius are refused. The error may be null.
/// Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_scene_probabilities(
    scene: *const SceneConfig,
    motion: *const UncertainMotion,
    confidence: f32,
    result: *mut UncertainClass,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let found = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            let motion = followed(memory::read(motion))?;
            followed(memory::write(result, probabilities(&scene, &motion, confidence)?))
        };
        finish(found(), error)
    }
}

fn probabilities(scene: &SceneConfig, motion: &UncertainMotion, confidence: f32) -> Result<UncertainClass, Failure> {
    let reading = UncertainReading {
        approach: motion.approach.estimate(),
        tangential: motion.tangential.estimate(),
        peripheral: motion.peripheral.estimate(),
        radius: motion.radius.estimate(),
    };
    let uncertain = reading.motion()?;
    let of_radius = |radius: f32| SceneConfig { radius, ..*scene };
    let config = of_radius(motion.radius.value).config()?;
    let at = |radius: f32| microimpact::SceneConfig { radius, ..config }.scene();
    let expected = match of_radius(motion.radius.value).check()? {
        (AnyModel::RigidBody(given), _) => {
            let body = |radius: f32, motion: PlanarMotion<f32>| -> Result<_, InputError> {
                // A scene does not change its model.
                Ok((if let AnyModel::RigidBody(body) = at(radius)? { body } else { given }, motion))
            };
            Confident::new(confidence, body)?.probabilities(&uncertain)?
        }
        (AnyModel::Contact(given), SceneMethod::Tolerance(method)) => {
            let contact = |radius: f32, motion: PlanarMotion<f32>| -> Result<_, InputError> {
                Ok((if let AnyModel::Contact(contact) = at(radius)? { contact } else { given }, motion, &method))
            };
            Confident::new(confidence, contact)?.probabilities(&uncertain)?
        }
        _ => return Err(Failure::Status(Status::Choice)),
    };
    let probabilities = expected.by_class();
    let mut classes = microimpact::Class::ALL.iter().zip(probabilities);
    let class = classes.find(|(_, probability)| *probability >= confidence).map(|(class, _)| *class);
    Ok(UncertainClass { impact_class: class.unwrap_or(microimpact::Class::Undecided).into(), probabilities })
}
