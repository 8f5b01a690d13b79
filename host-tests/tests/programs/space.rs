//! The command `classify` with motions in space and with two spheres.

use microimpact::contact::{Adaptive, AnyLaw, Contact};
use microimpact::space::{Pair, SpatialMotion, Wall};
use microimpact::{ConstantRestitution, RigidBody, Sphere, Stiffness};

use crate::classify::{Written, run};

const AFTER: [&str; 7] = [
    "velocity_out_x_m_s",
    "velocity_out_y_m_s",
    "velocity_out_z_m_s",
    "spin_out_x_rad_s",
    "spin_out_y_rad_s",
    "spin_out_z_rad_s",
    "energy_out_j",
];

fn classified(table: &str, model: &str) -> Written {
    let output = run(&["-", "--format", "csv", "--model", model], table.as_bytes());
    assert_eq!(output.status, 0, "{}", output.complaint());
    Written::read(&output.stdout, b',')
}

fn refused(table: &str) -> String {
    let output = run(&["-", "--format", "csv", "--model", "simulation"], table.as_bytes());
    assert_eq!(output.status, 1, "{}", output.complaint());
    Written::read(&output.stdout, b',').text(0, "error").to_owned()
}

/// The cells of a motion after an impact, which are those of the library to the last bit.
fn assert_motion(written: &Written, columns: &[String], motion: &SpatialMotion<f64>, sphere: &Sphere<f64>) {
    let numbers = [&motion.velocity()[..], &motion.spin(), &[motion.energy(sphere)]].concat();
    for (column, number) in columns.iter().zip(numbers) {
        assert_eq!(written.number(0, column), number + 0.0, "{column}");
    }
}

fn first() -> Vec<String> {
    AFTER.map(String::from).into()
}

fn second() -> Vec<String> {
    AFTER.map(|column| column.replacen("_out", "_2_out", 1)).into()
}

#[test]
fn a_moving_wall_of_any_direction() {
    let table = "radius_m,density_kg_m3,stiffness_pa,zeta_h,restitution,friction,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s,\
                 spin_x_rad_s,spin_y_rad_s,spin_z_rad_s,normal_x,normal_y,normal_z,wall_velocity_x_m_s,wall_velocity_y_m_s\n\
                 1e-6,1000,1e10,3,0.8,0.2,-1.5,0.25,0.5,1e5,-2e5,3e5,0.6,0,-0.8,0.125,-0.5\n";
    let sphere = Sphere::solid(1e-6, 1000.0).unwrap();
    let wall = Wall::moving([0.6, 0.0, -0.8], [0.125, -0.5, 0.0]).unwrap();
    let motion = SpatialMotion::new([-1.5, 0.25, 0.5], [1e5, -2e5, 3e5]).unwrap();
    let before = wall.incidence(&sphere, &motion).unwrap();

    let law = AnyLaw::hertz(Stiffness::new(1e10).unwrap()).with_damping(3.0).unwrap();
    let scene = Contact::new(sphere, law).with_friction(0.2).unwrap().with_peeling(0.0).unwrap();
    let planar = microimpact::NormalMotion::new(microimpact::Approach::normal(&before).speed()).unwrap();
    let planar = planar.with_tangential(microimpact::Oblique::tangential(&before)).unwrap();
    let planar = planar.with_peripheral_velocity(microimpact::Oblique::peripheral(&before)).unwrap();
    let simulated = scene.solve(&planar, &Adaptive::new(1e-9).unwrap()).unwrap();
    assert_motion(&classified(table, "simulation"), &first(), &before.after(&simulated).unwrap(), &sphere);

    let scene = RigidBody::new(sphere, ConstantRestitution::new(0.8).unwrap()).with_friction(0.2).unwrap();
    let after = before.after(&scene.impact(&before)).unwrap();
    assert_motion(&classified(table, "rigid-body"), &first(), &after, &sphere);
    let both = classified(table, "both");
    assert_eq!(both.number(0, "rigid_body_velocity_out_x_m_s"), after.velocity()[0]);
}

