//! Checks of the arguments before the first evaluation.

use super::failure::Cause;

/// Largest number of steps for which neighbouring times t0 + k step still differ.
const MOST_STEPS: f64 = 1e15;
/// A remainder of the interval below this part of it is rounding, not a step.
pub(super) const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A refused argument: its name, its value, and the condition on it.
pub(super) type Refused = (&'static str, f64, &'static str);

pub(super) fn refusal<E>((name, value, must): Refused) -> Cause<E> {
    Cause::Argument { name, value, must }
}

/// Times and initial state.
pub(super) fn check_problem(t0: f64, t_end: f64, y: &[f64], len: usize) -> Result<(), Refused> {
    finite("t0", t0)?;
    finite("t_end", t_end)?;
    finite("t_end - t0", t_end - t0)?;
    if y.len() != len {
        return Err(("y0", y.len() as f64, "as long as the system"));
    }
    y.iter().try_for_each(|&value| finite("y0", value))
}

pub(super) fn finite(name: &'static str, value: f64) -> Result<(), Refused> {
    if value.is_finite() {
        Ok(())
    } else {
        Err((name, value, "finite"))
    }
}

/// Infinity is positive; NaN is not.
pub(super) fn positive(name: &'static str, value: f64) -> Result<(), Refused> {
    if value > 0.0 {
        Ok(())
    } else {
        Err((name, value, "> 0"))
    }
}

pub(super) fn not_negative(name: &'static str, value: f64) -> Result<(), Refused> {
    finite(name, value)?;
    if value >= 0.0 {
        Ok(())
    } else {
        Err((name, value, ">= 0"))
    }
}

/// Number of constant steps over an interval; a remainder of rounding does not count.
pub(super) fn step_count(step: f64, interval: f64) -> Result<usize, Refused> {
    positive("step", step)?;
    finite("step", step)?;
    let ratio = interval / step;
    if ratio > MOST_STEPS {
        return Err(("step", step, "at least 1e-15 of |t_end - t0|"));
    }
    Ok((ratio * (1.0 - ROUNDING)).ceil() as usize)
}
