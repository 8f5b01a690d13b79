//! Tables: capture or rebound, restitution, and sliding or rolling, without a simulation.

use microimpact::table::{self, BoundarySlice, Lookup, TableOutcome, TableRebound};
use microimpact::{Coulomb, InputError, Parameter, PlanarMotion, Sphere};

use crate::error::Error;
use crate::memory;
use crate::simulation::{ALL_INTERVALS, ContactScene, simulated};
use crate::status::{Failure, Motion, Status, finish, followed};

/// What a table says of an impact.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The sphere leaves the surface.
    Rebound,
    /// The surface holds the sphere.
    Capture,
    /// The speed is closer to the critical one than the error of the table.
    TooCloseToCall,
    /// The table does not reach there.
    OutsideTable,
}

impl From<TableOutcome> for Verdict {
    fn from(verdict: TableOutcome) -> Self {
        match verdict {
            TableOutcome::Rebound => Self::Rebound,
            TableOutcome::Capture => Self::Capture,
            TableOutcome::TooCloseToCall => Self::TooCloseToCall,
            TableOutcome::OutsideTable => Self::OutsideTable,
        }
    }
}

/// The critical speeds of spheres of one material on one surface, over a range of radii. Made by microimpact_boundary_make,
/// or a constant that `cargo microimpact table` has written.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BoundaryTable {
    /// Radius at which the table begins, m.
    pub smallest_radius: f32,
    /// Greatest error of the logarithm of a critical speed, in 2^-23 octaves.
    pub margin: u32,
    /// Cells, in flash or in memory of the caller: a quarter of an octave of radii each.
    pub cells: *const [i32; 4],
    /// Their number.
    pub count: usize,
}

/// Makes a boundary table of the material and the surface of a scene, whose radius and friction do not count, from a radius on
/// (m), in cells of the caller, which the table keeps pointing to. Where it fails, the cells hold no table. It takes seven critical
/// speeds for each cell; microimpact_boundary_step makes as many of them as you allow. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the cells to room for `count` of them, and nobody else uses them
/// during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_boundary_make(
    scene: *const ContactScene,
    smallest_radius: f32,
    cells: *mut [i32; 4],
    count: usize,
    table: *mut BoundaryTable,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let made = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            let room = followed(memory::zeroed(cells, count))?;
            let made = BoundarySlice::fill(smallest_radius, room, |radius| scene.critical_speed(radius))?;
            let (smallest_radius, margin, _) = made.parts();
            followed(memory::write(table, BoundaryTable { smallest_radius, margin, cells, count }))
        };
        finish(made(), error)
    }
}

/// Checks all of a boundary table: a constant once, at start-up. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_boundary_check(table: *const BoundaryTable, error: *mut Error) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let checked = || -> Result<(), Failure> {
            let BoundaryTable { smallest_radius, margin, cells, count } = followed(memory::read(table))?;
            BoundarySlice::from_parts(smallest_radius, margin, followed(memory::slice(cells, count))?)?;
            Ok(())
        };
        finish(checked(), error)
    }
}

/// Tells rebound from capture of a sphere of a radius (m). Of the table, the cell around that radius is checked. The error may
/// be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_boundary_classify(
    table: *const BoundaryTable,
    radius: f32,
    motion: *const Motion,
    verdict: *mut Verdict,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let classified = || -> Result<(), Failure> {
            let BoundaryTable { smallest_radius, margin, cells, count } = followed(memory::read(table))?;
            let motion = followed(memory::read(motion))?.check()?;
            Parameter::Radius.check(radius)?;
            let cells = followed(memory::slice(cells, count))?;
            let cell = BoundarySlice::cell(smallest_radius, margin, cells, radius)?;
            let found = cell.map_or(TableOutcome::OutsideTable, |cell| cell.classify(radius, &motion));
            followed(memory::write(verdict, found.into()))
        };
        finish(classified(), error)
    }
}

/// Room for a table of restitution over two octaves of radii and a range of speeds, which microimpact_restitution_make makes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RestitutionTable {
    /// What is in it concerns the library alone.
    pub words: [u32; 165],
}

/// What is in the room.
#[derive(Clone, Copy)]
pub(crate) struct Made {
    mark: u32,
    /// Eight cells of radii, and nodes at six radii and ten speeds.
    table: table::RestitutionTable<f32, 8, 6, 10>,
    friction: Coulomb<f32>,
    gyration_ratio: f32,
}

/// Tells a table from memory in which none was made.
const MARK: u32 = 0x6d69_7274;

const _: () = assert!(size_of::<Made>() == size_of::<RestitutionTable>());
const _: () = assert!(align_of::<Made>() == align_of::<RestitutionTable>());

