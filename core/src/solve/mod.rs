//! Linear and nonlinear algebra, independent of mechanics.
//!
//! # Saddle-point matrices [W Aᵀ; A -μI]
//!
//! A [`Pattern`] is computed once for each structure (groups of one to three unknowns, blocks of one to three rows).
//! A [`Saddle`] contains the numbers of one matrix and of its factors. A solution has these steps:
//!
//! 1. Condense: a pair of rows at one group only, such as a joint to ground, leaves one degree of freedom e.
//! 2. Divide the right side of all other groups by their mass: x = W⁻¹ f.
//! 3. Assemble the Schur complement S = A W⁻¹ Aᵀ + μ I and its right side y = A x - g, row block by row block.
//! 4. Eliminate, S = L D Lᵀ, and compute y ← L⁻¹ y at the same time.
//! 5. Substitute back: λ = L⁻ᵀ D⁻¹ y, x -= W⁻¹ Aᵀ λ, then λ of condensed rows.
//!
//! [`Saddle::factor`] performs steps 1, 3 and 4 without a right side, and [`Saddle::solve`] the other steps with
//! these factors. The owner of pairs of rows [±I b] ("pins") may perform steps 1 and 3 for them while it computes
//! their numbers: [`Saddle::condense`], [`Saddle::divide_by_masses`], [`Saddle::add_pin`], [`Saddle::put_pin_rows`],
//! then [`Saddle::finish`].
//!
//! | array of [`Saddle`] | contents | length | filled by | when |
//! |---|---|---|---|---|
//! | `masses` | W⁻¹ = diag(d₀⁻¹, d₁⁻¹, 0) + d₂⁻¹ e eᵀ: 7 numbers | groups | owner; condensed e by step 1 | before 1 |
//! | `condensed` | W and the particular solution P: 10 numbers | condensed pairs | W by owner, P by step 1 | before 1 |
//! | `entries` | A in rows of three; columns ±I are constant | rows × groups touched | owner | before 1, or in 1, 3 |
//! | `light` | rows at light groups, which count with reference masses in pivot tests | such rows | owner | before 4 |
//! | `damping` | μ | rows, or 0 | owner | before 3 |
//! | `pins` | rows [±I b] with the mass of their group: 6 numbers | such rows × groups | step 3 | 3, read in 4 and 5 |
//! | `u` | other rows, transformed by W⁻¹: 6 numbers | such rows × groups | step 3 | 3, read in 4 and 5 |
//! | `factors` | S, then L D and D⁻¹; sums of the pivot test | blocks of L | step 3 (diagonal), step 4 | 3, 4 |
//!
//! The solution (x, λ) replaces the right side (f, g) in place; its length is [`Pattern::n_unknowns`] +
//! [`Pattern::n_rows`]. For a group with fewer than three unknowns, three are read and written nevertheless, and its
//! entries and its mass leave the unknowns after the group unchanged. Only the last group is padded.
//!
//! | file | concept |
//! |---|---|
//! | `structure` | groups of unknowns and blocks of rows, as the owner describes them |
//! | `order` | elimination order by minimum degree |
//! | `records` | the elimination program: records in the order in which they are used |
//! | `storage` | storage map: where rows and pin blocks are stored |
//! | `symbolic` | symbolic factorisation: fill, and the program |
//! | `pattern` | the complete pattern of one structure |
//! | `mass_block` | blocks of W, as inverses |
//! | `block` | arithmetic of blocks of at most 3 × 3 |
//! | `pin_block` | arithmetic of pairs of rows [±I b] |
//! | `condensed` | static condensation of a group with a pair of rows |
//! | `saddle` | the matrix, and its elimination |
//! | `schur` | assembly of the Schur complement |
//! | `substitute` | the solution with the factors |
//! | `reference` | reference masses of light groups in the pivot tests |
//! | `regularised` | regularised factors near singular positions (Tikhonov) |
//!
//! # Others
//!
//! | file | concept |
//! |---|---|
//! | `lu_symbolic` | order and fill of an unsymmetric block matrix |
//! | `block_lu` | its factors, real or complex |
//! | `complementarity` | linear complementarity problems |
//! | `dense` | small dense systems |
//! | `symmetric`, `tridiagonal` | eigenvalues and eigenvectors of dense symmetric matrices, small and large |
//! | `null_space` | null vectors of a matrix whose rank is known |
//! | `newton` | damped Newton and Gauss–Newton iteration |
//! | `breakdown` | reasons why a system has no usable solution |
//! | `rank` | numerical rank, dependent rows and left null vectors |

mod block;
mod block_lu;
mod breakdown;
pub mod complementarity;
mod condensed;
mod dense;
mod eigenvalues;
mod full_pivot;
mod lu_symbolic;
mod mass_block;
pub mod newton;
mod null_space;
mod order;
mod pattern;
mod pin_block;
mod rank;
mod records;
mod reference;
mod regularised;
mod saddle;
mod schur;
mod sparse_rank;
mod storage;
mod structure;
mod substitute;
mod symbolic;
mod symmetric;
mod tridiagonal;

pub use block_lu::{BlockLu, LOST};
pub use breakdown::Breakdown;
pub use condensed::{Condensation, CondensedGroup};
pub use dense::{sign_of_determinant, solve_dense};
pub use eigenvalues::eigenvalues;
pub use full_pivot::{solve_any_rank, AnyRank};
pub use lu_symbolic::LuPlan;
pub use mass_block::{InverseMass, PIVOT_TOLERANCE};
pub use newton::Newton;
pub use null_space::{null_space, NullSpace};
pub use order::{groups_first, touched_first};
pub use pattern::Pattern;
pub use rank::{dot, normalize_rows, rank, Rank, RANK_TOLERANCE};
pub use records::{PinEnd, PinRows};
pub use reference::LightGroup;
pub use saddle::Saddle;
pub use schur::PinSum;
pub use sparse_rank::{SparseRank, SparseRow};
pub use structure::{Group, RowBlock};
pub use symmetric::{is_positive, Eigen};
