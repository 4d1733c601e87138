//! A scalar that records formulas, so that the code that computes numbers also yields its equations as text.
//!
//! A [`Symbolic`] is an index into an arena of expression nodes. Equal expressions are stored once.
//! The arena belongs to one call of [`record`](fn@record) and is freed at its end; a value from another call
//! counts as NaN. Every operation returns a simplified expression: like terms are merged, and the
//! sums of products of sines and cosines are written with sums of angles.
//!
//! [`Record::differentiate`] names the vectors in the residuals Φ, such as d = Pⱼ - Pᵢ, and
//! derives Φ_q and γ in terms of them. [`Record::write`] prints in one of three [`Form`]s.
//!
//! ```
//! use kempe::symbolic::{record, Form, Name};
//! use kempe::math::Real;
//! let text = record(|record| {
//!     let (a, b) = (record.symbol(Name::field("a")), record.symbol(Name::field("b")));
//!     record.write(a.cos() * b.cos() - a.sin() * b.sin() + a - a, Form::Expression)
//! });
//! assert_eq!(text, "cos(a + b)");
//! ```

mod algebra;
mod arena;
mod choice;
mod definitions;
mod derivative;
mod factor;
mod function;
mod identities;
mod name;
mod naming;
mod number;
mod order;
mod print;
mod record;
mod scalar;
mod style;
mod tape;

pub(crate) use name::upright;
pub use name::{Axis, Name, NameKind};
pub use record::{record, Differentiated, Record, Symbolic};
pub use style::Form;
