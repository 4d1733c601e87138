//! The record of an analysis: what every analysis takes and returns.
//!
//! An analysis is a set of options that implements [`Analysis`]. It starts at a [`StartState`] and returns a [`Record`],
//! or [`Unfinished`] with the record so far.
//!
//! | file | concept |
//! |---|---|
//! | `start_state` | the state in which an analysis starts |
//! | `analysis` | the trait of analyses, their subject, and who watches them |
//! | `result` | the record, and the quantity that replaces the time |
//! | `fact` | a named value of a result, for readers |
//! | `numbers` | one number or several, of which a text names one |
//! | `outcome` | the reason for which an analysis fails, with advice |
//! | `motion` | the record of forward dynamics |

mod analysis;
mod fact;
mod motion;
mod numbers;
mod outcome;
mod result;
mod start_state;

pub use analysis::{Analysis, EventActions, Observer, Subject};
pub use fact::{effort_unit, Fact};
pub use motion::{missing, with_start};
pub use numbers::{parts, NumberList};
pub use outcome::{ErrorClass, Outcome};
pub use result::{
    rate_unit, Driven, NamedNumber, NumberTable, Record, RunResult, Unfinished, Variable,
};
pub use start_state::StartState;
