//! Bytes of flash and of static memory, read from the linked firmware.

use std::fs;
use std::path::Path;

use object::{Object, ObjectSection, SectionFlags, elf};

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
        let name = firmware.display();
        let bytes = fs::read(firmware).map_err(|error| format!("cannot read {name}: {error}"))?;
        let file = object::File::parse(&*bytes).map_err(|error| format!("cannot understand {name}: {error}"))?;
        let mut footprint = Self { flash: 0, static_memory: 0 };
        for section in file.sections() {
            let SectionFlags::Elf { sh_flags, .. } = section.flags() else {
                return Err(format!("{name} is not an ELF file"));
            };
            if !sh_flags.contains(elf::SHF_ALLOC) {
                continue;
            }
            let size = section.size() as u32;
            // Variables with a start value are in both: the value waits in flash.
            if section.kind() != object::SectionKind::UninitializedData {
                footprint.flash += size;
            }
            if sh_flags.contains(elf::SHF_WRITE) {
                footprint.static_memory += size;
            }
        }
        Ok(footprint)
    }

    /// What this firmware occupies more than `other`.
    pub fn minus(self, other: Self) -> Self {
        Self {
            flash: self.flash.saturating_sub(other.flash),
            static_memory: self.static_memory.saturating_sub(other.static_memory),
        }
    }
}
