//! What was not read, with its place.

use std::fmt;

/// A part of a file that the case lacks.
#[derive(Clone, Debug, PartialEq)]
pub struct Unread {
    /// The line, from 1; 0 for the file as a whole.
    pub line: usize,
    /// The thing and the reason, for people.
    pub what: String,
    /// Whether the motion and the forces are the same without it, such as for a shape or a note.
    pub harmless: bool,
}

impl fmt::Display for Unread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => f.write_str(&self.what),
            line => write!(f, "line {line}: {}", self.what),
        }
    }
}

/// The list of unread parts.
#[derive(Debug, Default)]
pub(crate) struct UnreadList(Vec<Unread>);

impl UnreadList {
    /// Something that changes the motion or the forces.
    pub(crate) fn lost(&mut self, line: usize, what: impl Into<String>) {
        self.0.push(Unread { line, what: what.into(), harmless: false });
    }

    /// Something that only changes the drawing or the notes.
    pub(crate) fn left(&mut self, line: usize, what: impl Into<String>) {
        self.0.push(Unread { line, what: what.into(), harmless: true });
    }

    /// All of it, in the order of the file.
    pub(crate) fn sorted(mut self) -> Vec<Unread> {
        self.0.sort_by_key(|unread| unread.line);
        self.0
    }
}
