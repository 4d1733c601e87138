//! Building of models, and runs of extreme models.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod building;
mod dimensions;
mod edges;
mod fields;
mod quantities;
mod refused;
mod remedies;
mod running;
mod shapes;
mod symbols;
mod tables;
