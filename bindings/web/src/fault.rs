//! The reason that a request fails.

use kempe::analyses::record::Outcome;
use kempe::case::{Diagnostic, Document};
use kempe::model::Problem;
use serde_json::{json, Value};

/// A message with its remedy, and the faults of a text.
#[derive(Debug, Default)]
pub struct Fault {
    /// The message.
    pub message: String,
    hint: Option<String>,
    problems: Vec<Value>,
}

impl Fault {
    /// A fault with a message.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), ..Self::default() }
    }

    /// Adds a remedy. An empty text is ignored.
    pub fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()).filter(|hint| !hint.is_empty()), ..self }
    }

    /// The fault for several faults of a model, without positions in a text.
    pub fn of_problems(found: &[Problem]) -> Self {
        let first = found.first().map_or_else(String::new, ToString::to_string);
        Self { message: first, hint: None, problems: found.iter().map(problem).collect() }
    }

    /// The fault for the faults of a text.
    pub fn of_diagnostics(found: &[Diagnostic]) -> Self {
        let first = found.first().map_or_else(String::new, ToString::to_string);
        Self { message: first, hint: None, problems: found.iter().map(diagnostic).collect() }
    }

    /// The fault for one problem of a request, with its remedy.
    pub fn of_problem(found: Problem) -> Self {
        let hint = found.hint.unwrap_or_default();
        Self::new(found.message).hint(hint)
    }

    /// The value of `error` in a reply.
    pub fn value(&self) -> Value {
        json!({ "message": self.message, "hint": self.hint, "problems": self.problems })
    }

    /// The fault as a reply.
    pub fn reply(&self) -> String {
        json!({ "error": self.value() }).to_string()
    }
}

impl From<Outcome> for Fault {
    fn from(outcome: Outcome) -> Self {
        let problems = outcome.problems.iter().map(problem).collect();
        Self { message: outcome.message, hint: outcome.hint, problems }
    }
}

/// A fault of a text.
pub fn diagnostic(found: &Diagnostic) -> Value {
    let place = |number: usize| (found.line > 0).then_some(number);
    let length = found.excerpt.chars().filter(|c| *c == '^').count().max(1);
    json!({
        "message": found.message, "hint": found.hint, "path": found.path.join("."),
        "line": place(found.line), "column": place(found.column), "length": length,
    })
}

/// The faults of a model, with their positions in the text if it has them.
pub fn placed(document: &Document, found: &[Problem]) -> Vec<Value> {
    let mut found: Vec<Diagnostic> = found.iter().map(|p| document.diagnose(p)).collect();
    found.sort_by_key(|d| (d.line, d.column));
    found.iter().map(diagnostic).collect()
}

/// A fault of a model, without a position in a text.
pub fn problem(found: &Problem) -> Value {
    json!({
        "message": found.message, "hint": found.hint, "path": found.path.join("."),
        "line": null, "column": null, "length": 1,
    })
}
