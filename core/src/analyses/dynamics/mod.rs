//! Forward dynamics: the motion of a mechanism under forces, from a consistent state.

mod accelerations;
mod branch_averaging;
mod constraint_violation;
mod energies;
mod failure;
mod initial_stiffness;
mod lane_batch;
mod method_options;
mod method_switching;
mod methods;
mod model_cache;
mod motion_dae;
mod motion_ode;
mod options;
mod prepared;
mod recorder;
mod report_projection;
mod singularity_forecast;
mod singularity_passage;
mod stabilizations;
mod stiffness_detection;

pub use accelerations::{Accelerations, States};
pub use energies::ENERGIES;
pub use failure::{Failure, Reason};
pub use methods::{Auto, Scheme};
pub use options::{most_steps, read, Options, Output};
pub use prepared::Prepared;
pub use recorder::{PiecewiseInterpolant, Trajectory};
pub use singularity_passage::Singularity;
pub use stabilizations::Stabilization;
pub use stiffness_detection::MethodChoice;

use super::State;
use crate::integrate::{self, Cause, Ended, Flow, ImplicitMethod, Method, Observer, Step};
use crate::model::Model;
use crate::stabilize::Fault;
use method_switching::MethodSwitching;
use model_cache::ModelCache;
use motion_dae::MotionDae;
use motion_ode::{MotionOde, WORKS};
use recorder::Recorder;
use std::time::Instant;

/// What an integration took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected steps.
    pub rejected: usize,
    /// Evaluations of the equations of motion, without those for the output.
    pub evaluations: usize,
    /// Tangents of the equations of motion; zero for explicit methods.
    pub jacobians: usize,
    /// Steps of Newton's iteration; zero for explicit methods.
    pub iterations: usize,
    /// Factorisations of the augmented matrix, with those for the output, and of the matrices of
    /// Newton's iteration.
    pub factorisations: usize,
    /// Wall time, s.
    pub seconds: f64,
}

/// The outcome of forward dynamics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Reported states.
    pub trajectory: Trajectory,
    /// Continuous extension, if it was asked for.
    pub dense: Option<PiecewiseInterpolant>,
    /// What it took.
    pub statistics: Statistics,
    /// The method that was chosen, where none was named.
    pub choice: Option<MethodChoice>,
    /// Whether t_end was reached; otherwise the observer stopped it.
    pub reached: bool,
    /// Whether it passes singular positions, as runs with projection do.
    pub passing: bool,
}

/// Integrates the equations of motion from `start` to `options.t_end`.
///
/// `watch` sees the time after each step and may stop the run.
///
/// # Errors
/// [`Failure`], with everything computed so far.
pub fn dynamics(
    model: &Model,
    start: &State,
    options: &Options,
    watch: impl FnMut(f64) -> Flow,
) -> Result<Run, Box<Failure>> {
    Prepared::new(model).dynamics(start, options, watch)
}

/// The same, but `look` sees every accepted step with its continuous extension, after what is reported of
/// it, and may stop the run; [`locate`](crate::integrate::locate) finds events in it. Of each y = (q, v, works)
/// both ends are as the stabilization leaves them, what lies between by the extension alone.
///
/// # Errors
/// As [`dynamics`].
pub fn dynamics_by_steps(
    model: &Model,
    start: &State,
    options: &Options,
    mut look: impl FnMut(&Step<'_>) -> Flow,
) -> Result<Run, Box<Failure>> {
    let watch = |_| Flow::Continue;
    let eyes = Eyes { watch, look: Some(&mut look) };
    simulate((model, &ModelCache::default()), start, options, eyes)
}

/// What the caller sees of a run.
struct Eyes<'l, W> {
    /// The time after each step and each reported state.
    watch: W,
    /// Each step.
    look: Option<&'l mut dyn FnMut(&Step<'_>) -> Flow>,
}

fn simulate<W: FnMut(f64) -> Flow>(
    (model, cache): (&Model, &ModelCache),
    start: &State,
    options: &Options,
    eyes: Eyes<'_, W>,
) -> Result<Run, Box<Failure>> {
    // WebAssembly has no clock of its own
    let clock = (!cfg!(target_family = "wasm")).then(Instant::now);
    options.check(model, start).map_err(|reason| Failure { reason, run: Run::default() })?;
    let mut system = MotionOde::new(model, options, cache.plan(model));
    let t0 = options.t_start.unwrap_or(start.t);
    let wide = recorder::many(options.output_step, options.t_end - t0).then(|| cache.wide(model));
    let mut recorder = Recorder::new(&system, wide, options, t0);
    let mut y: Vec<f64> = start.q.iter().chain(&start.v).copied().collect();
    y.resize(y.len() + WORKS, 0.0);
    system.project(t0, &mut y, false).map_err(|(t, fault)| Failure {
        reason: Reason::fault(model, t, &start.q, fault),
        run: Run::default(),
    })?;
    system.begin(t0, &y).map_err(|singular| Failure {
        reason: Reason::singular(model, t0, &start.q, singular),
        run: Run::default(),
    })?;
    let first = recorder.begin(t0, &y);
    if first == Flow::Stop {
        let nothing = (Ok(integrate::Statistics::none(t0)), 0, None);
        return finish(system, recorder, nothing, (clock, start));
    }
    let mut observer = Watched { recorder: &mut recorder, eyes };
    let end = integrate_by(options, &mut system, t0, &mut y, &mut observer);
    finish(system, recorder, end, (clock, start))
}

