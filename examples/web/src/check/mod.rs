//! The page in a browser: its answers are those of the program, to the last digit.

mod sliders;
pub mod tables;

use std::fs;
use std::path::Path;

use boards::firmware::repository;
use boards::packages::{self, Permission};
use clap::Parser;
use microimpact_cli::{Arguments, Streams};
use serde_json::json;

use crate::browser::Browser;
use crate::screenshots;

/// Whether the page shows the answer to what the user set last.
pub const READY: &str = "document.getElementById('answer').ariaBusy === 'false'";

/// Checks the page in Chromium, and writes screenshots beside it.
pub fn page(file: &Path, permission: Permission) -> Result<(), String> {
    packages::find("chromium", &["chromium"], "", permission)?;
    let folder = file.with_file_name("browser");
    let mut browser = Browser::start("chromium", &folder)?;
    browser.open(file, (1280, 900), "light")?;
    browser.wait_for(READY)?;

    let cases = data("cases.csv")?;
    sliders::units(&mut browser)?;
    sliders::first_answer(&mut browser)?;
    sliders::keyboard(&mut browser)?;
    sliders::names_of_controls(&mut browser)?;
    sliders::every_term(&mut browser)?;
    sliders::refusal(&mut browser)?;
    sliders::rigid_body(&mut browser)?;
    sliders::materials(&mut browser)?;
    sliders::angle_and_force(&mut browser)?;
    sliders::columns(&mut browser)?;
    sliders::folded(&mut browser)?;
    sliders::errors(&mut browser)?;
    tables::cases(&mut browser, &cases)?;
    tables::mapping(&mut browser)?;
    tables::workbook(&mut browser)?;
    tables::units_of_headings(&mut browser)?;
    tables::none_and_twice(&mut browser)?;
    tables::completed_by_sliders(&mut browser)?;
    tables::results_are_in_view(&mut browser)?;
    screenshots::write(&mut browser, file, &cases)?;

    let own = |url: &String| ["file:", "blob:", "data:", "about:"].iter().any(|scheme| url.starts_with(scheme));
    if let Some(url) = browser.requests.iter().find(|url| !own(url)) {
        return Err(format!("the page loads {url}"));
    }
    if browser.exceptions.is_empty() { Ok(()) } else { Err(browser.exceptions.join("\n")) }
}

/// A file of the tests.
fn data(name: &str) -> Result<Vec<u8>, String> {
    let file = repository().join("host-tests/data").join(name);
    fs::read(&file).map_err(|error| format!("{}: {error}", file.display()))
}

/// What the program writes for a table; `arguments` are its command and options.
fn program(arguments: &[&str], table: &[u8]) -> Result<String, String> {
    let parsed = Arguments::try_parse_from([&["microimpact"], arguments].concat());
    let parsed = parsed.map_err(|error| error.to_string())?;
    let (mut output, mut errors) = (Vec::new(), Vec::new());
    let streams = &mut Streams { input: &mut { table }, output: &mut output, errors: &mut errors };
    if parsed.run(streams) > 1 {
        return Err(String::from_utf8_lossy(&errors).into_owned());
    }
    String::from_utf8(output).map_err(|error| error.to_string())
}

/// Fails with both texts if they differ.
fn same(what: &str, found: &str, expected: &str) -> Result<(), String> {
    if found == expected {
        return Ok(());
    }
    let mut lines = found.lines().zip(expected.lines()).filter(|(found, expected)| found != expected);
    let (found, expected) = lines.next().unwrap_or((found, expected));
    Err(format!("{what} differs from the program's\npage:    {found}\nprogram: {expected}"))
}

/// The first row of a table that the program writes, by column.
fn first_row(table: &str, column: &str) -> Result<String, String> {
    let mut rows = csv::Reader::from_reader(table.as_bytes());
    let names = rows.headers().map_err(|error| error.to_string())?.clone();
    let row = rows.records().next().ok_or("no rows")?.map_err(|error| error.to_string())?;
    let cell = names.iter().position(|name| name == column).and_then(|at| row.get(at));
    cell.map(String::from).ok_or_else(|| format!("no column {column}"))
}

/// Chooses an option of a control.
pub fn choose(browser: &mut Browser, control: &str, option: &str) -> Result<(), String> {
    browser.value(&format!(
        "(() => {{ const select = document.getElementById({}); select.value = {}; \
         select.dispatchEvent(new Event('change')); }})()",
        json!(control),
        json!(option)
    ))?;
    Ok(())
}
