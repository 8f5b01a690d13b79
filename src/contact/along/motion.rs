//! Motion along the surface and spin during contact: sliding under Coulomb's friction, then rolling (B7 to B10).
//!
//! The normal motion does not depend on them, so they follow from integrals over its stretches. In units of the scene the
//! tangential velocity v and the peripheral velocity u = r theta' obey, with the elastic force F and the slip v - u,
//!
//! v' = -f F sgn(v - u),   kappa u' = f F sgn(v - u) - kappa q s u
//!
//! while sliding; q is the peeling rate. Rolling, v = u = v0 exp(-kappa/(1 + kappa) * integral of q s).

// Indices run over arrays of the length that their loops count to.
#![allow(clippy::indexing_slicing, clippy::needless_range_loop)]

use super::integrals::{Integrals, Quantities, observe_by_integrals};
use super::law::NormalLaw;
use super::motion::NormalPath;
use super::nodes::Nodes;
use super::observer::Observer;
use super::outcome::TangentialContact;
use super::relaxation::{SLOW, relaxed};
use super::scaled::{ScalePeeling, Scaled};
use super::stretch::{Stretch, dot, integrals};
use crate::{Coulomb, InputError, NoFriction, Oblique, Parameter, Real, Sphere};

/// No peeling moment.
///
/// ```
/// assert_eq!(size_of::<microimpact::simulation::NoPeeling>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct NoPeeling;

/// The peeling moment g = -lambda c_A a theta' against the spin (B10).
///
/// ```
/// use microimpact::simulation::Peeling;
///
/// assert!(Peeling::new(2e-12).is_ok());
/// assert!(Peeling::new(-2e-12).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Peeling<T> {
    pub(super) lambda: T,
}

impl<T: Real> Peeling<T> {
    /// A moment of strength lambda >= 0, N m.
    ///
    /// # Errors
    /// A value outside its range.
    ///
    /// ```
    /// assert!(microimpact::simulation::Peeling::new(f64::NAN).is_err());
    /// ```
    #[inline]
    pub fn new(lambda: T) -> Result<Self, InputError> {
        Ok(Self { lambda: Parameter::PeelingMoment.check(lambda)? })
    }
}

/// The rate at which a peeling moment slows the spin at contact radius 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledPeeling<T>(pub(super) T);

/// A moment that slows the spin in proportion to contact radius and spin.
pub trait SpinDamping<T>: Copy {
    /// Whether there is such a moment at all.
    const PRESENT: bool;

    /// Rate q of the spin's decay at contact radius 1.
    fn rate(&self) -> T;
}

impl<T: Real> SpinDamping<T> for NoPeeling {
    const PRESENT: bool = false;

    #[inline]
    fn rate(&self) -> T {
        T::ZERO
    }
}

impl<T: Real> SpinDamping<T> for ScaledPeeling<T> {
    const PRESENT: bool = true;

    #[inline]
    fn rate(&self) -> T {
        self.0
    }
}

/// The tangential motion so far, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentialMotion<T, P> {
    pub(super) friction: T,
    pub(super) gyration_ratio: T,
    pub(super) peeling: P,
    pub(super) tangential: T,
    pub(super) peripheral: T,
    pub(super) displacement: T,
    /// Rotation angle times radius.
    pub(super) rotation: T,
    /// Energies that friction and the peeling moment have taken, over the mass.
    pub(super) friction_loss: T,
    pub(super) peeling_loss: T,
    /// Sign of the slip, zero when rolling.
    pub(super) direction: T,
    now: T,
    pub(super) rolls_from: Option<T>,
    /// Speed below which rolling is nothing but rounding.
    rounding: T,
}

/// Direction of a slip: its sign, or zero.
fn direction<T: Real>(slip: T) -> T {
    if slip > T::ZERO {
        T::ONE
    } else if slip < T::ZERO {
        -T::ONE
    } else {
        T::ZERO
    }
}

