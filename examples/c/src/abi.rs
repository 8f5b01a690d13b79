//! Whether a header and a library belong together.

use crate::critical_steps::CriticalSearch;
use crate::error::Error;
use crate::event::Event;
use crate::fit::{Fit, FitRoom, MeasuredImpact};
use crate::fixed_contact::{FixedContact, FixedImpact};
use crate::fixed_point::{FixedBody, FixedMotion, FixedResult};
use crate::probability::{UncertainClass, UncertainMotion};
use crate::queue::Queue;
use crate::rigid::{Classification, RigidScene};
use crate::scene::{SceneConfig, SceneImpact};
use crate::simulation::{Contact, ContactScene};
use crate::space::{Pair, SpatialMotion, Wall};
use crate::status::{Class, Motion};
use crate::table_steps::{BoundaryMaker, RestitutionMaker};
use crate::tables::{BoundaryTable, RestitutionTable, TableReading};
use crate::tally::{Tally, TallyReport};
use crate::tangential::{CompliantContact, CompliantScene};
use crate::trajectory::Sample;

/// Number of the interface: another one has other functions, structures or meanings.
pub const ABI: u32 = 2;

/// Version of the library: major times 10000, minor times 100, patch.
pub const VERSION: u32 = 100;

/// Factor of the layout, as in the macro MICROIMPACT_LAYOUT.
const FACTOR: u32 = 31;

/// Sizes of all structures, in the order of the macro MICROIMPACT_LAYOUT.
const SIZES: [usize; 28] = [
    size_of::<Error>(),
    size_of::<Class>(),
    size_of::<Motion>(),
    size_of::<RigidScene>(),
    size_of::<Classification>(),
    size_of::<ContactScene>(),
    size_of::<Contact>(),
    size_of::<Sample>(),
    size_of::<CompliantScene>(),
    size_of::<CompliantContact>(),
    size_of::<Wall>(),
    size_of::<SpatialMotion>(),
    size_of::<Pair>(),
    size_of::<BoundaryTable>(),
    size_of::<RestitutionTable>(),
    size_of::<TableReading>(),
    size_of::<SceneConfig>(),
    size_of::<SceneImpact>(),
    size_of::<Event>(),
    size_of::<Queue>(),
    size_of::<Tally>(),
    size_of::<TallyReport>(),
    size_of::<FixedBody>() + size_of::<FixedMotion>(),
    size_of::<FixedResult>() + size_of::<FixedContact>() + size_of::<FixedImpact>(),
    size_of::<UncertainMotion>() + size_of::<UncertainClass>(),
    size_of::<MeasuredImpact>() + size_of::<FitRoom>(),
    size_of::<Fit>(),
    size_of::<BoundaryMaker>() + size_of::<RestitutionMaker>() + size_of::<CriticalSearch>(),
];

const LAYOUT: u32 = {
    let (mut layout, mut index) = (0_u32, 0);
    while index < SIZES.len() {
        layout = layout.wrapping_mul(FACTOR).wrapping_add(SIZES[index] as u32);
        index += 1;
    }
    layout
};

/// Version of the library; MICROIMPACT_VERSION is that of the header. Re-entrant.
#[unsafe(no_mangle)]
pub extern "C" fn microimpact_version() -> u32 {
    VERSION
}

/// Number of the library's interface, to be compared with MICROIMPACT_ABI of the header. Re-entrant.
#[unsafe(no_mangle)]
pub extern "C" fn microimpact_abi() -> u32 {
    ABI
}

/// A number made of the sizes of all structures, to be compared with MICROIMPACT_LAYOUT, which the caller's compiler makes of the
/// same: they differ where an option of the compiler changes the size of a structure. Re-entrant.
#[unsafe(no_mangle)]
pub extern "C" fn microimpact_layout() -> u32 {
    LAYOUT
}
