//! Failures of an integration.

use super::statistics::Statistics;
use std::fmt;

/// The cause of a failure.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause<E> {
    /// An argument or option with an impossible value; nothing was evaluated.
    Argument {
        /// Name of the argument.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The condition on it.
        must: &'static str,
    },
    /// The error test needs a step below the spacing of numbers: a singularity or a stiff system.
    StepTooSmall {
        /// Time at which the step begins.
        t: f64,
        /// Size of the refused step.
        h: f64,
    },
    /// The derivative or the state is not finite, for steps of any length.
    NotFinite {
        /// Time.
        t: f64,
    },
    /// Newton's iteration does not converge with a constant step, or with steps of any length.
    Newton {
        /// Time at which the step begins.
        t: f64,
        /// Size of the step.
        h: f64,
    },
    /// The allowed number of steps was taken.
    MaxSteps {
        /// The number.
        steps: usize,
    },
    /// Steps of the largest allowed length need more steps than allowed; nothing was evaluated.
    TooManySteps {
        /// Least number of steps needed.
        needed: f64,
        /// Largest length of a step.
        step: f64,
        /// The allowed number.
        most: usize,
    },
    /// An error of the system.
    Equations {
        /// Time of the evaluation.
        t: f64,
        /// The error.
        error: E,
    },
}

/// A failed integration, with the time and state reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure<E> {
    /// The cause.
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
            Cause::Equations { error, .. } => error.fmt(f),
        }
    }
}

impl<E: fmt::Debug + fmt::Display> std::error::Error for Failure<E> {}
