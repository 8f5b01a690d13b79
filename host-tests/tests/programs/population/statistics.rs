//! The statistics of a population against closed forms and against Monte Carlo.

use std::f64::consts::PI;

use microimpact::contact::{Adaptive, AnyLaw, Contact};
use microimpact::measure::NormalDistribution;
use microimpact::{
    Class, Coulomb, CriticalSpeed, InputError, NormalMotion, RigidBody, SpeedRestitution, Sphere, Stiffness, rigid,
};
use population::{
    Distribution, Estimate, Outcomes, Population, PopulationError, Rebound, Response, RigidBodies, Simulations,
    Statistics,
};
use rand::SeedableRng;
use rand::rngs::StdRng;
use rand_distr::{Distribution as _, StandardNormal};
use reference::repetitions;

type Failure = Box<dyn std::error::Error>;

/// Spheres with the critical speed C d^-p, which rebound with e^2 = 1 - (v_c/v)^2.
struct PowerLaw {
    factor: f64,
    power: f64,
}

impl Response for PowerLaw {
    fn critical_speed(&self, diameter: f64, adhesion: f64) -> Result<CriticalSpeed<f64>, PopulationError> {
        Ok(CriticalSpeed::At(self.factor * diameter.powf(-self.power) * adhesion))
    }

    fn rebound(&self, diameter: f64, adhesion: f64, speed: f64) -> Result<Rebound, PopulationError> {
        let critical = self.factor * diameter.powf(-self.power) * adhesion;
        Ok(Rebound { restitution: (1.0 - (critical / speed).powi(2)).max(0.0).sqrt(), stopped: f64::INFINITY })
    }

    fn stopped_in_capture(&self, _diameter: f64, _adhesion: f64) -> Result<f64, PopulationError> {
        Ok(f64::INFINITY)
    }
}

fn near(found: Estimate, expected: f64, noise: f64, what: &str) {
    assert!(
        (found.value - expected).abs() <= found.error + noise,
        "{what}: {found:?} instead of {expected} within {noise}"
    );
}

/// P = Phi[(ln C - mu_v - p mu_d)/sqrt(s_v^2 + p^2 s_d^2 + s_a^2)], and by mass mu_d + 3 s_d^2 instead of mu_d. The spreads are
/// alike, one much larger than the others, or zero.
#[test]
fn closed_form_of_log_normal_populations() -> Result<(), Failure> {
    let (median, factor, power) = (5e-6, 1.5 * 5e-6_f64.powf(1.6), 1.6);
    for (speed, [s_d, s_v, s_a]) in [
        (1.6, [0.3, 0.2, 0.0]),
        (1.0, [0.3, 0.01, 0.2]),
        (3.0, [0.01, 0.3, 0.2]),
        (1.4, [0.4, 0.0, 0.0]),
        (2.0, [0.0, 0.5, 0.0]),
        (1.5, [0.0, 0.0, 0.3]),
        (1.2, [0.6, 0.4, 0.3]),
        (1.6, [0.2, 0.0, 0.001]),
    ] {
        let population = Population {
            diameter: Distribution::log_normal(median, f64::exp(s_d))?,
            adhesion: Distribution::log_normal(1.0, f64::exp(s_a))?,
            angle: Distribution::fixed(0.0)?,
            speed: Distribution::log_normal(speed, f64::exp(s_v))?,
        };
        let spheres = PowerLaw { factor, power };
        let spread = (s_v * s_v + (power * s_d).powi(2) + s_a * s_a).sqrt();
        let capture =
            |shift: f64| ((factor.ln() - f64::ln(speed) - power * (f64::ln(median) + shift)) / spread).below();
        for statistics in
            [Statistics::direct(&population, &spheres), Statistics::interpolated(&population, &spheres, &[])?]
        {
            let found = statistics.outcomes()?.capture();
            near(found, capture(0.0), 5e-9, "by number");
            let by_mass = statistics.outcomes_by_mass()?.capture();
            near(by_mass, capture(3.0 * s_d * s_d), 5e-9, "by mass");
            assert!(found.error < 2e-5 && by_mass.error < 2e-5, "{found:?} {by_mass:?}");
        }
    }
    Ok(())
}

