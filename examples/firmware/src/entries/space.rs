//! Impacts in space.

use core::hint::black_box;

use microimpact::contact::{Contact, FixedCost};
use microimpact::rigid::Departure;
use microimpact::space::{Departing, Pair, SpatialMotion, Wall};
use microimpact::{InputError, Oblique, RigidBody, SpeedRestitution, Sphere, Stiffness};

use super::contact::AnyNodes;
use super::{any, keep};

pub(super) fn call_all<T: AnyNodes>() -> Result<(), InputError> {
    let sphere = Sphere::<T>::new(any(), any(), any())?;
    let motion = SpatialMotion::<T>::new([any(), any(), any()], [any(), any(), any()])?;
    keep((motion.velocity(), motion.spin(), motion.energy(&sphere)));
    let wall = Wall::<T>::new([any(), any(), any()]).or(Wall::moving([any(), any(), any()], [any(), any(), any()]))?;
    let before = wall.incidence(&sphere, &motion)?;
    keep((before.sideways(), before.slip()));
    impacts(&sphere, &before, |impact| keep(before.after(&impact)))?;

    let pair = Pair::new(sphere, sphere);
    let before = pair.incidence([any(), any(), any()], [&motion, &motion])?;
    impacts(&pair.reduced(), &before, |impact| keep(before.after(&impact)))
}

/// The departure of an impact.
struct Left<T>(Option<Departure<T>>);

impl<T: Copy> Departing<T> for Left<T> {
    fn departure(&self, _tangential: T) -> Option<Departure<T>> {
        self.0
    }
}

fn impacts<T: AnyNodes>(
    sphere: &Sphere<T>,
    before: &impl Oblique<T>,
    mut after: impl FnMut(Left<T>),
) -> Result<(), InputError> {
    let rigid = RigidBody::new(*sphere, SpeedRestitution::new(any::<T>())?);
    after(Left(rigid.impact(before).departure(any())));
    after(Left(rigid.with_friction(any())?.impact(before).departure(any())));
    let scene = Contact::hertz(*sphere, Stiffness::new(any())?);
    let method = FixedCost::<5>::new(black_box(3))?;
    after(Left(scene.solve(before, &method)?.departure(any())));
    after(Left(scene.with_friction(any())?.solve(before, &method)?.departure(any())));
    Ok(())
}