/// Velocity of a sphere that rolls with the angular momentum about its contact point of two velocities.
#[inline]
fn rolling<T: Real>(tangential: T, peripheral: T, gyration_ratio: T) -> T {
    (tangential + gyration_ratio * peripheral) / (T::ONE + gyration_ratio)
}

/// Speed that is nothing but the rounding of [`rolling`].
fn rounding<T: Real>(tangential: T, peripheral: T, gyration_ratio: T) -> T {
    T::constant(8.0) * T::EPSILON * rolling(tangential.abs(), peripheral.abs(), gyration_ratio)
}

/// Velocities at the nodes of a stretch and at its end in time.
struct Slide<T, const N: usize> {
    tangential: [T; N],
    peripheral: [T; N],
    tangential_after: T,
    peripheral_after: T,
}

impl<T: Real, P: SpinDamping<T>> SurfaceObserver<T, P> for TangentialMotion<T, P> {
    fn new(motion: &impl Oblique<T>, unit: T, friction: T, gyration_ratio: T, peeling: P) -> Self {
        let direction = direction(motion.slip());
        let (tangential, peripheral) = (motion.tangential() / unit, motion.peripheral() / unit);
        Self {
            friction,
            gyration_ratio,
            peeling,
            tangential,
            peripheral,
            displacement: T::ZERO,
            rotation: T::ZERO,
            friction_loss: T::ZERO,
            peeling_loss: T::ZERO,
            direction,
            now: T::ZERO,
            rolls_from: (direction == T::ZERO).then_some(T::ZERO),
            rounding: rounding(tangential, peripheral, gyration_ratio),
        }
    }
}

impl<T: Real, P: SpinDamping<T>> TangentialMotion<T, P> {
    /// Whether it rolls with no more than a speed of rounding.
    pub(super) fn rests(&self) -> bool {
        !self.slides() && self.tangential.abs() <= self.rounding
    }

    pub(super) fn slides(&self) -> bool {
        self.direction != T::ZERO
    }

    /// Kinetic energy along the surface and of the spin, over the mass.
    pub(super) fn energy(&self) -> T {
        let (v, u) = (self.tangential, self.peripheral);
        T::constant(0.5) * (v * v + self.gyration_ratio * u * u)
    }

    /// Energy that the peeling moment takes over a stretch, from the peripheral velocities at the nodes.
    fn peeled<const N: usize>(&self, stretch: &Stretch<T, N>, peripheral: &[T; N]) -> T
    where
        T: Nodes<N>,
    {
        let mut peeled = T::ZERO;
        for j in 0..N {
            let u = peripheral[j];
            peeled = peeled + T::WHOLE[j] * stretch.rate[j] * stretch.s[j] * u * u;
        }
        self.gyration_ratio * self.peeling.rate() * peeled
    }

    /// The sphere rolls from here on; it began `before` this moment.
    pub(super) fn roll(&mut self, before: T) {
        self.direction = T::ZERO;
        self.rolls_from = Some(self.now + before);
        self.tangential = rolling(self.tangential, self.peripheral, self.gyration_ratio);
        self.peripheral = self.tangential;
    }

    /// The way that the sphere rolls in a time, without a peeling moment.
    fn pass_rolling(&mut self, duration: T) {
        let way = duration * self.tangential;
        self.now = self.now + duration;
        self.displacement = self.displacement + way;
        self.rotation = self.rotation + way;
    }

    /// By how much an impulse changes the slip.
    #[inline]
    fn closing(&self) -> T {
        self.friction * (T::ONE + T::ONE / self.gyration_ratio)
    }

