//! One phase of a run, with its own active constraints. `course` creates the sequence of phases.

use super::continued::Continued;
use super::event_list::{EventList, StepEvents, Watched};
use super::failure::Failure;
use super::feet::Feet;
use super::laws_before::LawsBefore;
use super::model_cache::ModelCache;
use super::motion_ode::MotionOde;
use super::motion_stepper::MotionStepper;
use super::options::Options;
use super::recorder::{self, Recorder};
use super::redundant_rows::workspace_at;
use super::run_results::{Run, ROUNDING};
use super::start_check::StartCheck;
use super::switch_schedule::Schedule;
use crate::analyses::curves::Ranges;
use crate::analyses::so_far::SoFar;
use crate::analyses::State;
use crate::equations::energy;
use crate::equations::kinematics::Motions;
use crate::integrate::{Cause, Flow, TooFast};
use crate::math::{Listed, ShortArray};
use crate::model::Model;
use crate::solve::Breakdown;
use serde::{Deserialize, Serialize};

/// The progress of a run through its phases.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Progress {
    /// The start of the run.
    t0: f64,
    pub t: f64,
    pub y: Vec<f64>,
    /// The events that ended the last phase.
    pub fired: Vec<usize>,
    /// The course of the run, which conditions may use.
    pub so_far: SoFar,
    /// The values of the conditions of events at the end of the last phase.
    #[serde(default)]
    conditions: Vec<f64>,
    /// Whether a phase has begun.
    begun: bool,
    /// How the steps of the last phase continue.
    last: Option<Continued>,
    /// How the next phase continues the last one; None unless the run paused between them.
    continued: Option<Continued>,
    /// Whether the state has met the constraints when the run paused.
    checked: bool,
    /// The numbers of events in the parts of the run before the last pause.
    earlier: Vec<usize>,
    /// Whether forces jump at the end of the last phase, where a law changes, and the next phase begins with the same
    /// state and parameters.
    #[serde(default)]
    pub jumped: bool,
}

impl Progress {
    /// Begins a run and creates its tables.
    pub fn begin(model: &Model, start: &State, options: &Options, run: &mut Run) -> Self {
        let t0 = options.t_start.unwrap_or(start.t);
        let mut y = [&start.q[..], &start.v, &start.z].concat();
        y.resize(model.layout.n_y(), 0.0);
        (run.trajectory, run.dense) = recorder::tables(model, options, t0);
        Self { t0, t: t0, y, ..Self::default() }
    }

    /// The present state.
    pub fn state(&self, model: &Model) -> State {
        let [q, v, z, _] = model.layout.split(&self.y).each(<[f64]>::to_vec);
        State { t: self.t, q, v, z }
    }

    /// The first row of the next phase. Where a law has jumped at its beginning, the rows at this time belong to it:
    /// they have the forces of the law at this time, which the phase before could not carry.
    fn first_row(&mut self, run: &Run) -> usize {
        let rows = run.trajectory.t.len();
        let least = run.phases.last().map_or(rows, |first| first + 1);
        if !std::mem::take(&mut self.jumped) || least >= rows {
            return rows;
        }
        let here = |t: &&f64| (**t - self.t).abs() <= 4.0 * f64::EPSILON * self.t.abs();
        rows - run.trajectory.t[least..].iter().rev().take_while(here).count()
    }

    /// How often an event has occurred.
    pub fn occurred(&self, run: &Run, index: usize) -> usize {
        let earlier = self.earlier.get(index).copied().unwrap_or_default();
        earlier + run.events[index].states.t.len()
    }

    /// Pauses at the end of a part of the run.
    pub fn pause(&mut self, run: &Run) {
        self.earlier = (0..run.events.len()).map(|index| self.occurred(run, index)).list();
        (self.continued, self.checked) = (self.last, true);
    }

    /// Notes that the caller has changed the mechanism or the state during a pause.
    pub fn resume_changed(&mut self) {
        self.checked = false;
    }
}

/// How a phase ended.
pub(super) enum PhaseEnd {
    /// The phase reached its end time.
    Reached,
    /// The caller ended the phase.
    Stopped,
    /// The phase ended at events, which are in [`Progress::fired`].
    Event,
}

