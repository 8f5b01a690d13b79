//! The page: one HTML file with everything in it but the CSV files beside it.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::content::{Cell, Figure, Part, Section, Table};

const STYLE: &str = include_str!("page.css");

/// Rows from which on a table is folded.
const LONG: usize = 25;
/// Letters from which on the text of a cell is broken into lines.
const WIDE: usize = 25;

/// A section as it came out.
pub(crate) struct Chapter {
    pub(crate) name: &'static str,
    pub(crate) section: Result<Section, String>,
    pub(crate) elapsed: Duration,
}

/// Writes the page and its tables into a folder; where the page is.
pub(crate) fn write(
    folder: &Path,
    facts: &[(&'static str, String)],
    chapters: &[Chapter],
) -> Result<PathBuf, Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    for section in chapters.iter().filter_map(|chapter| chapter.section.as_ref().ok()) {
        for part in &section.parts {
            if let Part::Table(table) | Part::Figure(Figure { data: table, .. }) = part {
                write_csv(&folder.join(file(table)), table)?;
            }
        }
    }
    let index = folder.join("index.html");
    fs::write(&index, page(facts, chapters).into_string())?;
    Ok(index)
}

fn file(table: &Table) -> String {
    format!("{}.csv", table.name)
}

fn write_csv(path: &Path, table: &Table) -> Result<(), Box<dyn Error>> {
    let mut writer = csv::Writer::from_path(path)?;
    writer.write_record(&table.columns)?;
    for row in &table.rows {
        writer.write_record(row.iter().map(exact))?;
    }
    Ok(writer.flush()?)
}

/// All digits.
fn exact(cell: &Cell) -> String {
    match cell {
        Cell::Text(text) => text.clone(),
        Cell::Number(None) => String::new(),
        Cell::Number(Some(number)) if *number == 0.0 || (1e-4..1e7).contains(&number.abs()) => number.to_string(),
        Cell::Number(Some(number)) => format!("{number:e}"),
        Cell::Count(count) => count.to_string(),
    }
}

/// Four significant digits.
fn short(cell: &Cell) -> String {
    match cell {
        Cell::Number(Some(number)) => significant(*number),
        _ => exact(cell),
    }
}

fn significant(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return number.to_string();
    }
    // The exponent after rounding: 9.9996 is 10.00.
    let scientific = format!("{number:.3e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let zeros = |text: &str| match text.split_once('.') {
        Some(_) => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        None => text.to_owned(),
    };
    match exponent.parse::<i32>() {
        Ok(exponent @ -3..=4) => zeros(&format!("{number:.*}", usize::try_from(3 - exponent).unwrap_or(0))),
        _ => format!("{}e{exponent}", zeros(digits)),
    }
}

fn page(facts: &[(&'static str, String)], chapters: &[Chapter]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "microimpact: report" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { "microimpact: report" }
                    p {
                        "Impacts of microspheres by both models of Brach and Dunn (1995). Every picture and table has its
                        numbers as CSV beside this page."
                    }
                    (contents(chapters))
                    (made_with(facts))
                }
                main { @for chapter in chapters { (render(chapter)) } }
            }
        }
    }
}

fn contents(chapters: &[Chapter]) -> Markup {
    html! {
        nav {
            ul {
                @for chapter in chapters {
                    li {
                        @match &chapter.section {
                            Ok(section) => {
                                a href={ "#" (section.name) } { (section.title) }
                                (subsections(section))
                            }
                            Err(_) => a href={ "#" (chapter.name) } { (chapter.name) " (failed)" },
                        }
                    }
                }
            }
        }
    }
}

fn subsections(section: &Section) -> Markup {
    let headings =
        section.parts.iter().filter_map(|part| if let Part::Heading(text) = part { Some(text) } else { None });
    html! {
        ul.subsections { @for heading in headings { li { a href={ "#" (anchor(section, heading)) } { (heading) } } } }
    }
}

/// Where a heading is, by its letters and digits.
fn anchor(section: &Section, heading: &str) -> String {
    let words = heading.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<_> = words.map(str::to_lowercase).collect();
    format!("{}--{}", section.name, words.join("-"))
}

