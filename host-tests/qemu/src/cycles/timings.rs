//! Cycles of executed instructions by the published timings of a core: a model, with the fewest and the most that the timings allow.

use std::collections::HashMap;
use std::ops::{AddAssign, Sub};
use std::path::PathBuf;

use boards::firmware;

use super::trace::{Instruction, Trace};

#[cfg(test)]
mod tests;

/// The names of conditions, which are appended to those of instructions.
const CONDITIONS: [&str; 17] =
    ["eq", "ne", "hs", "cs", "lo", "cc", "mi", "pl", "vs", "vc", "hi", "ls", "ge", "lt", "gt", "le", "al"];

/// Names of rows that are no instructions: what is added to an instruction that stands behind another.
const BEHIND_LOAD: &str = "(behind-a-load)";
const FLOATING_BEHIND_LOAD: &str = "(floating-behind-a-load)";
const FRESH_ADDRESS: &str = "(address-just-computed)";
const LITERAL: &str = "(literal)";
const RESULT_USED: &str = "(result-used-next)";
const BEHIND_DIVISION: &str = "(integer-behind-a-division)";
const SECOND_NARROW: &str = "(second-of-two-narrow)";
const SECOND: &str = "(second-of-two)";

/// Instructions whose cost depends on their neighbours.
const LOADS: [&str; 6] = ["ldr", "ldrb", "ldrh", "ldrsb", "ldrsh", "vldr"];
const STORES: [&str; 4] = ["str", "strb", "strh", "vstr"];
const DIVISIONS: [&str; 2] = ["vdiv", "vsqrt"];
/// Those that read their first operand.
const READ_FIRST: [&str; 7] = ["vcmp", "vcmpe", "vstr", "vmla", "vmls", "vnmla", "vnmls"];
const FLOATING_ARITHMETIC: [&str; 4] = ["vadd", "vsub", "vmul", "vnmul"];

/// Bytes of the shorter instructions.
const NARROW: u32 = 2;

/// The fewest and the most cycles.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Cycles {
    pub least: f64,
    pub most: f64,
}

impl AddAssign for Cycles {
    fn add_assign(&mut self, other: Self) {
        self.least += other.least;
        self.most += other.most;
    }
}

impl Sub for Cycles {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { least: self.least - other.least, most: self.most - other.most }
    }
}

/// What a row says of an instruction.
#[derive(Debug, Clone, Copy)]
struct Timing {
    cycles: Cycles,
    /// For each word that it moves, in a list of registers.
    each: f64,
    /// More where it changes the flow of control.
    taken: Cycles,
}

/// The timings of a core.
pub(crate) struct Timings {
    core: String,
    rows: HashMap<String, Timing>,
}

/// What is known of an instruction at an address before it is executed.
struct Known<'a> {
    base: String,
    timing: Timing,
    words: f64,
    instruction: &'a Instruction,
    is_floating: bool,
}

/// The file with the timings of all cores.
fn path() -> PathBuf {
    firmware::repository().join("host-tests/data/timings.csv")
}

impl Timings {
    /// Those of a core; cores without timings have none.
    pub(crate) fn of(core: &str) -> Result<Self, String> {
        let path = path();
        let wrong = |what: &str| format!("{}: {what}", path.display());
        let mut reader = csv::Reader::from_path(&path).map_err(|error| wrong(&error.to_string()))?;
        let mut rows = HashMap::new();
        for record in reader.records() {
            let record = record.map_err(|error| wrong(&error.to_string()))?;
            let field = |place: usize| record.get(place).unwrap_or_default();
            if field(0) != core {
                continue;
            }
            let mut numbers = [0.0; 5];
            for (number, place) in numbers.iter_mut().zip(2..) {
                *number = field(place).parse().map_err(|_| wrong(&format!("`{}` is not a number", field(place))))?;
            }
            let [least, most, each, taken_least, taken_most] = numbers;
            let cycles = Cycles { least, most };
            let timing = Timing { cycles, each, taken: Cycles { least: taken_least, most: taken_most } };
            for name in field(1).split_whitespace() {
                if rows.insert(name.to_owned(), timing).is_some() {
                    return Err(wrong(&format!("two rows for {name} on {core}")));
                }
            }
        }
        if rows.is_empty() {
            Err(wrong(&format!("no timings of {core}")))
        } else {
            Ok(Self { core: core.to_owned(), rows })
        }
    }

