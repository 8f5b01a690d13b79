//! Calibration: parameters from measured impacts.

use microimpact::Sphere;
use microimpact::measure::{self, CalibrationError, RestitutionFit, material_damping};
use microimpact::measure::{Estimate, MeasuredRebound};
use microimpact::{Stiffness, contact};

use crate::error::Error;
use crate::memory;
use crate::probability::Measured;
use crate::simulation::ContactScene;
use crate::status::{Failure, Status, finish, followed};

impl From<CalibrationError> for Failure {
    fn from(error: CalibrationError) -> Self {
        match error {
            CalibrationError::Input(input) => Self::Input(input),
            CalibrationError::TooFew => Self::Status(Status::TooFew),
            CalibrationError::NotConverged => Self::Status(Status::Unsolved),
            CalibrationError::Undetermined | CalibrationError::NoMaterialLoss => Self::Status(Status::Undetermined),
            _ => Self::Status(Status::Contradiction),
        }
    }
}

/// A measured impact of one of many spheres of the same material.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeasuredImpact {
    /// Radius of the sphere, m.
    pub radius: f32,
    /// Its density, kg/m^3.
    pub density: f32,
    /// Approach speed, m/s; the standard error is zero if it is not known.
    pub approach: Measured,
    /// Rebound speed, m/s, which errors may make negative. Not looked at for a capture.
    pub rebound: Measured,
    /// Zero for a rebound, anything else for a capture.
    pub captured: u32,
}

/// Room of the caller for one measured impact, in which microimpact_fit_restitution works.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FitRoom {
    /// What is in it concerns the library alone.
    pub words: [u32; 9],
}

/// cbindgen:ignore
type Row = measure::MeasuredImpact<f32>;

const _: () = assert!(size_of::<Row>() == size_of::<FitRoom>());
const _: () = assert!(align_of::<Row>() <= align_of::<FitRoom>());

/// A value with its interval of 95 %.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    /// The value.
    pub value: f32,
    /// Lower end.
    pub low: f32,
    /// Upper end.
    pub high: f32,
}

impl From<measure::Interval<f32>> for Interval {
    fn from(measure::Interval { value, low, high }: measure::Interval<f32>) -> Self {
        Self { value, low, high }
    }
}

/// Restitution law R = k/(k + v) and work of adhesion, fitted to many impacts.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fit {
    /// Speed k, m/s.
    pub restitution_speed: Interval,
    /// Work of adhesion, J.
    pub work_of_adhesion: Interval,
    /// Critical speed of the sphere of median mass, m/s; zeros where the law does not fit.
    pub critical_speed: Interval,
    /// Median mass, kg.
    pub mass: f32,
    /// Natural scatter of the restitution: its standard deviation without the errors of the speeds.
    pub scatter: f32,
    /// Number of rebounds.
    pub rebounds: u32,
    /// Number of captures.
    pub captures: u32,
    /// Number of rebounds so far from the curve that they have no weight.
    pub outliers: u32,
    /// One if nothing in these impacts contradicts the law; zero if they show a trend over speed that it does not have, or contradict
    /// the critical speed. Few impacts, or a narrow range of speeds, contradict little.
    pub fits: u32,
}

/// Fits the law to `count` measured impacts, of which at least 12 are rebounds, in room of the caller for as many. The intervals hold the
/// truth in 93 to 97 of 100 sets from 30 rebounds on. The time it takes grows with the square of the number. The error may be null.
/// Re-entrant, with other room.
///
/// # Safety
/// Each pointer is null or points to what its type says, the impacts and the room to `count` of them, and nobody else uses it during the
/// call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_fit_restitution(
    impacts: *const MeasuredImpact,
    room: *mut FitRoom,
    count: usize,
    fit: *mut Fit,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the room is one for as many rows, all of which are
    // written before they are read.
    unsafe {
        let fitted = || -> Result<(), Failure> {
            followed(memory::room(fit))?;
            followed(memory::slice(impacts, count))?;
            followed(memory::zeroed(room, count))?;
            let rows = room.cast::<Row>();
            for index in 0..count {
                let impact = followed(memory::read(memory::element(impacts, index)))?;
                followed(memory::write(memory::element_mut(rows, index), impact.row()?))?;
            }
            let found = RestitutionFit::of(followed(memory::slice(rows.cast_const(), count))?)?;
            followed(memory::write(fit, found.into()))
        };
        finish(fitted(), error)
    }
}

impl MeasuredImpact {
    fn row(&self) -> Result<Row, Failure> {
        let sphere = Sphere::solid(self.radius, self.density)?;
        let estimate = |measured: Measured| Estimate { value: measured.value, standard_error: measured.standard_error };
        let rebound = (self.captured == 0).then(|| estimate(self.rebound));
        Ok(Row { sphere, approach: estimate(self.approach), rebound })
    }
}

impl From<RestitutionFit<f32>> for Fit {
    fn from(fit: RestitutionFit<f32>) -> Self {
        Self {
            restitution_speed: fit.restitution_speed.into(),
            work_of_adhesion: fit.work_of_adhesion.into(),
            critical_speed: fit.critical_speed.map_or_else(Interval::default, Into::into),
            mass: fit.mass,
            scatter: fit.scatter,
            rebounds: fit.rebounds,
            captures: fit.captures,
            outliers: fit.outliers,
            fits: fit.fits.into(),
        }
    }
}

/// Writes the strength zeta_H of hysteretic damping with which a scene without adhesion rebounds with a measured restitution at a speed,
/// m/s. Of the scene, radius, density, stiffness and tolerance count. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_fit_material_damping(
    scene: *const ContactScene,
    speed: f32,
    restitution: f32,
    material_damping: *mut f32,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let fitted = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            followed(memory::write(material_damping, scene.damping(speed, restitution)?))
        };
        finish(fitted(), error)
    }
}

impl ContactScene {
    fn damping(&self, speed: f32, restitution: f32) -> Result<f32, Failure> {
        let (_, method) = self.check()?;
        let sphere = Sphere::solid(self.radius, self.density)?;
        let contact = contact::Contact::hertz(sphere, Stiffness::new(self.stiffness)?);
        Ok(material_damping(&contact, &method, &MeasuredRebound { speed, restitution }, self.tolerance)?)
    }
}
