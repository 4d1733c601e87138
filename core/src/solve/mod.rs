//! Linear and nonlinear algebra without mechanics.

mod block;
mod block_lu;
mod condensed;
mod lu_symbolic;
mod mass_block;
pub mod newton;
mod order;
mod pattern;
mod pin_block;
mod rank;
mod records;
mod regularised;
mod saddle;
mod schur;
mod storage;
mod structure;
mod substitute;
mod symbolic;

pub use block_lu::{BlockLu, LOST};
pub use condensed::{Condensation, CondensedGroup};
pub use lu_symbolic::LuPlan;
pub use mass_block::{Dependent, InverseMass, PIVOT_TOLERANCE};
pub use newton::Newton;
pub use order::{groups_first, touched_first};
pub use pattern::Pattern;
pub use rank::{normalize_rows, rank, Rank, RANK_TOLERANCE};
pub use records::{PinEnd, PinRows};
pub use saddle::Saddle;
pub use schur::PinSum;
pub use structure::{Group, RowBlock};
