//! `cargo qemu worst`: the most that every method takes over the shared grid of impacts, in instructions and in stack.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use boards::figures::LARGEST_EXCESS;
use boards::packages::Permission;
use boards::toolchain::Choice;
use boards::{BOARDS, Board, REFERENCE_CORE, emulator, firmware};
use reference::grids::{Impact, PLANES};

/// So many by so many places of each plane.
const PLACES: usize = 12;

const LIMIT: Duration = Duration::from_secs(900);

/// What methods of fixed cost take at most, in instructions and in bytes of stack, whatever the impact is.
const PROMISED: [(&str, [u64; 2]); 5] = [
    ("FixedCost<4>, 2 iterations", [1600, 544]),
    ("FixedCost<5>, 3 iterations", [2200, 544]),
    ("FixedCost<7>, 3 iterations", [3200, 544]),
    ("FixedCost<5, 7>, 3 iterations", [3200, 544]),
    ("FixedCost<7, 9>, 3 iterations", [4400, 544]),
];

/// What a method takes at most.
struct Worst {
    method: String,
    task: String,
    scalar: String,
    impacts: u64,
    instructions: u64,
    /// The impact that takes them, and that whose stack is deepest.
    slowest: usize,
    stack: u64,
    deepest: usize,
}

/// Runs all methods, and stores what they take or names each figure that exceeds the stored one of the same compiler or a promise.
pub(crate) fn compare(choice: Choice, permission: Permission, overwrite: bool) -> Result<Vec<String>, String> {
    let board = BOARDS.iter().find(|board| board.core == REFERENCE_CORE).ok_or("there is no reference core")?;
    let toolchain = crate::tools(choice, std::slice::from_ref(board), permission)?;
    let impacts = grid();
    let file = firmware::target_folder(&toolchain, board).join("grid");
    write(&file, &impacts)?;
    eprintln!("building for {} ({}) ...", board.core, board.triple);
    let folder = firmware::build_with_grid(&toolchain, board, &file, &["worst"])?;
    eprintln!("running {} impacts by every method on {} ({}) ...", impacts.len(), board.core, board.machine);
    let printed = emulator::run_within(LIMIT, board, &folder.join("worst"))?;
    let found = printed.lines().filter(|line| *line != "done").map(Worst::parse).collect::<Result<Vec<_>, _>>()?;
    for worst in &found {
        println!("{}", worst.sentence(&impacts));
    }
    let mut failures: Vec<_> = found.iter().flat_map(Worst::broken).collect();
    if overwrite {
        store(&toolchain.compiler, board, &found)?;
    } else {
        failures.extend(worse(&toolchain.compiler, board, &found)?);
    }
    Ok(failures)
}

/// The impacts of all planes, as single precision sees them.
pub(crate) fn grid() -> Vec<Impact> {
    let mut impacts = Vec::new();
    for plane in &PLANES {
        for x in plane.x.values(PLACES) {
            let impact = |y: f64| (plane.impact)(x, y).map(|impact| impact.in_single_precision());
            impacts.extend(plane.y.values(PLACES).into_iter().filter_map(impact));
        }
    }
    impacts
}

/// The numbers of an impact, in the order in which the firmware and the C program read them.
pub(crate) fn numbers(impact: &Impact) -> [f32; 6] {
    let Impact { radius, stiffness, speed, zeta_h, strength, zeta_a } = *impact;
    [radius, stiffness, speed, zeta_h, strength, zeta_a].map(|number| number as f32)
}

/// As the firmware reads them.
fn write(file: &Path, impacts: &[Impact]) -> Result<(), String> {
    let bytes: Vec<u8> = impacts.iter().flat_map(numbers).flat_map(f32::to_le_bytes).collect();
    let folder = file.parent().unwrap_or(file);
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(file, bytes))
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

impl Worst {
    /// From a line that the firmware prints.
    fn parse(line: &str) -> Result<Self, String> {
        let wrong = || format!("the firmware printed {line:?}");
        let [method, task, scalar, numbers @ ..] = &*Vec::from_iter(line.split(';')) else { return Err(wrong()) };
        let numbers: Vec<u64> =
            numbers.iter().map(|number| number.parse()).collect::<Result<_, _>>().map_err(|_| wrong())?;
        let [impacts, instructions, slowest, stack, deepest] = *numbers else { return Err(wrong()) };
        let [method, task, scalar] = [method, task, scalar].map(|text| (*text).to_owned());
        let (slowest, deepest) = (slowest as usize, deepest as usize);
        Ok(Self { method, task, scalar, impacts, instructions, slowest, stack, deepest })
    }

