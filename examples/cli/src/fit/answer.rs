//! The answer of a fit, to read and for programs.

use std::error::Error;
use std::io::Write;

use comfy_table::{CellAlignment, Table, presets};
use impact_fit::{Candidate, Interval, Statement, Verdict};
use serde_json::{Map, Value, json};

use super::rows::Measurements;

/// What a fit has found.
pub struct Answer<'a> {
    pub table: &'a Measurements,
    pub verdict: &'a Verdict,
}

impl Answer<'_> {
    /// Writes tables to read.
    pub fn write_table(&self, sink: &mut dyn Write) -> Result<(), Box<dyn Error>> {
        let captures = self.captures();
        writeln!(sink, "impacts: {} rebounds, {captures} captures", self.table.observations.len() - captures)?;
        match self.verdict {
            Verdict::NotEnough(reason) => writeln!(sink, "{reason}")?,
            Verdict::NoLaw(candidates) => {
                writeln!(sink, "no law fits: {}", no_law(candidates))?;
                writeln!(sink, "{}", candidate_table(candidates))?;
            }
            Verdict::Fits(statement) => {
                writeln!(
                    sink,
                    "law: {}, which fits (p = {:.3})",
                    statement.fit.law.name(),
                    statement.fit.judgement.p_value()
                )?;
                let alike = names(&statement.not_told_apart());
                if !alike.is_empty() {
                    writeln!(sink, "these data cannot tell it apart from: {}", alike.join(", "))?;
                }
                writeln!(sink, "{}", quantity_table(statement))?;
                if let Some((diameter, true)) = self.table.diameter {
                    writeln!(sink, "work and critical speed: for the median diameter, {diameter:.4e} m")?;
                }
                let skewed = if statement.fit.is_skewed() { ", skewed" } else { "" };
                writeln!(
                    sink,
                    "natural scatter of e: {:.4}{skewed}; outliers: {:.1} %",
                    statement.fit.scatter(),
                    100.0 * statement.fit.outliers()
                )?;
                writeln!(sink, "{}", candidate_table(&statement.candidates))?;
            }
        }
        Ok(())
    }

    /// Writes one JSON object.
    pub fn write_json(&self, sink: &mut dyn Write) -> Result<(), Box<dyn Error>> {
        let captures = self.captures();
        let mut answer = Map::new();
        let mut put = |name: &str, value: Value| {
            answer.insert(name.to_owned(), value);
        };
        match self.verdict {
            Verdict::NotEnough(reason) => {
                put("law", "none".into());
                put("fits", Value::Null);
                put("p_value", Value::Null);
                put("reason", reason.as_str().into());
                put("parameters", json!({}));
            }
            Verdict::NoLaw(candidates) => {
                put("law", "none".into());
                put("fits", false.into());
                put("p_value", p_value(candidates).into());
                put("reason", no_law(candidates).into());
                put("parameters", json!({}));
                put("candidates", candidates_json(candidates));
            }
            Verdict::Fits(statement) => {
                put("law", statement.fit.law.name().into());
                put("fits", true.into());
                put("p_value", statement.fit.judgement.p_value().into());
                let quantities = statement.quantities.iter();
                let parameters: Map<_, _> =
                    quantities.map(|quantity| (quantity.name.to_owned(), interval_json(quantity.interval))).collect();
                put("parameters", parameters.into());
                let alike = names(&statement.not_told_apart());
                put("told_apart", alike.is_empty().into());
                if !alike.is_empty() {
                    put("reason", format!("these data cannot tell the law apart from: {}", alike.join(", ")).into());
                }
                put("indistinguishable_laws", alike.into());
                put("candidates", candidates_json(&statement.candidates));
                put("natural_scatter", statement.fit.scatter().into());
                put("skewed_scatter", statement.fit.is_skewed().into());
                put("outlier_fraction", statement.fit.outliers().into());
            }
        }
        put("rebounds", (self.table.observations.len() - captures).into());
        put("captures", captures.into());
        if let Some((diameter, _)) = self.table.diameter {
            put("median_diameter_m", diameter.into());
        }
        if self.table.default_error {
            put("assumed_velocity_error_m_s", super::rows::VELOCITY_ERROR.into());
        }
        put("assumptions", self.table.assumptions.clone().into());
        writeln!(sink, "{}", serde_json::to_string_pretty(&Value::from(answer))?)?;
        Ok(())
    }

    /// Writes a row for each parameter.
    pub fn write_csv(&self, sink: &mut dyn Write) -> Result<(), Box<dyn Error>> {
        let mut writer = csv::Writer::from_writer(sink);
        writer.write_record(["law", "fits", "p_value", "parameter", "value", "low", "high"])?;
        match self.verdict {
            Verdict::NotEnough(_) => writer.write_record(["none", "", "", "", "", "", ""])?,
            Verdict::NoLaw(candidates) => {
                writer.write_record(["none", "false", &p_value(candidates).to_string(), "", "", "", ""])?;
            }
            Verdict::Fits(statement) => {
                for quantity in &statement.quantities {
                    let Interval { value, low, high } = quantity.interval;
                    let high = if high.is_finite() { high.to_string() } else { String::new() };
                    let (name, p_value) = (statement.fit.law.name(), statement.fit.judgement.p_value().to_string());
                    let numbers = [value.to_string(), low.to_string(), high];
                    writer.write_record(
                        [&[name, "true", &p_value, quantity.name][..], &numbers.each_ref().map(String::as_str)]
                            .concat(),
                    )?;
                }
            }
        }
        Ok(writer.flush()?)
    }

    fn captures(&self) -> usize {
        self.table.observations.iter().filter(|observation| !observation.rebounds()).count()
    }
}

