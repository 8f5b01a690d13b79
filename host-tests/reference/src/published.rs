//! Single impacts that others measured or solved: the tests of Chung and Ooi (2011, Granular Matter 13:643), the balls of Kharaz, Gorham
//! and Salman (2001, Powder Technology 120:281), and the spheres of Thornton, Cummins and Cleary (2013, Powder Technology 233:30).

use std::f64::consts::PI;

use microimpact::contact::{Adaptive, Contact, HertzLaw, HystereticDamping, Unloading};
use microimpact::measure::{MeasuredRebound, material_damping};
use microimpact::{Coulomb, Material, NormalMotion, Outcome, Sphere, Stiffness};

/// Values read from figures, `data/published.csv`.
const PUBLISHED: &str = include_str!("../../data/published.csv");

/// Tolerance of every impact.
pub const TOLERANCE: f64 = 1e-10;

type Anything<T> = Result<T, Box<dyn std::error::Error>>;

/// Values of a source, a series and a quantity: abscissa and value.
///
/// # Panics
/// If there are none.
pub fn values(source: &str, series: &str, quantity: &str) -> Vec<(f64, f64)> {
    let number = |cell: &str| cell.parse().expect("the published values are numbers");
    let rows = crate::table(PUBLISHED).map(|(_, cells)| cells);
    let found = rows.filter(|cells| [&cells[0], &cells[1], &cells[2]] == [source, series, quantity]);
    let found: Vec<_> = found.map(|cells| (number(&cells[3]), number(&cells[4]))).collect();
    assert!(!found.is_empty(), "{source}, {series}, {quantity}");
    found
}

/// What a body is made of.
#[derive(Clone, Copy)]
pub struct Substance {
    /// As in the published series.
    pub name: &'static str,
    /// Young's modulus, Pa.
    young: f64,
    poisson: f64,
    /// kg/m^3.
    pub density: f64,
}

impl Substance {
    const fn new(name: &'static str, young: f64, poisson: f64, density: f64) -> Self {
        Self { name, young, poisson, density }
    }

    fn material(&self) -> Anything<Material<f64>> {
        Ok(Material::new(self.young, self.poisson)?)
    }
}

/// Of test 1.
pub const GLASS: Substance = Substance::new("glass", 4.8e10, 0.2, 2800.0);
/// Of test 1.
pub const LIMESTONE: Substance = Substance::new("limestone", 2e10, 0.25, 2500.0);
/// Of test 2, unlike that of the others.
pub const ALLOY_2: Substance = Substance::new("al alloy", 7e10, 0.3, 2699.0);
/// Of test 2.
pub const MAGNESIUM: Substance = Substance::new("mg alloy", 4e10, 0.35, 1800.0);
/// Of the tests 3 and 4, and of the measured balls.
pub const OXIDE: Substance = Substance::new("al oxide", 3.8e11, 0.23, 4000.0);
/// Of test 3.
pub const IRON: Substance = Substance::new("cast iron", 1e11, 0.25, 7000.0);
/// Of the tests 4 and 6 to 8.
pub const ALLOY: Substance = Substance::new("al alloy", 7e10, 0.33, 2700.0);
/// Of test 5.
pub const STEEL: Substance = Substance::new("steel", 2.08e11, 0.3, 7850.0);
/// Of test 5.
pub const POLYETHYLENE: Substance = Substance::new("polyethylene", 1e9, 0.4, 1400.0);
/// Of the tests 6 and 8.
pub const NYLON: Substance = Substance::new("nylon", 2.5e9, 0.4, 1000.0);
/// Of test 7.
pub const COPPER: Substance = Substance::new("copper", 1.2e11, 0.35, 8900.0);
/// Of Thornton's spheres.
pub const SPHERE: Substance = Substance::new("sphere", 7e10, 0.3, 2650.0);

