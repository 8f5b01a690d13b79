//! The page: one HTML file with everything in it but the CSV files beside it.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::content::{Figure, Section};
use crate::device::Device;

mod numbers;
mod parts;

use numbers::exact;
use parts::{file, link, render_parts, with_code};

const STYLE: &str = include_str!("page.css");
/// The sphere before, in and after the contact, with the symbols of speeds and forces.
const SCENE: &str = include_str!("scene.svg");

/// Symbols of the drawing and of the axes.
const SYMBOLS: [(&str, &str); 9] = [
    ("v", "approach speed along the normal; after the impact V"),
    ("v_t, ω", "velocity along the surface and spin; after the impact V_t and Ω"),
    ("e", "restitution V/v, zero if the surface captures the sphere"),
    ("R", "restitution without adhesion"),
    ("x", "indentation"),
    ("F_H, F_A", "elastic force (Hertz) and adhesion"),
    ("F_t", "friction, at most f F_H"),
    ("h, g", "damping of the materials and of adhesion, at the largest speed without damping"),
    ("ε", "error"),
];

/// A section as it came out.
pub(crate) struct Chapter {
    pub(crate) name: &'static str,
    pub(crate) section: Result<Section, String>,
    pub(crate) elapsed: Duration,
}

/// Writes the page and its tables into a folder; where the page is.
pub(crate) fn write(
    folder: &Path,
    device: &Device,
    chapters: &[Chapter],
    quick: bool,
) -> Result<PathBuf, Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    for table in chapters.iter().filter_map(|chapter| chapter.section.as_ref().ok()).flat_map(Section::tables) {
        let mut writer = csv::Writer::from_path(folder.join(file(table)))?;
        writer.write_record(&table.columns)?;
        for row in &table.rows {
            writer.write_record(row.iter().map(exact))?;
        }
        writer.flush()?;
    }
    let index = folder.join("index.html");
    fs::write(&index, page(device, chapters, quick).into_string())?;
    Ok(index)
}

fn page(device: &Device, chapters: &[Chapter], quick: bool) -> Markup {
    let sections = || chapters.iter().filter_map(|chapter| chapter.section.as_ref().ok());
    let leads: Vec<_> = sections().filter_map(|section| Some((section.lead.as_ref()?, section.name))).collect();
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
                    h1 { "microimpact: does a microsphere bounce off a surface or stick to it?" }
                    (contents(chapters))
                }
                @if !leads.is_empty() {
                    div.leads { @for (figure, name) in leads { (render_lead(figure, name)) } }
                }
                (left_out(quick, sections()))
                main {
                    @for chapter in chapters { (render(chapter)) }
                    (scene())
                    (made_with(device, chapters))
                }
            }
        }
    }
}

fn contents(chapters: &[Chapter]) -> Markup {
    html! {
        nav {
            @for chapter in chapters {
                @match &chapter.section {
                    Ok(section) => a href={ "#" (section.name) } { (section.title) },
                    Err(_) => a href={ "#" (chapter.name) } { (chapter.name) " (failed)" },
                }
            }
            a href="#scene" { "Symbols" }
        }
    }
}

/// One line on what a run does not show, and how to see it.
fn left_out<'a>(quick: bool, sections: impl Iterator<Item = &'a Section>) -> Markup {
    let missing: Vec<_> = sections.filter_map(|section| section.left_out.as_deref()).collect();
    html! {
        @if quick {
            p.left-out {
                "Quick run, with fewer settings, scenes and points"
                @if !missing.is_empty() { ", without " (missing.join(", without ")) }
                ". All of it: " code { "cargo write-report" } "."
            }
        } @else if !missing.is_empty() {
            p.left-out { "Without " (with_code(&missing.join(", without "))) "." }
        }
    }
}

/// A picture of the first screen, its title, and its sentence.
fn render_lead(figure: &Figure, section: &str) -> Markup {
    html! {
        figure id=(figure.data.name) {
            h2 { (figure.title) }
            (PreEscaped(&figure.drawing))
            figcaption { (figure.data.caption) " " a href={ "#" (section) } { "more" } " " (link(&figure.data)) }
        }
    }
}

fn render(chapter: &Chapter) -> Markup {
    match &chapter.section {
        Ok(section) => html! {
            section id=(section.name) {
                h2 { (section.title) }
                (render_parts(&section.parts))
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

fn scene() -> Markup {
    html! {
        section #scene {
            h2 { "The scene and its symbols" }
            figure { (PreEscaped(SCENE)) }
            dl.symbols { @for (symbol, meaning) in SYMBOLS { dt { (symbol) } dd { (meaning) } } }
        }
    }
}

fn made_with(device: &Device, chapters: &[Chapter]) -> Markup {
    let seconds = |chapter: &Chapter| format!("{} {:.1} s", chapter.name, chapter.elapsed.as_secs_f64());
    html! {
        details {
            summary { "What this report was made with" }
            dl {
                @for (name, value) in &device.facts { dt { (name) } dd { (value) } }
                dt { "Sections" }
                dd { (chapters.iter().map(seconds).collect::<Vec<_>>().join(", ")) }
                dt { "Crates" }
                dd {
                    @for (name, version) in &device.crates {
                        a href={ "https://docs.rs/" (name) "/" (version) } { (name) " " (version) } " "
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failed_section_is_on_the_page() {
        let chapter = Chapter { name: "cost", section: Err("no <peer> ran".to_owned()), elapsed: Duration::ZERO };
        let page = page(&Device::default(), &[chapter], true).into_string();
        assert!(page.contains("<section class=\"failure\" id=\"cost\">") && page.contains("no &lt;peer&gt; ran"));
        assert!(page.contains("href=\"#cost\""));
    }

    #[test]
    fn what_a_run_leaves_out_is_one_line() {
        let section = Section { left_out: Some("the boards: `qemu` is missing".to_owned()), ..Section::default() };
        let line = |quick| left_out(quick, [&section, &Section::default()].into_iter()).into_string();
        assert!(line(true).contains("without the boards") && line(true).contains("cargo write-report"));
        assert_eq!(line(false), "<p class=\"left-out\">Without the boards: <code>qemu</code> is missing.</p>");
        assert_eq!(left_out(false, std::iter::empty()).into_string(), "");
    }
}
