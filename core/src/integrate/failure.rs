//! Failures of an integration.

/// The cause of a failure.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause<E> {
    /// An argument or option has an impossible value. Nothing was evaluated.
    Argument {
        /// Name of the argument.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The condition that the value must satisfy.
        must: &'static str,
    },
    /// The error test requires a step below the floating-point spacing of t, because of a singularity or a stiff
    /// system.
    StepTooSmall {
        /// Time at which the step begins.
        t: f64,
        /// Size of the rejected step.
        h: f64,
    },
    /// The derivative or the state is not finite for any step size.
    NotFinite {
        /// Time.
        t: f64,
    },
    /// Newton's iteration does not converge with the constant step, or with any step size.
    Newton {
        /// Time at which the step begins.
        t: f64,
        /// Size of the step.
        h: f64,
    },
    /// The allowed number of steps was reached.
    MaxSteps {
        /// The number of steps.
        steps: usize,
    },
    /// The integration needs more steps of the largest allowed length than allowed. Nothing was evaluated.
    TooManySteps {
        /// Smallest number of steps needed.
        needed: f64,
        /// Largest length of a step.
        step: f64,
        /// The allowed number of steps.
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
