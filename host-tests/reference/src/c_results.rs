//! What `examples/c/results.c` must print, computed in Rust.

use std::fmt::Write;

use microimpact::contact::{
    Collocation, CompliantVelocities, Contact, ContactLaw, FixedCost, JkrEnd, JkrLaw, PaperScene, Recording, RingScene,
    Sample, SimulatedImpact, Slip, Trajectory, Unloading,
};
use microimpact::rigid::PowerRestitution;
use microimpact::space::{Pair, SpatialMotion, Wall};
use microimpact::table::{BoundarySlice, BoundaryTable, Lookup, RestitutionTable, TableRebound};
use microimpact::{
    Approach, Coulomb, InFixedPoint, InputError, NormalMotion, Oblique, PlanarMotion, Real, RigidBody,
    SpeedRestitution, Sphere, Stiffness, SurfaceMotion,
};

use microimpact_scenes::table_1::{
    DENSITY_KG_M3, FRICTION, MATERIAL_DAMPING, RADIUS_M, RESTITUTION_SPEED_M_S, RING_DAMPING, RING_N_M, STIFFNESS_PA,
    WORK_OF_ADHESION_J,
};

/// Approach speed, tangential and peripheral velocity of each impact, m/s.
pub const MOTIONS: [[f32; 3]; 8] = [
    [2.8, 0.0, 0.0],
    [2.8, 0.0, 0.7388],
    [2.8, 20.0, 0.0],
    [2.8, 1.0, -2.5],
    [1.85, 0.0, 0.0],
    [0.5, 0.0, 0.0],
    [1.75, 0.2, 0.0],
    [1.0, 5.0, 0.0],
];

/// Radius of each sphere that is looked up in the tables, m.
pub const RADII: [f32; 4] = [1e-6, 2.5e-6, 5.06e-6, 1e-5];

/// Motions that are looked up, as [`MOTIONS`].
pub const LOOKED_UP: [[f32; 3]; 6] =
    [[5.15957, 0.0, 0.0], [2.8, 0.0, 0.7388], [2.8, 20.0, 0.0], [1.4, 0.0, 0.0], [9.0, 1.0, -2.5], [300.0, 0.0, 0.0]];

/// Normal and velocity (m/s) of each wall.
pub const WALLS: [[[f32; 3]; 2]; 2] = [[[0.0, 0.0, 1.0], [0.0; 3]], [[0.48, -0.6, 0.64], [0.3, 0.2, 0.1]]];

/// Velocity (m/s) and spin (rad/s) of each sphere that hits the walls.
pub const IN_SPACE: [[[f32; 3]; 2]; 3] =
    [[[0.3, 0.4, -2.8], [1e5, -2e5, 7e4]], [[12.0, 16.0, -3.0], [0.0; 3]], [[-0.1, 0.3, -0.5], [0.0, 3e4, 0.0]]];

/// Two spheres that collide: radii (m), densities (kg/m^3), normal, and motions as [`IN_SPACE`].
pub struct Collision([f32; 2], [f32; 2], [f32; 3], [[[f32; 3]; 2]; 2]);

/// Pairs of spheres that collide.
pub const PAIRS: [Collision; 3] = [
    Collision(
        [5.06e-6, 5.06e-6],
        [2600.0, 2600.0],
        [1.0, 0.0, 0.0],
        [[[-2.8, 0.2, 0.1], [0.0, 0.0, 1e5]], [[2.8, 0.0, 0.0], [0.0; 3]]],
    ),
    Collision(
        [4e-6, 1.2e-5],
        [2600.0, 1300.0],
        [0.0, 0.6, 0.8],
        [[[0.2, -1.0, -4.0], [0.0, 3e4, -1e4]], [[9.0, 0.5, 0.4], [2e4, 0.0, 0.0]]],
    ),
    Collision([6e-6, 5e-6], [1000.0, 2000.0], [0.0, 0.0, 1.0], [[[0.1, 0.0, -0.3], [0.0; 3]], [[0.0; 3], [0.0; 3]]]),
];

/// Where the tables begin, m.
const SMALLEST_RADIUS: f32 = 2e-6;
const LARGEST_SPEED_RATIO: f32 = 10.0;

