//! The analyses of a model: free functions of model, state and options.

pub mod assemble;
mod closing;
mod conditions;
pub mod configurations;
mod curves;
mod dependence;
pub mod diagnosis;
pub mod dynamics;
pub mod equilibrium;
mod errors;
mod event_options;
mod freedoms;
pub mod kinematics;
pub mod limits;
pub mod linearization;
pub mod measures;
mod mobility;
mod option_tables;
pub mod options;
mod quantities;
mod required;
mod results;
mod sequence;
mod signal_names;
mod signal_units;
mod signals;
mod state;
mod uniqueness;

pub use dependence::Dependent;
pub use event_options::{EventOption, DIRECTIONS};
pub use mobility::{mobility, Mobility};
pub use option_tables::{declarations, option_families};
pub use results::NoResult;
pub use sequence::check;
pub use state::State;
pub use uniqueness::not_unique;
