//! Motions in space after an impact.

use std::cell::OnceCell;

use microimpact::space::{Departing, SpatialMotion};

use crate::Quantity;
use crate::motions::Place;

/// Velocity and spin of one sphere, and of the second of two.
const QUANTITIES: [[Quantity; 6]; 2] = [
    [
        Quantity::VelocityOutX,
        Quantity::VelocityOutY,
        Quantity::VelocityOutZ,
        Quantity::SpinOutX,
        Quantity::SpinOutY,
        Quantity::SpinOutZ,
    ],
    [
        Quantity::Velocity2OutX,
        Quantity::Velocity2OutY,
        Quantity::Velocity2OutZ,
        Quantity::Spin2OutX,
        Quantity::Spin2OutY,
        Quantity::Spin2OutZ,
    ],
];

/// Motions of one sphere or two after an impact, which are computed where they are first asked for.
#[derive(Default)]
pub(crate) struct Departure(OnceCell<[Option<SpatialMotion<f64>>; 2]>);

impl Departure {
    /// A component of velocity or spin; `None` if there is no such sphere, or for a quantity of another kind.
    pub(crate) fn number(&self, quantity: Quantity, place: &Place, impact: &impl Departing<f64>) -> Option<f64> {
        let component = |body: usize| QUANTITIES[body].iter().position(|other| *other == quantity);
        let (body, component) = (0..QUANTITIES.len()).find_map(|body| Some((body, component(body)?)))?;
        let after = self.0.get_or_init(|| place.after(impact))[body]?;
        after.velocity().into_iter().chain(after.spin()).nth(component)
    }
}
