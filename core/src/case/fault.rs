//! Faults of syntax, by place in the text.

use std::ops::Range;

/// What is wrong with the text itself, before it has paths.
#[derive(Debug)]
pub(super) struct Fault {
    pub place: Range<usize>,
    pub message: String,
}

/// The faults found so far; those beyond [`MOST_REPORTED`](super::MOST_REPORTED) are dropped.
#[derive(Debug, Default)]
pub(super) struct Faults(pub Vec<Fault>);

impl Faults {
    pub(super) fn push(&mut self, place: Range<usize>, message: impl Into<String>) {
        if self.0.len() < super::MOST_REPORTED {
            self.0.push(Fault { place, message: message.into() });
        }
    }
}
