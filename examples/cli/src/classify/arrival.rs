//! What arrives at the impact of a row: a sphere in a plane, a sphere at a wall in space, or two spheres.

use microimpact::space::{Departing, Pair, PairIncidence, SpatialMotion, Wall, WallIncidence};
use microimpact::{InputError, NormalMotion, Oblique, PlanarMotion, Sphere, SurfaceMotion};
use sheet::{Header, Input, Row, Scalar, Value};

use crate::inputs::{DENSITY_INPUT, GYRATION_INPUT, MOTION_INPUTS, SIZE_INPUT, radius};

/// The columns of a vector.
type Columns = [&'static str; 3];

const VELOCITY: Columns = ["velocity_x_m_s", "velocity_y_m_s", "velocity_z_m_s"];
const SPIN: Columns = ["spin_x_rad_s", "spin_y_rad_s", "spin_z_rad_s"];
const NORMAL: Columns = ["normal_x", "normal_y", "normal_z"];
const WALL_VELOCITY: Columns = ["wall_velocity_x_m_s", "wall_velocity_y_m_s", "wall_velocity_z_m_s"];
const RADIUS_2: &str = "radius_2_m";
const DENSITY_2: &str = "density_2_kg_m3";
const GYRATION_2: &str = "gyration_ratio_2";
const VELOCITY_2: Columns = ["velocity_2_x_m_s", "velocity_2_y_m_s", "velocity_2_z_m_s"];
const SPIN_2: Columns = ["spin_2_x_rad_s", "spin_2_y_rad_s", "spin_2_z_rad_s"];

/// The columns of a motion in a plane.
const PLANAR: Columns = ["speed_normal_m_s", "speed_tangential_m_s", "spin_rad_s"];

/// The columns of the motion of a sphere after the impact, and of its energies; and of the second.
const AFTER: [&str; 8] = [
    "velocity_out_x_m_s",
    "velocity_out_y_m_s",
    "velocity_out_z_m_s",
    "spin_out_x_rad_s",
    "spin_out_y_rad_s",
    "spin_out_z_rad_s",
    "energy_in_j",
    "energy_out_j",
];
const AFTER_2: [&str; 8] = [
    "velocity_2_out_x_m_s",
    "velocity_2_out_y_m_s",
    "velocity_2_out_z_m_s",
    "spin_2_out_x_rad_s",
    "spin_2_out_y_rad_s",
    "spin_2_out_z_rad_s",
    "energy_2_in_j",
    "energy_2_out_j",
];

/// The columns of the summary for motions in space, with a line for each sphere.
const HEADS: [&str; 4] = ["velocity after\nm/s", "spin after\nrad/s", "energy before\nJ", "energy after\nJ"];

/// The numbers of an arrival.
pub const INPUTS: [Input; 15] = {
    let [_, tangential, spin] = MOTION_INPUTS;
    [
        SIZE_INPUT,
        DENSITY_INPUT,
        GYRATION_INPUT,
        Input::required(&["speed_normal_m_s", VELOCITY[0], VELOCITY[1], VELOCITY[2]]),
        tangential.without(&VELOCITY),
        spin.without(&VELOCITY),
        Input::vector(&VELOCITY, "", "0 m/s"),
        Input::vector(&SPIN, "0 rad/s", "0 rad/s").with(&VELOCITY),
        Input::vector(&NORMAL, "0, 0, 1", "0").with(&VELOCITY),
        Input::vector(&WALL_VELOCITY, "0 m/s", "0 m/s").with(&VELOCITY).without(&[RADIUS_2]),
        Input::further(&[RADIUS_2]),
        Input::optional(&[DENSITY_2], "that of the first sphere").with(&[RADIUS_2]),
        Input::optional(&[GYRATION_2], "0.4, a solid sphere").with(&[RADIUS_2]),
        Input::vector(&VELOCITY_2, "0 m/s", "0 m/s").with(&[RADIUS_2]),
        Input::vector(&SPIN_2, "0 rad/s", "0 rad/s").with(&[RADIUS_2]),
    ]
};

/// The normal where none is given.
const UPRIGHT: [f64; 3] = [0.0, 0.0, 1.0];

/// A sphere and its planar motion before the impact; of two spheres, those of the reduced sphere.
pub struct Arrival<T> {
    pub sphere: Sphere<T>,
    pub motion: PlanarMotion<T>,
    place: Place<T>,
    /// The spheres that move in space, before the impact.
    bodies: Vec<(Sphere<T>, SpatialMotion<T>)>,
    /// Their kinetic energy, seen from the wall if there is one.
    energy: Option<T>,
}

enum Place<T> {
    Plane,
    Wall(WallIncidence<T>),
    Pair(PairIncidence<T>),
}

/// A vector; `None` where all of its cells are empty, and else zero for an empty one.
fn vector<T: Scalar>(row: &Row<'_>, columns: Columns) -> Result<Option<[T; 3]>, String> {
    let [x, y, z] = columns.map(|column| row.number::<T>(column));
    Ok(match (x?, y?, z?) {
        (None, None, None) => None,
        (x, y, z) => Some([x, y, z].map(|component| component.unwrap_or(T::ZERO))),
    })
}

/// A motion in space from the columns of its velocity and spin.
fn motion<T: Scalar>(
    row: &Row<'_>,
    velocity: Columns,
    spin: Columns,
    reason: impl Fn(InputError) -> String,
) -> Result<SpatialMotion<T>, String> {
    let zero = [T::ZERO; 3];
    let (velocity, spin) = (vector(row, velocity)?.unwrap_or(zero), vector(row, spin)?.unwrap_or(zero));
    SpatialMotion::new(velocity, spin).map_err(reason)
}

/// What is wrong with the second sphere, whose columns have names of their own.
fn of_second(error: InputError) -> String {
    format!("second sphere: {error}")
}

/// The same planar motion as a motion of that type.
fn planar<T: Scalar>(row: &Row<'_>, motion: &impl Oblique<T>) -> Result<PlanarMotion<T>, String> {
    let oblique = motion.normal().with_tangential(motion.tangential());
    oblique.and_then(|oblique| oblique.with_peripheral_velocity(motion.peripheral())).map_err(|error| row.reason(error))
}

/// Refuses a row with a number in one of these columns.
fn refuse(row: &Row<'_>, columns: &[&'static str], reason: &str) -> Result<(), String> {
    for column in columns {
        if row.has(column) {
            return Err(format!("{column}: {reason} or leave the cell empty"));
        }
    }
    Ok(())
}

