//! Building of models, and runs of extreme models.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod building;
mod edges;
mod refused;
mod running;
mod symbols;
