//! kempe: planar multibody mechanics.
//!
//! Modules depend on each other in one direction only:
//! `math ← expression ← symbolic ← elements ← model ← equations ← stabilize ← analyses ← case`;
//! `solve` and `integrate` know no mechanics. See `ARCHITECTURE.md`.
#![forbid(unsafe_code)]

pub mod analyses;
pub mod case;
pub mod elements;
pub mod equations;
pub mod expression;
pub mod integrate;
pub mod math;
pub mod model;
pub mod solve;
pub mod stabilize;
pub mod symbolic;
