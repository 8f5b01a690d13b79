//! Critical speeds found in steps, between which a program does other work.

use microimpact::AnyModel;
use microimpact::contact::CriticalSpeedSearch;

use crate::error::Error;
use crate::memory;
use crate::scene::{SceneConfig, SceneMethod, number_of};
use crate::status::{Failure, Status, finish, followed};

/// Room for a search for a critical speed, which microimpact_critical_speed_begin prepares.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CriticalSearch {
    /// What is in it concerns the library alone.
    pub words: [usize; 64],
}

/// Tells a search from memory in which nothing was begun.
const SEARCH: u32 = 0x6d69_6373;

/// A search under way.
#[repr(C)]
#[derive(Clone, Copy)]
struct Searching {
    mark: u32,
    scene: SceneConfig,
    search: CriticalSpeedSearch<f32>,
}

const _: () = assert!(memory::fits_in::<Searching, CriticalSearch>());

/// Begins the search for the speed that microimpact_scene_critical_speed writes. The scene is copied; a contact needs a tolerance, not
/// iterations. Nothing is computed as yet. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_critical_speed_begin(
    scene: *const SceneConfig,
    search: *mut CriticalSearch,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; the search is room for a `Searching`.
    unsafe {
        let begun = || -> Result<(), Failure> {
            let scene = followed(memory::read(scene))?;
            if let (_, SceneMethod::FixedCost(_)) = scene.check()? {
                return Err(Failure::Status(Status::Choice));
            }
            followed(memory::room(search))?;
            let searching = Searching { mark: SEARCH, scene, search: CriticalSpeedSearch::new() };
            followed(memory::write(search.cast(), searching))
        };
        finish(begun(), error)
    }
}

/// Goes on with a search by at most `budget` trials of a speed, of which it takes less than ten as a rule and never more than 88, and
/// writes 1 to `found` once the speed is found, else 0. The speed is written where it is found: the one of
/// microimpact_scene_critical_speed to the last bit. That of a rigid body needs no trial. The figures are those of one trial. Where a
/// step fails, so does every further one. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call; only
/// microimpact_critical_speed_begin and this function have written to the search.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_critical_speed_step(
    search: *mut CriticalSearch,
    budget: u32,
    speed: *mut f32,
    found: *mut u32,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`; behind its mark is the `Searching` that was begun.
    unsafe {
        let stepped = || -> Result<(), Failure> {
            followed(memory::room(speed))?;
            followed(memory::write(found, 0))?;
            if followed(memory::read(search.cast_const().cast::<u32>()))? != SEARCH {
                return Err(Failure::Status(Status::Unmade));
            }
            let Searching { scene, search, .. } = followed(memory::follow_mut(search.cast()))?;
            let critical = match scene.check()? {
                (AnyModel::RigidBody(body), _) => Some(body.critical_speed()),
                (AnyModel::Contact(contact), SceneMethod::Tolerance(method)) => {
                    search.step(budget, &contact, &method)?
                }
                _ => return Err(Failure::Status(Status::Choice)),
            };
            if let Some(critical) = critical {
                followed(memory::write(speed, number_of(critical)))?;
                followed(memory::write(found, 1))?;
            }
            Ok(())
        };
        finish(stepped(), error)
    }
}
