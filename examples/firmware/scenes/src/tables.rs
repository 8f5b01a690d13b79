//! The scenes in which tables answer, those of the contact simulation on the surface of Brach & Dunn (1995), Table 1: the
//! boundary made on the host, the surface over it on the board.

use core::hint::black_box;

use microimpact::contact::{Collocation, Nodes};
use microimpact::table::{BoundaryTable, Lookup, RestitutionTable, Single, TableOutcome, TableRebound};
use microimpact::{Coulomb, InputError, NormalMotion, PlanarMotion, Separation, SurfaceMotion};

use super::contacts::{exact_restitution, surface_of};
use super::impacts::{CONTACTS, Impact};
use super::scenes::{Answer, Measured, Number, Scene, Visitor, given};
use super::table_1::{FRICTION, RADIUS_M};

/// Three octaves of radii around that of the sphere.
pub type Table = BoundaryTable<12>;

/// As `cargo microimpact table --smallest-radius 2e-6 --cells 12` writes it: made here, it would take the
/// last of the flash for the search of critical speeds.
const TABLE: Table = match BoundaryTable::from_parts(
    1.9073486e-6,
    592,
    [
        [1088728656, -5161287, 647136, -107606],
        [1084119581, -4133047, 413760, -54992],
        [1080350653, -3446374, 287329, -31829],
        [1077162420, -2955240, 211141, -20043],
        [1073145078, -4869162, 575996, -90242],
        [1068771779, -3942560, 376946, -47813],
        [1065162811, -3311965, 265777, -28334],
        [1062090562, -2855114, 197421, -18139],
        [1058197983, -4730919, 544559, -83056],
        [1053937653, -3850166, 360024, -44704],
        [1050406912, -3245697, 255617, -26750],
        [1047392182, -2805169, 190828, -17275],
    ],
) {
    Ok(table) => table,
    Err(_) => panic!("no boundary table"),
};

/// Gyration ratio of a solid sphere.
const SOLID: f64 = 0.4;

/// Rebound or capture, from a table.
pub struct Boundary<T> {
    table: Table,
    radius: T,
}

impl<T: Number + Single> Scene<T> for Boundary<T> {
    const NAME: &'static str = "table/boundary";
    const PLANAR: bool = false;
    type Motion = NormalMotion<T>;
    type Verdict = TableOutcome;

    fn new() -> Option<Self> {
        Some(Self { table: black_box(TABLE), radius: given(RADIUS_M) })
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s).ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> TableOutcome {
        self.table.classify(self.radius, motion)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter().filter(|impact| impact.is_normal())
    }
}

/// Restitution and elastic impulse from a table, and sliding or rolling by them.
pub struct Restitution<T> {
    table: Surface<T>,
    friction: Coulomb<T>,
    radius: T,
}

/// 7 radii and 10 speeds, up to ten times the critical one.
type Surface<T> = RestitutionTable<T, 12, 7, 10>;
const LARGEST_RATIO: f64 = 10.0;

fn surface<T: Number + Nodes<7> + Single>() -> Result<Surface<T>, InputError> {
    let method = Collocation::<7, T>::new(given(1e-6))?;
    RestitutionTable::new(black_box(TABLE), given(LARGEST_RATIO), |radius, speed| {
        // Sliding throughout, friction turns what the elastic impulse is: no other code than that of the scenes.
        let scene = surface_of::<T>(radius)?.with_friction(T::ONE)?;
        let along = T::constant(10.0) * speed;
        let motion = NormalMotion::new(speed)?.with_tangential(along)?.with_peripheral_velocity(T::ZERO)?;
        let impact = scene.solve(&motion, &method)?;
        let impulse = (along - impact.tangential.velocity()) / speed;
        Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
    })
}

impl<T: Number + Nodes<7> + Single> Scene<T> for Restitution<T> {
    const NAME: &'static str = "table/restitution";
    const PLANAR: bool = true;
    type Motion = PlanarMotion<T>;
    type Verdict = (Lookup<T>, Option<Separation<T>>);

    fn new() -> Option<Self> {
        let friction = Coulomb::new(given(FRICTION)).ok()?;
        Some(Self { table: surface::<T>().ok()?, friction, radius: given(RADIUS_M) })
    }

    // What is counted is the library, not a second call around it.
    #[inline(always)]
    fn motion(&self, measured: &Measured<T>) -> Option<Self::Motion> {
        NormalMotion::new(measured.approach_m_s)
            .and_then(|normal| normal.with_tangential(measured.tangential_m_s))
            .and_then(|oblique| oblique.with_peripheral_velocity(self.radius * measured.spin_rad_s))
            .ok()
    }

    #[inline(always)]
    fn classify(&self, motion: &Self::Motion) -> Self::Verdict {
        let reading = self.table.look_up(self.radius, motion);
        let separation = match reading {
            Lookup::Rebound { rebound, .. } => Some(rebound.separation(&self.friction, given(SOLID), motion)),
            _ => None,
        };
        (reading, separation)
    }

    fn restitution(impact: &Impact) -> Option<f64> {
        exact_restitution(surface_of(given(RADIUS_M)), impact)
    }

    fn impacts() -> impl Iterator<Item = &'static Impact> {
        CONTACTS.iter()
    }
}

impl<T> From<TableOutcome> for Answer<T> {
    fn from(verdict: TableOutcome) -> Self {
        let class = match verdict {
            TableOutcome::Rebound => "rebound",
            TableOutcome::Capture => "captured",
            TableOutcome::TooCloseToCall => "too-close-to-call",
            TableOutcome::OutsideTable => "outside-table",
        };
        Self { class, speed_margin: None, friction_margin: None, restitution: None }
    }
}

impl<T> From<(Lookup<T>, Option<Separation<T>>)> for Answer<T> {
    fn from((reading, separation): (Lookup<T>, Option<Separation<T>>)) -> Self {
        let (class, restitution) = match reading {
            Lookup::Rebound { rebound, .. } => {
                let slides = separation.is_some_and(|after| after.motion == SurfaceMotion::Sliding);
                (if slides { "rebound-sliding" } else { "rebound-rolling" }, Some(rebound.restitution))
            }
            Lookup::Capture => ("captured", None),
            Lookup::TooCloseToCall => ("too-close-to-call", None),
            Lookup::OutsideTable => ("outside-table", None),
        };
        Self { class, speed_margin: None, friction_margin: None, restitution }
    }
}

/// Goes through the scenes with tables.
pub(super) fn visit_tables(visitor: &mut impl Visitor) {
    visitor.visit::<f32, Boundary<f32>>();
    visitor.visit::<f32, Restitution<f32>>();
}
