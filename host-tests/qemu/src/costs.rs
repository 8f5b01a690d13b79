//! What each function of the C library takes on the board: the table in the README of `examples/c`.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use boards::figures::LARGEST_EXCESS;
use boards::section::Section;

/// The command that writes the table.
const COMMAND: &str = "cargo qemu --overwrite c";

/// A function, its instructions and its stack in bytes.
struct Cost<'a> {
    function: &'a str,
    instructions: u64,
    stack: u64,
}

/// The lines that the program prints: name, instructions and stack.
fn parsed(printed: &str) -> Result<Vec<Cost<'_>>, String> {
    let cost = |line| {
        let [function, instructions, stack] = *Vec::from_iter(str::split(line, ';')) else { return None };
        Some(Cost { function, instructions: instructions.parse().ok()?, stack: stack.parse().ok()? })
    };
    printed.lines().map(|line| cost(line).ok_or(format!("costs.c printed {line:?}"))).collect()
}

/// The table of a page for a compiler.
fn table(compiler: &str, costs: &[Cost]) -> String {
    let mut table = format!(
        "Compiler: {compiler}.\n\n| function, with microimpact_ before it | instructions | stack |\n| --- | --- | --- |\n"
    );
    for Cost { function, instructions, stack } in costs {
        // Writing to a string does not fail.
        let _ = writeln!(table, "| {function} | {instructions} | {stack} |");
    }
    table
}

/// Stores what was printed in a page, or names each figure that exceeds the stored one of the same compiler, each function that is not
/// in the table, and each in the header without a figure.
pub(crate) fn compare(
    page: &Path,
    header: &Path,
    compiler: &str,
    printed: &str,
    overwrite: bool,
) -> Result<Vec<String>, String> {
    let costs = parsed(printed)?;
    let header = fs::read_to_string(header).map_err(|error| format!("cannot read {}: {error}", header.display()))?;
    let section = Section::read(page, COMMAND)?;
    let stored = &section.text;
    let mut failures: Vec<_> = functions(&header)
        .filter(|function| !costs.iter().any(|cost| cost.function.split(',').next() == Some(function)))
        .map(|function| format!("costs.c does not measure {function}"))
        .collect();
    if overwrite {
        section.overwrite(&table(compiler, &costs))?;
        return Ok(failures);
    }
    if !stored.contains(&format!("Compiler: {compiler}.")) {
        eprintln!("no costs are stored for {compiler}, so none are compared; `cargo qemu --overwrite c` stores them");
        return Ok(failures);
    }
    for Cost { function, instructions, stack } in &costs {
        let row = stored.lines().find_map(|line| line.strip_prefix(&format!("| {function} | ")));
        let Some((stored_instructions, stored_stack)) =
            row.and_then(|row| row.trim_end_matches(" |").split_once(" | "))
        else {
            failures.push(format!("{function} is not in {}; `cargo qemu --overwrite c` adds it", page.display()));
            continue;
        };
        for (what, found, stored) in
            [("instructions", *instructions, stored_instructions), ("bytes of stack", *stack, stored_stack)]
        {
            let stored: f64 = stored.parse().map_err(|_| format!("{}: {stored:?} is not a number", page.display()))?;
            if found as f64 > stored * (1.0 + LARGEST_EXCESS) {
                failures.push(format!("{function}: {found} {what}, but {stored} are stored"));
            }
        }
    }
    Ok(failures)
}

/// The functions of a header without the beginning of their names.
fn functions(header: &str) -> impl Iterator<Item = &str> {
    header.lines().filter_map(|line| {
        let (_, function) = line
            .split_once(" microimpact_")
            .filter(|(result, _)| ["MicroimpactStatus", "uint32_t", "size_t"].contains(result))?;
        function.split('(').next()
    })
}
