//! The dimension of a formula, inferred from the dimensions of its parameters.
//!
//! A parameter that is written with a unit has a dimension. A plain number has the SI unit that its place requires:
//! as a factor it is dimensionless, and as a summand it has the dimension of the other summand.

use super::names::constant;
use super::operation::{Binary, Unary};
use super::table::Table;
use super::tree::{Node, NodeKind};
use super::unit::Dimension;
use super::{ExpressionError, Names, Symbol};
use crate::math::ShortArray;
use std::fmt;
use std::ops::Range;

/// The dimension of a formula, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inferred {
    /// Numbers only, or a ratio. Compatible with any unit.
    Number,
    /// Contains a value whose unit is not written. Compatible with any unit.
    Open,
    /// Known from the units of its parameters.
    Of(Dimension),
}

const ANGLE: Dimension = Dimension::new(0, 0, 0);

impl Inferred {
    /// The SI unit, if it is known.
    pub fn unit(&self) -> Option<String> {
        match self {
            Self::Of(dimension) => Some(match dimension.common_unit() {
                Some(unit) => unit.to_string(),
                None if *dimension == ANGLE => "rad".to_string(),
                None => dimension.to_string(),
            }),
            Self::Number | Self::Open => None,
        }
    }
}

/// The dimension with the usual unit: `N (kg*m*s^-2)`.
impl fmt::Display for Inferred {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number => f.write_str("a number"),
            Self::Open => f.write_str("an unknown unit"),
            Self::Of(dimension) => match dimension.common_unit() {
                Some(name) => write!(f, "{name} ({dimension})"),
                None if *dimension == ANGLE => f.write_str("rad"),
                None => write!(f, "{dimension}"),
            },
        }
    }
}

/// A part of a formula that was read.
struct Part {
    of: Inferred,
    /// Its value, if it is a literal number. It is needed because exponents change dimensions.
    value: Option<f64>,
    span: Range<usize>,
}

/// Infers the dimension of a tree that was read from `text`.
pub(super) fn infer<N: Names + ?Sized>(
    text: &str,
    nodes: &[Node],
    names: &N,
    of: &dyn Fn(Symbol) -> Inferred,
) -> Result<Inferred, ExpressionError> {
    let mut stack: Vec<Part> = Vec::new();
    for node in nodes {
        let first = stack.len() - node.kind.operands();
        let parts = stack.split_off(first);
        let inference = Inference { text, parts: &parts };
        let (inferred, value) = match &node.kind {
            NodeKind::Number(value) => (Inferred::Number, Some(*value)),
            NodeKind::Name(name) if constant(name).is_some() => (Inferred::Number, None),
            NodeKind::Name(name) => (names.resolve(name).map_or(Inferred::Open, of), None),
            NodeKind::Unary(operation) => inference.unary(*operation)?,
            NodeKind::Binary(operation) => inference.binary(*operation)?,
            NodeKind::Compare(_) => (inference.alike(0, 1)?, None),
            NodeKind::If => (inference.alike(1, 2)?, None),
            NodeKind::Step5 => {
                inference.alike(0, 1)?;
                inference.alike(1, 3)?;
                inference.alike(0, 3)?;
                (inference.alike(2, 4)?, None)
            }
            NodeKind::Call(name, _) => {
                match names.tables().iter().find(|table| table.name() == name) {
                    Some(table) => (inference.read(table)?, None),
                    None => (Inferred::Open, None),
                }
            }
        };
        stack.push(Part { of: inferred, value, span: node.span.clone() });
    }
    Ok(stack.pop().map_or(Inferred::Open, |part| part.of))
}

/// One operation on parts.
struct Inference<'a> {
    text: &'a str,
    parts: &'a [Part],
}

type Found = Result<(Inferred, Option<f64>), ExpressionError>;

