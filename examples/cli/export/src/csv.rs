//! Comma-separated values: a row for each point.

use std::io::{self, Write};

use crate::{Curve, Point, Table};

/// Writes the table, with the columns that the commands read.
///
/// # Errors
/// Those of the stream.
pub fn write(to: &mut dyn Write, table: &Table) -> io::Result<()> {
    writeln!(to, "radius_m,critical_speed_m_s,speed_normal_m_s,overall_restitution")?;
    for Curve { radius, critical_speed, points } in &table.curves {
        for Point { speed, restitution } in points {
            writeln!(to, "{radius:e},{critical_speed:e},{speed:e},{restitution:e}")?;
        }
    }
    Ok(())
}
