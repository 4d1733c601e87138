//! Implicit methods: their tangent, their matrices, their order, and stiff mechanisms.

mod block_lu;
mod events;
mod order;
mod product;
mod stiff;
mod tangent;
