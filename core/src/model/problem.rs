//! A fault of a definition, with its path and remedy.

use crate::expression::ExpressionError;
use crate::math::Listed;
use std::fmt;
use std::ops::Range;

/// One fault of a definition. A reader of a file adds line and column from the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Keys from the top of the file, such as `bodies`, `crank`, `mass`; list indices as digits.
    pub path: Vec<String>,
    /// Description, with the value and the requirement.
    pub message: String,
    /// Remedy, if there is one.
    pub hint: Option<String>,
    /// The range of faulty bytes within the value at `path`, if the value is a text and only a part of it is wrong.
    pub within: Option<Range<usize>>,
    /// Whether the key is wrong rather than its value.
    pub at_key: bool,
}

impl Problem {
    /// A fault whose path the caller adds.
    pub fn new(message: impl Into<String>) -> Self {
        let message = message.into();
        Self { path: Vec::new(), message, hint: None, within: None, at_key: false }
    }
    /// A fault of the value at `path`.
    pub fn at<P: AsRef<str>>(path: &[P], message: impl Into<String>) -> Self {
        let path = path.iter().map(|p| p.as_ref().to_string()).list();
        Self { path, ..Self::new(message) }
    }
    /// Adds a hint.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
    /// Adds a hint, if given.
    pub fn maybe_hint(mut self, hint: Option<String>) -> Self {
        self.hint = self.hint.or(hint);
        self
    }
    /// Restricts the fault to these bytes of the value.
    pub fn within(mut self, span: Range<usize>) -> Self {
        self.within = Some(span);
        self
    }
    /// Marks the key itself as wrong.
    pub fn at_key(mut self) -> Self {
        self.at_key = true;
        self
    }
}

impl From<ExpressionError> for Problem {
    /// The fault of a formula, with the faulty bytes and the remedy.
    fn from(fault: ExpressionError) -> Self {
        Self::new(fault.message).within(fault.span).maybe_hint(fault.hint)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.join(".");
        write!(f, "{path}{}{}", if path.is_empty() { "" } else { ": " }, self.message)?;
        match &self.hint {
            Some(hint) => write!(f, "; {hint}"),
            None => Ok(()),
        }
    }
}
