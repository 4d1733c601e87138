//! The fields of an element in the order in which its scalars are visited.

use crate::elements::{catalogue, Constraint, Shape};
use crate::math::Listed;

/// A field that contains scalars; a point or a pair contains two.
pub(super) enum Scalar {
    Point(String),
    Pair(String),
    Number(String),
    Law(String),
    /// Several numbers, named by their index in the field.
    Numbers(String, usize),
    /// A curve with the given number of scalars. It is printed as the names of C and its derivatives.
    Curve(usize),
    /// Several laws, named by their index in the field.
    Laws(String, usize),
}

/// The fields of an element that contain scalars. An absent optional field contains none.
pub(super) fn scalars<T>(element: &Constraint<T>) -> Vec<Scalar> {
    let tables = catalogue().into_iter().map(|(_, table)| table);
    let fields = tables.filter(|table| table.name == element.kind()).flat_map(|table| table.fields);
    let scalar = |(field, count): (crate::elements::Field, usize)| {
        let name = field.name.to_string();
        match field.shape {
            _ if count == 0 => None,
            Shape::Point => Some(Scalar::Point(name)),
            Shape::Pair => Some(Scalar::Pair(name)),
            Shape::Number => Some(Scalar::Number(name)),
            Shape::Law => Some(Scalar::Law(name)),
            Shape::Terms | Shape::Triple => Some(Scalar::Numbers(name, count)),
            Shape::Curve => Some(Scalar::Curve(count)),
            Shape::LawPair | Shape::Laws | Shape::Coordinate => Some(Scalar::Laws(name, count)),
            _ => None,
        }
    };
    fields.zip(element.scalars()).filter_map(scalar).list()
}