/// The bodies, constraints and forces of a phase.
#[derive(Clone, Copy)]
pub(super) struct Phase<'a> {
    pub model: &'a Model,
    pub cache: &'a ModelCache,
    /// Whether the velocities at the start are projected onto the constraints of the phase, in the metric of the mass
    /// matrix. Otherwise they must meet the constraints already.
    pub project_velocities: bool,
}

/// Integrates one phase; updates `at` and `run`. `watch` is called with the time after each step and each reported
/// state.
pub(super) fn run_phase(
    phase: Phase<'_>,
    watched: Vec<Watched<'_>>,
    at: &mut Progress,
    options: &Options,
    run: &mut Run,
    watch: &mut impl FnMut(f64) -> Flow,
) -> Result<PhaseEnd, Box<Failure>> {
    let (begun, mut recorder) = begin_phase(phase, watched, at, options, run)?;
    let outcome = begun.and_then(|steps| {
        let Some(mut steps) = steps else { return Ok(PhaseEnd::Stopped) };
        let outcome = loop {
            match steps.step((&mut recorder, watch), run) {
                Ok(None) => {}
                Ok(Some(end)) => break Ok(end),
                Err(failure) => break Err(failure),
            }
        };
        steps.end(at, run);
        outcome
    });
    end_phase(phase.model, recorder, at, outcome, run)
}

/// The steps of a phase (None if it is stopped at its start), and their recorder, which holds the tables of the run.
type Begun<'a> = (Result<Option<PhaseSteps<'a>>, Box<Failure>>, Recorder<'a>);

/// Begins a phase; updates `at` and `run`.
pub(super) fn begin_phase<'a>(
    Phase { model, cache, project_velocities }: Phase<'a>,
    watched: Vec<Watched<'a>>,
    at: &mut Progress,
    options: &Options,
    run: &mut Run,
) -> Result<Begun<'a>, Box<Failure>> {
    let first = !std::mem::replace(&mut at.begun, true);
    let check =
        if first { StartCheck::of_run(options) } else { StartCheck::of_continuation(options) };
    let check = if project_velocities { check.of_positions() } else { check };
    let [q, v, z, _] = model.layout.split(&at.y);
    if !std::mem::take(&mut at.checked) {
        check.check(model, at.t, [q, v, z])?;
    }
    let schedule = Schedule::new(model, (at.t, options.t_end))?;
    let workspace = workspace_at((model, cache), at.t, [q, v, z]);
    let mut ode = MotionOde::new(model, options, workspace);
    run.phases.push(at.first_row(run));
    run.passing = ode.passing;
    run.projection = ode.projection();
    let wide = cache.wide(model, recorder::grid_steps(options, at.t) as usize);
    let tables = (std::mem::take(&mut run.trajectory), run.dense.take());
    let mut recorder = Recorder::new(&ode, wide, options, (at.t0, at.t), tables);
    let q = model.layout.split(&at.y)[0].to_vec();
    let begun = match ode.begin_phase(at.t, &mut at.y, project_velocities, true) {
        Err(breakdown) => Err(Failure::at_state(model, at.t, &q, breakdown)),
        Ok(()) if recorder.begin(at.t, &at.y) == Flow::Stop => Ok(None),
        Ok(()) => {
            let so_far = (std::mem::take(&mut at.so_far), std::mem::take(&mut at.conditions));
            let events = EventList::new(&ode, watched, at.t, &at.fired, so_far);
            PhaseSteps::new(ode, events, at, options, schedule).map(Some)
        }
    };
    Ok((begun, recorder))
}

/// Ends a phase that [began](begin_phase): returns the tables to the run.
pub(super) fn end_phase(
    model: &Model,
    mut recorder: Recorder<'_>,
    at: &Progress,
    outcome: Result<PhaseEnd, Box<Failure>>,
    run: &mut Run,
) -> Result<PhaseEnd, Box<Failure>> {
    recorder.flush();
    run.statistics.factorisations += recorder.factorisations();
    let Recorder { trajectory, dense, breakdown, .. } = recorder;
    (run.trajectory, run.dense) = (trajectory, dense);
    let reached = model.layout.split(&at.y)[0];
    let last = run.trajectory.q.rchunks(model.layout.n_q.max(1)).next().unwrap_or(reached);
    match breakdown {
        Some((t, breakdown)) if outcome.is_ok() => {
            Err(Failure::at_state(model, t, last, breakdown))
        }
        _ => outcome,
    }
}

