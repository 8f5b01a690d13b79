//! Paragraphs, tables, figures and folds as HTML.

use maud::{Markup, PreEscaped, html};

use super::numbers::short;
use crate::content::{Cell, Figure, Part, Table};

/// Letters from which on the text of a cell is broken into lines.
const WIDE: usize = 25;
/// Columns from which on a table takes the whole width.
const MANY_COLUMNS: usize = 6;

pub(super) fn render_parts(parts: &[Part]) -> Markup {
    html! {
        @for part in parts {
            @match part {
                Part::Text(text) => p { (with_code(text)) },
                Part::Table(table) => (render_table(table)),
                Part::Figure(figure) => (render_figure(figure)),
                Part::Fold(line, parts) => details {
                    summary { (line) }
                    div.parts { (render_parts(parts)) }
                },
            }
        }
    }
}

/// Text with code between backticks.
pub(super) fn with_code(text: &str) -> Markup {
    html! {
        @for (index, piece) in text.split('`').enumerate() {
            @if index % 2 == 1 { code { (piece) } } @else { (piece) }
        }
    }
}

fn render_figure(figure: &Figure) -> Markup {
    html! {
        figure id=(figure.data.name) {
            b { (figure.title) }
            (PreEscaped(&figure.drawing))
            figcaption { (with_code(&figure.data.caption)) " " (link(&figure.data)) }
        }
    }
}

fn render_table(table: &Table) -> Markup {
    html! {
        figure.wide[table.columns.len() >= MANY_COLUMNS] id=(table.name) {
            figcaption { (with_code(&table.caption)) " " (link(table)) }
            div.scroll tabindex="0" {
                table {
                    thead {
                        tr {
                            @for (index, column) in table.columns.iter().enumerate() {
                                th.number[has_numbers(table, index)] scope="col" { (column) }
                            }
                        }
                    }
                    tbody {
                        @for row in &table.rows {
                            tr { @for cell in row { (render_cell(cell)) } }
                        }
                    }
                }
            }
        }
    }
}

fn has_numbers(table: &Table, column: usize) -> bool {
    let cell = table.rows.first().and_then(|row| row.get(column));
    cell.is_some_and(|cell| matches!(cell, Cell::Number(_) | Cell::Count(_)))
}

fn render_cell(cell: &Cell) -> Markup {
    match cell {
        Cell::Text(text) => html! { td.wide[text.chars().count() >= WIDE] { (text) } },
        Cell::Link(text, address) => html! { td { a href=(address) { (text) } } },
        Cell::Number(_) | Cell::Count(_) => html! { td.number { (short(cell)) } },
    }
}

pub(super) fn link(table: &Table) -> Markup {
    html! { a.csv href=(file(table)) { "CSV" } }
}

/// The name of a table's file, beside the page.
pub(super) fn file(table: &Table) -> String {
    format!("{}.csv", table.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::Section;

    #[test]
    fn folded_parts_are_on_the_page_and_among_the_tables() {
        let table = Table { name: "t".to_owned(), caption: "c".to_owned(), columns: Vec::new(), rows: Vec::new() };
        let parts = vec![Part::Fold("all rows".to_owned(), vec![Part::Table(table)])];
        let section = Section { parts, ..Section::default() };
        assert_eq!(section.tables().len(), 1);
        let page = render_parts(&section.parts).into_string();
        assert!(page.starts_with("<details><summary>all rows</summary>") && page.contains("href=\"t.csv\""));
    }
}
