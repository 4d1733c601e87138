//! What keeps a motion on its constraints while it is integrated.
//!
//! Baumgarte's stabilization with given gains changes the right side of the equations of motion and lives
//! there ([`Gains`](crate::equations::Gains)); gains from the step, and what is done to accepted states,
//! live here.

mod baumgarte;
mod projection;

pub use baumgarte::StepwiseBaumgarte;
pub use projection::{Fault, Projection, Projector};