impl Inference<'_> {
    fn unary(&self, operation: Unary) -> Found {
        let Part { of, value, .. } = &self.parts[0];
        let inferred = match operation {
            Unary::Negate => return Ok((*of, value.map(|x| -x))),
            Unary::Abs | Unary::Floor => *of,
            Unary::Sqrt => raised(*of, Some(0.5)),
            Unary::Sign | Unary::Step => Inferred::Number,
            _ => {
                self.pure(0, "the argument of a function")?;
                Inferred::Number
            }
        };
        Ok((inferred, None))
    }

    fn binary(&self, operation: Binary) -> Found {
        let [a, b] = [&self.parts[0], &self.parts[1]];
        let value = a.value.zip(b.value).map(|(a, b)| operation.apply(a, b));
        let inferred = match operation {
            Binary::Add | Binary::Subtract | Binary::Min | Binary::Max | Binary::Hypot => {
                self.alike(0, 1)?
            }
            Binary::Atan2 => self.alike(0, 1).map(|_| Inferred::Number)?,
            Binary::Multiply => product(a.of, b.of, 1),
            Binary::Divide => product(a.of, b.of, -1),
            Binary::Power => {
                self.pure(1, "an exponent")?;
                raised(a.of, b.value)
            }
        };
        Ok((inferred, value))
    }

    fn written(&self, k: usize) -> &str {
        &self.text[self.parts[k].span.clone()]
    }

    /// The common dimension of two parts that are added or compared.
    fn alike(&self, a: usize, b: usize) -> Result<Inferred, ExpressionError> {
        match (self.parts[a].of, self.parts[b].of) {
            (Inferred::Of(one), Inferred::Of(other)) if one != other => {
                let [left, right] = [a, b].each(|k| format!("'{}'", self.written(k)));
                let message = format!(
                    "{left} is in {}, but {right} is in {}",
                    self.parts[a].of, self.parts[b].of
                );
                let span = self.parts[a].span.start..self.parts[b].span.end;
                let hint = "only values of one dimension can be added or compared";
                Err(ExpressionError::new(span, message).hint(hint.to_string()))
            }
            (Inferred::Of(d), _) | (_, Inferred::Of(d)) => Ok(Inferred::Of(d)),
            (Inferred::Number, Inferred::Number) => Ok(Inferred::Number),
            _ => Ok(Inferred::Open),
        }
    }

    /// The dimension of a table that is read at a part.
    fn read(&self, table: &Table) -> Result<Inferred, ExpressionError> {
        match (self.parts[0].of, table.x_dimension()) {
            (Inferred::Of(one), Some(other)) if one != other => {
                let (at, name) = (self.written(0), table.name());
                let own = Inferred::Of(other);
                let message =
                    format!("'{at}' is in {}, but {name}(x) needs {own}", Inferred::Of(one));
                let hint = format!("x_unit of table '{name}' must fit");
                Err(ExpressionError::new(self.parts[0].span.clone(), message).hint(hint))
            }
            _ => Ok(table.y_dimension().map_or(Inferred::Open, Inferred::Of)),
        }
    }

    /// Rejects a part with a dimension where a number or an angle is required.
    fn pure(&self, k: usize, place: &str) -> Result<(), ExpressionError> {
        match self.parts[k].of {
            Inferred::Of(dimension) if dimension != ANGLE => {
                let message = format!(
                    "'{}' is in {}; {place} must be a number or an angle",
                    self.written(k),
                    self.parts[k].of
                );
                let hint = "divide it by a value of the same dimension".to_string();
                Err(ExpressionError::new(self.parts[k].span.clone(), message).hint(hint))
            }
            _ => Ok(()),
        }
    }
}

/// The dimension of a · b^power.
fn product(a: Inferred, b: Inferred, power: i8) -> Inferred {
    match (a, b) {
        (Inferred::Of(a), Inferred::Of(b)) => match a.times(b, power) {
            // the ratio of two equal dimensions is a number
            Some(ANGLE) if a != ANGLE => Inferred::Number,
            Some(dimension) => Inferred::Of(dimension),
            None => Inferred::Open,
        },
        (Inferred::Open, _) | (_, Inferred::Open) => Inferred::Open,
        (Inferred::Of(a), Inferred::Number) => Inferred::Of(a),
        (Inferred::Number, b) => raised(b, Some(f64::from(power))),
    }
}

/// The dimension of a base raised to a power. The power is known only if it is a literal number.
fn raised(base: Inferred, power: Option<f64>) -> Inferred {
    match (base, power) {
        (Inferred::Of(dimension), Some(power)) => {
            dimension.raised(power).map_or(Inferred::Open, Inferred::Of)
        }
        (Inferred::Of(dimension), None) if dimension != ANGLE => Inferred::Open,
        (base, _) => base,
    }
}
