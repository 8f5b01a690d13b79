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
            "velocity_z_m_s,normal_x,normal_y,normal_z",
            "-1,2,-3,6",
            "normal_x, normal_y, normal_z: length of the normal is 7, but must be 0.999 to 1.001; divide each component by 7",
        ),
        (
            "velocity_z_m_s,normal_x",
            "-1,0",
            "normal_x, normal_y, normal_z: length of the normal is 0, but must be 0.999 to 1.001; give the direction",
        ),
        ("velocity_z_m_s", "1", "velocity_z_m_s: approach speed is -1 m/s, but must be positive"),
        ("velocity_x_m_s,velocity_z_m_s", "1,1", "velocity_x_m_s, velocity_z_m_s: approach speed is -1 m/s"),
        (
            "speed_normal_m_s,radius_2_m,velocity_2_z_m_s",
            "1,1e-6,-2",
            "speed_normal_m_s: approach speed is -1 m/s, but must be positive",
        ),
        ("velocity_z_m_s,velocity_x_m_s", "-1,2e7", "velocity_x_m_s: \"2e7\" is refused: component of the velocity"),
    ] {
        let error = refused(&format!("{scene},{columns}\n1e-6,1000,1e10,{cells}\n"));
        assert!(error.starts_with(reason), "{columns}: {error}");
    }
}

/// What is absent from a vector counts as zero, and the command says so.
#[test]
fn absent_components_are_said() {
    let absent = |columns: &str, cells: &str| {
        let table = format!("radius_m,density_kg_m3,restitution,{columns}\n1e-6,1000,0.5,{cells}\n");
        let complaint = run(&["-", "--format", "csv"], table.as_bytes()).complaint();
        complaint.lines().find(|line| line.contains("columns absent")).unwrap().to_owned()
    };
    let wall = absent("velocity_x_m_s,velocity_z_m_s,normal_z,wall_velocity_x_m_s", "1,-1,1,0");
    for words in [
        "velocity_y_m_s (0 m/s)",
        "spin_x_rad_s, spin_y_rad_s, spin_z_rad_s (0 rad/s)",
        "normal_x (0), normal_y (0)",
        "wall_velocity_y_m_s (0 m/s), wall_velocity_z_m_s (0 m/s)",
    ] {
        assert!(wall.contains(words), "{words}: {wall}");
    }
    for words in ["speed_tangential_m_s", "_2_", "velocity_x_m_s (", " spin_rad_s"] {
        assert!(!wall.contains(words), "{words}: {wall}");
    }
    let pair = absent("velocity_z_m_s,radius_2_m,velocity_2_x_m_s,spin_2_y_rad_s", "-1,1e-6,0,0");
    for words in [
        "normal_x, normal_y, normal_z (0, 0, 1)",
        "density_2_kg_m3 (that of the first sphere), gyration_ratio_2 (0.4, a solid sphere)",
        "velocity_2_y_m_s (0 m/s), velocity_2_z_m_s (0 m/s), spin_2_x_rad_s (0 rad/s), spin_2_z_rad_s (0 rad/s)",
    ] {
        assert!(pair.contains(words), "{words}: {pair}");
    }
    assert!(!pair.contains("wall_velocity"), "{pair}");
    // Nothing of this in a plane.
    let plane = absent("speed_normal_m_s", "1");
    assert!(
        !plane.contains("velocity_") && plane.contains("speed_tangential_m_s (0 m/s), spin_rad_s (0 rad/s)"),
        "{plane}"
    );
}

