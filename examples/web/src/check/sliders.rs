//! The answer to what the user sets by sliders, and how the page is used without a mouse.

use std::collections::BTreeSet;

use serde_json::json;

use super::{READY, choose, first_row, program, same};
use crate::browser::Browser;

/// Pairs of materials, sphere and surface, of which the list has the work of adhesion of one.
const KNOWN_PAIR: [&str; 2] = ["ice", "ice"];
const UNKNOWN_PAIR: [&str; 2] = ["polystyrene", "steel"];

/// Names and codes of keys.
const ARROW_LEFT: (&str, u32) = ("ArrowLeft", 37);
const TAB: (&str, u32) = ("Tab", 9);

/// Steps of the slider of the approach speed from the paper's 2.8 m/s to a speed at which the sphere is captured.
const STEPS_TO_CAPTURE: u32 = 50;

/// More tab stops than the page has.
const MOST_STOPS: u32 = 200;

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

/// Columns of `classify` without a control: those in place of a column that has one, and those of motions in space, which begin or end so.
const INSTEAD: [&str; 4] = ["name", "diameter_m", "diameter_error_m", "impulse_ratio"];
const IN_SPACE: [&str; 4] = ["velocity_", "normal_", "wall_", "spin_"];
const OF_SECOND: &str = "_2";

/// A term that is folded away and where it is there, with its number in the unit of its slider and in SI units, and a quantity of the
/// program that it changes.
struct Folded {
    choices: &'static [(&'static str, &'static str)],
    column: &'static str,
    entered: &'static str,
    number: f64,
    changes: &'static str,
}

const FOLDED: [Folded; 4] = [
    Folded { choices: &[], column: "peeling_n_m", entered: "2", number: 2e-12, changes: "spin_out_rad_s" },
    Folded {
        choices: &[("law", "hertz"), ("compliance", "elastic")],
        column: "stiffness_ratio",
        entered: "1.5",
        number: 1.5,
        changes: "spin_out_rad_s",
    },
    Folded { choices: &[], column: "yield_pressure_pa", entered: "2", number: 2e9, changes: "speed_over_yield" },
    Folded {
        choices: &[("scene_model", "rigid-body")],
        column: "rolling_arm_m",
        entered: "100",
        number: 1e-7,
        changes: "spin_out_rad_s",
    },
];

/// Every column that `classify` reads has a control, but for other ways to give a number and for motions in space.
pub fn columns(browser: &mut Browser) -> Result<(), String> {
    let offered = browser.value("[...new Set(INPUTS.map((input) => input.column).filter(Boolean))]")?;
    let offered: Vec<&str> = offered.as_array().into_iter().flatten().filter_map(|name| name.as_str()).collect();
    let list = program(&["columns", "--format", "csv"], b"")?;
    let mut rows = csv::Reader::from_reader(list.as_bytes());
    let place = |name: &str, names: &csv::StringRecord| names.iter().position(|other| other == name).unwrap_or(0);
    let names = rows.headers().map_err(|error| error.to_string())?.clone();
    let (column, read_by) = (place("column", &names), place("read_by", &names));
    let read: Vec<String> = (rows.records().filter_map(Result::ok))
        .filter(|row| row[read_by].contains("classify"))
        .map(|row| row[column].to_owned())
        .collect();
    let in_space = |name: &str| {
        IN_SPACE.iter().any(|start| name.starts_with(start)) && !name.starts_with("spin_rad") && !name.contains("error")
    };
    let elsewhere = |name: &str| INSTEAD.contains(&name) || in_space(name) || name.contains(OF_SECOND);
    let missing: Vec<&String> =
        read.iter().filter(|name| !elsewhere(name) && !offered.contains(&name.as_str())).collect();
    if read.len() < 60 || !missing.is_empty() {
        return Err(format!("of {} columns of classify the page lacks {missing:?}", read.len()));
    }
    Ok(())
}

