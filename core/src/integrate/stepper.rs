//! Steppers advance an initial value problem by one accepted step at a time.
//!
//! A method ([`ExplicitMethod`], [`ImplicitMethod`]) starts a [`Stepper`] for a system `Y`, which is passed to each
//! call.

use super::dae::Dae;
use super::events::{self, Direction};
use super::failure::Cause;
use super::lane_steps::SideBySide;
use super::ode::Ode;
use super::statistics::StepCounts;
use super::step::Step;

/// Advances a system `Y` with the error type `E` by one accepted step at a time.
pub trait Stepper<Y: ?Sized, E> {
    /// Takes the next step, which ends at t_end at the latest.
    ///
    /// # Errors
    /// [`Cause`]. The stepper then remains at the last accepted state.
    ///
    /// # Panics
    /// At t_end.
    fn step(&mut self, system: &mut Y) -> Result<(), Cause<E>>;

    /// Performs the evaluations that only the interpolant of the last step needs. Without this call the interpolant
    /// has a lower order. It must be called before the next step.
    ///
    /// # Errors
    /// [`Cause::Equations`].
    fn prepare_interpolant(&mut self, system: &mut Y) -> Result<(), Cause<E>>;

    /// The last accepted step. None before the first step and after a restart.
    fn last_step(&self) -> Option<Step<'_>>;

    /// Time reached.
    fn t(&self) -> f64;

    /// Time at which the steps end.
    fn t_end(&self) -> f64;

    /// State reached.
    fn y(&self) -> &[f64];

    /// The size of the next trial step, if the error control has chosen one.
    fn next_size(&self) -> Option<f64> {
        None
    }

    /// Continues from a state `y` at a time `t` within the last step, for instance after an event that changes the
    /// velocities. The solution then has two states at this time: the end of the last step and `y`.
    ///
    /// # Errors
    /// [`Cause::Argument`].
    #[inline]
    fn restart(&mut self, t: f64, y: &[f64]) -> Result<(), Cause<E>> {
        self.restart_until(t, y, self.t_end())
    }

    /// Continues from another state with a new end time.
    ///
    /// # Errors
    /// As [`restart`](Self::restart).
    fn restart_until(&mut self, t: f64, y: &[f64], t_end: f64) -> Result<(), Cause<E>>;

    /// Counts of all steps so far.
    fn statistics(&self) -> StepCounts;

    /// The stepper for steps [in parallel with others](super::LaneSteps), if its method supports them.
    #[inline]
    fn side_by_side(&mut self) -> Option<&mut dyn SideBySide> {
        None
    }

    /// Time within the last step at which g(t, y) changes sign, with the state at this time; see
    /// [`locate`](fn@super::locate). None if g does not change sign in the given direction.
    ///
    /// # Errors
    /// As [`prepare_interpolant`](Self::prepare_interpolant).
    fn locate(
        &mut self,
        system: &mut Y,
        g: &mut dyn FnMut(f64, &[f64]) -> f64,
        direction: Direction,
        tolerance: f64,
    ) -> Result<Option<(f64, Vec<f64>)>, Cause<E>> {
        let changes = |step: Step<'_>| events::changes_sign(&step, &mut *g, direction);
        if !self.last_step().is_some_and(changes) {
            return Ok(None);
        }
        self.prepare_interpolant(system)?;
        let Some(step) = self.last_step() else { return Ok(None) };
        let mut y = step.y.to_vec();
        let t = events::locate(&step, &mut y, g, direction, tolerance);
        Ok(t.map(|t| (t, y)))
    }
}

/// A stepper of a system `Y` with the error type `E`.
pub type BoxedStepper<Y, E> = Box<dyn Stepper<Y, E>>;

/// An explicit method with its options.
pub trait ExplicitMethod {
    /// Returns a stepper from `y` at `t0` to `t_end`, forward or backward. Evaluates nothing.
    ///
    /// # Errors
    /// [`Cause::Argument`] and [`Cause::TooManySteps`].
    fn start<Y: Ode>(
        &self,
        system: &Y,
        span: (f64, f64),
        y: &[f64],
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>>;
}

/// An implicit method with its options.
pub trait ImplicitMethod {
    /// As [`ExplicitMethod::start`], with `y` = (q, v, z, quadratures).
    ///
    /// # Errors
    /// As [`ExplicitMethod::start`].
    fn start<Y: Dae + ?Sized>(
        &self,
        system: &Y,
        span: (f64, f64),
        y: &[f64],
    ) -> Result<BoxedStepper<Y, Y::Stop>, Cause<Y::Stop>>;
}