/// The energies are those of the bodies, and what is lost between them is the sum of the works.
#[test]
fn energies_are_those_of_the_bodies() {
    let table = "radius_m,density_kg_m3,restitution,friction,velocity_x_m_s,velocity_y_m_s,velocity_z_m_s,spin_x_rad_s,\
                 spin_z_rad_s,radius_2_m,velocity_2_z_m_s,wall_velocity_x_m_s\n\
                 2e-3,1000,0.9,0.3,3,1,-2,500,300,1e-3,1,\n\
                 2e-3,1000,0.9,0.3,3,1,-2,500,300,,,\n\
                 2e-3,1000,0.9,0.3,3,1,-2,500,300,,,0.5\n";
    let written = classified(table, "rigid-body");
    let number = |row: usize, columns: &[&str]| columns.iter().map(|column| written.number(row, column)).sum::<f64>();
    let works = ["work_material_j", "work_adhesion_j", "work_friction_j", "work_rolling_j"];
    let close = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found:e} {expected:e}");
    let lost = |row: usize| -number(row, &works).abs();
    let (before, after) = (["energy_in_j", "energy_2_in_j"], ["energy_out_j", "energy_2_out_j"]);
    close(number(0, &before), number(0, &["energy_before_j"]));
    close(number(0, &before) + lost(0), number(0, &after));
    close(number(1, &["energy_in_j"]), number(1, &["energy_before_j"]));
    close(number(1, &["energy_in_j"]) + lost(1), number(1, &["energy_out_j"]));
    // A solid sphere of radius r and density rho: its mass is 4/3 pi r^3 rho, and 2/5 r^2 of that its moment of inertia.
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 8e-9 * 1000.0;
    let energy = |along: f64| 0.5 * mass * (along * along + 5.0 + 0.4 * 4e-6 * (500.0 * 500.0 + 300.0 * 300.0));
    close(number(2, &["energy_in_j"]), energy(3.0));
    close(number(2, &["energy_before_j"]), energy(2.5));
    assert_eq!(written.text(1, "energy_2_in_j"), "");
}

/// The summary shows both spheres, and no velocity of the reduced one.
#[test]
fn summary_of_two_spheres() {
    let table = "radius_m,density_kg_m3,restitution,stiffness_pa,velocity_x_m_s,velocity_z_m_s,radius_2_m,velocity_2_z_m_s\n\
                 1e-3,1000,1,1e10,0.25,-1,1e-3,1\n";
    for model in ["rigid-body", "simulation"] {
        let summary = String::from_utf8(run(&["-", "--model", model], table.as_bytes()).stdout).unwrap();
        for words in [
            "velocity after",
            "energy before",
            "(0.250, 0.000, 1.000)",
            "(0.000, 0.000, -1.000)",
            "2.225e-6",
            "2.094e-6",
        ] {
            assert!(summary.contains(words), "{words}: {summary}");
        }
    }
    let plane = "radius_m,density_kg_m3,restitution,speed_normal_m_s\n1e-3,1000,1,1\n";
    assert!(!String::from_utf8(run(&["-"], plane.as_bytes()).stdout).unwrap().contains("velocity after"));
}

/// A column of zeros for adhesion is no adhesion; compliance needs no option, and says which method it needs.
#[test]
fn compliance() {
    let scene = "radius_m,density_kg_m3,stiffness_pa,friction,speed_normal_m_s,speed_tangential_m_s,stiffness_ratio";
    let run = |columns: &str, cells: &str, arguments: &[&str]| {
        let table = format!("{scene},{columns}\n1e-3,1000,1e10,0.3,1,0.5,0.85,{cells}\n");
        let output = run(&[&["-", "--format", "csv", "--model", "simulation"], arguments].concat(), table.as_bytes());
        Written::read(&output.stdout, b',')
    };
    let without = run("zeta_h", "3", &[]);
    assert_eq!((without.text(0, "error"), without.text(0, "law"), without.text(0, "phases")), ("", "hertz", "3"));
    let zero = run("zeta_h,adhesion_n_m,zeta_a", "3,0,0", &[]);
    for column in ["error", "law", "overall_restitution", "impulse_ratio_out", "phases"] {
        assert_eq!(zero.text(0, column), without.text(0, column), "{column}");
    }
    assert_eq!(
        zero.text(0, "impulse_ratio_out"),
        run("zeta_h", "3", &["--method", "adaptive"]).text(0, "impulse_ratio_out")
    );
    let error = run("zeta_h", "3", &["--method", "collocation"]).text(0, "error").to_owned();
    assert_eq!(
        error,
        "stiffness_ratio: --method collocation is not offered with it; use --method adaptive, or leave the cell empty"
    );
    assert!(run("adhesion_n_m", "250", &[]).text(0, "error").contains("only be given with Hertz's contact"));
}