/// The steps of a phase.
pub(super) struct PhaseSteps<'a> {
    pub stepper: MotionStepper<'a>,
    events: Option<EventList<'a>>,
    ranges: Ranges,
    feet: Feet,
    /// The start of the phase, for messages.
    start: (f64, Vec<f64>),
    /// The end of the run.
    t_end: f64,
    /// The events that end the phase.
    fired: Vec<usize>,
    motions: Motions,
    laws: LawsBefore,
}

impl<'a> PhaseSteps<'a> {
    fn new(
        ode: MotionOde<'a>,
        events: Option<EventList<'a>>,
        at: &mut Progress,
        options: &Options,
        schedule: Schedule,
    ) -> Result<Self, Box<Failure>> {
        let (model, continued) = (ode.model, at.continued.take());
        let stepper = MotionStepper::new(ode, (options, continued), schedule, at.t, &at.y)
            .map_err(|cause| Failure::of_integrator(model, cause, at.t, &at.y))?;
        let start = (at.t, at.y.clone());
        let (ranges, t_end, fired) = (Ranges::of(model), options.t_end, Vec::new());
        let feet = Feet::of(model, model.layout.split(&at.y)[0]);
        let motions = Motions::new(&model.layout);
        let laws = LawsBefore::new(model, &at.y);
        Ok(Self { stepper, events, ranges, feet, start, t_end, fired, motions, laws })
    }

    /// How the phase ended, if the last step reached its end.
    pub fn reached(&self, recorder: &Recorder<'_>) -> Option<PhaseEnd> {
        if self.stepper.t() != recorder.t_end {
            return None;
        }
        let ended = self.fired.is_empty() && recorder.t_end == self.t_end;
        Some(if ended { PhaseEnd::Reached } else { PhaseEnd::Event })
    }

