//! What a user asks for: free functions of model, state and options.

pub mod assemble;
pub mod dynamics;
mod mobility;
mod option_tables;
mod state;

pub use mobility::{mobility, Mobility};
pub use option_tables::{analysis_tables, option_families, Family, Options};
pub use state::State;
