//! Monotone interpolation by piecewise cubics (Fritsch and Carlson 1980, SIAM J. Numer. Anal. 17:238).

/// A rising function through given points, continued by straight lines.
#[derive(Clone, Debug)]
pub struct Monotone {
    x: Vec<f64>,
    y: Vec<f64>,
    slope: Vec<f64>,
}

impl Monotone {
    /// The function through points of rising `x` and rising `y`, at least two.
    pub fn through(x: Vec<f64>, y: Vec<f64>) -> Self {
        let secant: Vec<f64> = (1..x.len()).map(|i| (y[i] - y[i - 1]) / (x[i] - x[i - 1])).collect();
        let last = x.len() - 1;
        let end = |near: usize, next: usize, width: [f64; 2]| {
            // The parabola through three points, kept monotone.
            let slope = ((2.0 * width[0] + width[1]) * secant[near] - width[0] * secant[next]) / (width[0] + width[1]);
            slope.clamp(0.0, 3.0 * secant[near].max(0.0))
        };
        let slope = (0..x.len()).map(|i| {
            if last < 2 {
                secant[0]
            } else if i == 0 {
                end(0, 1, [x[1] - x[0], x[2] - x[1]])
            } else if i == last {
                end(last - 1, last - 2, [x[last] - x[last - 1], x[last - 1] - x[last - 2]])
            } else {
                let (left, right) = (secant[i - 1], secant[i]);
                let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
                let (first, second) = (before + 2.0 * after, 2.0 * before + after);
                if left * right <= 0.0 { 0.0 } else { (first + second) / (first / left + second / right) }
            }
        });
        let slope = slope.collect();
        Self { x, y, slope }
    }

    /// Value and derivative.
    pub fn at(&self, x: f64) -> (f64, f64) {
        let last = self.x.len() - 1;
        if x <= self.x[0] {
            return (self.y[0] + self.slope[0] * (x - self.x[0]), self.slope[0]);
        }
        if x >= self.x[last] {
            return (self.y[last] + self.slope[last] * (x - self.x[last]), self.slope[last]);
        }
        let right = self.x.partition_point(|node| *node <= x).clamp(1, last);
        let left = right - 1;
        let width = self.x[right] - self.x[left];
        let t = (x - self.x[left]) / width;
        let rise = self.y[right] - self.y[left];
        let (a, b) = (width * self.slope[left] - rise, rise - width * self.slope[right]);
        let value = self.y[left] + t * rise + t * (1.0 - t) * (a * (1.0 - t) + b * t);
        let slope = rise + (1.0 - 2.0 * t) * (a * (1.0 - t) + b * t) + t * (1.0 - t) * (b - a);
        (value, slope / width)
    }
}

#[cfg(test)]
mod tests {
    use super::Monotone;

    #[test]
    fn a_smooth_function_and_its_derivative() {
        let x: Vec<f64> = (0..=40).map(|i| 0.1 * f64::from(i)).collect();
        let y = x.iter().map(|x| x.exp()).collect();
        let curve = Monotone::through(x, y);
        for x in [0.03_f64, 0.77, 2.345, 3.99] {
            let (value, slope) = curve.at(x);
            assert!((value / x.exp() - 1.0).abs() < 1e-4, "{x} {value}");
            assert!((slope / x.exp() - 1.0).abs() < 4e-3, "{x} {slope}");
        }
    }

    #[test]
    fn steps_stay_monotone() {
        let curve = Monotone::through(vec![0.0, 1.0, 2.0, 3.0, 4.0], vec![0.0, 0.0, 1.0, 1.0, 1.0]);
        let values: Vec<f64> = (0..=400).map(|i| curve.at(0.01 * f64::from(i)).0).collect();
        assert!(values.windows(2).all(|pair| pair[1] >= pair[0]));
    }
}
