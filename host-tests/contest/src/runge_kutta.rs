//! The classical Runge-Kutta method of order 4 with a fixed step on the regularised equations.
//!
//! An event is met by a last step against its own variable (Henon 1982), from the last point before it.

use std::hint::black_box;

use crate::contestant::Contestant;
use crate::problem::Problem;
use microimpact_scenes::methods::regularised::{LONGEST, NAME, UNDAMPED_LENGTH};

/// Numbers of steps in a contact of the length that an undamped one without adhesion has in z.
pub fn contestants(equations: Problem) -> Vec<Contestant> {
    let contestant = |octaves: u32| {
        let steps = 8 << octaves;
        Contestant::new(NAME, "Henon's events", format!("{steps} steps"), move || {
            let (end, _, evaluations) =
                black_box(&equations).solve(UNDAMPED_LENGTH / f64::from(steps), steps * LONGEST)?;
            Some(equations.answer(end, Some(evaluations as usize)))
        })
    };
    (0..11).map(contestant).collect()
}
