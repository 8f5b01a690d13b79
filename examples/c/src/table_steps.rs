//! Tables made in steps, between which a program does other work.

use microimpact::Parameter;
use microimpact::table::{BoundarySlice, BoundarySliceMaker, BoundaryTableMaker, RestitutionTableMaker};

use crate::error::Error;
use crate::memory;
use crate::simulation::ContactScene;
use crate::status::{Failure, Status, finish, followed};
use crate::tables::{BoundaryTable, Made, RestitutionTable};

/// Room for a boundary table that is being made, which microimpact_boundary_begin prepares.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BoundaryMaker {
    /// What is in it concerns the library alone.
    pub words: [usize; 32],
}

/// Room for a restitution table that is being made, which microimpact_restitution_begin prepares.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RestitutionMaker {
    /// What is in it concerns the library alone.
    pub words: [usize; 216],
}

/// Tell what is being made from memory in which nothing was begun.
const BOUNDARY: u32 = 0x6d69_6273;
const CELLS: u32 = 0x6d69_6363;
const SURFACE: u32 = 0x6d69_7266;

/// A boundary table in cells of the caller.
#[repr(C)]
#[derive(Clone, Copy)]
struct MakingBoundary {
    mark: u32,
    scene: ContactScene,
    maker: BoundarySliceMaker,
    cells: *mut [i32; 4],
    count: usize,
}

/// What all of a restitution table needs.
#[derive(Clone, Copy)]
struct Wanted {
    scene: ContactScene,
    smallest_radius: f32,
    speed_ratio: f32,
}

/// The boundary of a restitution table.
#[repr(C)]
#[derive(Clone, Copy)]
struct MakingCells {
    mark: u32,
    wanted: Wanted,
    maker: BoundaryTableMaker<8>,
}

/// The rest of it.
#[repr(C)]
#[derive(Clone, Copy)]
struct MakingSurface {
    mark: u32,
    wanted: Wanted,
    maker: SurfaceMaker,
}

type SurfaceMaker = RestitutionTableMaker<f32, 8, 6, 10>;

/// Calls that a restitution table takes.
const RESTITUTION_CALLS: usize = BoundaryTableMaker::<8>::CALLS + SurfaceMaker::CALLS;

const _: () = assert!(memory::fits_in::<MakingBoundary, BoundaryMaker>());
const _: () =
    assert!(memory::fits_in::<MakingCells, RestitutionMaker>() && memory::fits_in::<MakingSurface, RestitutionMaker>());

/// Begins a boundary table as microimpact_boundary_make makes it, in cells of the caller, which the maker keeps pointing to: until the
/// table is complete, they belong to it. The scene is copied. Nothing is computed as yet. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, the cells to room for `count` of them, and nobody else uses them
/// during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_boundary_begin(
    scene: *const ContactScene,
    smallest_radius: f32,
    cells: *mut [i32; 4],
    count: usize,
    maker: *mut BoundaryMaker,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the maker is room for a `MakingBoundary`.
    unsafe {
        let begun = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            ContactScene { radius: smallest_radius, ..scene }.check()?;
            let made = BoundarySliceMaker::new(smallest_radius)?;
            followed(memory::room(maker))?;
            followed(memory::zeroed(cells, count))?;
            let making = MakingBoundary { mark: BOUNDARY, scene, maker: made, cells, count };
            followed(memory::write(maker.cast(), making))
        };
        finish(begun(), error)
    }
}

