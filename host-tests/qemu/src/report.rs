//! The verdict and the tables that a run prints.

use std::fmt::Write;
use std::ops::Range;

use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table, TableComponent};

use crate::answers::{Case, Protocol};
use crate::limits;
use boards::figures::{Figure, Quantity};
use boards::{Board, REFERENCE_CORE};

/// What the verdict states of the rigid body's scenes.
const STATED: [Quantity; 4] = [Quantity::Classify, Quantity::Flash, Quantity::Stack, Quantity::StaticMemory];

/// The outcome of a run in a few lines; what failed is listed after it.
pub(crate) fn verdict(
    protocols: &[(&Board, Protocol)],
    checked: &[Figure],
    figures: &[Figure],
    proved: &[(&Board, bool)],
) -> String {
    let cores: Vec<&str> = protocols.iter().map(|(board, _)| board.core).collect();
    let impacts: usize = protocols.iter().map(|(_, protocol)| protocol.measurements.len()).sum();
    let mut text = format!("Ran {impacts} classifications on {}.\n", cores.join(", "));
    let rigid: Vec<String> = STATED.iter().filter_map(|quantity| largest(checked, *quantity)).collect();
    // Writing to a String cannot fail.
    if !rigid.is_empty() {
        let _ = writeln!(text, "The rigid body, {REFERENCE_CORE}, {}: {}.", limits::SCALAR, rigid.join("; "));
    }
    let absent: Vec<f64> = figures
        .iter()
        .filter(|figure| figure.subject.quantity == Quantity::AbsentTerms)
        .map(|figure| figure.value)
        .collect();
    if !absent.is_empty() {
        let bytes: f64 = absent.iter().sum();
        let _ = writeln!(text, "Terms that a scene leaves out: {bytes} bytes in {} firmwares.", absent.len());
    }
    if !proved.is_empty() {
        let free = proved.iter().filter(|(_, proved)| *proved).count();
        let _ = writeln!(text, "No panicking path in the library: proved on {free} of {} cores.", proved.len());
    }
    text.push_str("Instructions are not cycles. `--details` prints every figure.\n");
    text
}

/// The largest value of a quantity in the rigid body's scenes, with its limit.
fn largest(checked: &[Figure], quantity: Quantity) -> Option<String> {
    let rigid = |figure: &&Figure| {
        let scene = &figure.subject.scene;
        figure.subject.quantity == quantity && table_of(scene) == RIGID_BODY && !limits::is_small(scene)
    };
    let figure = checked.iter().filter(rigid).max_by(|a, b| a.value.total_cmp(&b.value))?;
    let limit = limits::of(&figure.subject.scene, quantity)?;
    Some(format!("{} {} of at most {limit} {}", quantity.name(), quantity.digits(figure.value), quantity.unit()))
}

/// Place of the rigid body's table in the footprint.
const RIGID_BODY: usize = 0;

/// Place of a scene's table in the footprint.
fn table_of(scene: &str) -> usize {
    match scene {
        _ if limits::is_fixed_point(scene) => 3,
        _ if limits::is_simulated(scene) => 1,
        _ if limits::is_table(scene) => 2,
        _ if limits::is_calibration(scene) => 4,
        _ if limits::is_uncertain(scene) => 5,
        _ => RIGID_BODY,
    }
}

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

/// The promises and what became of them, the rigid body's first, then those of the simulation, of tables, of fixed point, of
/// calibrations and of class probabilities; a column for each scene.
pub(crate) fn footprint(checked: &[Figure]) -> String {
    let tables = [0, 1, 2, 3, 4, 5].map(|table| {
        let own: Vec<&Figure> = checked.iter().filter(|figure| table_of(&figure.subject.scene) == table).collect();
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