/// Terms that are folded away reach the program and change its answer, which the page shows.
pub fn folded(browser: &mut Browser) -> Result<(), String> {
    for Folded { choices, column, entered, number, changes } in FOLDED {
        for (control, option) in choices {
            choose(browser, control, option)?;
        }
        enter(browser, "speed_tangential_m_s", "5")?;
        browser.wait_for(READY)?;
        let without = browser.text(&format!(
            "table(Object.fromEntries(Object.entries(scene.columns()).filter(([name]) => name !== '{column}')))"
        ))?;
        enter(browser, column, entered)?;
        browser.wait_for(READY)?;
        let found = browser.text(&format!("scene.columns().{column}"))?;
        if found.parse() != Ok(number) {
            return Err(format!("{column} is {found} and not {number}"));
        }
        answered(browser)?;
        let model = browser.text("scene.values.scene_model")?;
        let classify =
            |table: &str| program(&["classify", "-", "--model", &model, "--format", "csv"], table.as_bytes());
        let with = classify(&browser.text("table(scene.columns())")?)?;
        if first_row(&with, changes)? == first_row(&classify(&without)?, changes).unwrap_or_default() {
            return Err(format!("{column} does not change {changes}"));
        }
        let spin = first_row(&with, "spin_out_rad_s")?;
        let shown = browser.text("document.getElementById('numbers').textContent")?;
        let expected = browser.text(&format!("inUnits({}, 'rad/s')", json!(spin)))?;
        if !shown.contains(&expected) {
            return Err(format!("{column}: the page does not show the spin {expected}"));
        }
        reset(browser)?;
    }
    Ok(())
}

/// Each standard error that the page has reaches the program, and the page shows the probabilities of the program.
pub fn errors(browser: &mut Browser) -> Result<(), String> {
    let scenes: [&[(&str, &str)]; 5] = [
        &[],
        &[("law", "dmt")],
        &[("scene_model", "rigid-body")],
        &[("scene_model", "rigid-body"), ("restitution_law", "yield"), ("adhesion_law", "speed")],
        &[("scene_model", "rigid-body"), ("restitution_law", "constant"), ("adhesion_law", "coefficient")],
    ];
    let mut seen = BTreeSet::new();
    for choices in scenes {
        for (control, option) in choices {
            choose(browser, control, option)?;
        }
        enter(browser, "speed_tangential_m_s", "2")?;
        browser.value(
            "for (const input of ERRORS.filter((input) => scene.has(input))) { const field = document.getElementById(keyOf(input)); \
             field.value = input.most / 20; field.dispatchEvent(new Event('input')); }",
        )?;
        browser.wait_for(READY)?;
        answered(browser)?;
        let (model, table) = (browser.text("scene.values.scene_model")?, browser.text("table(scene.columns())")?);
        seen.extend(table.lines().next().into_iter().flat_map(|names| names.split(',')).map(str::to_owned));
        let classified = program(&["classify", "-", "--model", &model, "--format", "csv"], table.as_bytes())?;
        let shown = browser.text("document.getElementById('margin').textContent")?;
        for (class, words) in [("rebound_rolling", "rebound, rolling"), ("captured_rolling", "captured, rolling")] {
            let probability = first_row(&classified, &format!("probability_{class}"))?;
            let probability: f64 = probability.parse().map_err(|_| format!("{class} has no probability: {table}"))?;
            if probability >= 0.0005 && !shown.contains(&format!("{words} {probability:.3}")) {
                return Err(format!("the probability of {class} is {probability}; the page shows {shown}"));
            }
        }
        reset(browser)?;
    }
    let offered = browser.value("ERRORS.map((input) => input.column)")?;
    let missed: Vec<_> = offered
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|name| name.as_str())
        .filter(|name| !seen.contains(*name))
        .collect();
    if missed.is_empty() { Ok(()) } else { Err(format!("these do not reach the program: {missed:?}")) }
}

