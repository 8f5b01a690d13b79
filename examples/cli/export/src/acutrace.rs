//! AcuTrace: the boundary condition of a wall, for spheres of one radius.

use std::io::{self, Write};

use crate::{Curve, Point, Table};

/// Writes the first curve of the table as a command of the trace input file; the user enters the name of the surface.
///
/// A coefficient of AcuTrace does not depend on the radius. Restitution zero does not hold a particle: it slides on along the wall.
///
/// # Errors
/// Those of the stream.
pub fn write(to: &mut dyn Write, table: &Table) -> io::Result<()> {
    for line in table.heading() {
        writeln!(to, "# {line}")?;
    }
    let Some(Curve { radius, points, .. }) = table.curves.first() else { return Ok(()) };
    writeln!(
        to,
        "# Spheres of radius {radius:e} m. A captured sphere has e = 0: it keeps its velocity along the wall. \
         Check that no sphere is faster than the table: AcuTrace would take its last e."
    )?;
    writeln!(to, "FINITE_MASS_BOUNDARY_CONDITION( \"microimpact\" ) {{")?;
    writeln!(to, "    particle_surface         = \"wall\"")?;
    writeln!(to, "    wall_type                = reflect")?;
    writeln!(to, "    wall_en_type             = piecewise_linear")?;
    write!(to, "    wall_en_curve_fit_values = {{ 0, {:e}", points.first().map_or(0.0, |point| point.restitution))?;
    for Point { speed, restitution } in points {
        write!(to, " ;\n                                 {speed:e}, {restitution:e}")?;
    }
    writeln!(to, " ; }}\n}}")
}
