//! Numerical methods: integrators, linear and nonlinear solvers, projection, and the ways in which they are combined.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod accelerations;
mod implicit;
mod integrate;
mod newton;
mod order;
mod prepared;
mod projection;
mod rank;
mod reports;
mod saddle;
mod scale;
mod side_by_side;
mod tolerances;
