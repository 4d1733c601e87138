//! The points of a table as they are written, and their checks.

use super::unit::{Dimension, Unit};
use crate::math::Interpolation;

pub(super) const SI: Unit =
    Unit { numerator: 1.0, denominator: 1.0, dimension: Dimension::new(0, 0, 0) };

/// The value of a table beyond its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// There is no value: a law that reads the table there has no value either.
    Refuse,
    /// The value at the nearest end.
    Hold,
    /// The tangent at the nearest end.
    Linear,
}

impl Outside {
    /// All, with their names in a file.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::Refuse, "refuse"), (Self::Hold, "hold"), (Self::Linear, "linear")];

    /// The value with this name in a file.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(_, known)| *known == name).map(|(outside, _)| outside)
    }
}

/// The remedy for a table that is read outside its range.
pub const TABLE_ENDS: &str =
    "give the table more points, make it periodic, or write outside = \"hold\" or \"linear\" in it";

/// The points of a table as they are written.
#[derive(Clone, Debug, PartialEq)]
pub struct Points<'a> {
    /// Places, increasing, in `x_unit`.
    pub x: &'a [f64],
    /// Values, in `y_unit`.
    pub y: &'a [f64],
    /// The unit of x; SI and rad if it is absent.
    pub x_unit: Option<&'a str>,
    /// The unit of y.
    pub y_unit: Option<&'a str>,
    /// The curve between the points.
    pub interpolation: Interpolation,
    /// Whether the curve repeats itself with the period `x[last] - x[0]`.
    pub periodic: bool,
    /// The value beyond the points.
    pub outside: Outside,
}

/// A fault of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError {
    /// The field at fault: x, y, x_unit or y_unit.
    pub field: &'static str,
    /// The index of the number at fault in the list.
    pub entry: Option<usize>,
    /// Description of the fault.
    pub message: String,
    /// Remedy.
    pub hint: Option<String>,
}

impl TableError {
    /// The error for points from which the curve cannot be computed in floating-point arithmetic.
    pub(super) fn steep(entry: usize) -> Self {
        let message = format!("the points beside x[{entry}] are too close or too far apart");
        let hint = "remove a point, or choose units in which the numbers are moderate";
        fault("x", entry, message, hint)
    }
}

/// Points in SI units, with the units in which they are written.
pub(super) struct Checked {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub units: [Option<Unit>; 2],
}

impl Points<'_> {
    /// The points in SI units. The values at the ends of a period may differ by at most `rounding` times the largest
    /// |y|.
    pub(super) fn check(&self, rounding: f64) -> Result<Checked, TableError> {
        let unit = |field, unit: Option<&str>| {
            let read = unit.map(Unit::parse).transpose();
            read.map_err(|e| TableError { field, entry: None, message: e.message, hint: e.hint })
        };
        let units = [unit("x_unit", self.x_unit)?, unit("y_unit", self.y_unit)?];
        checked(self)?;
        let x = scaled("x", self.x, units[0].unwrap_or(SI))?;
        increasing(self.x, &x)?;
        let mut y = scaled("y", self.y, units[1].unwrap_or(SI))?;
        if self.periodic {
            closed(self.y, &mut y, rounding)?;
        }
        Ok(Checked { x, y, units })
    }
}

fn fault(
    field: &'static str,
    entry: impl Into<Option<usize>>,
    message: String,
    hint: &str,
) -> TableError {
    TableError { field, entry: entry.into(), message, hint: Some(hint.to_string()) }
}

/// Checks that the lists determine a curve.
fn checked(points: &Points) -> Result<(), TableError> {
    let (x, y) = (points.x.len(), points.y.len());
    if x != y {
        let message = format!("{y} numbers, but x has {x}");
        return Err(fault("y", None, message, "give one y for each x"));
    }
    let least = points.interpolation.least(points.periodic);
    if x < least {
        let name = points.interpolation.name();
        let which = if points.periodic { format!("periodic {name}") } else { name.to_string() };
        let message = format!("{x} points; the interpolation {which} needs at least {least}");
        return Err(fault("x", None, message, "give more points, or choose another interpolation"));
    }
    for (field, numbers) in [("x", points.x), ("y", points.y)] {
        if let Some(entry) = numbers.iter().position(|x| !x.is_finite()) {
            let message =
                format!("{field}[{entry}] is {}; must be a finite number", numbers[entry]);
            return Err(fault(field, entry, message, "remove this point"));
        }
    }
    Ok(())
}

/// The numbers in SI units.
fn scaled(field: &'static str, numbers: &[f64], unit: Unit) -> Result<Vec<f64>, TableError> {
    let scaled = numbers.iter().enumerate().map(|(entry, x)| {
        unit.scale(*x).ok_or_else(|| {
            let message = format!("{field}[{entry}] = {x} is too large or too small in SI units");
            fault(field, entry, message, "choose another unit")
        })
    });
    scaled.collect()
}

/// Checks that the numbers x increase.
fn increasing(written: &[f64], x: &[f64]) -> Result<(), TableError> {
    let Some(k) = (1..x.len()).find(|k| x[*k] <= x[k - 1]) else { return Ok(()) };
    let (x, before) = (written[k], written[k - 1]);
    let message = format!("x[{k}] = {x} does not exceed x[{}] = {before}", k - 1);
    let hint = match x == before {
        true => "remove one of the two points",
        false => "sort the points by x",
    };
    Err(fault("x", k, message, hint))
}

/// Sets both ends of a period to the same value.
fn closed(written: &[f64], y: &mut [f64], rounding: f64) -> Result<(), TableError> {
    let last = y.len() - 1;
    let size = y.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    if (y[last] - y[0]).abs() > rounding * size {
        let message = format!(
            "y[{last}] = {} is not y[0] = {}, as a period needs",
            written[last], written[0]
        );
        let hint = "repeat the first y at the end of the period, or remove periodic";
        return Err(fault("y", last, message, hint));
    }
    y[last] = y[0];
    Ok(())
}
