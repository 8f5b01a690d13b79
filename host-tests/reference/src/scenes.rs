//! Random scenes of all physics of the simulation, from mild ones to corners. Where a scene does not say otherwise, its
//! numbers are ones of single precision, so that f32 and f64 solve the very same scene.

use std::f64::consts::PI;

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use truth::{Double, Outcome, Scene, solve};

/// What a random scene is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Damping h and g from 1e-4 to 1, adhesion q from 1e-3 to 5.
    Mild,
    /// h and g from 0.1 to 100.
    Damped,
    /// A force into the surface, 1e-4 to 2 times the largest force of Hertz's impact.
    ForceInwards,
    /// The same out of the surface.
    ForceOutwards,
    /// A force near the largest that adhesion holds, nearer by up to 1e-7 of it.
    LargestTension,
    /// The sphere's own weight, into or out of the surface.
    Weight,
    /// A peeling moment from weak to strong, on spinning spheres.
    Peeling,
    /// Hollow spheres, with any gyration ratio from 0.4 to 2/3.
    Hollow,
    /// Slip that ends near the peak, nearer by up to 1e-7 of the velocity.
    SlipToPeak,
    /// Slip that ends near separation, nearer by up to 1e-7 of the velocity.
    SlipToSeparation,
    /// Speeds near the critical speed, nearer by up to 1e-10 of it. Those within 1e-7 are ones of double precision.
    Critical,
    /// An outward force, and an energy near that of its barrier, nearer by up to 1e-6 of the speed.
    Barrier,
    /// Slow captures, damped near where a sphere begins to creep to its equilibrium without turning.
    Equilibrium,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 13] = [
        Self::Mild,
        Self::Damped,
        Self::ForceInwards,
        Self::ForceOutwards,
        Self::LargestTension,
        Self::Weight,
        Self::Peeling,
        Self::Hollow,
        Self::SlipToPeak,
        Self::SlipToSeparation,
        Self::Critical,
        Self::Barrier,
        Self::Equilibrium,
    ];

    /// In tables and arguments.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mild => "mild",
            Self::Damped => "damped",
            Self::ForceInwards => "force-inwards",
            Self::ForceOutwards => "force-outwards",
            Self::LargestTension => "largest-tension",
            Self::Weight => "weight",
            Self::Peeling => "peeling",
            Self::Hollow => "hollow",
            Self::SlipToPeak => "slip-to-peak",
            Self::SlipToSeparation => "slip-to-separation",
            Self::Critical => "critical",
            Self::Barrier => "barrier",
            Self::Equilibrium => "equilibrium",
        }
    }

    /// The random scene with a number.
    pub fn scene(self, seed: u64, number: u64) -> Scene {
        /// Odd constants that keep the streams of seeds, kinds and numbers apart.
        const MIXERS: [u64; 2] = [0x9e37_79b9_7f4a_7c15, 0xbf58_476d_1ce4_e5b9];
        let stream = seed.wrapping_mul(MIXERS[0]) ^ (self as u64 + 1).wrapping_mul(MIXERS[1]);
        let mut draw = Draw { random: StdRng::seed_from_u64(stream.wrapping_add(number)) };
        match self {
            Self::Mild => draw.impact(MILD, ADHESION),
            Self::Damped => draw.impact(STRONG, ADHESION),
            Self::ForceInwards | Self::ForceOutwards => draw.forced(self == Self::ForceOutwards),
            Self::LargestTension => draw.near_largest_tension(),
            Self::Weight => draw.weighed(),
            Self::Peeling => draw.peeling(),
            Self::Hollow => {
                let scene = draw.impact(MILD, ADHESION);
                Scene { gyration_ratio: draw.random.random_range(SOLID..THIN_SHELL), ..scene }.in_single_precision()
            }
            Self::SlipToPeak | Self::SlipToSeparation => draw.slip(self == Self::SlipToPeak),
            Self::Critical => draw.near_critical(),
            Self::Barrier => draw.near_barrier(),
            Self::Equilibrium => draw.near_equilibrium(),
        }
    }
}

/// Decades of the groups h and g.
const MILD: (f64, f64) = (-4.0, 0.0);
const STRONG: (f64, f64) = (-1.0, 2.0);

