//! The page in a browser: its answers are those of the program, to the last digit.

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

/// Names and codes of keys.
const ARROW_LEFT: (&str, u32) = ("ArrowLeft", 37);
const TAB: (&str, u32) = ("Tab", 9);

/// Steps of the slider of the approach speed from the paper's 2.8 m/s to a speed at which the sphere is captured.
const STEPS_TO_CAPTURE: u32 = 50;

/// More tab stops than the page has.
const MOST_STOPS: u32 = 120;

/// Checks the page in Chromium, and writes screenshots beside it.
pub fn page(file: &Path, permission: Permission) -> Result<(), String> {
    packages::find("chromium", &["chromium"], "", permission)?;
    let folder = file.with_file_name("browser");
    let mut browser = Browser::start("chromium", &folder)?;
    browser.open(file, (1280, 900), "light")?;
    browser.wait_for(READY)?;

    let cases = repository().join("host-tests/data/cases.csv");
    let cases = fs::read_to_string(&cases).map_err(|error| format!("{}: {error}", cases.display()))?;
    units(&mut browser)?;
    first_answer(&mut browser)?;
    keyboard(&mut browser)?;
    names_of_controls(&mut browser)?;
    every_term(&mut browser)?;
    refusal(&mut browser)?;
    tables(&mut browser, &cases)?;
    mapping(&mut browser)?;
    screenshots::write(&mut browser, file, &cases)?;

    let own = |url: &String| ["file:", "blob:", "data:", "about:"].iter().any(|scheme| url.starts_with(scheme));
    if let Some(url) = browser.requests.iter().find(|url| !own(url)) {
        return Err(format!("the page loads {url}"));
    }
    if browser.exceptions.is_empty() { Ok(()) } else { Err(browser.exceptions.join("\n")) }
}

