//! Motion along the surface and spin during contact: sliding under Coulomb's friction, then rolling (B7 to B10).
//!
//! The normal motion does not depend on them, so they follow from integrals over its intervals. In units of the scene the
//! tangential velocity v and the peripheral velocity u = r theta' obey, with the elastic force F and the slip v - u,
//!
//! v' = -f F sgn(v - u),   kappa u' = f F sgn(v - u) - kappa q s u
//!
//! while sliding; q is the peeling rate. Rolling, v = u = v0 exp(-kappa/(1 + kappa) * integral of q s).

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::relaxation::{SLOW, relaxed};
use super::{PressingForce, SlipStart};
use crate::Real;
use crate::contact::law::ContactLaw;
use crate::contact::solve::interval::{Interval, dot, integrals, unresolved};
use crate::contact::solve::nodes::Nodes;
use crate::contact::solve::observer::Observer;
use crate::contact::solve::quantities::Times;
use crate::rolling::{direction, rolling, rounding};

/// Slip at the root over the slip before, and least distance of the root from the ends of an interval: only a first value.
const SLIP_ROOT_ACCURACY: f64 = 1e-6;

/// Decay over an interval beyond which the nodes may miss it,
const FAST: f64 = 6.0;

/// estimated error over the unresolved part where the decay is not slow,
const FAST_ERROR: f64 = 2e-3;

/// and over its square where it is.
const SLOW_ERROR: f64 = 0.25;

/// Steps of Newton's method on the cubic between two nodes,
const CUBIC_STEPS: u32 = 4;

/// and on the polynomial through all nodes.
const POLYNOMIAL_STEPS: u32 = 20;

/// The tangential motion so far, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentialMotion<T, P, const PEELS: bool> {
    pub(crate) friction: T,
    pressing: P,
    pub(crate) gyration_ratio: T,
    /// Rate q at which the peeling moment slows the spin at contact radius 1; zero where nothing `PEELS`.
    peeling: T,
    pub(crate) velocity: T,
    pub(crate) peripheral: T,
    pub(crate) displacement: T,
    /// Rotation angle times radius.
    pub(crate) rotation: T,
    /// Energies that friction and the peeling moment have taken, in units of the next.
    pub(crate) friction_loss: T,
    pub(crate) peeling_loss: T,
    /// A velocity whose square times the mass is the unit of energies: one or, where that is larger, the largest before contact, so that
    /// no square is too large.
    pub(crate) energy_speed: T,
    /// Largest velocity before contact.
    scale: T,
    /// Sign of the slip, zero when rolling.
    pub(crate) direction: T,
    now: T,
    pub(crate) rolls_from: Option<T>,
    /// Speed below which rolling is nothing but rounding.
    pub(super) rounding: T,
}

/// Velocities at the nodes of an interval and at its end in time.
struct Slide<T, const N: usize> {
    velocity: [T; N],
    peripheral: [T; N],
    velocity_after: T,
    peripheral_after: T,
}

impl<T: Real, P: PressingForce<T>, const PEELS: bool> TangentialMotion<T, P, PEELS> {
    pub(crate) fn new(start: &SlipStart<T, P, PEELS>) -> Self {
        let SlipStart { friction, pressing, gyration_ratio, velocity, peripheral, peeling } = *start;
        // Of the velocities in these units: their rounding may leave nothing of a slip in SI units.
        let direction = direction(velocity - peripheral);
        let scale = velocity.abs().max(peripheral.abs());
        Self {
            friction,
            pressing,
            gyration_ratio,
            peeling,
            velocity,
            peripheral,
            displacement: T::ZERO,
            rotation: T::ZERO,
            friction_loss: T::ZERO,
            peeling_loss: T::ZERO,
            energy_speed: scale.max(T::ONE),
            scale,
            direction,
            now: T::ZERO,
            rolls_from: (direction == T::ZERO).then_some(T::ZERO),
            rounding: rounding(velocity, peripheral, gyration_ratio),
        }
    }

    pub(crate) fn slides(&self) -> bool {
        self.direction != T::ZERO
    }

    /// Kinetic energy along the surface and of the spin.
    pub(crate) fn energy(&self) -> T {
        let (v, u) = (self.velocity / self.energy_speed, self.peripheral / self.energy_speed);
        T::constant(0.5) * (v * v + self.gyration_ratio * u * u)
    }

