//! A stepper for callers that take the steps themselves: a notebook, a web page, or another analysis.

use super::failure::Failure;
use super::model_cache::ModelCache;
use super::motion_ode::MotionOde;
use super::motion_stepper::MotionStepper;
use super::option_checks::check_lengths;
use super::options::Options;
use super::redundant_rows::workspace_at;
use super::stabilizations::Stabilization;
use super::start_check::StartCheck;
use super::switch_schedule::Schedule;
use crate::analyses::State;
use crate::integrate::{Direction, Step};
use crate::math::ShortArray;
use crate::model::Model;

/// Advances a model by one accepted step at a time, by any method.
///
/// ```
/// # use kempe::{analyses::{dynamics, State}, integrate::Direction, model::Model};
/// # fn all(model: &Model, start: &State) -> Result<(), Box<dynamics::Failure>> {
/// let mut stepper = dynamics::Stepper::new(model, start, &dynamics::Options::new(1.0))?;
/// while !stepper.is_at_end() {
///     stepper.step()?;
///     if let Some(event) = stepper.locate(|_, [q, _, _]| q[0], Direction::Falling)? {
///         stepper.restart(&State { v: event.v.iter().map(|v| -v).collect(), ..event })?;
///     }
/// }
/// # Ok(())
/// # }
/// ```
pub struct Stepper<'a> {
    model: &'a Model,
    t_end: f64,
    /// The check of a state from which the stepper continues.
    check: StartCheck,
    inner: MotionStepper<'a>,
}

impl<'a> Stepper<'a> {
    /// Begins at a state and ends at `options.t_end`. Options of the output are ignored. The state must meet the
    /// constraints.
    ///
    /// # Errors
    /// [`Failure`]
    pub fn new(model: &'a Model, start: &State, options: &Options) -> Result<Self, Box<Failure>> {
        options.check(model, start)?;
        let t = options.t_start.unwrap_or(start.t);
        StartCheck::of_run(options).check(model, t, [&start.q, &start.v, &start.z])?;
        let schedule = Schedule::new(model, (t, options.t_end))?;
        let state = [&start.q[..], &start.v, &start.z];
        let workspace = workspace_at((model, &ModelCache::default()), t, state);
        let mut ode = MotionOde::new(model, options, workspace);
        let mut y = [&start.q[..], &start.v, &start.z].concat();
        y.resize(model.layout.n_y(), 0.0);
        let outcome = ode.begin_phase(t, &mut y, false, true);
        outcome.map_err(|breakdown| Failure::at_state(model, t, &start.q, breakdown))?;
        let inner = MotionStepper::new(ode, (options, None), schedule, t, &y)
            .map_err(|cause| Failure::of_integrator(model, cause, t, &y))?;
        let check = StartCheck::of_continuation(options);
        let projects = matches!(options.stabilization, Stabilization::Projection(_));
        let check = if projects { check.of_positions() } else { check };
        Ok(Self { model, t_end: options.t_end, check, inner })
    }

    /// Takes the next step; does nothing at the end.
    ///
    /// # Errors
    /// [`Failure`]; the stepper then stays at the last accepted state.
    pub fn step(&mut self) -> Result<(), Box<Failure>> {
        if self.is_at_end() {
            return Ok(());
        }
        self.inner.step().map_err(|cause| self.inner.failure(cause))
    }

    /// Whether t_end is reached.
    pub fn is_at_end(&self) -> bool {
        self.inner.t() == self.t_end
    }

    /// The current state.
    pub fn state(&self) -> State {
        self.to_state(self.inner.t(), self.inner.y())
    }

    /// Works up to the current state, J: dissipated energy, work of drivers, work of applied forces.
    pub fn works(&self) -> &[f64] {
        self.model.layout.split(self.inner.y())[3]
    }

    /// The state at a time within the last step; None outside this step. The state is not projected.
    ///
    /// # Errors
    /// The errors of [`step`](Self::step).
    pub fn interpolate(&mut self, t: f64) -> Result<Option<State>, Box<Failure>> {
        self.inner.prepare_interpolant().map_err(|cause| self.inner.failure(cause))?;
        let inside = |step: &Step<'_>| (t - step.t_old) * (t - step.t) <= 0.0;
        Ok(self.inner.last_step().filter(inside).map(|step| {
            let mut y = step.y.to_vec();
            if t != step.t {
                step.interpolate(t, &mut y);
            }
            self.to_state(t, &y)
        }))
    }

    /// The state within the last step at which g(t, [q, v, z]) changes sign; None if it has the same sign at both ends.
    ///
    /// # Errors
    /// The errors of [`step`](Self::step).
    pub fn locate(
        &mut self,
        g: impl Fn(f64, [&[f64]; 3]) -> f64,
        direction: Direction,
    ) -> Result<Option<State>, Box<Failure>> {
        let found = self.inner.locate(&g, direction).map_err(|cause| self.inner.failure(cause))?;
        Ok(found.map(|(t, y)| self.to_state(t, &y)))
    }

    /// Continues from another state, at a time within the last step or at its end, for instance with other velocities
    /// after an impact. The works continue from the last step. With projection, the velocities are replaced by the
    /// nearest velocities that meet the constraints, in the metric of the mass matrix.
    ///
    /// # Errors
    /// The errors of [`step`](Self::step).
    pub fn restart(&mut self, state: &State) -> Result<(), Box<Failure>> {
        check_lengths(self.model, state)?;
        self.check.check(self.model, state.t, [&state.q, &state.v, &state.z])?;
        let mut y = [&state.q[..], &state.v, &state.z].concat();
        let works = match self.interpolate(state.t)? {
            Some(_) => self.inner.works_at(state.t),
            None => self.works().to_vec(),
        };
        y.extend(works);
        let outcome = self.inner.ode.begin_phase(state.t, &mut y, false, false);
        outcome.map_err(|breakdown| Failure::at_state(self.model, state.t, &state.q, breakdown))?;
        self.inner.restart(state.t, &y).map_err(|cause| self.inner.failure(cause))
    }

    fn to_state(&self, t: f64, y: &[f64]) -> State {
        let [q, v, z, _] = self.model.layout.split(y).each(<[f64]>::to_vec);
        State { t, q, v, z }
    }
}