/// The size bins of a population at one speed are a step at one diameter; together they give the whole.
#[test]
fn capture_efficiency_by_size() -> Result<(), Failure> {
    let (factor, power, speed) = (1.5 * 5e-6_f64.powf(1.6), 1.6, 1.4_f64);
    let population = Population {
        diameter: Distribution::log_normal(5e-6, 1.5)?,
        adhesion: Distribution::fixed(1.0)?,
        angle: Distribution::fixed(0.0)?,
        speed: Distribution::fixed(speed)?,
    };
    let spheres = PowerLaw { factor, power };
    let statistics = Statistics::direct(&population, &spheres);
    let edges: Vec<f64> = (0..=12).map(|index| 1e-7 * 10.0_f64.powf(0.25 * f64::from(index))).collect();
    let bins = statistics.by_size(&edges)?;
    let step = (factor / speed).powf(1.0 / power);
    let mut sums = [0.0; 4];
    for bin in &bins {
        let captured = population.diameter.part(bin.from, step.min(bin.to)) / bin.number;
        near(bin.by_number, captured, 1e-8, "by number");
        let mass = population.diameter.clone().weighted(3);
        near(bin.by_mass, mass.part(bin.from, step.min(bin.to)) / bin.mass, 1e-8, "by mass");
        for (sum, part) in
            sums.iter_mut().zip([bin.number, bin.mass, bin.number * bin.by_number.value, bin.mass * bin.by_mass.value])
        {
            *sum += part;
        }
    }
    assert!(bins.iter().any(|bin| bin.by_number.value > 0.01 && bin.by_number.value < 0.99));
    let [number, mass, by_number, by_mass] = sums;
    assert!((number - 1.0).abs() < 1e-8 && (mass - 1.0).abs() < 1e-8);
    near(statistics.outcomes()?.capture(), by_number, 1e-8, "sum");
    near(statistics.outcomes_by_mass()?.capture(), by_mass, 1e-8, "sum by mass");
    Ok(())
}

/// At one speed of spheres of one size the restitution has one value; moments of a spread have a closed form too.
#[test]
fn moments_of_the_restitution() -> Result<(), Failure> {
    let fixed = Distribution::fixed;
    let spheres = PowerLaw { factor: 1.0, power: 0.0 };
    let mut population =
        Population { diameter: fixed(1e-6)?, adhesion: fixed(1.0)?, angle: fixed(0.0)?, speed: fixed(2.0)? };
    let outcomes = Statistics::direct(&population, &spheres).outcomes()?;
    let moments = outcomes.restitution();
    assert!((moments.mean.value - 0.75_f64.sqrt()).abs() < 1e-15 && moments.variance.value < 1e-15);
    // The mean of e^2 = 1 - a^2 is that of the truncated log-normal adhesion.
    let s: f64 = 0.5;
    population.adhesion = Distribution::log_normal(1.0, s.exp())?;
    let outcomes = Statistics::direct(&population, &spheres).outcomes()?;
    let limit = 2.0_f64.ln() / s;
    let square = limit.below() - 0.25 * (2.0 * s * s).exp() * (limit - 2.0 * s).below();
    let moments = outcomes.restitution();
    near(outcomes.rebound(), limit.below(), 1e-8, "rebound");
    near(moments.variance, square - moments.mean.value.powi(2), 1e-8, "variance");
    assert!(moments.variance.error < 1e-5, "{moments:?}");
    let of_rebounds = outcomes.restitution_of_rebounds().ok_or("no rebounds")?;
    assert!((of_rebounds.mean.value * outcomes.rebound().value - moments.mean.value).abs() < 1e-12);
    Ok(())
}

/// A property of the spheres as it is drawn.
#[derive(Clone, Copy, Debug)]
enum Drawn {
    Fixed(f64),
    Normal(f64, f64),
    LogNormal(f64, f64),
}

