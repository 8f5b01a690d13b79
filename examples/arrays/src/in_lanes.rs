//! Rows by the contact simulation, several at a time.

use std::array;

use microimpact::contact::{AnyLaw, Contact, FixedCost, Impulses, Method, Times};
use microimpact::{Approach, InputError, NormalMotion, Oblique, Real, Sphere};

use crate::impacts::{Record, gather_ranges};
use crate::motions::Arrival;
use crate::quantity::Asked;
use crate::simulate::{by_law, record};
use crate::{Column, Contacts, F64x4, Impacts, Motions, Quantity, Surface};

/// Rows that are computed at once.
const LANES: usize = 4;

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
        let alone = |row: usize| {
            let record = self.row(motions, row, method, asked)?;
            if record.is_decided() { Ok(record) } else { self.row(motions, row, otherwise, asked) }
        };
        gather_ranges(count, quantities, |rows, put| {
            let mut next = rows.start;
            while next < rows.end {
                let fits = asked != Asked::All && next + LANES <= rows.end;
                let together = if fits { self.together(motions, next, method, asked) } else { None };
                let Some(together) = together else {
                    put(alone(next));
                    next += 1;
                    continue;
                };
                for record in together {
                    put(if record.is_decided() { Ok(record) } else { alone(next) });
                    next += 1;
                }
            }
        })
    }

    /// The results of the rows from `first` on; `None` if they are to be computed one by one.
    fn together<const N: usize, const M: usize>(
        &self,
        motions: &Motions<'_>,
        first: usize,
        method: &FixedCost<N, M>,
        asked: Asked,
    ) -> Option<[Record; LANES]> {
        let Surface::Coulomb { friction } = self.surface else {
            return None;
        };
        let arrivals = [0, 1, 2, 3].map(|lane| motions.arrival(self.sphere(first + lane).ok()?, first + lane).ok());
        let [Some(a), Some(b), Some(c), Some(d)] = arrivals else {
            return None;
        };
        self.in_lanes([a, b, c, d], friction, first, method, asked).ok()
    }

    fn in_lanes<const N: usize, const M: usize>(
        &self,
        arrivals: [Arrival; LANES],
        friction: Column<'_>,
        first: usize,
        method: &FixedCost<N, M>,
        asked: Asked,
    ) -> Result<[Record; LANES], InputError> {
        let of = |number: fn(&Arrival) -> f64| F64x4::from(arrivals.each_ref().map(number));
        let at = |column: &Column<'_>| match column {
            Column::All(number) => F64x4::constant(*number),
            Column::Each(_) => F64x4::from(array::from_fn(|lane| column.at(first + lane))),
        };
        let sphere = Sphere::new(
            of(|arrival| arrival.sphere.radius()),
            of(|arrival| arrival.sphere.density()),
            of(|arrival| arrival.sphere.gyration_ratio()),
        )?;
        let before = NormalMotion::new(of(|arrival| arrival.motion.normal().speed()))?
            .with_tangential(of(|arrival| arrival.motion.tangential()))?
            .with_peripheral_velocity(of(|arrival| arrival.motion.peripheral()))?;
        by_law!(self.law(at)?, law => {
            let scene = Contact::new(sphere, law).with_friction(at(&friction))?;
            Ok(if asked == Asked::End {
                let impacts = scene.solve_lanes::<f64, _, N, M, LANES>(&before, method)?;
                array::from_fn(|lane| record(&arrivals[lane], &impacts[lane], None))
            } else {
                let impacts = scene.solve_lanes_for::<f64, _, _, N, M, LANES>(&before, method, (Times, Impulses))?;
                array::from_fn(|lane| {
                    let (impact, outputs) = &impacts[lane];
                    record(&arrivals[lane], impact, Some((*outputs).into()))
                })
            })
        })
    }
}
