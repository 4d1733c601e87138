//! Models: as written ([`Definition`]) and as numbers ([`Model`]).

mod definition;
mod problem;

pub use definition::{Definition, Entry, Value};
pub use problem::Problem;