impl<T: Scalar> Arrival<T> {
    /// The spheres of a row and their motions before the impact.
    pub fn read(row: &Row<'_>) -> Result<Self, String> {
        let gyration = |column| Ok::<T, String>(row.number(column)?.unwrap_or(T::constant(0.4)));
        let density: T = row.required("density_kg_m3")?;
        let sphere = Sphere::new(radius(row)?, density, gyration("gyration_ratio")?);
        let sphere = sphere.map_err(|error| row.reason(error))?;
        let in_space = VELOCITY.iter().any(|column| row.has(column));
        if in_space {
            refuse(row, &PLANAR, "the velocity is given in space; remove its cells")?;
        } else {
            for columns in [SPIN, NORMAL, WALL_VELOCITY] {
                refuse(row, &columns, "it goes with velocity_x_m_s, velocity_y_m_s and velocity_z_m_s; give them")?;
            }
        }
        let Some(radius_2) = row.number::<T>(RADIUS_2)? else {
            for columns in [&[DENSITY_2, GYRATION_2][..], &VELOCITY_2, &SPIN_2] {
                refuse(row, columns, "radius_2_m is missing; give it too")?;
            }
            return if in_space { Self::at_wall(row, sphere) } else { Self::in_plane(row, sphere) };
        };
        refuse(row, &WALL_VELOCITY, "two spheres meet without a wall; give velocity_2_x_m_s, _y_ and _z_ instead,")?;
        let second = Sphere::new(radius_2, row.number(DENSITY_2)?.unwrap_or(density), gyration(GYRATION_2)?);
        Self::of_pair(row, [sphere, second.map_err(of_second)?], in_space)
    }

