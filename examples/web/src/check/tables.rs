//! Files of impacts that are dropped on the page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

use super::{choose, data, first_row, program, same};
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
    let expected = with_headings(&simulated(&known)?, "half width;solid;k;f0 of Table 1;zeta_h;speed");
    same("the result of renamed columns", &classified(browser, "simulation")?, &expected)
}

/// What the program simulates for a table.
fn simulated(table: &str) -> Result<String, String> {
    program(&["classify", "-", "--model", "simulation", "--format", "csv"], table.as_bytes())
}

/// A result in which the first columns have these headings.
fn with_headings(result: &str, headings: &str) -> String {
    let (header, rows) = result.split_once('\n').unwrap_or((result, ""));
    let computed = header.split([';', ',']).skip(headings.split([';', ',']).count()).collect::<Vec<_>>();
    let separator = if headings.contains(';') { ";" } else { "," };
    format!("{headings}{separator}{}\n{rows}", computed.join(separator))
}

/// The numbers of Table 1 but for size and speed, and their columns.
const SURFACE: &str = "density_kg_m3,stiffness_pa,adhesion_n_m,zeta_a";
const GLASS: &str = "2600,7.5e10,250,6.25";

/// A heading with other words states the unit of its column, and a diameter is no radius.
pub fn units_of_headings(browser: &mut Browser) -> Result<(), String> {
    let headings = format!("Size d (um),Impact vel [cm/s],{SURFACE}");
    drop_file(browser, "units.csv", format!("{headings}\n10.12,280,{GLASS}\n").as_bytes())?;
    for (column, heading, unit) in
        [("diameter_m", "Size d (um)", "diameter_um"), ("speed_normal_m_s", "Impact vel [cm/s]", "speed_normal_cm_s")]
    {
        choose(browser, &format!("column-{column}"), heading)?;
        same(heading, &browser.text(&format!("document.getElementById('unit-{column}').value"))?, unit)?;
    }
    let known = simulated(&format!("diameter_um,speed_normal_cm_s,{SURFACE}\n10.12,280,{GLASS}\n"))?;
    same("the result in other units", &classified(browser, "simulation")?, &with_headings(&known, &headings))?;
    // Brackets that hold no unit of the column leave it to the user.
    let headings = format!("d [inch],speed_normal_m_s,{SURFACE}");
    drop_file(browser, "inch.csv", format!("{headings}\n10.12,2.8,{GLASS}\n").as_bytes())?;
    choose(browser, "column-diameter_m", "d [inch]")?;
    refused(browser, "its unit is not known")
}

/// The page says why it does not take the columns, and does not classify.
fn refused(browser: &mut Browser, words: &str) -> Result<(), String> {
    let problem = browser.text("document.getElementById('problem').textContent")?;
    let disabled = browser.value("document.querySelector('#mapping button').disabled")?;
    let is_refused = problem.contains(words) && disabled == json!(true);
    if is_refused { Ok(()) } else { Err(format!("the page says \"{problem}\" where it must say \"{words}\"")) }
}

/// A column is left out, or chosen twice.
pub fn none_and_twice(browser: &mut Browser) -> Result<(), String> {
    let headings = format!("radius_um,speed_normal_m_s,zeta_h,{SURFACE}");
    let rows = format!("5.06,2.8,10.5,{GLASS}\n");
    drop_file(browser, "none.csv", format!("{headings}\n{rows}").as_bytes())?;
    choose(browser, "column-zeta_h", "")?;
    browser.value("document.getElementById('take').checked = false")?;
    browser.value("document.getElementById('take').dispatchEvent(new Event('change'))")?;
    let unused = simulated(&format!("{}\n{rows}", headings.replace("zeta_h", "unused_zeta_h")))?;
    same("the result without zeta_h", &classified(browser, "simulation")?, &with_headings(&unused, &headings))?;
    let outcome = browser.text("document.getElementById('outcome').textContent")?;
    if !outcome.contains("zeta_h (0)") {
        return Err(format!("the page does not say which damping it assumes: {outcome}"));
    }
    choose(browser, "column-friction", "speed_normal_m_s")?;
    refused(browser, "chosen for approach speed and for friction")
}

/// A table of sizes and speeds takes the rest from the sliders, and says so.
pub fn completed_by_sliders(browser: &mut Browser) -> Result<(), String> {
    drop_file(browser, "speeds.csv", b"radius_um,speed_normal_m_s\n5.06,2.8\n4.3,1.1\n")?;
    let result = classified(browser, "simulation")?;
    let outcome = browser.text("document.getElementById('outcome').textContent")?;
    if !outcome.contains("Taken from the sliders for all rows:") || !outcome.contains("density_kg_m3 2600") {
        return Err(format!("the page does not say what it takes from the sliders: {outcome}"));
    }
    // The sliders stand at Table 1.
    let columns = "speed_tangential_m_s,spin_rad_s,friction,law,zeta_h,density_kg_m3,stiffness_pa,adhesion_n_m,zeta_a";
    let cells = format!("0,146000,0.1,ring,10.5,{GLASS}");
    let expected = simulated(&format!("radius_um,speed_normal_m_s,{columns}\n5.06,2.8,{cells}\n4.3,1.1,{cells}\n"))?;
    for column in ["outcome", "overall_restitution", "spin_out_rad_s"] {
        same(column, &first_row(&result, column)?, &first_row(&expected, column)?)?;
    }
    // Without the sliders it cannot be classified.
    browser.value("document.getElementById('take').click()")?;
    browser.value("document.getElementById('outcome').replaceChildren()")?;
    browser.value("document.querySelector('#mapping button').click()")?;
    browser.wait_for("document.getElementById('outcome').textContent.includes('lacks required columns')")
}

/// The class of the sliders never lies over the results of a table.
pub fn results_are_in_view(browser: &mut Browser) -> Result<(), String> {
    browser.value("document.getElementById('outcome').scrollIntoView()")?;
    let bottom = "document.getElementById('answer').getBoundingClientRect().bottom";
    let top = "document.getElementById('sheet').getBoundingClientRect().top";
    let is_above = browser.value(&format!("{bottom} <= {top}"))?;
    browser.value("window.scrollTo(0, 0)")?;
    if is_above == json!(true) { Ok(()) } else { Err("the class of the sliders covers the results of a table".into()) }
}

/// The first sheet of a workbook gives what the program writes for the same file.
pub fn workbook(browser: &mut Browser) -> Result<(), String> {
    let workbook = data("spreadsheets/impacts.xlsx")?;
    drop_file(browser, "impacts.xlsx", &workbook)?;
    let expected = program(&["classify", "-", "--model", "rigid-body", "--format", "csv"], &workbook)?;
    same("the result of a workbook", &classified(browser, "rigid-body")?, &expected)
}
