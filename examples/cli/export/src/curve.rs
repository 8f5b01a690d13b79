//! The restitution of spheres of one radius, as points between which it is linear.

/// The restitution at an approach speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Approach speed, m/s.
    pub speed: f64,
    /// Restitution, from 0 to 1.
    pub restitution: f64,
}

/// The restitution of spheres of one radius against the approach speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Radius of the spheres, m.
    pub radius: f64,
    /// Speed below which they are captured, m/s; zero if they rebound from every speed.
    pub critical_speed: f64,
    /// Points in the order of their speeds. The first is that of capture, if there is a critical speed.
    pub points: Vec<Point>,
}

/// The least distance of two points over the critical speed. Restitution begins as a square root of the speed beyond it; at
/// this distance it is about a ten-thousandth.
const LEAST_DISTANCE: f64 = 1e-8;

/// The slowest speed over the fastest, of spheres without a critical speed.
const SLOWEST: f64 = 1e-4;

/// The most halvings of an interval: enough for twelve decades of speeds.
const MOST_HALVINGS: u32 = 40;

/// Places in an interval, as fractions of it, where the line is compared with the restitution. A square root deviates most from
/// its line at the first, and a parabola at the second.
const PLACES: [f64; 3] = [0.25, 0.5, 0.75];

/// The deviation at these places, over the tolerance, that is allowed: the largest one may lie between them.
const ALLOWED: f64 = 0.9;

impl Curve {
    /// A curve up to the fastest speed, in as many points as keep the error of restitution below a tolerance between them.
    ///
    /// # Errors
    /// The first error of `restitution`.
    pub fn new<E>(
        radius: f64,
        critical_speed: f64,
        fastest: f64,
        tolerance: f64,
        mut restitution: impl FnMut(f64) -> Result<f64, E>,
    ) -> Result<Self, E> {
        let mut point = |speed: f64| Ok(Point { speed, restitution: restitution(speed)? });
        let first = if critical_speed > 0.0 {
            Point { speed: critical_speed, restitution: 0.0 }
        } else {
            point(SLOWEST * fastest)?
        };
        let mut points = vec![first];
        if critical_speed < fastest {
            let least = LEAST_DISTANCE * first.speed;
            let end = point(fastest)?;
            let mut ends = vec![(end, 0)];
            let mut from = first;
            while let Some((to, halvings)) = ends.pop() {
                let mut deviation = 0.0_f64;
                for place in PLACES {
                    let at = from.speed + place * (to.speed - from.speed);
                    deviation = deviation.max((between(from, to, at) - point(at)?.restitution).abs());
                }
                if deviation <= ALLOWED * tolerance || halvings == MOST_HALVINGS || to.speed - from.speed < least {
                    points.push(to);
                    from = to;
                } else {
                    ends.push((to, halvings + 1));
                    ends.push((point(middle(from.speed, to.speed, first.speed))?, halvings + 1));
                }
            }
        }
        Ok(Self { radius, critical_speed, points })
    }

    /// The restitution at a speed: zero up to the critical speed, linear between points, and beyond them that of the last or
    /// the first.
    pub fn at(&self, speed: f64) -> f64 {
        if speed <= self.critical_speed {
            return 0.0;
        }
        let after = self.points.partition_point(|point| point.speed < speed);
        match (after.checked_sub(1).and_then(|before| self.points.get(before)), self.points.get(after)) {
            (Some(&from), Some(&to)) => between(from, to, speed),
            (Some(point), None) | (None, Some(point)) => point.restitution,
            (None, None) => 0.0,
        }
    }
}

/// Where to divide an interval: near the first speed of a curve in the distance from that speed, and far from it in the
/// logarithm of that distance.
fn middle(from: f64, to: f64, first: f64) -> f64 {
    let (from, to) = (from - first, to - first);
    // A square root is divided best at a quarter of its interval.
    first + if from == 0.0 { to / 4.0 } else { (from * to).sqrt() }
}

fn between(from: Point, to: Point, speed: f64) -> f64 {
    let part = (speed - from.speed) / (to.speed - from.speed);
    from.restitution + part * (to.restitution - from.restitution)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R = k/(k + v) with a work of adhesion, so that e is zero at the critical speed.
    fn law(critical: f64) -> impl Fn(f64) -> Result<f64, ()> {
        move |speed| Ok(130.0 / (130.0 + speed) * (1.0 - (critical / speed).powi(2)).max(0.0).sqrt())
    }

    #[test]
    fn the_error_between_points_is_within_the_tolerance() {
        for (critical, tolerance) in [(1.4, 2e-3), (0.01, 1e-3), (50.0, 1e-2), (0.0, 1e-3)] {
            let curve = Curve::new(1e-6, critical, 100.0, tolerance, law(critical)).unwrap();
            assert!(curve.points.is_sorted_by(|a, b| a.speed < b.speed));
            assert!(curve.points.len() < 100, "{}", curve.points.len());
            for k in 0..20_000 {
                let speed = critical.max(0.02) * (1.0 + 1e-9 * 1e11_f64.powf(f64::from(k) / 20_000.0));
                let error = (curve.at(speed) - law(critical)(speed.min(100.0)).unwrap()).abs();
                assert!(speed > 100.0 || error <= tolerance, "{critical} {speed} {error}");
            }
            let slow = curve.at((critical / 2.0).max(1e-6));
            assert!(if critical > 0.0 { slow == 0.0 } else { (slow - 1.0).abs() <= tolerance });
            assert_eq!(curve.at(1e5), curve.points.last().unwrap().restitution);
        }
    }

    #[test]
    fn spheres_that_are_all_captured_have_one_point() {
        let curve = Curve::new(1e-6, 200.0, 100.0, 1e-3, law(200.0)).unwrap();
        assert_eq!(curve.points, [Point { speed: 200.0, restitution: 0.0 }]);
        assert_eq!((curve.at(150.0), curve.at(300.0)), (0.0, 0.0));
    }

    #[test]
    fn an_error_is_handed_on() {
        assert_eq!(Curve::new(1e-6, 1.0, 10.0, 1e-3, |_| Err("no answer")), Err("no answer"));
    }
}
