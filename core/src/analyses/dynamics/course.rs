//! The course of a run with events: phases, each with the drivers and parameters that hold in it.
//!
//! An event that only lists its times does not end a phase. A phase ends where the run stops, a driver is released, a
//! force changes its mode or the caller acts. The next phase begins there, with its own model.
//!
//! A course can pause at a time and continue later: it is plain data between two phases.

use super::clock::Clock;
use super::failure::{Failure, Reason};
use super::guard::{self, Guard};
use super::model_cache::ModelCache;
use super::modes::{self, Ended, StateAt};
use super::option_checks::check_lengths;
use super::options::{ImpactLaws, Options};
use super::paradoxes::Paradoxes;
use super::passages::Passage;
use super::planned_events::{conditions, ended, planned, watched, Effect, Planned};
use super::run::{run_phase, Phase, PhaseEnd, Progress};
use super::run_results::{EventStates, Run};
use super::setting::Setting;
use super::stall::Stall;
use super::start_check::StartCheck;
use crate::analyses::conditions::Condition;
use crate::analyses::State;
use crate::elements::Mode;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::{usual_energy, Model, Problem};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The changes that a caller makes at an event, or between the parts of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// New values of parameters by name.
    pub parameters: Vec<(String, f64)>,
    /// A new state at the same time, which must meet the constraints.
    pub state: Option<State>,
}

/// Called with the name of an event, the state there, and the setting until then; None ends the run.
pub type Act<'a> = &'a mut dyn FnMut(&str, &State, &Setting) -> Option<Change>;

/// A model of a phase.
#[derive(Debug)]
struct Own {
    model: Model,
    cache: ModelCache,
}

impl Own {
    fn of(base: &Model, setting: &Setting, t: f64) -> Result<Option<Arc<Self>>, Box<Failure>> {
        if setting.is_plain() {
            return Ok(None);
        }
        let model = setting.model(base).map_err(|problems| impossible(&problems, t))?;
        Ok(Some(Arc::new(Self { model, cache: ModelCache::default() })))
    }
}

/// The failure of parameters with impossible values.
fn impossible(problems: &[Problem], t: f64) -> Box<Failure> {
    let all: Vec<String> = problems.iter().map(ToString::to_string).list();
    let message = format!("the parameters at t = {t:.6} s: {}", all.join("; "));
    Reason::Option { name: "parameters", message }.into()
}

/// Runs a model through its phases.
pub(super) fn run(
    base: (&Model, &ModelCache),
    start: &State,
    options: &Options,
    clock: Clock,
    mut watch: impl FnMut(f64) -> Flow,
    mut act: Option<Act<'_>>,
) -> Result<Run, Box<Failure>> {
    let (began, mut run) = (clock(), Run::default());
    let mut course = PhasedRun::begin(base.0, start, options, &mut run)?;
    let outcome = course.proceed(base, options, &mut run, (&mut watch, &mut act));
    run.statistics.seconds = clock() - began;
    match outcome {
        Ok(()) => guard::end(&course.guard, base.0, run),
        Err(failure) => Err(Box::new(Failure { run, ..*failure })),
    }
}

/// A run between two of its phases.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct PhasedRun {
    #[serde(skip)]
    events: Arc<Vec<Planned>>,
    setting: Setting,
    /// The model of this setting; None for the model of the run.
    #[serde(skip)]
    own: Option<Arc<Own>>,
    /// The conditions of the events, for this model.
    #[serde(skip)]
    conditions: Arc<Vec<Option<Condition>>>,
    pub at: Progress,
    laws: ImpactLaws,
    paradoxes: Paradoxes,
    stall: Stall,
    pub guard: Guard,
}

impl PhasedRun {
    /// Begins a run and creates its tables.
    pub fn begin(
        base: &Model,
        start: &State,
        options: &Options,
        run: &mut Run,
    ) -> Result<Self, Box<Failure>> {
        let (setting, events) = (Setting::of(options), planned(base, options));
        run.events = named(&events);
        let own = Own::of(base, &setting, start.t)?;
        options.check(own.as_ref().map_or(base, |own| &own.model), start)?;
        let mut course = Self {
            events: Arc::new(events),
            setting,
            own,
            conditions: Arc::default(),
            at: Progress::begin(base, start, options, run),
            laws: options.impact_laws(),
            paradoxes: Paradoxes::default(),
            stall: Stall::default(),
            guard: Guard::new(usual_energy(base), options),
        };
        let mut passage = Passage::default();
        if base.forces.iter().any(|item| item.element.keeps_speed()) {
            let model = course.own.as_ref().map_or(base, |own| &own.model);
            StateAt::new(model, course.at.t, &mut course.at.y).keep_speeds_of_closed(model)?;
        }
        if modes::has_modes(base) {
            let model = course.own.as_ref().map_or(base, |own| &own.model);
            check_modes(model, start, options, (&mut course.at, &course.events))?;
            course.settle(base, (run, &mut passage))?;
            course.own = Own::of(base, &course.setting, course.at.t)?;
        }
        run.note(passage);
        course.read_conditions(base)?;
        Ok(course)
    }

