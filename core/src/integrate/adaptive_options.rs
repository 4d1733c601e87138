//! Options that every embedded pair has.

use super::arguments::{check_problem, not_negative, positive, refusal, Refused};
use super::failure::Cause;
use super::fixed_step::{affordable, Grid};

/// Absolute tolerance: one for all components, or one each (for the controlled ones at least).
#[derive(Clone, Debug, PartialEq)]
pub enum Atol {
    /// The same for every component.
    Scalar(f64),
    /// One for each controlled component.
    Each(Vec<f64>),
}

/// Options every pair has.
pub(super) struct Options<'a> {
    /// Relative tolerance, as it is used.
    pub rtol: f64,
    pub atol: &'a Atol,
    /// Constant step, which no tolerance changes.
    pub step: Option<f64>,
    pub max_step: f64,
    pub first_step: Option<f64>,
    pub max_steps: Option<usize>,
}

impl Options<'_> {
    /// Refuses what cannot be right in them, in the times and in `y`, which must be `len` long; the ends
    /// of constant steps, if they are.
    pub fn begin<E>(
        &self,
        (t0, t_end): (f64, f64),
        (y, len): (&[f64], usize),
        controlled: usize,
    ) -> Result<Option<Grid>, Cause<E>> {
        check_problem(t0, t_end, y, len)
            .and_then(|()| self.check(controlled, (t_end - t0).abs()))
            .map_err(refusal)?;
        self.grid(t0, t_end)
    }

    fn check(&self, controlled: usize, interval: f64) -> Result<(), Refused> {
        not_negative("rtol", self.rtol)?;
        match self.atol {
            Atol::Scalar(atol) => not_negative("atol", *atol)?,
            Atol::Each(atol) => {
                if atol.len() != controlled {
                    return Err(("atol", atol.len() as f64, "one for each controlled component"));
                }
                atol.iter().try_for_each(|&a| not_negative("atol", a))?;
            }
        }
        positive("max_step", self.max_step)?;
        if self.step.is_some() {
            return self.check_constant();
        }
        if let Some(h) = self.first_step {
            positive("first_step", h)?;
            if h > interval && interval > 0.0 {
                return Err(("first_step", h, "at most |t_end - t0|"));
            }
        }
        Ok(())
    }

    /// A constant step leaves nothing to choose.
    fn check_constant(&self) -> Result<(), Refused> {
        const ABSENT: &str = "absent beside a constant step";
        match self.first_step {
            Some(h) => Err(("first_step", h, ABSENT)),
            None if self.max_step < f64::INFINITY => Err(("max_step", self.max_step, ABSENT)),
            None => Ok(()),
        }
    }

    /// Refused where the end cannot be reached in `max_steps`.
    fn grid<E>(&self, t0: f64, t_end: f64) -> Result<Option<Grid>, Cause<E>> {
        match self.step {
            Some(step) => Grid::new(t0, t_end, step, self.max_steps).map(Some),
            None => affordable((t_end - t0).abs(), self.max_step, self.max_steps).map(|()| None),
        }
    }
}

/// Smallest relative tolerance in use: below it, rounding is all that is estimated.
const MIN_RTOL: f64 = 100.0 * f64::EPSILON;

/// `rtol`, or 100 ε if that is larger; what is no tolerance is left to be refused.
pub(super) fn usable_rtol(rtol: f64) -> f64 {
    if (0.0..MIN_RTOL).contains(&rtol) {
        MIN_RTOL
    } else {
        rtol
    }
}
