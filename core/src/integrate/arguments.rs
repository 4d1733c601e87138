//! Checks of the arguments before the first evaluation.

use super::failure::Cause;

/// Largest number of steps for which the neighbouring times t0 + k step still differ.
const MOST_STEPS: f64 = 1e15;
/// A remainder of the interval below this fraction of the interval is a rounding error and requires no step.
pub(super) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Returns an error with the name, the value and the condition `must` if the condition does not hold.
pub(super) fn require<E>(
    holds: bool,
    name: &'static str,
    value: f64,
    must: &'static str,
) -> Result<(), Cause<E>> {
    match holds {
        true => Ok(()),
        false => Err(Cause::Argument { name, value, must }),
    }
}

/// Checks the times and the initial state.
pub(super) fn check_problem<E>(t0: f64, t_end: f64, y: &[f64], len: usize) -> Result<(), Cause<E>> {
    finite("t0", t0)?;
    finite("t_end", t_end)?;
    finite("t_end - t0", t_end - t0)?;
    require(y.len() == len, "y0", y.len() as f64, "as long as the system")?;
    y.iter().try_for_each(|&value| finite("y0", value))
}

pub(super) fn finite<E>(name: &'static str, value: f64) -> Result<(), Cause<E>> {
    require(value.is_finite(), name, value, "finite")
}

/// Infinity is positive; NaN is not.
pub(super) fn positive<E>(name: &'static str, value: f64) -> Result<(), Cause<E>> {
    require(value > 0.0, name, value, "> 0")
}

pub(super) fn not_negative<E>(name: &'static str, value: f64) -> Result<(), Cause<E>> {
    finite(name, value)?;
    require(value >= 0.0, name, value, ">= 0")
}

/// Number of constant steps over an interval. A remainder that is a rounding error requires no further step.
pub(super) fn step_count<E>(step: f64, interval: f64) -> Result<usize, Cause<E>> {
    let ratio = interval / step;
    require(ratio <= MOST_STEPS, "step", step, "at least 1e-15 of |t_end - t0|")?;
    Ok((ratio * (1.0 - ROUNDING)).ceil() as usize)
}
