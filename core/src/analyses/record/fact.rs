//! A named value of a result, for readers.

use crate::analyses::readings::find;
use crate::elements::QuantityKind;
use crate::model::Model;
use serde_json::Value;

/// A named value of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// Its name.
    pub name: String,
    /// A number, a text, or null where the name is enough.
    pub value: Value,
    /// The SI unit of a number; empty without one.
    pub unit: String,
}

impl Fact {
    /// A value without a unit.
    pub fn new(name: impl Into<String>, value: impl Into<Value>) -> Self {
        Self { name: name.into(), value: value.into(), unit: String::new() }
    }

    /// Gives the SI unit.
    pub fn unit(mut self, unit: impl Into<String>) -> Self {
        self.unit = unit.into();
        self
    }

    /// A list of names; none if it is empty.
    pub fn list(name: impl Into<String>, of: &[String]) -> Option<Self> {
        (!of.is_empty()).then(|| Self::new(name, of.join(", ")))
    }
}

/// The SI unit of the effort along a quantity: N for a length, N*m for an angle, J for a number.
pub fn effort_unit(model: &Model, quantity: &str) -> &'static str {
    let kind = find(model, quantity).ok().and_then(|found| QuantityKind::of_unit(&found.unit));
    kind.unwrap_or_default().unit_of_effort()
}
