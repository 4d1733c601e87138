//! All faults of a definition as one Rust error.

use super::problem::Problem;
use std::fmt;

/// All faults that were found, in the order of the model. Not empty if it is returned as an error.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems(pub Vec<Problem>);

/// Largest number of faults in a message.
pub const MOST_REPORTED: usize = 100;
/// Largest number of names in a sentence.
const MOST_NAMES: usize = 20;

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, problem) in self.0.iter().take(MOST_REPORTED).enumerate() {
            write!(f, "{}{problem}", if k == 0 { "" } else { "\n" })?;
        }
        match self.0.len().checked_sub(MOST_REPORTED) {
            None | Some(0) => Ok(()),
            Some(more) => write!(f, "\n{}", more_problems(more)),
        }
    }
}

/// The last line of a message that does not show all problems.
pub fn more_problems(more: usize) -> String {
    format!("… and {more} more problem{}", if more == 1 { "" } else { "s" })
}

/// The text "A, B, C", or the first names and the number of the others.
pub fn listed(names: &[&str]) -> String {
    match names.len().checked_sub(MOST_NAMES) {
        None | Some(0) => names.join(", "),
        Some(more) => format!("{} and {more} more", names[..MOST_NAMES].join(", ")),
    }
}

impl std::error::Error for Problems {}

impl From<Vec<Problem>> for Problems {
    fn from(found: Vec<Problem>) -> Self {
        Self(found)
    }
}
