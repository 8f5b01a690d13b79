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

use super::law::NormalLaw;
use super::nodes::Nodes;
use super::observer::Observer;
use super::outcome::TangentialContact;
use super::ring::Ring;
use super::scaled::Scaled;
use super::stretch::{Stretch, dot, integrals};
use crate::{Coulomb, InputError, NoFriction, Oblique, Parameter, Real, Sphere};

/// No peeling moment.
///
/// ```
/// assert_eq!(size_of::<microimpact::simulation::NoPeeling>(), 0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
}

/// Velocities at the nodes of a stretch and at its end in time.
struct Slide<T, const N: usize> {
    tangential: [T; N],
    peripheral: [T; N],
    tangential_after: T,
    peripheral_after: T,
}

impl<T: Real, P: SpinDamping<T>> TangentialMotion<T, P> {
    /// The motion before contact, with velocities divided by `unit`.
    pub(super) fn new(motion: &impl Oblique<T>, unit: T, friction: T, gyration_ratio: T, peeling: P) -> Self {
        let slip = motion.slip();
        let direction = if slip > T::ZERO {
            T::ONE
        } else if slip < T::ZERO {
            -T::ONE
        } else {
            T::ZERO
        };
        Self {
            friction,
            gyration_ratio,
            peeling,
            tangential: motion.tangential() / unit,
            peripheral: motion.peripheral() / unit,
            displacement: T::ZERO,
            rotation: T::ZERO,
            friction_loss: T::ZERO,
            peeling_loss: T::ZERO,
            direction,
            now: T::ZERO,
            rolls_from: (direction == T::ZERO).then_some(T::ZERO),
        }
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
        // Variation of constants: u = exp(-G) (u0 + turn * integral of exp(G) F).
        let (decay, whole_decay) = self.decay(stretch, T::ONE);
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

    /// Integral G of a share of the peeling rate.
    fn decay<const N: usize>(&self, stretch: &Stretch<T, N>, share: T) -> ([T; N], T)
    where
        T: Nodes<N>,
    {
        let rate = share * self.peeling.rate();
        let mut decay = [T::ZERO; N];
        for j in 0..N {
            decay[j] = rate * stretch.s[j] * stretch.rate[j];
        }
        Self::running(&decay, stretch.forward)
    }
}

impl<T: Real, P: SpinDamping<T>> Observer<T> for TangentialMotion<T, P> {
    const EVENTS: bool = true;

    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
        let duration = dot(&T::WHOLE, &stretch.rate);
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
        let mut way = duration * self.tangential;
        if P::PRESENT {
            let share = self.gyration_ratio / (T::ONE + self.gyration_ratio);
            let (decay, whole_decay) = self.decay(stretch, share);
            let mut left = T::ZERO;
            for j in 0..N {
                left = left + T::WHOLE[j] * stretch.rate[j] * (-decay[j]).exp();
            }
            way = left * self.tangential;
            let energy = self.energy();
            self.tangential = self.tangential * (-whole_decay).exp();
            self.peripheral = self.tangential;
            // Rolling, friction only passes the moment on.
            self.peeling_loss = self.peeling_loss + (energy - self.energy());
        }
        self.displacement = self.displacement + way;
        self.rotation = self.rotation + way;
    }

    fn rolls_at<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        if !self.slides() {
            return None;
        }
        let slide = self.slide(law, stretch);
        let slip_after = (slide.tangential_after - slide.peripheral_after) * self.direction;
        if slip_after > T::ZERO {
            return None;
        }
        let mut slip = [T::ZERO; N];
        for j in 0..N {
            slip[j] = (slide.tangential[j] - slide.peripheral[j]) * self.direction;
        }
        let ends = if stretch.forward { (self.slip(), slip_after) } else { (slip_after, self.slip()) };
        let z = root_between_nodes(&slip, ends, T::constant(1e-9) * self.slip());
        let z = z.max(T::constant(1e-6)).min(T::constant(0.999_999));
        Some(if stretch.forward { z } else { T::ONE - z })
    }

    fn lateness<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        let slide = self.slide(law, stretch);
        let (s, rate) = (stretch.s[N - 1], stretch.rate[N - 1]);
        let closing = self.direction * self.friction * law.elastic_force(s) * (T::ONE + T::ONE / self.gyration_ratio);
        let mut slope = -(closing * rate);
        if P::PRESENT {
            slope = slope + self.peeling.rate() * s * rate * slide.peripheral_after;
        }
        (slide.tangential_after - slide.peripheral_after) / slope
    }

    fn roll(&mut self, before: T) {
        self.direction = T::ZERO;
        self.rolls_from = Some(self.now + before);
        let momentum = self.tangential + self.gyration_ratio * self.peripheral;
        self.tangential = momentum / (T::ONE + self.gyration_ratio);
        self.peripheral = self.tangential;
    }
}

