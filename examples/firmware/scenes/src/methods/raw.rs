//! The paper's equations B6 to B10 in time, as they are printed, without a peeling moment, by the classical Runge-Kutta
//! method of order 4 with a fixed step, in SI units.
//!
//! An event is met by a last step against its own variable (Henon 1982): the indentation at separation, the slip where
//! sliding ends.

use core::f64::consts::PI;
use core::hint::black_box;

use microimpact::Real;

use super::inputs::Inputs;
use super::{Amount, Contestant, Extent, Number, Reply, Task, Variant, Visitor, runge_kutta};

/// Name of the method.
pub const NAME: &str = "RK4 in time";

/// A motion that takes this many times the duration of Hertz's impact is given up.
const LONGEST: u32 = 64;

/// The equations, each force over the mass.
#[derive(Clone, Copy, Debug)]
pub struct Raw<T> {
    /// sqrt(r) K/m.
    elastic: T,
    /// 2 pi f0 sqrt(r)/m.
    adhesion: T,
    /// c_H and c_A, s/m.
    material_damping: T,
    adhesion_damping: T,
    friction: T,
    /// Duration of Hertz's impact, s.
    duration: T,
    approach: T,
    /// v_t and r w, m/s.
    surface: [T; 2],
    radius: T,
}

/// k^2/r^2 of a solid sphere.
const GYRATION_RATIO: f64 = 0.4;

impl<T: Real> Raw<T> {
    /// The equations of a solid sphere.
    pub fn new(inputs: &Inputs) -> Self {
        let number = T::constant;
        let (radius, approach) = (number(inputs.radius), number(inputs.approach));
        let stiffness = number(inputs.stiffness);
        // m/r^3 and m.
        let cubic = number(4.0 / 3.0 * PI) * number(inputs.density);
        let mass = cubic * radius * radius * radius;
        let root = radius.sqrt();
        let elastic = root / mass * stiffness;
        // B4: C = (m/(r^3 K sqrt(v)))^(2/5).
        let damping = (cubic / (stiffness * approach.sqrt())).two_fifths_power();
        // T = 2.943 delta/v, delta = (5 v^2/(4 sqrt(r) K/m))^(2/5).
        let peak = (number(1.25) * approach * approach / elastic).two_fifths_power();
        Self {
            elastic,
            adhesion: number(2.0 * PI * inputs.ring) * root / mass,
            material_damping: number(inputs.material_damping) * damping,
            adhesion_damping: number(inputs.ring_damping) * damping,
            friction: number(inputs.friction),
            duration: number(2.943_275_2) * peak / approach,
            approach,
            surface: [number(inputs.tangential), number(inputs.spin) * radius],
            radius,
        }
    }

    /// Rates of indentation and its speed (B6) and, where the state has them, of v_t and r w (B7 to B9) under a slip in
    /// `direction`, zero while the sphere rolls.
    #[inline]
    fn rates<const S: usize>(&self, state: [T; S], direction: T) -> [T; S] {
        let (depth, speed) = (state[0].max(T::ZERO), state[1]);
        let root = depth.sqrt();
        let hertz = self.elastic * depth * root;
        let lost = if speed < T::ZERO { self.adhesion_damping * speed } else { T::ZERO };
        let acceleration = self.adhesion * root * (T::ONE - lost) - hertz * (T::ONE + self.material_damping * speed);
        let mut rates = [T::ZERO; S];
        rates[0] = speed;
        rates[1] = acceleration;
        if let [_, _, tangential, peripheral] = rates.as_mut_slice() {
            let friction = direction * self.friction * hertz;
            *tangential = -friction;
            *peripheral = friction * T::constant(1.0 / GYRATION_RATIO);
        }
        rates
    }

    /// The state at separation, by `steps` in the duration of Hertz's impact: indentation, speed and, with four
    /// quantities, v_t and r w.
    pub fn solve<const S: usize>(&self, steps: u32) -> Option<[T; S]> {
        let mut state = [T::ZERO; S];
        state[1] = self.approach;
        let mut direction = T::ZERO;
        if let [_, _, tangential, peripheral] = state.as_mut_slice() {
            [*tangential, *peripheral] = self.surface;
            let slip = *tangential - *peripheral;
            direction = match slip {
                _ if slip > T::ZERO => T::ONE,
                _ if slip < T::ZERO => -T::ONE,
                _ => T::ZERO,
            };
        }
        let slip = |state: &[T; S], direction: T| match state.as_slice() {
            [_, _, tangential, peripheral] => (*tangential - *peripheral) * direction,
            _ => T::ZERO,
        };
        let step = self.duration / T::constant(f64::from(steps));
        for _ in 0..steps.saturating_mul(LONGEST) {
            let next = runge_kutta::step(|state| self.rates(state, direction), state, step);
            if direction != T::ZERO && slip(&next, direction) <= T::ZERO {
                let against = |state| {
                    let rates = self.rates(state, direction);
                    let pace = T::ONE / slip(&rates, direction);
                    rates.map(|rate| rate * pace)
                };
                state = runge_kutta::step(against, state, -slip(&state, direction));
                direction = T::ZERO;
                continue;
            }
            if state[1] < T::ZERO && next[0] <= T::ZERO {
                let against = |state: [T; S]| {
                    let rates = self.rates(state, direction);
                    let pace = T::ONE / rates[0];
                    rates.map(|rate| rate * pace)
                };
                let end = runge_kutta::step(against, state, -state[0]);
                return end.iter().all(|value| value.is_finite()).then_some(end);
            }
            state = next;
        }
        None
    }
}

/// The numbers of steps, along the normal and with friction.
pub fn visit<T: Number>(inputs: &Inputs, extent: Extent, visitor: &mut impl Visitor) {
    for steps in extent.steps(16) {
        let contestant =
            Contestant { task: Task::Normal, method: NAME, variant: Variant::Only, amount: Amount::Steps(steps) };
        let inputs = *inputs;
        visitor.visit::<T>(contestant, move || {
            let raw = Raw::<T>::new(black_box(&inputs));
            let [_, speed] = raw.solve(black_box(steps))?;
            Some(Reply::normal(-speed / raw.approach))
        });
        visitor.visit::<T>(Contestant { task: Task::Oblique, ..contestant }, move || {
            let raw = Raw::<T>::new(black_box(&inputs));
            let [_, speed, tangential, peripheral] = raw.solve(black_box(steps))?;
            let surface = Some([tangential, peripheral / raw.radius]);
            Some(Reply { restitution: -speed / raw.approach, surface })
        });
    }
}
