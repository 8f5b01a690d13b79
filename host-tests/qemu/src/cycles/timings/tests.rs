//! The timings against examples of the manuals, known durations and sums by hand.

use super::*;

/// The cycles of instructions on a core, `turns` times one after the other; each is length, name and operands.
fn cycles(core: &str, instructions: &[(u32, &str, &str)], turns: usize) -> Cycles {
    let (mut trace, mut turn, mut address) = (Trace { instructions: HashMap::new(), calls: Vec::new() }, Vec::new(), 0);
    for (length, name, operands) in instructions {
        let [name, operands] = [name, operands].map(|text| (*text).to_owned());
        trace.instructions.insert(address, Instruction { length: *length, name, operands });
        turn.push(address);
        address += length;
    }
    Timings::of(core).unwrap().cycles(&trace, &turn.repeat(turns)).unwrap()
}

fn exactly(cycles: f64) -> Cycles {
    Cycles { least: cycles, most: cycles }
}

/// The examples of the manuals of Cortex-M3 (DDI 0337I, section 3.3.2) and Cortex-M4, with the totals printed there.
#[test]
fn pipelined_loads_take_what_the_manual_says() {
    let load = |operands| (2, "ldr", operands);
    for core in ["Cortex-M3", "Cortex-M4F"] {
        assert_eq!(cycles(core, &[load("r0, [r1]"), load("r1, [r2]")], 1), exactly(3.0));
        assert_eq!(cycles(core, &[load("r0, [r1, r2]"), (2, "str", "r0, [r3, #0x14]")], 1), exactly(3.0));
        assert_eq!(cycles(core, &[load("r0, [r1, r2]"), (2, "str", "r1, [r3, r2]")], 1), exactly(3.0));
        let three = [load("r0, [r1, r5]"), load("r1, [r2]"), load("r2, [r3, #4]")];
        assert_eq!(cycles(core, &three, 1), exactly(4.0));
        // An address that is loaded cannot be used at once.
        assert_eq!(cycles(core, &[load("r0, [r1]"), load("r1, [r0]")], 1), exactly(4.0));
    }
}

/// The loop of `cortex_m::asm::delay`: its documentation says three cycles a turn, and one on a Cortex-M7; Cortex-M0 takes one
/// for the subtraction and three for the jump. The last branch is not taken.
#[test]
fn a_delay_takes_the_cycles_that_are_known() {
    const TURNS: usize = 1000;
    let turn = |core| {
        let sum = cycles(core, &[(2, "subs", "r0, #1"), (2, "bne", "#0")], TURNS);
        Cycles { least: sum.least / TURNS as f64, most: sum.most / TURNS as f64 }
    };
    let last = 2.0 / TURNS as f64;
    assert!((turn("Cortex-M0").least - 4.0).abs() <= last);
    assert_eq!(turn("Cortex-M0").least, turn("Cortex-M0").most);
    for core in ["Cortex-M3", "Cortex-M4F"] {
        assert!((turn(core).least - 3.0).abs() <= last && turn(core).most < 5.0 + last);
    }
    let within = |core, known: f64| turn(core).least <= known && known <= turn(core).most;
    assert!(within("Cortex-M33", 3.0) && within("Cortex-M7", 1.0));
}

/// Horner's scheme with one division, added up by hand from the tables of the manual.
#[test]
fn floating_point_is_added_up_as_by_hand() {
    let division = (4, "vdiv.f32", "s0, s1, s2");
    let polynomial = [(4, "vldr", "s0, [r0]"), (4, "vmla.f32", "s0, s1, s2"), (4, "vmla.f32", "s3, s0, s2")];
    // 2 + 3 + 3, or a cycle less for each multiply-add.
    assert_eq!(cycles("Cortex-M4F", &polynomial, 1), Cycles { least: 6.0, most: 8.0 });
    assert_eq!(cycles("Cortex-M4F", &[division, (4, "vmul.f32", "s3, s4, s5")], 1), exactly(15.0));
    // Integer instructions may go on during a division.
    assert_eq!(cycles("Cortex-M4F", &[division, (2, "adds", "r0, r0, r1")], 1), Cycles { least: 14.0, most: 15.0 });
    // A sum that is used at once may take a cycle more.
    let sums = [(4, "vadd.f32", "s0, s1, s2"), (4, "vadd.f32", "s3, s0, s2"), (4, "vadd.f32", "s4, s1, s2")];
    assert_eq!(cycles("Cortex-M4F", &sums, 1), Cycles { least: 3.0, most: 4.0 });
    assert_eq!(cycles("Cortex-M4F", &[(4, "vpush", "{d8, d9}"), (2, "push", "{r4, lr}")], 1), exactly(8.0));
}

#[test]
fn conditions_and_jumps_are_told_apart() {
    // The second instruction behind IT may be skipped, but a multiplication with 64 bits takes three to five cycles if not.
    let block =
        [(2, "itt", "eq"), (4, "smull", "r0, r1, r2, r3"), (2, "movs", "r0, #1"), (4, "smull", "r0, r1, r2, r3")];
    assert_eq!(cycles("Cortex-M3", &block, 1), Cycles { least: 5.0, most: 12.0 });
    // `bls` is a branch, not BL.
    assert_eq!(cycles("Cortex-M0", &[(2, "bls", "#8"), (2, "nop", "")], 1), exactly(2.0));
    assert_eq!(cycles("Cortex-M0", &[(4, "bl", "#8"), (2, "pop", "{r4, pc}")], 1), exactly(7.0));
}

#[test]
fn an_instruction_without_timing_is_named() {
    let trace = Trace {
        instructions: HashMap::from([(0, Instruction { length: 2, name: "abc".to_owned(), operands: String::new() })]),
        calls: Vec::new(),
    };
    let error = Timings::of("Cortex-M0").unwrap().cycles(&trace, &[0]).unwrap_err();
    assert!(error.contains("no row for `abc ` on Cortex-M0"), "{error}");
    assert!(Timings::of("Z80").is_err());
}