/// Goes on with a boundary table by at most `budget` critical speeds, of which a table takes seven for each cell, and writes how many
/// remain. Where none remains, the table is written: the one of microimpact_boundary_make to the last bit. A critical speed is the
/// least that a step computes; the figures are those of one. Where a step fails, the next one tries the same critical speed again. The
/// error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells given to
/// microimpact_boundary_begin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_boundary_step(
    maker: *mut BoundaryMaker,
    budget: usize,
    table: *mut BoundaryTable,
    remaining: *mut usize,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; a `MakingBoundary` is plain numbers.
    unsafe {
        let stepped = || -> Result<(), Failure> {
            followed(memory::room(table))?;
            followed(memory::room(remaining))?;
            if followed(memory::read(maker.cast_const().cast::<u32>()))? != BOUNDARY {
                return Err(Failure::Status(Status::Unmade));
            }
            let making: &mut MakingBoundary = followed(memory::follow_mut(maker.cast()))?;
            let (cells, count, scene) = (making.cells, making.count, making.scene);
            let room = followed(memory::slice_mut(cells, count))?;
            let made = making.maker.step(room, budget, |radius| scene.critical_speed(radius))?;
            if let Some((smallest_radius, margin, _)) = made.map(|made: BoundarySlice| made.parts()) {
                followed(memory::write(table, BoundaryTable { smallest_radius, margin, cells, count }))?;
            }
            let all = count.saturating_mul(BoundarySliceMaker::CALLS_PER_CELL);
            followed(memory::write(remaining, all.saturating_sub(making.maker.calls())))
        };
        finish(stepped(), error)
    }
}

/// Begins a restitution table as microimpact_restitution_make makes it. The scene is copied. Nothing is computed as yet. The error may be
/// null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_restitution_begin(
    scene: *const ContactScene,
    smallest_radius: f32,
    speed_ratio: f32,
    maker: *mut RestitutionMaker,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the maker is room for a `MakingCells`.
    unsafe {
        let begun = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            ContactScene { radius: smallest_radius, ..scene }.check()?;
            let wanted = Wanted { scene, smallest_radius, speed_ratio: Parameter::SpeedRatio.check(speed_ratio)? };
            let making = MakingCells { mark: CELLS, wanted, maker: BoundaryTableMaker::new(smallest_radius)? };
            followed(memory::write(maker.cast(), making))
        };
        finish(begun(), error)
    }
}

/// Goes on with a restitution table by at most `budget` critical speeds or simulations, of which the table takes 56 and then 336, and
/// writes how many remain. Where none remains, the table is written: the one of microimpact_restitution_make to the last bit. One critical speed or
/// one simulation is the least that a step computes; the figures are those of a critical speed. Where a step fails, the next one tries
/// the same again. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_restitution_step(
    maker: *mut RestitutionMaker,
    budget: usize,
    table: *mut RestitutionTable,
    remaining: *mut usize,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; what is being made is plain numbers.
    unsafe {
        let stepped = || -> Result<(), Failure> {
            followed(memory::room(table))?;
            followed(memory::room(remaining))?;
            let mut left = budget;
            if followed(memory::read(maker.cast_const().cast::<u32>()))? == CELLS {
                let making: &mut MakingCells = followed(memory::follow_mut(maker.cast()))?;
                let done = making.maker.calls();
                let scene = making.wanted.scene;
                let made = making.maker.step(left, |radius| scene.critical_speed(radius))?.copied();
                left = left.saturating_sub(making.maker.calls().saturating_sub(done));
                let Some(boundary) = made else {
                    let calls = making.maker.calls();
                    return followed(memory::write(remaining, RESTITUTION_CALLS.saturating_sub(calls)));
                };
                let wanted = making.wanted;
                let surface = RestitutionTableMaker::new(boundary, wanted.speed_ratio)?;
                followed(memory::write(maker.cast(), MakingSurface { mark: SURFACE, wanted, maker: surface }))?;
            }
            if followed(memory::read(maker.cast_const().cast::<u32>()))? != SURFACE {
                return Err(Failure::Status(Status::Unmade));
            }
            let making: &mut MakingSurface = followed(memory::follow_mut(maker.cast()))?;
            let Wanted { scene, smallest_radius, .. } = making.wanted;
            let made = making.maker.step(left, |radius, speed| scene.rebound(radius, speed))?;
            if let Some(made) = made {
                followed(memory::write(table.cast(), Made::of(scene.of_spheres(smallest_radius)?, *made)))?;
            }
            followed(memory::write(remaining, SurfaceMaker::CALLS.saturating_sub(making.maker.calls())))
        };
        finish(stepped(), error)
    }
}
