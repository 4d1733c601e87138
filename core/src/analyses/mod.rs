//! What a user asks for: free functions of model, state and options.

pub mod assemble;
pub mod dynamics;
mod mobility;
mod option_tables;
pub mod options;
mod state;

pub use mobility::{mobility, Mobility};
pub use option_tables::{declarations, option_families};
pub use state::State;
