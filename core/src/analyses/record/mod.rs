//! The record of an analysis: what every analysis takes and returns.
//!
//! An analysis is a set of options that implements [`Analysis`]. It starts at a [`StartState`] and returns a [`Record`],
//! or [`Unfinished`] with the record so far.
//!
//! | file | concept |
//! |---|---|
//! | `analysis` | the trait of analyses, their subject, and who watches them |
//! | `result` | the record, and the quantity that replaces the time |
//! | `outcome` | the reason for which an analysis fails, with advice |
//! | `motion` | the record of forward dynamics |

mod analysis;
mod motion;
mod outcome;
mod result;

pub use analysis::{Acting, Analysis, Observer, StartState, Subject};
pub use outcome::{ErrorClass, Outcome, Unfinished};
pub use result::{rate_unit, Driven, Numbers, Record, Variable};
