//! Bounds of errors in text.

/// A positive bound in two digits, rounded up, so that what is stated still bounds.
///
/// ```
/// assert_eq!(export::rounded_up(0.002406), 0.0025);
/// assert_eq!(export::rounded_up(0.0024), 0.0024);
/// ```
pub fn rounded_up(bound: f64) -> f64 {
    let unit = 10_f64.powf(bound.log10().floor() - 1.0);
    // A bound that has two digits itself may be a rounding above them.
    let digits = (bound / unit * (1.0 - 8.0 * f64::EPSILON)).ceil();
    // Through its text it is the number with these digits.
    format!("{:.1e}", digits * unit).parse().unwrap_or(bound)
}
