//! Assembly: positions, closures, turns, velocities, and what is said when it cannot be.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod andrews;
mod angle_winding;
mod closures;
mod drivers;
mod failures;
mod redundancy;
mod six_bars;
mod velocities;
