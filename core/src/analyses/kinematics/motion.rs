//! The result of kinematics.

use crate::analyses::dynamics::{PiecewiseInterpolant, Trajectory};

/// A motion at chosen times.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// States, and works since the start. Without forces, as at a singular position, works are NaN.
    pub trajectory: Trajectory,
    /// Polynomials between the steps of the continuation.
    pub dense: PiecewiseInterpolant,
    /// Steps of the continuation.
    pub steps: usize,
    /// Steps that were taken again, shorter.
    pub rejected: usize,
    /// Whether the last time was reached; otherwise the observer stopped.
    pub reached: bool,
}