    /// The cycles of executed instructions.
    pub(crate) fn cycles(&self, trace: &Trace, call: &[u32]) -> Result<Cycles, String> {
        let mut known = HashMap::new();
        for address in call {
            if !known.contains_key(address) {
                let instruction = trace.instructions.get(address);
                let instruction = instruction.ok_or_else(|| format!("QEMU has not disassembled {address:#x}"))?;
                known.insert(*address, self.known(instruction)?);
            }
        }
        let mut sum = Cycles::default();
        let mut before: Option<&Known> = None;
        let mut state = State::default();
        for (place, address) in call.iter().enumerate() {
            let instruction = &known[address];
            let next = call.get(place + 1);
            let is_taken = next.is_some_and(|next| *next != address + instruction.instruction.length);
            let after = next.map(|next| &known[next]);
            sum += self.one(&mut state, before, instruction, after, is_taken);
            before = Some(instruction);
        }
        Ok(sum)
    }

    /// The cycles of one instruction between its neighbours.
    fn one(
        &self,
        state: &mut State,
        before: Option<&Known>,
        now: &Known,
        after: Option<&Known>,
        is_taken: bool,
    ) -> Cycles {
        let Timing { mut cycles, each, taken } = now.timing;
        cycles += Cycles { least: each * now.words, most: each * now.words };
        if is_taken {
            cycles += taken;
        }
        if let Some(before) = before
            && (now.is_load() || now.is_store())
        {
            let feeds_address = now.address().is_some_and(|address| mentions(address, before.result()));
            if before.is_load() && !feeds_address {
                let is_floating = before.is_floating || now.is_floating;
                let saved = self.more(if is_floating { FLOATING_BEHIND_LOAD } else { BEHIND_LOAD });
                // A store that takes one cycle takes it here too.
                cycles =
                    Cycles { least: (cycles.least + saved.least).max(1.0), most: (cycles.most + saved.most).max(1.0) };
            } else if feeds_address && !before.is_load() && !before.is_store() {
                cycles += self.more(FRESH_ADDRESS);
            }
        }
        if now.is_load() && now.address().is_some_and(|address| mentions(address, "pc")) {
            cycles += self.more(LITERAL);
        }
        if FLOATING_ARITHMETIC.contains(&&*now.base) && after.is_some_and(|after| after.uses(now.result())) {
            cycles += self.more(RESULT_USED);
        }
        if state.conditional > 0 {
            state.conditional -= 1;
            // Where its condition does not hold, it takes one cycle; whether it holds is not known.
            cycles.least = if is_taken { cycles.least } else { cycles.least.min(1.0) };
        }
        if let Some(others) = now.base.strip_prefix("it")
            && others.bytes().all(|byte| matches!(byte, b't' | b'e'))
        {
            state.conditional = 1 + others.len();
        }
        let mut saved = Cycles::default();
        if let Some(before) = before.filter(|_| state.may_be_followed) {
            saved += self.more(SECOND);
            if before.instruction.length == NARROW && now.instruction.length == NARROW {
                saved += self.more(SECOND_NARROW);
            }
        }
        cycles += saved;
        state.may_be_followed = saved == Cycles::default() && !is_taken;
        if DIVISIONS.contains(&&*now.base) {
            state.hidden = self.more(BEHIND_DIVISION).least;
        } else if now.is_floating {
            state.hidden = 0.0;
        } else {
            let hidden = cycles.least.min(state.hidden);
            state.hidden -= hidden;
            cycles.least -= hidden;
        }
        cycles
    }