/// Decades of q, equilibrium indentation over the peak of Hertz's impact.
const ADHESION: (f64, f64) = (-3.0, 0.7);

/// kappa
const SOLID: f64 = 0.4;
const THIN_SHELL: f64 = 2.0 / 3.0;

/// m/s^2
const GRAVITY: f64 = 9.81;

/// Fraction of the scenes that lack a term.
const ABSENT: f64 = 0.12;

/// Steps of the truth that scenes may take which are made from a solution.
pub const STEPS: u32 = 300;

struct Draw {
    random: StdRng,
}

impl Draw {
    fn decades(&mut self, (low, high): (f64, f64)) -> f64 {
        10_f64.powf(self.random.random_range(low..high))
    }

    fn or_zero(&mut self, decades: (f64, f64)) -> f64 {
        let value = self.decades(decades);
        if self.random.random_bool(ABSENT) { 0.0 } else { value }
    }

    fn sign(&mut self) -> f64 {
        if self.random.random_bool(0.5) { 1.0 } else { -1.0 }
    }

    /// 1 +- 10^-k with k in a range.
    fn near_one(&mut self, decades: (f64, f64)) -> f64 {
        1.0 + self.sign() * self.decades((-decades.1, -decades.0))
    }

    /// An impact with groups h and g, and a ratio q, drawn from decades.
    fn impact(&mut self, damping: (f64, f64), adhesion: (f64, f64)) -> Scene {
        let [radius, density, stiffness, speed] =
            [(-7.0, -3.0), (2.0, 4.3), (5.0, 12.0), (-4.0, 3.0)].map(|range| self.decades(range));
        let (h, g, q) = (self.or_zero(damping), self.or_zero(damping), self.or_zero(adhesion));
        let friction = self.or_zero((-2.0, 0.3));
        let along = speed * self.sign() * self.or_zero((-2.0, 1.0));
        let around = if self.random.random_bool(0.5) { 0.0 } else { speed * self.sign() * self.or_zero((-2.0, 1.0)) };
        let mut scene = Scene {
            radius,
            density,
            gyration_ratio: SOLID,
            stiffness,
            adhesion: 0.0,
            material_damping: 0.0,
            adhesion_damping: 0.0,
            friction,
            peeling: 0.0,
            force: 0.0,
            speed,
            tangential: along,
            spin: around / radius,
        };
        let unit = damping_unit(&scene) * speed;
        scene.adhesion = q * hertz_depth(&scene) * stiffness / (2.0 * PI);
        scene.material_damping = h / unit;
        scene.adhesion_damping = g / unit;
        scene.in_single_precision()
    }

    /// Three of four mildly damped.
    fn any_damping(&mut self) -> (f64, f64) {
        if self.random.random_bool(0.75) { MILD } else { STRONG }
    }

    fn forced(&mut self, outwards: bool) -> Scene {
        let damping = self.any_damping();
        let scene = self.impact(damping, ADHESION);
        let largest = scene.radius.sqrt() * scene.stiffness * hertz_depth(&scene).powf(1.5);
        let force = largest * self.decades((-4.0, 0.3));
        Scene { force: if outwards { force } else { -force }, ..scene }.in_single_precision()
    }

    fn near_largest_tension(&mut self) -> Scene {
        let damping = self.any_damping();
        let scene = self.with_adhesion(damping, (-1.0, 0.7));
        let edge = (scene.radius * equilibrium(&scene)).sqrt();
        let tension = 2.0 * PI * scene.adhesion * edge * 2.0 / 27_f64.sqrt();
        Scene { force: tension * self.near_one((0.5, 7.0)), ..scene }.in_single_precision()
    }

    /// An impact with adhesion.
    fn with_adhesion(&mut self, damping: (f64, f64), adhesion: (f64, f64)) -> Scene {
        loop {
            let scene = self.impact(damping, adhesion);
            if scene.adhesion > 0.0 {
                return scene;
            }
        }
    }

