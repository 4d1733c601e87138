//! The names that an expression may use, and their meaning.

use super::operation::FUNCTIONS;
use super::symbol::Symbol;
use super::table::Table;
use super::Tape;
use crate::math::Listed;
use std::sync::Arc;

/// The names that an expression at a place may use.
pub trait Names {
    /// The meaning of `name`: `"L1"`, `"t"`, `"crank.omega"`. Backticks are already removed.
    ///
    /// The result for `"t"` is `None` where the time has no meaning. `pi` and `deg` are never passed to this
    /// function.
    fn resolve(&self, name: &str) -> Option<Symbol>;

    /// The formula that `name` abbreviates, if it is not a symbol: `"slide.displacement"`.
    fn formula(&self, name: &str) -> Option<Tape> {
        let _ = name;
        None
    }

    /// Every name that [`resolve`](Names::resolve) or [`formula`](Names::formula) accepts, for suggestions.
    fn known(&self) -> Vec<String>;

    /// The tables that an expression may call.
    fn tables(&self) -> &[Arc<Table>] {
        &[]
    }
}

/// A list of names is a list of parameters.
impl<T: AsRef<str>> Names for [T] {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        self.iter().position(|known| known.as_ref() == name).map(Symbol::Parameter)
    }
    fn known(&self) -> Vec<String> {
        self.iter().map(|name| name.as_ref().to_string()).list()
    }
}

impl<T: AsRef<str>, const N: usize> Names for [T; N] {
    fn resolve(&self, name: &str) -> Option<Symbol> {
        self.as_slice().resolve(name)
    }
    fn known(&self) -> Vec<String> {
        self.as_slice().known()
    }
}

/// The value of a constant of the language: `pi`, and `deg` = π/180.
pub(super) fn constant(name: &str) -> Option<f64> {
    match name {
        "pi" => Some(std::f64::consts::PI),
        "deg" => Some(std::f64::consts::PI / 180.0),
        _ => None,
    }
}

/// Whether a name is reserved: `t pi deg ground` and the functions.
pub fn is_reserved(name: &str) -> bool {
    matches!(name, "t" | "pi" | "deg" | "ground") || FUNCTIONS.iter().any(|f| f.name == name)
}

/// Whether an expression may use the name without backticks: `[A-Za-z_][A-Za-z0-9_]*`.
pub fn is_identifier(name: &str) -> bool {
    name.starts_with(is_name_start) && name.chars().all(is_name_part)
}

pub(super) fn is_name_start(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

pub(super) fn is_name_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}
