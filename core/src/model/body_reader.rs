//! Reads the fields of one body, and composes formulas of them.

use super::body_fields::POINT_MASS;
use super::definition::{Entry, Value};
use super::items::Body;
use super::problem::Problem;
use super::scope::{Reach, Scope};
use super::unit_check::ANY_UNIT;
use crate::expression::{Expression, FormulaValues, Tape};
use crate::math::Local;

/// Reads one body of the file.
pub(super) struct Reader<'a> {
    pub entry: &'a Entry,
    pub scope: &'a Scope,
    /// Values of the parameters.
    pub values: &'a [f64],
    pub problems: &'a mut Vec<Problem>,
}

impl Reader<'_> {
    /// A body without mass or points; its curves and its outline are read.
    pub(super) fn blank(&mut self, kind: &'static str) -> Body<Tape> {
        let zero = || Tape::from(0.0);
        let moving = Tape::from(if kind == "ground" { 0.0 } else { 1.0 });
        Body {
            name: self.entry.name.clone(),
            kind,
            mass: moving.clone(),
            inertia: moving,
            center: Local { x: zero(), y: zero() },
            points: Vec::new(),
            curves: super::curves::read(self.entry, self.scope, self.problems),
            shapes: Vec::new(),
            outline: super::read_outline::read(self.entry, self.scope, self.problems),
            drawn: None,
            turns: kind != POINT_MASS,
        }
    }

    pub(super) fn number(&mut self, key: &str, unit: &str) -> Option<Tape> {
        match self.entry.get(key) {
            Some(value) => {
                let path = self.path(key);
                self.scope.formula(value, &path, unit, Reach::Parameters, self.problems)
            }
            None => {
                self.missing(&format!("'{key}' is missing"));
                None
            }
        }
    }

    /// The present value of a formula that is composed here.
    pub(super) fn value(&mut self, text: &str) -> f64 {
        let tape = self.compose(text);
        let values = FormulaValues { parameters: self.values, time: f64::NAN, variables: &[] };
        tape.evaluate(&values)
    }

    /// A formula that is composed here. It can only fail by becoming too long.
    pub(super) fn compose(&mut self, text: &str) -> Tape {
        let path = self.path("type");
        let value = Value::Text(text.to_string());
        let tape =
            self.scope.formula(&value, &path[..2], ANY_UNIT, Reach::Parameters, self.problems);
        tape.unwrap_or_else(|| Tape::from(0.0))
    }

    pub(super) fn path(&self, key: &str) -> [String; 3] {
        ["bodies".to_string(), self.entry.name.clone(), key.to_string()]
    }

    pub(super) fn report(&mut self, key: &str, message: &str) {
        self.problems.push(Problem::at(&self.path(key), message));
    }

    pub(super) fn missing(&mut self, message: &str) {
        self.problems.push(Problem::at(&["bodies", &self.entry.name], message));
    }
}

/// A value as a term of a longer formula. A quantity with a unit is not allowed in formulas, so its number is used.
pub(super) fn term(value: &Value) -> String {
    match value {
        Value::Number(x) => format!("({x:?})"),
        Value::Text(text) => match Expression::parse(text) {
            Ok(e) if e.dimension().is_some() => match e.compile(&[""; 0]).map(|t| t.constant()) {
                Ok(Some(x)) => format!("({x:?})"),
                _ => format!("({text})"),
            },
            _ => format!("({text})"),
        },
        _ => "0".to_string(),
    }
}