    fn in_plane(row: &Row<'_>, sphere: Sphere<T>) -> Result<Self, String> {
        let (tangential, spin) = (row.or_zero("speed_tangential_m_s")?, row.or_zero("spin_rad_s")?);
        let motion = NormalMotion::new(row.required("speed_normal_m_s")?)
            .and_then(|motion| motion.with_tangential(tangential))
            .and_then(|motion| motion.with_spin(&sphere, spin))
            .map_err(|error| row.reason(error))?;
        Ok(Self { sphere, motion, place: Place::Plane, bodies: Vec::new(), energy: None })
    }

    fn at_wall(row: &Row<'_>, sphere: Sphere<T>) -> Result<Self, String> {
        let wall_velocity = vector(row, WALL_VELOCITY)?.unwrap_or([T::ZERO; 3]);
        let wall = Wall::moving(normal(row)?, wall_velocity).map_err(|error| row.reason(error))?;
        let motion = motion(row, VELOCITY, SPIN, |error| row.reason(error))?;
        let incidence = wall.incidence(&sphere, &motion).map_err(|error| row.reason(error))?;
        let [(x, u), (y, v), (z, w)] = [0, 1, 2].map(|axis| (motion.velocity()[axis], wall_velocity[axis]));
        let seen = SpatialMotion::new([x - u, y - v, z - w], motion.spin()).map_err(|error| row.reason(error))?;
        Ok(Self {
            sphere,
            motion: planar(row, &incidence)?,
            place: Place::Wall(incidence),
            bodies: vec![(sphere, motion)],
            energy: Some(seen.energy(&sphere)),
        })
    }

    /// In a plane the speeds are those of the first sphere, and the second moves only as its own columns say.
    fn of_pair(row: &Row<'_>, spheres: [Sphere<T>; 2], in_space: bool) -> Result<Self, String> {
        let first = if in_space {
            motion(row, VELOCITY, SPIN, |error| row.reason(error))?
        } else {
            let (normal, tangential) = (row.required::<T>("speed_normal_m_s")?, row.or_zero("speed_tangential_m_s")?);
            let (zero, spin) = (T::ZERO, row.or_zero("spin_rad_s")?);
            let motion = SpatialMotion::new([tangential, zero, -normal], [zero, spin, zero]);
            motion.map_err(|error| row.reason(error))?
        };
        let (pair, second) = (Pair::new(spheres[0], spheres[1]), motion(row, VELOCITY_2, SPIN_2, of_second)?);
        let incidence = pair.incidence(normal(row)?, [&first, &second]).map_err(|error| row.reason(error))?;
        Ok(Self {
            sphere: pair.reduced(),
            motion: planar(row, &incidence)?,
            place: Place::Pair(incidence),
            bodies: vec![(spheres[0], first), (spheres[1], second)],
            energy: Some(first.energy(&spheres[0]) + second.energy(&spheres[1])),
        })
    }