/// A tangential side of a scene: none, or friction with or without a peeling moment.
///
/// ```
/// use microimpact::simulation::{NoPeeling, TangentialScene};
/// use microimpact::{NoAdhesion, NoFriction, NormalMotion};
///
/// type Contact = <NoFriction as TangentialScene<f32, NormalMotion<f32>, NoAdhesion, NoPeeling>>::Contact;
/// assert_eq!(size_of::<Contact>(), 0);
/// ```
pub trait TangentialScene<T: Real, M, A, P> {
    /// What is integrated along the motion.
    type Observer: Observer<T>;
    /// What comes out.
    type Contact;

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
    fn finish(observer: Self::Observer, sphere: &Sphere<T>, units: &Scaled<T>) -> Self::Contact;
}

impl<T: Real, M, A, P> TangentialScene<T, M, A, P> for NoFriction {
    type Observer = ();
    type Contact = ();

    fn start(&self, _: &Sphere<T>, _: &A, _: &P, _: &M, _: &Scaled<T>) -> Result<(), InputError> {
        Ok(())
    }

    fn finish((): (), _: &Sphere<T>, _: &Scaled<T>) {}
}

impl<T: Real, M: Oblique<T>, A> TangentialScene<T, M, A, NoPeeling> for Coulomb<T> {
    type Observer = TangentialMotion<T, NoPeeling>;
    type Contact = TangentialContact<T>;

    fn start(
        &self,
        sphere: &Sphere<T>,
        _adhesion: &A,
        peeling: &NoPeeling,
        motion: &M,
        units: &Scaled<T>,
    ) -> Result<Self::Observer, InputError> {
        Ok(TangentialMotion::new(motion, units.speed, self.coefficient(), sphere.gyration_ratio(), *peeling))
    }

    fn finish(observer: Self::Observer, sphere: &Sphere<T>, units: &Scaled<T>) -> TangentialContact<T> {
        TangentialContact::new(&observer, sphere, units)
    }
}

impl<T: Real, M: Oblique<T>> TangentialScene<T, M, Ring<T>, Peeling<T>> for Coulomb<T> {
    type Observer = TangentialMotion<T, ScaledPeeling<T>>;
    type Contact = TangentialContact<T>;

    fn start(
        &self,
        sphere: &Sphere<T>,
        adhesion: &Ring<T>,
        peeling: &Peeling<T>,
        motion: &M,
        units: &Scaled<T>,
    ) -> Result<Self::Observer, InputError> {
        let peeling = super::scaled::peeling(peeling, adhesion, sphere, units)?;
        Ok(TangentialMotion::new(motion, units.speed, self.coefficient(), sphere.gyration_ratio(), peeling))
    }

    fn finish(observer: Self::Observer, sphere: &Sphere<T>, units: &Scaled<T>) -> TangentialContact<T> {
        TangentialContact::new(&observer, sphere, units)
    }
}

/// Root of the polynomial through `values` at the nodes that has the values `ends` at 0 and 1, of opposite signs:
/// regula falsi with halving (the Illinois method) on the barycentric form.
fn root_between_nodes<T: Nodes<N>, const N: usize>(values: &[T; N], ends: (T, T), enough: T) -> T {
    let positive_first = ends.0 > T::ZERO;
    let (mut low, mut at_low, mut high, mut at_high) = (T::ZERO, ends.0, T::ONE, ends.1);
    for j in 0..N {
        if (values[j] > T::ZERO) == positive_first {
            (low, at_low) = (T::Z[j], values[j]);
        } else {
            (high, at_high) = (T::Z[j], values[j]);
            break;
        }
    }
    let half = T::constant(0.5);
    let mut root = low;
    for _ in 0..30 {
        if at_high == at_low {
            break;
        }
        root = low - at_low * (high - low) / (at_high - at_low);
        let (mut numerator, mut denominator) = (T::ZERO, T::ZERO);
        for j in 0..N {
            let distance = root - T::Z[j];
            if distance == T::ZERO {
                return root;
            }
            let weight = T::TAIL[j] / distance;
            numerator = numerator + weight * values[j];
            denominator = denominator + weight;
        }
        let value = numerator / denominator;
        if value.abs() < enough {
            break;
        }
        if (value > T::ZERO) == positive_first {
            (low, at_low) = (root, value);
            at_high = at_high * half;
        } else {
            (high, at_high) = (root, value);
            at_low = at_low * half;
        }
    }
    root
}