/// Arguments with which `microimpact table` writes the constant of the C example.
pub const CONSTANT: [&str; 6] = ["--smallest-radius", "2e-6", "--cells", "8", "--format", "c"];

/// All lines, with every bit of each number.
///
/// # Errors
/// None for the values here.
pub fn expected() -> Result<String, InputError> {
    Ok(impacts()?
        + &laws()?
        + &trajectories()?
        + &boundaries()?
        + &restitutions()?
        + &walls()?
        + &pairs()?
        + &compliant()?
        + &of_one_scene()?
        + &integers()?)
}

/// The lines of both models.
fn impacts() -> Result<String, InputError> {
    let c = f32::constant;
    let sphere = Sphere::solid(c(RADIUS_M), c(DENSITY_KG_M3))?;
    let body = RigidBody::new(sphere, SpeedRestitution::new(c(RESTITUTION_SPEED_M_S))?)
        .with_work_of_adhesion(c(WORK_OF_ADHESION_J))?
        .with_friction(c(FRICTION))?;
    let contact = surface(c(RADIUS_M))?.with_friction(c(FRICTION))?;
    let mut rigid = String::new();
    for (index, before) in MOTIONS.into_iter().enumerate() {
        let motion = motion(before)?;
        let (impact, classification) = (body.impact(&motion), body.classify(&motion));
        line(
            &mut rigid,
            &format!("rigid {index} {}", classification.class() as u8),
            &[
                classification.speed_over_critical.unwrap_or(-1.0),
                classification.contact.friction_over_limit.unwrap_or(-1.0),
                impact.normal.overall_restitution(),
                impact.tangential.velocity(),
                impact.tangential.peripheral(),
            ],
        );
    }
    Ok(rigid + &simulations("contact", &contact)?)
}

/// The lines of scenes that C has as one structure, each by its type: a rigid body with two laws that others do not have, of a hollow
/// sphere, and the method of fixed cost, which may leave an impact unsolved.
fn of_one_scene() -> Result<String, InputError> {
    let c = f32::constant;
    let body = RigidBody::new(Sphere::hollow(c(RADIUS_M), 1e-6, c(DENSITY_KG_M3))?, PowerRestitution::new(90.0, 0.75)?)
        .with_adhesion_at_speed(1.5, 2.0)?
        .with_friction(c(FRICTION))?;
    let contact = surface(c(RADIUS_M))?.with_friction(c(FRICTION))?;
    let method = FixedCost::<7>::new(3)?;
    let mut text = String::new();
    for (index, before) in MOTIONS.into_iter().enumerate() {
        let (impact, class) = (body.impact(&motion(before)?), body.classify(&motion(before)?).class());
        let along = (impact.tangential.velocity(), impact.tangential.peripheral());
        let numbers = [impact.normal.overall_restitution(), along.0, along.1];
        line(&mut text, &format!("power {index} {}", class as u8), &numbers);
        let impact = contact.solve(&motion(before)?, &method)?;
        let along = (impact.tangential.velocity(), impact.tangential.spin() * c(RADIUS_M));
        let numbers = [impact.normal.overall_restitution(), along.0, along.1];
        match impact.class() {
            Some(class) => line(&mut text, &format!("fixed-cost {index} {}", class as u8), &numbers),
            None => text.push_str(&format!("fixed-cost {index} unsolved\n")),
        }
    }
    Ok(text)
}

/// The lines of the rigid body in integers, with a unit of 4 m/s. Motions are those that fit.
fn integers() -> Result<String, InputError> {
    let c = f32::constant;
    let body =
        RigidBody::new(Sphere::solid(c(RADIUS_M), c(DENSITY_KG_M3))?, SpeedRestitution::new(c(RESTITUTION_SPEED_M_S))?)
            .with_work_of_adhesion(c(WORK_OF_ADHESION_J))?
            .with_friction(c(FRICTION))?
            .in_fixed_point(4.0)?;
    let mut text = String::new();
    for (index, before) in MOTIONS.into_iter().enumerate() {
        // An eighth is exact in both.
        let before = before.map(|velocity| (velocity * 8.0).round() / 8.0);
        let motion = motion(before)?.in_fixed_point(4.0)?;
        let (impact, classification) = (body.impact(&motion), body.classify(&motion));
        let _ = write!(text, "integers {index} {}", classification.class() as u8);
        let along = [impact.tangential.velocity(), impact.tangential.peripheral()];
        for number in [impact.normal.overall_restitution()].into_iter().chain(along) {
            let _ = write!(text, " {}", number.to_bits());
        }
        text.push('\n');
    }
    Ok(text)
}

