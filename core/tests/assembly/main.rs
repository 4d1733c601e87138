//! Assembly: positions, closures, turns, velocities, and the errors if it fails.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod andrews;
mod angle_winding;
mod closures;
mod contradictions;
mod drivers;
mod equations;
mod failures;
mod followers;
mod large;
mod quantities;
mod redundancy;
mod six_bars;
mod velocities;