fn made_with(facts: &[(&'static str, String)]) -> Markup {
    html! {
        details {
            summary { "Made with" }
            dl { @for (name, value) in facts { dt { (name) } dd { (value) } } }
        }
    }
}

fn render(chapter: &Chapter) -> Markup {
    match &chapter.section {
        Ok(section) => html! {
            section id=(section.name) {
                h2 { (section.title) }
                @for part in &section.parts {
                    @match part {
                        Part::Heading(text) => h3 id=(anchor(section, text)) { (text) },
                        Part::Text(text) => p { (with_code(text)) },
                        Part::Table(table) => (render_table(table)),
                        Part::Figure(figure) => (render_figure(figure)),
                    }
                }
                p.elapsed { (format!("{:.1} s", chapter.elapsed.as_secs_f64())) }
            }
        },
        Err(error) => html! {
            section.failure id=(chapter.name) {
                h2 { (chapter.name) " failed" }
                pre { (error) }
            }
        },
    }
}

/// Text with code between backticks.
fn with_code(text: &str) -> Markup {
    html! {
        @for (index, piece) in text.split('`').enumerate() {
            @if index % 2 == 1 { code { (piece) } } @else { (piece) }
        }
    }
}

fn render_figure(figure: &Figure) -> Markup {
    html! {
        figure id=(figure.data.name) {
            (PreEscaped(&figure.drawing))
            figcaption { (figure.data.caption) " " (link(&figure.data)) }
        }
    }
}

fn render_table(table: &Table) -> Markup {
    let cells = html! {
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
    };
    html! {
        figure id=(table.name) {
            figcaption { (table.caption) " " (link(table)) }
            @if table.rows.len() < LONG {
                (cells)
            } @else {
                details { summary { (table.rows.len()) " rows" } (cells) }
            }
        }
    }
}

fn has_numbers(table: &Table, column: usize) -> bool {
    table.rows.first().and_then(|row| row.get(column)).is_some_and(|cell| !matches!(cell, Cell::Text(_)))
}

fn render_cell(cell: &Cell) -> Markup {
    match cell {
        Cell::Text(text) => html! { td.wide[text.chars().count() >= WIDE] { (text) } },
        Cell::Number(_) | Cell::Count(_) => html! { td.number { (short(cell)) } },
    }
}

fn link(table: &Table) -> Markup {
    html! { a.csv href=(file(table)) { "CSV" } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_digits() {
        for (number, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-2.8, "-2.8"),
            (0.746_193_2, "0.7462"),
            (9.999_96, "10"),
            (41_714.3, "41714"),
            (0.001_234_56, "0.001235"),
            (4.251_18e-8, "4.251e-8"),
            (-7.5e10, "-7.5e10"),
        ] {
            assert_eq!(significant(number), text);
        }
    }

    #[test]
    fn files_have_all_digits() {
        for number in [0.1 + 0.2, 4.251_184_950_650_474_4e-8, -1e300, 5e-324, 0.0] {
            assert_eq!(exact(&Cell::Number(Some(number))).parse(), Ok(number));
        }
        assert_eq!(exact(&Cell::Number(None)), "");
    }

    #[test]
    fn failed_section_is_on_the_page() {
        let chapter = Chapter { name: "cost", section: Err("no <peer> ran".to_owned()), elapsed: Duration::ZERO };
        let page = page(&[], &[chapter]).into_string();
        assert!(page.contains("<section class=\"failure\" id=\"cost\">") && page.contains("no &lt;peer&gt; ran"));
        assert!(page.contains("href=\"#cost\""));
    }

    #[test]
    fn long_tables_are_folded() {
        let table = |rows: usize| Table {
            name: "t".to_owned(),
            caption: "c".to_owned(),
            columns: vec!["x".to_owned()],
            rows: (0..rows).map(|row| vec![Cell::Count(row as u64)]).collect(),
        };
        assert!(render_table(&table(LONG)).into_string().contains("<details>"));
        assert!(!render_table(&table(LONG - 1)).into_string().contains("<details>"));
    }
}