/// The sliders give the program numbers in SI units.
pub fn units(browser: &mut Browser) -> Result<(), String> {
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

/// Returns to Table 1.
fn reset(browser: &mut Browser) -> Result<(), String> {
    browser.value("document.querySelector('#scene [type=reset]').click()")?;
    browser.wait_for(READY)
}

/// The answer of the sliders where they start is that of the program to the same row.
pub fn first_answer(browser: &mut Browser) -> Result<(), String> {
    let table = browser.text("table(scene.columns())")?;
    let classified = program(&["classify", "-", "--model", "simulation", "--format", "csv"], table.as_bytes())?;
    let class = format!("{}, {}", first_row(&classified, "outcome")?, first_row(&classified, "motion")?);
    let shown = browser.text("document.getElementById('class').textContent")?;
    same("the class", &shown.to_lowercase(), &class)?;
    let charts = browser.value("document.querySelectorAll('#results figure > svg').length")?;
    if charts != json!(3) {
        return Err(format!("the page has {charts} charts and not 3"));
    }
    let ids = "[...document.querySelectorAll('[id]')].map((part) => part.id)";
    let twice = browser.value(&format!("{ids}.filter((id, at, all) => all.indexOf(id) !== at)"))?;
    if twice != json!([]) {
        return Err(format!("parts of the page share the names {twice}"));
    }
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
pub fn keyboard(browser: &mut Browser) -> Result<(), String> {
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
pub fn names_of_controls(browser: &mut Browser) -> Result<(), String> {
    let nameless = browser.value(
        "[...document.querySelectorAll('input, select, button')].filter((control) => \
         !control.ariaLabel && !control.textContent.trim() && !control.labels?.length).map((control) => control.outerHTML)",
    )?;
    if nameless != json!([]) {
        return Err(format!("controls without a name: {nameless}"));
    }
    browser.value(
        "for (const fold of document.querySelectorAll('#scene details')) fold.open = true; \
         document.activeElement.blur(); window.stops = new Set()",
    )?;
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
    browser.value("for (const fold of document.querySelectorAll('#scene details')) fold.open = false")?;
    if missed == json!([]) { Ok(()) } else { Err(format!("the keyboard does not reach {missed}")) }
}

/// Every law of contact with every damping has an answer, charts without gaps, and no number that is none.
pub fn every_term(browser: &mut Browser) -> Result<(), String> {
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

/// What is entered in the box of a column, and what the page says of it.
const REFUSED: [(&str, &str, &str); 6] = [
    (
        "speed_normal_m_s",
        "-2.8",
        "Approach speed: -2.8 m/s is refused: approach speed must be 1e-12 to 1e6 m/s; enter -2.8 m/s as 2.8",
    ),
    ("radius_m", "5e6", "Radius: 5000000 µm is refused: radius must be 1e-4 to 1e6 µm"),
    ("stiffness_pa", "-75", "Hertz stiffness: -75 GPa is refused: stiffness must be 1e-9 to 1e7 GPa"),
    ("radius_m", "", "Enter a number in each box. Empty: Radius."),
    ("spin_error_rad_s", "", "Enter a number in each box. Empty: Standard error of the spin."),
    ("radius_error_m", "-5", "Standard error of the radius: it must not be negative"),
];

/// A number out of its range is refused by the label and in the unit of its box, and standard errors give probabilities.
pub fn refusal(browser: &mut Browser) -> Result<(), String> {
    for (column, entered, expected) in REFUSED {
        enter(browser, column, entered)?;
        browser.wait_for(READY)?;
        same("the reason", &browser.text("document.getElementById('margin').textContent")?, expected)?;
        let left = browser.value("document.querySelectorAll('#numbers td, #results svg').length")?;
        if left != json!(0) {
            return Err(format!("{left} numbers and charts of another impact are left beside the refusal"));
        }
        reset(browser)?;
    }

    enter(browser, "speed_normal_m_s", "1.5")?;
    enter(browser, "speed_normal_error_m_s", "5")?;
    browser.wait_for(READY)?;
    let table = browser.text("table(scene.columns())")?;
    let classified = program(&["classify", "-", "--model", "simulation", "--format", "csv"], table.as_bytes())?;
    let rolling: f64 = first_row(&classified, "probability_rebound_rolling")?.parse().map_err(|_| "no probability")?;
    let shown = browser.text("document.getElementById('margin').textContent")?;
    if !shown.contains(&format!("rebound, rolling {rolling:.3}")) {
        return Err(format!("the probability of a rolling rebound is {rolling}; the page shows {shown}"));
    }
    reset(browser)
}

/// Enters a number in a field.
fn enter(browser: &mut Browser, id: &str, number: &str) -> Result<(), String> {
    browser.value(&format!(
        "(() => {{ const field = document.getElementById('{id}'); field.value = '{number}'; \
         field.dispatchEvent(new Event('input')); }})()"
    ))?;
    Ok(())
}

/// The rigid body has the class, the restitution and the critical speed of the program, by each law.
pub fn rigid_body(browser: &mut Browser) -> Result<(), String> {
    choose(browser, "scene_model", "rigid-body")?;
    let laws =
        [("speed", "work"), ("constant", "coefficient"), ("speed", "none"), ("power", "speed"), ("yield", "work")];
    for (restitution, adhesion) in laws {
        choose(browser, "restitution_law", restitution)?;
        choose(browser, "adhesion_law", adhesion)?;
        browser.wait_for(READY)?;
        let table = browser.text("table(scene.columns())")?;
        let classified = program(&["classify", "-", "--model", "rigid-body", "--format", "csv"], table.as_bytes())?;
        let outcome = first_row(&classified, "outcome")?.replace("capture", "captured");
        let class = format!("{outcome}, {}", first_row(&classified, "motion")?);
        let shown = browser.text("document.getElementById('class').textContent")?;
        same("the class of the rigid body", &shown.to_lowercase(), &class)?;
        let margin = browser.text("document.getElementById('margin').textContent")?;
        let over = first_row(&classified, "speed_over_critical")?;
        let stated = if over.is_empty() {
            "There is no critical speed".to_owned()
        } else {
            format!("is {} times the critical speed", browser.text(&format!("digits({})", json!(over)))?)
        };
        if !margin.contains(&stated) {
            return Err(format!("the page says \"{margin}\" where it must say \"{stated}\""));
        }
        let curve = browser.value("document.querySelectorAll('#restitution-curve > svg polyline').length")?;
        let page = browser.text("document.querySelector('main').innerHTML")?;
        if curve != json!(1) || ["NaN", "Infinity", "undefined"].iter().any(|word| page.contains(word)) {
            return Err(format!(
                "rigid body, restitution {restitution}, adhesion {adhesion}: the curve is missing, or a number is none"
            ));
        }
    }
    reset(browser)
}

/// Two materials set what the program computes for them, and a number that is set by hand is that of no material.
pub fn materials(browser: &mut Browser) -> Result<(), String> {
    browser.wait_for("document.getElementById('surface_material').options.length > 10")?;
    choose(browser, "sphere_material", "polystyrene")?;
    choose(browser, "surface_material", "steel")?;
    let pair = program(&["materials", "polystyrene", "steel", "--format", "csv"], b"")?;
    browser.wait_for("scene.columns().stiffness_pa !== '75000000000'")?;
    for column in ["density_kg_m3", "stiffness_pa"] {
        let found =
            browser.text(&format!("scene.columns().{column}"))?.parse::<f64>().map_err(|error| error.to_string())?;
        let expected = first_row(&pair, column)?.parse::<f64>().map_err(|error| error.to_string())?;
        if (found / expected - 1.0).abs() > 1e-9 {
            return Err(format!("{column} of polystyrene on steel is {found} and not {expected}"));
        }
    }
    let noted = browser.text("scene.note.textContent")?;
    if !noted.contains("strength of adhesion") {
        return Err(format!("the page does not say that the ring is not that of the materials, but \"{noted}\""));
    }
    enter(browser, "stiffness_pa", "75")?;
    same("the material of a surface by its numbers", &browser.text("scene.values.surface_material")?, "")?;
    work_of_another_pair(browser)?;
    reset(browser)
}

/// The work of adhesion of a pair is not that of the pair before: where the list has none, it is the start value, and the page says so.
fn work_of_another_pair(browser: &mut Browser) -> Result<(), String> {
    let work_of = |browser: &mut Browser, [sphere, surface]: [&str; 2], until: &str| {
        choose(browser, "sphere_material", sphere)?;
        choose(browser, "surface_material", surface)?;
        choose(browser, "law", "dmt")?;
        browser.wait_for(until)?;
        Ok::<_, String>((
            browser.text("scene.columns().work_of_adhesion_j_m2")?,
            browser.text("scene.note.textContent")?,
        ))
    };
    let (known, _) = work_of(browser, KNOWN_PAIR, "scene.columns().work_of_adhesion_j_m2 !== '0.1'")?;
    let listed = program(&[&["materials"], &KNOWN_PAIR[..], &["--format", "csv"]].concat(), b"")?;
    same("the work of adhesion of ice on ice", &known, &first_row(&listed, "work_of_adhesion_j_m2")?)?;
    // A surface alone keeps nothing of the pair before.
    choose(browser, "sphere_material", "")?;
    browser.wait_for("scene.note.textContent.includes('choose the material of the sphere too')")?;
    same("the work of adhesion of a surface alone", &browser.text("scene.columns().work_of_adhesion_j_m2")?, "0.1")?;
    let (unknown, note) = work_of(browser, UNKNOWN_PAIR, "scene.note.textContent.includes('polystyrene on steel')")?;
    same("the work of adhesion of polystyrene on steel", &unknown, "0.1")?;
    let expected = "The list does not give for polystyrene on steel: work of adhesion, which is now 100 mJ/m².";
    same("what the page says of it", note.split_inclusive('.').next().unwrap_or_default(), expected)
}

/// A speed along a path has two components, and a force and the other terms that are folded away reach the program.
pub fn angle_and_force(browser: &mut Browser) -> Result<(), String> {
    choose(browser, "arrival", "path")?;
    enter(browser, "path_speed", "4")?;
    enter(browser, "path_angle", "30")?;
    enter(browser, "external_force_n", "-2")?;
    enter(browser, "gyration_ratio", "0.6")?;
    browser.wait_for(READY)?;
    for (column, expected) in [
        ("speed_normal_m_s", 12.0_f64.sqrt()),
        ("speed_tangential_m_s", 2.0),
        ("external_force_n", -2e-6),
        ("gyration_ratio", 0.6),
    ] {
        let found = browser.text(&format!("scene.columns().{column}"))?;
        let error = found.parse::<f64>().map_err(|error| error.to_string())? / expected - 1.0;
        if error.abs() > 1e-9 {
            return Err(format!("{column} is {found} and not {expected}"));
        }
    }
    answered(browser)?;
    enter(browser, "path_speed", "-2")?;
    browser.wait_for(READY)?;
    let expected = "Speed along the path, Angle between path and normal: the approach speed must be 1e-12 to 1e6 m/s";
    same("the reason", &browser.text("document.getElementById('margin').textContent")?, expected)?;
    enter(browser, "path_speed", "4")?;
    // The program knows no force with this end.
    enter(browser, "external_force_n", "0")?;
    choose(browser, "law", "hertz")?;
    choose(browser, "end_of_hertz", "no-force")?;
    browser.wait_for(READY)?;
    same("the end of contact", &browser.text("scene.columns().end_rule")?, "no-force")?;
    answered(browser)?;
    reset(browser)
}

/// Fails with the reason if there is no answer.
fn answered(browser: &mut Browser) -> Result<(), String> {
    let class = browser.text("document.getElementById('class').textContent")?;
    if class == "No answer" { Err(browser.text("document.getElementById('margin').textContent")?) } else { Ok(()) }
}
