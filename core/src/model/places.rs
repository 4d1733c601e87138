//! The places of names, so that a name is found at once in a large model.

use std::collections::HashMap;

/// The places of the names of each kind.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    pub parameters: HashMap<String, usize>,
    pub bodies: HashMap<String, usize>,
    pub states: HashMap<String, usize>,
    /// Joints and drivers as they are written.
    pub constraints: HashMap<String, usize>,
    /// Forces as they are written.
    pub forces: HashMap<String, usize>,
}

/// The first place of each name.
pub(super) fn places<'n>(names: impl Iterator<Item = &'n String>) -> HashMap<String, usize> {
    let mut places = HashMap::new();
    names.enumerate().for_each(|(k, name)| _ = places.entry(name.clone()).or_insert(k));
    places
}
