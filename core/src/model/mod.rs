//! Models: as written ([`Definition`]), linked ([`Blueprint`]) and as numbers ([`Model`]).

mod added_inertia;
mod anchor;
mod blueprint;
mod bodies;
mod body_fields;
mod checks;
mod definition;
mod inertia;
mod layout;
mod link;
#[allow(clippy::module_inception)] // the model of the module `model`
mod model;
mod parameters;
mod pin;
mod problem;
mod size;

pub use anchor::Anchor;
pub use blueprint::{build, Blueprint};
pub use body_fields::body_tables;
pub use definition::{Definition, Entry, Value};
pub use inertia::Inertia;
pub use layout::{columns, Block, Layout, Slots, WORKS};
pub use link::{did_you_mean, Reach, Scope};
pub use model::{variable, Body, ConstraintItem, Dependence, ForceItem, Model};
pub use pin::Pin;
pub use problem::Problem;
pub use size::{row_scales, size};
