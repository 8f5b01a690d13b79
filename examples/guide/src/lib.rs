#![doc = include_str!("../README.md")]

#[doc = include_str!("../pages/step_1_measure.md")]
pub mod step_1_measure {}

#[doc = include_str!("../pages/step_2_fit.md")]
pub mod step_2_fit {}

#[doc = include_str!("../pages/step_3_classify.md")]
pub mod step_3_classify {}

#[doc = include_str!("../pages/step_4_populations.md")]
pub mod step_4_populations {}

#[doc = include_str!("../pages/step_5_programs.md")]
pub mod step_5_programs {}

#[doc = include_str!("../pages/choose.md")]
pub mod choose {}

#[doc = include_str!("../pages/answers.md")]
pub mod answers {}

#[doc = include_str!("../pages/equations.md")]
pub mod equations {}

#[doc = include_str!("../pages/columns.md")]
pub mod columns {}

#[doc = include_str!("../pages/accuracy.md")]
pub mod accuracy {}

#[doc = include_str!("../pages/footprint.md")]
pub mod footprint {}
