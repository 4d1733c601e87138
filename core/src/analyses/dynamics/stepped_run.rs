//! A run that a host program advances part by part: a controller, a game or another simulator. The host sets inputs
//! between the parts, and they hold during a part.
//!
//! Each part is a run of the same [`PhasedRun`], with its events, phases and checks; a part ends exactly at its time. All
//! that a later part needs is plain data, so a run can be saved at any pause and continued from there, to the last bit.
//! A part works on a copy of this data: after an error, the run is where it was before the part.

use super::course::{Act, Change, PhasedRun};
use super::failure::{Failure, Reason};
use super::model_cache::ModelCache;
use super::modes;
use super::options::Options;
use super::prepared::Prepared;
use super::run_results::Run;
use super::setting::Setting;
use super::start_check::StartCheck;
use crate::analyses::{second_order, State};
use crate::integrate::Flow;
use crate::model::Model;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::ops::Deref;
use std::sync::Arc;

/// A state of a [`SteppedRun`] from which it continues. It can be written, without the tables of its model, which
/// [`SteppedRun::adopt`] adds again.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SavedRun {
    course: PhasedRun,
    /// The first of equal parts, their duration and their number so far: their ends are computed without drift.
    grid: (f64, f64, u32),
    /// The largest kinetic energy and work so far, J.
    largest_energy: f64,
    stopped_by: Option<String>,
}

impl SavedRun {
    /// The end of the next part.
    fn end_of(&mut self, duration: f64) -> Result<f64, Box<Failure>> {
        let t = self.course.at.t;
        if let Some(event) = &self.stopped_by {
            let message = format!(
                "the event {event} stopped the run at t = {t:.6} s; reset it, or restore a saved state"
            );
            return Err(Reason::Option { name: "dt", message }.into());
        }
        let (begin, last, count) = &mut self.grid;
        if *last != duration || t != *begin + f64::from(*count) * duration {
            (*begin, *last, *count) = (t, duration, 0);
        }
        *count += 1;
        let end = *begin + f64::from(*count) * duration;
        if duration > 0.0 && end > t && end.is_finite() {
            return Ok(end);
        }
        let message = format!(
            "dt: {duration} s at t = {t} s; must be positive, and more than a rounding error of t"
        );
        Err(Reason::Option { name: "dt", message }.into())
    }
}

/// A run that pauses after each part.
///
/// ```
/// # use kempe::{analyses::{dynamics, State}, integrate::Flow, model::Model};
/// # fn all(model: &Model, start: &State) -> Result<(), Box<dynamics::Failure>> {
/// let prepared = std::sync::Arc::new(dynamics::Prepared::new(model));
/// let mut run = dynamics::SteppedRun::new(prepared, start, &dynamics::Options::new(0.0))?;
/// for _ in 0..100 {
///     let force = -10.0 * run.state().v[0];
///     run.change(dynamics::Change { parameters: vec![("F".into(), force)], state: None })?;
///     run.advance(0.01, |_| Flow::Continue, None)?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SteppedRun<M> {
    prepared: Arc<Prepared<M>>,
    /// The model with the constraints that others imply only to second order, if there are any.
    own: Option<Box<(Model, ModelCache)>>,
    options: Options,
    /// The first step that the options ask for.
    first_step: Option<f64>,
    now: SavedRun,
    last: Run,
    /// Doubts of the start or of a change, which the next part reports.
    unreported: Vec<String>,
}

impl<M: Deref<Target = Model>> SteppedRun<M> {
    /// Begins a run. The end and the output of the options are not used.
    ///
    /// # Errors
    /// The errors of the start of [`Prepared::dynamics`].
    pub fn new(
        prepared: Arc<Prepared<M>>,
        start: &State,
        options: &Options,
    ) -> Result<Self, Box<Failure>> {
        let t = options.t_start.unwrap_or(start.t);
        let first_step = options.method.control().first_step;
        let mut options =
            Options { t_end: t, output_step: None, dense_output: false, ..options.clone() };
        options.method.control_mut().first_step = None;
        let own = second_order::acting(prepared.model(), start.t, &start.q);
        let limited = own.as_ref().unwrap_or(prepared.model()).limited();
        let own = match limited {
            Cow::Owned(model) => Some(model),
            Cow::Borrowed(_) => own,
        };
        let own = own.map(|model| Box::new((model, ModelCache::default())));
        let base = own.as_ref().map_or_else(|| &**prepared.model(), |own| &own.0);
        let mut last = Run::default();
        let course = PhasedRun::begin(base, start, &options, &mut last)?;
        if !modes::has_modes(base) {
            // otherwise the modes have been decided for a state that was checked
            let parts = [&start.q[..], &start.v, &start.z];
            StartCheck::of_run(&options).check(course.model(base), t, parts)?;
        }
        let now = SavedRun { course, grid: (t, 0.0, 0), largest_energy: 0.0, stopped_by: None };
        let unreported = std::mem::take(&mut last.doubts);
        Ok(Self { prepared, own, options, first_step, now, last, unreported })
    }

