//! Bytes of flash and of static memory that a function needs: its own, and those of all that it refers to, directly or not.
//!
//! Every function and every constant is a piece of its own for the linker. Which piece refers to which is in the relocations
//! that it keeps when told so (`--emit-relocs`), and where pieces begin and end is in its map. To follow the references is what
//! the linker itself does to leave out what nobody needs. Routines of the compiler, such as those for arithmetic in software,
//! are pieces too; padding between pieces is not counted.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use object::{File, Object, ObjectSection, ObjectSymbol, Relocation, RelocationTarget, Section, SymbolKind};

use super::footprint::{self, Footprint, Memory};

/// Where the names of pieces begin in a line of the map, after address, load address, size and alignment.
const NAMES: usize = 33;
const INDENTATION: &str = "        ";

/// A firmware, in pieces that refer to each other.
pub struct Pieces {
    /// By address.
    pieces: BTreeMap<u32, Piece>,
}

struct Piece {
    name: String,
    size: u32,
    memory: Memory,
    /// Addresses that it refers to.
    references: Vec<u32>,
}

impl Pieces {
    /// The pieces of a firmware, which has its map beside it.
    pub fn of(firmware: &Path) -> Result<Self, String> {
        let name = firmware.display();
        let map = firmware.with_extension("map");
        let map = fs::read_to_string(&map).map_err(|error| format!("cannot read {}: {error}", map.display()))?;
        let bytes = footprint::read(firmware)?;
        let file = footprint::parse(firmware, &bytes)?;
        let mut pieces = Self { pieces: BTreeMap::new() };
        let mut section = None;
        for line in map.lines() {
            if let Some(found) = line.get(NAMES..).and_then(|name| file.section_by_name(name)) {
                section = Some(found);
            } else if let (Some((address, size, name)), Some(section)) = (mapped(line), &section) {
                pieces.add(section, address, size, name);
            }
        }
        for section in file.sections() {
            for (place, relocation) in section.relocations() {
                let target = target(&file, &section, place, &relocation);
                if let (Some(target), Some((_, piece))) = (target, pieces.at_mut(place as u32)) {
                    piece.references.push(target);
                }
            }
        }
        if pieces.pieces.values().all(|piece| piece.references.is_empty()) {
            return Err(format!("{name} has no relocations, so what its functions need is unknown"));
        }
        Ok(pieces)
    }

    /// What the function at an address needs.
    pub fn needed_by(&self, function: u32) -> Result<Footprint, String> {
        let mut footprint = Footprint { flash: 0, static_memory: 0 };
        let mut seen = Vec::new();
        // The lowest bit says that it is Thumb code.
        let mut open = vec![function & !1];
        if self.at(function & !1).is_none() {
            return Err(format!("the linker's map has no function at {function:#x}"));
        }
        while let Some(address) = open.pop() {
            // Addresses of registers and the ends of sections belong to no piece.
            let Some((start, piece)) = self.at(address) else { continue };
            if seen.contains(&start) {
                continue;
            }
            seen.push(start);
            if piece.name.contains("thunk") {
                return Err(format!("{}: the linker does not say where it leads", piece.name));
            }
            footprint.add(piece.memory, piece.size);
            open.extend(&piece.references);
        }
        Ok(footprint)
    }

    /// Adds a piece, or each constant of one into which the linker has put equal ones together.
    fn add(&mut self, section: &Section<'_, '_>, address: u32, size: u32, name: &str) {
        let Some(memory) = Memory::of(section) else { return };
        let mut lengths = vec![size];
        if name.contains(".str1.") {
            let data = section.data_range(u64::from(address), u64::from(size)).ok().flatten().unwrap_or_default();
            lengths = data.split_inclusive(|byte| *byte == 0).map(|text| text.len() as u32).collect();
        } else if let Some((_, width)) = name.split_once(".cst")
            && let Ok(width @ 1..) = width.trim_end_matches(')').parse::<u32>()
        {
            lengths = vec![width; (size / width) as usize];
        }
        let mut start = address;
        for size in lengths {
            let piece = Piece { name: name.to_owned(), size, memory, references: Vec::new() };
            self.pieces.insert(start, piece);
            start += size;
        }
    }

    fn at(&self, address: u32) -> Option<(u32, &Piece)> {
        let (start, piece) = self.pieces.range(..=address).next_back()?;
        (address - start < piece.size).then_some((*start, piece))
    }

    fn at_mut(&mut self, address: u32) -> Option<(u32, &mut Piece)> {
        let (start, piece) = self.pieces.range_mut(..=address).next_back()?;
        (address - start < piece.size).then_some((*start, piece))
    }
}

/// Address, size and name of a piece in a line of the map: `FILE:(SECTION)`.
fn mapped(line: &str) -> Option<(u32, u32, &str)> {
    let name = line.get(NAMES..)?.strip_prefix(INDENTATION)?;
    if name.starts_with(' ') || !name.contains(":(") {
        return None;
    }
    let mut numbers = line.split_whitespace().map(|number| u32::from_str_radix(number, 16).ok());
    let (address, _, size) = (numbers.next()??, numbers.next()?, numbers.next()??);
    (size > 0).then_some((address, size, name))
}

/// The address that a relocation leads to.
fn target(file: &File<'_>, section: &Section<'_, '_>, place: u64, relocation: &Relocation) -> Option<u32> {
    let RelocationTarget::Symbol(index) = relocation.target() else { return None };
    let symbol = file.symbol_by_index(index).ok()?;
    let address = match symbol.kind() {
        // The way to the constant within the section stands where the linker has put its address.
        SymbolKind::Section if relocation.has_implicit_addend() => {
            let word = section.data_range(place, 4).ok()??;
            u64::from(u32::from_le_bytes(word.try_into().ok()?))
        }
        SymbolKind::Section => symbol.address().wrapping_add_signed(relocation.addend()),
        // The lowest bit says that it is Thumb code.
        SymbolKind::Text => symbol.address() & !1,
        _ => symbol.address(),
    };
    Some(address as u32)
}
