//! The factors of a contest, kept in `host-tests/data/contest.csv`.

use std::error::Error;

use sysinfo::{CpuRefreshKind, RefreshKind, System};

use crate::contestant::Asked;
use crate::duel::{Duel, Winner};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/contest.csv");

const COLUMNS: [&str; 11] = [
    "axis",
    "value",
    "error",
    "asked",
    "ours",
    "our_setting",
    "peer",
    "peer_setting",
    "factor",
    "factor_adaptive",
    "machine",
];

/// Names of what both sides are asked for.
const ASKED: [(Asked, &str); 2] = [(Asked::Restitution, "e"), (Asked::Outputs, "e, time and impulse")];

/// How a table names what both sides are asked for.
pub fn asked_for(asked: Asked) -> &'static str {
    if asked == ASKED[0].0 { ASKED[0].1 } else { ASKED[1].1 }
}

/// Stores the factors, measured on a kind of machine.
///
/// # Errors
/// The file cannot be written.
pub fn store(duels: &[Duel], machine: &str) -> Result<(), Box<dyn Error>> {
    let mut writer = csv::Writer::from_path(PATH)?;
    writer.write_record(COLUMNS)?;
    for duel in duels {
        writer.write_record([
            &duel.axis,
            &duel.value.to_string(),
            &format!("{:e}", duel.level),
            asked_for(duel.asked),
            &duel.ours.entry,
            &duel.ours.setting,
            &duel.peer.entry,
            &duel.peer.setting,
            &format!("{:.2}", duel.factor),
            &duel.adaptive.map_or_else(String::new, |factor| format!("{factor:.2}")),
            machine,
        ])?;
    }
    Ok(writer.flush()?)
}

/// The stored factors, and the kind of machine that they were measured on.
///
/// # Errors
/// The file is no table of factors: measure it again.
pub fn stored() -> Result<(Vec<Duel>, String), String> {
    let fault = |what: &str| format!("host-tests/data/contest.csv: {what}; measure it again by `{COMMAND}`");
    let mut machine = String::new();
    let mut duels = Vec::new();
    let mut reader = csv::Reader::from_path(PATH).map_err(|error| fault(&error.to_string()))?;
    if reader.headers().is_ok_and(|names| names != COLUMNS[..]) {
        return Err(fault("its columns are others"));
    }
    for row in reader.records() {
        let row = row.map_err(|error| fault(&error.to_string()))?;
        let text = |column: &str| COLUMNS.iter().position(|name| *name == column).and_then(|index| row.get(index));
        let text = |column: &str| text(column).unwrap_or("").to_owned();
        let number = |column: &str| -> Result<f64, String> {
            text(column).parse().map_err(|_| fault(&format!("{column} is no number: {}", text(column))))
        };
        let asked = ASKED.iter().find(|(_, name)| *name == text("asked"));
        let winner = |entry: &str, setting: &str| Winner { entry: text(entry), setting: text(setting) };
        machine = text("machine");
        duels.push(Duel {
            axis: text("axis"),
            value: number("value")?,
            level: number("error")?,
            asked: asked.ok_or_else(|| fault("nobody can be asked for that"))?.0,
            ours: winner("ours", "our_setting"),
            peer: winner("peer", "peer_setting"),
            factor: number("factor")?,
            adaptive: number("factor_adaptive").ok(),
        });
    }
    Ok((duels, machine))
}

/// The kind of this machine.
pub fn machine() -> String {
    let system = System::new_with_specifics(RefreshKind::nothing().with_cpu(CpuRefreshKind::nothing()));
    let processor = system.cpus().first().map_or("unknown", |cpu| cpu.brand()).trim().to_owned();
    format!("{} x {processor}, {}", system.cpus().len(), std::env::consts::ARCH)
}

/// What measures and stores them.
pub const COMMAND: &str = "cargo bench -p contest --bench contact -- --peers --store";
