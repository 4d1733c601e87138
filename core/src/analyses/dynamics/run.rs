//! A run: a sequence of phases, each with its own active constraints.

use super::clock::Clock;
use super::failure::Failure;
use super::model_cache::ModelCache;
use super::motion_ode::MotionOde;
use super::motion_stepper::MotionStepper;
use super::options::Options;
use super::recorder::{self, Recorder};
use super::run_results::Run;
use super::stabilizations::Stabilization;
use super::start_check::StartCheck;
use super::switch_schedule::Schedule;
use crate::analyses::curves::Ranges;
use crate::analyses::State;
use crate::integrate::{Cause, Direction, Flow, Step};
use crate::model::Model;
use crate::solve::Breakdown;

/// A function of the state whose change of sign ends a phase.
#[derive(Clone, Copy)]
pub struct Event<'a> {
    /// g(t, q, v, z).
    pub g: &'a dyn Fn(f64, [&[f64]; 3]) -> f64,
    /// The changes of sign that count.
    pub direction: Direction,
}

/// A part of a run with its own active constraints.
#[derive(Clone, Copy)]
pub struct Phase<'a> {
    /// Bodies, constraints and forces. The models of all phases have the same bodies and states.
    pub model: &'a Model,
    /// Time at which the phase ends, s; None for the end of the run.
    pub t_end: Option<f64>,
    /// An event that ends the phase before.
    pub event: Option<Event<'a>>,
    /// Whether the velocities at its start are projected onto its constraints, in the metric of the mass matrix.
    /// Otherwise they should meet the constraints already.
    pub project_velocities: bool,
}

impl<'a> Phase<'a> {
    /// A phase to the end of the run.
    pub fn new(model: &'a Model) -> Self {
        Self { model, t_end: None, event: None, project_velocities: false }
    }
}

/// The functions of the caller that observe a run.
pub(super) struct Watcher<'l, W> {
    /// Called with the time after each step and each reported state.
    pub watch: W,
    /// Called with each step.
    pub look: Option<&'l mut dyn FnMut(&Step<'_>) -> Flow>,
}

/// The phases of a run, each with the cache of its model.
pub(super) type Phases<'p, 'm> = &'p [(Phase<'m>, &'m ModelCache)];

/// Integrates through all phases.
pub(super) fn simulate<W: FnMut(f64) -> Flow>(
    phases: Phases<'_, '_>,
    start: &State,
    options: &Options,
    clock: Clock,
    mut watcher: Watcher<'_, W>,
) -> Result<Run, Box<Failure>> {
    let began = clock();
    for (phase, _) in phases {
        options.check(phase.model, start)?;
    }
    let t0 = options.t_start.unwrap_or(start.t);
    let mut run = Run::default();
    let mut at = At { t0, t: t0, y: Vec::new() };
    for (k, (phase, cache)) in phases.iter().enumerate() {
        if k == 0 {
            let layout = &phase.model.layout;
            at.y = [&start.q[..], &start.v, &start.z].concat();
            at.y.resize(layout.n_y(), 0.0);
            (run.trajectory, run.dense) = recorder::tables(phase.model, options, t0);
        }
        let t_end = phase.t_end.unwrap_or(options.t_end);
        let options = Options { t_end, ..options.clone() };
        let outcome = run_phase((phase, cache), &mut at, &options, &mut run, &mut watcher);
        run.statistics.seconds = clock() - began;
        match outcome {
            Ok(Flow::Continue) => {}
            Ok(Flow::Stop) => return Ok(run),
            Err(failure) => return Err(Box::new(Failure { run, ..*failure })),
        }
    }
    run.reached = true;
    Ok(run)
}

/// The place of a run in its phases.
struct At {
    /// The start of the run.
    t0: f64,
    t: f64,
    y: Vec<f64>,
}

