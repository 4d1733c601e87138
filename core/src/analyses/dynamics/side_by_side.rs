//! Runs of several variants of a model side by side: up to four take their steps together, one in each lane.
//!
//! Each run has its own time and step. A run that ends is replaced by the next run. If a step needs more than the
//! ordinary evaluation (`integrate/lane_steps.rs`), the run takes this step alone. The results therefore agree with
//! the results of a separate run to the last bit.

use super::failure::Failure;
use super::guard::{self, Guard};
use super::lane_motion::{LaneEquations, LaneMotion};
use super::methods::Scheme;
use super::modes::has_modes;
use super::motion_ode::tests_works;
use super::options::Options;
use super::prepared::Prepared;
use super::recorder::Recorder;
use super::run::{begin_phase, end_phase, Phase, PhaseEnd, PhaseSteps, Progress};
use super::run_results::Run;
use super::setting::Setting;
use super::stabilizations::Stabilization;
use crate::analyses::State;
use crate::integrate::{Flow, LaneSteps, Steppers, Taken};
use crate::math::Lanes;
use crate::model::{usual_energy, Model};
use std::sync::Arc;

const WIDTH: usize = Lanes::WIDTH;

/// A run: its model, start and options.
pub struct Variant<'a> {
    /// The model.
    pub prepared: &'a Prepared<Arc<Model>>,
    /// The start.
    pub start: &'a State,
    /// The options.
    pub options: &'a Options,
}

/// The result of a run.
pub type RunOutcome = Result<Run, Box<Failure>>;

impl Variant<'_> {
    /// Whether the run can take its steps side by side with others: by an explicit method with error control, without
    /// events, switches, tests of works, or outputs between start and end.
    pub fn serves(&self) -> bool {
        let Options { method, stabilization, events, stop, output_step, .. } = self.options;
        let model: &Model = self.prepared.model();
        let explicit = matches!(method, Scheme::Auto(_) | Scheme::Dop853(_) | Scheme::Rk45(_));
        let span = (self.options.t_end - self.start.t).abs();
        explicit
            && method.control().step.is_none()
            && *stabilization != Stabilization::BaumgarteFromStep
            && events.is_empty()
            && stop.is_none()
            && output_step.is_some_and(|h| h > span)
            && Setting::of(self.options).is_plain()
            && model.switches.is_empty()
            && !tests_works(model)
            && !has_modes(model)
            && model.constraints.iter().all(|item| item.element.release().is_none())
    }
}

/// A run that has not ended.
struct Underway<'a> {
    /// Index among the variants.
    place: usize,
    prepared: &'a Prepared<Arc<Model>>,
    options: &'a Options,
    at: Progress,
    run: Run,
    recorder: Recorder<'a>,
    steps: PhaseSteps<'a>,
}

impl<'a> Underway<'a> {
    /// Begins a run. Returns its result if it ends at once.
    fn begin(place: usize, variant: &Variant<'a>) -> Result<Self, Box<RunOutcome>> {
        let Variant { prepared, start, options } = variant;
        let model: &'a Model = prepared.model();
        let mut run = Run::default();
        if let Err(failure) = options.check(model, start) {
            return Err(Box::new(Err(failure)));
        }
        let mut at = Progress::begin(model, start, options, &mut run);
        run.settings.push(Setting::of(options));
        let phase = Phase { model, cache: prepared.cache(), project_velocities: false };
        match begin_phase(phase, Vec::new(), &mut at, options, &mut run) {
            Err(failure) => Err(Box::new(Err(Box::new(Failure { run, ..*failure })))),
            Ok((Ok(Some(steps)), recorder)) => {
                Ok(Self { place, prepared, options, at, run, recorder, steps })
            }
            Ok((stopped, recorder)) => {
                let outcome = stopped.map(|_| PhaseEnd::Stopped);
                Err(Box::new(conclude((prepared, options), recorder, &at, outcome, run)))
            }
        }
    }

    /// Takes a step alone, or processes a step that was taken side by side. Returns whether the run continues.
    fn go_on(&mut self, beside: bool, watch: &dyn Fn() -> Flow) -> Result<bool, Box<Failure>> {
        let mut each_step = |_| watch();
        let observers = (&mut self.recorder, &mut each_step);
        let ended = match beside {
            true => {
                self.steps.stepper.after_step_beside_others();
                self.steps.follow(observers, &mut self.run)?
            }
            false => self.steps.step(observers, &mut self.run)?,
        };
        Ok(ended.is_none() && self.steps.reached(&self.recorder).is_none())
    }

    fn end(mut self, outcome: Result<(), Box<Failure>>) -> RunOutcome {
        let reached = self.steps.reached(&self.recorder);
        let outcome = outcome.map(|()| reached.unwrap_or(PhaseEnd::Stopped));
        self.steps.end(&mut self.at, &mut self.run);
        conclude((self.prepared, self.options), self.recorder, &self.at, outcome, self.run)
    }
}

