//! Power series in the independent variable of a step, and their products.

use crate::double::{Double, split, two_sum};

/// Highest power of a series.
pub(crate) const ORDER: usize = 24;

/// Number of coefficients.
const TERMS: usize = ORDER + 1;

/// A power series.
#[derive(Clone)]
pub(crate) struct Series {
    coefficients: [Coefficient; TERMS],
}

/// A number as its parts, the larger of them split for exact products.
#[derive(Clone, Copy)]
struct Coefficient {
    high: f64,
    low: f64,
    head: f64,
    tail: f64,
}

impl Coefficient {
    const ZERO: Self = Self { high: 0.0, low: 0.0, head: 0.0, tail: 0.0 };

    #[inline(always)]
    fn value(&self) -> Double {
        Double::of_parts(self.high, self.low)
    }
}

impl Series {
    pub(crate) const ZERO: Self = Self { coefficients: [Coefficient::ZERO; TERMS] };

    /// A constant.
    pub(crate) fn constant(value: Double) -> Self {
        let mut series = Self::ZERO;
        series.set(0, value);
        series
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, power: usize, value: Double) {
        let (high, low) = value.parts();
        let (head, tail) = split(high);
        self.coefficients[power] = Coefficient { high, low, head, tail };
    }

    #[inline(always)]
    pub(crate) fn get(&self, power: usize) -> Double {
        self.coefficients[power].value()
    }

    /// Size of a coefficient.
    pub(crate) fn size(&self, power: usize) -> f64 {
        self.coefficients[power].high.abs()
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
        let forwards = self.coefficients[..count].chunks_exact(LANES);
        let backwards = other.coefficients[power + 1 - count..=power].rchunks_exact(LANES);
        for (a, b) in forwards.remainder().iter().zip(backwards.remainder().iter().rev()) {
            sums[0].add(a, b);
        }
        for (a, b) in forwards.zip(backwards) {
            for ((sum, a), b) in sums.iter_mut().zip(a).zip(b.iter().rev()) {
                sum.add(a, b);
            }
        }
        let [a, b, c, d] = sums.map(Sum::total);
        (a + b) + (c + d)
    }

    /// The value at a place.
    #[inline]
    pub(crate) fn at(&self, place: Double) -> Double {
        self.coefficients.iter().rev().fold(Double::ZERO, |value, coefficient| value * place + coefficient.value())
    }

    /// The value at a place to the rounding of f64.
    fn near(&self, place: f64) -> f64 {
        self.coefficients.iter().rev().fold(0.0, |value, coefficient| value * place + coefficient.high)
    }

    /// The derivative there, likewise.
    fn slope_near(&self, place: f64) -> f64 {
        let powers = self.coefficients.iter().enumerate().skip(1).rev();
        powers.fold(0.0, |value, (power, coefficient)| value * place + power as f64 * coefficient.high)
    }

    /// The values of several series at a place.
    pub(crate) fn all_at<const N: usize>(series: &[Self], place: Double) -> [Double; N] {
        let mut values = [Double::ZERO; N];
        for power in (0..TERMS).rev() {
            for (value, series) in values.iter_mut().zip(series) {
                *value = *value * place + series.get(power);
            }
        }
        values
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
        let last = end.to_f64();
        if self.near(last) * sign < 0.0 {
            return Some(self.root(sign, end));
        }
        if self.get(1).to_f64() * sign < 0.0 && self.slope_near(last) * sign > 0.0 {
            let extremum = self.derivative().root(-sign, end);
            if self.at(extremum).to_f64() * sign < 0.0 {
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
    fn add(&mut self, a: &Coefficient, b: &Coefficient) {
        let product = a.high * b.high;
        let exact = ((a.head * b.head - product) + a.head * b.tail + a.tail * b.head) + a.tail * b.tail;
        let (sum, rest) = two_sum(self.high, product);
        self.high = sum;
        self.low += rest + (exact + (a.high * b.low + a.low * b.high));
    }

    #[inline(always)]
    fn total(self) -> Double {
        let (high, low) = two_sum(self.high, self.low);
        Double::of_parts(high, low)
    }
}
