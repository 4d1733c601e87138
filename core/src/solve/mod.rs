//! Linear and nonlinear algebra without mechanics.
//!
//! | file | concept |
//! |---|---|
//! | `order` | in which order unknowns are eliminated |
//! | `symbolic` | the pattern of a factor, worked out once |
//! | `columns` | the elimination of one column |
//! | `ldlt` | numbers: A = L D Lᵀ and A x = b, without allocation |
//! | `newton` | damped Newton and Gauss–Newton iteration |
//! | `rank` | numerical rank, dependent rows and left null vectors |

mod columns;
mod ldlt;
pub mod newton;
mod order;
mod rank;
mod symbolic;

pub use ldlt::{Factor, ZeroPivot, PIVOT_TOLERANCE};
pub use newton::Newton;
pub use order::bodies_first;
pub use rank::{normalize_rows, rank, Rank, RANK_TOLERANCE};
pub use symbolic::Symbolic;
