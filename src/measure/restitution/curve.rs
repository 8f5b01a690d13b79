//! The curve of a fit, in units of the largest speed: w^2 = h^2 - mu b with h = x/(1 + c x), from (A34) with R = k/(k + v).

use crate::Real;

/// c and b.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve<T> {
    /// c: the largest speed over k.
    pub(super) loss: T,
    /// b: 2 W_A/m over the square of the largest speed, of a sphere of median mass.
    pub(super) pull: T,
}

/// Halvings of a bracket, more than a double has digits.
const HALVINGS: u32 = 60;

/// Range of c. Noise may make the restitution rise with speed.
const LEAST_LOSS: f64 = -0.5;
const LARGEST_LOSS: f64 = 1e3;

impl<T: Real> Curve<T> {
    /// The curve after a step of c and b.
    pub(super) fn moved(&self, [loss, pull]: [T; 2]) -> Self {
        let within = |value: T, low: T, high: T| value.max(low).min(high);
        Self {
            loss: within(self.loss + loss, T::constant(LEAST_LOSS), T::constant(LARGEST_LOSS)),
            // A sphere of median mass does not lose more energy than the fastest has.
            pull: within(self.pull + pull, -T::ONE, T::ONE),
        }
    }

    /// Rebound speed without adhesion.
    pub(super) fn body(&self, x: T) -> T {
        x / (T::ONE + self.loss * x)
    }

    /// Square of the rebound speed, negative for a capture. `lightness` is the median mass over that of the sphere.
    #[inline(never)]
    pub(super) fn square(&self, x: T, lightness: T) -> T {
        let h = self.body(x);
        h * h - lightness * self.pull
    }

    /// Derivative of the square with respect to the speed.
    pub(super) fn rise(&self, x: T) -> T {
        let r = T::ONE / (T::ONE + self.loss * x);
        T::constant(2.0) * x * r * r * r
    }

    /// Derivatives of the square with respect to c and b.
    pub(super) fn slopes(&self, x: T, lightness: T) -> [T; 2] {
        let h = self.body(x);
        [T::constant(-2.0) * h * h * h, -lightness]
    }

    /// Square of the critical speed of the sphere of median mass, and its derivatives with respect to c and b. `None` if no sphere
    /// rebounds.
    pub(super) fn critical_square(&self) -> Option<(T, [T; 2])> {
        let root = self.pull.max(T::ZERO).sqrt();
        let rest = T::ONE - self.loss * root;
        if rest <= T::EPSILON {
            return None;
        }
        let speed = root / rest;
        let by_pull = T::ONE / (rest * rest * rest);
        Some((speed * speed + self.pull.min(T::ZERO), [T::constant(2.0) * speed * speed * speed, by_pull]))
    }

    /// The curve through two rebounds (x, w, lightness) of different speeds; `None` if there is none with c >= 0.
    #[inline(never)]
    pub(super) fn through(slow: (T, T, T), fast: (T, T, T)) -> Option<Self> {
        // Both rebounds give b at a given c. With the right c they are equal.
        let pull = |(x, w, lightness): (T, T, T), loss: T| {
            let h = x / (T::ONE + loss * x);
            (h * h - w * w) / lightness
        };
        let excess = |loss: T| pull(fast, loss) - pull(slow, loss);
        let (mut low, mut high) = (T::ZERO, T::constant(LARGEST_LOSS));
        if excess(low) < T::ZERO || excess(high) > T::ZERO {
            return None;
        }
        let mut loss = low;
        for _ in 0..HALVINGS {
            // Large c are halved in their logarithm.
            loss =
                if low > T::constant(0.01) * high { T::constant(0.5) * (low + high) } else { T::constant(0.1) * high };
            if excess(loss) > T::ZERO {
                low = loss;
            } else {
                high = loss;
            }
        }
        Some(Self { loss, pull: pull(slow, loss) })
    }
}