/// The lines of other laws of contact, each by its type.
fn laws() -> Result<String, InputError> {
    let c = f32::constant;
    let (sphere, stiffness) = (Sphere::solid(c(RADIUS_M), c(DENSITY_KG_M3))?, Stiffness::new(c(STIFFNESS_PA))?);
    let (hertz, jkr) = (Contact::hertz(sphere, stiffness), JkrLaw::new(stiffness, 2.0)?);
    let (friction, time) = (c(FRICTION), 1e-10);
    let dmt = hertz.with_dmt(2.0)?.with_constant_damping(0.8)?.with_friction(friction)?;
    let snaps = Contact::new(sphere, jkr.with_viscoelastic_damping(time)?).with_friction(friction)?;
    let pulled = Contact::new(sphere, jkr.ending_at(JkrEnd::PullOff)).with_friction(friction)?;
    let released = hertz.with_viscoelastic_damping(time)?.without_tension().with_friction(friction)?;
    Ok(simulations("law", &dmt)?
        + &simulations("law", &snaps)?
        + &simulations("law", &pulled)?
        + &simulations("law", &released)?)
}

fn simulations<L: ContactLaw<f32>>(name: &str, scene: &Contact<f32, L, Coulomb<f32>>) -> Result<String, InputError> {
    let method = Collocation::<7, f32>::new(1e-6)?;
    let mut text = String::new();
    for (index, before) in MOTIONS.into_iter().enumerate() {
        let impact = scene.solve(&motion(before)?, &method)?;
        line(
            &mut text,
            &format!("{name} {index} {}", impact.class().map_or(u8::MAX, |class| class as u8)),
            &[
                impact.normal.overall_restitution(),
                impact.normal.peak_indentation().unwrap_or(-1.0),
                impact.tangential.velocity(),
                impact.tangential.spin(),
            ],
        );
    }
    Ok(text)
}

/// The lines of the trajectories, each whole and in the least room: of the scene, and of one without damping, adhesion and
/// friction.
fn trajectories() -> Result<String, InputError> {
    let c = f32::constant;
    let contact = surface(c(RADIUS_M))?.with_friction(c(FRICTION))?;
    // In C, a strength of zero is an absent term.
    let elastic = Contact::hertz(*contact.sphere(), Stiffness::new(c(STIFFNESS_PA))?).with_friction(0.0)?;
    Ok(trajectories_of("trajectory", &contact)? + &trajectories_of("elastic", &elastic)?)
}

fn trajectories_of<L: ContactLaw<f32>>(
    name: &str,
    scene: &Contact<f32, L, Coulomb<f32>>,
) -> Result<String, InputError> {
    let method = Collocation::<7, f32>::new(1e-6)?;
    let mut text = String::new();
    for (index, before) in MOTIONS.into_iter().enumerate() {
        let (impact, (_, trajectory)) = scene.solve_for(&motion(before)?, &method, (Slip, Recording::<64>))?;
        let whole: Vec<Sample<f32>> = trajectory.samples().collect();
        for samples in [&whole, &least(&trajectory)] {
            let class = impact.class().map_or(u8::MAX, |class| class as u8);
            line(&mut text, &format!("{name} {index} {class}"), &[impact.normal.overall_restitution()]);
            for Sample { time, indentation, velocity, force, elastic } in samples {
                line(&mut text, "sample", &[*time, *indentation, *velocity, *force, *elastic]);
            }
        }
    }
    Ok(text)
}

/// What is in a trajectory however little room there is.
fn least(whole: &Trajectory<f32, 64>) -> Vec<Sample<f32>> {
    let (first, last) = (whole.samples().next(), whole.samples().last());
    let mut samples: Vec<_> = [first, whole.peak(), whole.roll(), last].into_iter().flatten().collect();
    samples.sort_by(|a, b| a.time.total_cmp(&b.time));
    samples.dedup();
    samples
}

