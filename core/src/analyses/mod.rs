//! What a user asks for: free functions of model, state and options.

pub mod assemble;
pub mod dynamics;
mod mobility;
mod state;

pub use mobility::{dense_jacobian, mobility, Mobility};
pub use state::State;
