//! The tables that a run prints.

use std::fmt::Write;
use std::ops::Range;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table, TableComponent};

use crate::answers::{Case, Protocol};
use crate::limits;
use boards::figures::{Figure, Quantity};
use boards::{Board, REFERENCE_CORE};

/// Class and instructions of every case, a column for each core.
pub(crate) fn classes(protocols: &[(&Board, Protocol)]) -> String {
    let mut table = new_table();
    let mut header = vec!["scene", "scalar", "impact", "class"];
    header.extend(protocols.iter().map(|(board, _)| board.core));
    table.set_header(header);
    align_right(&mut table, 4..4 + protocols.len());

    let Some((_, first)) = protocols.first() else {
        return String::new();
    };
    for measurement in &first.measurements {
        let case = &measurement.case;
        let mut row =
            vec![case.scene.clone(), case.scalar.clone(), case.impact.clone(), measurement.verdict.class.clone()];
        row.extend(protocols.iter().map(|(_, protocol)| cost(protocol, case)));
        table.add_row(row);
    }
    format!(
        "Classifications, and what they cost\n{table}\n\
         Instructions of a classification + of validating the measured motion before it.\n\
         Instructions are not cycles: a division or a square root counts 1, and there are no wait \
         states.\n"
    )
}

fn cost(protocol: &Protocol, case: &Case) -> String {
    let same = |found: &&crate::answers::Measurement| found.case == *case;
    protocol.measurements.iter().find(same).map_or_else(String::new, |found| {
        let set_up = found.with_set_up.saturating_sub(found.instructions);
        format!("{} + {set_up}", found.instructions)
    })
}

/// The promises and what became of them, the rigid body's first, then those of the simulation, of tables, of fixed point and
/// of calibrations; a column for each scene.
pub(crate) fn footprint(checked: &[Figure]) -> String {
    let place = |scene: &str| match scene {
        _ if limits::is_fixed_point(scene) => 3,
        _ if limits::is_simulated(scene) => 1,
        _ if limits::is_table(scene) => 2,
        _ if limits::is_calibration(scene) => 4,
        _ => 0,
    };
    let tables = [0, 1, 2, 3, 4].map(|table| {
        let own: Vec<&Figure> = checked.iter().filter(|figure| place(&figure.subject.scene) == table).collect();
        footprint_table(&own).to_string()
    });
    format!(
        "Footprint on {REFERENCE_CORE}, {}\n{}\n\
         Instructions are not cycles. Flash: a firmware that validates a scene and motions and classifies them, less the same\n\
         firmware without that. Code and constants, static memory: what the same refers to in a firmware with other scenes,\n\
         between which the compiler shares more and joins less.\n",
        limits::SCALAR,
        tables.join("\n\n"),
    )
}

fn footprint_table(checked: &[&Figure]) -> Table {
    let mut scenes: Vec<&str> = Vec::new();
    let mut quantities: Vec<Quantity> = Vec::new();
    for Figure { subject, .. } in checked {
        if !scenes.contains(&&*subject.scene) {
            scenes.push(&subject.scene);
        }
        if !quantities.contains(&subject.quantity) {
            quantities.push(subject.quantity);
        }
    }
    let mut table = new_table();
    table.set_header(["at most", "limit"].iter().chain(&scenes));
    align_right(&mut table, 1..2 + scenes.len());
    for quantity in quantities {
        let limit = scenes.first().and_then(|scene| limits::of(scene, quantity));
        let limit = limit.map_or_else(|| "-".to_owned(), |limit| limit.to_string());
        let mut row = vec![format!("{}, {}", quantity.name(), quantity.unit()), limit];
        row.extend(scenes.iter().map(|scene| {
            let same = |found: &&&Figure| found.subject.quantity == quantity && found.subject.scene == *scene;
            checked.iter().find(same).map_or_else(String::new, |found| quantity.digits(found.value))
        }));
        table.add_row(row);
    }
    table
}

/// The outcome of the search for panicking paths on each board.
pub(crate) fn panics(proved: &[(&Board, bool)]) -> String {
    let mut text = String::from("Panicking paths in the library\n");
    for (board, proved) in proved {
        let verdict =
            if *proved { "none: the probe links, and does not with one path added" } else { "not proved, see below" };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {:<10}  {verdict}", board.core);
    }
    text
}

pub(crate) fn new_table() -> Table {
    let mut table = Table::new();
    table
        .load_preset(NOTHING)
        .set_style(TableComponent::HeaderLines, '-')
        .set_style(TableComponent::MiddleHeaderIntersections, '-');
    table
}

pub(crate) fn align_right(table: &mut Table, columns: Range<usize>) {
    for column in columns {
        if let Some(column) = table.column_mut(column) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
}
