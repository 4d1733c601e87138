//! What a user asks for: free functions of model, state and options.

pub mod assemble;
mod state;

pub use state::State;
