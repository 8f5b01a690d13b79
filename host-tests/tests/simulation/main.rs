//! Tests of the simulated contact: its methods, its numbers and its outputs.

mod adaptive;
mod bounds;
mod captured;
mod checking;
mod chosen;
mod compliance;
mod contest;
mod critical_speed;
mod dual;
mod error_bounds;
mod everything;
mod fixed_cost;
mod fixed_point;
mod laws;
mod ledger;
mod micromath;
mod paper_method;
mod pressing;
mod simulation_exact;
mod simulation_reference;
mod solver_direct;
mod space;
mod tables;
mod trajectory;
mod trials;
mod uncertainty;
