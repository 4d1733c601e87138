//! Failures of an integration.

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
