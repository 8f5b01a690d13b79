//! What the templates share and you replace by your own: the particle and its surface, the bins of speed, and the sensor.

#![no_std]

use microimpact::instrument::{Instrument, NoLines, PlanarReading, SpeedBins};
use microimpact::rigid::WorkOfAdhesion;
use microimpact::{Coulomb, InputError, Real, RigidBody, SpeedRestitution, Sphere};

/// What classifies the impacts.
pub type Scene<T> = RigidBody<T, SpeedRestitution<T>, WorkOfAdhesion<T>, Coulomb<T>>;

/// Classifier and tally; no pin shows the class.
pub type Counter = Instrument<Scene<f32>, NoLines, f32, 6, 4>;

/// Silver-coated glass on steel: R = k/(k + v) with k = 130 m/s.
///
/// # Errors
/// A number outside its range; none of those here is.
pub fn scene<T: Real>() -> Result<Scene<T>, InputError> {
    let sphere = Sphere::solid(T::constant(5.06e-6), T::constant(2600.0))?;
    RigidBody::new(sphere, SpeedRestitution::new(T::constant(130.0))?)
        .with_work_of_adhesion(T::constant(2.22e-12))?
        .with_friction(T::constant(0.1))
}

/// The scene with an empty tally.
///
/// # Errors
/// As for [`scene`].
pub fn counter() -> Result<Counter, InputError> {
    Ok(Instrument::new(scene()?, NoLines, SpeedBins::new([1.0, 2.0, 4.0, 8.0])?))
}

/// Readings until a template prints its tally and ends.
pub const READINGS: u32 = 1000;

/// Stands for the sensor: reading `number`, from 0 to 10.23 m/s towards the surface and to 8.92 m/s along it, one in eight straight.
pub const fn read_sensor(number: u32) -> PlanarReading<f32> {
    // A multiple of the golden ratio's bits spreads the numbers evenly.
    let spread = number.wrapping_mul(0x9e37_79b9);
    PlanarReading {
        approach: 0.01 * (spread >> 22) as f32,
        tangential: 0.04 * (spread >> 8 & 0xff).saturating_sub(32) as f32,
        peripheral: 0.0,
    }
}
