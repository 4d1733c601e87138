//! Every element of the catalogue, and the equations, against their definitions.
//!
//! A new element is covered by one sample in `samples.rs`.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod balance;
mod beams;
mod constraints;
mod energy;
mod equilibrium;
mod forces;
mod formulas;
mod gaps;
mod laws;
mod mass;
mod newton_euler;
mod pins;
mod rubbing;
mod samples;
mod spring_damper;
mod tables;
mod touching;