    /// Takes a step. Returns how the phase ended, if it did.
    pub fn step(
        &mut self,
        observers: (&mut Recorder<'_>, &mut impl FnMut(f64) -> Flow),
        run: &mut Run,
    ) -> Result<Option<PhaseEnd>, Box<Failure>> {
        if let Some(end) = self.reached(observers.0) {
            return Ok(Some(end));
        }
        match self.stepper.step() {
            Ok(()) => self.follow(observers, run),
            Err(cause) => Err(self.stepper.failure(cause)),
        }
    }

    /// Passes the step that was taken to the observers. Returns how the phase ended, if the observers end it.
    pub fn follow(
        &mut self,
        observers: (&mut Recorder<'_>, &mut impl FnMut(f64) -> Flow),
        run: &mut Run,
    ) -> Result<Option<PhaseEnd>, Box<Failure>> {
        let model = self.stepper.ode.model;
        let Self { stepper, events, fired, motions, .. } = self;
        match observe(stepper, events, observers, (run, motions), fired) {
            Ok(Next::Step(Flow::Continue)) => {
                let (start, end) = (self.start.0, self.t_end);
                let span = start.abs().max((end - start).abs());
                self.laws.keep(&self.stepper.ode, self.stepper.last_step(), ROUNDING * span);
                let q = model.layout.split(self.stepper.y())[0];
                let beyond = self.ranges.beyond(model, q);
                let failure =
                    |(_, message): (_, String)| Failure::off_the_curve(self.stepper.t(), &message);
                let wedged = || self.feet.look(model, self.stepper.t(), q);
                beyond.map(failure).or_else(wedged).map_or(Ok(None), Err)
            }
            Ok(Next::Step(Flow::Stop)) => Ok(Some(PhaseEnd::Stopped)),
            Ok(Next::TooFast(index)) => {
                let name = self.events.as_ref().map_or("", |events| events.name(index));
                Err(Failure::too_fast(
                    name,
                    self.stepper.last_step().map_or(0.0, |step| step.t_old),
                ))
            }
            // the step is taken again, to end at the event
            Ok(Next::Event(t)) => {
                let (t_start, y_start) = (self.start.0, &self.start.1);
                let again = self.stepper.end_within_step(t);
                again.map_err(|cause| Failure::of_integrator(model, cause, t_start, y_start))?;
                Ok(None)
            }
            Err(cause) => Err(self.stepper.failure(cause)),
        }
    }

    /// Ends the steps; updates `at` and `run`.
    pub fn end(mut self, at: &mut Progress, run: &mut Run) {
        // a switch may have ended the phase
        let held = self.stepper.held(run.implicit.len(), true);
        run.held.extend(held.filter(|held| held.step > 0 && !held.causes.is_empty()));
        run.statistics.add(self.stepper.statistics(), self.stepper.factorisations());
        run.choice = self.stepper.choice();
        at.last = Some(self.stepper.continued());
        run.passed.append(&mut self.stepper.passed);
        at.t = self.stepper.t();
        at.y.copy_from_slice(self.stepper.y());
        at.jumped = self.laws.jump(&mut self.stepper.ode, at.t, &at.y);
        at.fired = self.fired;
        (at.so_far, at.conditions) = self.events.map(EventList::so_far).unwrap_or_default();
    }
}

/// The largest of the kinetic energy and the works at a state, J.
fn largest_energy(model: &Model, motions: &mut Motions, y: &[f64]) -> f64 {
    let [q, v, _, works] = model.layout.split(y);
    motions.place(&model.layout, q, v);
    works.iter().fold(energy::kinetic(model, motions), |most, work| most.max(work.abs()))
}

/// The outcome of a step.
enum Next {
    Step(Flow),
    /// The phase ends at an event near this time.
    Event(f64),
    /// The event with this index may occur more often in the step than can be listed.
    TooFast(usize),
}

/// Passes the last step to the recorder and to the caller. Adds the events in the step to the run. Events that end
/// the phase are also added to `fired`.
fn observe(
    stepper: &mut MotionStepper<'_>,
    events: &mut Option<EventList<'_>>,
    (recorder, watch): (&mut Recorder<'_>, &mut impl FnMut(f64) -> Flow),
    (run, motions): (&mut Run, &mut Motions),
    fired: &mut Vec<usize>,
) -> Result<Next, Cause<Breakdown>> {
    let model = stepper.ode.model;
    if events.is_some() || recorder.looks_inside(stepper.t()) {
        stepper.prepare_interpolant()?;
    }
    let step = stepper.last_step().expect("a step was taken");
    let found = events.as_mut().map(|events| events.look(model, &step, recorder.t_end));
    let happened = match found.transpose() {
        Err(TooFast(index)) => return Ok(Next::TooFast(index)),
        Ok(found) => found,
    };
    let happened = match happened {
        Some(StepEvents::Again(t)) => return Ok(Next::Event(t)),
        Some(StepEvents::End(happened)) => {
            recorder.t_end = step.t;
            let ending = happened.iter().filter(|event| event.t == step.t);
            ending.map(|event| event.index).append_to(fired);
            happened
        }
        Some(StepEvents::Events(happened)) => happened,
        None => Vec::new(),
    };
    // a step that will be taken again has no sample
    recorder.sample = stepper.sample().cloned();
    let step = stepper.last_step().expect("a step was taken");
    run.largest_energy = largest_energy(model, motions, step.y).max(run.largest_energy);
    let mut flow = recorder.follow(&stepper.ode.workspace);
    if flow == Flow::Continue {
        flow = recorder.step(&step, watch);
    }
    let steps = recorder.dense.as_ref().map_or(0, |dense| dense.t.len() - 1);
    if steps > 0 {
        run.implicit.resize(steps, stepper.was_implicit());
        run.held.extend(stepper.held(steps - 1, false).filter(|held| held.is_new(run.held.last())));
    }
    let step = stepper.last_step().expect("a step was taken");
    let listed = |index: usize| events.as_ref().is_some_and(|events| events.lists(index));
    for event in happened.iter().filter(|event| listed(event.index)) {
        let y = recorder.state_in(&step, event.t);
        run.add_event(&model.layout, event.index, event.t, &y);
    }
    if flow == Flow::Continue {
        flow = watch(step.t);
    }
    Ok(Next::Step(flow))
}
