//! The position quantities that formulas and elements may use by name.

use crate::elements::{Acted, Followed};
use crate::expression::Tape;

/// Quantities of points and elements that formulas may use by name.
pub trait Quantities {
    /// The formula of a position quantity, or of its rate if `rates` is set.
    fn formula(&self, name: &str, rates: bool) -> Option<Tape>;
    /// A position quantity with the bodies between which it is measured.
    fn followed(&self, name: &str) -> Option<Followed<Tape>>;
    /// The derivatives of a position quantity with respect to x, y and angle of its bodies i and j.
    fn gradient(&self, name: &str) -> Option<[[Tape; 3]; 2]>;
    /// A position quantity of an element or of a body, on which an effort acts.
    fn acted(&self, name: &str) -> Option<Acted<Tape>> {
        match self.followed(name)? {
            Followed::Coordinate(of) => Some(of.into()),
            of => Some(Acted { of, gradient: self.gradient(name)? }),
        }
    }
    /// The reason that a quantity exists but has no formula.
    fn refusal(&self, name: &str) -> Option<String>;
    /// The position quantities of a point or element; None if there is no such owner.
    fn offered(&self, owner: &str) -> Option<Vec<&'static str>>;
    /// Names for suggestions.
    fn names(&self, rates: bool) -> Vec<String>;
}
