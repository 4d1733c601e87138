//! What keeps a motion on its constraints while it is integrated.
//!
//! Baumgarte's stabilization changes the right side of the equations of motion and lives there
//! ([`Gains`](crate::equations::Gains)); what is done to accepted states lives here.

mod projection;

pub use projection::{Fault, Projection, Projector};