    /// Energy that the peeling moment takes over an interval, from the peripheral velocities at the nodes.
    fn peeled<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, peripheral: &[T; N]) -> T
    where
        T: Nodes<N>,
    {
        let mut peeled = T::ZERO;
        for j in 0..N {
            let u = peripheral[j] / self.energy_speed;
            peeled = peeled + T::WEIGHTS[j] * interval.rate[j] * law.contact_radius(interval.s[j]) * u * u;
        }
        self.gyration_ratio * self.peeling * peeled
    }

    /// The sphere rolls from here on; it began `before` this moment.
    pub(crate) fn roll(&mut self, before: T) {
        self.direction = T::ZERO;
        self.rolls_from = Some(self.now + before);
        self.velocity = rolling(self.velocity, self.peripheral, self.gyration_ratio);
        self.peripheral = self.velocity;
    }

    /// The distance that the sphere rolls in a time, without a peeling moment.
    fn pass_rolling(&mut self, duration: T) {
        let distance = duration * self.velocity;
        self.now = self.now + duration;
        self.displacement = self.displacement + distance;
        self.rotation = self.rotation + distance;
    }

    /// By how much an impulse changes the slip.
    #[inline]
    fn closing(&self) -> T {
        self.friction * (T::ONE + T::ONE / self.gyration_ratio)
    }

    /// Slip after an interval of sliding in its first direction, without a peeling moment.
    fn slip_after<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> T
    where
        T: Nodes<N>,
    {
        let mut impulse = T::ZERO;
        for j in 0..N {
            impulse = impulse + T::WEIGHTS[j] * self.pressing.at(law, interval.s[j]) * interval.rate[j];
        }
        self.slip_left() - self.closing() * impulse
    }

    /// Slip in its first direction.
    fn slip_left(&self) -> T {
        (self.velocity - self.peripheral) * self.direction
    }

    /// Integrals up to each node in the order of time, and the whole.
    fn running<const N: usize>(f: &[T; N], forward: bool) -> ([T; N], T)
    where
        T: Nodes<N>,
    {
        let mut running = integrals(&T::INTEGRATION, f);
        let whole = running[N - 1];
        if !forward {
            running = running.map(|part| whole - part);
        }
        (running, whole)
    }

    /// The motion over an interval while the sphere slides.
    fn slide<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> Slide<T, N>
    where
        T: Nodes<N>,
    {
        let force = self.direction * self.friction;
        let mut elastic = [T::ZERO; N];
        for j in 0..N {
            elastic[j] = self.pressing.at(law, interval.s[j]) * interval.rate[j];
        }
        let (impulse, whole) = Self::running(&elastic, interval.forward);
        let turn = force / self.gyration_ratio;
        let velocity = impulse.map(|impulse| self.velocity - force * impulse);
        let velocity_after = self.velocity - force * whole;
        if !PEELS {
            let peripheral = impulse.map(|impulse| self.peripheral + turn * impulse);
            return Slide { velocity, peripheral, velocity_after, peripheral_after: self.peripheral + turn * whole };
        }
        let (decay, whole_decay) = self.decay(law, interval, T::ONE);
        if whole_decay > T::constant(SLOW) {
            let drive = elastic.map(|elastic| turn * elastic);
            let (peripheral, peripheral_after) =
                relaxed(self.peripheral, &drive, &self.decay_rates(law, interval, T::ONE), interval.forward);
            return Slide { velocity, peripheral, velocity_after, peripheral_after };
        }
        // Variation of constants: u = exp(-G) (u0 + turn * integral of exp(G) F).
        for j in 0..N {
            elastic[j] = elastic[j] * decay[j].exp();
        }
        let (driven, whole_driven) = Self::running(&elastic, interval.forward);
        let mut peripheral = [T::ZERO; N];
        for j in 0..N {
            peripheral[j] = (-decay[j]).exp() * (self.peripheral + turn * driven[j]);
        }
        let peripheral_after = (-whole_decay).exp() * (self.peripheral + turn * whole_driven);
        Slide { velocity, peripheral, velocity_after, peripheral_after }
    }

    /// Part of the peeling rate that slows a rolling sphere.
    #[inline]
    fn rolling_fraction(&self) -> T {
        self.gyration_ratio / (T::ONE + self.gyration_ratio)
    }

    /// Velocities over an interval, and after it, of a rolling sphere that the peeling moment slows.
    fn slowed<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> ([T; N], T)
    where
        T: Nodes<N>,
    {
        let fraction = self.rolling_fraction();
        let (decay, whole_decay) = self.decay(law, interval, fraction);
        if whole_decay > T::constant(SLOW) {
            let rates = self.decay_rates(law, interval, fraction);
            return relaxed(self.velocity, &[T::ZERO; N], &rates, interval.forward);
        }
        let left = |decay: T| self.velocity * (-decay).exp();
        (decay.map(left), left(whole_decay))
    }

    /// A fraction of the peeling rate, along the interval.
    fn decay_rates<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, fraction: T) -> [T; N] {
        let rate = fraction * self.peeling;
        let mut decay = [T::ZERO; N];
        for j in 0..N {
            decay[j] = rate * law.contact_radius(interval.s[j]) * interval.rate[j];
        }
        decay
    }

    /// Integral G of a fraction of the peeling rate.
    fn decay<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, fraction: T) -> ([T; N], T)
    where
        T: Nodes<N>,
    {
        Self::running(&self.decay_rates(law, interval, fraction), interval.forward)
    }
}

