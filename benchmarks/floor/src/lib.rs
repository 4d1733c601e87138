//! The flagship, and nothing else, as fast as one can make it by hand: the floor under kempe.
//!
//! The same equations as kempe's (three bodies in Cartesian coordinates, four revolutes, eight
//! multipliers, Baumgarte's α = 10, β = 200), the same Dormand–Prince 5(4) with the same step control,
//! the same output; but every number is a constant, every array lies on the stack, and the order of
//! elimination is written out. What a general program may cost is told as a ratio to this one.

pub mod angles;
pub mod chain;
pub mod dormand_prince;
pub mod linkage;
pub mod plane;
pub mod recorded;
pub mod straight;
