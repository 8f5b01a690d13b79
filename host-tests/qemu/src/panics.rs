//! The proof that no panicking path is left in the library.
//!
//! `probe` calls all of the library and has a panic handler that cannot be linked:
//! that it links is the proof. `probe_fails` has one panicking path more and must
//! not link, for this reason and no other: that is the proof of the proof.

use boards::Board;
use boards::firmware;
use boards::toolchain::Toolchain;

/// The text in the name of the symbol that panic-never leaves undefined.
const UNDEFINED_SYMBOL: &str = "error(panic-never)";

/// Whatever speaks against the proof on this board.
pub(crate) fn doubts(toolchain: &Toolchain, board: &Board) -> Vec<String> {
    let mut doubts = Vec::new();
    match firmware::try_build(toolchain, board, &["probe"]) {
        Ok(build) if build.success() => {}
        Ok(build) if build.stderr.contains(UNDEFINED_SYMBOL) => doubts.push(format!(
            "{}: a panicking path is left in the library; find it in the machine code of \
             examples/firmware/src/bin/probe.rs linked with panic-halt",
            board.core
        )),
        Ok(build) => doubts.push(format!("{}: the panic probe does not build:\n{}", board.core, build.tail(40))),
        Err(error) => doubts.push(error),
    }
    match firmware::try_build(toolchain, board, &["probe_fails"]) {
        Ok(build) if build.success() => doubts
            .push(format!("{}: the probe with a panicking path links, so the panic probe proves nothing", board.core)),
        Ok(build) if build.stderr.contains(UNDEFINED_SYMBOL) => {}
        Ok(build) => doubts.push(format!(
            "{}: the probe with a panicking path fails for another reason:\n{}",
            board.core,
            build.tail(40)
        )),
        Err(error) => doubts.push(error),
    }
    doubts
}