fn names(laws: &[impact_fit::Law]) -> Vec<String> {
    laws.iter().map(|law| law.name().to_owned()).collect()
}

/// The probability of the best law.
fn p_value(candidates: &[Candidate]) -> f64 {
    candidates.first().map_or(0.0, |candidate| candidate.p_value)
}

fn no_law(candidates: &[Candidate]) -> String {
    match candidates.first() {
        Some(best) => {
            format!("the best of {} laws, {}, has p = {:.1e}", candidates.len(), best.law.name(), best.p_value)
        }
        None => "no curve of any law comes near the data".to_owned(),
    }
}

fn quantity_table(statement: &Statement) -> Table {
    let mut table = table(&["", "value", "95 % from", "to", "unit"]);
    for quantity in &statement.quantities {
        let Interval { value, low, high } = quantity.interval;
        let numbers =
            [value, low, high].map(|number| if number.is_finite() { digits(number) } else { "no bound".into() });
        table.add_row([&[quantity.symbol.to_owned()][..], &numbers, &[quantity.unit.to_owned()]].concat());
    }
    table
}

fn candidate_table(candidates: &[Candidate]) -> Table {
    let mut table = table(&["law", "AIC above the best", "p", "fits"]);
    for candidate in candidates {
        let fits = if candidate.fits() { "yes" } else { "no" };
        let p_value = format!("{:.1e}", candidate.p_value);
        table.add_row([candidate.law.name(), &format!("{:.1}", candidate.aic), &p_value, fits]);
    }
    table
}

fn table(heads: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_preset(presets::UTF8_FULL_CONDENSED).set_header(heads);
    for column in table.column_iter_mut().skip(1).take(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// Five significant digits.
fn digits(number: f64) -> String {
    let size = number.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{number:.4e}");
    }
    let before = if size > 0.0 { size.log10().floor() as i32 } else { 0 };
    format!("{number:.*}", (4 - before).max(0) as usize)
}

fn interval_json(interval: Interval) -> Value {
    json!({ "value": number(interval.value), "low": number(interval.low), "high": number(interval.high) })
}

/// A number; null where there is no bound.
fn number(value: f64) -> Value {
    if value.is_finite() { value.into() } else { Value::Null }
}

fn candidates_json(candidates: &[Candidate]) -> Value {
    let object = |candidate: &Candidate| {
        json!({
            "law": candidate.law.name(),
            "aic_above_best": number(candidate.aic),
            "p_value": candidate.p_value,
            "fits": candidate.fits(),
        })
    };
    candidates.iter().map(object).collect::<Vec<_>>().into()
}
