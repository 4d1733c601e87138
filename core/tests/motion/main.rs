//! Runs of mechanisms with friction, switches, events, curves and light bodies.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod abilities;
mod curve_distances;
mod curves;
mod events;
mod friction;
mod light_bodies;
mod linearization;
mod phases;
mod sticking;
mod switches;
mod translational;
