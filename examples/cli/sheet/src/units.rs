//! Units of columns: which units a quantity may have, and how a header writes them.

/// A unit and what it is in the SI unit of its quantity: 10^`power` times `factor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Its symbol as a text writes it, `g/cm3`.
    pub symbol: &'static str,
    power: i32,
    factor: f64,
}

const fn decimal(symbol: &'static str, power: i32) -> Unit {
    Unit { symbol, power, factor: 1.0 }
}

const fn by(symbol: &'static str, factor: f64) -> Unit {
    Unit { symbol, power: 0, factor }
}

/// rad/s of one revolution per second.
const REVOLUTION: f64 = 2.0 * std::f64::consts::PI;

/// rad/s of one revolution per minute.
const PER_MINUTE: f64 = REVOLUTION / 60.0;

/// Degrees of one radian.
const RADIAN: f64 = 180.0 / std::f64::consts::PI;

/// The units of each quantity, by the unit that the program computes in. Of symbols that differ in capitals only, the commoner
/// is first.
const UNITS: [(&str, &[Unit]); 16] = [
    (
        "m",
        &[
            decimal("m", 0),
            decimal("cm", -2),
            decimal("mm", -3),
            decimal("um", -6),
            decimal("micron", -6),
            decimal("nm", -9),
        ],
    ),
    ("kg/m3", &[decimal("kg/m3", 0), decimal("g/cm3", 3), decimal("g/ml", 3), decimal("kg/l", 3), decimal("g/l", 0)]),
    (
        "m/s",
        &[
            decimal("m/s", 0),
            decimal("cm/s", -2),
            decimal("mm/s", -3),
            decimal("um/s", -6),
            decimal("km/s", 3),
            by("km/h", 1.0 / 3.6),
        ],
    ),
    (
        "rad/s",
        &[
            decimal("rad/s", 0),
            decimal("krad/s", 3),
            decimal("rad/ms", 3),
            decimal("rad/us", 6),
            by("rev/s", REVOLUTION),
            by("rps", REVOLUTION),
            by("rpm", PER_MINUTE),
            by("rev/min", PER_MINUTE),
            by("deg/s", 1.0 / RADIAN),
        ],
    ),
    (
        "Pa",
        &[
            decimal("Pa", 0),
            decimal("kPa", 3),
            decimal("MPa", 6),
            decimal("mPa", -3),
            decimal("GPa", 9),
            decimal("N/m2", 0),
            decimal("N/mm2", 6),
        ],
    ),
    (
        "N",
        &[
            decimal("N", 0),
            decimal("mN", -3),
            decimal("MN", 6),
            decimal("uN", -6),
            decimal("nN", -9),
            decimal("pN", -12),
        ],
    ),
    (
        "N/m",
        &[
            decimal("N/m", 0),
            decimal("mN/m", -3),
            decimal("MN/m", 6),
            decimal("kN/m", 3),
            decimal("uN/m", -6),
            decimal("N/mm", 3),
        ],
    ),
    ("N m", &[decimal("N m", 0), decimal("mN m", -3), decimal("uN m", -6), decimal("nN m", -9), decimal("pN m", -12)]),
    (
        "J",
        &[
            decimal("J", 0),
            decimal("mJ", -3),
            decimal("uJ", -6),
            decimal("nJ", -9),
            decimal("pJ", -12),
            decimal("fJ", -15),
            decimal("aJ", -18),
            decimal("erg", -7),
            by("eV", 1.602_176_634e-19),
        ],
    ),
    (
        "J/m2",
        &[
            decimal("J/m2", 0),
            decimal("mJ/m2", -3),
            decimal("uJ/m2", -6),
            decimal("erg/cm2", -3),
            decimal("N/m", 0),
            decimal("mN/m", -3),
        ],
    ),
    ("s", &[decimal("s", 0), decimal("ms", -3), decimal("us", -6), decimal("ns", -9), decimal("ps", -12)]),
    ("N s", &[decimal("N s", 0), decimal("mN s", -3), decimal("uN s", -6), decimal("nN s", -9), decimal("pN s", -12)]),
    (
        "kg",
        &[
            decimal("kg", 0),
            decimal("g", -3),
            decimal("mg", -6),
            decimal("ug", -9),
            decimal("ng", -12),
            decimal("pg", -15),
            decimal("fg", -18),
        ],
    ),
    ("deg", &[decimal("deg", 0), by("rad", RADIAN)]),
    ("rad", &[decimal("rad", 0), by("deg", 1.0 / RADIAN)]),
    ("1", &[decimal("1", 0), decimal("%", -2), decimal("percent", -2)]),
];

/// The units of the quantity that the program computes in the unit `si`.
pub(crate) fn units_of(si: &str) -> &'static [Unit] {
    UNITS.iter().find(|(unit, _)| *unit == si).map_or(&[], |(_, units)| units)
}

/// Whether a text is a unit of any quantity, as in a row of units below a header.
pub(crate) fn is_unit(text: &str) -> bool {
    let written = Written::of(text);
    UNITS.iter().flat_map(|(_, units)| *units).any(|unit| written.is(unit.symbol, false))
}

/// The unit of a quantity with this text, as in brackets or in a row of units.
pub(crate) fn unit_in(units: &'static [Unit], text: &str) -> Option<Unit> {
    let written = Written::of(text);
    let with = |capitals: bool| units.iter().find(|unit| written.is(unit.symbol, capitals));
    with(true).or_else(|| with(false)).copied()
}

