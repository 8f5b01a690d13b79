//! Charge, speed and mass from the pulse that a charged particle induces in a tube.

use super::{Clock, ROUNDING, calibration, radius_of, relative_error, with_relative_errors};
use crate::measure::Estimate;
use crate::{InputError, Parameter, Real};

/// What a pulse detector measures of a charged particle.
///
/// ```
/// use microimpact::instrument::sensor::ChargePulse;
///
/// assert_eq!(ChargePulse { height: -210, width: 4000 }.height, -210);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChargePulse {
    /// Height of the pulse above the baseline, in counts of the converter. It has the sign of the charge.
    pub height: i32,
    /// Width of the pulse at half of its height, in ticks of the clock.
    pub width: u32,
}

/// A tube in which a charged particle induces an image charge while it passes.
///
/// The height of the pulse is proportional to the charge, and its width at half of the height is the length of the tube over
/// the speed (Shelton, Hendricks and Wuerker, J. Appl. Phys. 31:1243, 1960).
///
/// ```
/// use microimpact::instrument::sensor::{ChargePulse, Clock, ImageCharge};
/// use microimpact::measure::Estimate;
///
/// let clock = Clock::new(&Estimate { value: 10e6, standard_error: 0.0 }, 5.0)?;
/// let length = Estimate { value: 0.05, standard_error: 0.0005 };
/// // 100 electrons a count, and a noise of 3 counts.
/// let tube = ImageCharge::new(&length, &Estimate { value: 1.6e-17, standard_error: 1.6e-19 }, 3.0, clock)?;
/// let particle = tube.particle(&ChargePulse { height: 210, width: 4000 })?;
/// assert!((particle.charge.value - 3.36e-15_f64).abs() < 1e-20);
/// assert!((particle.speed.value - 125.0).abs() < 1e-9);
/// # Ok::<(), microimpact::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImageCharge<T> {
    length: Estimate<T>,
    sensitivity: Estimate<T>,
    height_variance: T,
    clock: Clock<T>,
}

impl<T: Real> ImageCharge<T> {
    /// Creates the front end from the `length` of the tube (m), the charge of one count (C), the `noise` of the height (standard
    /// deviation, counts) and the clock.
    ///
    /// # Errors
    /// A value is outside its range, or a relative error exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::{Clock, ImageCharge};
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 10e6, standard_error: 0.0 }, 5.0)?;
    /// let [length, sensitivity] = [0.05, 0.0].map(|value| Estimate { value, standard_error: 0.0 });
    /// assert!(ImageCharge::new(&length, &sensitivity, 3.0, clock).is_err());
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn new(length: &Estimate<T>, sensitivity: &Estimate<T>, noise: T, clock: Clock<T>) -> Result<Self, InputError> {
        let noise = Parameter::SignalNoise.check(noise)?;
        Ok(Self {
            length: calibration(Parameter::SensorLength, length)?,
            sensitivity: calibration(Parameter::Sensitivity, sensitivity)?,
            height_variance: noise * noise + T::constant(ROUNDING),
            clock,
        })
    }

    /// Charge and speed of a particle.
    ///
    /// # Errors
    /// The width is zero, the relative error of the speed exceeds a fifth, or the charge is outside its range.
    ///
    /// ```
    /// use microimpact::Parameter;
    /// use microimpact::instrument::sensor::{ChargePulse, Clock, ImageCharge};
    /// use microimpact::measure::Estimate;
    ///
    /// let clock = Clock::new(&Estimate { value: 10e6, standard_error: 0.0 }, 5.0)?;
    /// let [length, sensitivity] = [0.05, 1.6e-17].map(|value| Estimate { value, standard_error: 0.0 });
    /// let tube = ImageCharge::new(&length, &sensitivity, 3.0, clock)?;
    /// assert_eq!(tube.particle(&ChargePulse { height: 210, width: 0 }).unwrap_err().parameter, Parameter::Ticks);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn particle(&self, pulse: &ChargePulse) -> Result<ChargedParticle<T>, InputError> {
        let speed = self.clock.speed_over(&self.length, pulse.width)?;
        let height = T::constant(pulse.height.into());
        let value = Parameter::Charge.check(height * self.sensitivity.value)?;
        let by_height = self.height_variance.sqrt() * self.sensitivity.value;
        let by_sensitivity = value * relative_error(&self.sensitivity)?;
        // The squares of charges underflow single precision.
        let ratio = by_sensitivity / by_height;
        let charge = Estimate { value, standard_error: by_height * (T::ONE + ratio * ratio).sqrt() };
        Ok(ChargedParticle { charge, speed })
    }
}

/// Charge and speed of a particle.
///
/// ```
/// use microimpact::instrument::sensor::ChargedParticle;
/// use microimpact::measure::Estimate;
///
/// let particle = ChargedParticle {
///     charge: Estimate { value: 1e-15, standard_error: 1e-17 },
///     speed: Estimate { value: 100.0, standard_error: 1.0 },
/// };
/// assert!(particle.speed.value > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChargedParticle<T> {
    /// Charge, C. It attracts the particle to a conducting surface: see
    /// [`image_charge_energy`](crate::rigid::image_charge_energy).
    pub charge: Estimate<T>,
    /// Speed, m/s.
    pub speed: Estimate<T>,
}

impl<T: Real> ChargedParticle<T> {
    /// Radius (m) of a particle of known density (kg/m^3) that an accelerating `voltage` (V) gave its speed: m v^2/2 = |q| U.
    ///
    /// # Errors
    /// A value is outside its range, or a relative error exceeds a fifth.
    ///
    /// ```
    /// use microimpact::instrument::sensor::ChargedParticle;
    /// use microimpact::measure::Estimate;
    ///
    /// let exact = |value: f64| Estimate { value, standard_error: 0.0 };
    /// let charge = Estimate { value: 1e-15, standard_error: 3e-17 };
    /// let particle = ChargedParticle { charge, speed: exact(100.0) };
    /// // 2 |q| U/v^2 = 4e-15 kg.
    /// let radius = particle.radius(&exact(20e3), &exact(2600.0))?;
    /// assert!((radius.value - 0.716e-6).abs() < 1e-9);
    /// // A third of the relative error of the charge.
    /// assert!((radius.standard_error / radius.value - 0.01).abs() < 1e-6);
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn radius(&self, voltage: &Estimate<T>, density: &Estimate<T>) -> Result<Estimate<T>, InputError> {
        let voltage = calibration(Parameter::AcceleratingVoltage, voltage)?;
        let density = calibration(Parameter::Density, density)?;
        let speed = Parameter::ApproachSpeed.check(self.speed.value)?;
        let (third, two_thirds) = (T::constant(1.0 / 3.0), T::constant(2.0 / 3.0));
        let errors = [
            third * relative_error(&self.charge)?,
            third * relative_error(&voltage)?,
            third * relative_error(&density)?,
            two_thirds * relative_error(&self.speed)?,
        ];
        let energy = self.charge.value.abs() * voltage.value;
        let mass = (energy + energy) / speed / speed;
        with_relative_errors(Parameter::Radius.check(radius_of(mass, density.value))?, &errors)
    }
}
