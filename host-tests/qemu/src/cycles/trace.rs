//! What a firmware executed, from the log of QEMU: every instruction in words once, and then its address each time.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::path::Path;

/// An instruction of a firmware.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// In bytes.
    pub length: u32,
    /// Its name with what is appended to it: `vadd.f32`, `ldr.w`, `bne`.
    pub name: String,
    pub operands: String,
}

/// The calls that were followed.
pub(crate) struct Trace {
    /// By address.
    pub instructions: HashMap<u32, Instruction>,
    /// The addresses that each call executed, in order.
    pub calls: Vec<Vec<u32>>,
}

/// Reads a log. A call is what is executed between two readings of the counter: after the function at `reading` returns and until it
/// is entered again.
pub(crate) fn read(log: &Path, reading: &Range<u32>) -> Result<Trace, String> {
    let unreadable = |error| format!("cannot read {}: {error}", log.display());
    let lines = BufReader::new(File::open(log).map_err(unreadable)?).lines();
    let mut trace = Trace { instructions: HashMap::new(), calls: Vec::new() };
    let mut calls = Calls { reading, readings: 0, current: Vec::new(), ended: Vec::new() };
    let mut announced = None;
    for line in lines {
        let line = line.map_err(unreadable)?;
        if line.starts_with("Trace ") {
            let address = executed(&line).ok_or_else(|| format!("QEMU's log has the line {line:?}"))?;
            if let Some(before) = announced.replace(address) {
                calls.take(before);
            }
        } else if line.starts_with("Stopped execution ") {
            // It is announced again when it is executed.
            announced = None;
        } else if let Some((address, instruction)) = disassembled(&line) {
            trace.instructions.insert(address, instruction);
        }
    }
    if let Some(last) = announced {
        calls.take(last);
    }
    trace.calls = calls.ended;
    if trace.instructions.is_empty() {
        return Err("this QEMU does not disassemble; one that is built with the library Capstone does".to_owned());
    }
    Ok(trace)
}

/// Tells calls apart.
struct Calls<'a> {
    reading: &'a Range<u32>,
    readings: usize,
    current: Vec<u32>,
    ended: Vec<Vec<u32>>,
}

impl Calls<'_> {
    fn take(&mut self, address: u32) {
        if address == self.reading.start {
            self.readings += 1;
            let call = std::mem::take(&mut self.current);
            // Every other interval lies between two measurements.
            if self.readings.is_multiple_of(2) {
                self.ended.push(call);
            }
        } else if !self.reading.contains(&address) {
            self.current.push(address);
        }
    }
}

/// The address in `Trace 0: 0x7fb384026200 [00800400/00013992/00000010/ff020201] NAME`.
fn executed(line: &str) -> Option<u32> {
    let (_, state) = line.split_once('[')?;
    u32::from_str_radix(state.split('/').nth(1)?, 16).ok()
}

/// An instruction in `0x000151a8:  e92d 0b00  push.w   {r8, sb, fp}`, or with all digits in one group.
fn disassembled(line: &str) -> Option<(u32, Instruction)> {
    let (address, rest) = line.strip_prefix("0x")?.split_once(':')?;
    let address = u32::from_str_radix(address, 16).ok()?;
    let mut rest = rest.trim_start();
    let mut digits = 0;
    while let Some((group, after)) = rest.split_once(' ')
        && matches!(group.len(), 4 | 8)
        && digits + group.len() <= 8
        && group.bytes().all(|byte| byte.is_ascii_hexdigit())
    {
        digits += group.len();
        // Two spaces end the digits.
        let is_last = after.starts_with(' ');
        rest = after.trim_start();
        if is_last {
            break;
        }
    }
    let text = rest.split('#').next().filter(|_| rest.contains(" # ")).unwrap_or(rest);
    let (name, operands) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let (name, operands) = (name.to_owned(), operands.trim().to_owned());
    (digits > 0 && !name.is_empty()).then_some((address, Instruction { length: digits as u32 / 2, name, operands }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_are_read_from_their_lines() {
        let parsed =
            |line| disassembled(line).map(|(address, found)| (address, found.length, found.name, found.operands));
        let owned =
            |address, length, name: &str, operands: &str| Some((address, length, name.to_owned(), operands.to_owned()));
        assert_eq!(parsed("0x0000040e:  c004       stm      r0!, {r2}"), owned(0x40e, 2, "stm", "r0!, {r2}"));
        assert_eq!(
            parsed("0x000151a8:  e92d 0b00  push.w   {r8, sb, fp}"),
            owned(0x151a8, 4, "push.w", "{r8, sb, fp}")
        );
        let auipc = "0x80015834:  00005097          auipc                   ra,20480                # 0x8001a834";
        assert_eq!(parsed(auipc), owned(0x8001_5834, 4, "auipc", "ra,20480"));
        assert_eq!(
            parsed("0x80015806:  8566              mv                      a0,s9"),
            owned(0x8001_5806, 2, "mv", "a0,s9")
        );
        assert_eq!(parsed("0x80015806:  8566              ret"), owned(0x8001_5806, 2, "ret", ""));
        assert_eq!(parsed("IN: Reset"), None);
    }
}
