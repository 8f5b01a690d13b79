//! The body of the `flash_*` binaries, whose sizes are compared.

use core::hint::black_box;

use crate::scenes::{Measured, Number, Scene};
use crate::table_1::{APPROACH_M_S, SPIN_RAD_S};

/// The impact of Table 1.
pub const MEASURED: Measured<f32> =
    Measured { approach_m_s: APPROACH_M_S as f32, tangential_m_s: 0.0, spin_rad_s: SPIN_RAD_S as f32 };

/// Validates a scene and then, for ever, a motion, and classifies it.
pub fn classify_for_ever<T: Number, S: Scene<T>>(impact: Measured<T>) -> ! {
    let scene = S::new();
    loop {
        let measured = black_box(impact);
        if let Some(scene) = &scene
            && let Some(motion) = scene.motion(&measured)
        {
            black_box(&scene.classify(&motion));
        }
    }
}

/// The same without a classification.
pub fn do_nothing_for_ever<T: Number>(impact: Measured<T>) -> ! {
    loop {
        black_box(impact);
    }
}