impl<T: Real, P: PressingForce<T>, const PEELS: bool> Observer<T> for TangentialMotion<T, P, PEELS> {
    const EVENTS: bool = true;
    const TIMED: bool = true;
    // A moment can slow the spin faster than the normal motion changes.
    const DEMANDS: bool = PEELS;

    #[inline]
    fn kink(&self) -> Option<T> {
        // Rolling, nothing depends on it.
        self.pressing.kink().filter(|_| self.slides())
    }

    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
        let duration = dot(&T::WEIGHTS, &interval.rate);
        if !self.slides() && !PEELS {
            return self.pass_rolling(duration);
        }
        self.now = self.now + duration;
        if self.slides() {
            let slide = self.slide(law, interval);
            for j in 0..N {
                let moment = T::WEIGHTS[j] * interval.rate[j];
                self.displacement = self.displacement + moment * slide.velocity[j];
                self.rotation = self.rotation + moment * slide.peripheral[j];
            }
            let energy = self.energy();
            let peeled = if PEELS { self.peeled(law, interval, &slide.peripheral) } else { T::ZERO };
            self.velocity = slide.velocity_after;
            self.peripheral = slide.peripheral_after;
            self.peeling_loss = self.peeling_loss + peeled;
            self.friction_loss = self.friction_loss + (energy - self.energy() - peeled);
            return;
        }
        let (velocity, after) = self.slowed(law, interval);
        let mut distance = T::ZERO;
        for j in 0..N {
            distance = distance + T::WEIGHTS[j] * interval.rate[j] * velocity[j];
        }
        let energy = self.energy();
        self.velocity = after;
        self.peripheral = self.velocity;
        // Rolling, friction only passes the moment on.
        self.peeling_loss = self.peeling_loss + (energy - self.energy());
        self.displacement = self.displacement + distance;
        self.rotation = self.rotation + distance;
    }

    fn error<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>, _allowed: T) -> T
    where
        T: Nodes<N>,
    {
        if !PEELS {
            return T::ZERO;
        }
        let peripheral =
            if self.slides() { self.slide(law, interval).peripheral } else { self.slowed(law, interval).0 };
        let fraction = if self.slides() { T::ONE } else { self.rolling_fraction() };
        let decay = self.decay(law, interval, fraction).1;
        let mut turned = peripheral;
        for j in 0..N {
            turned[j] = turned[j] * interval.rate[j];
        }
        let tail = unresolved(&turned) / (self.scale * dot(&T::WEIGHTS, &interval.rate) + T::SMALLEST);
        if decay > T::constant(FAST) {
            // What decays before the first node does not show in the tail.
            let first = if interval.forward { peripheral[0] } else { peripheral[N - 2] };
            let missed = (self.peripheral - first).abs();
            T::constant(FAST_ERROR) * tail.max(missed / (self.scale + T::SMALLEST))
        } else if decay > T::constant(SLOW) {
            T::constant(FAST_ERROR) * tail
        } else {
            T::constant(SLOW_ERROR) * tail * tail
        }
    }

    fn rolls_at<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        if !self.slides() || (!PEELS && self.slip_after(law, interval) > T::ZERO) {
            return None;
        }
        let slide = self.slide(law, interval);
        let slip_after = (slide.velocity_after - slide.peripheral_after) * self.direction;
        let (mut slip, mut slope) = ([T::ZERO; N], [T::ZERO; N]);
        let closing = if interval.forward { -self.closing() } else { self.closing() };
        for j in 0..N {
            slip[j] = (slide.velocity[j] - slide.peripheral[j]) * self.direction;
            slope[j] = closing * self.pressing.at(law, interval.s[j]) * interval.rate[j];
        }
        // A moment that outlasts friction opens the slip again: what counts is its first end.
        if slip_after > T::ZERO && !(PEELS && slip.iter().any(|slip| *slip <= T::ZERO)) {
            return None;
        }
        let least = T::constant(SLIP_ROOT_ACCURACY);
        if self.slip_left() <= T::ZERO {
            // It ended in the interval before, by less than rounding.
            return Some(least);
        }
        let ends = if interval.forward { (self.slip_left(), slip_after) } else { (slip_after, self.slip_left()) };
        let z = first_root(&slip, &slope, ends, interval.forward, least * self.slip_left());
        let z = z.max(least).min(T::ONE - least);
        Some(if interval.forward { z } else { T::ONE - z })
    }

    #[inline]
    fn fastest_decay(&self, law: &impl ContactLaw<T>, s: T) -> T {
        if PEELS { self.peeling * law.contact_radius(s) } else { T::ZERO }
    }

    fn residual<const N: usize>(&self, law: &impl ContactLaw<T>, interval: &Interval<T, N>) -> T
    where
        T: Nodes<N>,
    {
        let s = interval.end.s;
        let closing = -(self.closing() * self.pressing.at(law, s));
        if !PEELS {
            let late = self.slip_after(law, interval) / closing;
            // Where nothing presses nothing changes, and a slip next to the smallest number ends where the force is none yet.
            return if late.is_finite() { late } else { T::ZERO };
        }
        let slide = self.slide(law, interval);
        let slope = self.direction * closing + self.peeling * law.contact_radius(s) * slide.peripheral_after;
        let late = (slide.velocity_after - slide.peripheral_after) / slope;
        // Where nothing but the moment ends the slip, slip and slope end together.
        if late.is_finite() { late } else { T::ZERO }
    }

    fn observe_rolling<const N: usize>(
        &mut self,
        law: &impl ContactLaw<T>,
        whole: &Interval<T, N>,
        before: &Interval<T, N>,
        late: T,
        after: &mut dyn FnMut() -> Interval<T, N>,
        rebound: bool,
    ) where
        T: Nodes<N>,
    {
        let end = self.now + dot(&T::WEIGHTS, &whole.rate);
        self.observe(law, before, rebound);
        self.roll(-late);
        if PEELS {
            let rest = after();
            // The end of the interval is known better than that of its first part: close to a turning point the last rate is
            // not exact. The moment does next to nothing in the difference.
            self.pass_rolling(end - dot(&T::WEIGHTS, &rest.rate) - self.now);
            self.observe(law, &rest, rebound);
        } else {
            self.pass_rolling(end - self.now);
        }
    }

    /// Velocities of centre and periphery, the distances of both, and what friction and the moment have taken.
    type State = ([T; 2], ([T; 2], [T; 2]));

    #[inline]
    fn state(&self) -> Self::State {
        let losses = [self.friction_loss, self.peeling_loss];
        ([self.velocity, self.peripheral], ([self.displacement, self.rotation], losses))
    }

    /// B7 to B10.
    #[inline]
    fn rates(&self, state: &Self::State, law: &impl ContactLaw<T>, s: T, _y: T, _rebound: bool) -> Self::State {
        let ([velocity, peripheral], _) = *state;
        let ratio = self.gyration_ratio;
        let braking = if PEELS { self.peeling * law.contact_radius(s) * peripheral } else { T::ZERO };
        let (accelerations, rubbed) = if self.slides() {
            let force = self.direction * self.friction * self.pressing.at(law, s);
            (
                [-force, force / ratio - braking],
                force / self.energy_speed * ((velocity - peripheral) / self.energy_speed),
            )
        } else {
            // The friction that keeps the sphere rolling divides the moment between both.
            let divided = -(ratio / (T::ONE + ratio) * braking);
            ([divided, divided], T::ZERO)
        };
        let peeled = ratio * (braking / self.energy_speed) * (peripheral / self.energy_speed);
        (accelerations, ([velocity, peripheral], [rubbed, peeled]))
    }

    #[inline]
    fn slip(&self, state: &Self::State) -> Option<T> {
        let ([velocity, peripheral], _) = *state;
        self.slides().then(|| (velocity - peripheral) * self.direction)
    }

    #[inline]
    fn rolls_from(&mut self, time: T) {
        self.roll(time);
    }

    #[inline]
    fn ended(&mut self, state: &Self::State, _times: &Times<T>) {
        let ([velocity, peripheral], ([displacement, rotation], [friction_loss, peeling_loss])) = *state;
        *self = Self { velocity, peripheral, displacement, rotation, friction_loss, peeling_loss, ..*self };
    }
}

