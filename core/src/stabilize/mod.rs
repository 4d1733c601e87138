//! Stabilization of the constraints during integration.
//!
//! Baumgarte's stabilization with given gains changes the right side of the equations of motion and is part of them
//! ([`Gains`](crate::equations::Gains)). This module contains Baumgarte's stabilization with gains that depend on the
//! step size, and the projection of states: one state at a time, or one in each lane.

mod baumgarte;
mod lane_projection;
mod projection;

pub use baumgarte::StepwiseBaumgarte;
pub use lane_projection::LaneProjector;
pub use projection::{Projection, Projector};
