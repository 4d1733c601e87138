//! Expressions: text → syntax tree → tape → value on any [`Real`](crate::math::Real).
//!
//! ```text
//! expression = sum                      a comparison is allowed only as the condition of `if`
//! comparison = sum ("<" | "<=" | ">" | ">=") sum
//! sum        = product {("+" | "-") product}
//! product    = unary {("*" | "/") unary}
//! unary      = ("-" | "+") unary | power
//! power      = primary ["^" unary]      so -2^2 = -4, 2^-1 = 0.5, 2^3^2 = 2^9
//! primary    = number | name | function "(" arguments ")" | "(" comparison ")"
//! function   = one of FUNCTIONS, or the name of a table with one argument
//! name       = part {"." part}          L1, t, pi, crank.omega, `my body`.omega
//! ```
//!
//! A text that consists of a single number may have a unit (`30 deg`, `-5 kN`, see [`mod@unit`]); an expression never
//! does. Everything is in SI units and radians. A parameter with a unit has a dimension, and [`Expression::infer`]
//! infers the dimension of a formula.
//!
//! A power with a constant exponent (`x^2`, `x^(3/2)`) is defined as in `f64`. If the exponent is a parameter or
//! varies, the derivatives exist for x > 0 only.
//!
//! ```
//! use kempe::expression::{Expression, FormulaValues};
//! let law = Expression::parse("-k*(x - L0)^3")?;
//! let tape = law.compile(&["k", "x", "L0"])?;
//! let values = FormulaValues { parameters: &[2.0, 1.5, 1.0], time: 0.0, variables: &[] };
//! assert_eq!(tape.evaluate(&values), -0.25);
//! # Ok::<(), kempe::expression::ExpressionError>(())
//! ```

mod compile;
mod error;
mod inference;
mod knots;
mod lexer;
mod limits;
mod motion_law;
mod names;
mod operation;
pub mod parameters;
mod parser;
mod points;
mod postfix;
mod print;
mod quantity;
pub mod suggest;
mod switch;
mod switch_times;
mod symbol;
mod table;
mod tape;
mod text;
mod tree;
pub mod unit;

pub use error::ExpressionError;
pub use inference::Inferred;
pub use knots::Knots;
pub use limits::{MAX_DEPTH, MAX_LENGTH, MAX_OPERANDS};
pub use motion_law::MotionLaw;
pub use names::{is_identifier, is_reserved, Names};
pub use operation::{Function, FUNCTIONS};
pub use points::{Outside, Points, TableError, TABLE_ENDS};
pub(crate) use postfix::Postfix;
pub use switch::Boundaries;
pub use switch_times::{pieces_at, switch_places, switch_times, TooManySwitches};
pub use symbol::Symbol;
pub use table::{Kink, Table};
pub use tape::{FormulaSwitch, FormulaValues, Tape, Values};
pub use text::{Expression, Sense};
