//! What a system, an observer and a method promise each other.

use super::failure::Failure;
use super::interpolant::Interpolant;

/// A first-order system y′ = f(t, y).
pub trait Ode {
    /// Why the system cannot go on; passed through untouched.
    type Stop;

    /// Number of components of y.
    fn len(&self) -> usize;

    /// Whether y has no components.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How many components, from the first, enter the error norm; the others are quadratures, carried
    /// along without influence on the steps.
    fn controlled(&self) -> usize {
        self.len()
    }

    /// How many components, from the first, are positions of a system of second order: their derivatives are
    /// the next as many components, and the rest are quadratures, on which no derivative depends. Then the
    /// continuous extension may cost less. 0 for any other system.
    fn positions(&self) -> usize {
        0
    }

    /// dy = f(t, y); both of length [`Ode::len`].
    ///
    /// # Errors
    /// Ends the integration at once. A trial state that is merely too far off should yield NaN
    /// instead: an adaptive method then tries a shorter step.
    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop>;

    /// Called before every step that is tried, from y at t over h, which is negative when integrating
    /// backward. May change f for the step, as gains that follow it do, and then returns true: the
    /// derivative at its beginning is evaluated afresh.
    fn before_trial(&mut self, t: f64, y: &[f64], h: f64) -> bool {
        let _ = (t, y, h);
        false
    }

    /// Called with every state whose error is accepted, near which f was evaluated last. May change y
    /// (projection onto a manifold) and then returns true: the derivative there is that of the changed y,
    /// and the continuous extension of the step ends in it.
    ///
    /// # Errors
    /// The state is refused: a method with step control tries a shorter step, and stops with this
    /// where none is short enough; one with constant steps stops at once.
    fn project_accepted(&mut self, t: f64, y: &mut [f64]) -> Result<bool, Self::Stop> {
        let _ = (t, y);
        Ok(false)
    }

    /// The same as [`rate`](Self::rate) right after [`accepted`](Self::project_accepted) has changed y: what the system
    /// then knows of y it need not find again.
    ///
    /// # Errors
    /// As there.
    fn rate_projected(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Self::Stop> {
        self.rate(t, y, dy)
    }

    /// Called by methods with step control where a step stands, before the observer sees it; f was
    /// evaluated last in its end.
    fn on_accepted_end(&mut self, t: f64) {
        let _ = t;
    }

    /// Of a derivative at the last evaluated state, leaves the part that [`accepted`](Self::project_accepted)
    /// would not take away; false if it takes nothing. Linear in `dy`. By it a step is judged that the
    /// whole error estimate refuses.
    fn project_error(&mut self, dy: &mut [f64]) -> bool {
        let _ = dy;
        false
    }

    /// Whether an obstacle may be near, by the evaluations of the trial under way: then f is evaluated in the
    /// very end of it too, which the error of a method may do without.
    fn near_time_to_avoid(&self) -> bool {
        false
    }

    /// Called after every trial step, whether it will be accepted or not, with the time of its end, at
    /// which f was evaluated last, near the end if not in it. A time near which f is little but noise: a method with step control
    /// places its steps so that no stage comes near it.
    fn time_to_avoid(&mut self, t: f64) -> Option<f64> {
        let _ = t;
        None
    }
}

/// Whether to go on after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// End here; a normal outcome.
    Stop,
}

/// Sees every accepted step.
pub trait Observer {
    /// Takes what it needs from the step; nothing of it outlives the call.
    fn step(&mut self, step: &Step<'_>) -> Flow;

    /// Whether it will look between the ends of a step that it is about to be shown. If not, a scheme may
    /// spare what only its continuous extension needs, which then is of lesser order.
    fn looks_inside(&self, t_old: f64, t: f64) -> bool {
        let _ = (t_old, t);
        true
    }
}

impl<F: FnMut(&Step<'_>) -> Flow> Observer for F {
    fn step(&mut self, step: &Step<'_>) -> Flow {
        self(step)
    }
}

/// An accepted step, from `t_old` to `t` (which is earlier when integrating backward).
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
    /// The continuous extension.
    pub interpolant: Interpolant<'a>,
}

impl Step<'_> {
    /// The state at a `time` within the step, into `out` (length of y).
    pub fn interpolate(&self, time: f64, out: &mut [f64]) {
        let (h, ahead) = (self.t - self.t_old, time - self.t_old);
        self.interpolant.evaluate(self.y_old, ahead, ahead / h, out);
    }

    /// Coefficients b of y(θ) = y_old + h Σₖ bₖ θᵏ, k = 1…[`Interpolant::degree`], θ = (t - t_old) / h: into
    /// `out`, row-major (len of y) × degree.
    pub fn coefficients(&self, out: &mut [f64]) {
        self.interpolant.coefficients(out);
    }
}

/// How an integration that did not fail ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// At t_end.
    Reached,
    /// By the observer.
    Stopped,
}

/// What an integration took.
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

/// A scheme with its options.
pub trait Method {
    /// Integrates from `t0` to `t_end`, forward or backward, in place: `y` holds the state at `t0` and
    /// afterwards the last accepted one, of a failure too. With `t_end == t0` nothing is evaluated.
    ///
    /// # Errors
    /// [`Failure`], with the time and the state reached.
    fn integrate<Y: Ode, O: Observer>(
        &self,
        system: &mut Y,
        t0: f64,
        t_end: f64,
        y: &mut [f64],
        observer: &mut O,
    ) -> Result<Statistics, Failure<Y::Stop>>;
}
