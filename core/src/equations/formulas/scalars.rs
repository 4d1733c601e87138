//! The fields of an element in the order in which its scalars are visited.

use crate::elements::{catalogue, Shape};

/// A field that holds scalars: two for a point or a pair.
pub(super) enum Scalar {
    Point(String),
    Pair(String),
    Number(String),
    Law(String),
}

/// The fields of a type of element that hold scalars.
pub(super) fn scalars(kind: &str) -> Vec<Scalar> {
    let tables = catalogue().into_iter().map(|(_, table)| table);
    let fields = tables.filter(|table| table.name == kind).flat_map(|table| table.fields);
    let scalar = |field: crate::elements::Field| {
        let name = field.name.to_string();
        match field.shape {
            Shape::Point => Some(Scalar::Point(name)),
            Shape::Pair => Some(Scalar::Pair(name)),
            Shape::Number => Some(Scalar::Number(name)),
            Shape::Law => Some(Scalar::Law(name)),
            _ => None,
        }
    };
    fields.filter_map(scalar).collect()
}
