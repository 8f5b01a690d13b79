//! Rows by the contact simulation, several at a time.

use microimpact::contact::{AnyLaw, Contact, FixedCost, Impulses, Method, Times};
use microimpact::{Approach, InputError, NormalMotion, Oblique, PlanarMotion, Real, Sphere};

use crate::groups::{LANES, fill_groups, in_lanes};
use crate::impacts::{Part, Slot};
use crate::motions::{Arrival, Place, in_plane};
use crate::quantity::Asked;
use crate::simulate::by_law;
use crate::simulated::Simulated;
use crate::{Column, Contacts, Damping, F64x4, Impacts, Law, Motions, Quantity, Surface};

impl Contacts<'_> {
    /// Simulates the impacts of `count` rows on all threads, four rows at a time on each, by a method of fixed cost; `otherwise` solves
    /// the rows that this method does not decide. The result of a row is that of a single call of one of the two.
    ///
    /// Rows with an external force, a peeling moment or compliance are computed one by one, and all are where a quantity is asked for
    /// that needs more of the motion in contact than its times and impulses, such as a work.
    /// Built for a processor with AVX2 (`RUSTFLAGS=-Ctarget-cpu=x86-64-v3`), the solver takes about 1.6 times as long for four rows as for
    /// one.
    ///
    /// ```
    /// use impact_arrays::{Column, Contacts, Motions, Quantity};
    /// use microimpact::contact::{Adaptive, FixedCost};
    ///
    /// let radii = [1e-6, 2e-6, 3e-6, 4e-6, 5e-6];
    /// let (radius, density, stiffness) = (Column::Each(&radii), Column::All(2600.0), Column::All(7.5e10));
    /// let contacts = Contacts { radius, density, stiffness, ..Contacts::default() };
    /// let all = Column::All;
    /// let motions = Motions::Planar { speed_normal: all(2.8), speed_tangential: all(0.0), spin: all(0.0) };
    /// let (quick, sure) = (FixedCost::<7>::new(3)?, Adaptive::new(1e-6)?);
    /// let impacts = contacts.simulate_in_lanes(&motions, radii.len(), &quick, &sure, &[Quantity::OverallRestitution]);
    /// let restitution = impacts.numbers(Quantity::OverallRestitution).unwrap();
    /// assert!(restitution.iter().all(|e| (e - 1.0).abs() < 1e-12));
    /// # Ok::<(), microimpact::InputError>(())
    /// ```
    pub fn simulate_in_lanes<const N: usize, const M: usize>(
        &self,
        motions: &Motions<'_>,
        count: usize,
        method: &FixedCost<N, M>,
        otherwise: &(impl Method<f64> + Sync),
        quantities: &[Quantity],
    ) -> Impacts {
        let asked = Asked::by(quantities);
        let otherwise = |row: usize, slot: &mut Slot<'_, '_>| self.row(motions, row, otherwise, asked, slot);
        self.simulate_groups(motions, count, method, quantities, || false, otherwise)
    }

    /// The same until `stop` is true; `otherwise` puts a row that the method does not decide into its slot.
    pub(crate) fn simulate_groups<const N: usize, const M: usize>(
        &self,
        motions: &Motions<'_>,
        count: usize,
        method: &FixedCost<N, M>,
        quantities: &[Quantity],
        stop: impl Fn() -> bool + Sync,
        otherwise: impl Fn(usize, &mut Slot<'_, '_>) -> Result<(), InputError> + Sync,
    ) -> Impacts {
        let asked = Asked::by(quantities);
        let group = |first: usize, part: &mut Part<'_>| {
            let group = if asked == Asked::All { None } else { self.group(motions, first) };
            self.put_group(&group?, method, asked, part).ok()
        };
        fill_groups(count, quantities, stop, group, |row, slot, solved| {
            if solved.is_none() {
                self.row(motions, row, method, asked, slot)?;
            }
            if slot.is_decided() { Ok(()) } else { otherwise(row, slot) }
        })
    }

    /// The rows from `first` on, if they can be computed at once.
    fn group(&self, motions: &Motions<'_>, first: usize) -> Option<Group> {
        let at = |column: &Column<'_>| in_lanes(column, first);
        // With a force the method looks for a barrier, which differs from lane to lane.
        if !matches!(self.surface, Surface::Coulomb { .. }) || at(&self.external_force) != F64x4::ZERO {
            return None;
        }
        if let Motions::Planar { speed_normal, speed_tangential, spin } = motions {
            let sphere = self.sphere_of(at).ok()?;
            let before = in_plane([speed_normal, speed_tangential, spin], &sphere, at).ok()?;
            return Some(Group { first, sphere, before, places: [const { Place::Plane }; LANES] });
        }
        let arrivals = [0, 1, 2, 3].map(|lane| motions.arrival(self.sphere(first + lane).ok()?, first + lane).ok());
        let [Some(a), Some(b), Some(c), Some(d)] = arrivals else {
            return None;
        };
        Group::of(first, [a, b, c, d]).ok()
    }

    /// Puts the results of some rows into their slots.
    fn put_group<const N: usize, const M: usize>(
        &self,
        Group { first, sphere, before, places }: &Group,
        method: &FixedCost<N, M>,
        asked: Asked,
        part: &mut Part<'_>,
    ) -> Result<(), InputError> {
        let at = |column: &Column<'_>| in_lanes(column, *first);
        by_law!(self, at, law => {
            let scene = Contact::new(*sphere, law).with_friction(at(&self.friction()))?;
            if asked == Asked::End {
                let impacts = scene.solve_lanes::<f64, _, N, M, LANES>(before, method)?;
                for (lane, (impact, place)) in impacts.iter().zip(places).enumerate() {
                    part.slot(first + lane).put(&Simulated::new(place, impact, None));
                }
            } else {
                let impacts = scene.solve_lanes_for::<f64, _, _, N, M, LANES>(before, method, (Times, Impulses))?;
                for (lane, ((impact, outputs), place)) in impacts.iter().zip(places).enumerate() {
                    part.slot(first + lane).put(&Simulated::new(place, impact, Some((*outputs).into())));
                }
            }
        });
        Ok(())
    }
}

/// Rows that are computed at once: the first, spheres and planar motions, and where they are in space.
struct Group {
    first: usize,
    sphere: Sphere<F64x4>,
    before: PlanarMotion<F64x4>,
    places: [Place; LANES],
}

impl Group {
    fn of(first: usize, arrivals: [Arrival; LANES]) -> Result<Self, InputError> {
        let of = |number: fn(&Arrival) -> f64| F64x4::from(arrivals.each_ref().map(number));
        let sphere = Sphere::new(
            of(|arrival| arrival.sphere.radius()),
            of(|arrival| arrival.sphere.density()),
            of(|arrival| arrival.sphere.gyration_ratio()),
        )?;
        let before = NormalMotion::new(of(|arrival| arrival.motion.normal().speed()))?
            .with_tangential(of(|arrival| arrival.motion.tangential()))?
            .with_peripheral_velocity(of(|arrival| arrival.motion.peripheral()))?;
        Ok(Self { first, sphere, before, places: arrivals.map(|arrival| arrival.place) })
    }
}