    /// Slip after a stretch of sliding in its first direction, without a peeling moment.
    fn slip_after<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        let mut impulse = T::ZERO;
        for j in 0..N {
            impulse = impulse + T::WHOLE[j] * law.elastic_force(stretch.s[j]) * stretch.rate[j];
        }
        self.slip() - self.closing() * impulse
    }

    /// Slip in its first direction.
    fn slip(&self) -> T {
        (self.tangential - self.peripheral) * self.direction
    }

    /// Integrals up to each node in the order of time, and the whole.
    fn running<const N: usize>(f: &[T; N], forward: bool) -> ([T; N], T)
    where
        T: Nodes<N>,
    {
        let mut running = integrals(&T::RUNNING, f);
        let whole = running[N - 1];
        if !forward {
            running = running.map(|part| whole - part);
        }
        (running, whole)
    }

    /// The motion over a stretch while the sphere slides.
    fn slide<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> Slide<T, N>
    where
        T: Nodes<N>,
    {
        let force = self.direction * self.friction;
        let mut elastic = [T::ZERO; N];
        for j in 0..N {
            elastic[j] = law.elastic_force(stretch.s[j]) * stretch.rate[j];
        }
        let (impulse, whole) = Self::running(&elastic, stretch.forward);
        let turn = force / self.gyration_ratio;
        let tangential = impulse.map(|impulse| self.tangential - force * impulse);
        let tangential_after = self.tangential - force * whole;
        if !P::PRESENT {
            let peripheral = impulse.map(|impulse| self.peripheral + turn * impulse);
            return Slide {
                tangential,
                peripheral,
                tangential_after,
                peripheral_after: self.peripheral + turn * whole,
            };
        }
        let (decay, whole_decay) = self.decay(stretch, T::ONE);
        if whole_decay > T::constant(SLOW) {
            let drive = elastic.map(|elastic| turn * elastic);
            let (peripheral, peripheral_after) =
                relaxed(self.peripheral, &drive, &self.decay_rates(stretch, T::ONE), stretch.forward);
            return Slide { tangential, peripheral, tangential_after, peripheral_after };
        }
        // Variation of constants: u = exp(-G) (u0 + turn * integral of exp(G) F).
        for j in 0..N {
            elastic[j] = elastic[j] * decay[j].exp();
        }
        let (driven, whole_driven) = Self::running(&elastic, stretch.forward);
        let mut peripheral = [T::ZERO; N];
        for j in 0..N {
            peripheral[j] = (-decay[j]).exp() * (self.peripheral + turn * driven[j]);
        }
        let peripheral_after = (-whole_decay).exp() * (self.peripheral + turn * whole_driven);
        Slide { tangential, peripheral, tangential_after, peripheral_after }
    }

    /// A share of the peeling rate, along the stretch.
    fn decay_rates<const N: usize>(&self, stretch: &Stretch<T, N>, share: T) -> [T; N] {
        let rate = share * self.peeling.rate();
        let mut decay = [T::ZERO; N];
        for j in 0..N {
            decay[j] = rate * stretch.s[j] * stretch.rate[j];
        }
        decay
    }

    /// Integral G of a share of the peeling rate.
    fn decay<const N: usize>(&self, stretch: &Stretch<T, N>, share: T) -> ([T; N], T)
    where
        T: Nodes<N>,
    {
        Self::running(&self.decay_rates(stretch, share), stretch.forward)
    }
}

