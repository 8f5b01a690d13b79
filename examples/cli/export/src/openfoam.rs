//! OpenFOAM: a dictionary with a table for each radius.

use std::io::{self, Write};

use crate::{Curve, Point, Table};

const HEADER: [(&str, &str); 4] =
    [("version", "2.0"), ("format", "ascii"), ("class", "dictionary"), ("object", "restitutionProperties")];

/// Writes the table as a dictionary: an entry for each radius, with `radius`, `criticalSpeed` and `restitution`, a `Function1` of
/// the approach speed, which is an error beyond the table.
///
/// # Errors
/// Those of the stream.
pub fn write(to: &mut dyn Write, table: &Table) -> io::Result<()> {
    writeln!(to, "FoamFile\n{{")?;
    for (key, value) in HEADER {
        writeln!(to, "    {key:<11} {value};")?;
    }
    writeln!(to, "}}\n")?;
    for line in table.heading() {
        writeln!(to, "// {line}")?;
    }
    for (number, Curve { radius, critical_speed, points }) in table.curves.iter().enumerate() {
        writeln!(to, "\nradius{number}\n{{\n    radius          {radius:e};")?;
        writeln!(
            to,
            "    criticalSpeed   {critical_speed:e};\n    restitution     table;\n    restitutionCoeffs\n    {{"
        )?;
        writeln!(to, "        outOfBounds error;\n        values\n        (")?;
        writeln!(to, "            (0 {:e})", points.first().map_or(0.0, |point| point.restitution))?;
        for Point { speed, restitution } in points {
            writeln!(to, "            ({speed:e} {restitution:e})")?;
        }
        writeln!(to, "        );\n    }}\n}}")?;
    }
    Ok(())
}
