//! What the benchmarks share: contestants with one setting each, their race, the table of winners, and the equations.

pub mod contestant;
pub mod race;
pub mod regularised;
pub mod scene;
pub mod table;
