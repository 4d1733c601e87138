//! Implicit methods: their tangent, their matrices, their order, and stiff mechanisms.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod block_lu;
mod events;
mod order;
mod product;
mod stiff;
mod tangent;
