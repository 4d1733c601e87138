//! Stabilization of the constraints during integration.
//!
//! Baumgarte's stabilization with given gains changes the right side of the equations of motion and is part of them
//! ([`Gains`](crate::equations::Gains)). This module contains Baumgarte's stabilization with gains from the step, and
//! the projection of states.

mod baumgarte;
mod projection;

pub use baumgarte::StepwiseBaumgarte;
pub use projection::{Projection, Projector};
