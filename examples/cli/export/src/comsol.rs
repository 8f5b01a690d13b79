//! COMSOL Multiphysics: the file of an interpolation function, for spheres of one radius.

use std::io::{self, Write};

use crate::{Curve, Point, Table};

/// Writes the first curve of the table in the spreadsheet format: speed and restitution.
///
/// # Errors
/// Those of the stream.
pub fn write(to: &mut dyn Write, table: &Table) -> io::Result<()> {
    for line in table.heading() {
        writeln!(to, "% {line}")?;
    }
    let Some(Curve { radius, critical_speed, points }) = table.curves.first() else { return Ok(()) };
    writeln!(to, "% Spheres of radius {radius:e} m. Critical speed {critical_speed:e} m/s.")?;
    writeln!(
        to,
        "% Interpolation linear; extrapolation \"Specific value\" NaN, so that a faster sphere is an error and has no wrong e. \
         Reflected normal velocity: -e(abs(vn))*vn; freeze if e is 0."
    )?;
    writeln!(to, "% speed_m_s restitution")?;
    writeln!(to, "0 {:e}", points.first().map_or(0.0, |point| point.restitution))?;
    for Point { speed, restitution } in points {
        writeln!(to, "{speed:e} {restitution:e}")?;
    }
    Ok(())
}