impl<T: Real, P: SpinDamping<T>> Observer<T> for TangentialMotion<T, P> {
    const EVENTS: bool = true;
    const TIMED: bool = true;

    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
        let duration = dot(&T::WHOLE, &stretch.rate);
        if !self.slides() && !P::PRESENT {
            return self.pass_rolling(duration);
        }
        self.now = self.now + duration;
        if self.slides() {
            let slide = self.slide(law, stretch);
            for j in 0..N {
                let moment = T::WHOLE[j] * stretch.rate[j];
                self.displacement = self.displacement + moment * slide.tangential[j];
                self.rotation = self.rotation + moment * slide.peripheral[j];
            }
            let energy = self.energy();
            let peeled = if P::PRESENT { self.peeled(stretch, &slide.peripheral) } else { T::ZERO };
            self.tangential = slide.tangential_after;
            self.peripheral = slide.peripheral_after;
            self.peeling_loss = self.peeling_loss + peeled;
            self.friction_loss = self.friction_loss + (energy - self.energy() - peeled);
            return;
        }
        let share = self.gyration_ratio / (T::ONE + self.gyration_ratio);
        let (decay, whole_decay) = self.decay(stretch, share);
        let (velocity, after) = if whole_decay > T::constant(SLOW) {
            let rates = self.decay_rates(stretch, share);
            relaxed(self.tangential, &[T::ZERO; N], &rates, stretch.forward)
        } else {
            let left = |decay: T| self.tangential * (-decay).exp();
            (decay.map(left), left(whole_decay))
        };
        let mut way = T::ZERO;
        for j in 0..N {
            way = way + T::WHOLE[j] * stretch.rate[j] * velocity[j];
        }
        let energy = self.energy();
        self.tangential = after;
        self.peripheral = self.tangential;
        // Rolling, friction only passes the moment on.
        self.peeling_loss = self.peeling_loss + (energy - self.energy());
        self.displacement = self.displacement + way;
        self.rotation = self.rotation + way;
    }

    fn rolls_at<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        if !self.slides() || (!P::PRESENT && self.slip_after(law, stretch) > T::ZERO) {
            return None;
        }
        let slide = self.slide(law, stretch);
        let slip_after = (slide.tangential_after - slide.peripheral_after) * self.direction;
        if slip_after > T::ZERO {
            return None;
        }
        let (mut slip, mut slope) = ([T::ZERO; N], [T::ZERO; N]);
        let closing = if stretch.forward { -self.closing() } else { self.closing() };
        for j in 0..N {
            slip[j] = (slide.tangential[j] - slide.peripheral[j]) * self.direction;
            slope[j] = closing * law.elastic_force(stretch.s[j]) * stretch.rate[j];
        }
        let ends = if stretch.forward { (self.slip(), slip_after) } else { (slip_after, self.slip()) };
        let z = root_between_nodes(&slip, &slope, ends, T::constant(1e-6) * self.slip());
        let z = z.max(T::constant(1e-6)).min(T::constant(0.999_999));
        Some(if stretch.forward { z } else { T::ONE - z })
    }

    fn lateness<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        let (s, rate) = (stretch.s[N - 1], stretch.rate[N - 1]);
        let closing = -(self.closing() * law.elastic_force(s) * rate);
        if !P::PRESENT {
            return self.slip_after(law, stretch) / closing;
        }
        let slide = self.slide(law, stretch);
        let slope = self.direction * closing + self.peeling.rate() * s * rate * slide.peripheral_after;
        let late = (slide.tangential_after - slide.peripheral_after) / slope;
        // Where nothing but the moment ends the slip, slip and slope end together.
        if late.is_finite() { late } else { T::ZERO }
    }

    fn observe_rolling<const N: usize>(
        &mut self,
        law: &impl NormalLaw<T>,
        whole: &Stretch<T, N>,
        before: &Stretch<T, N>,
        late: T,
        after: &mut dyn FnMut() -> Stretch<T, N>,
        rebound: bool,
    ) where
        T: Nodes<N>,
    {
        let end = self.now + dot(&T::WHOLE, &whole.rate);
        self.observe(law, before, rebound);
        self.roll(-late);
        if P::PRESENT {
            self.observe(law, &after(), rebound);
        } else {
            self.pass_rolling(end - self.now);
        }
    }
}

/// Velocities before contact and the impulse of the elastic force, from which those after it follow without a peeling
/// moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceImpulse<T> {
    friction: T,
    gyration_ratio: T,
    tangential: T,
    peripheral: T,
    elastic: T,
}