/// Place, value and, at a node, slope at an end of a bracket.
type End<T> = (T, T, Option<T>);

/// The root that comes first in time, of the polynomial through `values` at the nodes that has the values `ends` at 0 and 1:
/// Newton's method on the barycentric form, with `slopes` at the nodes that need not be exact. The value is positive before.
fn first_root<T: Nodes<N>, const N: usize>(
    values: &[T; N],
    slopes: &[T; N],
    ends: (T, T),
    forward: bool,
    enough: T,
) -> T {
    let (mut low, mut high): (End<T>, End<T>) = ((T::ZERO, ends.0, None), (T::ONE, ends.1, None));
    for i in 0..N {
        let j = if forward { i } else { N - 1 - i };
        let node = (T::Z[j], values[j], Some(slopes[j]));
        let before = values[j] > T::ZERO;
        if before == forward {
            low = node;
        } else {
            high = node;
        }
        if !before {
            break;
        }
    }
    let width = high.0 - low.0;
    if width <= T::ZERO {
        return high.0;
    }
    let secant = (high.1 - low.1) / width;
    let (slope_low, slope_high) = (low.2.unwrap_or(secant), high.2.unwrap_or(secant));
    // The cubic with these values and slopes at both ends of the bracket.
    let bend = slope_low + slope_high - secant - secant;
    let cubic = |z: T| {
        let t = (z - low.0) / width;
        low.1 + width * t * (slope_low + t * (secant - slope_low - bend * (T::ONE - t)))
    };
    let slope = |z: T| {
        let t = (z - low.0) / width;
        slope_low + t * ((slope_high - slope_low) - T::constant(3.0) * bend * (T::ONE - t))
    };
    let polynomial = |z: T| {
        let (mut numerator, mut denominator) = (T::ZERO, T::ZERO);
        for j in 0..N {
            let distance = z - T::Z[j];
            if distance == T::ZERO {
                return values[j];
            }
            let weight = T::HIGHEST_COEFFICIENT[j] / distance;
            numerator = numerator + weight * values[j];
            denominator = denominator + weight;
        }
        numerator / denominator
    };
    let guess = polish(cubic, &slope, (low.0, high.0), forward, low.0 - low.1 / secant, (enough, CUBIC_STEPS));
    polish(polynomial, &slope, (low.0, high.0), forward, guess, (enough, POLYNOMIAL_STEPS))
}

