//! Comparison of the dimension of a formula with the required dimension.

use crate::expression::unit::Unit;
use crate::expression::{Expression, ExpressionError, Inferred};

/// The unit of a formula that is composed of checked formulas.
pub(crate) const ANY_UNIT: &str = "any";

/// Checks that a formula with a known dimension has the required dimension. If the field has no unit, it requires a
/// number.
pub(super) fn check_unit(
    e: &Expression,
    inferred: Inferred,
    unit: &str,
) -> Result<(), ExpressionError> {
    let Inferred::Of(dimension) = inferred else { return Ok(()) };
    let place = if unit.is_empty() { "rad" } else { unit };
    let wanted = Unit::parse(place).map(|unit| unit.dimension);
    if unit == ANY_UNIT || wanted.as_ref() == Ok(&dimension) {
        return Ok(());
    }
    let must = match wanted {
        _ if unit.is_empty() => "a number".to_string(),
        Ok(wanted) if place != wanted.to_string() && place != "rad" => {
            format!("in {unit} ({wanted})")
        }
        _ => format!("in {unit}"),
    };
    let text = e.text().trim();
    let message = format!("'{text}' is in {inferred}; must be {must}");
    let hint = e.dimension().is_none().then(|| {
        let example = if unit.is_empty() { "2" } else { &format!("\"2 {unit}\"") };
        format!("use parameters of that dimension, such as {example}; a plain number in a product has none")
    });
    Err(ExpressionError::new(0..e.text().len(), message).hint(hint))
}