/// Integrates one phase; updates `at` and `run`. Returns whether the next phase follows.
fn run_phase<W: FnMut(f64) -> Flow>(
    (phase, cache): (&Phase<'_>, &ModelCache),
    at: &mut At,
    options: &Options,
    run: &mut Run,
    watcher: &mut Watcher<'_, W>,
) -> Result<Flow, Box<Failure>> {
    let model = phase.model;
    let first = run.phases.is_empty();
    let check =
        if first { StartCheck::of_run(options) } else { StartCheck::of_continuation(options) };
    let check = if phase.project_velocities { check.of_positions() } else { check };
    let [q, v, z, _] = model.layout.split(&at.y);
    check.check(model, at.t, [q, v, z])?;
    let schedule = Schedule::new(model, (at.t, options.t_end))?;
    let mut ode = MotionOde::new(model, options, cache.plan(model));
    run.phases.push(run.trajectory.t.len());
    run.passing = ode.passing;
    run.projection = match options.stabilization {
        Stabilization::Projection(projection) => Some(projection),
        _ => None,
    };
    let wide = recorder::many(options.output_step, options.t_end - at.t).then(|| cache.wide(model));
    let tables = (std::mem::take(&mut run.trajectory), run.dense.take());
    let mut recorder = Recorder::new(&ode, wide, options, (at.t0, at.t), tables);
    let q = model.layout.split(&at.y)[0].to_vec();
    let started = ode.begin_phase(at.t, &mut at.y, phase.project_velocities, true);
    let outcome = match started {
        Err(breakdown) => Err(Failure::at_state(model, at.t, &q, breakdown)),
        Ok(()) if recorder.begin(at.t, &at.y) == Flow::Stop => Ok(Flow::Stop),
        Ok(()) => step_through(ode, phase, at, options, (&mut recorder, watcher), schedule, run),
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
fn step_through<W: FnMut(f64) -> Flow>(
    ode: MotionOde<'_>,
    phase: &Phase<'_>,
    at: &mut At,
    options: &Options,
    (recorder, watcher): (&mut Recorder<'_>, &mut Watcher<'_, W>),
    schedule: Schedule,
    run: &mut Run,
) -> Result<Flow, Box<Failure>> {
    let model = ode.model;
    let failed = |cause, t, y: &[f64]| Failure::of_integrator(model, cause, t, y);
    let mut stepper = MotionStepper::new(ode, options, schedule, at.t, &at.y)
        .map_err(|cause| failed(cause, at.t, &at.y))?;
    let ranges = Ranges::of(model);
    let mut event = phase.event;
    let outcome = loop {
        if stepper.t() == recorder.t_end {
            break Ok(Flow::Continue);
        }
        match next_step(&mut stepper, &mut event, recorder, watcher) {
            Ok(Next::Step(Flow::Continue)) => {
                let q = model.layout.split(stepper.y())[0];
                if let Some((_, message)) = ranges.beyond(model, q) {
                    break Err(Failure::off_the_curve(stepper.t(), &message));
                }
            }
            Ok(Next::Step(Flow::Stop)) => break Ok(Flow::Stop),
            // the step is taken again, to end at the event
            Ok(Next::Event(t)) => {
                recorder.t_end = t;
                stepper.end_within_step(t).map_err(|cause| failed(cause, at.t, &at.y))?;
            }
            Err(cause) => break Err(stepper.failure(cause)),
        }
    };
    run.statistics.add(stepper.statistics(), stepper.factorisations());
    run.choice = stepper.choice();
    at.t = stepper.t();
    at.y.copy_from_slice(stepper.y());
    outcome
}

/// The outcome of a step.
enum Next {
    Step(Flow),
    /// An event at this time.
    Event(f64),
}

/// Takes a step and passes it to the recorder and to the caller.
fn next_step<W: FnMut(f64) -> Flow>(
    stepper: &mut MotionStepper<'_>,
    event: &mut Option<Event<'_>>,
    recorder: &mut Recorder<'_>,
    watcher: &mut Watcher<'_, W>,
) -> Result<Next, Cause<Breakdown>> {
    stepper.step()?;
    if let Some(Event { g, direction }) = *event {
        if let Some((t, _)) = stepper.locate(g, direction)? {
            *event = None;
            if t != stepper.t() {
                return Ok(Next::Event(t));
            }
            recorder.t_end = t;
        }
    }
    let Watcher { watch, look } = watcher;
    if look.is_some() || recorder.looks_inside(stepper.t()) {
        stepper.prepare_interpolant()?;
    }
    recorder.sample = stepper.sample().cloned();
    let step = stepper.last_step().expect("a step was taken");
    let mut flow = recorder.step(&step, watch);
    if flow == Flow::Continue {
        flow = watch(step.t);
    }
    let flow = match look {
        Some(look) if flow == Flow::Continue => look(&step),
        _ => flow,
    };
    Ok(Next::Step(flow))
}
