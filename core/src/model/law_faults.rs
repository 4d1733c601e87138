//! Faults of names in laws.

use crate::expression::ExpressionError;

/// The remedy for a quantity without a formula.
pub(super) const WITHOUT_FORMULA: &str =
    "use a line or a circle as curve; conditions, measures and figures may use every gap";

/// The error for a quantity that has no formula. It replaces the error for an unknown name.
pub(super) fn without_formula(
    text: &str,
    fault: ExpressionError,
    refusal: impl Fn(&str) -> Option<String>,
) -> ExpressionError {
    let name = text.get(fault.span.clone()).unwrap_or("");
    let Some(message) = refusal(name) else { return fault };
    ExpressionError::new(fault.span, message).hint(WITHOUT_FORMULA.to_string())
}

/// The error for a name that is both a parameter and a quantity of the element.
pub(super) fn ambiguity(text: &str, name: &str, element: &str) -> ExpressionError {
    let message = format!("'{name}' is a parameter and a quantity of '{element}'");
    let hint = format!("rename the parameter, or write '{element}.{name}' for the quantity");
    ExpressionError::new(0..text.len(), message).hint(hint)
}
