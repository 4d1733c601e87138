//! Models: as written ([`Definition`]) and as numbers ([`Model`]).

mod body_fields;
mod definition;
mod problem;

pub use body_fields::body_tables;
pub use definition::{Definition, Entry, Value};
pub use problem::Problem;
