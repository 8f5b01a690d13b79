//! The guide: its commands run and print what it shows, its lists are current, and its measurements are what it says they are.

mod columns;
mod impacts;
mod transcript;

use std::fs;
use std::path::PathBuf;

/// The top folder of the repository, where the guide's commands run.
fn repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn folder() -> PathBuf {
    repository().join("examples/guide")
}

/// The text of a page.
fn page(name: &str) -> String {
    let path = folder().join("pages").join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The names of all pages.
fn pages() -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder().join("pages"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".md"))
        .collect();
    names.sort();
    names
}

/// Writes a page, or demands that it is current.
fn keep_current(path: PathBuf, text: &str, writes: bool) {
    if writes {
        return fs::write(path, text).unwrap();
    }
    let stored = fs::read_to_string(&path).unwrap_or_default();
    let write = "cargo test --package host-tests --test programs -- guide --ignored --test-threads 1";
    assert!(stored == text, "{} is not current; `{write}` writes it anew", path.display());
}

/// Each page is part of the documentation.
#[test]
fn rustdoc_has_every_page() {
    let library = fs::read_to_string(folder().join("src/lib.rs")).unwrap();
    let names = pages();
    assert!(names.len() > 5);
    for name in names {
        assert!(library.contains(&format!("\"../pages/{name}\"")), "{name} is not in examples/guide/src/lib.rs");
    }
}

/// The programs in C and Python are files that the gate runs, and the page shows them.
#[test]
fn page_shows_its_programs() {
    let page = page("step_5_programs.md");
    for (language, file) in [("c", "classify.c"), ("python", "classify.py")] {
        let program = fs::read_to_string(folder().join(file)).unwrap();
        assert!(page.contains(&format!("```{language}\n{program}```")), "{file}");
    }
}

/// Equations and text of the page with MathML are those of its source, where they are written in LaTeX.
#[test]
fn page_of_equations_is_made_from_its_source() {
    let source = fs::read_to_string(folder().join("source/equations.md")).unwrap();
    let page = page("equations.md");
    assert!(page.contains("<math"));
    assert_eq!(
        without(&source, ["$$", "$$"], ["$", "$"]),
        without(&page, ["<p><math", "</math></p>"], ["<math", "</math>"])
    );
}

/// A text without its formulas, which lie between these marks.
fn without(text: &str, block: [&str; 2], inline: [&str; 2]) -> String {
    let mut text = text.to_owned();
    for [begin, end] in [block, inline] {
        while let Some((before, rest)) = text.split_once(begin) {
            let after = rest.split_once(end).expect("the formula ends").1;
            text = format!("{before}\u{2026}{after}");
        }
    }
    text
}