/// What the program writes for a table; `arguments` are its command and options.
fn program(arguments: &[&str], table: &str) -> Result<String, String> {
    let parsed = Arguments::try_parse_from([&["microimpact"], arguments].concat());
    let parsed = parsed.map_err(|error| error.to_string())?;
    let (mut output, mut errors) = (Vec::new(), Vec::new());
    let streams = &mut Streams { input: &mut table.as_bytes(), output: &mut output, errors: &mut errors };
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

/// The paper's Table 1 in SI units, at which the sliders start. Its program halves the printed damping of adhesion.
const TABLE_1: [(&str, f64); 10] = [
    ("radius_m", 5.06e-6),
    ("density_kg_m3", 2600.0),
    ("stiffness_pa", 7.5e10),
    ("adhesion_n_m", 250.0),
    ("zeta_a", 6.25),
    ("zeta_h", 10.5),
    ("friction", 0.1),
    ("speed_normal_m_s", 2.8),
    ("speed_tangential_m_s", 0.0),
    ("spin_rad_s", 1.46e5),
];

/// Numbers of other terms in SI units, where their sliders start: 100 mJ/m^2, 1 ns and 0.9.
const OTHER_TERMS: [(&str, &str, &str, f64); 3] = [
    ("law", "dmt", "work_of_adhesion_j_m2", 0.1),
    ("damping", "viscoelastic", "damping_value", 1e-9),
    ("damping", "constant", "damping_value", 0.9),
];

/// The sliders give the program numbers in SI units.
fn units(browser: &mut Browser) -> Result<(), String> {
    let check = |browser: &mut Browser, column: &str, expected: f64| {
        let found = browser.text(&format!("scene.columns().{column}"))?;
        if found.parse() == Ok(expected) { Ok(()) } else { Err(format!("{column} is {found} and not {expected}")) }
    };
    for (column, expected) in TABLE_1 {
        check(browser, column, expected)?;
    }
    for (control, term, column, expected) in OTHER_TERMS {
        choose(browser, control, term)?;
        check(browser, column, expected)?;
    }
    reset(browser)
}

/// Chooses an option of a control.
fn choose(browser: &mut Browser, control: &str, option: &str) -> Result<(), String> {
    browser.value(&format!(
        "(() => {{ const select = document.getElementById({}); select.value = {}; \
         select.dispatchEvent(new Event('change')); }})()",
        json!(control),
        json!(option)
    ))?;
    Ok(())
}

/// Returns to Table 1.
fn reset(browser: &mut Browser) -> Result<(), String> {
    browser.value("document.querySelector('#scene [type=reset]').click()")?;
    browser.wait_for(READY)
}

/// The answer of the sliders where they start is that of the program to the same row.
fn first_answer(browser: &mut Browser) -> Result<(), String> {
    let table = browser.text("table(scene.columns())")?;
    let classified = program(&["classify", "-", "--model", "simulation", "--format", "csv"], &table)?;
    let class = format!("{}, {}", first_row(&classified, "outcome")?, first_row(&classified, "motion")?);
    let shown = browser.text("document.getElementById('class').textContent")?;
    same("the class", &shown.to_lowercase(), &class)?;
    for (row, column, unit) in
        [("Largest indentation δ", "max_indentation_m", "m"), ("Contact time t", "contact_time_s", "s")]
    {
        let number = first_row(&classified, column)?;
        let cell = browser.text(&format!(
            "[...document.querySelectorAll('#numbers tr')].find((row) => row.textContent.startsWith({})).querySelector('td').textContent",
            json!(row)
        ))?;
        same(row, &cell, &browser.text(&format!("inUnits({}, {})", json!(number), json!(unit)))?)?;
        let shown: f64 = cell.split(' ').next().and_then(|text| text.parse().ok()).ok_or("the cell has no number")?;
        // Both are tens of nanometres or nanoseconds.
        let exact = number.parse::<f64>().map_err(|error| error.to_string())? * 1e9;
        if (shown / exact - 1.0).abs() > 5e-3 {
            return Err(format!("{row}: the page shows {cell}, the program has {number}"));
        }
    }
    Ok(())
}

/// The slider of the speed is moved by the keyboard, down to capture.
fn keyboard(browser: &mut Browser) -> Result<(), String> {
    browser.value("document.querySelector('[aria-label^=\"Approach speed\"][type=range]').focus()")?;
    for _ in 0..STEPS_TO_CAPTURE {
        browser.press(ARROW_LEFT.0, ARROW_LEFT.1)?;
    }
    browser.wait_for(READY)?;
    let speed = browser.value("scene.values.speed_normal_m_s")?;
    let class = browser.text("document.getElementById('class').textContent")?;
    if !class.starts_with("Captured") {
        return Err(format!("at {speed} m/s, after {STEPS_TO_CAPTURE} steps to the left, the class is {class}"));
    }
    reset(browser)
}

/// Every control has a name, and shows when it has the focus.
fn names_of_controls(browser: &mut Browser) -> Result<(), String> {
    let nameless = browser.value(
        "[...document.querySelectorAll('input, select, button')].filter((control) => \
         !control.ariaLabel && !control.textContent.trim() && !control.labels?.length).map((control) => control.outerHTML)",
    )?;
    if nameless != json!([]) {
        return Err(format!("controls without a name: {nameless}"));
    }
    browser.value("document.activeElement.blur(); window.stops = new Set()")?;
    for _ in 0..MOST_STOPS {
        browser.press(TAB.0, TAB.1)?;
        let outlined = browser.value(
            "(() => { const at = document.activeElement; \
             if (at === document.body) return true; \
             stops.add(at); \
             const seen = at.id === 'file' ? at.nextElementSibling : at; \
             return getComputedStyle(seen).outlineStyle !== 'none'; })()",
        )?;
        if outlined != json!(true) {
            let control = browser.text("document.activeElement.outerHTML")?;
            return Err(format!("the focus does not show on {control}"));
        }
    }
    let missed = browser.value(
        "[...document.querySelectorAll('input, select, button, summary')].filter((control) => \
         control.checkVisibility() && !stops.has(control)).map((control) => control.outerHTML)",
    )?;
    if missed == json!([]) { Ok(()) } else { Err(format!("the keyboard does not reach {missed}")) }
}

/// Every law of contact with every damping has an answer, charts without gaps, and no number that is none.
fn every_term(browser: &mut Browser) -> Result<(), String> {
    for law in ["hertz", "ring", "dmt", "jkr"] {
        for damping in ["none", "hysteretic", "viscoelastic", "constant"] {
            choose(browser, "law", law)?;
            choose(browser, "damping", damping)?;
            browser.wait_for(READY)?;
            let class = browser.text("document.getElementById('class').textContent")?;
            let margin = browser.text("document.getElementById('margin').textContent")?;
            if class == "No answer" {
                return Err(format!("law {law}, damping {damping}: {margin}"));
            }
            let page = browser.text("document.querySelector('main').innerHTML")?;
            if ["NaN", "Infinity", "undefined"].iter().any(|word| page.contains(word)) {
                return Err(format!("law {law}, damping {damping}: the page shows a number that is none"));
            }
        }
    }
    reset(browser)
}

/// A number out of its range is refused in the program's words, and standard errors give probabilities.
fn refusal(browser: &mut Browser) -> Result<(), String> {
    let enter = |id: &str, number: &str| {
        format!(
            "(() => {{ const field = document.getElementById('{id}'); field.value = '{number}'; \
             field.dispatchEvent(new Event('input')); }})()"
        )
    };
    browser.value(&enter("speed_normal_m_s", "-2.8"))?;
    browser.wait_for(READY)?;
    let reason = browser.text("document.getElementById('margin').textContent")?;
    let table = browser.text("table(scene.columns())")?;
    let classified = program(&["classify", "-", "--model", "simulation", "--format", "csv"], &table)?;
    same("the reason", &reason, &first_row(&classified, "error")?)?;

    browser.value(&enter("speed_normal_m_s", "1.5"))?;
    browser.value(&enter("speed_normal_error_m_s", "5"))?;
    browser.wait_for(READY)?;
    let table = browser.text("table(scene.columns())")?;
    let classified = program(&["classify", "-", "--model", "simulation", "--format", "csv"], &table)?;
    let rolling: f64 = first_row(&classified, "probability_rebound_rolling")?.parse().map_err(|_| "no probability")?;
    let shown = browser.text("document.getElementById('margin').textContent")?;
    if !shown.contains(&format!("rebound, rolling {rolling:.3}")) {
        return Err(format!("the probability of a rolling rebound is {rolling}; the page shows {shown}"));
    }
    reset(browser)
}

/// Drops a file on the page.
pub fn drop_file(browser: &mut Browser, name: &str, table: &str) -> Result<(), String> {
    browser.value(&format!(
        "(() => {{ const dataTransfer = new DataTransfer(); dataTransfer.items.add(new File([{}], {})); \
         document.getElementById('mapping').hidden = true; \
         document.body.dispatchEvent(new DragEvent('drop', {{ dataTransfer, bubbles: true, cancelable: true }})); }})()",
        json!(table),
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
fn tables(browser: &mut Browser, cases: &str) -> Result<(), String> {
    drop_file(browser, "cases.csv", cases)?;
    for model in ["simulation", "rigid-body", "both"] {
        let expected = program(&["classify", "-", "--model", model, "--format", "csv"], cases)?;
        if expected.lines().count() != cases.lines().count() {
            return Err(format!("the program classifies {} lines of cases.csv", expected.lines().count()));
        }
        same(&format!("the result of model {model}"), &classified(browser, model)?, &expected)?;
    }
    Ok(())
}

/// Columns with other names, which the user chooses, in a file with semicolons and decimal commas.
fn mapping(browser: &mut Browser) -> Result<(), String> {
    let body = "2,5;2600;75;250;10,5;2,8\n5,06;2600;75;250;10,5;0,9\n";
    let own = format!("half width;solid;k;f0 of Table 1;zeta_h;speed\n{body}");
    let known = format!("radius_um;density_kg_m3;stiffness_gpa;adhesion_n_m;zeta_h;speed_normal_m_s\n{body}");
    drop_file(browser, "own.csv", &own)?;
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
    let expected = program(&["classify", "-", "--model", "simulation", "--format", "csv"], &known)?;
    same("the result of renamed columns", &classified(browser, "simulation")?, &expected)
}
