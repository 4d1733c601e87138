//! Linear and nonlinear algebra without mechanics.
//!
//! | file | concept |
//! |---|---|
//! | `order` | in which order unknowns are eliminated |
//! | `pattern` | the pattern of a saddle-point matrix and the plan of its elimination |
//! | `plan` | working them out, once |
//! | `places` | where rows and entries stand |
//! | `steps` | the plan as records, in the order in which they are used |
//! | `weight` | the blocks of W by their factors |
//! | `block` | arithmetic of blocks of at most 3 × 3 |
//! | `arm` | the same for pairs of rows that begin with ±I |
//! | `anchor` | such a pair that holds one group alone, eliminated in closed form |
//! | `saddle` | numbers: [W Aᵀ; A -μI] factorised and solved without allocation |
//! | `gram` | the diagonal blocks of S = A W⁻¹ Aᵀ + μ I |
//! | `bytes` | how much memory that takes |
//! | `substitute` | the solution with its factors |
//! | `near` | the same where rows of A come near to dependence |
//! | `lu_plan` | pattern, order and plan of an unsymmetric block matrix |
//! | `block_lu` | its numbers, real or complex, factorised and solved without allocation |
//! | `newton` | damped Newton and Gauss–Newton iteration |
//! | `rank` | numerical rank, dependent rows and left null vectors |

mod anchor;
mod arm;
mod block;
mod block_lu;
mod bytes;
mod gram;
mod lu_plan;
mod near;
pub mod newton;
mod order;
mod pattern;
mod places;
mod plan;
mod rank;
mod saddle;
mod steps;
mod substitute;
mod weight;

pub use anchor::{Anchor, Anchored};
pub use arm::Arm;
pub use block_lu::{BlockLu, LOST};
pub use bytes::Bytes;
pub use gram::Begun;
pub use lu_plan::LuPlan;
pub use newton::Newton;
pub use order::{groups_first, touched_first};
pub use pattern::{Pattern, RowBlock};
pub use places::Armed;
pub use rank::{normalize_rows, rank, Rank, RANK_TOLERANCE};
pub use saddle::{Saddle, PIVOT_TOLERANCE};
pub use weight::{Dependent, Weight};
