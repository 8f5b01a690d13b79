//! Ansys Fluent: a source file of a user-defined function, the boundary condition of particles at a wall.

use std::io::{self, Write};

use crate::Table;

/// The functions, which read the arrays.
const FUNCTIONS: &str = include_str!("fluent.c");

/// Writes the table as arrays of C, and the functions that read them. The boundary condition aborts a particle whose radius or speed is
/// outside the table.
///
/// # Errors
/// Those of the stream.
pub fn write(to: &mut dyn Write, table: &Table) -> io::Result<()> {
    for line in table.heading() {
        writeln!(to, "/* {line} */")?;
    }
    writeln!(to, "#include \"udf.h\"\n#include <math.h>\n")?;
    let curves = &table.curves;
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let begins = curves.iter().scan(0, |begin, curve| {
        *begin += curve.points.len();
        Some(*begin)
    });
    let begins: Vec<_> = [0].into_iter().chain(begins).map(|begin| begin.to_string()).collect();
    writeln!(to, "/* Largest speed of the table, m/s. */\n#define FASTEST {:e}", table.fastest)?;
    writeln!(to, "#define CURVES {}", curves.len())?;
    array(to, "double", "curve_radius", curves.iter().map(|curve| format!("{:e}", curve.radius)))?;
    array(to, "double", "critical_speed", curves.iter().map(|curve| format!("{:e}", curve.critical_speed)))?;
    writeln!(to, "/* Where the points of each curve begin. */")?;
    array(to, "int", "curve_begin", begins.into_iter())?;
    array(to, "double", "point_speed", points().map(|point| format!("{:e}", point.speed)))?;
    array(to, "double", "point_restitution", points().map(|point| format!("{:e}", point.restitution)))?;
    to.write_all(FUNCTIONS.as_bytes())
}

fn array(to: &mut dyn Write, kind: &str, name: &str, numbers: impl Iterator<Item = String>) -> io::Result<()> {
    let numbers: Vec<_> = numbers.map(|number| format!("    {number}")).collect();
    writeln!(to, "static const {kind} {name}[] = {{\n{}\n}};", numbers.join(",\n"))
}