    fn weighed(&mut self) -> Scene {
        let damping = self.any_damping();
        let scene = self.impact(damping, ADHESION);
        let slow = Scene {
            radius: self.decades((-5.0, -2.5)),
            stiffness: self.decades((5.0, 9.0)),
            speed: self.decades((-5.0, -1.0)),
            tangential: 0.0,
            spin: 0.0,
            ..scene
        };
        // The groups stay those of the scene that was drawn.
        let same = damping_unit(&scene) * scene.speed / (damping_unit(&slow) * slow.speed);
        let along = scene.tangential / scene.speed * slow.speed;
        Scene {
            force: self.sign() * GRAVITY * mass(&slow),
            adhesion: equilibrium(&scene) / hertz_depth(&scene) * hertz_depth(&slow) * slow.stiffness / (2.0 * PI),
            material_damping: scene.material_damping * same,
            adhesion_damping: scene.adhesion_damping * same,
            tangential: along,
            ..slow
        }
        .in_single_precision()
    }

    fn peeling(&mut self) -> Scene {
        let scene = loop {
            let scene = self.with_adhesion(MILD, ADHESION);
            if scene.adhesion_damping > 0.0 {
                break scene;
            }
        };
        let depth = hertz_depth(&scene) + equilibrium(&scene);
        let inertia = scene.gyration_ratio * mass(&scene) * scene.radius * scene.radius;
        let decay = scene.adhesion_damping * damping_unit(&scene) * (scene.radius * depth).sqrt() / inertia;
        let peeling = self.decades((-3.0, 1.5)) / (decay * depth / scene.speed);
        let spin = scene.speed / scene.radius * self.sign() * self.decades((-2.0, 1.5));
        Scene { peeling, spin, ..scene }.in_single_precision()
    }

    /// Slip that friction ends near the peak, or near separation.
    fn slip(&mut self, at_peak: bool) -> Scene {
        loop {
            let scene = Scene { spin: 0.0, tangential: 0.0, ..self.impact(MILD, ADHESION) };
            let truth = solve(&scene, STEPS);
            if scene.friction == 0.0 || !truth.complete || (!at_peak && truth.outcome != Some(Outcome::Rebound)) {
                continue;
            }
            let impulse = if at_peak { truth.elastic_impulse_to_peak } else { truth.elastic_impulse };
            let stopped = scene.friction * impulse.to_f64() / mass(&scene) * (1.0 + 1.0 / scene.gyration_ratio);
            return Scene { tangential: stopped * self.near_one((1.0, 7.0)), ..scene }.in_single_precision();
        }
    }

    fn near_critical(&mut self) -> Scene {
        /// Beyond it a relative distance is lost in single precision.
        const SINGLE: f64 = 1e-7;
        loop {
            let damping = self.any_damping();
            let scene = self.with_adhesion(damping, (-2.0, 1.0));
            let factor = self.near_one((2.0, 10.0));
            if let Some(critical) = critical_speed(&scene) {
                let scene = Scene { speed: critical * factor, ..scene };
                return if (factor - 1.0).abs() > SINGLE { scene.in_single_precision() } else { scene };
            }
        }
    }

    /// An outward force up to the largest tension, and a speed at which the sphere just passes the barrier.
    fn near_barrier(&mut self) -> Scene {
        let damping = self.any_damping();
        let scene = self.with_adhesion(damping, (-1.0, 2.0));
        let root = scene.radius.sqrt();
        let (elastic, ring) = (root * scene.stiffness, 2.0 * PI * scene.adhesion * root);
        let strongest = (ring / (3.0 * elastic)).sqrt();
        let force = ring * strongest * 2.0 / 3.0 * self.decades((-3.0, -0.01));
        let (mut low, mut high) = (0.0, strongest);
        // Halvings of an f64.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if ring * middle - elastic * middle.powi(3) < force { low = middle } else { high = middle }
        }
        let height = low * low * (force + low * (0.4 * elastic * low * low - 2.0 / 3.0 * ring));
        let speed = (2.0 * height / mass(&scene)).sqrt() * self.near_one((0.5, 6.0));
        Scene { force, speed, tangential: scene.tangential / scene.speed * speed, ..scene }.in_single_precision()
    }

    /// Damping near 4 k m, with k the stiffness at the equilibrium.
    fn near_equilibrium(&mut self) -> Scene {
        let scene = loop {
            let scene = self.with_adhesion(MILD, (0.0, 4.0));
            if scene.material_damping + scene.adhesion_damping > 0.0 {
                break scene;
            }
        };
        let depth = equilibrium(&scene);
        let unit = scene.radius.sqrt() * scene.stiffness * depth.sqrt();
        let critical = 2.0 * (unit * mass(&scene)).sqrt() / (unit * depth * damping_unit(&scene));
        let factor = critical * self.near_one((0.0, 6.0)) / (scene.material_damping + scene.adhesion_damping);
        Scene {
            material_damping: scene.material_damping * factor,
            adhesion_damping: scene.adhesion_damping * factor,
            ..scene
        }
        .in_single_precision()
    }
}