    fn name(&self) -> String {
        format!("{}; {}; {}", self.method, self.task, self.scalar)
    }

    fn sentence(&self, grid: &[Impact]) -> String {
        let Self { impacts, instructions, slowest, stack, deepest, .. } = self;
        let [slow, deep] = [slowest, deepest].map(|place| grid.get(*place).map(words).unwrap_or_default());
        let name = self.name();
        format!(
            "{name}: in {impacts} impacts at most\n  {instructions} instructions: {slow}\n  {stack} bytes of stack: {deep}"
        )
    }

    /// The figures that are gated, in words.
    fn figures(&self) -> [(&'static str, u64); 2] {
        [("instructions", self.instructions), ("bytes of stack", self.stack)]
    }

    /// Every promise that is broken.
    fn broken(&self) -> Vec<String> {
        let Some((_, limits)) = PROMISED.iter().find(|(method, _)| self.method == *method) else { return Vec::new() };
        let beyond = self.figures().into_iter().zip(limits).filter(|((_, found), limit)| found > *limit);
        let broken =
            |((what, found), limit)| format!("{}: {found} {what}; the promise is at most {limit}", self.name());
        beyond.map(broken).collect()
    }
}

/// An impact in the words of the paper.
fn words(impact: &Impact) -> String {
    let Impact { radius, stiffness, speed, zeta_h, strength, zeta_a } = impact;
    format!(
        "r = {radius:.3e} m, K = {stiffness:.3e} Pa, v = {speed:.3e} m/s, zeta_H = {zeta_h:.3e}, f0 = {strength:.3e} N/m, \
         zeta_A = {zeta_a:.3e}"
    )
}

const HEADER: [&str; 8] = ["compiler", "core", "method", "task", "scalar", "impacts", "instructions", "stack (bytes)"];

fn path() -> PathBuf {
    firmware::repository().join("host-tests/data/worst.csv")
}

/// Stores the figures in place of those that were there.
fn store(compiler: &str, board: &Board, found: &[Worst]) -> Result<(), String> {
    let write = || {
        let mut writer = csv::Writer::from_path(path())?;
        writer.write_record(HEADER)?;
        for worst in found {
            let Worst { method, task, scalar, impacts, instructions, stack, .. } = worst;
            let numbers = [impacts, instructions, stack].map(u64::to_string);
            let texts =
                [compiler, board.core, method, task, scalar].into_iter().chain(numbers.iter().map(String::as_str));
            writer.write_record(texts)?;
        }
        writer.flush()?;
        Ok(())
    };
    write().map_err(|error: csv::Error| format!("cannot write {}: {error}", path().display()))
}

/// Every figure that exceeds the stored one, and every method without one.
fn worse(compiler: &str, board: &Board, found: &[Worst]) -> Result<Vec<String>, String> {
    let unreadable = |error: csv::Error| format!("cannot read {}: {error}", path().display());
    let mut reader = csv::Reader::from_path(path()).map_err(unreadable)?;
    let records: Vec<_> = reader.records().collect::<Result<_, _>>().map_err(unreadable)?;
    let field = |record: &csv::StringRecord, name: &str| {
        let column = HEADER.iter().position(|column| *column == name);
        column.and_then(|column| record.get(column)).unwrap_or_default().to_owned()
    };
    let same = |record: &csv::StringRecord, wanted: &[(&str, &str)]| {
        wanted.iter().all(|(column, value)| field(record, column) == *value)
    };
    if !records.iter().any(|record| same(record, &[("compiler", compiler), ("core", board.core)])) {
        eprintln!(
            "no figures are stored for {compiler}, so none are compared; `cargo qemu --overwrite worst` stores them"
        );
        return Ok(Vec::new());
    }
    let mut failures = Vec::new();
    for worst in found {
        let wanted = [("method", &*worst.method), ("task", &*worst.task), ("scalar", &*worst.scalar)];
        let Some(record) = records.iter().find(|record| same(record, &wanted)) else {
            failures.push(format!("{} is not stored; `cargo qemu --overwrite worst` adds it", worst.name()));
            continue;
        };
        for ((what, found), column) in worst.figures().into_iter().zip(["instructions", "stack (bytes)"]) {
            let stored = field(record, column);
            let stored: f64 =
                stored.parse().map_err(|_| format!("{}: {stored:?} is not a number", path().display()))?;
            if found as f64 > stored * (1.0 + LARGEST_EXCESS) {
                failures.push(format!("{}: {found} {what} at most, but {stored} are stored", worst.name()));
            }
        }
    }
    Ok(failures)
}