impl<T: Real> SurfaceObserver<T, NoPeeling> for SurfaceImpulse<T> {
    fn new(motion: &impl Oblique<T>, unit: T, friction: T, gyration_ratio: T, _peeling: NoPeeling) -> Self {
        let (tangential, peripheral) = (motion.tangential() / unit, motion.peripheral() / unit);
        Self { friction, gyration_ratio, tangential, peripheral, elastic: T::ZERO }
    }
}

impl<T: Real> SurfaceImpulse<T> {
    /// What friction can change of the slip.
    #[inline]
    fn reach(&self) -> T {
        self.friction * self.elastic * (T::ONE + T::ONE / self.gyration_ratio)
    }

    /// The same over the slip; `None` where nothing slips.
    pub(super) fn friction_over_limit(&self) -> Option<T> {
        let slip = (self.tangential - self.peripheral).abs();
        (slip > T::ZERO).then(|| self.reach().saturating_div(slip))
    }

    /// Whether the sphere still slides, and its tangential and peripheral velocities; a captured one goes on until it rolls.
    pub(super) fn after(&self, captured: bool) -> (bool, [T; 2]) {
        let (v, u, kappa) = (self.tangential, self.peripheral, self.gyration_ratio);
        let slip = v - u;
        let ends = slip.abs() <= self.reach() || (captured && self.friction > T::ZERO);
        if ends {
            let rolling = rolling(v, u, kappa);
            return (false, [rolling, rolling]);
        }
        let impulse = direction(slip) * (self.friction * self.elastic);
        (true, [v - impulse, u + impulse / kappa])
    }

    /// Whether it would roll with no more than a speed of rounding.
    pub(super) fn rests(&self) -> bool {
        let (v, u, kappa) = (self.tangential, self.peripheral, self.gyration_ratio);
        rolling(v, u, kappa).abs() <= rounding(v, u, kappa)
    }
}

impl<T: Real> Quantities<T> for SurfaceImpulse<T> {
    #[inline]
    fn combine(self, other: Self, of: impl Fn(T, T) -> T + Copy) -> Self {
        Self { elastic: of(self.elastic, other.elastic), ..self }
    }
}

impl<T: Real> Integrals<T> for SurfaceImpulse<T> {
    #[inline]
    fn growth(&self, law: &impl NormalLaw<T>, s: T, _y: T, _rebound: bool) -> Self {
        Self { elastic: law.elastic_force(s), ..*self }
    }
}

observe_by_integrals!(SurfaceImpulse, timed: true);

/// A tangential side of a scene, with a result `G`: `()` without friction; with it all of [`TangentialContact`], or,
/// without a peeling moment, [`TangentialVelocities`](super::TangentialVelocities) or
/// [`ContactClass`](crate::ContactClass) alone.
///
/// ```
/// use microimpact::simulation::{NoPeeling, TangentialScene};
/// use microimpact::{NoAdhesion, NoFriction, NormalMotion};
///
/// type Observer = <NoFriction as TangentialScene<f32, NormalMotion<f32>, NoAdhesion, NoPeeling, ()>>::Observer;
/// assert_eq!(size_of::<Observer>(), 0);
/// ```
pub trait TangentialScene<T: Real, M, A, P, G> {
    /// What is integrated along the motion.
    type Observer;

    /// The state before contact.
    ///
    /// # Errors
    /// A ratio outside its range.
    fn start(
        &self,
        sphere: &Sphere<T>,
        adhesion: &A,
        peeling: &P,
        motion: &M,
        units: &Scaled<T>,
    ) -> Result<Self::Observer, InputError>;