fn surface<T: Real>(radius: T) -> Result<RingScene<T>, InputError> {
    let c = T::constant;
    let sphere = Sphere::solid(radius, c(DENSITY_KG_M3))?;
    Contact::hertz(sphere, Stiffness::new(c(STIFFNESS_PA))?)
        .with_damping(c(MATERIAL_DAMPING))?
        .with_ring(c(RING_N_M), c(RING_DAMPING))
}

fn motion([approach, tangential, peripheral]: [f32; 3]) -> Result<PlanarMotion<f32>, InputError> {
    NormalMotion::new(approach)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)
}

/// The lines of the tables of critical speeds: that which `microimpact table` writes, and one made in single precision.
fn boundaries() -> Result<String, InputError> {
    let constant = BoundaryTable::<8>::new(2e-6_f64, |radius| {
        surface(radius)?.critical_speed(&Collocation::<9, f64>::new(1e-9)?)
    })?;
    let made = BoundaryTable::<4>::new(SMALLEST_RADIUS, |radius| {
        surface(radius)?.critical_speed(&Collocation::<7, f32>::new(1e-6)?)
    })?;
    let mut text = verdicts("constant", constant.as_slice())?;
    let (smallest, margin, cells) = made.parts();
    line(&mut text, "made", &[smallest]);
    text.pop();
    let _ = writeln!(text, " {margin}");
    for [constant, linear, square, cube] in cells {
        let _ = writeln!(text, "cell {constant} {linear} {square} {cube}");
    }
    Ok(text + &verdicts("boundary", made.as_slice())?)
}

fn verdicts(name: &str, table: BoundarySlice<'_>) -> Result<String, InputError> {
    let mut text = String::new();
    for (i, radius) in RADII.into_iter().enumerate() {
        for (j, before) in LOOKED_UP.into_iter().enumerate() {
            let verdict = table.classify(radius, &motion(before)?);
            let _ = writeln!(text, "{name} {i} {j} {}", verdict as u8);
        }
    }
    Ok(text)
}

/// The lines of the table of restitutions.
fn restitutions() -> Result<String, InputError> {
    let method = Collocation::<7, f32>::new(1e-6)?;
    let boundary = BoundaryTable::new(SMALLEST_RADIUS, |radius| surface(radius)?.critical_speed(&method))?;
    let table = RestitutionTable::<f32, 8, 6, 10>::new(boundary, LARGEST_SPEED_RATIO, |radius, speed| {
        // Friction of one takes the impulse of the elastic force from a velocity with which the sphere slides throughout.
        let scene: PaperScene<f32> = surface(radius)?.with_friction(1.0)?;
        let along = 10.0 * speed;
        let impact = scene.solve(&motion([speed, along, 0.0])?, &method)?;
        let impulse = (along - impact.tangential.velocity()) / speed;
        Ok(TableRebound { restitution: impact.normal.overall_restitution(), impulse })
    })?;
    let friction = Coulomb::new(f32::constant(FRICTION))?;
    let mut text = String::new();
    for (i, radius) in RADII.into_iter().enumerate() {
        for (j, before) in LOOKED_UP.into_iter().enumerate() {
            let motion = motion(before)?;
            let (verdict, surface_motion, numbers) = match table.look_up(radius, &motion) {
                Lookup::Rebound { rebound, error } => {
                    let after = rebound.separation(&friction, 0.4, &motion);
                    let numbers = [rebound.restitution, error, after.velocity, after.peripheral];
                    (0, if after.motion == SurfaceMotion::Sliding { 1 } else { 2 }, numbers)
                }
                Lookup::Capture => (1, 0, [0.0; 4]),
                Lookup::TooCloseToCall => (2, 0, [-1.0, -1.0, 0.0, 0.0]),
                Lookup::OutsideTable => (3, 0, [-1.0, -1.0, 0.0, 0.0]),
            };
            line(&mut text, &format!("restitution {i} {j} {verdict} {surface_motion}"), &numbers);
        }
    }
    Ok(text)
}

