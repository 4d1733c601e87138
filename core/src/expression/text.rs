//! An expression as written.

use super::compile::compile;
use super::limits::MAX_LENGTH;
use super::operation::Relation;
use super::unit::Dimension;
use super::{inference, parser, print, quantity, tree::Node};
use super::{ExpressionError, Inferred, Names, Symbol, Tape};
use std::fmt;

/// The sense of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sense {
    /// 1 if the comparison holds for a positive difference of its sides, -1 if it holds for a negative difference.
    pub sign: f64,
    /// Whether the comparison fails for a difference of zero.
    pub strict: bool,
}

/// An expression: its text, and the syntax tree read from it.
///
/// Equal expressions have equal trees and equal [`dimension`](Expression::dimension), regardless of spaces and
/// superfluous parentheses. `Display` writes the tree in its shortest form, which is read as an equal expression;
/// [`text`](Expression::text) returns the original text.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    nodes: Vec<Node>,
    dimension: Option<Dimension>,
}

impl Expression {
    /// Reads an expression, or a number with a unit. Names are not looked up yet.
    ///
    /// # Errors
    /// The first part of the text that is not in the language, or a text that exceeds [`MAX_LENGTH`] or
    /// [`MAX_DEPTH`].
    pub fn parse(text: &str) -> Result<Self, ExpressionError> {
        check_length(text)?;
        let (nodes, dimension) = match quantity::read(text)? {
            Some((node, unit)) => (vec![node], Some(unit.dimension)),
            None => (parser::parse(text)?, None),
        };
        Ok(Self { text: text.to_string(), nodes, dimension })
    }

    /// Reads a condition: an expression, or the difference of the sides of a comparison with its sense.
    ///
    /// # Errors
    /// As [`parse`](Self::parse).
    pub fn parse_condition(text: &str) -> Result<(Self, Option<Sense>), ExpressionError> {
        check_length(text)?;
        let (nodes, relation) = parser::parse_condition(text)?;
        let sense = relation.map(|relation| {
            let (sign, strict) = match relation {
                Relation::Greater => (1.0, true),
                Relation::GreaterOrEqual => (1.0, false),
                Relation::Less => (-1.0, true),
                Relation::LessOrEqual => (-1.0, false),
            };
            Sense { sign, strict }
        });
        Ok((Self { text: text.to_string(), nodes, dimension: None }, sense))
    }

    /// A number as an expression; its text reads back as the same number.
    ///
    /// # Errors
    /// NaN and infinities.
    pub fn number(value: f64) -> Result<Self, ExpressionError> {
        if !value.is_finite() {
            return Err(ExpressionError::new(0..0, format!("{value} is not a finite number")));
        }
        Self::parse(&format!("{value:?}"))
    }

    /// The text as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The dimension of the unit after a single number. `None` if no unit was written; the value is then in the SI
    /// unit that its place requires.
    pub fn dimension(&self) -> Option<Dimension> {
        self.dimension
    }

    /// The dimension of the value; `of` returns the dimensions of the symbols.
    ///
    /// # Errors
    /// A sum of different dimensions; a function or an exponent of a value with a dimension.
    pub fn infer<N: Names + ?Sized>(
        &self,
        names: &N,
        of: &dyn Fn(Symbol) -> Inferred,
    ) -> Result<Inferred, ExpressionError> {
        match self.dimension {
            Some(dimension) => Ok(Inferred::Of(dimension)),
            None => inference::infer(&self.text, &self.nodes, names, of),
        }
    }

    /// Looks up the names and prepares the expression for evaluation; constants are folded.
    ///
    /// # Errors
    /// An unknown name; a constant part that is not finite (`1/0`, `sqrt(-1)`); an expression that
    /// needs more than [`MAX_OPERANDS`].
    pub fn compile<N: Names + ?Sized>(&self, names: &N) -> Result<Tape, ExpressionError> {
        compile(&self.text, &self.nodes, names)
    }
}

fn check_length(text: &str) -> Result<(), ExpressionError> {
    if text.len() <= MAX_LENGTH {
        return Ok(());
    }
    let message = format!("the expression has {} bytes; at most {MAX_LENGTH} are read", text.len());
    Err(ExpressionError::new(0..text.len(), message)
        .hint("give its parts names of their own as parameters".to_string()))
}

impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        self.nodes == other.nodes && self.dimension == other.dimension
    }
}

impl fmt::Display for Expression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.dimension {
            Some(_) => f.write_str(self.text.trim()),
            None => f.write_str(&print::print(&self.text, &self.nodes)),
        }
    }
}

impl std::str::FromStr for Expression {
    type Err = ExpressionError;
    fn from_str(text: &str) -> Result<Self, ExpressionError> {
        Self::parse(text)
    }
}
