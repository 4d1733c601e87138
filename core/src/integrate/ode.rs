//! Ordinary differential equations y′ = f(t, y), and optional properties that a method may use.

/// A system of ordinary differential equations y′ = f(t, y).
///
/// Only [`len`](Self::len) and [`rate`](Self::rate) are required. Each other method gives access to one optional
/// property of the system.
pub trait Ode {
    /// The error of the system; it is passed on unchanged.
    type Stop;

    /// Number of components of y.
    fn len(&self) -> usize;

    /// Whether y has no components.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// dy = f(t, y); both of length [`Ode::len`].
    ///
    /// # Errors
    /// Ends the integration at once. A trial state that is too far off should yield NaN instead: a method
    /// with step control then tries a shorter step.
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop>;

    /// The structure of y.
    fn structure(&self) -> Structure {
        Structure::first_order(self.len())
    }

    /// The manifold on which accepted states have to be.
    fn manifold(&mut self) -> Option<&mut dyn Manifold<Stop = Self::Stop>> {
        None
    }

    /// Times near which f is noise.
    fn times_to_avoid(&mut self) -> Option<&mut dyn TimesToAvoid> {
        None
    }

    /// Changes of f that depend on the step.
    fn trial_changes(&mut self) -> Option<&mut dyn TrialChanges> {
        None
    }
}

/// The structure of y = (q, v, z, w): positions with q′ = v, their rates, further states, and quadratures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// Number of components of q, and of v. A system of second order allows a cheaper interpolant.
    pub positions: usize,
    /// Number of further states z of first order.
    pub states: usize,
    /// Number of quadratures w. No derivative depends on them, and they do not enter the error norm.
    pub quadratures: usize,
}

impl Structure {
    /// A system of `n` equations of first order.
    pub fn first_order(n: usize) -> Self {
        Self { states: n, ..Self::default() }
    }

    /// Number of components that enter the error norm: q, v and z.
    pub fn controlled(&self) -> usize {
        2 * self.positions + self.states
    }

    /// Number of all components.
    pub fn total(&self) -> usize {
        self.controlled() + self.quadratures
    }
}

/// A manifold on which the states of an [`Ode`] have to be.
pub trait Manifold {
    /// As that of the system.
    type Stop;

    /// Projects an accepted state, near which f was evaluated last. Returns whether y changed; then the derivative
    /// there is evaluated by [`rate_projected`](Self::rate_projected), and the interpolant ends in the new y.
    ///
    /// # Errors
    /// The state is refused: a method with step control tries a shorter step, and stops with this error where
    /// none is short enough; a method with constant steps stops at once.
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<bool, Self::Stop>;

    /// dy = f(t, y) right after [`project`](Self::project) changed y, whose results it may use.
    ///
    /// # Errors
    /// As [`Ode::rate`].
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop>;

    /// Replaces a derivative at the last evaluated state by its tangent part, which [`project`](Self::project)
    /// leaves. Returns false if it is to count as a whole. Linear in `dy`. Used to test a rejected step again with
    /// the tangential error alone.
    fn project_error(&mut self, dy: &mut [f64]) -> bool {
        let _ = dy;
        false
    }
}

/// Times near which f is noise. A method with step control places its steps so that no stage is near one.
pub trait TimesToAvoid {
    /// Whether such a time may be near, by the evaluations of the trial under way. Then f is evaluated at the end
    /// of the trial as well, where the error estimate does not need it.
    fn may_be_near(&self) -> bool;

    /// The next such time, if one is in reach. Called after every trial step, accepted or not, with the time of
    /// its end, at or near which f was evaluated last.
    fn next(&mut self, t: f64) -> Option<f64>;

    /// Called with the end of every accepted step, where f was evaluated last.
    fn on_accepted_end(&mut self, t: f64);
}

/// Changes of f that depend on the step, such as gains that follow its length.
pub trait TrialChanges {
    /// Called before every trial step from y at t over h, which is negative when integrating backward. Returns
    /// whether f changed; then the derivative at the beginning is evaluated again.
    fn before_trial(&mut self, t: f64, y: &[f64], h: f64) -> bool;
}
