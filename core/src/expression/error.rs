//! Faults of an expression, with their places.

use std::fmt;
use std::ops::Range;

/// An expression that cannot be read or compiled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExpressionError {
    /// Description, in one sentence without a full stop.
    pub message: String,
    /// The bytes of the text at fault, on character boundaries; empty at the end of the text.
    pub span: Range<usize>,
    /// A suggested remedy, if there is one.
    pub hint: Option<String>,
}

impl ExpressionError {
    /// An error without a hint.
    pub fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self { message: message.into(), span, hint: None }
    }

    /// The same error with a hint, or without a hint for `None`.
    pub fn hint(self, hint: impl Into<Option<String>>) -> Self {
        Self { hint: hint.into(), ..self }
    }
}

impl fmt::Display for ExpressionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        match &self.hint {
            Some(hint) => write!(f, "; {hint}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for ExpressionError {}
