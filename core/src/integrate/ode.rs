//! Ordinary differential equations y′ = f(t, y), and optional properties that a method may use.

/// A system of ordinary differential equations y′ = f(t, y).
///
/// Only [`len`](Self::len) and [`rate`](Self::rate) are required. Each other method gives access to one optional
/// property of the system.
pub trait Ode {
    /// Error of the system, passed on unchanged.
    type Stop;

    /// Number of components of y.
    fn len(&self) -> usize;

    /// Whether y has no components.
    #[inline]
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// dy = f(t, y). Both y and dy have the length [`Ode::len`].
    ///
    /// # Errors
    /// An error ends the integration at once. For a trial state outside the domain of f, return NaN instead: a method
    /// with step control then tries a shorter step.
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop>;

    /// The structure of y.
    #[inline]
    fn structure(&self) -> Structure {
        Structure::first_order(self.len())
    }

    /// The magnitude of the quadratures to which their errors are relative, after the evaluations of a trial step
    /// that ends in `y`. None if the quadratures are as smooth as the other components: their errors then need no
    /// test of their own.
    #[inline]
    fn quadrature_scale(&self, y: &[f64]) -> Option<f64> {
        let _ = y;
        None
    }

    /// The manifold on which accepted states must lie.
    #[inline]
    fn manifold(&mut self) -> Option<&mut dyn Manifold<Stop = Self::Stop>> {
        None
    }

    /// Times near which noise dominates f.
    #[inline]
    fn times_to_avoid(&mut self) -> Option<&mut dyn TimesToAvoid> {
        None
    }

    /// Changes of f that depend on the step.
    #[inline]
    fn trial_changes(&mut self) -> Option<&mut dyn TrialChanges> {
        None
    }
}

/// The structure of y = (q, v, z, w): positions q with q′ = v, their rates v, further states z, and quadratures w.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Structure {
    /// Number of components of q, and of v. A system of second order allows a cheaper interpolant.
    pub positions: usize,
    /// Number of further first-order states z.
    pub states: usize,
    /// Number of quadratures w. No derivative depends on them. They enter the error test only where the system has
    /// a [scale](Ode::quadrature_scale) for them.
    pub quadratures: usize,
}

impl Structure {
    /// The structure of `n` first-order equations.
    #[inline]
    pub fn first_order(n: usize) -> Self {
        Self { states: n, ..Self::default() }
    }

    /// Number of components that enter the error norm: q, v and z.
    #[inline]
    pub fn controlled(&self) -> usize {
        2 * self.positions + self.states
    }

    /// Number of all components.
    #[inline]
    pub fn total(&self) -> usize {
        self.controlled() + self.quadratures
    }
}

/// A manifold on which the states of an [`Ode`] must lie.
pub trait Manifold {
    /// Error of the system, as [`Ode::Stop`].
    type Stop;

    /// Projects an accepted state, near which f was evaluated last. Returns whether y changed. If it did, the
    /// derivative is evaluated by [`rate_projected`](Self::rate_projected), and the interpolant ends in the new y.
    ///
    /// # Errors
    /// An error refuses the state. A method with step control then tries shorter steps, and ends with this error if
    /// no step is short enough. A method with constant steps ends at once.
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<bool, Self::Stop>;

    /// dy = f(t, y) immediately after [`project`](Self::project) changed y. It may use results of the projection.
    ///
    /// # Errors
    /// As [`Ode::rate`].
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop>;

    /// Replaces a derivative at the last evaluated state by its tangential component, which
    /// [`project`](Self::project) does not remove. Linear in `dy`. Returns false if the whole derivative counts as
    /// error. A rejected step is tested again with the tangential error alone.
    #[inline]
    fn project_error(&mut self, dy: &mut [f64]) -> bool {
        let _ = dy;
        false
    }
}

/// Times near which noise dominates f. A method with step control places its steps so that no stage is near such a
/// time.
pub trait TimesToAvoid {
    /// Whether such a time may be near, according to the evaluations of the current trial. If so, f is also evaluated
    /// at the end of the trial, even if the error estimate does not need this evaluation.
    fn may_be_near(&self) -> bool;

    /// The next such time, if one is within reach. Called after every trial step, accepted or not. `t` is the end of
    /// the trial; f was evaluated last at or near it.
    fn next(&mut self, t: f64) -> Option<f64>;

    /// Called at the end of every accepted step, where f was evaluated last.
    fn on_accepted_end(&mut self, t: f64);
}

/// Changes of f that depend on the step, such as gains that depend on the step size.
pub trait TrialChanges {
    /// Called before every trial step of length h from y at t. h is negative when integrating backward. Returns
    /// whether f changed. If it did, the derivative at the beginning is evaluated again.
    fn before_trial(&mut self, t: f64, y: &[f64], h: f64) -> bool;
}
