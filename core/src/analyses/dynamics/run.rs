//! One phase of a run, with its own active constraints. `course` makes the sequence of phases.

use super::event_list::{EventList, StepEvents, Watched};
use super::failure::Failure;
use super::model_cache::ModelCache;
use super::motion_ode::MotionOde;
use super::motion_stepper::MotionStepper;
use super::options::Options;
use super::recorder::{self, Recorder};
use super::redundant_rows::workspace_at;
use super::run_results::Run;
use super::stabilizations::Stabilization;
use super::start_check::StartCheck;
use super::switch_schedule::Schedule;
use crate::analyses::curves::Ranges;
use crate::analyses::so_far::SoFar;
use crate::analyses::State;
use crate::integrate::{Cause, Flow};
use crate::model::Model;
use crate::solve::Breakdown;

/// The progress of a run through its phases.
#[derive(Default)]
pub(super) struct Progress {
    /// The start of the run.
    t0: f64,
    pub t: f64,
    pub y: Vec<f64>,
    /// The events that ended the last phase.
    pub fired: Vec<usize>,
    /// The course of the run that conditions refer to.
    pub so_far: SoFar,
}

impl Progress {
    /// At the start of a run; makes its tables.
    pub fn begin(model: &Model, start: &State, options: &Options, run: &mut Run) -> Self {
        let t0 = options.t_start.unwrap_or(start.t);
        let mut y = [&start.q[..], &start.v, &start.z].concat();
        y.resize(model.layout.n_y(), 0.0);
        (run.trajectory, run.dense) = recorder::tables(model, options, t0);
        Self { t0, t: t0, y, ..Self::default() }
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
    /// Whether the velocities at its start are projected onto its constraints, in the metric of the mass matrix.
    /// Otherwise they should meet the constraints already.
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
    let Phase { model, cache, project_velocities } = phase;
    let first = run.phases.is_empty();
    let check =
        if first { StartCheck::of_run(options) } else { StartCheck::of_continuation(options) };
    let check = if project_velocities { check.of_positions() } else { check };
    let [q, v, z, _] = model.layout.split(&at.y);
    check.check(model, at.t, [q, v, z])?;
    let schedule = Schedule::new(model, (at.t, options.t_end))?;
    let workspace = workspace_at((model, cache), at.t, [q, v, z]);
    let mut ode = MotionOde::new(model, options, workspace);
    run.phases.push(run.trajectory.t.len());
    run.passing = ode.passing;
    run.projection = match options.stabilization {
        Stabilization::Projection(projection) => Some(projection),
        _ => None,
    };
    let wide = cache.wide(model, recorder::grid_steps(options, at.t) as usize);
    let tables = (std::mem::take(&mut run.trajectory), run.dense.take());
    let mut recorder = Recorder::new(&ode, wide, options, (at.t0, at.t), tables);
    let q = model.layout.split(&at.y)[0].to_vec();
    let started = ode.begin_phase(at.t, &mut at.y, project_velocities, true);
    let outcome = match started {
        Err(breakdown) => Err(Failure::at_state(model, at.t, &q, breakdown)),
        Ok(()) if recorder.begin(at.t, &at.y) == Flow::Stop => Ok(PhaseEnd::Stopped),
        Ok(()) => {
            let so_far = std::mem::take(&mut at.so_far);
            let events = EventList::new(&ode, watched, at.t, &at.fired, so_far);
            step_through(ode, events, at, options, (&mut recorder, watch), schedule, run)
        }
    };
    recorder.flush();
    run.statistics.factorisations += recorder.factorisations();
    let Recorder { trajectory, dense, breakdown, .. } = recorder;
    (run.trajectory, run.dense) = (trajectory, dense);
    let last = run.trajectory.q.rchunks(model.layout.n_q.max(1)).next().unwrap_or(&q);
    match breakdown {
        Some((t, breakdown)) if outcome.is_ok() => {
            Err(Failure::at_state(model, t, last, breakdown))
        }
        _ => outcome,
    }
}

/// Takes the steps of a phase.
fn step_through(
    ode: MotionOde<'_>,
    mut events: Option<EventList<'_>>,
    at: &mut Progress,
    options: &Options,
    (recorder, watch): (&mut Recorder<'_>, &mut impl FnMut(f64) -> Flow),
    schedule: Schedule,
    run: &mut Run,
) -> Result<PhaseEnd, Box<Failure>> {
    let model = ode.model;
    let failed = |cause, t, y: &[f64]| Failure::of_integrator(model, cause, t, y);
    let mut stepper = MotionStepper::new(ode, options, schedule, at.t, &at.y)
        .map_err(|cause| failed(cause, at.t, &at.y))?;
    let ranges = Ranges::of(model);
    at.fired.clear();
    let outcome = loop {
        if stepper.t() == recorder.t_end {
            let ended = at.fired.is_empty() && recorder.t_end == options.t_end;
            break Ok(if ended { PhaseEnd::Reached } else { PhaseEnd::Event });
        }
        match next_step(&mut stepper, &mut events, (recorder, watch), run, &mut at.fired) {
            Ok(Next::Step(Flow::Continue)) => {
                let q = model.layout.split(stepper.y())[0];
                if let Some((_, message)) = ranges.beyond(model, q) {
                    break Err(Failure::off_the_curve(stepper.t(), &message));
                }
            }
            Ok(Next::Step(Flow::Stop)) => break Ok(PhaseEnd::Stopped),
            // the step is taken again, to end at the event
            Ok(Next::Event(t)) => {
                stepper.end_within_step(t).map_err(|cause| failed(cause, at.t, &at.y))?;
            }
            Err(cause) => break Err(stepper.failure(cause)),
        }
    };
    run.statistics.add(stepper.statistics(), stepper.factorisations());
    run.choice = stepper.choice();
    run.passed.append(&mut stepper.passed);
    at.t = stepper.t();
    at.y.copy_from_slice(stepper.y());
    at.so_far = events.map(EventList::so_far).unwrap_or_default();
    outcome
}

/// The outcome of a step.
enum Next {
    Step(Flow),
    /// The phase ends at an event near this time.
    Event(f64),
}

/// Takes a step and passes it to the recorder and to the caller. Events in it are added to the run; those that end the
/// phase are also put into `fired`.
fn next_step(
    stepper: &mut MotionStepper<'_>,
    events: &mut Option<EventList<'_>>,
    (recorder, watch): (&mut Recorder<'_>, &mut impl FnMut(f64) -> Flow),
    run: &mut Run,
    fired: &mut Vec<usize>,
) -> Result<Next, Cause<Breakdown>> {
    stepper.step()?;
    let model = stepper.ode.model;
    if events.is_some() || recorder.looks_inside(stepper.t()) {
        stepper.prepare_interpolant()?;
    }
    let step = stepper.last_step().expect("a step was taken");
    let found = events.as_mut().map(|events| events.look(model, &step, recorder.t_end));
    let happened = match found {
        Some(StepEvents::Again(t)) => return Ok(Next::Event(t)),
        Some(StepEvents::End(happened)) => {
            recorder.t_end = step.t;
            let ending = happened.iter().filter(|event| event.t == step.t);
            fired.extend(ending.map(|event| event.index));
            happened
        }
        Some(StepEvents::Events(happened)) => happened,
        None => Vec::new(),
    };
    // a step that is taken again has no sample
    recorder.sample = stepper.sample().cloned();
    let step = stepper.last_step().expect("a step was taken");
    let mut flow = recorder.follow(&stepper.ode.workspace);
    if flow == Flow::Continue {
        flow = recorder.step(&step, watch);
    }
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
