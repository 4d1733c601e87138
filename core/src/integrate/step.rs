//! An accepted step.

use super::interpolant::Interpolant;

/// Whether an integration continues after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// The integration continues.
    Continue,
    /// The integration ends here; this is a normal outcome.
    Stop,
}

/// An accepted step from `t_old` to `t`. When integrating backward, `t` is the earlier time.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Time at the beginning.
    pub t_old: f64,
    /// Time at the end.
    pub t: f64,
    /// State at the beginning.
    pub y_old: &'a [f64],
    /// State at the end.
    pub y: &'a [f64],
    /// Derivative at the beginning.
    pub dy_old: &'a [f64],
    /// Derivative at the end.
    pub dy: &'a [f64],
    /// The state between the ends.
    pub interpolant: Interpolant<'a>,
}

impl Step<'_> {
    /// Computes the state at a `time` within the step into `out`, which has the length of y.
    #[inline]
    pub fn interpolate(&self, time: f64, out: &mut [f64]) {
        let (h, ahead) = (self.t - self.t_old, time - self.t_old);
        self.interpolant.evaluate(self.y_old, ahead, ahead / h, out);
    }

    /// Computes the coefficients b of y(θ) = y_old + h Σₖ bₖ θᵏ, k = 1…[`Interpolant::degree`], θ = (t - t_old) / h,
    /// into `out`, row-major (len of y) × degree.
    #[inline]
    pub fn coefficients(&self, out: &mut [f64]) {
        self.interpolant.coefficients(out);
    }
}