/// The speed between capture and rebound, to rounding; `None` where the truth finds none near the speed of the scene.
pub fn critical_speed(scene: &Scene) -> Option<f64> {
    /// How far from the speed of the scene to look.
    const DECADES: f64 = 1e3;
    /// Halvings of the logarithm after which the secant converges: the speeds then differ by a tenth.
    const HALVINGS: u32 = 7;
    let at = |speed: f64| Some((speed, speed_margin(scene, speed)?));
    let (mut captured, mut rebounds) = (at(scene.speed / DECADES)?, at(scene.speed * DECADES)?);
    if captured.1 > 0.0 || rebounds.1 < 0.0 {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = at((captured.0 * rebounds.0).sqrt())?;
        if middle.1 > 0.0 { rebounds = middle } else { captured = middle }
    }
    speed_without_margin(scene, captured.0, rebounds.0)
}

/// The same close to a speed; `None` where there is none as close as a hundredth. Where a force makes a barrier, a sphere that hardly
/// comes over it may be captured at a few speeds only.
pub fn critical_speed_near(scene: &Scene, speed: f64) -> Option<f64> {
    /// Relative distance of two speeds that tell how the energy left grows.
    const APART: f64 = 1e-8;
    /// Relative distance that is no more close.
    const FAR: f64 = 0.01;
    let found = speed_without_margin(scene, speed * (1.0 - APART), speed * (1.0 + APART))?;
    let captured = speed_margin(scene, found * (1.0 - APART))? < 0.0;
    (captured && (found / speed - 1.0).abs() < FAR).then_some(found)
}

/// Energy left at a speed, over the initial energy.
fn speed_margin(scene: &Scene, speed: f64) -> Option<f64> {
    let truth = solve(&Scene { speed, friction: 0.0, tangential: 0.0, spin: 0.0, peeling: 0.0, ..*scene }, STEPS);
    truth.margin.filter(|_| truth.complete).map(Double::to_f64)
}

/// The speed at which no energy is left, which is a smooth function of the speed: by secants from two speeds.
fn speed_without_margin(scene: &Scene, first: f64, second: f64) -> Option<f64> {
    const SECANTS: u32 = 20;
    let (mut before, mut last) = ((first, speed_margin(scene, first)?), (second, speed_margin(scene, second)?));
    for _ in 0..SECANTS {
        let next = last.0 - last.1 * (last.0 - before.0) / (last.1 - before.1);
        if (next / last.0 - 1.0).abs() <= f64::EPSILON {
            return Some(next);
        }
        if !(0.5 * first..2.0 * second).contains(&next) {
            return None;
        }
        (before, last) = (last, (next, speed_margin(scene, next)?));
    }
    None
}

/// Mass, kg.
pub fn mass(scene: &Scene) -> f64 {
    4.0 / 3.0 * PI * scene.radius.powi(3) * scene.density
}

/// C of B4, s/m.
pub fn damping_unit(scene: &Scene) -> f64 {
    (4.0 / 3.0 * PI * scene.density / (scene.stiffness * scene.speed.sqrt())).powf(0.4)
}

/// Peak indentation of Hertz's impact, m.
pub fn hertz_depth(scene: &Scene) -> f64 {
    (1.25 * mass(scene) * scene.speed * scene.speed / (scene.radius.sqrt() * scene.stiffness)).powf(0.4)
}

/// Indentation at which the sphere can rest, m.
pub fn equilibrium(scene: &Scene) -> f64 {
    2.0 * PI * scene.adhesion / scene.stiffness
}