/// A root improved by Newton's method within its bracket, until the value is small enough.
#[inline]
fn polish<T: Real>(
    value_at: impl Fn(T) -> T,
    slope_at: &impl Fn(T) -> T,
    (mut low, mut high): (T, T),
    positive_first: bool,
    root: T,
    (enough, steps): (T, u32),
) -> T {
    let mut root = root;
    for _ in 0..steps {
        let value = value_at(root);
        if value.abs() < enough {
            break;
        }
        if (value > T::ZERO) == positive_first {
            low = root;
        } else {
            high = root;
        }
        root = root - value / slope_at(root);
        if !(root > low && root < high) {
            root = T::constant(0.5) * (low + high);
        }
    }
    root
}

#[cfg(test)]
mod tests {
    use crate::contact::{Adaptive, Contact, Slip};
    use crate::{InputError, NormalMotion, Oblique, Sphere, Stiffness};

    /// A slip of one unit in the last place, which is gone in the units of the impact.
    #[test]
    fn a_slip_that_rounding_removes_is_none() -> Result<(), InputError> {
        let sphere = Sphere::new(9.999999973194381e-6, 0.06977853575606303, 0.0019952623133643525)?;
        let scene = Contact::hertz(sphere, Stiffness::new(1.000560660449101e8)?)
            .with_external_force(2.4102473642900153e-8)?
            .with_friction(0.14142135632453895)?;
        let motion = NormalMotion::new(11.97238862289469)?.with_tangential(3.7860017111479776)?;
        let motion = motion.with_spin(&sphere, 378600.1721296589)?;
        assert_eq!(motion.slip(), 4.440892098500626e-16);
        let (_, slip) = scene.solve_for(&motion, &Adaptive::new(1e-9_f64)?, Slip)?;
        assert_eq!((slip.slides, slip.rolls_from), (false, Some(0.0)));
        assert!((slip.velocity / motion.tangential() - 1.0).abs() < 1e-14 && slip.rotation.is_finite(), "{slip:?}");
        Ok(())
    }
}
