//! How an integration fails.

use super::statistics::Statistics;
use std::fmt;

/// Why an integration failed.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause<E> {
    /// An argument or option that cannot be right; nothing was evaluated.
    Argument {
        /// Name of the argument.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        must: &'static str,
    },
    /// The error test asks for a step below the spacing of numbers: a singularity or a stiff system.
    StepTooSmall {
        /// Where the step begins.
        t: f64,
        /// Size of the refused step.
        h: f64,
    },
    /// The derivative or the state is not finite, however short the step.
    NotFinite {
        /// Where.
        t: f64,
    },
    /// Newton's iteration does not converge, with a constant step or however short the step.
    Newton {
        /// Where the step begins.
        t: f64,
        /// Size of the step.
        h: f64,
    },
    /// The allowed number of steps was taken.
    MaxSteps {
        /// The number.
        steps: usize,
    },
    /// More steps than are allowed are needed, as their length is bounded; nothing was evaluated.
    TooManySteps {
        /// At least so many.
        needed: f64,
        /// Largest length of a step.
        step: f64,
        /// The allowed number.
        most: usize,
    },
    /// The system cannot go on.
    Equations(E),
}

/// A failed integration, with what was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure<E> {
    /// Why.
    pub cause: Cause<E>,
    /// Last accepted time.
    pub t: f64,
    /// State there.
    pub y: Box<[f64]>,
    /// Steps and evaluations up to the failure.
    pub statistics: Statistics,
}

impl<E: fmt::Display> fmt::Display for Failure<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.cause {
            Cause::Argument { name, value, must } => write!(f, "{name}: {value}; must be {must}"),
            Cause::StepTooSmall { t, h } => {
                write!(f, "step of {h:.1e} at t = {t} falls below the spacing of numbers")
            }
            Cause::NotFinite { t } => write!(f, "the derivative is not finite at t = {t}"),
            Cause::Newton { t, h } => {
                write!(f, "Newton's iteration does not converge at t = {t} with a step of {h:.1e}")
            }
            Cause::MaxSteps { steps } => write!(f, "{steps} steps taken at t = {}", self.t),
            Cause::TooManySteps { needed, step, most } => {
                write!(f, "{needed} steps of {step} are more than {most}")
            }
            Cause::Equations(stop) => stop.fmt(f),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> std::error::Error for Failure<E> {}
