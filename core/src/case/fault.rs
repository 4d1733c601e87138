//! Faults of syntax and their places in the text.

use std::ops::Range;

/// A fault of the syntax, which has no path.
#[derive(Debug)]
pub(super) struct TextFault {
    pub place: Range<usize>,
    pub message: String,
    /// The earlier place of the same key, if a key occurs twice. The tree is complete in spite of such a fault.
    pub earlier: Option<Range<usize>>,
}

impl TextFault {
    /// A key that occurs a second time.
    pub(super) fn twice(key: &str, place: Range<usize>, earlier: Range<usize>) -> Self {
        let message = format!("key '{}' is given twice", super::shown(key));
        Self { place, message, earlier: Some(earlier) }
    }
}

/// The faults found so far, and the number of faults beyond [`MOST_REPORTED`](super::MOST_REPORTED), which are only
/// counted.
#[derive(Debug, Default)]
pub(super) struct Faults(pub Vec<TextFault>, pub usize);

impl Faults {
    /// A fault of syntax.
    pub(super) fn push(&mut self, place: Range<usize>, message: impl Into<String>) {
        self.add(TextFault { place, message: message.into(), earlier: None });
    }
    pub(super) fn add(&mut self, fault: TextFault) {
        match self.0.len() < super::MOST_REPORTED {
            true => self.0.push(fault),
            false => self.1 += 1,
        }
    }
    /// Whether the tree contains all of the text, except keys that occur twice.
    pub(super) fn sound(&self) -> bool {
        self.0.iter().all(|fault| fault.earlier.is_some())
    }
}
