//! The contents of a case, its formats and the limits of its texts.

pub use crate::model::MOST_REPORTED;
use crate::model::{Definition, Entry, Value};

/// The version of the format that is read and written: `kempe = 1`.
pub const FORMAT_VERSION: u32 = 1;
/// Largest size of a text, in bytes: 16 MiB.
pub const MOST_BYTES: usize = 16 << 20;

/// The format of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML 1.0.
    Toml,
    /// JSON, RFC 8259.
    Json,
}

/// A model as written, its start, and its analyses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Case {
    /// The model.
    pub definition: Definition,
    /// The start of assembly.
    pub start: Start,
    /// Analyses, in order.
    pub analyses: Vec<Entry>,
    /// The sweep: variables, measures and the design; empty without one.
    pub sweep: Vec<(String, Value)>,
    /// The gradient: measures and variables; empty without one.
    pub gradient: Vec<(String, Value)>,
    /// The optimisation: variables, an objective and limits; empty without one.
    pub optimize: Vec<(String, Value)>,
    /// The fit: columns of data, and parameters; empty without one.
    pub fit: Vec<(String, Value)>,
    /// The synthesis: a task and limits of the linkages; empty without one.
    pub synthesis: Vec<(String, Value)>,
    /// The exercise: questions and random parameters; empty without one.
    pub exercise: Vec<(String, Value)>,
}

/// Coordinates and rates for the assembly; keys are `body.coordinate`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// Prescribed coordinates and rates.
    pub set: Vec<(String, Value)>,
    /// Guessed coordinates and rates.
    pub guess: Vec<(String, Value)>,
}
