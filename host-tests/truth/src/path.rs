//! The motion from first contact to its end.

use crate::double::Double;
use crate::scene::Scene;
use crate::series::{ORDER, Series};

/// How an impact ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The sphere leaves the surface.
    Rebound,
    /// The surface holds the sphere.
    Capture,
}

/// The solution of a scene in SI units. Velocities, works, impulses and paths are those of a rebound at separation; of
/// a capture, those where the sphere first turns back or where the computation stopped.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    /// `None` where the steps did not suffice.
    pub outcome: Option<Outcome>,
    /// Whether the motion was followed to its end: of a capture, to its turning point or to the proof that it has none.
    pub complete: bool,
    /// Whether the sphere rolls at the end.
    pub rolls: bool,
    /// Steps of the series.
    pub steps: u32,
    /// Energy beyond what a rebound needs, over the initial kinetic energy; negative for a capture. If a barrier has to
    /// be passed on arrival, the smaller of both distances. Of a sphere that creeps to rest, the energy it has where
    /// that is proven, and of one that is held but was not followed to its end, what it has then. `None` where it is
    /// not known.
    pub margin: Option<Double>,
    /// e^2, zero for a capture.
    pub restitution_squared: Double,
    /// Peak indentation, m; `None` where there is none.
    pub peak: Option<Double>,
    /// Indentation where a captured sphere first turns back, m; `None` where there is none.
    pub turning: Option<Double>,
    /// Indentation of the stable equilibrium, m; `None` where nothing holds the sphere.
    pub equilibrium: Option<Double>,
    /// Time of the peak, s.
    pub peak_time: Option<Double>,
    /// Time at the end of the computed motion, s.
    pub time: Double,
    /// Time at which the slip ended, s; zero if there was none, `None` if it did not end.
    pub roll_time: Option<Double>,
    /// Impulse of the elastic force, N s.
    pub elastic_impulse: Double,
    /// The same up to the peak, N s.
    pub elastic_impulse_to_peak: Double,
    /// Impulse of adhesion on rebound with its damping, N s.
    pub adhesion_impulse: Double,
    /// Energy taken by the damping of the materials, J.
    pub material_work: Double,
    /// Energy taken by the damping of adhesion, J.
    pub adhesion_work: Double,
    /// V_t, m/s.
    pub velocity: Double,
    /// W, rad/s.
    pub spin: Double,
    /// Rotation during contact, rad.
    pub rotation: Double,
    /// Displacement of the centre along the surface, m.
    pub displacement: Double,
    /// How far the motion along the surface is from the other kind: change of the slip that friction could still have
    /// produced after the slip ended, over the initial slip; negative for the slip that remains. `None` where there was
    /// none.
    pub slip_margin: Option<Double>,
    /// h, damping of the materials for the unit of speed.
    pub material_group: f64,
    /// g, damping of adhesion for the unit of speed.
    pub adhesion_group: f64,
}

/// Local error of a step, over the size of the state.
const TOLERANCE: f64 = 1e-24;

/// The same where only a change of the solution is of interest, by no less than the rounding of f64.
const TOLERANCE_OF_CHANGES: f64 = 1e-20;

/// A scene in units of the length L and the speed U.
struct Dimensionless {
    /// L, m.
    length: f64,
    /// U, m/s.
    speed: f64,
    /// m, kg.
    mass: Double,
    /// r, m.
    radius: Double,
    /// A
    elastic: Double,
    /// B
    adhesion: Double,
    /// X
    force: Double,
    /// h
    material: Double,
    /// g
    ring: Double,
    /// Rate of the peeling moment at s = 1.
    peeling: Double,
    /// f
    friction: Double,
    /// kappa
    gyration: Double,
    /// Kinetic energy before, over m U^2.
    energy: Double,
    /// Coordinate of the barrier, zero without one.
    barrier: Double,
    /// Potential there; `None` where nothing holds the sphere.
    height: Option<Double>,
    /// Coordinate of the stable equilibrium.
    equilibrium: Double,
}