/// Makes a restitution table of the material, the surface and the friction of a scene, whose radius does not count: over two
/// octaves of radii from one on (m), and up to `speed_ratio` times the critical speed. If it fails, the room keeps what it held. It
/// takes hundreds of simulations; microimpact_restitution_step makes as many of them as you allow. The error may be null.
/// Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_restitution_make(
    scene: *const ContactScene,
    smallest_radius: f32,
    speed_ratio: f32,
    table: *mut RestitutionTable,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the table is room for a `Made`.
    unsafe {
        let made = || -> Result<(), Failure> {
            let made = Made::new(followed(memory::read(scene))?, smallest_radius, speed_ratio)?;
            followed(memory::write(table.cast(), made))
        };
        finish(made(), error)
    }
}

impl Made {
    fn new(scene: ContactScene, smallest_radius: f32, speed_ratio: f32) -> Result<Self, InputError> {
        let material = scene.of_spheres(smallest_radius)?;
        let boundary = table::BoundaryTable::new(smallest_radius, |radius| scene.critical_speed(radius))?;
        let rebound = |radius, speed| scene.rebound(radius, speed);
        Ok(Self::of(material, table::RestitutionTable::new(boundary, speed_ratio, rebound)?))
    }

    /// With friction and gyration ratio of the material.
    pub(crate) fn of(
        (friction, gyration_ratio): (Coulomb<f32>, f32),
        table: table::RestitutionTable<f32, 8, 6, 10>,
    ) -> Self {
        Self { mark: MARK, table, friction, gyration_ratio }
    }
}

impl ContactScene {
    /// Friction and gyration ratio of all spheres of the material.
    pub(crate) fn of_spheres(&self, radius: f32) -> Result<(Coulomb<f32>, f32), InputError> {
        Ok((Coulomb::new(self.friction)?, Sphere::solid(radius, self.density)?.gyration_ratio()))
    }

    /// What a restitution table holds of a sphere of the same material.
    pub(crate) fn rebound(&self, radius: f32, speed: f32) -> Result<TableRebound<f32>, InputError> {
        // Friction of one takes the impulse of the elastic force from a velocity with which the sphere slides throughout: no
        // other solver than that of the simulation.
        let (scene, method) = Self { radius, friction: 1.0, ..*self }.check()?;
        let along = 10.0 * speed;
        let motion = Motion { approach: speed, tangential: along, peripheral: 0.0 }.check()?;
        let impact = simulated(&scene, &motion, method, ALL_INTERVALS)?;
        let impulse = (along - impact.tangential.velocity()) / speed;
        Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
    }
}

/// The motion along the surface after a rebound.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceMotion {
    /// There is no rebound.
    None,
    /// The contact point slips.
    Sliding,
    /// The sphere rolls.
    Rolling,
}

/// What a restitution table says of an impact.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableReading {
    /// Rebound or capture.
    pub verdict: Verdict,
    /// Sliding or rolling.
    pub surface_motion: SurfaceMotion,
    /// Overall restitution; zero for a capture, negative where the table has no answer.
    pub restitution: f32,
    /// Greatest error of the restitution; zero for a capture, negative where the table has no answer.
    pub restitution_error: f32,
    /// Tangential velocity after a rebound, m/s; else zero.
    pub tangential: f32,
    /// Peripheral velocity after a rebound, m/s; else zero.
    pub peripheral: f32,
}

/// Reads from a table what becomes of a sphere of a radius (m). The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_restitution_read(
    table: *const RestitutionTable,
    radius: f32,
    motion: *const Motion,
    reading: *mut TableReading,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; `Made` is plain numbers.
    unsafe {
        let found = || -> Result<(), Failure> {
            let made: &Made = followed(memory::follow(table.cast()))?;
            if made.mark != MARK {
                return Err(Failure::Status(Status::Unmade));
            }
            let motion = followed(memory::read(motion))?.check()?;
            Parameter::Radius.check(radius)?;
            followed(memory::write(reading, made.read(radius, &motion)))
        };
        finish(found(), error)
    }
}

impl Made {
    fn read(&self, radius: f32, motion: &PlanarMotion<f32>) -> TableReading {
        let without = |verdict, restitution| TableReading {
            verdict,
            surface_motion: SurfaceMotion::None,
            restitution,
            restitution_error: restitution,
            tangential: 0.0,
            peripheral: 0.0,
        };
        match self.table.look_up(radius, motion) {
            Lookup::Rebound { rebound, error } => {
                let after = rebound.separation(&self.friction, self.gyration_ratio, motion);
                let slides = after.motion == microimpact::SurfaceMotion::Sliding;
                TableReading {
                    verdict: Verdict::Rebound,
                    surface_motion: if slides { SurfaceMotion::Sliding } else { SurfaceMotion::Rolling },
                    restitution: rebound.restitution,
                    restitution_error: error,
                    tangential: after.velocity,
                    peripheral: after.peripheral,
                }
            }
            Lookup::Capture => without(Verdict::Capture, 0.0),
            Lookup::TooCloseToCall => without(Verdict::TooCloseToCall, -1.0),
            Lookup::OutsideTable => without(Verdict::OutsideTable, -1.0),
        }
    }
}
