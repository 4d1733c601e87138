//! Models: as written ([`Definition`]), linked ([`Blueprint`]) and as numbers ([`Model`]).

mod blueprint;
mod bodies;
mod body_fields;
mod build;
mod checks;
mod curves;
mod definition;
mod functions;
mod items;
mod layout;
mod link;
#[allow(clippy::module_inception)] // the model of the module `model`
mod model;
mod parameters;
mod problem;
mod problems;
mod quantity;
mod quantity_owner;
mod read_fields;
mod scope;
mod size;
mod switch;
mod symbols;
mod tables;
mod unit_check;
mod variable;
mod variant;

pub use blueprint::Blueprint;
pub use body_fields::body_tables;
pub use build::build;
pub use definition::{Definition, Entry, Value};
pub use functions::{FunctionLaw, Functions, Host, Sampling};
pub use items::{Body, ConstraintItem, ForceItem};
pub use layout::{Block, Columns, Slots, StateLayout, WORKS};
pub use link::did_you_mean;
pub use model::Model;
pub use problem::Problem;
pub use problems::{listed, more_problems, Problems, MOST_REPORTED};
pub(crate) use quantity::{quantity_of, Offered};
pub use scope::{Reach, Scope};
pub use size::{column_scales, row_scales, size};
pub use switch::{Owner, Switch};
pub use tables::table_fields;
pub(crate) use unit_check::ANY_UNIT;
pub use variable::{Dependence, Variable};