impl Dimensionless {
    fn new(numbers: &[Double; 13]) -> Self {
        let [radius, density, gyration, stiffness, strength, zeta_h, zeta_a, ..] = *numbers;
        let [.., friction, lambda, force, speed, _, _] = *numbers;
        let mass = Double::PI * 4.0 / 3.0 * radius * radius * radius * density;
        // C of B4, with m/r^3 = 4 pi rho/3.
        let unit = (Double::PI * 4.0 / 3.0 * density / (stiffness * speed.sqrt())).two_fifths_power();
        // Any L and U will do. These keep s and y near one.
        let (r, m, k, v) = (radius.to_f64(), mass.to_f64(), stiffness.to_f64(), speed.to_f64());
        let equilibrium = 2.0 * std::f64::consts::PI * strength.to_f64() / k;
        let pressed = if force.to_f64() < 0.0 { (-force.to_f64() / (r.sqrt() * k)).powf(2.0 / 3.0) } else { 0.0 };
        let length = (1.25 * m * v * v / (r.sqrt() * k)).powf(0.4) + 5.0 / 3.0 * equilibrium + 2.0 * pressed;
        let scale = (0.8 * r.sqrt() * k * length.powf(2.5) / m).sqrt().max(v);
        let inertia = mass * scale * scale;
        let root = (radius * length).sqrt();
        let (material, ring) = (zeta_h * unit * scale, zeta_a * unit * scale);
        let mut scene = Self {
            length,
            speed: scale,
            mass,
            radius,
            elastic: stiffness * length * length * root / inertia,
            adhesion: Double::PI * 2.0 * strength * root * length / inertia,
            force: force * length / inertia,
            material,
            ring,
            peeling: lambda * zeta_a * unit * root * length / (mass * gyration * radius * radius * scale),
            friction,
            gyration,
            energy: speed * speed * 0.5 / (Double::from(scale) * scale),
            barrier: Double::ZERO,
            height: None,
            equilibrium: Double::ZERO,
        };
        scene.find_well();
        scene
    }

    /// B s - A s^3 - X, the force into the surface over s.
    fn pull(&self, s: Double) -> Double {
        s * (self.adhesion - self.elastic * s * s) - self.force
    }

    /// (2/5) A s^5 - (2/3) B s^3 + X s^2
    fn potential(&self, s: Double) -> Double {
        let square = s * s;
        square * (self.force + s * (self.elastic * square * 0.4 - self.adhesion * 2.0 / 3.0))
    }

    /// Equilibrium and barrier: the roots of the pull.
    fn find_well(&mut self) {
        let strongest = (self.adhesion / (self.elastic * 3.0)).sqrt();
        if self.pull(strongest) <= Double::ZERO {
            return; // nothing holds the sphere
        }
        let mut high = strongest.max(Double::ONE);
        while self.pull(high) > Double::ZERO {
            high = high * 2.0;
        }
        self.equilibrium = self.bisected(strongest, high);
        if self.force > Double::ZERO {
            self.barrier = self.bisected(strongest, Double::ZERO);
        }
        self.height = Some(self.potential(self.barrier));
    }

    /// The root between a place with pull and one without.
    fn bisected(&self, mut pulls: Double, mut pushes: Double) -> Double {
        /// Halvings that leave nothing of 106 bits, even of a root some decades below the first place.
        const HALVINGS: u32 = 140;
        for _ in 0..HALVINGS {
            let middle = (pulls + pushes) * 0.5;
            if self.pull(middle) > Double::ZERO { pulls = middle } else { pushes = middle }
        }
        (pulls + pushes) * 0.5
    }

    /// Whether a sphere at s with a speed y towards the equilibrium gets there without turning or passing it.
    ///
    /// It stays below the line y = m (`equilibrium` - s) if on that line dy/dsigma <= -m y. With m the least damping
    /// between here and there this holds where 2 s Q(s) <= m^2, with `pull` = (`equilibrium` - s) Q.
    fn creeps(&self, s: Double, y: Double, rebound: bool) -> bool {
        /// More than the rounding of f64.
        const MARGIN: f64 = 1e-9;
        let (s, y, rest) = (s.to_f64(), y.to_f64(), self.equilibrium.to_f64());
        let (a, b) = (self.elastic.to_f64(), self.adhesion.to_f64());
        let ring = if rebound { self.ring.to_f64() } else { 0.0 };
        let damping = |s: f64| s * s * (self.material.to_f64() * a * s * s + ring * b);
        let (least, most) = (damping(s.min(rest)), s.max(rest));
        let way = rest - s;
        let steepness = most * (a * most * most + a * rest * most + (-self.force.to_f64() / rest).max(0.0));
        way * y > 0.0 && y.abs() <= least * way.abs() && 2.0 * steepness * (1.0 + MARGIN) < least * least
    }
}

/// Quantities that are integrated.
#[derive(Clone, Copy)]
enum Quantity {
    /// s
    Place,
    /// y
    Speed,
    /// tau
    Time,
    /// Elastic impulse.
    Elastic,
    /// Work of adhesion.
    Adhesion,
    /// Impulse of adhesion on rebound.
    Pull,
    /// t'
    Velocity,
    /// r theta'
    Peripheral,
    /// r theta
    Rotation,
    /// t
    Displacement,
}

