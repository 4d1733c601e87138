//! Linear and nonlinear algebra without mechanics.
//!
//! | file | concept |
//! |---|---|
//! | `order` | in which order unknowns are eliminated |
//! | `pattern` | the pattern of a saddle-point matrix and the plan of its elimination |
//! | `plan` | working them out, once |
//! | `weight` | the blocks of W by their factors |
//! | `block` | arithmetic of blocks of at most 3 × 3 |
//! | `arm` | the same for pairs of rows that begin with ±I |
//! | `saddle` | numbers: [W Aᵀ; A -μI] factorised and solved without allocation |
//! | `substitute` | the solution with its factors |
//! | `near` | the same where rows of A come near to dependence |
//! | `newton` | damped Newton and Gauss–Newton iteration |
//! | `rank` | numerical rank, dependent rows and left null vectors |

mod arm;
mod block;
mod near;
pub mod newton;
mod order;
mod pattern;
mod plan;
mod rank;
mod saddle;
mod substitute;
mod weight;

pub use newton::Newton;
pub use order::groups_first;
pub use pattern::{Pattern, RowBlock};
pub use rank::{normalize_rows, rank, Rank, RANK_TOLERANCE};
pub use saddle::{Saddle, PIVOT_TOLERANCE};
pub use weight::{Dependent, Weight};
