//! An independent solver of the paper's equations B6 to B10, with an external force, a peeling moment and any gyration
//! ratio.
//!
//! It integrates a Taylor series of high order in double-double arithmetic. With delta = L s^2, delta' = U y and
//! d tau = 2 s d sigma, where tau is the time in L/U, the equations are polynomials:
//!
//! ```text
//! ds/dsigma = y,   dy/dsigma = 2 [s (B s - A s^3 - X) - y D],   D = h A s^4 + g B s^2 (g on rebound only)
//! ```
//!
//! Each step ends at the first event inside it: the end of slip, the peak, separation, or the turning point of a
//! captured sphere. A sphere that creeps to rest without turning is proven to do so.

mod compliance;
mod double;
mod path;
mod scene;
mod series;

pub use compliance::{CompliantImpact, CompliantRebound};
pub use double::Double;
pub use path::{Outcome, Truth, solve, solve_changed, solve_exactly};
pub use scene::{INPUTS, Scene};