    /// The result in SI units.
    fn finish(observer: Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> G;
}

/// All that a scene can tell of its tangential side.
///
/// ```
/// use microimpact::simulation::{Tangential, TangentialContact};
/// use microimpact::{Coulomb, NoFriction};
///
/// assert_eq!(size_of::<<NoFriction as Tangential<f32>>::Contact>(), 0);
/// let _: Option<<Coulomb<f32> as Tangential<f32>>::Contact> = None::<TangentialContact<f32>>;
/// ```
pub trait Tangential<T> {
    /// The result.
    type Contact;
}

impl<T> Tangential<T> for NoFriction {
    type Contact = ();
}

impl<T> Tangential<T> for Coulomb<T> {
    type Contact = TangentialContact<T>;
}

impl<T: Real, M, A, P> TangentialScene<T, M, A, P, ()> for NoFriction {
    type Observer = ();

    fn start(&self, _: &Sphere<T>, _: &A, _: &P, _: &M, _: &Scaled<T>) -> Result<(), InputError> {
        Ok(())
    }

    fn finish((): (), _: &NormalPath<T>, _: &Sphere<T>, _: &Scaled<T>) {}
}

impl<T, M, A, P, G> TangentialScene<T, M, A, P, G> for Coulomb<T>
where
    T: Real,
    M: Oblique<T>,
    P: ScalePeeling<T, A, Scaled: SurfaceResult<T, G>>,
{
    type Observer = <P::Scaled as SurfaceResult<T, G>>::Observer;

    fn start(
        &self,
        sphere: &Sphere<T>,
        adhesion: &A,
        peeling: &P,
        motion: &M,
        units: &Scaled<T>,
    ) -> Result<Self::Observer, InputError> {
        let peeling = peeling.scale(adhesion, sphere, units)?;
        Ok(SurfaceObserver::new(motion, units.speed, self.coefficient(), sphere.gyration_ratio(), peeling))
    }

    fn finish(observer: Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> G {
        P::Scaled::result(&observer, path, sphere, units)
    }
}

/// What is integrated along the motion of a sphere with friction, under a scaled peeling moment `P`.
pub trait SurfaceObserver<T: Real, P> {
    /// The state before contact, with velocities divided by `unit`.
    fn new(motion: &impl Oblique<T>, unit: T, friction: T, gyration_ratio: T, peeling: P) -> Self;
}

/// A scaled peeling moment, or none, under which a scene with friction has the result `G`.
pub trait SurfaceResult<T: Real, G>: Sized {
    /// What is integrated for it.
    type Observer: SurfaceObserver<T, Self>;

    /// The result in SI units.
    fn result(motion: &Self::Observer, path: &NormalPath<T>, sphere: &Sphere<T>, units: &Scaled<T>) -> G;
}

/// Place, value and, at a node, slope at an end of a bracket.
type End<T> = (T, T, Option<T>);

/// Root of the polynomial through `values` at the nodes that has the values `ends` at 0 and 1, of opposite signs: Newton's
/// method on the barycentric form, with `slopes` at the nodes that need not be exact.
fn root_between_nodes<T: Nodes<N>, const N: usize>(values: &[T; N], slopes: &[T; N], ends: (T, T), enough: T) -> T {
    let positive_first = ends.0 > T::ZERO;
    let (mut low, mut high): (End<T>, End<T>) = ((T::ZERO, ends.0, None), (T::ONE, ends.1, None));
    for j in 0..N {
        if (values[j] > T::ZERO) == positive_first {
            low = (T::Z[j], values[j], Some(slopes[j]));
        } else {
            high = (T::Z[j], values[j], Some(slopes[j]));
            break;
        }
    }
    let secant = (high.1 - low.1) / (high.0 - low.0);
    let (slope_low, slope_high) = (low.2.unwrap_or(secant), high.2.unwrap_or(secant));
    let width = high.0 - low.0;
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
            let weight = T::TAIL[j] / distance;
            numerator = numerator + weight * values[j];
            denominator = denominator + weight;
        }
        numerator / denominator
    };
    let guess = polish(cubic, &slope, (low.0, high.0), positive_first, low.0 - low.1 / secant, (enough, 4));
    polish(polynomial, &slope, (low.0, high.0), positive_first, guess, (enough, 20))
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
