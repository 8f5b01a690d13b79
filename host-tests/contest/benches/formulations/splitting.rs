//! Splitting of the regularised equations into drifts of s and kicks of y, by the method of Blanes and Moan (2002) with
//! six stages and order 4, of Runge-Kutta-Nystrom type.
//!
//! In a drift y rests and s grows linearly. In a kick s rests, dy/dz = a - b y, and y += dz phi(-b dz) (a - b y) with
//! phi(x) = (exp(x) - 1)/x. Events are met by Newton's method on the length of the last step.

use std::hint::black_box;

use contest::contestant::{Answer, Contestant};
use contest::problem::Equations;
use contest::problem::Problem;
use microimpact_scenes::methods::regularised::{LONGEST, UNDAMPED_LENGTH};

/// Parts of a step: kicks, and the drifts between them; both read the same from either end.
const KICKS: [f64; 4] =
    [0.082_984_406_417_405_2, 0.396_309_801_498_368, -0.039_056_304_922_348_6, 0.119_524_194_012_150_8];
const DRIFTS: [f64; 3] = [0.245_298_957_184_271, 0.604_872_665_711_080, -0.350_171_622_895_351];

/// Numbers of steps in a contact of the length that an undamped one without adhesion has in z.
pub fn contestants(equations: Problem) -> Vec<Contestant> {
    let contestant = |half_octaves: i32| {
        let steps = (4.0 * 2f64.powf(0.5 * f64::from(half_octaves))).round();
        Contestant::new("splitting in z", "Blanes and Moan", format!("{steps} steps"), move || {
            solve(black_box(&equations), UNDAMPED_LENGTH / steps)
        })
    };
    (0..18).map(contestant).collect()
}

/// s, y and time.
type State = [f64; 3];

fn solve(equations: &Problem, step: f64) -> Option<Answer> {
    let mut kicks = 0;
    let [s, y, time, _] = equations.start();
    let mut state = [s, y, time];
    for (equations, event) in [(**equations, 1), (equations.on_rebound(), 0)] {
        let mut most = (f64::from(LONGEST) * UNDAMPED_LENGTH / step) as u32;
        loop {
            let next = advance(&equations, state, step);
            kicks += 7;
            if next[event] <= 0.0 {
                break;
            }
            (state, most) = (next, most.checked_sub(1)?);
        }
        let slope = |state: State| equations.rates([state[0], state[1], 0.0, 0.0])[event];
        let (mut length, mut end) = (0.0, state);
        for _ in 0..6 {
            let change = -end[event] / slope(end);
            length += change;
            end = advance(&equations, state, length);
            kicks += 7;
            if change.abs() < 1e-8 {
                break;
            }
        }
        state = end;
        state[event] = 0.0;
    }
    let answer = equations.answer([state[0], state[1], state[2], 0.0], None);
    Some(Answer { impulse: None, effort: Some((kicks, "kicks")), ..answer })
}

fn advance(equations: &Equations, [mut s, mut y, mut time]: State, step: f64) -> State {
    let lost = if equations.rebound { equations.adhesion * equations.adhesion_damping } else { 0.0 };
    for stage in 0..7 {
        let from_end = stage.min(6 - stage);
        let square = s * s;
        let elastic = equations.elastic * square;
        let free = 2.0 * square * (equations.adhesion - elastic);
        let damping = 2.0 * square * (equations.material_damping * elastic + lost);
        let kick = KICKS[from_end] * step;
        y += kick * phi(-damping * kick) * (free - damping * y);
        if stage < 6 {
            let drift = DRIFTS[stage.min(5 - stage)] * step;
            time += drift * (2.0 * s + drift * y);
            s += drift * y;
        }
    }
    [s, y, time]
}

/// (exp(x) - 1)/x for small x.
fn phi(x: f64) -> f64 {
    1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0))))
}
