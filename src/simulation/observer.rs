//! What a scene wants to know of a motion besides how it ends: each a type that costs nothing where it is not named.

use super::law::NormalLaw;
use super::nodes::Nodes;
use super::stretch::{Stretch, dot};
use crate::Real;

/// Something that is integrated along the motion, one stretch after the other in the order of time.
pub trait Observer<T: Real> {
    /// Whether it looks for the end of sliding.
    const EVENTS: bool = false;

    /// Adds a stretch.
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>;

    /// Share of a stretch, in the order of time, after which the sphere rolls, if it begins to.
    #[inline]
    fn rolls_at<const N: usize>(&self, _law: &impl NormalLaw<T>, _stretch: &Stretch<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        None
    }

    /// By how much of its length a stretch ends after the sphere has begun to roll.
    #[inline]
    fn lateness<const N: usize>(&self, _law: &impl NormalLaw<T>, _stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        T::ZERO
    }

    /// The sphere rolls from here on; it began `before` this moment.
    #[inline]
    fn roll(&mut self, _before: T) {}
}

/// Nothing besides the end.
impl<T: Real> Observer<T> for () {
    #[inline]
    fn observe<const N: usize>(&mut self, _law: &impl NormalLaw<T>, _stretch: &Stretch<T, N>, _rebound: bool)
    where
        T: Nodes<N>,
    {
    }
}

impl<T: Real, A: Observer<T>, B: Observer<T>> Observer<T> for (A, B) {
    const EVENTS: bool = A::EVENTS || B::EVENTS;

    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        self.0.observe(law, stretch, rebound);
        self.1.observe(law, stretch, rebound);
    }

    #[inline]
    fn rolls_at<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> Option<T>
    where
        T: Nodes<N>,
    {
        if A::EVENTS { self.0.rolls_at(law, stretch) } else { self.1.rolls_at(law, stretch) }
    }

    #[inline]
    fn lateness<const N: usize>(&self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>) -> T
    where
        T: Nodes<N>,
    {
        if A::EVENTS { self.0.lateness(law, stretch) } else { self.1.lateness(law, stretch) }
    }

    #[inline]
    fn roll(&mut self, before: T) {
        self.0.roll(before);
        self.1.roll(before);
    }
}

/// Times of peak and separation, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times<T> {
    pub(super) now: T,
    pub(super) peak: T,
}

impl<T: Real> Times<T> {
    pub(super) fn new() -> Self {
        Self { now: T::ZERO, peak: T::ZERO }
    }
}

impl<T: Real> Observer<T> for Times<T> {
    #[inline]
    fn observe<const N: usize>(&mut self, _law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        self.now = self.now + dot(&T::WHOLE, &stretch.rate);
        if !rebound {
            self.peak = self.now;
        }
    }
}

/// Impulses of the elastic force and of adhesion on rebound, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impulses<T> {
    pub(super) elastic: T,
    pub(super) adhesion_rebound: T,
}

impl<T: Real> Impulses<T> {
    pub(super) fn new() -> Self {
        Self { elastic: T::ZERO, adhesion_rebound: T::ZERO }
    }
}

impl<T: Real> Observer<T> for Impulses<T> {
    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        for ((&s, &y), (&rate, &weight)) in stretch.s.iter().zip(&stretch.y).zip(stretch.rate.iter().zip(&T::WHOLE)) {
            let duration = weight * rate;
            self.elastic = self.elastic + duration * law.elastic_force(s);
            if rebound {
                let force = law.adhesion_force(s) + law.adhesion_damping(s) * y;
                self.adhesion_rebound = self.adhesion_rebound + duration * force;
            }
        }
    }
}

/// Works of the two kinds of damping, in units of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Works<T> {
    pub(super) material: T,
    pub(super) adhesion: T,
}

impl<T: Real> Works<T> {
    pub(super) fn new() -> Self {
        Self { material: T::ZERO, adhesion: T::ZERO }
    }
}

impl<T: Real> Observer<T> for Works<T> {
    #[inline]
    fn observe<const N: usize>(&mut self, law: &impl NormalLaw<T>, stretch: &Stretch<T, N>, rebound: bool)
    where
        T: Nodes<N>,
    {
        for ((&s, &y), (&rate, &weight)) in stretch.s.iter().zip(&stretch.y).zip(stretch.rate.iter().zip(&T::WHOLE)) {
            let square = weight * rate * y * y;
            self.material = self.material + square * law.material_damping(s);
            if rebound {
                self.adhesion = self.adhesion + square * law.adhesion_damping(s);
            }
        }
    }
}
