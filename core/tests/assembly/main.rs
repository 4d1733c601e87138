//! Positions: assembly, all configurations, rest, turns and limits of motion, and the errors if there are none.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod andrews;
mod angle_winding;
mod branches;
mod closures;
mod configurations;
mod contradictions;
mod culprits;
mod diagnosis;
mod dragging;
mod drivers;
mod equations;
mod equilibrium;
mod failures;
mod folded_positions;
mod followers;
mod guesses;
mod kinematics;
mod large;
mod limits;
mod limits_of_motion;
mod meshes_and_rods;
mod near_folded;
mod quantities;
mod redundancy;
mod six_bars;
mod slide_dyads;
mod starts;
mod velocities;
