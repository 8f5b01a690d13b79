//! The laws that compete, their parameters, and the median curve that each gives.

use std::f64::consts::PI;

use microimpact::RestitutionLaw;
use microimpact::rigid::ElasticPlasticRestitution;

use crate::contact::ContactCurve;
use crate::monotone::Monotone;

/// A law of restitution or of contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// R at every speed, with the work of adhesion W_A (A34).
    Constant,
    /// R = k/(k + v), with W_A (A34).
    SpeedRestitution,
    /// Thornton's elastic-plastic R with the yield speed v_y, with W_A (A34).
    ElasticPlastic,
    /// R of a viscoelastic sphere, with W_A (A34).
    Viscoelastic,
    /// The contact simulation with hysteretic damping and the paper's ring of adhesion.
    Ring,
    /// The contact simulation with hysteretic damping and the adhesion of Derjaguin, Muller and Toporov.
    Dmt,
    /// The contact simulation with hysteretic damping of Johnson, Kendall and Roberts' contact.
    Jkr,
}

/// A parameter in the units of a fit, where speeds are multiples of the reference speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Kinetic restitution R.
    Restitution,
    /// Reference speed over k.
    Loss,
    /// Logarithm of the yield speed v_y over the reference speed.
    YieldSpeed,
    /// x of a viscoelastic sphere at the reference speed.
    Viscosity,
    /// 2 W_A/m over the square of the reference speed, of the sphere of median mass.
    Work,
    /// Critical speed over the reference speed, of the sphere of median mass.
    CriticalSpeed,
    /// Hysteretic damping c_H times the reference speed.
    Damping,
    /// Damping zeta_A of adhesion over zeta_H of the materials.
    AdhesionDamping,
}

impl Law {
    /// All laws, the paper's first.
    pub const ALL: [Self; 7] = [
        Self::SpeedRestitution,
        Self::Constant,
        Self::ElasticPlastic,
        Self::Viscoelastic,
        Self::Ring,
        Self::Dmt,
        Self::Jkr,
    ];

    /// Its name in options and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::SpeedRestitution => "speed-restitution",
            Self::ElasticPlastic => "elastic-plastic",
            Self::Viscoelastic => "viscoelastic",
            Self::Ring => "ring",
            Self::Dmt => "dmt",
            Self::Jkr => "jkr",
        }
    }

    /// Whether the law is a restitution law of the rigid body, whose adhesion takes the work W_A.
    #[must_use]
    pub fn is_rigid(self) -> bool {
        matches!(self, Self::Constant | Self::SpeedRestitution | Self::ElasticPlastic | Self::Viscoelastic)
    }

    /// Its parameters. Adhesion is the work W_A, or the critical speed instead of it.
    #[must_use]
    pub fn coordinates(self, adhesion: Coordinate) -> Vec<Coordinate> {
        match self {
            Self::Constant => vec![Coordinate::Restitution, adhesion],
            Self::SpeedRestitution => vec![Coordinate::Loss, adhesion],
            Self::ElasticPlastic => vec![Coordinate::YieldSpeed, adhesion],
            Self::Viscoelastic => vec![Coordinate::Viscosity, adhesion],
            Self::Ring => vec![Coordinate::Damping, Coordinate::CriticalSpeed, Coordinate::AdhesionDamping],
            Self::Dmt | Self::Jkr => vec![Coordinate::Damping, Coordinate::CriticalSpeed],
        }
    }

    /// Its curve; `None` if there is none with these parameters. `radii` are the smallest and the largest radius over that of the
    /// sphere of median mass, and `fastest` the largest speed at which the curve is asked for.
    #[must_use]
    pub fn curve(self, coordinates: &[Coordinate], values: &[f64], radii: (f64, f64), fastest: f64) -> Option<Curve> {
        if !self.is_rigid() {
            return ContactCurve::new(self, values, radii, fastest).map(Curve::Contact);
        }
        let body = match self {
            Self::Constant => Body::Constant(values[0]),
            Self::SpeedRestitution => Body::Speed(values[0]),
            Self::ElasticPlastic => {
                let law = ElasticPlasticRestitution::new(values[0].exp()).ok()?;
                Body::tabulated(|speed| law.restitution(speed))
            }
            _ => {
                let law = viscoelastic(values[0])?;
                Body::tabulated(|speed| law.restitution(speed))
            }
        };
        let pull = match coordinates[1] {
            Coordinate::CriticalSpeed => body.rebound(values[1]).0.powi(2),
            _ => values[1],
        };
        Some(Curve::Rigid { body, pull })
    }
}

/// The restitution of a viscoelastic sphere of unit mass, radius and stiffness, with this x at unit speed.
fn viscoelastic(x: f64) -> Option<microimpact::rigid::ViscoelasticRestitution<f64>> {
    let sphere = microimpact::Sphere::solid(1.0, 0.75 / PI).ok()?;
    let stiffness = microimpact::Stiffness::new(1.0).ok()?;
    microimpact::rigid::ViscoelasticRestitution::new(&sphere, stiffness, x / 1.5).ok()
}

/// The size of a sphere, relative to the sphere of median mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Median mass over its mass.
    pub lightness: f64,
    /// Logarithm of its radius over the median radius.
    pub log_radius: f64,
}

