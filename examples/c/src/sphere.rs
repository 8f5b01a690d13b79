//! Spheres that are not solid.

use microimpact::{InputError, Sphere};

use crate::error::Error;
use crate::memory;
use crate::scene::SceneConfig;
use crate::status::{Failure, Status, finish, followed};

/// Writes radius, mean density and gyration ratio of a hollow sphere into a scene, with the radius (m), the thickness of its wall (m) and
/// the density of the wall (kg/m^3). Everything else of the scene stays as it is. The error may be null. Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_sphere_hollow(
    radius: f32,
    thickness: f32,
    density: f32,
    scene: *mut SceneConfig,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { fill(Sphere::hollow(radius, thickness, density), scene, error) }
}

/// The same for a coated sphere, with the radius (m), the thickness of the coating (m) and the densities of core and coating (kg/m^3).
/// Re-entrant.
///
/// # Safety
/// Each pointer is null or points to what its type says, and nobody else uses it during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn microimpact_sphere_coated(
    radius: f32,
    thickness: f32,
    core_density: f32,
    coating_density: f32,
    scene: *mut SceneConfig,
    error: *mut Error,
) -> Status {
    // SAFETY: the contract of this function.
    unsafe { fill(Sphere::coated(radius, thickness, core_density, coating_density), scene, error) }
}

/// # Safety
/// As for [`memory::read`] and [`memory::write`].
unsafe fn fill(sphere: Result<Sphere<f32>, InputError>, scene: *mut SceneConfig, error: *mut Error) -> Status {
    // SAFETY: the contract of this function is that of the functions in `memory`.
    unsafe {
        let filled = || -> Result<(), Failure> {
            let sphere = sphere?;
            let (radius, density, gyration_ratio) = (sphere.radius(), sphere.density(), sphere.gyration_ratio());
            let old = followed(memory::read(scene))?;
            followed(memory::write(scene, SceneConfig { radius, density, gyration_ratio, ..old }))
        };
        finish(filled(), error)
    }
}
