//! The analyses of a model: free functions of model, state and options.

pub mod assemble;
mod closing;
mod curves;
mod dependence;
pub mod dynamics;
mod errors;
pub mod kinematics;
mod mobility;
mod option_tables;
pub mod options;
mod required;
mod results;
mod sequence;
mod state;

pub use mobility::{mobility, Mobility};
pub use option_tables::{declarations, option_families};
pub use results::NoResult;
pub use sequence::check;
pub use state::State;