    /// What is added in a situation; nothing where a core does not know it.
    fn more(&self, situation: &str) -> Cycles {
        self.rows.get(situation).map_or_else(Cycles::default, |timing| timing.cycles)
    }

    fn known<'a>(&self, instruction: &'a Instruction) -> Result<Known<'a>, String> {
        let name = instruction.name.split('.').next().unwrap_or_default();
        let unconditional = CONDITIONS.iter().find_map(|condition| name.strip_suffix(condition)).unwrap_or(name);
        // In this order: `bls` is a branch, not a call.
        let candidates = [name, unconditional, name.strip_suffix('s').unwrap_or(name)];
        let base = candidates.into_iter().find(|candidate| self.rows.contains_key(*candidate)).ok_or_else(|| {
            format!(
                "{} has no row for `{} {}` on {}",
                path().display(),
                instruction.name,
                instruction.operands,
                self.core
            )
        })?;
        let variant = variant(instruction).map(|variant| format!("{base}{variant}"));
        let timing = variant.and_then(|name| self.rows.get(&name)).unwrap_or(&self.rows[base]);
        Ok(Known {
            base: base.to_owned(),
            timing: *timing,
            words: words(&instruction.operands),
            instruction,
            is_floating: base.starts_with('v'),
        })
    }
}

/// What follows from the instructions before.
#[derive(Default)]
struct State {
    /// So many instructions stand under a condition.
    conditional: usize,
    /// Whether the instruction before can be issued together with this one: it is no second one itself, and no jump.
    may_be_followed: bool,
    /// Cycles of a division during which integer instructions cost nothing.
    hidden: f64,
}

impl Known<'_> {
    fn is_load(&self) -> bool {
        LOADS.contains(&&*self.base)
    }

    fn is_store(&self) -> bool {
        STORES.contains(&&*self.base)
    }

    /// The register that it writes, as far as it is its first operand.
    fn result(&self) -> &str {
        self.instruction.operands.split(',').next().unwrap_or_default().trim()
    }

    /// The part of its operands that is an address.
    fn address(&self) -> Option<&str> {
        let (_, address) = self.instruction.operands.split_once('[')?;
        address.split(']').next()
    }

    /// Whether an operand behind the first is a register, or the first too where it accumulates or is stored.
    fn uses(&self, register: &str) -> bool {
        let behind = self.instruction.operands.split_once(',').map_or("", |(_, behind)| behind);
        let reads_first = READ_FIRST.contains(&&*self.base);
        mentions(behind, register) || (reads_first && self.result() == register)
    }
}

/// Whether a list of operands has a register in it.
fn mentions(operands: &str, register: &str) -> bool {
    operands.split(|letter: char| !letter.is_ascii_alphanumeric()).any(|operand| operand == register)
}

/// What tells instructions of one name apart: registers of double precision, a store to the sum of two registers, three operands.
fn variant(instruction: &Instruction) -> Option<&'static str> {
    let Instruction { name, operands, .. } = instruction;
    if name.contains(".f64") {
        return Some("+f64");
    }
    if let Some((_, address)) = operands.split_once('[') {
        let has_index = address.split(',').nth(1).is_some_and(|offset| !offset.contains('#'));
        return has_index.then_some("+index");
    }
    (operands.split(',').count() == 3).then_some("+three")
}

/// The words that an instruction moves, in a list or in a floating-point register.
fn words(operands: &str) -> f64 {
    let (list, is_list) = match operands.split_once('{') {
        Some((_, list)) => (list.trim_end_matches('}'), true),
        None => (operands.split(',').next().unwrap_or_default(), false),
    };
    let registers = list.split(',').map(str::trim);
    let words = registers.map(|register| if register.starts_with('d') { 2.0 } else { 1.0 });
    if is_list { words.sum() } else { words.take(1).sum() }
}
