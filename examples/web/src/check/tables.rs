//! Files of impacts that are dropped on the page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

use super::{choose, data, program, same};
use crate::browser::Browser;

/// Drops a file on the page.
pub fn drop_file(browser: &mut Browser, name: &str, table: &[u8]) -> Result<(), String> {
    browser.value(&format!(
        "(() => {{ const dataTransfer = new DataTransfer(); dataTransfer.items.add(new File( \
         [Uint8Array.from(atob({}), (letter) => letter.charCodeAt(0))], {})); \
         document.getElementById('mapping').hidden = true; \
         document.body.dispatchEvent(new DragEvent('drop', {{ dataTransfer, bubbles: true, cancelable: true }})); }})()",
        json!(STANDARD.encode(table)),
        json!(name)
    ))?;
    browser.wait_for("!document.getElementById('mapping').hidden")
}

/// The result of a file on the page, as it is saved.
fn classified(browser: &mut Browser, model: &str) -> Result<String, String> {
    browser.value(&format!(
        "(() => {{ const model = document.getElementById('model'); model.value = '{model}'; \
         model.dispatchEvent(new Event('change')); document.getElementById('outcome').replaceChildren(); \
         document.querySelector('#mapping button').click(); }})()"
    ))?;
    browser.wait_for("document.getElementById('outcome').childElementCount > 0")?;
    browser.text("fetch(document.getElementById('download').href).then((file) => file.text())")
}

/// A dropped file gives what the program writes, by each model.
pub fn cases(browser: &mut Browser, cases: &[u8]) -> Result<(), String> {
    drop_file(browser, "cases.csv", cases)?;
    for model in ["simulation", "rigid-body", "both"] {
        let expected = program(&["classify", "-", "--model", model, "--format", "csv"], cases)?;
        let rows = cases.iter().filter(|byte| **byte == b'\n').count();
        if expected.lines().count() != rows {
            return Err(format!("the program classifies {} lines of cases.csv", expected.lines().count()));
        }
        same(&format!("the result of model {model}"), &classified(browser, model)?, &expected)?;
    }
    Ok(())
}

/// Columns with other names, which the user chooses, in a file with semicolons and decimal commas.
pub fn mapping(browser: &mut Browser) -> Result<(), String> {
    let body = "2,5;2600;75;250;10,5;2,8\n5,06;2600;75;250;10,5;0,9\n";
    let own = format!("half width;solid;k;f0 of Table 1;zeta_h;speed\n{body}");
    let known = format!("radius_um;density_kg_m3;stiffness_gpa;adhesion_n_m;zeta_h;speed_normal_m_s\n{body}");
    drop_file(browser, "own.csv", own.as_bytes())?;
    for (select, chosen) in [
        ("column-radius_m", "half width"),
        ("unit-radius_m", "radius_um"),
        ("column-density_kg_m3", "solid"),
        ("column-stiffness_pa", "k"),
        ("unit-stiffness_pa", "stiffness_gpa"),
        ("column-adhesion_n_m", "f0 of Table 1"),
        ("column-speed_normal_m_s", "speed"),
    ] {
        choose(browser, select, chosen)?;
    }
    let expected = program(&["classify", "-", "--model", "simulation", "--format", "csv"], known.as_bytes())?;
    same("the result of renamed columns", &classified(browser, "simulation")?, &expected)
}

/// The first sheet of a workbook gives what the program writes for the same file.
pub fn workbook(browser: &mut Browser) -> Result<(), String> {
    let workbook = data("spreadsheets/impacts.xlsx")?;
    drop_file(browser, "impacts.xlsx", &workbook)?;
    let expected = program(&["classify", "-", "--model", "rigid-body", "--format", "csv"], &workbook)?;
    same("the result of a workbook", &classified(browser, "rigid-body")?, &expected)
}
