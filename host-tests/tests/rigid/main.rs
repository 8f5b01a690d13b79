//! Tests of the rigid body, of what all models share, and of calibration.

mod absent_terms;
mod calibrate;
mod fixed_point_rigid;
mod inputs;
mod restitution_fit;
mod restitution_laws;
mod rigid_properties;
mod scalars;
mod table1;
