//! `cargo write-report`: one page without other files, its tables as CSV, and the paper's numbers within bounds.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use clap::Parser;

/// Whether a report succeeds, or why there is none.
pub(crate) fn report(arguments: &[&str]) -> Result<bool, String> {
    let options = report::Options::try_parse_from(["write-report"].iter().chain(arguments));
    report::run(&options.map_err(|error| error.to_string())?).map_err(|error| error.to_string())
}

/// The folder of a quick report on the sections that measure nothing.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("the folder of the run before can be removed");
    }
    let path = folder.to_str().expect("the folder has a name in Unicode");
    let only = SECTIONS.iter().flat_map(|section| ["--only", section]);
    let arguments: Vec<_> = ["--quick", "--output", path].into_iter().chain(only).collect();
    assert_eq!(report(&arguments), Ok(true));
    folder
});

const SECTIONS: [&str; 4] = ["price", "laws", "published", "paper"];

fn page() -> String {
    fs::read_to_string(FOLDER.join("index.html")).expect("the report has a page")
}

/// The figures of the page with their names.
fn figures(page: &str) -> Vec<(&str, &str)> {
    let named = page.split("<figure id=\"").skip(1);
    named.filter_map(|rest| rest.split_once("</figure>")?.0.split_once('"')).collect()
}

/// Values of an attribute on the page.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let begin = format!(" {name}=\"");
    page.split(begin.as_str()).skip(1).filter_map(|rest| rest.split_once('"')).map(|(value, _)| value).collect()
}

fn rows(name: &str) -> Vec<csv::StringRecord> {
    let mut reader = csv::Reader::from_path(FOLDER.join(format!("{name}.csv"))).expect("the table has its file");
    reader.records().map(|row| row.expect("the file is a table")).collect()
}

#[test]
fn page_needs_nothing_else() {
    let page = page();
    for (at, _) in page.match_indices("http") {
        // A name of the language of drawings, or a link to follow.
        let link = page[..at].ends_with("<a href=\"");
        assert!(
            link || page[at..].starts_with("http://www.w3.org/2000/svg\""),
            "{}",
            &page[at..page.len().min(at + 60)]
        );
    }
    for resource in ["<script", "<link", "<img", "<iframe", "@import", " src="] {
        assert!(!page.contains(resource), "{resource}");
    }
    assert!(page.match_indices("url(").all(|(at, _)| page[at..].starts_with("url(#")));
    let names = attributes(&page, "id");
    let anchors: BTreeSet<_> = names.iter().copied().collect();
    assert_eq!(anchors.len(), names.len(), "a name stands for two places");
    for target in attributes(&page, "href") {
        match target.strip_prefix('#') {
            Some(anchor) => assert!(anchors.contains(anchor), "{target}"),
            None => assert!(target.starts_with("https://") || FOLDER.join(target).is_file(), "{target}"),
        }
    }
}

#[test]
fn contents_name_every_section_and_details_are_folded() {
    let page = page();
    let (_, after) = page.split_once("<nav>").expect("the page has contents");
    let (contents, rest) = after.split_once("</nav>").expect("the contents end");
    let linked = attributes(contents, "href");
    assert_eq!(linked.len(), rest.matches("<section id=").count());
    assert!(SECTIONS.iter().all(|section| linked.contains(&&*format!("#{section}"))), "{linked:?}");
    assert!(!rest.contains('`'), "code is not marked as such");
    // Sections follow the pictures of the first screen, and show at most two figures each.
    for section in rest.split("<section id=").skip(1) {
        let shown = section.split("<details>").next().unwrap_or_default();
        assert!(shown.matches("<svg ").count() <= 2, "{}", &section[..20]);
    }
    assert!(page.matches("<details>").count() > 10 && !page.contains("<details open"));
}