    /// Advances by a duration, or to the event that stops the run. [`Flow::Stop`] if `watch` or `act` has stopped the
    /// part: the run then remains at the state before it, as after an error.
    ///
    /// # Errors
    /// The errors of [`Prepared::dynamics`]; a duration that is not positive; a run that an event has stopped.
    pub fn advance(
        &mut self,
        duration: f64,
        watch: impl FnMut(f64) -> Flow,
        act: Option<Act<'_>>,
    ) -> Result<Flow, Box<Failure>> {
        let mut now = self.now.clone();
        self.options.t_end = now.end_of(duration)?;
        let first = self.first_step.map(|first| first.min(self.options.t_end - self.t()));
        self.options.method.control_mut().first_step = first;
        let mut run = self.part(&mut now, watch, act)?;
        if !run.reached && run.stopped_by.is_none() {
            return Ok(Flow::Stop);
        }
        run.doubts.splice(0..0, self.unreported.drain(..));
        (self.now, self.last) = (now, run);
        Ok(Flow::Continue)
    }

    fn part(
        &self,
        now: &mut SavedRun,
        mut watch: impl FnMut(f64) -> Flow,
        mut act: Option<Act<'_>>,
    ) -> Result<Run, Box<Failure>> {
        let mut run = Run { events: now.course.events(), ..Run::default() };
        run.largest_energy = now.largest_energy;
        let model: &Model = self.prepared.model();
        let base = self.own.as_deref();
        let base = base.map_or((model, self.prepared.cache()), |(model, own)| (model, own));
        now.course.proceed(base, &self.options, &mut run, (&mut watch, &mut act))?;
        if run.reached || run.stopped_by.is_some() {
            let doubts = now.course.guard.judge_part(base.0, &run)?;
            run.doubts.extend(doubts);
        }
        now.course.at.pause(&run);
        now.largest_energy = run.largest_energy;
        now.stopped_by.clone_from(&run.stopped_by);
        Ok(run)
    }

    /// Changes inputs between two parts: parameters, or the state at the present time. They must meet the constraints.
    ///
    /// # Errors
    /// The change does not meet the constraints, or a value is impossible. The run then keeps its inputs.
    pub fn change(&mut self, change: Change) -> Result<(), Box<Failure>> {
        let (before, events) = (self.now.clone(), self.last.events.clone());
        let base = self.own.as_ref().map_or_else(|| &**self.prepared.model(), |own| &own.0);
        let reported = std::mem::take(&mut self.last.doubts);
        let outcome = self.now.course.change(base, &self.options, change, &mut self.last);
        let new = std::mem::replace(&mut self.last.doubts, reported);
        match outcome {
            Ok(()) => self.unreported.extend(new),
            Err(_) => (self.now, self.last.events) = (before, events),
        }
        outcome
    }

    /// The time reached, s.
    pub fn t(&self) -> f64 {
        self.now.course.at.t
    }

    /// The present state.
    pub fn state(&self) -> State {
        self.now.course.at.state(self.prepared.model())
    }

    /// Works up to the present state, J: dissipated energy, work of drivers, work of applied forces.
    pub fn works(&self) -> &[f64] {
        self.prepared.model().layout.split(&self.now.course.at.y)[3]
    }

    /// The parameters, released drivers and modes that hold at present.
    pub fn setting(&self) -> &Setting {
        self.now.course.setting()
    }

    /// The last part: its events and its reported states. Before the first part, the events of the start.
    pub fn last_part(&self) -> &Run {
        &self.last
    }

    /// The event that has stopped the run.
    pub fn stopped_by(&self) -> Option<&str> {
        self.now.stopped_by.as_deref()
    }

    /// The present state with all that later parts need.
    pub fn save(&self) -> SavedRun {
        self.now.clone()
    }

    /// Continues from a state that this run has saved. Its last part has then no events.
    pub fn restore(&mut self, saved: &SavedRun) {
        self.now = saved.clone();
        self.last = Run { events: self.now.course.events(), ..Run::default() };
    }

    /// Continues from a state that was written and read again. It must belong to a run of the same model and options.
    ///
    /// # Errors
    /// The state does not fit this run. The run then remains where it was.
    pub fn adopt(&mut self, mut read: SavedRun) -> Result<(), Box<Failure>> {
        let base = self.own.as_ref().map_or_else(|| &**self.prepared.model(), |own| &own.0);
        read.course.link(base, &self.now.course)?;
        self.restore(&read);
        Ok(())
    }
}
