//! The section on cost of `cargo write-report`: its choices are within the errors that they promise, and the cheapest drawn.

use std::path::Path;

use reference::repetitions;

use crate::report::report;

type Row = std::collections::HashMap<String, String>;

fn rows(folder: &Path, name: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(folder.join(name)).expect("the table has its file");
    reader.deserialize().map(|row| row.expect("the file is a table")).collect()
}

fn number(row: &Row, column: &str) -> Option<f64> {
    row[column].parse().ok()
}

/// It measures for minutes in an unoptimised build: `.ci/run tests` builds it optimised.
#[test]
fn choices_are_the_cheapest_within_their_error() {
    if !repetitions(true, false) {
        return;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report-cost");
    let path = folder.to_str().expect("the folder has a name in Unicode");
    let arguments = ["--quick", "--only", "cost", "--output", path];
    assert_eq!(report(&arguments), Ok(true));

    let mut compared = 0;
    let drawn = rows(&folder, "cost-host-s-normal-f64.csv");
    for choice in rows(&folder, "cost-choice.csv") {
        let (promised, error) = (number(&choice, "error to").unwrap(), number(&choice, "its error").unwrap());
        assert!(error <= promised, "{choice:?}");
        let here =
            ["processor", "number type", "asked for"].map(|column| &*choice[column]) == ["host", "f64", "normal"];
        for other in drawn.iter().filter(|_| here) {
            let (error, time) = (number(other, "error"), number(other, "least time, s").unwrap());
            let exact = error.is_some_and(|error| error <= promised);
            assert!(!exact || time >= number(&choice, "cost").unwrap(), "{other:?} undercuts {choice:?}");
            compared += 1;
        }
    }
    assert!(compared > 200, "{compared}");

    // The summary has the cheapest of all number types.
    let choices = rows(&folder, "cost-choice-all-scenes.csv");
    let summary = rows(&folder, "cost-summary.csv");
    for row in &summary {
        let level = number(row, "error").unwrap();
        let here = choices.iter().filter(|choice| {
            [&*choice["processor"], &*choice["unit"], &*choice["asked for"]] == ["host", "s", &*row["asked for"]]
        });
        let exact = here.filter(|choice| number(choice, "its error").unwrap() <= level);
        let least = exact.map(|choice| number(choice, "cost").unwrap()).min_by(f64::total_cmp).unwrap();
        assert!(row["host, least time"].starts_with(&format!("{:.2} µs: ", 1e6 * least)), "{row:?}");
    }
    assert!(summary.len() >= 12, "{}", summary.len());

    // The factor to the best peer is that of the settings with all outputs.
    let drawn = rows(&folder, "cost-host-s-normal-with-contact-time-and-impulse-f64.csv");
    for row in rows(&folder, "cost-ratios.csv").iter().filter(|row| !row["this computer"].is_empty()) {
        let level = number(row, "error").unwrap();
        let least = |ours: bool| {
            let of = drawn.iter().filter(|one| {
                ours == ["Collocation", "Adaptive", "FixedCost", "the paper's method"].contains(&&*one["method"])
            });
            let exact = of.filter(|one| number(one, "error").is_some_and(|error| error <= level));
            exact.map(|one| number(one, "least time, s").unwrap()).min_by(f64::total_cmp).unwrap()
        };
        let (ratio, _) = row["this computer"].split_once(", ").unwrap();
        assert!((ratio.parse::<f64>().unwrap() - least(false) / least(true)).abs() < 0.006, "{row:?}");
    }

    // Settings that did not converge are in the data too.
    let data = rows(&folder, "cost-host-s-normal-with-contact-time-and-impulse-f64.csv");
    assert!(data.iter().any(|row| row["error"].is_empty()) && data.iter().any(|row| !row["error"].is_empty()));
}