impl Drawn {
    fn distribution(self, smallest: f64) -> Result<Distribution, population::DistributionError> {
        match self {
            Self::Fixed(value) => Distribution::fixed(value),
            Self::Normal(mean, deviation) => Distribution::normal_from(mean, deviation, smallest),
            Self::LogNormal(median, geometric) => Distribution::log_normal(median, geometric),
        }
    }

    fn draw(self, random: &mut StdRng, smallest: f64) -> f64 {
        let z: f64 = StandardNormal.sample(random);
        match self {
            Self::Fixed(value) => value,
            Self::Normal(mean, deviation) => {
                let value = mean + deviation * z;
                // An angle is less than a right one.
                if value < smallest || value > 0.499 * PI && smallest == 0.0 {
                    self.draw(random, smallest)
                } else {
                    value
                }
            }
            Self::LogNormal(median, geometric) => median * (geometric.ln() * z).exp(),
        }
    }
}

/// Fractions of the classes, and the mean of e, e^2 and e^3 of all impacts, of some draws.
fn monte_carlo(
    drawn: [Drawn; 4],
    smallest: [f64; 4],
    draws: u32,
    impact: impl Fn([f64; 4]) -> (Class, f64),
) -> [f64; 7] {
    let mut random = StdRng::seed_from_u64(7);
    let mut sums = [0.0; 7];
    for _ in 0..draws {
        let values = [0, 1, 2, 3].map(|index: usize| drawn[index].draw(&mut random, smallest[index]));
        let (class, e) = impact(values);
        let class = match class {
            Class::ReboundSliding => 0,
            Class::ReboundRolling => 1,
            Class::CapturedSliding => 2,
            Class::CapturedRolling | Class::CapturedResting => 3,
            Class::Undecided => continue,
        };
        sums[class] += 1.0;
        for power in 1..=3 {
            sums[3 + power as usize] += e.powi(power);
        }
    }
    sums.map(|sum| sum / f64::from(draws))
}

/// Compares with Monte Carlo within four standard errors of the draws and the stated error.
fn compare(outcomes: &Outcomes, expected: [f64; 7], draws: u32, what: &str) {
    let found = [
        outcomes.rebound_sliding(),
        outcomes.rebound_rolling(),
        outcomes.captured_sliding(),
        outcomes.captured_rolling(),
    ];
    let sum: f64 = found.iter().map(|one| one.value).sum();
    assert!((sum - 1.0).abs() < 1e-8, "{what}: {sum}");
    for (found, expected) in found.iter().zip(expected) {
        let noise = 4.0 * ((expected * (1.0 - expected)).max(1.0 / f64::from(draws)) / f64::from(draws)).sqrt();
        near(*found, expected, noise, what);
        assert!(found.error < 1e-4, "{what}: {found:?}");
    }
    let [.., first, second, third] = expected;
    let moments = outcomes.restitution();
    let variance = second - first * first;
    let noise = 4.0 * (variance / f64::from(draws)).sqrt();
    near(moments.mean, first, noise, what);
    near(moments.variance, variance, 2.0 * noise, what);
    if variance > 1e-4 {
        let skewness = (third - 3.0 * first * second + 2.0 * first.powi(3)) / variance.powf(1.5);
        near(moments.skewness, skewness, 6.0 * noise / variance.sqrt(), what);
    }
    assert!(moments.mean.error < 1e-4 && moments.variance.error < 1e-4, "{what}: {moments:?}");
}

/// Populations of the diameter, adhesion, angle of incidence and speed. All four vary in the last, which takes long.
fn populations(adhesion: f64, diameter: f64, speed: f64) -> Vec<[Drawn; 4]> {
    use Drawn::{Fixed, LogNormal, Normal};
    let (d, a, v) = (diameter, adhesion, speed);
    vec![
        [LogNormal(d, 1.3), Fixed(a), Fixed(0.0), LogNormal(v, 1.3)],
        [LogNormal(d, 1.5), LogNormal(a, 1.4), Fixed(0.5), LogNormal(v, 1.2)],
        [LogNormal(d, 1.2), Fixed(a), Normal(0.4, 0.2), Fixed(v)],
        [Fixed(d), Fixed(a), Normal(0.5, 0.3), LogNormal(v, 1.5)],
        [Fixed(d), LogNormal(a, 1.8), Fixed(0.8), Fixed(v)],
        [Normal(d, 0.1 * d), Normal(a, 0.3 * a), Normal(0.6, 0.1), Normal(v, 0.3 * v)],
    ]
}

