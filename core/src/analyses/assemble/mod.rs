//! Assembly.
mod dyad;
mod placement;
mod wishes;
pub use placement::{place, Placement};
pub use wishes::Wishes;