#[test]
fn two_spheres_in_space() {
    let table = "radius_m,density_kg_m3,gyration_ratio,restitution,friction,velocity_x_m_s,velocity_z_m_s,spin_y_rad_s,\
                 radius_2_m,density_2_kg_m3,gyration_ratio_2,velocity_2_z_m_s,spin_2_y_rad_s\n\
                 2e-3,1000,0.4,0.9,0.3,0.35,-0.9,0.2,1e-3,3000,0.6,0.4,-0.3\n";
    let spheres = [Sphere::new(2e-3, 1000.0, 0.4).unwrap(), Sphere::new(1e-3, 3000.0, 0.6).unwrap()];
    let pair = Pair::new(spheres[0], spheres[1]);
    let motions = [
        SpatialMotion::new([0.35, 0.0, -0.9], [0.0, 0.2, 0.0]).unwrap(),
        SpatialMotion::new([0.0, 0.0, 0.4], [0.0, -0.3, 0.0]).unwrap(),
    ];
    let before = pair.incidence([0.0, 0.0, 1.0], [&motions[0], &motions[1]]).unwrap();
    let scene = RigidBody::new(pair.reduced(), ConstantRestitution::new(0.9).unwrap()).with_friction(0.3).unwrap();
    let after = before.after(&scene.impact(&before)).unwrap();
    let written = classified(table, "rigid-body");
    assert_motion(&written, &first(), &after[0], &spheres[0]);
    assert_motion(&written, &second(), &after[1], &spheres[1]);

    // The same in the columns of a plane, in which the second sphere is given in space.
    let plane =
        table.replace("velocity_x_m_s,velocity_z_m_s,spin_y_rad_s", "speed_tangential_m_s,speed_normal_m_s,spin_rad_s");
    let written = classified(&plane.replace("0.35,-0.9", "0.35,0.9"), "rigid-body");
    assert_motion(&written, &first(), &after[0], &spheres[0]);
}

/// A sphere that is captured, and whose plane shows it at rest, may still roll sideways.
#[test]
fn a_captured_sphere_that_rolls_sideways_does_not_rest() {
    let table = "radius_m,density_kg_m3,restitution,work_of_adhesion_j,friction,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s,\
                 spin_x_rad_s,spin_y_rad_s\n";
    // It slips along x, where its spin is just what stops it, and rolls along y.
    let sideways = format!("{table}1,1000,0.5,1e6,1e3,1,1,-1,-1,-2.5\n");
    let straight = format!("{table}1,1000,0.5,1e6,1e3,1,0,-1,0,-2.5\n");
    assert_eq!(classified(&straight, "rigid-body").text(0, "motion"), "resting");
    let written = classified(&sideways, "rigid-body");
    assert_eq!((written.text(0, "outcome"), written.text(0, "motion")), ("capture", "rolling"));
    assert_eq!(written.number(0, "velocity_out_y_m_s"), 1.0);
}

#[test]
fn columns_in_space_are_written_where_they_are_read() {
    let table = "radius_m,density_kg_m3,restitution,speed_normal_m_s\n1e-6,1000,0.5,1\n";
    let output = run(&["-", "--format", "csv"], table.as_bytes());
    assert!(!output.complaint().contains("normal_x"));
    let header = String::from_utf8(output.stdout).unwrap();
    assert!(!header.contains("velocity_out"), "{header}");
}

#[test]
fn what_does_not_go_together_is_refused() {
    let scene = "radius_m,density_kg_m3,stiffness_pa";
    for (columns, cells, reason) in [
        ("velocity_z_m_s,speed_normal_m_s", "-1,1", "speed_normal_m_s: the velocity is given in space"),
        ("speed_normal_m_s,normal_x", "1,1", "normal_x: it goes with velocity_x_m_s"),
        ("velocity_z_m_s,density_2_kg_m3", "-1,1000", "density_2_kg_m3: radius_2_m is missing"),
        ("velocity_z_m_s,velocity_2_z_m_s", "-1,1", "velocity_2_z_m_s: radius_2_m is missing"),
        ("velocity_z_m_s,peeling_n_m", "-1,1e-12", "peeling_n_m: it acts against a spin about one axis"),
        (
            "velocity_z_m_s,radius_2_m,external_force_n",
            "-1,1e-6,1e-9",
            "external_force_n: it is not known for two spheres",
        ),
        (
            "velocity_z_m_s,radius_2_m,wall_velocity_x_m_s",
            "-1,1e-6,1",
            "wall_velocity_x_m_s: two spheres meet without a wall",
        ),
        (
            "velocity_z_m_s,normal_z",
            "-1,0.9",
            "normal_z: \"0.9\" is refused: length of the normal must be 0.999 to 1.001",
        ),
        ("velocity_z_m_s", "1", "approach speed is -1 m/s, but must be positive"),
        ("velocity_z_m_s,velocity_x_m_s", "-1,2e7", "velocity_x_m_s: \"2e7\" is refused: component of the velocity"),
    ] {
        let error = refused(&format!("{scene},{columns}\n1e-6,1000,1e10,{cells}\n"));
        assert!(error.starts_with(reason), "{columns}: {error}");
    }
}
