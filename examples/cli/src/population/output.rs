//! The statistics as tables, as CSV and as JSON.

use std::error::Error;
use std::io::Write;

use comfy_table::{CellAlignment, Table, presets};
use population::{Estimate, Moments, Results};
use serde::Serialize;

use super::Answer;

/// A table whose first columns, so many as `words`, hold words.
fn table(heads: &[&str], words: usize, rows: impl IntoIterator<Item = Vec<String>>) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_header(heads).add_rows(rows);
    for column in table.column_iter_mut().skip(words) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Four digits after the point, or as many as the error leaves.
fn probability(number: Estimate) -> String {
    let digits = if number.error < 1e-4 { 4 } else { 3 };
    format!("{:.digits$}", number.value.clamp(0.0, 1.0))
}

fn errors(results: &Results) -> f64 {
    let classes = results.classes_by_number.named().into_iter().chain(results.classes_by_mass.named());
    let sizes = results.sizes.iter().flat_map(|size| [size.by_number, size.by_mass]);
    let bounces = results.bounces.iter().map(|bounce| bounce.bounce_fraction);
    let all = classes.map(|(_, number)| number).chain(sizes).chain(bounces);
    all.map(|number| number.error).fold(0.0, f64::max)
}

/// Writes tables to read.
pub(super) fn tables(answers: &[Answer], model: &str, to: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    for (name, answer) in answers {
        match answer {
            Err(reason) => writeln!(to, "{name}: bad row: {reason}\n")?,
            Ok(results) => results_in_tables(name, model, results, to)?,
        }
    }
    Ok(())
}

fn results_in_tables(name: &str, model: &str, results: &Results, to: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    writeln!(to, "{name} ({})", model)?;
    let by_mass = results.classes_by_mass.named();
    let classes = results.classes_by_number.named().into_iter().zip(by_mass);
    let rows =
        classes.map(|((name, number), (_, mass))| vec![name.replace('_', " "), probability(number), probability(mass)]);
    writeln!(to, "{}", table(&["class", "probability\nby number", "probability\nby mass"], 1, rows))?;
    if !results.sizes.is_empty() {
        let rows = results.sizes.iter().map(|size| {
            vec![
                format!("{:.3e}", size.from),
                format!("{:.3e}", size.to),
                format!("{:.4}", size.number),
                format!("{:.4}", size.mass),
                probability(size.by_number),
                probability(size.by_mass),
            ]
        });
        let heads = [
            "diameter\nfrom, m",
            "to, m",
            "part of\nnumber",
            "part of\nmass",
            "captured\nby number",
            "captured\nby mass",
        ];
        writeln!(to, "{}", table(&heads, 0, rows))?;
    }
    let rows = results.bounces.iter().map(|bounce| {
        vec![
            format!("{:.4}", bounce.speed),
            probability(bounce.bounce_fraction),
            format!("{:.3}", bounce.interval[0]),
            format!("{:.3}", bounce.interval[1]),
        ]
    });
    let particles = format!("95 % of {}\nfrom", results.particles);
    writeln!(to, "{}", table(&["speed\nm/s", "bounce\nfraction", &particles, "to"], 0, rows))?;
    let spreads = [("rebounds", results.restitution_of_rebounds), ("all impacts", Some(results.restitution))];
    let rows = spreads.into_iter().filter_map(|(name, spread)| {
        let Moments { mean, variance, skewness } = spread?;
        let numbers = [mean, variance, skewness].map(|number| format!("{:.4}", number.value));
        Some([&[name.to_owned()][..], &numbers].concat())
    });
    writeln!(to, "{}", table(&["restitution e", "mean", "variance", "skewness"], 1, rows))?;
    writeln!(to, "Largest error of these probabilities by quadrature: {:.1e}\n", errors(results))?;
    Ok(())
}

/// One number of the CSV format.
#[derive(Default, Serialize)]
struct Line<'a> {
    population: &'a str,
    model: &'a str,
    quantity: String,
    from: Option<f64>,
    to: Option<f64>,
    value: Option<f64>,
    numerical_error: Option<f64>,
    low: Option<f64>,
    high: Option<f64>,
    error: &'a str,
}

/// Writes a row for each number.
pub(super) fn csv(answers: &[Answer], model: &str, to: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mut writer = csv::Writer::from_writer(to);
    for (population, answer) in answers {
        let results = match answer {
            Ok(results) => results,
            Err(reason) => {
                writer.serialize(Line { population, error: reason, ..Line::default() })?;
                continue;
            }
        };
        let line = |quantity: String, Estimate { value, error }: Estimate| Line {
            population,
            model,
            quantity,
            value: Some(value),
            numerical_error: Some(error),
            ..Line::default()
        };
        for (by, classes) in [("", &results.classes_by_number), ("_by_mass", &results.classes_by_mass)] {
            for (class, number) in classes.named() {
                writer.serialize(line(format!("probability_{class}{by}"), number))?;
            }
        }
        for size in &results.sizes {
            let exact = |value| Estimate { value, error: 0.0 };
            for (quantity, number) in [
                ("number_fraction", exact(size.number)),
                ("mass_fraction", exact(size.mass)),
                ("capture_efficiency_number", size.by_number),
                ("capture_efficiency_mass", size.by_mass),
            ] {
                let (from, to) = (Some(size.from), Some(size.to));
                writer.serialize(Line { from, to, ..line(quantity.into(), number) })?;
            }
        }
        for bounce in &results.bounces {
            let (speed, [low, high]) = (Some(bounce.speed), bounce.interval);
            let ends = Line { from: speed, to: speed, low: Some(low), high: Some(high), ..Line::default() };
            let Line { population, model, quantity, value, numerical_error, .. } =
                line("bounce_fraction".into(), bounce.bounce_fraction);
            writer.serialize(Line { population, model, quantity, value, numerical_error, ..ends })?;
        }
        let spreads =
            [("restitution", Some(results.restitution)), ("restitution_of_rebounds", results.restitution_of_rebounds)];
        for (name, spread) in spreads.into_iter().filter_map(|(name, spread)| Some((name, spread?))) {
            writer.serialize(line(format!("{name}_mean"), spread.mean))?;
            writer.serialize(line(format!("{name}_variance"), spread.variance))?;
            writer.serialize(line(format!("{name}_skewness"), spread.skewness))?;
        }
    }
    writer.flush()?;
    Ok(())
}

/// A population of the JSON format.
#[derive(Serialize)]
struct Object<'a> {
    population: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    model: Option<&'a str>,
    #[serde(flatten)]
    results: Option<&'a Results>,
}

/// Writes an array with an object for each population.
pub(super) fn json(answers: &[Answer], model: &str, to: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let objects: Vec<_> = answers
        .iter()
        .map(|(population, answer)| Object {
            population,
            error: answer.as_ref().err().map(String::as_str),
            model: answer.is_ok().then_some(model),
            results: answer.as_ref().ok(),
        })
        .collect();
    writeln!(to, "{}", serde_json::to_string_pretty(&objects)?)?;
    Ok(())
}