/// The lines of impacts on walls in space.
fn walls() -> Result<String, InputError> {
    let c = f32::constant;
    let method = Collocation::<7, f32>::new(1e-6)?;
    let scene = surface(c(RADIUS_M))?.with_friction(c(FRICTION))?;
    let mut text = String::new();
    for (i, [normal, velocity]) in WALLS.into_iter().enumerate() {
        let wall = Wall::moving(normal, velocity)?;
        for (j, [velocity, spin]) in IN_SPACE.into_iter().enumerate() {
            let before = wall.incidence(scene.sphere(), &SpatialMotion::new(velocity, spin)?)?;
            let impact = scene.solve(&before, &method)?;
            let class = impact.class().map_or(u8::MAX, |class| class as u8);
            let after = before.after(&impact).map_or([f32::NAN; 6], numbers);
            let planar = [before.normal().speed(), before.tangential(), before.peripheral(), before.sideways()];
            line(&mut text, &format!("wall {i} {j} {class}"), &[&planar[..], &after].concat());
        }
    }
    Ok(text)
}

/// The lines of collisions, each simulated on a solid sphere with radius and density of the reduced one.
fn pairs() -> Result<String, InputError> {
    let c = f32::constant;
    let method = Collocation::<7, f32>::new(1e-6)?;
    let mut text = String::new();
    for (index, Collision(radii, densities, normal, motions)) in PAIRS.into_iter().enumerate() {
        let [first, second] = [0, 1].map(|i| Sphere::solid(radii[i], densities[i]));
        let pair = Pair::new(first?, second?);
        let [first, second] = motions.map(|[velocity, spin]| SpatialMotion::new(velocity, spin));
        let before = pair.incidence(normal, [&first?, &second?])?;
        let (radius, density) = (pair.reduced().radius(), pair.reduced().density());
        let scene = Contact::hertz(Sphere::solid(radius, density)?, Stiffness::new(c(STIFFNESS_PA))?)
            .with_damping(c(MATERIAL_DAMPING))?
            .with_ring(c(RING_N_M), c(RING_DAMPING))?
            .with_friction(c(FRICTION))?;
        let impact = scene.solve(&before, &method)?;
        let class = impact.class().map_or(u8::MAX, |class| class as u8);
        let after = before.after(&impact).map_or([[f32::NAN; 6]; 2], |after| after.map(numbers));
        let planar = [radius, density, before.normal().speed(), before.tangential()];
        line(&mut text, &format!("pair {index} {class}"), &[&planar[..], &after.concat()].concat());
    }
    Ok(text)
}

/// The lines of contacts that give sideways, each by its type.
fn compliant() -> Result<String, InputError> {
    let c = f32::constant;
    let method = Collocation::<7, f32>::new(1e-6)?;
    let elastic = Contact::hertz(Sphere::solid(c(RADIUS_M), c(DENSITY_KG_M3))?, Stiffness::new(c(STIFFNESS_PA))?);
    let damped = elastic.with_damping(c(MATERIAL_DAMPING))?.with_friction(c(FRICTION))?.with_compliance(0.85)?;
    let stiff = elastic.with_friction(0.3)?.with_compliance(10.0)?.with_unloading(Unloading::Incremental);
    let mut text = String::new();
    for (j, before) in MOTIONS.into_iter().enumerate() {
        compliant_line(&mut text, &format!("compliant 0 {j}"), &damped.solve(&motion(before)?, &method)?);
    }
    for (j, before) in MOTIONS.into_iter().enumerate() {
        compliant_line(&mut text, &format!("compliant 1 {j}"), &stiff.solve(&motion(before)?, &method)?);
    }
    Ok(text)
}

fn compliant_line(text: &mut String, start: &str, impact: &SimulatedImpact<f32, CompliantVelocities<f32>>) {
    let (class, along) = (impact.class().map_or(u8::MAX, |class| class as u8), &impact.tangential);
    let numbers = [
        impact.normal.overall_restitution(),
        impact.normal.peak_indentation().unwrap_or(-1.0),
        along.velocity(),
        along.spin(),
        along.slip(),
        along.impulse_ratio(),
    ];
    line(text, &format!("{start} {class} {}", along.phases()), &numbers);
}

/// Velocity and spin.
fn numbers(motion: SpatialMotion<f32>) -> [f32; 6] {
    let ([a, b, c], [x, y, z]) = (motion.velocity(), motion.spin());
    [a, b, c, x, y, z]
}

fn line(text: &mut String, start: &str, numbers: &[f32]) {
    // Writing to a String cannot fail.
    let _ = write!(text, "{start}");
    for number in numbers {
        let _ = write!(text, " {:08x}", number.to_bits());
    }
    text.push('\n');
}
