//! Faults of syntax, by place in the text.

use std::ops::Range;

/// What is wrong with the text itself, before it has paths.
#[derive(Debug)]
pub(super) struct Fault {
    pub place: Range<usize>,
    pub message: String,
    /// Where the same key stood before, if that is the fault; such a fault leaves the tree sound.
    pub earlier: Option<Range<usize>>,
}

impl Fault {
    /// A key that is given a second time.
    pub(super) fn twice(key: &str, place: Range<usize>, earlier: Range<usize>) -> Self {
        let message = format!("key '{}' is given twice", super::shown(key));
        Self { place, message, earlier: Some(earlier) }
    }
}

/// The faults found so far; those beyond [`MOST_REPORTED`](super::MOST_REPORTED) are dropped.
#[derive(Debug, Default)]
pub(super) struct Faults(pub Vec<Fault>);

impl Faults {
    /// A fault of syntax.
    pub(super) fn push(&mut self, place: Range<usize>, message: impl Into<String>) {
        self.add(Fault { place, message: message.into(), earlier: None });
    }
    pub(super) fn add(&mut self, fault: Fault) {
        if self.0.len() < super::MOST_REPORTED {
            self.0.push(fault);
        }
    }
    /// Whether the tree says what the text says, but for keys given twice.
    pub(super) fn sound(&self) -> bool {
        self.0.iter().all(|fault| fault.earlier.is_some())
    }
}
