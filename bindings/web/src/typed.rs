//! Numbers as a person writes them: plain, or with a unit.

use crate::fault::Fault;
use kempe::expression::unit::Unit;
use kempe::expression::{Expression, FormulaValues, Inferred};
use kempe::model::Value;

/// A number in SI units and rad. A text without a unit is in `unit`; one with a unit must be of the same dimension.
pub fn typed(value: &Value, what: &str, unit: &str) -> Result<f64, Fault> {
    let text = match value {
        Value::Number(x) => return Ok(x * factor(unit, what)?),
        Value::Text(text) => text,
        _ => return Err(Fault::new(format!("{what} must be a number"))),
    };
    let wrong = |reason: String| Fault::new(format!("{what}: '{text}': {reason}"));
    let none: &[String] = &[];
    let formula = Expression::parse(text).map_err(|error| wrong(error.to_string()))?;
    let found =
        formula.infer(none, &|_| Inferred::Open).map_err(|error| wrong(error.to_string()))?;
    let tape = formula.compile(none).map_err(|error| wrong(error.to_string()))?;
    let value = tape.evaluate(&FormulaValues::<f64> { parameters: &[], time: 0.0, variables: &[] });
    if !value.is_finite() {
        return Err(wrong("it is not a number".to_string()));
    }
    let Some(own) = found.unit().filter(|unit| unit != "1") else {
        return Ok(value * factor(unit, what)?);
    };
    let dimension = |unit: &str| Unit::parse(unit).map(|found| found.dimension).ok();
    if dimension(&own) != dimension(unit) {
        return Err(wrong(format!("it is in {own}; must be in {unit}")));
    }
    Ok(value)
}

/// The factor from a unit to its SI unit.
fn factor(unit: &str, what: &str) -> Result<f64, Fault> {
    if unit.is_empty() || unit == "1" {
        return Ok(1.0);
    }
    let found = Unit::parse(unit);
    found
        .map(|unit| unit.numerator / unit.denominator)
        .map_err(|_| Fault::new(format!("{what}: unknown unit '{unit}'")))
}
