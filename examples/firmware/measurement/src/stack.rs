//! How much stack a piece of work touches, measured by painting.

use super::processor::paint;

/// What unused stack is painted with.
const PAINT: u32 = 0xa5c3_5a3c;
/// Bytes of stack that are painted; work that reaches further cannot be measured.
const REACH: u32 = 12_288;
const WORD: u32 = 4;

/// Bytes of stack from the caller's to the deepest word that `work` writes, its
/// variables and results included; `None` if that is more than [`REACH`].
///
/// Interrupts must stay silent meanwhile: their frames would be counted too.
pub fn used(work: impl FnOnce()) -> Option<u32> {
    let top = paint(PAINT, REACH);
    apart(work);
    let untouched = (top - REACH..top)
        .step_by(WORD as usize)
        // SAFETY: words of RAM below the stack pointer, where nothing else lives.
        .take_while(|&word| unsafe { (word as *const u32).read_volatile() } == PAINT)
        .count() as u32;
    (untouched > 0).then_some(REACH - WORD * untouched)
}

/// Keeps the variables of `work` out of the caller's frame, where they would not count.
#[inline(never)]
fn apart(work: impl FnOnce()) {
    work();
}
