//! Curves of several radii.

use crate::{Curve, rounded_up};

/// Restitution against approach speed, of spheres of several radii on one surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// The materials, in a line of text.
    pub subject: String,
    /// Largest error of restitution between two points of a curve.
    pub tolerance: f64,
    /// Largest speed of the table, m/s. A curve may go on beyond it, for radii between two.
    pub fastest: f64,
    /// Curves in the order of their radii; at least one.
    pub curves: Vec<Curve>,
    /// Errors between two radii; `None` for one curve.
    pub between_radii: Option<Difference>,
}

/// How far a table is from the curve of another radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Difference of the critical speeds, relative to that of the curve.
    pub critical_speed: f64,
    /// Largest difference of the restitutions at the same multiples of the critical speeds.
    pub restitution: f64,
}

impl Difference {
    /// The larger of two, each by itself.
    pub fn max(self, other: Self) -> Self {
        Self {
            critical_speed: self.critical_speed.max(other.critical_speed),
            restitution: self.restitution.max(other.restitution),
        }
    }
}

/// The curves beside a radius, and the part of the way from the first to the second.
type Beside<'a> = (&'a Curve, &'a Curve, f64);

impl Table {
    /// The curves beside a radius, or twice that of the radius; `None` if the radius is outside the table.
    fn beside(&self, radius: f64) -> Option<Beside<'_>> {
        let after = self.curves.partition_point(|curve| curve.radius < radius);
        let to = self.curves.get(after)?;
        let from = match after.checked_sub(1) {
            Some(before) => self.curves.get(before)?,
            None if to.radius == radius => to,
            None => return None,
        };
        let part =
            if from.radius < to.radius { (radius / from.radius).ln() / (to.radius / from.radius).ln() } else { 0.0 };
        Some((from, to, part))
    }

    /// The critical speed of a sphere: a power of the radius between two radii. Zero if spheres of one of them have none; `None` if the
    /// radius is outside the table.
    pub fn critical_speed(&self, radius: f64) -> Option<f64> {
        let (from, to, part) = self.beside(radius)?;
        let (slow, fast) = (from.critical_speed, to.critical_speed);
        Some(if slow > 0.0 && fast > 0.0 { (slow.ln() + part * (fast / slow).ln()).exp() } else { 0.0 })
    }

    /// The restitution of a sphere: between two radii it is that of both curves at the same multiple of the critical speed,
    /// in proportion to the logarithm of the radius. `None` if the radius is outside the table.
    pub fn at(&self, radius: f64, speed: f64) -> Option<f64> {
        let (from, to, part) = self.beside(radius)?;
        let critical = self.critical_speed(radius)?;
        let of = |curve: &Curve| curve.at(if critical > 0.0 { speed / critical * curve.critical_speed } else { speed });
        Some((1.0 - part) * of(from) + part * of(to))
    }

    /// The difference from another curve, at its points and halfway between them; `None` if its radius is outside the table.
    pub fn difference(&self, curve: &Curve) -> Option<Difference> {
        let critical = self.critical_speed(curve.radius)?;
        let is_captured = curve.critical_speed > 0.0 && critical > 0.0;
        let multiple = if is_captured { critical / curve.critical_speed } else { 1.0 };
        let speeds = curve.points.iter().map(|point| point.speed);
        let halves = curve.points.windows(2).map(|two| (two[0].speed + two[1].speed) / 2.0);
        let mut restitution = 0.0_f64;
        for speed in speeds.chain(halves) {
            restitution = restitution.max((self.at(curve.radius, speed * multiple)? - curve.at(speed)).abs());
        }
        Some(Difference { critical_speed: (multiple - 1.0).abs(), restitution })
    }

    /// The radii and speeds that the table covers, and the spheres that are captured at all of these speeds, in words.
    pub fn range_in_words(&self) -> String {
        let (Some(smallest), Some(largest)) = (self.curves.first(), self.curves.last()) else { return String::new() };
        let fastest = self.fastest;
        let radii = if smallest.radius < largest.radius {
            format!("radii from {:e} to {:e} m", smallest.radius, largest.radius)
        } else {
            format!("the radius {:e} m alone", smallest.radius)
        };
        let captured = self.curves.iter().rfind(|curve| curve.critical_speed >= fastest);
        let captured = captured.map_or_else(String::new, |curve| {
            format!("; spheres of radius {:e} m are captured at all of these speeds", curve.radius)
        });
        format!("It holds {radii}, and approach speeds up to {fastest} m/s{captured}.")
    }

    /// What the table holds, in lines of text for the head of a file.
    pub(crate) fn heading(&self) -> Vec<String> {
        let Self { subject, tolerance, .. } = self;
        let mut lines = vec![
            format!("Restitution e against approach speed in m/s: {subject}."),
            format!(
                "Linear between the points, with an error of e up to {tolerance}. The first speed is critical if its e is 0."
            ),
            self.range_in_words(),
        ];
        if let Some(Difference { critical_speed, restitution }) = self.between_radii {
            let (percent, restitution) = (rounded_up(100.0 * critical_speed), rounded_up(restitution));
            lines.push(format!(
                "Between two radii the error of the critical speed is up to {percent} %, and that of e up to {restitution} \
                 at the same multiple of the critical speed."
            ));
        }
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Point;

    fn curve(radius: f64, critical_speed: f64, restitution: f64) -> Curve {
        let points = [(1.0, 0.0), (2.0, restitution)]
            .map(|(multiple, restitution)| Point { speed: multiple * critical_speed, restitution });
        Curve { radius, critical_speed, points: points.into() }
    }

    #[test]
    fn between_radii_the_critical_speed_is_a_power_of_the_radius() {
        let curves = vec![curve(1e-6, 8.0, 0.4), curve(4e-6, 2.0, 0.8)];
        let table = Table { subject: String::new(), tolerance: 0.01, fastest: 12.0, curves, between_radii: None };
        let at = |radius, speed| table.at(radius, speed).unwrap();
        assert!((table.critical_speed(2e-6).unwrap() - 4.0).abs() < 1e-12);
        assert!((at(2e-6, 6.0) - 0.3).abs() < 1e-12 && at(2e-6, 3.9).abs() < 1e-12);
        assert!((at(1e-6, 12.0) - 0.2).abs() < 1e-12 && (at(4e-6, 3.0) - 0.4).abs() < 1e-12);
        for outside in [0.99e-6, 4.01e-6, f64::NAN] {
            assert_eq!((table.at(outside, 3.0), table.critical_speed(outside)), (None, None));
        }
        let found = table.difference(&curve(2e-6, 5.0, 0.7)).unwrap();
        assert!((found.critical_speed - 0.2).abs() < 1e-12 && (found.restitution - 0.1).abs() < 1e-12, "{found:?}");
    }
}
