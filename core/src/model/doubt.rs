//! Angles that look like degrees.
//!
//! Angles without a unit are in rad. A plain number of 10 or more with at most one decimal, such as 70 or 22.5, is
//! probably meant in degrees. A formula such as `4*pi` or a computed number such as 12.566370614359172 causes no
//! warning.

use super::definition::Value;

/// Least magnitude of a number that causes a warning, rad. One and a half turns are below it.
const LEAST: f64 = 10.0;

/// An angle that looks like degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// The path in a file, such as `start.set.crank.angle`.
    pub place: String,
    /// The number, rad.
    pub value: f64,
}

impl Doubt {
    /// The warning for a value as written. None if its unit is not rad, or if its value is plausible in rad.
    pub fn of(value: &Value, path: &[String], unit: &str) -> Option<Self> {
        let value = match value {
            Value::Number(x) => *x,
            Value::Text(text) => text.trim().parse().ok()?,
            _ => return None,
        };
        let short = (10.0 * value - (10.0 * value).round()).abs() < 1e-12 * value.abs();
        let doubted = unit == "rad" && value.is_finite() && value.abs() >= LEAST && short;
        doubted.then(|| Self { place: path.join("."), value })
    }
}
