//! Power series in the independent variable of a step, and their products.

use crate::double::{Double, split, two_sum};

/// Highest power of a series.
pub(crate) const ORDER: usize = 26;

/// Number of coefficients.
const TERMS: usize = ORDER + 1;

/// A power series. The coefficients are kept as their parts, the larger split for exact products.
#[derive(Clone)]
pub(crate) struct Series {
    high: [f64; TERMS],
    low: [f64; TERMS],
    head: [f64; TERMS],
    tail: [f64; TERMS],
}

impl Series {
    pub(crate) const ZERO: Self =
        Self { high: [0.0; TERMS], low: [0.0; TERMS], head: [0.0; TERMS], tail: [0.0; TERMS] };

    /// A constant.
    pub(crate) fn constant(value: Double) -> Self {
        let mut series = Self::ZERO;
        series.set(0, value);
        series
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, power: usize, value: Double) {
        (self.high[power], self.low[power]) = value.parts();
        (self.head[power], self.tail[power]) = split(self.high[power]);
    }

    #[inline(always)]
    pub(crate) fn get(&self, power: usize) -> Double {
        Double::of_parts(self.high[power], self.low[power])
    }

    /// Size of a coefficient.
    pub(crate) fn size(&self, power: usize) -> f64 {
        self.high[power].abs()
    }

    /// The coefficient of a power in the product of two series, of whose coefficients those up to this power are known.
    #[inline]
    pub(crate) fn product(&self, other: &Self, power: usize) -> Double {
        self.products(other, power, power + 1)
    }

    /// The same of the square of this series.
    #[inline]
    pub(crate) fn square(&self, power: usize) -> Double {
        let twice = self.products(self, power, power.div_ceil(2)) * 2.0;
        if power.is_multiple_of(2) { twice + self.get(power / 2) * self.get(power / 2) } else { twice }
    }

    /// The first `count` terms of that coefficient.
    #[inline(always)]
    fn products(&self, other: &Self, power: usize, count: usize) -> Double {
        // Sums that do not wait for each other.
        let mut sums = [Sum::default(); LANES];
        let whole = count - count % LANES;
        for start in (0..whole).step_by(LANES) {
            for (lane, sum) in sums.iter_mut().enumerate() {
                sum.add(self, start + lane, other, power - start - lane);
            }
        }
        for i in whole..count {
            sums[0].add(self, i, other, power - i);
        }
        let [a, b, c, d] = sums.map(Sum::total);
        (a + b) + (c + d)
    }

    /// The value at a place.
    #[inline]
    pub(crate) fn at(&self, place: Double) -> Double {
        let mut value = self.get(ORDER);
        for power in (0..ORDER).rev() {
            value = value * place + self.get(power);
        }
        value
    }

    /// The derivative.
    pub(crate) fn derivative(&self) -> Self {
        let mut derivative = Self::ZERO;
        for power in 1..TERMS {
            derivative.set(power - 1, self.get(power) * power as f64);
        }
        derivative
    }

    /// The difference of two series.
    pub(crate) fn minus(&self, other: &Self) -> Self {
        let mut difference = Self::ZERO;
        for power in 0..TERMS {
            difference.set(power, self.get(power) - other.get(power));
        }
        difference
    }

    /// The first place after 0, up to `end`, where the series takes the sign opposite to `sign`; it has `sign` after 0.
    ///
    /// The series has at most one extremum up to `end`, because a step is short beside the radius of convergence.
    pub(crate) fn first_change(&self, sign: f64, end: Double) -> Option<Double> {
        let opposite = |value: Double| value.to_f64() * sign < 0.0;
        if opposite(self.at(end)) {
            return Some(self.root(sign, end));
        }
        let slope = self.derivative();
        if slope.get(0).to_f64() * sign < 0.0 && slope.at(end).to_f64() * sign > 0.0 {
            let extremum = slope.root(-sign, end);
            if opposite(self.at(extremum)) {
                return Some(self.root(sign, extremum));
            }
        }
        None
    }

    /// The root between 0, after which the series has a `sign`, and `end`, where it has the other.
    pub(crate) fn root(&self, sign: f64, end: Double) -> Double {
        /// Newton's method and, where it leaves the bracket, bisection; both together come to their end much earlier.
        const MOST: u32 = 200;
        /// Relative change that ends the search.
        const LEAST: f64 = 1e-31;
        let slope = self.derivative();
        let (mut low, mut high, mut place) = (Double::ZERO, end, end * 0.5);
        for _ in 0..MOST {
            let value = self.at(place);
            if value.to_f64() * sign > 0.0 {
                low = place;
            } else {
                high = place;
            }
            let steepness = slope.at(place);
            let newton = if steepness.to_f64() == 0.0 { end * 2.0 } else { place - value / steepness };
            let next = if newton > low && newton < high { newton } else { (low + high) * 0.5 };
            let change = (next - place).to_f64().abs();
            place = next;
            if change <= LEAST * place.to_f64().abs() {
                break;
            }
        }
        place
    }
}

/// Sums over which a product is distributed.
const LANES: usize = 4;

/// A sum of products of two numbers of 31 digits.
#[derive(Clone, Copy, Default)]
struct Sum {
    high: f64,
    low: f64,
}

impl Sum {
    /// Adds the product of two coefficients.
    #[inline(always)]
    fn add(&mut self, a: &Series, i: usize, b: &Series, j: usize) {
        let product = a.high[i] * b.high[j];
        let exact =
            ((a.head[i] * b.head[j] - product) + a.head[i] * b.tail[j] + a.tail[i] * b.head[j]) + a.tail[i] * b.tail[j];
        let (sum, rest) = two_sum(self.high, product);
        self.high = sum;
        self.low += rest + (exact + (a.high[i] * b.low[j] + a.low[i] * b.high[j]));
    }

    #[inline(always)]
    fn total(self) -> Double {
        let (high, low) = two_sum(self.high, self.low);
        Double::of_parts(high, low)
    }
}
