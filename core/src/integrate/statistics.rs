//! Counts of an integration.

/// Counts of an integration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepCounts {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations of f. For an implicit method, evaluations of residuals and accelerations.
    pub evaluations: usize,
    /// Evaluations of the tangent; zero for an explicit method.
    pub jacobians: u32,
    /// Factorisations of matrices of Newton's iteration. A complex factorisation counts as one.
    pub factorisations: u32,
    /// Newton iterations.
    pub iterations: u32,
}

impl StepCounts {
    /// The sum of the counts of two integrations.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            rejected: self.rejected + other.rejected,
            evaluations: self.evaluations + other.evaluations,
            jacobians: self.jacobians + other.jacobians,
            factorisations: self.factorisations + other.factorisations,
            iterations: self.iterations + other.iterations,
        }
    }
}
