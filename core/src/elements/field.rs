//! Fields of an element as data: shape, unit, default, and one sentence.

use super::quantity_kind::QuantityKind;

/// The values that a field accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Name of a body.
    Body,
    /// `body.point`.
    Point,
    /// `body.curve`.
    Curve,
    /// Names of curves, each with a table.
    Curves,
    /// Shapes of a body, each a table with a type.
    Shapes,
    /// Points, a circle or a path.
    Outline,
    /// A cross section of a beam.
    Section,
    /// At least three points without names.
    Corners,
    /// `body.x`, `body.y` or `body.angle`.
    Coordinate,
    /// Name of a joint.
    Joint,
    /// Number or expression in the parameters.
    Number,
    /// Number or expression in the parameters, `t` and the state.
    Law,
    /// Two numbers.
    Pair,
    /// Any number of pairs: the first and the last value of ranges.
    Ranges,
    /// Three numbers, each with its own unit. The unit of the field lists them, separated by commas.
    Triple,
    /// Two laws.
    LawPair,
    /// Any number of laws.
    Laws,
    /// Position quantities with a number each.
    Terms,
    /// Any number of units of equations.
    Units,
    /// Names of points with two numbers each.
    Points,
    /// Two names.
    Names,
    /// Two texts.
    TwoTexts,
    /// One name.
    Name,
    /// Any number of names.
    NameList,
    /// Any number of quantities, such as `crank.angle`, or of parameters.
    Quantities,
    /// A condition on quantities: a comparison, or an expression that becomes zero.
    Condition,
    /// Conditions by name, each written alone or in a table with a direction.
    Events,
    /// Parameters with a value each.
    Values,
    /// Numbers, without formulas.
    Numbers,
    /// Names of two columns of a file.
    Columns,
    /// true or false.
    Flag,
    /// A whole number from 1.
    Count,
    /// A number, or a table of numbers for some of [`TOLERANCES`].
    Tolerance,
    /// One of these words.
    Word(&'static [&'static str]),
    /// A table of the family of options of this name, chosen by its `type`.
    Options(&'static str),
}

/// The units that an equation may have.
pub const UNITS_OF_EQUATIONS: &[&str] =
    &[QuantityKind::OF_EQUATIONS[0].unit(), QuantityKind::OF_EQUATIONS[1].unit()];

/// The kinds of quantities that can have their own tolerance.
pub const TOLERANCES: [&str; 3] = ["length", "angle", "z"];

/// A default value of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Default {
    /// One number.
    Number(f64),
    /// Two numbers.
    Pair([f64; 2]),
    /// Three numbers.
    Triple([f64; 3]),
    /// true or false.
    Flag(bool),
    /// The options of this type with their defaults.
    Type(&'static str),
    /// This body or word.
    Body(&'static str),
    /// Nothing: the field may be left out.
    Absent,
}

impl From<f64> for Default {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}
impl From<[f64; 2]> for Default {
    fn from(x: [f64; 2]) -> Self {
        Self::Pair(x)
    }
}
impl From<[f64; 3]> for Default {
    fn from(x: [f64; 3]) -> Self {
        Self::Triple(x)
    }
}
impl From<bool> for Default {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}
impl From<&'static str> for Default {
    fn from(name: &'static str) -> Self {
        Self::Body(name)
    }
}

/// One field of an element, for files, the schema, Python and the reference page.
#[derive(Clone, Debug)]
pub struct Field {
    /// Key in the file, argument in Python.
    pub name: &'static str,
    /// The values that it accepts.
    pub shape: Shape,
    /// SI unit; empty for references.
    pub unit: String,
    /// Value if absent. A field without a default is required.
    pub default: Option<Default>,
    /// One sentence.
    pub doc: String,
}

impl Field {
    /// A field that must be given.
    pub fn required(name: &'static str, shape: Shape, unit: &str, doc: &str) -> Self {
        Self { name, shape, unit: unit.to_string(), default: None, doc: doc.to_string() }
    }
    /// A field with a default; [`Default::Absent`] if it may be left out.
    pub fn optional(
        name: &'static str,
        shape: Shape,
        unit: &str,
        default: Default,
        doc: &str,
    ) -> Self {
        Self { default: Some(default), ..Self::required(name, shape, unit, doc) }
    }
}
