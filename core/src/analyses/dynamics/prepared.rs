//! A model prepared for many runs. The first run computes the data that runs share.

use super::accelerations::accelerations;
use super::accelerations::Accelerations;
use super::clock::{system_clock, Clock};
use super::course::{self, Act};
use super::energies::energies;
use super::failure::Failure;
use super::interpolated_states;
use super::model_cache::ModelCache;
use super::options::Options;
use super::run_results::Run;
use super::trajectory::States;
use super::wide::Wide;
use crate::analyses::{second_order, State};
use crate::integrate::Flow;
use crate::math::{Lanes, Listed};
use crate::model::Model;
use crate::stabilize::Projection;
use std::borrow::Cow;
use std::ops::Deref;

/// Regularity of a position below which equations may hold only to second order.
const DOUBTFUL: f64 = 1e-4;

/// A model and the data that its runs share: the elimination plan, and the model over lanes once a run needs it.
///
/// It borrows the model or, as `Prepared<Arc<Model>>`, contains it. Threads may share it; the results of a run do not
/// depend on earlier runs.
///
/// ```
/// # use kempe::{analyses::{dynamics, State}, integrate::Flow, model::Model};
/// # fn all(model: &Model, starts: &[State]) -> Result<(), Box<dynamics::Failure>> {
/// let prepared = dynamics::Prepared::new(model);
/// for start in starts {
///     let run = prepared.dynamics(start, &dynamics::Options::new(0.1), |_| Flow::Continue)?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Prepared<M> {
    model: M,
    cache: ModelCache,
    clock: Clock,
}

impl<M: Deref<Target = Model>> Prepared<M> {
    /// Prepares a model; the data is computed at first use.
    pub fn new(model: M) -> Self {
        Self { model, cache: ModelCache::default(), clock: system_clock }
    }

    /// Takes the wall time of runs from another clock.
    pub fn with_clock(self, clock: Clock) -> Self {
        Self { clock, ..self }
    }

    /// The model.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// The data that its runs share.
    pub(super) fn cache(&self) -> &ModelCache {
        &self.cache
    }

    /// The model over lanes, if there are enough states for it.
    pub(in crate::analyses) fn wide_for(&self, count: usize) -> Option<&Model<Lanes>> {
        self.cache.wide(&self.model, count).map(Wide::model)
    }

    /// Integrates the equations of motion from `start` to `options.t_end`, as [`dynamics`](super::dynamics) does.
    ///
    /// # Errors
    /// [`Failure`], with everything computed so far.
    pub fn dynamics(
        &self,
        start: &State,
        options: &Options,
        watch: impl FnMut(f64) -> Flow,
    ) -> Result<Run, Box<Failure>> {
        self.run(start, options, watch, None)
    }

    /// Integrates the equations of motion; `act` is called at each event that
    /// [acts](crate::analyses::EventOption::acts).
    ///
    /// # Errors
    /// The errors of [`dynamics`](Self::dynamics), and a change that does not meet the constraints.
    pub fn dynamics_with(
        &self,
        start: &State,
        options: &Options,
        watch: impl FnMut(f64) -> Flow,
        act: Act<'_>,
    ) -> Result<Run, Box<Failure>> {
        self.run(start, options, watch, Some(act))
    }

    fn run(
        &self,
        start: &State,
        options: &Options,
        watch: impl FnMut(f64) -> Flow,
        act: Option<Act<'_>>,
    ) -> Result<Run, Box<Failure>> {
        let own = second_order::acting(&self.model, start.t, &start.q);
        let own = own.map(|model| (model, ModelCache::default()));
        let base = own.as_ref().map_or((&*self.model, &self.cache), |(model, own)| (model, own));
        let limited = match base.0.limited() {
            Cow::Borrowed(_) => None,
            Cow::Owned(model) => Some((model, ModelCache::default())),
        };
        let base = limited.as_ref().map_or(base, |(model, own)| (model, own));
        course::run(base, start, options, self.clock, watch, act)
    }

    /// Solves the equations of motion at states. With `passing`, also near singular positions, as in runs with
    /// projection. `watch` is called with the times and may stop the computation. The rows computed so far are then
    /// returned.
    ///
    /// # Errors
    /// [`Failure`] of the first state where accelerations and multipliers are not unique, or not finite. Without
    /// `passing`, also of a massless body whose motion is not determined in the first state.
    ///
    /// # Panics
    /// If the rows do not fit the model or each other.
    pub fn accelerations(
        &self,
        states: States<'_>,
        passing: bool,
        mut watch: impl FnMut(f64) -> Flow,
    ) -> Result<Accelerations, Box<Failure>> {
        let found = accelerations((&self.model, &self.cache), states, passing, &mut watch);
        let first = found.as_ref().map_or(Some(&0.0), |found| found.regularity.first());
        if first.is_none_or(|regularity| *regularity > DOUBTFUL) {
            return found;
        }
        let (n, rows) = (self.model.layout.n_q, self.model.layout.n_rows);
        let own = second_order::acting(&self.model, states.t[0], &states.q[..n]);
        let Some(own) = own else { return found };
        let found = accelerations((&own, &ModelCache::default()), states, passing, &mut watch)?;
        let lam = found.lam.chunks(own.layout.n_rows).flat_map(|lam| &lam[..rows]);
        Ok(Accelerations { lam: lam.copied().list(), ..found })
    }

    /// Projects states between the outputs of a run, such as states of its interpolant. The results are rows of q and
    /// v as they would be reported at these times. `projection` is the projection of the run.
    ///
    /// # Errors
    /// [`Failure`] at the first state that cannot be projected.
    ///
    /// # Panics
    /// If the rows do not fit the model or each other.
    pub fn project(
        &self,
        states: States<'_>,
        projection: Projection,
    ) -> Result<[Vec<f64>; 2], Box<Failure>> {
        let n = self.model.layout.n_q;
        let first = states.t.first().map(|t| second_order::acting(&self.model, *t, &states.q[..n]));
        match first.flatten() {
            Some(own) => {
                interpolated_states::project((&own, &ModelCache::default()), states, projection)
            }
            None => interpolated_states::project((&self.model, &self.cache), states, projection),
        }
    }

    /// Kinetic and potential energy at states, J, followed by the dissipated energy and the works up to these states.
    /// Rows of three in `works` become rows of [`ENERGIES`](super::ENERGIES).
    ///
    /// # Errors
    /// [`Failure`] of the first state with an energy that is not finite.
    ///
    /// # Panics
    /// If the rows do not fit the model or each other.
    pub fn energies(&self, states: States<'_>, works: &[f64]) -> Result<Vec<f64>, Box<Failure>> {
        energies((&self.model, &self.cache), states, works)
    }
}

impl Run {
    /// Accelerations and multipliers at the reported states, without stabilization.
    ///
    /// # Errors
    /// The errors of [`Prepared::accelerations`](Prepared::accelerations).
    pub fn accelerations(&self, model: &Model) -> Result<Accelerations, Box<Failure>> {
        let states = self.trajectory.states();
        Prepared::new(model).accelerations(states, self.passing, |_| Flow::Continue)
    }
}
