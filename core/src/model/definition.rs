//! A model as written: names, numbers and formulas as text, in the order of the file.

use super::functions::Functions;
pub use crate::elements::Value;

/// A named item with its fields: a body, a joint, a force, an analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// Its fields as written, including `type`.
    pub fields: Vec<(String, Value)>,
}

impl Entry {
    /// A field by its key.
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.fields.iter().find(|(k, _)| k == key).map(|(_, v)| v)
    }
}

/// A model as written. The order of the items is their order in q and Φ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Definition {
    /// Title.
    pub title: Option<String>,
    /// Acceleration of free fall, two numbers or formulas, m/s²; zero if absent.
    pub gravity: Option<Value>,
    /// Whether redundant constraints are accepted: "allow" or "refuse"; refused if absent.
    pub redundancy: Option<String>,
    /// Named parameters: numbers or formulas of other parameters.
    pub parameters: Vec<(String, Value)>,
    /// Tables: functions through given points.
    pub tables: Vec<Entry>,
    /// Bodies. An entry `ground` contains the points of ground.
    pub bodies: Vec<Entry>,
    /// Joints.
    pub joints: Vec<Entry>,
    /// Drivers.
    pub drivers: Vec<Entry>,
    /// Forces.
    pub forces: Vec<Entry>,
    /// Measures: named expressions of quantities, evaluated after an analysis.
    pub measures: Vec<(String, Value)>,
    /// Laws that the host computes. [`Value::Function`] contains the number of a law.
    pub functions: Option<Functions>,
}
