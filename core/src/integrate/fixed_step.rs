//! Steps of constant length: their ends, and a check of their number.

use super::arguments::{finite, positive, step_count, ROUNDING};
use super::failure::Cause;

/// The ends t0 + k step of the steps. They are computed by multiplication, so that errors do not accumulate; the last
/// is t_end.
pub(super) struct Grid {
    t0: f64,
    t_end: f64,
    /// The step, with the sign of the direction.
    step: f64,
    /// Number of steps.
    count: usize,
    /// Number of steps tried so far.
    taken: usize,
}

impl Grid {
    /// Checks `step` and the number of steps.
    pub fn new<E>(
        t0: f64,
        t_end: f64,
        step: f64,
        max_steps: Option<usize>,
    ) -> Result<Self, Cause<E>> {
        let interval = (t_end - t0).abs();
        positive("step", step)?;
        finite("step", step)?;
        affordable(interval, step, max_steps)?;
        let count = step_count(step, interval)?;
        Ok(Self { t0, t_end, step: step.copysign(t_end - t0), count, taken: 0 })
    }

    /// The end of the next step, which begins at `t`.
    pub fn next<E>(&mut self, t: f64) -> Result<f64, Cause<E>> {
        let k = self.taken + 1;
        let end = if k == self.count { self.t_end } else { self.t0 + k as f64 * self.step };
        if end == t {
            return Err(Cause::StepTooSmall { t, h: self.step.abs() });
        }
        self.taken = k;
        Ok(end)
    }
}

/// Returns an error if `max_steps` steps of at most `step` cannot cover the interval.
pub(super) fn affordable<E>(
    interval: f64,
    step: f64,
    max_steps: Option<usize>,
) -> Result<(), Cause<E>> {
    let needed = (interval / step * (1.0 - ROUNDING)).ceil();
    match max_steps {
        Some(most) if needed > most as f64 => Err(Cause::TooManySteps { needed, step, most }),
        _ => Ok(()),
    }
}
