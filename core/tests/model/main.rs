//! Building models, and running those at the edge of what can be run.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod building;
mod edges;
mod refused;
mod running;
mod symbols;
