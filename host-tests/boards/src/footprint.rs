//! Bytes of flash and of static memory, read from the linked firmware.

use std::fs;
use std::path::Path;

use object::{BinaryFormat, File, Object, ObjectSection, Section, SectionFlags, SectionKind, elf};

/// What a firmware occupies before it runs.
#[derive(Clone, Copy)]
pub struct Footprint {
    /// Code, constants and first values, in bytes.
    pub flash: u32,
    /// Variables, in bytes.
    pub static_memory: u32,
}

impl Footprint {
    /// Adds up the sections that the linker placed.
    pub fn of(firmware: &Path) -> Result<Self, String> {
        let bytes = read(firmware)?;
        let mut footprint = Self { flash: 0, static_memory: 0 };
        for section in parse(firmware, &bytes)?.sections() {
            if let Some(memory) = Memory::of(&section) {
                footprint.add(memory, section.size() as u32);
            }
        }
        Ok(footprint)
    }

    /// Adds a part that takes so many bytes.
    pub(super) fn add(&mut self, memory: Memory, size: u32) {
        self.flash += if memory.stored { size } else { 0 };
        self.static_memory += if memory.variable { size } else { 0 };
    }

    /// What this firmware occupies more than `other`.
    pub fn minus(self, other: Self) -> Self {
        Self {
            flash: self.flash.saturating_sub(other.flash),
            static_memory: self.static_memory.saturating_sub(other.static_memory),
        }
    }
}

/// The memory that a part of a firmware takes. A variable with a start value takes both: the value waits in flash.
#[derive(Clone, Copy)]
pub(super) struct Memory {
    /// Whether it has a start value or is constant, and so takes flash.
    stored: bool,
    /// Whether it is a variable.
    variable: bool,
}

impl Memory {
    /// That of a section; `None` if the linker has not placed it.
    pub(super) fn of(section: &Section<'_, '_>) -> Option<Self> {
        let SectionFlags::Elf { sh_flags, .. } = section.flags() else { return None };
        let stored = section.kind() != SectionKind::UninitializedData;
        sh_flags.contains(elf::SHF_ALLOC).then(|| Self { stored, variable: sh_flags.contains(elf::SHF_WRITE) })
    }
}

/// The bytes of a file.
pub(super) fn read(file: &Path) -> Result<Vec<u8>, String> {
    fs::read(file).map_err(|error| format!("cannot read {}: {error}", file.display()))
}

/// The ELF file that bytes read from `firmware` are.
pub(super) fn parse<'a>(firmware: &Path, bytes: &'a [u8]) -> Result<File<'a>, String> {
    let name = firmware.display();
    let file = File::parse(bytes).map_err(|error| format!("cannot understand {name}: {error}"))?;
    if file.format() == BinaryFormat::Elf { Ok(file) } else { Err(format!("{name} is not an ELF file")) }
}
