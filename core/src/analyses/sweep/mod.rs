//! Sweeps: an analysis of one mechanism with many values of its parameters and start, and the numbers of each result.
//!
//! A variant is equivalent to a single run of the changed case: its model is built from the linked blueprint, assembled
//! from the start of the case, and run through the analyses that lead to the swept one. The numbers of a motion are
//! statistics of measures; those of any other result are stated by its analysis. Variants share no state. Their numbers
//! therefore do not depend on the order, and the caller may compute variants on any number of threads.

mod faults;
mod fine;
mod kept;
mod outcomes;
mod readings;
mod request;
mod series;
mod statistic;
mod variant;

pub use faults::{measure_fault, variable_fault};
pub(super) use readings::{PreparedModel, Readings};
pub use request::{Outcome, Sweep, VariantRow, Wanted};
pub(super) use series::Series;
pub use statistic::Statistic;
pub(super) use variant::Ready;