fn conclude(
    (prepared, options): (&Prepared<Arc<Model>>, &Options),
    recorder: Recorder<'_>,
    at: &Progress,
    outcome: Result<PhaseEnd, Box<Failure>>,
    mut run: Run,
) -> RunOutcome {
    let model: &Model = prepared.model();
    match end_phase(model, recorder, at, outcome, &mut run) {
        Ok(PhaseEnd::Reached) => {
            run.reached = true;
            let mut guard = Guard::new(usual_energy(model), options);
            guard.look((model, prepared.cache()), &run, true);
            guard::end(&guard, model, run)
        }
        Ok(_) => Ok(run),
        Err(failure) => Err(Box::new(Failure { run, ..*failure })),
    }
}

/// Numbers of trial steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Trials {
    /// Taken side by side.
    pub beside: usize,
    /// Taken alone.
    pub alone: usize,
}

/// Integrates variants of one model, which differ in the [values of parameters](Model::with_values). All variants
/// must [be suitable](Variant::serves). `watch` may stop all runs. `done` receives each result with the index of its
/// variant once it is complete, so that few interpolants exist at a time.
pub fn side_by_side(
    variants: &[Variant<'_>],
    watch: &dyn Fn() -> Flow,
    done: &mut dyn FnMut(usize, RunOutcome),
) -> Trials {
    let mut trials = Trials::default();
    let mut waiting = variants.iter().enumerate();
    let mut lanes: [Option<Underway<'_>>; WIDTH] = Default::default();
    let keeps_stages = variants.iter().any(|variant| variant.options.dense_output);
    let (mut steps, mut motion) = (LaneSteps::new(keeps_stages), None);
    // whether the runs in the lanes differ from the runs in the model over lanes
    let mut stale = false;
    loop {
        for lane in lanes.iter_mut().filter(|lane| lane.is_none()) {
            *lane = next(&mut waiting, done);
            stale |= lane.is_some();
        }
        if lanes.iter().all(Option::is_none) {
            break;
        }
        if std::mem::take(&mut stale) {
            motion = over_lanes(&lanes);
        }
        let taken = round(&mut lanes, &mut motion, &mut steps);
        for (lane, taken) in lanes.iter_mut().zip(taken) {
            let Some(run) = lane else { continue };
            let is_alone = taken == Taken::Alone;
            *(if is_alone { &mut trials.alone } else { &mut trials.beside }) += 1;
            let goes_on = match taken {
                Taken::Rejected => Ok(true),
                _ => run.go_on(!is_alone, watch),
            };
            if !matches!(goes_on, Ok(true)) {
                let place = run.place;
                if let Some(run) = lane.take() {
                    done(place, run.end(goes_on.map(|_| ())));
                }
                stale = true;
            }
        }
    }
    trials
}

/// Begins the next run that does not end at once.
fn next<'v, 'a: 'v>(
    waiting: &mut impl Iterator<Item = (usize, &'v Variant<'a>)>,
    done: &mut dyn FnMut(usize, RunOutcome),
) -> Option<Underway<'a>> {
    waiting.find_map(|(place, variant)| match Underway::begin(place, variant) {
        Ok(run) => Some(run),
        Err(outcome) => {
            done(place, *outcome);
            None
        }
    })
}

/// The equations of the runs over lanes; empty lanes repeat a run. None for fewer than two runs, or if the structures
/// of their equations differ.
fn over_lanes(lanes: &[Option<Underway<'_>>; WIDTH]) -> Option<LaneMotion> {
    let first = lanes.iter().flatten().next().filter(|_| lanes.iter().flatten().count() > 1)?;
    let ode = |lane: usize| &lanes[lane].as_ref().unwrap_or(first).steps.stepper.ode;
    LaneMotion::new(std::array::from_fn(ode))
}

/// Takes a trial step of each run that can take it side by side.
fn round(
    lanes: &mut [Option<Underway<'_>>; WIDTH],
    motion: &mut Option<LaneMotion>,
    steps: &mut LaneSteps,
) -> [Taken; WIDTH] {
    let Some(motion) = motion else { return [Taken::Alone; WIDTH] };
    let mut steppers: Steppers<'_, '_> = Default::default();
    let mut equations = LaneEquations { motion, lanes: Default::default() };
    for (lane, run) in lanes.iter_mut().enumerate() {
        let beside = run.as_mut().and_then(|run| run.steps.stepper.side_by_side());
        if let Some((ode, stepper)) = beside {
            equations.lanes[lane] = Some(ode);
            steppers[lane] = Some(stepper);
        }
    }
    steps.step(&mut steppers, &mut equations)
}
