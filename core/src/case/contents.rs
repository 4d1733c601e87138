//! The contents of a case, its formats and the limits of its texts.

use crate::model::{Definition, Entry, Value};

/// The version of the format that is read and written: `kempe = 1`.
pub const FORMAT_VERSION: u32 = 1;
/// Most bytes of a text that are read: 16 MiB.
pub const MOST_BYTES: usize = 16 << 20;
/// Most faults that are reported.
pub const MOST_REPORTED: usize = 100;

/// How a case is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML 1.0.
    Toml,
    /// JSON, RFC 8259.
    Json,
}

/// A model as written, where it starts, and what is asked of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Case {
    /// The model.
    pub definition: Definition,
    /// Where assembly starts.
    pub start: Start,
    /// Analyses, in order.
    pub analyses: Vec<Entry>,
}

/// Coordinates and rates for the assembly; keys are `body.coordinate`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// Those that are prescribed.
    pub set: Vec<(String, Value)>,
    /// Those that are guessed.
    pub guess: Vec<(String, Value)>,
}