    /// Refuses terms of the scene that this arrival does not go with.
    pub fn refuse(
        &self,
        row: &Row<'_>,
        about_one_axis: &[&'static str],
        on_one_body: &[&'static str],
    ) -> Result<(), String> {
        let (columns, reason) = match self.place {
            Place::Plane => return Ok(()),
            Place::Wall(..) => {
                (about_one_axis, "it acts against a spin about one axis, and its effect in space is not known")
            }
            Place::Pair(..) => (&[about_one_axis, on_one_body].concat()[..], "it is not known for two spheres"),
        };
        for column in columns {
            if row.or_zero::<T>(column)? != T::ZERO {
                return Err(format!("{column}: {reason}; leave the cell empty"));
            }
        }
        Ok(())
    }

    /// How the contact point moves after the impact: a sphere that the plane of the impact shows at rest may roll sideways.
    pub fn motion_after(&self, in_plane: SurfaceMotion) -> SurfaceMotion {
        match &self.place {
            Place::Wall(incidence) if in_plane == SurfaceMotion::Resting && incidence.sideways() != T::ZERO => {
                SurfaceMotion::Rolling
            }
            _ => in_plane,
        }
    }

    /// Kinetic energy before the impact of what moves in space, seen from the wall if there is one; `None` in a plane.
    pub fn energy_before(&self) -> Option<T> {
        self.energy
    }

    /// A cell of the summary that describes the motion of one body in the plane; of two spheres it describes neither.
    pub fn of_one_body(&self, cell: String) -> String {
        if matches!(self.place, Place::Pair(_)) { "-".into() } else { cell }
    }

    /// The motions of the spheres in space after an impact; none where they are not known.
    fn after(&self, impact: Option<&impl Departing<T>>) -> Vec<SpatialMotion<T>> {
        let after = impact.and_then(|impact| match &self.place {
            Place::Plane => None,
            Place::Wall(incidence) => incidence.after(impact).map(|motion| vec![motion]),
            Place::Pair(incidence) => incidence.after(impact).map(Vec::from),
        });
        after.unwrap_or_default()
    }

    /// The cells of the motions after an impact, for the columns of a table; empty where they are not known.
    pub fn cells(&self, row: &Row<'_>, impact: Option<&impl Departing<T>>) -> Vec<Value> {
        if !is_in_space(&row.header()) {
            return Vec::new();
        }
        let after = self.after(impact);
        let bodies = 1 + usize::from(is_of_two(&row.header()));
        let cells = |body: usize| match (self.bodies.get(body), after.get(body)) {
            (Some((sphere, before)), Some(after)) => {
                let energies = [before.energy(sphere), after.energy(sphere)];
                let numbers = [&after.velocity()[..], &after.spin(), &energies].concat();
                numbers.into_iter().map(Scalar::value).collect()
            }
            _ => vec![Value::Empty; AFTER.len()],
        };
        (0..bodies).flat_map(cells).collect()
    }

    /// The cells of the summary after those of the plane.
    pub fn summary(&self, header: &Header<'_>, impact: Option<&impl Departing<T>>) -> Vec<String> {
        if !is_in_space(header) {
            return Vec::new();
        }
        let after = self.after(impact);
        let vector = |[x, y, z]: [String; 3]| format!("({x}, {y}, {z})");
        let lines = self.bodies.iter().zip(&after).map(|((sphere, before), after)| {
            let energy = |motion: &SpatialMotion<T>| format!("{:.3e}", motion.energy(sphere));
            [
                vector(after.velocity().map(|component| format!("{:.3}", component + T::ZERO))),
                vector(after.spin().map(|component| format!("{:.2e}", component + T::ZERO))),
                energy(before),
                energy(after),
            ]
        });
        let lines: Vec<_> = lines.collect();
        let cell = |column: usize| match &lines[..] {
            [] => "-".into(),
            lines => lines.iter().map(|line| line[column].as_str()).collect::<Vec<_>>().join("\n"),
        };
        (0..HEADS.len()).map(cell).collect()
    }
}

/// The heads of these cells.
pub fn heads(header: &Header<'_>) -> &'static [&'static str] {
    if is_in_space(header) { &HEADS } else { &[] }
}

/// The normal of a row.
fn normal<T: Scalar>(row: &Row<'_>) -> Result<[T; 3], String> {
    Ok(vector(row, NORMAL)?.unwrap_or(UPRIGHT.map(T::constant)))
}

fn is_of_two(header: &Header<'_>) -> bool {
    header.has(RADIUS_2)
}

fn is_in_space(header: &Header<'_>) -> bool {
    is_of_two(header) || VELOCITY.iter().any(|column| header.has(column))
}

/// The columns of the motions after an impact that a table gets.
pub fn columns(header: &Header<'_>) -> Vec<String> {
    let mut columns = Vec::new();
    if is_in_space(header) {
        columns.extend(AFTER);
    }
    if is_of_two(header) {
        columns.extend(AFTER_2);
    }
    columns.into_iter().map(String::from).collect()
}