impl Size {
    /// The sphere of median mass.
    pub const MEDIAN: Self = Self { lightness: 1.0, log_radius: 0.0 };

    /// A sphere of equal density.
    #[must_use]
    pub fn of_mass(mass: f64, median: f64) -> Self {
        Self { lightness: median / mass, log_radius: (mass / median).ln() / 3.0 }
    }
}

/// The median rebound speed against the approach speed, all in reference speeds. The rebound speed is continued below the critical
/// speed by negative numbers, whose squares are the energy that a captured sphere lacks.
#[derive(Clone, Debug)]
pub enum Curve {
    /// e^2 = R^2 - 2 W_A/(m v^2) (A34).
    Rigid {
        /// The body without adhesion.
        body: Body,
        /// 2 W_A/m.
        pull: f64,
    },
    /// A contact simulation.
    Contact(ContactCurve),
}

impl Curve {
    /// Signed square of the rebound speed, and its derivative by the approach speed.
    #[must_use]
    pub fn square(&self, speed: f64, size: Size) -> (f64, f64) {
        match self {
            Self::Rigid { body, pull } => {
                let (rebound, slope) = body.rebound(speed);
                (rebound * rebound - pull * size.lightness, 2.0 * rebound * slope)
            }
            Self::Contact(curve) => curve.square(speed, size),
        }
    }

    /// Approach speed of a signed rebound speed, and its derivative.
    #[must_use]
    pub fn approach(&self, rebound: f64, size: Size) -> (f64, f64) {
        match self {
            Self::Rigid { body, pull } => {
                let energy = rebound * rebound.abs() + pull * size.lightness;
                if energy <= 0.0 {
                    return (0.0, 0.0);
                }
                let without = energy.sqrt();
                let (speed, slope) = body.approach(without);
                (speed, slope * rebound.abs() / without)
            }
            Self::Contact(curve) => curve.approach(rebound, size),
        }
    }

    /// Signed rebound speed.
    #[must_use]
    pub fn rebound(&self, speed: f64, size: Size) -> f64 {
        let (square, _) = self.square(speed, size);
        square.signum() * square.abs().sqrt()
    }

    /// Median restitution.
    #[must_use]
    pub fn restitution(&self, speed: f64, size: Size) -> f64 {
        self.rebound(speed, size).max(0.0) / speed
    }

    /// Critical speed.
    #[must_use]
    pub fn critical_speed(&self, size: Size) -> f64 {
        self.approach(0.0, size).0
    }

    /// 2 W_A/m of the sphere of median mass, for a rigid body.
    #[must_use]
    pub fn pull(&self) -> Option<f64> {
        match self {
            Self::Rigid { pull, .. } => Some(*pull),
            Self::Contact(_) => None,
        }
    }
}

/// The rebound R(v) v without adhesion.
#[derive(Clone, Debug)]
pub enum Body {
    /// R.
    Constant(f64),
    /// Loss c of R = 1/(1 + c v).
    Speed(f64),
    /// Logarithms of rebound and approach speed, both ways.
    Tabulated(Box<[Monotone; 2]>),
}

/// Range and number of the speeds of a table, in reference speeds; logarithmic.
const SLOWEST: f64 = 1e-4;
const FASTEST: f64 = 3.0;
const SPEEDS: u32 = 96;

impl Body {
    fn tabulated(restitution: impl Fn(f64) -> f64) -> Self {
        let at = |step| SLOWEST * (FASTEST / SLOWEST).powf(f64::from(step) / f64::from(SPEEDS));
        let approach: Vec<f64> = (0..=SPEEDS).map(|step| at(step).ln()).collect();
        let rebound: Vec<f64> = approach.iter().map(|log| log + restitution(log.exp()).max(1e-300).ln()).collect();
        Self::Tabulated(Box::new([
            Monotone::through(approach.clone(), rebound.clone()),
            Monotone::through(rebound, approach),
        ]))
    }

    /// Rebound speed and its derivative.
    fn rebound(&self, speed: f64) -> (f64, f64) {
        match self {
            Self::Constant(restitution) => (restitution * speed, *restitution),
            Self::Speed(loss) => {
                let restitution = 1.0 / (1.0 + loss * speed);
                (restitution * speed, restitution * restitution)
            }
            Self::Tabulated(tables) => power(&tables[0], speed),
        }
    }

    /// Approach speed and its derivative. It is large where no speed is fast enough.
    fn approach(&self, rebound: f64) -> (f64, f64) {
        match self {
            Self::Constant(restitution) => {
                let inverse = 1.0 / restitution.max(1e-9);
                (rebound * inverse, inverse)
            }
            Self::Speed(loss) => {
                // R(v) v approaches 1/c.
                let inverse = 1.0 / (1.0 - loss * rebound).max(1e-6);
                (rebound * inverse, inverse * inverse)
            }
            Self::Tabulated(tables) => power(&tables[1], rebound),
        }
    }
}

/// A function and its derivative from a table of logarithms.
fn power(table: &Monotone, x: f64) -> (f64, f64) {
    if x <= 0.0 {
        return (0.0, 1.0);
    }
    let (log, slope) = table.at(x.ln());
    let value = log.exp();
    (value, slope * value / x)
}