/// The stiffness of a body against another of the same substance, or against a rigid plane.
///
/// # Errors
/// A number outside its range.
pub fn stiffness(substance: &Substance, rigid_plane: bool) -> Anything<Stiffness<f64>> {
    let material = substance.material()?;
    if rigid_plane {
        return Ok(Stiffness::new(4.0 / (3.0 * PI) / material.elastic_constant())?);
    }
    Ok(Stiffness::between(&material, &material)?)
}

/// A sphere on a plane: Hertz's contact with hysteretic damping and friction, and its stiffness ratio.
#[derive(Clone, Copy)]
pub struct Scene {
    /// The contact without compliance.
    pub contact: Contact<f64, HertzLaw<f64, HystereticDamping<f64>>, Coulomb<f64>>,
    /// Tangential over normal stiffness.
    pub stiffness_ratio: f64,
}

/// A sphere of a substance on a plane of the same: its restitution at an approach speed (m/s), and its friction.
///
/// # Errors
/// A number outside its range.
pub fn scene(
    sphere: Sphere<f64>,
    substance: &Substance,
    (restitution, speed): (f64, f64),
    friction: f64,
) -> Anything<Scene> {
    let elastic = Contact::hertz(sphere, stiffness(substance, false)?);
    let rebound = MeasuredRebound { speed, restitution };
    let zeta =
        if restitution < 1.0 { material_damping(&elastic, &Adaptive::new(1e-12)?, &rebound, 1e-12)? } else { 0.0 };
    let stiffness_ratio = Stiffness::tangential_ratio_between(&substance.material()?, &substance.material()?);
    Ok(Scene { contact: elastic.with_damping(zeta)?.with_friction(friction)?, stiffness_ratio })
}

/// How the contact along the surface is modelled.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Along {
    /// It sticks elastically by this rule.
    Compliant(Unloading),
    /// It slides until it rolls.
    Rigid,
}

/// The three models.
pub const MODELS: [(&str, Along); 3] = [
    ("compliant, rescaled", Along::Compliant(Unloading::Rescaled)),
    ("compliant, incremental", Along::Compliant(Unloading::Incremental)),
    ("without compliance", Along::Rigid),
];

/// Velocities after an impact.
#[derive(Clone, Copy)]
pub struct After {
    /// Normal velocity, m/s.
    pub normal: f64,
    /// Tangential velocity of the centre, m/s.
    pub tangential: f64,
    /// Peripheral velocity, m/s.
    pub peripheral: f64,
}

impl After {
    /// Velocity of the contact point, m/s.
    pub fn slip(&self) -> f64 {
        self.tangential - self.peripheral
    }

    /// Angle from the normal at which the contact point leaves, in degrees.
    pub fn contact_angle(&self) -> f64 {
        (self.slip() / self.normal).atan().to_degrees()
    }
}

/// The impact of a scene with an approach speed, a tangential and a peripheral velocity, m/s.
///
/// # Errors
/// A number outside its range.
///
/// # Panics
/// If the sphere does not rebound.
pub fn impact(scene: &Scene, [speed, tangential, peripheral]: [f64; 3], along: Along) -> Anything<After> {
    let motion = NormalMotion::new(speed)?.with_tangential(tangential)?.with_peripheral_velocity(peripheral)?;
    let (method, radius) = (Adaptive::new(TOLERANCE)?, scene.contact.sphere().radius());
    let (normal, tangential, spin) = match along {
        Along::Compliant(unloading) => {
            let compliant = scene.contact.with_compliance(scene.stiffness_ratio)?.with_unloading(unloading);
            let impact = compliant.solve(&motion, &method)?;
            (impact.normal, impact.tangential.velocity(), impact.tangential.spin())
        }
        Along::Rigid => {
            let impact = scene.contact.solve(&motion, &method)?;
            (impact.normal, impact.tangential.velocity(), impact.tangential.spin())
        }
    };
    assert_eq!(normal.outcome(), Some(Outcome::Rebound));
    Ok(After { normal: normal.rebound_speed(), tangential, peripheral: spin * radius })
}

/// Root of the mean square.
pub fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = errors.fold((0.0, 0.0), |(sum, count), error| (sum + error * error, count + 1.0));
    (sum / count).sqrt()
}
