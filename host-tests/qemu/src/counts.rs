//! `cargo qemu --counts`: one row for each scene, number type and core, with the largest figures of all its impacts.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::io;

use boards::BOARDS;
use boards::absent::{PROOFS, Proof};
use boards::figures::{Figure, Quantity};

use crate::report;

/// What stands in a row.
const QUANTITIES: [Quantity; 6] = [
    Quantity::Classify,
    Quantity::SetUpAndClassify,
    Quantity::Code,
    Quantity::Stack,
    Quantity::StaticMemory,
    Quantity::Error,
];

/// Scene, number type and place of the core in [`BOARDS`].
type Key<'a> = (&'a str, &'a str, usize);

/// As text.
pub(crate) fn table(figures: &[Figure]) -> String {
    let mut table = report::new_table();
    let names = QUANTITIES.map(|quantity| format!("{}, {}", quantity.name(), quantity.unit()));
    table.set_header(["scene", "scalar", "core"].into_iter().map(str::to_owned).chain(names));
    report::align_right(&mut table, 3..3 + QUANTITIES.len());
    for ((scene, scalar, board), values) in rows(figures) {
        let texts = QUANTITIES.iter().zip(values);
        let texts = texts.map(|(quantity, value)| value.map_or_else(String::new, |value| quantity.digits(value)));
        table.add_row([scene, scalar, BOARDS[board].core].into_iter().map(str::to_owned).chain(texts));
    }
    format!(
        "What each scene costs on each core\n{table}\n\
         Instructions are not cycles. Classify: a classification; set up: the validation of the measured motion too. Code and\n\
         constants: all that setting up the scene and both of these refer to, routines of the compiler included; a firmware\n\
         with this scene alone is up to some hundred bytes smaller. Stack: painted, and looked for the deepest change. Error:\n\
         of the restitution against the solution in f64 on the host, or, of rigid bodies, of the margins, relative.\n"
    )
}

/// What the terms that a scene does not use cost it.
pub(crate) fn absent_terms(figures: &[Figure]) -> String {
    let mut text =
        String::from("Bytes that differ from the firmware of a library in which absent terms do not exist\n");
    for Figure { subject, value } in figures.iter().filter(|figure| figure.subject.quantity == Quantity::AbsentTerms) {
        let proof = PROOFS.iter().find(|proof| proof.scene == subject.scene);
        let absent = proof.map(Proof::absent).unwrap_or_default();
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {:<10}  {value} in {}, without {absent}", subject.core, subject.scene);
    }
    text
}

/// As CSV.
pub(crate) fn write(compiler: &str, figures: &[Figure], destination: impl io::Write) -> Result<(), String> {
    let mut writer = csv::Writer::from_writer(destination);
    let names = QUANTITIES.map(|quantity| format!("{} ({})", quantity.name(), quantity.unit()));
    let header = ["compiler", "core", "scene", "scalar"].into_iter().map(str::to_owned).chain(names);
    let write = || {
        writer.write_record(header)?;
        for ((scene, scalar, board), values) in rows(figures) {
            let texts = values.map(|value| value.map_or_else(String::new, |value| value.to_string()));
            let names = [compiler, BOARDS[board].core, scene, scalar].into_iter().map(str::to_owned);
            writer.write_record(names.chain(texts))?;
        }
        writer.flush()?;
        Ok(())
    };
    write().map_err(|error: csv::Error| error.to_string())
}

/// The scenes that ran on a board, with the largest figure of each quantity.
fn rows(figures: &[Figure]) -> BTreeMap<Key<'_>, [Option<f64>; QUANTITIES.len()]> {
    let mut rows: BTreeMap<Key<'_>, [Option<f64>; QUANTITIES.len()]> = BTreeMap::new();
    for Figure { subject, value } in figures {
        let column = QUANTITIES.iter().position(|quantity| *quantity == subject.quantity);
        let board = BOARDS.iter().position(|board| board.core == subject.core);
        if let (Some(column), Some(board)) = (column, board) {
            let largest = &mut rows.entry((&subject.scene, &subject.scalar, board)).or_default()[column];
            *largest = Some(largest.map_or(*value, |known| known.max(*value)));
        }
    }
    // What is built for flash alone does not run.
    rows.retain(|_, values| values[0].is_some());
    rows
}