/// How the integration ended; factorisations beside those that it counts itself; what was chosen.
type End = (Outcome, usize, Option<MethodChoice>);

fn integrate_by<'a, O: Observer>(
    options: &'a Options,
    system: &mut MotionOde<'a>,
    t0: f64,
    y: &mut [f64],
    observer: &mut O,
) -> End {
    let (model, t_end) = (system.model, options.t_end);
    let explicit = |outcome: Result<integrate::Statistics, integrate::Failure<_>>| -> End {
        let outcome = outcome.map_err(Box::new);
        let evaluations = taken(&outcome).evaluations;
        (outcome, evaluations, None)
    };
    match &options.bounded_method(model) {
        Scheme::Rk45(method) => explicit(method.integrate(system, t0, t_end, y, observer)),
        Scheme::Dop853(method) => explicit(method.integrate(system, t0, t_end, y, observer)),
        Scheme::Rk4(method) => explicit(method.integrate(system, t0, t_end, y, observer)),
        Scheme::GeneralizedAlpha(method) => {
            let mut implicit = MotionDae::new(model, options);
            let outcome = method.integrate(&mut implicit, t0, t_end, y, observer);
            (outcome.map_err(Box::new), implicit.factorisations(), None)
        }
        Scheme::Radau(method) => {
            let mut implicit = MotionDae::new(model, options);
            let outcome = method.integrate(&mut implicit, t0, t_end, y, observer);
            (outcome.map_err(Box::new), implicit.factorisations(), None)
        }
        Scheme::Auto(auto) => {
            let mut automatic = MethodSwitching::new(system, options, auto, t0);
            let outcome = automatic.run(system, t0, y, observer);
            (outcome, automatic.factorisations(), Some(automatic.choice))
        }
    }
}

/// Output first, then the caller's eyes.
struct Watched<'r, 'a, 'l, W> {
    recorder: &'r mut Recorder<'a>,
    eyes: Eyes<'l, W>,
}

impl<W: FnMut(f64) -> Flow> Observer for Watched<'_, '_, '_, W> {
    fn step(&mut self, step: &Step<'_>) -> Flow {
        let Eyes { watch, look } = &mut self.eyes;
        let mut flow = self.recorder.step(step, watch);
        if flow == Flow::Continue {
            flow = watch(step.t);
        }
        match look {
            Some(look) if flow == Flow::Continue => look(step),
            _ => flow,
        }
    }

    fn looks_inside(&self, _: f64, t: f64) -> bool {
        self.eyes.look.is_some() || self.recorder.looks_inside(t)
    }
}

type Outcome = Result<integrate::Statistics, Box<integrate::Failure<(f64, Fault)>>>;

fn taken(outcome: &Outcome) -> integrate::Statistics {
    match outcome {
        Ok(statistics) => *statistics,
        Err(failure) => failure.statistics,
    }
}

fn finish(
    system: MotionOde<'_>,
    mut recorder: Recorder<'_>,
    (outcome, factorisations, choice): End,
    (clock, start): (Option<Instant>, &State),
) -> Result<Run, Box<Failure>> {
    recorder.flush();
    let reports = recorder.factorisations();
    let Recorder { trajectory, dense, halt, .. } = recorder;
    let model = system.model;
    let n = model.layout.n_q;
    let took = taken(&outcome);
    let statistics = Statistics {
        steps: took.steps,
        rejected: took.rejected,
        evaluations: took.evaluations,
        jacobians: took.jacobians as usize,
        iterations: took.iterations as usize,
        factorisations: factorisations
            + took.factorisations as usize
            + system.factorisations()
            + reports,
        seconds: clock.map_or(0.0, |clock| clock.elapsed().as_secs_f64()),
    };
    let reached = outcome.as_ref().is_ok_and(|s| s.ended == Ended::Reached);
    let last = trajectory.q.rchunks(n.max(1)).next().unwrap_or(&start.q).to_vec();
    let passing = system.passing;
    let run = Run { trajectory, dense, statistics, choice, reached, passing };
    let reason = match (outcome, halt) {
        (Ok(_), None) => return Ok(run),
        (Err(failure), _) => match (&failure.cause, system.passage.undecided) {
            (Cause::NotFinite { .. }, Some((t, fault))) => {
                Reason::fault(model, t, &failure.y[..n], fault)
            }
            _ => Reason::from_integrator(model, *failure),
        },
        (_, Some((t, halt))) => Reason::halt(model, t, &last, halt),
    };
    Err(Box::new(Failure { reason, run }))
}