/// Name, symbol and unit, as in `approach speed v [m/s]`.
#[test]
fn every_axis_has_name_symbol_and_unit() {
    let page = page();
    let mut axes = 0;
    for (name, figure) in figures(&page) {
        let Some((_, drawing)) = figure.split_once("<svg ") else { continue };
        let labels = drawing.split("</text>").filter_map(|text| text.trim_end().strip_suffix(']'));
        let labels: Vec<_> = labels.filter_map(|label| label.rsplit_once('\n')).map(|(_, label)| label).collect();
        let panels = drawing.matches("Simulation, ").count() + 1;
        let least = if name.starts_with("price-") { panels } else { 2 };
        assert!(labels.len() >= least, "{name}: {labels:?}");
        for label in &labels {
            let (named, unit) = label.rsplit_once(" [").unwrap_or_else(|| panic!("{name}: {label}"));
            assert!(named.split(' ').count() >= 2 && !unit.is_empty(), "{name}: {label}");
        }
        axes += labels.len();
    }
    assert!(axes > 40, "{axes}");
}

/// The last piece of a bar ends where the footprint of the whole scene says.
#[test]
fn bars_are_as_long_as_the_stored_figures() {
    let whole = |quantity: usize| -> f64 {
        let pieces = rows("price-lead").into_iter().filter(|row| &row[0] == "Rigid body" && &row[1] == "Cortex-M4F");
        pieces.map(|row| row[quantity].parse::<f64>().unwrap()).sum()
    };
    let stored = include_str!("../../data/footprint/cortex-m4f.csv");
    let row = stored.lines().find(|row| row.contains(",rigid/rolling-dissipation,f32,")).expect("the scene is stored");
    let header: Vec<_> = stored.lines().next().unwrap_or_default().split(',').collect();
    let cells = row.split(',').zip(header).filter(|(_, column)| column.starts_with("classify: "));
    let most = cells.filter_map(|(cell, _)| cell.parse::<f64>().ok()).fold(0.0, f64::max);
    assert!(most > 100.0 && (whole(3) - most).abs() < 1e-9, "{} and {most}", whole(3));
}

#[test]
fn page_reads_on_a_phone_and_in_the_dark() {
    let page = page();
    for needed in ["width=device-width", "prefers-color-scheme: dark", "overflow-x: auto", "color-scheme"] {
        assert!(page.contains(needed), "{needed}");
    }
    for drawing in page.split("<svg ").skip(1) {
        assert!(drawing.split_once('>').is_some_and(|(head, _)| head.contains("viewBox")), "a drawing of fixed size");
    }
}

#[test]
fn figures_of_the_paper_have_their_numbers() {
    let page = page();
    for figure in ["2", "4", "6", "7", "8", "9", "a2"] {
        let name = format!("figure-{figure}");
        let (_, after) = page.split_once(&format!("<figure id=\"{name}\">")).unwrap_or_else(|| panic!("{name}"));
        let (figure, _) = after.split_once("</figure>").expect("the figure ends");
        assert!(figure.contains("<svg ") && figure.contains("<polyline "), "{name} shows nothing");
        assert!(figure.contains(&format!("href=\"{name}.csv\"")), "{name} has no link to its numbers");
        let rows = rows(&name);
        assert!(rows.len() > 20, "{name} has {} rows", rows.len());
        let numbers = rows.iter().flatten().filter(|cell| !cell.is_empty());
        assert!(numbers.map(|cell| cell.parse::<f64>().unwrap()).all(f64::is_finite), "{name}");
    }
    assert_eq!(page.matches("<svg ").count(), page.matches("</svg>").count());
}

/// Quantities that the paper gives with one or two digits, or roughly, and how far they may be off.
const ROUGH: [(&str, f64); 2] = [("rotation in contact, degrees", 0.04), ("critical speed, diameter 5 um, m/s", 0.04)];
/// What all others may be off: most have three digits, V_t and what follows from it two.
const CLOSE: f64 = 0.006;

