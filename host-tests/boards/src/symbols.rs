//! Where a function is in a firmware.

use std::ops::Range;
use std::path::Path;

use object::{Object, ObjectSymbol, SymbolKind};

use super::footprint;

/// The addresses of the only function whose name in the file has all these parts in it; none if there is no such function.
pub fn function(firmware: &Path, parts: &[&str]) -> Result<Option<Range<u32>>, String> {
    let bytes = footprint::read(firmware)?;
    let file = footprint::parse(firmware, &bytes)?;
    let is_meant = |name: &str| parts.iter().all(|part| name.contains(part));
    let mut found =
        file.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.name().is_ok_and(is_meant));
    let Some(symbol) = found.next() else { return Ok(None) };
    if found.next().is_some() {
        return Err(format!(
            "{} has several functions with {} in their names",
            firmware.display(),
            parts.join(" and ")
        ));
    }
    // The lowest bit says that it is Thumb code.
    let start = symbol.address() as u32 & !1;
    Ok(Some(start..start + symbol.size() as u32))
}