fn population_of(drawn: [Drawn; 4], smallest: [f64; 4]) -> Result<Population, Failure> {
    let [diameter, adhesion, angle, speed] = drawn;
    Ok(Population {
        diameter: diameter.distribution(smallest[0])?,
        adhesion: adhesion.distribution(smallest[1])?,
        angle: angle.distribution(smallest[2])?.within(0.0, 0.499 * PI)?,
        speed: speed.distribution(smallest[3])?,
    })
}

const FRICTION: f64 = 0.15;

type Body = RigidBody<f64, SpeedRestitution<f64>, rigid::WorkOfAdhesion<f64>, Coulomb<f64>>;

fn body(diameter: f64, work: f64) -> Result<Body, InputError> {
    RigidBody::new(Sphere::solid(0.5 * diameter, 2600.0)?, SpeedRestitution::new(130.0)?)
        .with_work_of_adhesion(work)?
        .with_friction(FRICTION)
}

/// A million draws of each population with MICROIMPACT_EXHAUSTIVE.
#[test]
fn rigid_bodies_against_monte_carlo() -> Result<(), Failure> {
    let draws = repetitions(1_000_000, 100_000);
    let smallest = [1e-9, 2e-15, 0.0, 1e-3];
    for drawn in populations(2.22e-12, 1e-5, 1.9).into_iter().take(repetitions(6, 5) as usize) {
        let impact = |[diameter, work, angle, speed]: [f64; 4]| {
            let scene = body(diameter, work).unwrap();
            let motion = NormalMotion::new(speed * angle.cos()).unwrap().with_tangential(speed * angle.sin()).unwrap();
            (scene.classify(&motion).class(), scene.impact(&motion).normal.overall_restitution())
        };
        let expected = monte_carlo(drawn, smallest, draws as u32, impact);
        let (population, spheres) = (population_of(drawn, smallest)?, RigidBodies(body));
        let direct = Statistics::direct(&population, &spheres).outcomes()?;
        compare(&direct, expected, draws as u32, &format!("{drawn:?}"));
    }
    Ok(())
}

fn contact(diameter: f64, strength: f64) -> Result<Contact<f64, AnyLaw<f64>>, InputError> {
    let law = AnyLaw::ring(Stiffness::new(7.5e10)?, strength, 6.25)?.with_damping(10.5)?;
    Ok(Contact::new(Sphere::solid(0.5 * diameter, 2600.0)?, law))
}

/// A million draws of each population with MICROIMPACT_EXHAUSTIVE.
#[test]
fn simulations_against_monte_carlo() -> Result<(), Failure> {
    let draws = repetitions(1_000_000, 4_000);
    let smallest = [1e-9, 0.25, 0.0, 1e-3];
    let method = Adaptive::new(1e-9)?;
    let fast = Adaptive::new(1e-6)?;
    for drawn in populations(250.0, 1e-5, 1.9).into_iter().take(repetitions(6, 5) as usize) {
        let impact = |[diameter, strength, angle, speed]: [f64; 4]| {
            let scene = contact(diameter, strength).and_then(|scene| scene.with_friction(FRICTION)).unwrap();
            let motion = NormalMotion::new(speed * angle.cos()).unwrap().with_tangential(speed * angle.sin()).unwrap();
            let impact = scene.solve(&motion, &fast).unwrap();
            (impact.class().unwrap(), impact.normal.overall_restitution())
        };
        let expected = monte_carlo(drawn, smallest, draws as u32, impact);
        let population = population_of(drawn, smallest)?;
        let spheres = Simulations { scene: contact, friction: FRICTION, method };
        let statistics = Statistics::interpolated(&population, &spheres, &[])?;
        let outcomes = statistics.outcomes()?;
        compare(&outcomes, expected, draws as u32, &format!("{drawn:?}"));
    }
    Ok(())
}