#[test]
fn numbers_of_the_paper_are_reproduced() {
    let mut count = 0;
    for table in ["numbers-rigid-body", "numbers-figure-4", "numbers-simulation", "numbers-parameters"] {
        for row in rows(table) {
            let [paper, ours, difference] = [1, 2, 3].map(|column| row[column].parse::<f64>().unwrap());
            assert!((ours / paper - 1.0 - difference).abs() < 1e-9, "{table}: {row:?}");
            let rough = ROUGH.iter().find(|(quantity, _)| *quantity == &row[0]);
            let bound = rough.map_or(CLOSE, |(_, bound)| *bound);
            assert!(difference.abs() <= bound, "{table}: {row:?}");
            count += 1;
        }
    }
    assert!(count >= 40, "{count} numbers");
}

/// The damping of adhesion as it is printed does not give the paper's results, which is why the others use half of it.
#[test]
fn printed_damping_does_not_reproduce_them() {
    let rows = rows("numbers-printed");
    assert_eq!(rows.len(), 2);
    for row in rows {
        assert!(row[3].parse::<f64>().unwrap() < -0.07, "{row:?}");
    }
}

/// With k = 130 m/s and one W_A the rigid-body model is within 0.1 of the simulation from Table 1 on, and captures
/// a sphere that rebounds in the simulation.
#[test]
fn models_agree_where_the_report_says_so() {
    let rows = rows("models-restitution");
    let numbers = rows.iter().map(|row| [0, 1, 4].map(|column| row[column].parse::<f64>().unwrap()));
    let (mut near, mut apart) = (0, 0);
    for [speed, simulated, rigid] in numbers {
        if (2.8..100.0).contains(&speed) {
            assert!((simulated - rigid).abs() < 0.1, "{speed}: {simulated} and {rigid}");
            near += 1;
        }
        apart += i32::from(simulated > 0.0 && rigid == 0.0);
    }
    assert!(near > 100 && apart > 5, "{near}, {apart}");
}

/// Without damping the laws are those of theory; with it LAMMPS, whose steps are fixed, has the same restitution.
#[test]
fn laws_of_contact_are_those_of_theory_and_of_lammps() {
    for (table, columns, bound, least) in
        [("laws-jkr", [1, 2], 1e-12, 400), ("laws-jkr", [3, 4], 1e-12, 400), ("laws-lammps", [4, 5], 1e-3, 28)]
    {
        let rows = rows(table);
        assert!(rows.len() >= least, "{table} has {} rows", rows.len());
        for row in rows {
            let [one, other] = columns.map(|column| row[column].parse::<f64>().unwrap().powi(2));
            assert!((one - other).abs() < bound, "{table}: {row:?}");
        }
    }
    let errors = rows("laws-errors");
    assert!(errors.len() >= 20, "{} laws", errors.len());
    for row in errors {
        let [wrong, square, contact, peak] = [4, 5, 6, 7].map(|column| row[column].parse::<f64>().unwrap());
        assert!(wrong == 0.0 && square < 1e-12 && contact < 1e-9 && peak < 1e-12, "{row:?}");
    }
}

/// The page of the simulation shows figures by their labels, and contains the drawings.
#[test]
fn figures_in_the_documentation_are_current() {
    assert_eq!(report(&["--check"]), Ok(true));
    let page = include_str!("../../../src/contact/mod.rs");
    assert!(page.contains("include_str!(\"../figures.md\")"));
    let mut shown = 0;
    for line in include_str!("../../../src/figures.md").lines() {
        let (label, _) = line.split_once(": data:image/svg+xml,").expect("a line is a drawing with its label");
        assert!(page.contains(&format!("]{label}")), "the documentation does not show {label}");
        shown += 1;
    }
    assert!(shown >= 2);
}

#[test]
fn what_cannot_be_written_is_said() {
    let file = FOLDER.join("index.html");
    let below = file.join("below");
    assert!(report(&["--quick", "--only", "paper", "--output", below.to_str().unwrap()]).is_err());
    assert!(report(&["--only", "nothing"]).is_err());
}
