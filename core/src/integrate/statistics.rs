//! Counts of an integration, and how it ended.

/// How an integration that did not fail ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// At t_end.
    Reached,
    /// By the observer.
    Stopped,
}

/// Counts of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations of f; for an implicit method, of residuals and accelerations.
    pub evaluations: usize,
    /// Tangents; zero for an explicit method.
    pub jacobians: u32,
    /// Factorisations of matrices of Newton's iteration, a complex one as one.
    pub factorisations: u32,
    /// Steps of Newton's iteration.
    pub iterations: u32,
    /// How it ended; of a failure, not meaningful beyond "not at t_end".
    pub ended: Ended,
    /// Time reached.
    pub t: f64,
}

impl Statistics {
    /// Before the first step.
    pub(crate) fn none(t: f64) -> Self {
        Self {
            steps: 0,
            rejected: 0,
            evaluations: 0,
            jacobians: 0,
            factorisations: 0,
            iterations: 0,
            ended: Ended::Stopped,
            t,
        }
    }
}