/// The unit of a quantity with this end of a column's name, in lower case: `g_cm3`.
pub(crate) fn unit_by_suffix(units: &'static [Unit], suffix: &str) -> Option<Unit> {
    units.iter().find(|unit| unit.suffix() == suffix).copied()
}

impl Unit {
    /// How the unit ends the name of a column: `g_cm3`.
    pub(crate) fn suffix(&self) -> String {
        self.symbol.replace(['/', ' '], "_").to_lowercase()
    }

    /// Whether numbers have it that the program computes with.
    pub(crate) fn is_si(&self) -> bool {
        self.power == 0 && self.factor == 1.0
    }

    /// The text of a number in the SI unit, from that of a number in this unit with a decimal point. A power of ten changes the
    /// exponent only, so that 5.06 um is the same number as 5.06e-6 m.
    pub(crate) fn in_si(&self, text: &str) -> Option<String> {
        if self.factor != 1.0 {
            let value: f64 = text.parse().ok()?;
            return Some(format!("{:e}", value * self.factor));
        }
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        mantissa.parse::<f64>().ok()?;
        let exponent: i32 = exponent.parse().ok()?;
        Some(format!("{mantissa}e{}", exponent.checked_add(self.power)?))
    }
}

/// A unit as somebody wrote it: `kg m-3`, `kg/m^3`, `kg·m⁻³`.
struct Written {
    above: Vec<String>,
    below: Vec<String>,
}

impl Written {
    fn of(text: &str) -> Self {
        let plain = plain(text.trim());
        let (mut above, mut below) = (Vec::new(), Vec::new());
        let mut divided = false;
        for part in plain.split_inclusive(['/', ' ', '*', '_']) {
            let factor = part.trim_end_matches(['/', ' ', '*', '_']);
            if !factor.is_empty() {
                match factor.split_once('-') {
                    Some((unit, power)) if !unit.is_empty() => {
                        below.push(if power == "1" { unit.to_owned() } else { format!("{unit}{power}") });
                    }
                    _ if divided => below.push(factor.to_owned()),
                    _ => above.push(factor.to_owned()),
                }
            }
            divided |= part.ends_with('/');
        }
        Self { above, below }
    }

    /// Whether it is the unit with this symbol, by capitals too or not.
    fn is(&self, symbol: &str, capitals: bool) -> bool {
        let (above, below) = symbol.split_once('/').unwrap_or((symbol, ""));
        let same = |written: &[String], symbol: &str| {
            let mut factors = symbol.split(' ').filter(|factor| !factor.is_empty());
            let all = written.iter().all(|text| {
                factors
                    .next()
                    .is_some_and(|factor| if capitals { factor == text } else { factor.eq_ignore_ascii_case(text) })
            });
            all && factors.next().is_none()
        };
        same(&self.above, above) && same(&self.below, below)
    }
}

/// A text with a unit in plain characters.
pub(crate) fn plain(text: &str) -> String {
    text.replace('°', "deg").chars().filter_map(plain_character).collect()
}

/// The plain character for one in a unit; `None` for one that is left out.
fn plain_character(character: char) -> Option<char> {
    match character {
        'µ' | 'μ' => Some('u'),
        '²' => Some('2'),
        '³' => Some('3'),
        '¹' => Some('1'),
        '⁻' | '−' => Some('-'),
        '·' | '⋅' | '.' => Some(' '),
        '^' | '[' | ']' | '(' | ')' => None,
        other => Some(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same number as if it had been written in SI units.
    #[test]
    fn powers_of_ten_are_exact() {
        let um = unit_in(units_of("m"), "µm").unwrap();
        for (text, si) in [("5.06", 5.06e-6), ("0.1", 1e-7), ("1.7e2", 1.7e-4), ("-3", -3e-6)] {
            assert_eq!(um.in_si(text).unwrap().parse::<f64>().unwrap(), si, "{text}");
        }
        assert_eq!(um.in_si("x"), None);
    }

    #[test]
    fn units_in_all_spellings() {
        for (si, text, symbol) in [
            ("kg/m3", "kg m-3", "kg/m3"),
            ("kg/m3", "kg·m⁻³", "kg/m3"),
            ("kg/m3", "(g/cm^3)", "g/cm3"),
            ("m/s", "m s-1", "m/s"),
            ("m/s", "CM/S", "cm/s"),
            ("Pa", "mPa", "mPa"),
            ("Pa", "mpa", "MPa"),
            ("N/m", "mN/m", "mN/m"),
            ("J/m2", "mJ m^-2", "mJ/m2"),
            ("N m", "N m", "N m"),
            ("m", "Micron", "micron"),
            ("deg", "°", "deg"),
            ("rad/s", "°/s", "deg/s"),
        ] {
            assert_eq!(unit_in(units_of(si), text).map(|unit| unit.symbol), Some(symbol), "{text}");
        }
        // A strength of the ring is no moment.
        assert_eq!(unit_in(units_of("N/m"), "N m"), None);
        assert_eq!(unit_in(units_of("m"), "m/s"), None);
        assert_eq!(unit_by_suffix(units_of("m"), "micron").map(|unit| unit.symbol), Some("micron"));
        assert_eq!(unit_by_suffix(units_of("kg/m3"), "g_cm3").map(|unit| unit.symbol), Some("g/cm3"));
    }
}
