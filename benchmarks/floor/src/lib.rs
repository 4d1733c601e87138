//! The floor program: the flagship alone, written by hand for speed.
//!
//! It uses the same equations as kempe (three bodies in Cartesian coordinates, four revolutes, eight
//! multipliers, Baumgarte's α = 10, β = 200), the same Dormand–Prince 5(4) with the same step control and
//! the same output. But every number is a constant, every array is on the stack, and the order of
//! elimination is written out. The cost of a general program is given as a ratio to this one.

pub mod angles;
pub mod chain;
pub mod dormand_prince;
pub mod linkage;
pub mod plane;
pub mod recorded;
pub mod straight;