    /// Adds the tables that were not written with a course: those of another course of the same model and options.
    pub fn link(&mut self, base: &Model, other: &Self) -> Result<(), Box<Failure>> {
        let fits = self.at.y.len() == base.layout.n_y()
            && self.at.fired.iter().all(|index| *index < other.events.len())
            && self.setting.modes.iter().all(|of| of.force < base.forces.len());
        if !fits {
            let message = "the state is that of another model".to_string();
            return Err(Reason::Option { name: "state", message }.into());
        }
        self.events = Arc::clone(&other.events);
        self.own = Own::of(base, &self.setting, self.at.t)?;
        self.read_conditions(base)
    }

    /// The events of a part of the run, which have not occurred.
    pub fn events(&self) -> Vec<EventStates> {
        named(&self.events)
    }

    /// The model of the next phase.
    pub fn model<'a>(&'a self, base: &'a Model) -> &'a Model {
        self.own.as_ref().map_or(base, |own| &own.model)
    }

    /// The setting of the next phase.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    /// Runs through phases to the end of the options, or to the event or the caller that stops the run.
    pub fn proceed(
        &mut self,
        base: (&Model, &ModelCache),
        options: &Options,
        run: &mut Run,
        (watch, act): (&mut impl FnMut(f64) -> Flow, &mut Option<Act<'_>>),
    ) -> Result<(), Box<Failure>> {
        loop {
            let own = self.own.clone();
            let (model, cache) = own.as_deref().map_or(base, |own| (&own.model, &own.cache));
            let released = &self.setting.released;
            let watched = watched(model, &self.events, &self.conditions, released, options);
            run.settings.push(self.setting.clone());
            let phase = Phase { model, cache, project_velocities: holds(&self.setting) };
            let outcome = run_phase(phase, watched, &mut self.at, options, run, watch);
            self.guard.look((model, cache), run, outcome.is_ok());
            let Self { paradoxes, setting, at, laws, .. } = self;
            match outcome.or_else(|e| paradoxes.end((base.0, setting, laws.jam), at, e))? {
                PhaseEnd::Reached => {
                    run.reached = true;
                    return Ok(());
                }
                PhaseEnd::Stopped => return Ok(()),
                PhaseEnd::Event => {}
            }
            let before = self.setting.clone();
            if self.pass(base.0, options, act, run)? == Flow::Stop {
                return Ok(());
            }
            self.at.jumped &= self.setting.differs_in_modes_only(&before);
            if self.setting != before {
                self.change_model(base.0, options)?;
            }
        }
    }

    /// Makes a change of the caller while the course pauses.
    pub fn change(
        &mut self,
        base: &Model,
        options: &Options,
        change: Change,
        run: &mut Run,
    ) -> Result<(), Box<Failure>> {
        let (before, mut passage) = (self.setting.clone(), Passage::default());
        self.apply(base, options, change, &mut passage)?;
        if modes::has_modes(base) {
            self.settle(base, (run, &mut passage))?;
        }
        self.at.resume_changed();
        if self.setting != before {
            self.change_model(base, options)?;
        }
        Ok(())
    }

    /// Goes from a phase to the next one. Returns whether the run continues.
    fn pass(
        &mut self,
        base: &Model,
        options: &Options,
        act: &mut Option<Act<'_>>,
        run: &mut Run,
    ) -> Result<Flow, Box<Failure>> {
        let mut passage = Passage { fired: self.at.fired.clone(), ..Passage::default() };
        let flow = self.take_effect(base, options, act, (run, &mut passage))?;
        if flow == Flow::Continue && modes::has_modes(base) {
            self.stall.look(base, self.at.t, &self.setting)?;
            let ended = ended(&self.events, &self.at.fired);
            self.paradoxes.look((base, &self.setting), &mut self.at, &ended);
            self.settle(base, (run, &mut passage))?;
        }
        self.at.jumped &= passage.impacts.is_empty() && !passage.replaced;
        run.note(passage);
        Ok(flow)
    }

    /// Builds the model of the next phase and checks that the state meets its constraints.
    fn change_model(&mut self, base: &Model, options: &Options) -> Result<(), Box<Failure>> {
        self.own = Own::of(base, &self.setting, self.at.t)?;
        let model = self.model(base);
        let [q, v, z, _] = model.layout.split(&self.at.y);
        let check = StartCheck::of_change(options);
        // a force that begins to hold has a small speed, which the projection at the start of the phase removes
        let check = if holds(&self.setting) { check.of_positions() } else { check };
        check.check(model, self.at.t, [q, v, z])?;
        self.read_conditions(base)
    }

    fn read_conditions(&mut self, base: &Model) -> Result<(), Box<Failure>> {
        let model = self.model(base);
        self.conditions = Arc::new(conditions(model, &self.setting, &self.events)?);
        Ok(())
    }

    /// Decides the modes of the next phase; velocities jump where contacts hit.
    fn settle(
        &mut self,
        base: &Model,
        (run, passage): (&mut Run, &mut Passage),
    ) -> Result<(), Box<Failure>> {
        let fired = ended(&self.events, &self.at.fired);
        let Self { events, at, setting, laws, paradoxes, stall, .. } = self;
        let open = setting.open(base).map_err(|problems| impossible(&problems, at.t))?;
        let (t, before) = (at.t, at.y.clone());
        let mut place = StateAt::new(&*open, t, &mut at.y);
        let ended = Ended { fired, ceased: stall.ceased.clone(), lost: paradoxes.take() };
        let settled = modes::settle(&open, &mut place, &setting.modes, &ended, *laws)?;
        stall.note(&setting.modes, &settled.modes);
        let index = |force: usize, of: usize| {
            let wanted = Effect::Mode { force, place: of };
            events.iter().position(|event| event.effect == wanted).expect("it was planned")
        };
        for (k, of) in settled.struck() {
            let index = index(k, of);
            run.add_event(&base.layout, index, t, &before);
            let index = run.listed(index);
            run.events[index].impulses.extend(&settled.impulses);
        }
        for (k, of) in &settled.changed {
            run.add_event(&base.layout, index(*k, *of), t, &before);
        }
        paradoxes.tell((&*open, &place), &settled, run);
        setting.modes = settled.modes;
        (passage.impacts, passage.collapsed) = (settled.impacts, settled.collapsed);
        passage.couples |= settled.couples;
        Ok(())
    }

    /// Carries out the events that ended a phase, in their order. Returns whether the run continues.
    fn take_effect(
        &mut self,
        base: &Model,
        options: &Options,
        act: &mut Option<Act<'_>>,
        (run, passage): (&mut Run, &mut Passage),
    ) -> Result<Flow, Box<Failure>> {
        let events = Arc::clone(&self.events);
        for index in self.at.fired.clone() {
            let event = &events[index];
            match &event.effect {
                Effect::Mode { force, place: 0 } if base.forces[*force].element.keeps_speed() => {
                    let (model, t) = (self.own.as_ref().map_or(base, |own| &own.model), self.at.t);
                    StateAt::new(model, t, &mut self.at.y).keep_speed(model, *force);
                }
                Effect::None | Effect::Mode { .. } => {}
                Effect::Release(driver) => self.setting.released.push(driver.clone()),
                Effect::Stop(count) if self.at.occurred(run, index) < *count => {}
                Effect::Stop(_) => {
                    run.stopped_by = Some(event.name.clone());
                    return Ok(Flow::Stop);
                }
                Effect::Act => {
                    let state = self.at.state(base);
                    let change =
                        act.as_mut().and_then(|act| act(&event.name, &state, &self.setting));
                    let Some(change) = change else { return Ok(Flow::Stop) };
                    self.apply(base, options, change, passage)?;
                }
            }
        }
        Ok(Flow::Continue)
    }

    /// Applies a change of the caller. The energy balance allows for the energy that it adds.
    fn apply(
        &mut self,
        base: &Model,
        options: &Options,
        change: Change,
        passage: &mut Passage,
    ) -> Result<(), Box<Failure>> {
        let energy = |course: &Self| {
            let found = course.setting.energy(base, course.at.t, &course.at.y);
            found.map_err(|problems| impossible(&problems, course.at.t))
        };
        let before = energy(self)?;
        change.parameters.into_iter().for_each(|(name, value)| self.setting.put(name, value));
        if let Some(state) = change.state {
            passage.replaced = true;
            self.put(base, options, &state)?;
        }
        self.guard.allow(energy(self)? - before);
        Ok(())
    }

    /// Replaces the state; it must meet the constraints.
    fn put(&mut self, base: &Model, options: &Options, state: &State) -> Result<(), Box<Failure>> {
        check_lengths(base, state)?;
        let own = Own::of(base, &self.setting, self.at.t)?;
        let model = own.as_ref().map_or(base, |own| &own.model);
        StartCheck::of_change(options).check(model, self.at.t, [&state.q, &state.v, &state.z])?;
        let [q, v, z, _] = base.layout.split_mut(&mut self.at.y);
        q.copy_from_slice(&state.q);
        v.copy_from_slice(&state.v);
        z.copy_from_slice(&state.z);
        Ok(())
    }
}

/// The events of a run, which have not occurred.
fn named(events: &[Planned]) -> Vec<EventStates> {
    let named = |event: &Planned| EventStates { name: event.name.clone(), ..Default::default() };
    events.iter().map(named).list()
}

/// Checks a start with forces that have modes.
fn check_modes(
    model: &Model,
    start: &State,
    options: &Options,
    (at, events): (&mut Progress, &[Planned]),
) -> Result<(), Box<Failure>> {
    StartCheck::of_run(options).check(model, at.t, [&start.q, &start.v, &start.z])?;
    let released = |event: &Planned| match &event.effect {
        Effect::Release(driver) => Some(driver.clone()),
        _ => None,
    };
    let later: Vec<String> = events.iter().filter_map(released).list();
    modes::check(model, &StateAt::new(model, at.t, &mut at.y), &later)
}

/// Whether any force holds in a phase.
fn holds(setting: &Setting) -> bool {
    setting.modes.iter().any(|of| matches!(of.mode, Mode::Holds(_)))
}
