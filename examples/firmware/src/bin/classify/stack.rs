//! How much stack a piece of work touches, measured by painting.

use core::arch::asm;

/// What unused stack is painted with.
const PAINT: u32 = 0xa5c3_5a3c;
/// Bytes of stack that are painted; work that reaches further cannot be measured.
const REACH: u32 = 8192;
const WORD: u32 = 4;

/// Bytes of stack from the caller's to the deepest word that `work` writes, its
/// variables and results included; `None` if that is more than [`REACH`].
///
/// Interrupts must stay silent meanwhile: their frames would be counted too.
pub(crate) fn used(work: impl FnOnce()) -> Option<u32> {
    let top = paint();
    apart(work);
    let untouched = (top - REACH..top)
        .step_by(WORD as usize)
        // SAFETY: words of RAM below the stack pointer, where nothing else lives.
        .take_while(|&word| unsafe { (word as *const u32).read_volatile() } == PAINT)
        .count() as u32;
    (untouched > 0).then_some(REACH - WORD * untouched)
}

/// Paints the [`REACH`] below the stack pointer and returns the stack pointer.
// Inlined and in assembly: a frame of its own would be in the way of the paint.
#[inline(always)]
fn paint() -> u32 {
    let top: u32;
    // SAFETY: writes words of RAM below the stack pointer, where nothing lives. There
    // is no `nostack` in the options, so the compiler keeps nothing there either.
    unsafe {
        asm!(
            "mov {top}, sp",
            "subs {word}, {top}, {word}",
            "2: str {paint}, [{word}]",
            "adds {word}, {word}, #4",
            "cmp {word}, {top}",
            "bne 2b",
            top = out(reg) top,
            word = inout(reg) REACH => _,
            paint = in(reg) PAINT,
        );
    }
    top
}

/// Keeps the variables of `work` out of the caller's frame, where they would not count.
#[inline(never)]
fn apart(work: impl FnOnce()) {
    work();
}
