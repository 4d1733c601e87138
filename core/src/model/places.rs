//! The indices of names, for fast look-up in a large model.

use super::definition::{Definition, Value};
use super::variable::Variable;
use crate::elements::own_of;
use std::collections::HashMap;

/// The indices of the names of each kind.
#[derive(Clone, Debug, Default)]
pub(super) struct NameIndex {
    pub parameters: HashMap<String, usize>,
    pub bodies: HashMap<String, usize>,
    pub states: HashMap<String, usize>,
    /// Internal coordinates of joints and their rates, such as `cam.u` and `cam.u_rate`.
    pub internals: HashMap<String, Variable>,
    /// Joints and drivers, in the order of the file.
    pub constraints: HashMap<String, usize>,
    /// Forces, in the order of the file.
    pub forces: HashMap<String, usize>,
}

impl NameIndex {
    /// Adds second names of bodies: (name, second name).
    pub fn add_ends(&mut self, ends: impl Iterator<Item = (String, String)>) {
        for (body, end) in ends {
            let place = self.bodies.get(&body).copied();
            place.into_iter().for_each(|k| _ = self.bodies.entry(end.clone()).or_insert(k));
        }
    }

    /// The index of an internal coordinate, such as `cam.u`, among those of all joints.
    pub fn place_on_curve(&self, name: &str) -> Option<usize> {
        match self.internals.get(name)? {
            Variable::Internal { place, rate: false } => Some(*place),
            _ => None,
        }
    }
}

/// The first index of each name.
pub(super) fn places<'n>(names: impl Iterator<Item = &'n String>) -> HashMap<String, usize> {
    let mut places = HashMap::new();
    names.enumerate().for_each(|(k, name)| _ = places.entry(name.clone()).or_insert(k));
    places
}

/// The internal coordinates of all joints and their rates, in the order of the layout.
pub(super) fn internals(definition: &Definition) -> HashMap<String, Variable> {
    let mut places = HashMap::new();
    let mut place = 0;
    for entry in &definition.joints {
        let Some(Value::Text(kind)) = entry.get("type") else { continue };
        let count = own_of(kind);
        for k in 1..=count {
            let number = if count == 1 { String::new() } else { k.to_string() };
            for (rate, suffix) in [(false, ""), (true, "_rate")] {
                let name = format!("{}.u{number}{suffix}", entry.name);
                places.insert(name, Variable::Internal { place, rate });
            }
            place += 1;
        }
    }
    places
}
