//! Whether the page fits: looked at in Chromium, in a wide window and on a phone.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use boards::process;
use maud::{DOCTYPE, PreEscaped, html};

/// Names of the browser.
const PROGRAMS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];
/// For a busy machine.
const LIMIT: Duration = Duration::from_secs(120);

/// Width of a wide window and of a phone, px.
const WIDTHS: [u32; 2] = [1280, 390];
/// Height of a wide window, px.
const SCREEN: u32 = 800;
/// Of the page in a wide window with its details folded, px: a tenth of what it was when it had no details to fold.
const LONGEST: u32 = 6700;
/// Screens of one section with its details folded.
const SCREENS: u32 = 3;

/// Measures the page in a frame of each width, and writes what does not fit below them.
const MEASURE: &str = r"addEventListener('load', () => {
  const faults = [];
  let height = 0;
  const atMost = (what, value, bound) => { if (!(value <= bound)) faults.push(`${what}: ${Math.round(value)} px, at most ${bound} px`); };
  for (const frame of document.querySelectorAll('iframe')) {
    const page = frame.contentDocument, width = frame.clientWidth, root = page.documentElement;
    const bottom = (selector) => Math.max(0, ...[...page.querySelectorAll(selector)].map((one) => one.getBoundingClientRect().bottom));
    atMost(`width in a window of ${width} px`, root.scrollWidth, width);
    if (frame.dataset.wide) {
      height = root.scrollHeight;
      atMost('height', height, LONGEST);
      atMost('end of the first three pictures', bottom('.leads figure'), SCREEN);
      for (const section of page.querySelectorAll('section')) {
        atMost(`height of section ${section.id}`, section.getBoundingClientRect().height, SCREENS * SCREEN);
      }
    }
    for (const one of page.querySelectorAll('details')) one.open = true;
    atMost(`width in a window of ${width} px, unfolded`, root.scrollWidth, width);
  }
  document.getElementById('faults').textContent = faults.join('\n') || `fits: ${height} px high`;
});";

/// Whether the page fits; true where there is no Chromium.
///
/// # Errors
/// Chromium fails, or a file cannot be written.
pub(crate) fn fits(page: &Path) -> Result<bool, Box<dyn Error>> {
    let installed = |program: &&&str| process::succeeds(Command::new(program).arg("--version"));
    let Some(program) = PROGRAMS.iter().find(installed) else {
        eprintln!("not looked at: there is no Chromium; install it, or leave out --look");
        return Ok(true);
    };
    let file = page.with_file_name("look.html");
    fs::write(&file, frames(&fs::read_to_string(page)?))?;
    let address = format!("file://{}", fs::canonicalize(&file)?.display());
    let mut command = Command::new(program);
    command.args([
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--virtual-time-budget=10000",
        "--dump-dom",
        &address,
    ]);
    let finished = process::run(&mut command, LIMIT)?.succeeded(program, 5)?;
    fs::remove_file(&file)?;
    let (_, faults) = finished.stdout.rsplit_once("<pre id=\"faults\">").ok_or("Chromium shows no page")?;
    let (faults, _) = faults.split_once("</pre>").ok_or("Chromium shows no whole page")?;
    if faults.is_empty() {
        return Err("Chromium did not measure the page; try again".into());
    }
    let fits = faults.starts_with("fits");
    eprintln!("{}{faults}", if fits { "the page " } else { "the page does not fit:\n" });
    Ok(fits)
}

/// A page with the report in a frame of each width.
fn frames(page: &str) -> String {
    let bounds = [("LONGEST", LONGEST), ("SCREENS", SCREENS), ("SCREEN", SCREEN)];
    let bounds: String = bounds.iter().map(|(name, value)| format!("const {name} = {value};\n")).collect();
    html! {
        (DOCTYPE)
        @for width in WIDTHS {
            iframe srcdoc=(page) width=(width) height=(SCREEN) style="border: 0" data-wide=[(width == WIDTHS[0]).then_some("wide")] {}
        }
        pre #faults {}
        script { (PreEscaped(bounds + MEASURE)) }
    }
    .into_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where Chromium is installed.
    #[test]
    fn a_page_that_is_too_wide_or_too_long_does_not_fit() {
        let folder = std::env::temp_dir().join(format!("microimpact-look-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let page = folder.join("index.html");
        let judge = |body: &str| {
            fs::write(&page, format!("<!DOCTYPE html><body style='margin: 0'>{body}")).unwrap();
            fits(&page).unwrap()
        };
        assert!(judge("short"));
        if PROGRAMS.iter().any(|program| process::succeeds(Command::new(program).arg("--version"))) {
            assert!(!judge("<div style='width: 500px'>wide</div>"));
            assert!(!judge("<div style='height: 7000px'>long</div>"));
            assert!(!judge("<details><div style='width: 500px'>wide, folded</div></details>"));
        }
        fs::remove_dir_all(&folder).unwrap();
    }
}