use Quantity as Q;

const QUANTITIES: usize = 10;

/// How the contact point moves.
#[derive(Clone, Copy, PartialEq)]
enum Surface {
    Slides,
    Rolls,
}

struct Path<'a> {
    scene: &'a Dimensionless,
    state: [Double; QUANTITIES],
    series: Vec<Series>,
    rebound: bool,
    surface: Surface,
    /// Sign of the slip.
    sign: f64,
    /// Size of the velocities along the surface.
    lateral: f64,
    /// Local error of a step, over the size of the state.
    tolerance: f64,
    /// 1/(k + 1)
    reciprocals: [Double; ORDER],
    /// Length of the last step in sigma.
    step: Double,
}

/// What ends a step.
#[derive(Clone, Copy, PartialEq)]
enum Event {
    None,
    EndOfSlip,
    Peak,
    Separation,
    Turning,
}

/// Series that only serve others, after those of the quantities.
const HELPERS: usize = 3;
const SQUARE: usize = QUANTITIES;
const FOURTH: usize = QUANTITIES + 1;
const SQUARE_SPEED: usize = QUANTITIES + 2;

impl Path<'_> {
    fn value(&self, quantity: Quantity) -> Double {
        self.state[quantity as usize]
    }

    fn of(&self, quantity: Quantity) -> &Series {
        &self.series[quantity as usize]
    }

    /// The series from the state.
    fn expand(&mut self) {
        let scene = self.scene;
        for (series, value) in self.series.iter_mut().zip(&self.state) {
            series.set(0, *value);
        }
        let ring = if self.rebound { scene.ring * scene.adhesion } else { Double::ZERO };
        let material = scene.material * scene.elastic;
        let peels = scene.peeling > Double::ZERO;
        let slides = self.surface == Surface::Slides;
        let friction = scene.friction * self.sign;
        let (start, turned) = (self.value(Q::Velocity), self.value(Q::Peripheral));
        for k in 0..ORDER {
            let part = self.reciprocals[k];
            let place = self.of(Q::Place).get(k);
            let square = self.of(Q::Place).square(k);
            self.series[SQUARE].set(k, square);
            let fourth = self.series[SQUARE].square(k);
            self.series[FOURTH].set(k, fourth);
            let elastic = scene.elastic * fourth * 2.0;
            let attraction = scene.adhesion * square * 2.0;
            let product = |a: &Series, b: &Series, factor: Double| match factor > Double::ZERO {
                true => a.product(b, k),
                false => Double::ZERO,
            };
            let of_ring = product(&self.series[SQUARE], self.of(Q::Speed), ring);
            let of_material = product(&self.series[FOURTH], self.of(Q::Speed), material);
            self.series[SQUARE_SPEED].set(k, of_ring);
            let resistance = (ring * of_ring + material * of_material) * 2.0;
            let gain = attraction - elastic - scene.force * place * 2.0 - resistance;
            let adhesion_power = ring * product(&self.series[SQUARE_SPEED], self.of(Q::Speed), ring) * 2.0;
            let pull = if self.rebound { attraction - ring * of_ring * 2.0 } else { Double::ZERO };
            let peeling = scene.peeling * product(&self.series[SQUARE], self.of(Q::Peripheral), scene.peeling) * 2.0;
            let (velocity, peripheral) = if slides {
                let force = friction * elastic;
                (-force, force / scene.gyration - peeling)
            } else {
                let both = -(peeling * scene.gyration / (scene.gyration + Double::ONE));
                (both, both)
            };
            let (displacement, rotation) = if peels {
                let along = |quantity| self.of(Q::Place).product(self.of(quantity), k) * 2.0;
                (along(Q::Velocity), along(Q::Peripheral))
            } else if slides {
                // What friction takes from the velocity it adds to kappa times the peripheral velocity.
                let displacement = self.of(Q::Place).product(self.of(Q::Velocity), k) * 2.0;
                (displacement, turned * place * 2.0 + (start * place * 2.0 - displacement) / scene.gyration)
            } else {
                (place * start * 2.0, place * turned * 2.0)
            };
            let growth = [
                (Q::Place, self.of(Q::Speed).get(k)),
                (Q::Speed, gain),
                (Q::Time, place * 2.0),
                (Q::Elastic, elastic),
                (Q::Adhesion, adhesion_power),
                (Q::Pull, pull),
                (Q::Velocity, velocity),
                (Q::Peripheral, peripheral),
                (Q::Rotation, rotation),
                (Q::Displacement, displacement),
            ];
            for (quantity, value) in growth {
                self.series[quantity as usize].set(k + 1, value * part);
            }
        }
    }

    /// Length of the step whose last term is as small as the tolerance, from the radius of convergence that the last
    /// terms show.
    fn longest_step(&self) -> f64 {
        /// From first contact without adhesion only one in five coefficients differs from zero.
        const GAP: usize = 4;
        let state = self.value(Q::Place).abs().max(self.value(Q::Speed).abs()).to_f64();
        let mut step = f64::INFINITY;
        let mut limit = |series: &Series, size: f64| {
            for power in ORDER - GAP..=ORDER {
                let last = series.size(power);
                if last > 0.0 {
                    step = step.min((size / last).powf(1.0 / power as f64));
                }
            }
        };
        limit(self.of(Q::Place), state);
        limit(self.of(Q::Speed), state);
        if self.scene.peeling > Double::ZERO {
            limit(self.of(Q::Peripheral), self.lateral);
        }
        step * self.tolerance.powf(1.0 / ORDER as f64)
    }

    /// Goes on to the end of a step or the first event in it.
    fn advance(&mut self) -> Event {
        self.expand();
        let mut end = Double::from(self.longest_step());
        let mut event = Event::None;
        let slips = self.surface == Surface::Slides;
        let slip = slips.then(|| self.of(Q::Velocity).minus(self.of(Q::Peripheral)));
        let direction = if self.rebound { -1.0 } else { 1.0 };
        if let Some(place) = self.of(Q::Speed).first_change(direction, end) {
            (end, event) = (place, if self.rebound { Event::Turning } else { Event::Peak });
        }
        if self.rebound
            && let Some(place) = self.of(Q::Place).first_change(1.0, end)
        {
            (end, event) = (place, Event::Separation);
        }
        if let Some(place) = slip.and_then(|slip| slip.first_change(self.sign, end)) {
            (end, event) = (place, Event::EndOfSlip);
        }
        self.state = Series::all_at(&self.series, end);
        self.step = end;
        event
    }
}

/// The solution of a scene, in at most so many steps.
pub fn solve(scene: &Scene, most_steps: u32) -> Truth {
    solve_exactly(&scene.numbers().map(Double::from), most_steps)
}

/// The solution of a scene with one number, counted as in [`INPUTS`](crate::INPUTS), changed by a relative amount.
pub fn solve_changed(scene: &Scene, number: usize, change: f64, most_steps: u32) -> Truth {
    let mut numbers = scene.numbers().map(Double::from);
    numbers[number] = numbers[number] * (Double::ONE + Double::from(change));
    solve_to(TOLERANCE_OF_CHANGES, &numbers, most_steps)
}

/// The solution of a scene of numbers with 31 digits, in the order of [`INPUTS`](crate::INPUTS).
pub fn solve_exactly(numbers: &[Double; 13], most_steps: u32) -> Truth {
    solve_to(TOLERANCE, numbers, most_steps)
}

fn solve_to(tolerance: f64, numbers: &[Double; 13], most_steps: u32) -> Truth {
    let scene = &Dimensionless::new(numbers);
    let [.., approach, tangential, spin] = *numbers;
    let mut state = [Double::ZERO; QUANTITIES];
    state[Q::Speed as usize] = approach / scene.speed;
    state[Q::Velocity as usize] = tangential / scene.speed;
    state[Q::Peripheral as usize] = scene.radius * spin / scene.speed;
    let (velocity, peripheral) = (state[Q::Velocity as usize], state[Q::Peripheral as usize]);
    let first_slip = velocity - peripheral;
    let slips = first_slip != Double::ZERO;
    let mut path = Path {
        scene,
        state,
        series: vec![Series::ZERO; QUANTITIES + HELPERS],
        rebound: false,
        surface: if slips { Surface::Slides } else { Surface::Rolls },
        sign: first_slip.to_f64().signum(),
        lateral: velocity.abs().max(peripheral.abs()).to_f64(),
        tolerance,
        reciprocals: std::array::from_fn(|k| Double::ONE / (k as f64 + 1.0)),
        step: Double::ZERO,
    };
    let (mut peak, mut peak_time, mut turning) = (None, None, None);
    let mut impulse_to_peak = Double::ZERO;
    let mut roll = (!slips).then_some((Double::ZERO, Double::ZERO));
    let (mut outcome, mut complete, mut steps) = (None, false, 0);
    // Of a sphere that is held, the energy it lacks to escape.
    let mut lacking = Double::ZERO;
    let mut margins: Vec<Double> = Vec::new();
    let time_unit = Double::from(scene.length) / scene.speed;
    while steps < most_steps && !complete {
        let before = path.value(Q::Place);
        let event = path.advance();
        steps += 1;
        let (place, speed) = (path.value(Q::Place), path.value(Q::Speed));
        if let Some(height) = scene.height {
            let beyond = |place: Double| place > scene.barrier;
            if scene.barrier > Double::ZERO && beyond(before) != beyond(place) {
                let distance = path.of(Q::Place).minus(&Series::constant(scene.barrier));
                let y = path.of(Q::Speed).at(distance.root(if beyond(before) { 1.0 } else { -1.0 }, path.step));
                margins.push(y * y * 0.5);
            }
            let lacks = height - speed * speed * 0.5 - scene.potential(place);
            if lacks > Double::ZERO && place > scene.barrier {
                lacking = lacks;
                outcome = Some(Outcome::Capture);
                complete = event == Event::None && scene.creeps(place, speed, path.rebound);
                if complete {
                    margins.push(lacks);
                }
            }
        }
        match event {
            Event::None => {}
            Event::EndOfSlip => {
                path.surface = Surface::Rolls;
                path.state[Q::Peripheral as usize] = path.value(Q::Velocity);
                roll = Some((path.value(Q::Time), path.value(Q::Elastic)));
            }
            Event::Peak => {
                path.state[Q::Speed as usize] = Double::ZERO;
                path.rebound = true;
                impulse_to_peak = path.value(Q::Elastic);
                peak = Some(place * place * scene.length);
                peak_time = Some(path.value(Q::Time) * time_unit);
                if let Some(height) = scene.height
                    && place < scene.barrier
                {
                    margins.push(height - scene.potential(place));
                }
            }
            Event::Separation => {
                outcome = Some(Outcome::Rebound);
                complete = true;
                if scene.height.is_none() || scene.barrier == Double::ZERO {
                    margins.push(speed * speed * 0.5);
                }
            }
            Event::Turning => {
                outcome = Some(Outcome::Capture);
                complete = true;
                turning = Some(place * place * scene.length);
                margins.push(scene.height.unwrap_or(Double::ZERO) - scene.potential(place));
            }
        }
    }
    let (mass, speed) = (scene.mass, scene.speed);
    let energy_unit = mass * speed * speed;
    let rebounds = outcome == Some(Outcome::Rebound);
    if !complete && outcome == Some(Outcome::Capture) {
        margins.push(lacking);
    }
    let smallest = margins.into_iter().reduce(Double::min).filter(|_| outcome.is_some());
    let last = path.value(Q::Speed);
    // What the other works and the remaining energy leave.
    let remaining = last * last * 0.5 + scene.potential(path.value(Q::Place));
    let material_work = match scene.material > Double::ZERO {
        true => scene.energy - remaining - path.value(Q::Adhesion),
        false => Double::ZERO,
    };
    let capacity = |impulse: Double| scene.friction * impulse * (Double::ONE + Double::ONE / scene.gyration);
    let slip_margin = slips.then(|| match roll {
        Some((_, impulse)) => capacity(path.value(Q::Elastic) - impulse) / first_slip.abs(),
        None => -((path.value(Q::Velocity) - path.value(Q::Peripheral)) / first_slip).abs(),
    });
    Truth {
        outcome,
        complete,
        rolls: path.surface == Surface::Rolls,
        steps,
        margin: smallest.map(|margin| if rebounds { margin / scene.energy } else { -(margin / scene.energy) }),
        restitution_squared: if rebounds { last * last * 0.5 / scene.energy } else { Double::ZERO },
        peak,
        turning,
        equilibrium: scene.height.map(|_| scene.equilibrium * scene.equilibrium * scene.length),
        peak_time,
        time: path.value(Q::Time) * time_unit,
        roll_time: roll.map(|(time, _)| time * time_unit),
        elastic_impulse: path.value(Q::Elastic) * mass * speed,
        elastic_impulse_to_peak: impulse_to_peak * mass * speed,
        adhesion_impulse: path.value(Q::Pull) * mass * speed,
        material_work: material_work * energy_unit,
        adhesion_work: path.value(Q::Adhesion) * energy_unit,
        velocity: path.value(Q::Velocity) * speed,
        spin: path.value(Q::Peripheral) * speed / scene.radius,
        rotation: path.value(Q::Rotation) * scene.length / scene.radius,
        displacement: path.value(Q::Displacement) * scene.length,
        slip_margin,
        material_group: scene.material.to_f64(),
        adhesion_group: scene.ring.to_f64(),
    }
}
