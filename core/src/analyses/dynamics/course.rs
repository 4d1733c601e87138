//! The course of a run with events: phases, each with the drivers and parameters that hold in it.
//!
//! An event that only lists its times does not end a phase. A phase ends where the run stops, a driver is released, a
//! force changes its mode or the caller acts. The next phase begins there, with its own model.

use super::clock::Clock;
use super::event_list::{EventFunction, Watched};
use super::failure::{Failure, Reason};
use super::guard::{self, Guard};
use super::model_cache::ModelCache;
use super::modes::{self, watched_mode, StateAt};
use super::option_checks::check_lengths;
use super::options::Options;
use super::passages::Passage;
use super::run::{run_phase, Phase, PhaseEnd, Progress};
use super::run_results::{EventStates, Run};
use super::setting::Setting;
use super::stall::Stall;
use super::start_check::StartCheck;
use crate::analyses::conditions::Condition;
use crate::analyses::event_options::STOP;
use crate::analyses::State;
use crate::elements::Mode;
use crate::integrate::{Direction, Flow};
use crate::math::Listed;
use crate::model::{usual_energy, Model, Problem};

/// The changes that a caller makes at an event.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Change {
    /// New values of parameters by name.
    pub parameters: Vec<(String, f64)>,
    /// A new state at the same time, which must meet the constraints.
    pub state: Option<State>,
}

/// Called with the name of an event, the state there, and the setting until then; None ends the run.
pub type Act<'a> = &'a mut dyn FnMut(&str, &State, &Setting) -> Option<Change>;

/// The effect of an event.
#[derive(Clone, PartialEq)]
pub(in crate::analyses) enum Effect {
    /// The event is listed, and nothing else.
    None,
    /// The run ends when the event occurs this number of times.
    Stop(usize),
    /// The caller acts.
    Act,
    /// This driver no longer acts.
    Release(String),
    /// The mode of a force may change. `place` is the index among the events of its behaviour.
    Mode { force: usize, place: usize },
}

/// An event of the whole run.
pub(in crate::analyses) struct Planned {
    pub name: String,
    pub condition: String,
    direction: Direction,
    pub effect: Effect,
}

/// Largest error of a step at which a gap counts as open, relative to the size of the mechanism.
const LOOSEST: f64 = 1e-10;

/// The name of the event at which a driver is released.
fn release_of(driver: &str) -> String {
    format!("{driver}.release")
}

/// The events of a run, in the order in which they take effect.
pub(in crate::analyses) fn planned(model: &Model, options: &Options) -> Vec<Planned> {
    let listed = options.events.iter().map(|event| Planned {
        name: event.name.clone(),
        condition: event.condition.clone(),
        direction: event.direction,
        effect: match (event.stop, event.acts) {
            (Some(count), _) => Effect::Stop(count),
            (_, true) => Effect::Act,
            _ => Effect::None,
        },
    });
    let stop = options.stop.iter().map(|condition| Planned {
        name: STOP.to_string(),
        condition: condition.clone(),
        direction: Direction::Any,
        effect: Effect::Stop(1),
    });
    let releases = model.constraints.iter().filter_map(|driver| {
        Some(Planned {
            name: release_of(&driver.name),
            condition: driver.element.release()?.to_string(),
            direction: Direction::Any,
            effect: Effect::Release(driver.name.clone()),
        })
    });
    let modes = model.forces.iter().enumerate().flat_map(|(force, item)| {
        let names = item.element.behaviour().map_or(&[][..], |behaviour| behaviour.events());
        let named = names.iter().enumerate();
        named.map(move |(place, name)| Planned {
            name: format!("{}.{name}", item.name),
            condition: String::new(),
            direction: Direction::Any,
            effect: Effect::Mode { force, place },
        })
    });
    listed.chain(stop).chain(releases).chain(modes).list()
}

/// A model of a phase.
struct Own {
    model: Model,
    cache: ModelCache,
}

impl Own {
    fn of(base: &Model, setting: &Setting, t: f64) -> Result<Option<Box<Self>>, Box<Failure>> {
        if setting.is_plain() {
            return Ok(None);
        }
        let model = setting.model(base).map_err(|problems| impossible(&problems, t))?;
        Ok(Some(Box::new(Self { model, cache: ModelCache::default() })))
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
    let (began, mut setting) = (clock(), Setting::of(options));
    let events = planned(base.0, options);
    let named = |event: &Planned| EventStates { name: event.name.clone(), ..Default::default() };
    let mut run = Run { events: events.iter().map(named).list(), ..Run::default() };
    let mut own = Own::of(base.0, &setting, start.t)?;
    options.check(own.as_ref().map_or(base.0, |own| &own.model), start)?;
    let mut at = Progress::begin(base.0, start, options, &mut run);
    let (mut stall, mut guard) = (Stall::default(), Guard::new(usual_energy(base.0), options));
    let mut passage = Passage::default();
    if modes::has_modes(base.0) {
        check_modes(own.as_ref().map_or(base.0, |own| &own.model), start, options, &mut at)?;
        settle(&events, &mut at, (base.0, &mut setting), (&mut run, &mut passage))?;
        own = Own::of(base.0, &setting, at.t)?;
    }
    run.note(passage);
    loop {
        let (model, cache) = own.as_ref().map_or(base, |own| (&own.model, &own.cache));
        let conditions = conditions(model, &setting, &events)?;
        let watched = watched(model, &events, &conditions, &setting.released, options);
        run.settings.push(setting.clone());
        let phase = Phase { model, cache, project_velocities: holds(&setting) };
        let outcome = run_phase(phase, watched, &mut at, options, &mut run, &mut watch);
        guard.look((model, cache), &run, outcome.is_ok());
        run.statistics.seconds = clock() - began;
        let ended = outcome.and_then(|ended| match ended {
            PhaseEnd::Reached => {
                run.reached = true;
                Ok(None)
            }
            PhaseEnd::Stopped => Ok(None),
            PhaseEnd::Event => {
                let before = setting.clone();
                let (changing, calls) = ((base.0, &mut setting), (&mut act, &mut guard));
                let flow =
                    pass(&events, &mut at, changing, (options, &mut stall), calls, &mut run)?;
                Ok((flow == Flow::Continue).then_some(before))
            }
        });
        let before = match ended {
            Ok(None) => return guard::end(&guard, base.0, run),
            Ok(Some(before)) => before,
            Err(failure) => return Err(Box::new(Failure { run, ..*failure })),
        };
        if setting != before {
            own = match changed(base.0, &setting, &at, options) {
                Ok(own) => own,
                Err(failure) => return Err(Box::new(Failure { run, ..*failure })),
            };
        }
    }
}

/// Goes from a phase to the next one. Returns whether the run continues.
fn pass(
    events: &[Planned],
    at: &mut Progress,
    (base, setting): (&Model, &mut Setting),
    (options, stall): (&Options, &mut Stall),
    calls: (&mut Option<Act<'_>>, &mut Guard),
    run: &mut Run,
) -> Result<Flow, Box<Failure>> {
    let mut passage = Passage { fired: at.fired.clone(), ..Passage::default() };
    let notes = (&mut *run, &mut passage);
    let flow = take_effect(events, at, (base, setting), options, calls, notes)?;
    if flow == Flow::Continue && modes::has_modes(base) {
        stall.look(base, at.t, setting)?;
        settle(events, at, (base, setting), (run, &mut passage))?;
    }
    run.note(passage);
    Ok(flow)
}

/// Checks a start with forces that have modes.
fn check_modes(
    model: &Model,
    start: &State,
    options: &Options,
    at: &mut Progress,
) -> Result<(), Box<Failure>> {
    StartCheck::of_run(options).check(model, at.t, [&start.q, &start.v, &start.z])?;
    modes::check(model, &StateAt { t: at.t, y: &mut at.y })
}

/// Builds the model of the next phase and checks that the state meets its constraints.
fn changed(
    base: &Model,
    setting: &Setting,
    at: &Progress,
    options: &Options,
) -> Result<Option<Box<Own>>, Box<Failure>> {
    let own = Own::of(base, setting, at.t)?;
    let model = own.as_ref().map_or(base, |own| &own.model);
    let [q, v, z, _] = model.layout.split(&at.y);
    let check = StartCheck::of_change(options);
    // a force that begins to hold has a small speed, which the projection at the start of the phase removes
    let check = if holds(setting) { check.of_positions() } else { check };
    check.check(model, at.t, [q, v, z])?;
    Ok(own)
}

/// Reads the conditions of the events for the model of a phase.
fn conditions(
    model: &Model,
    setting: &Setting,
    events: &[Planned],
) -> Result<Vec<Option<Condition>>, Box<Failure>> {
    let released = &setting.released;
    let read = |event: &Planned| {
        if matches!(event.effect, Effect::Mode { .. }) {
            return Ok(None);
        }
        Condition::read(model, released, &event.condition).map(Some).map_err(|problem| {
            let message = format!("events.{}: {}", event.name, problem.message);
            Reason::Option { name: "events", message }.into()
        })
    };
    events.iter().map(read).collect()
}

fn watched<'c>(
    model: &Model,
    events: &'c [Planned],
    conditions: &'c [Option<Condition>],
    released: &[String],
    options: &Options,
) -> Vec<Watched<'c>> {
    let accuracy = options.method.control().rtol.min(LOOSEST);
    let watched = events.iter().zip(conditions).map(|(event, condition)| {
        if let Effect::Mode { force, place } = event.effect {
            let (function, direction) = watched_mode(model, force, place);
            let has_mode = modes::has_mode(model, force);
            let ends = has_mode && place != modes::GRAZE;
            // a compliant contact acts as soon as the gap is negative
            let error = accuracy * modes::gap_unit(model, force);
            let shallow = if modes::is_contact(model, force) { error } else { 0.0 };
            return Watched {
                name: &event.name,
                shallow: if place == 0 { shallow } else { 0.0 },
                minima: (place == modes::GRAZE).then_some([-shallow, error]),
                function: EventFunction::Mode(function),
                direction,
                ends,
                listed: !ends,
            };
        }
        let done = matches!(&event.effect, Effect::Release(driver) if released.contains(driver));
        let condition = condition.as_ref().filter(|_| !done);
        Watched {
            name: &event.name,
            shallow: 0.0,
            minima: None,
            function: condition.map_or(EventFunction::Never, EventFunction::Condition),
            direction: condition.map_or(event.direction, |c| c.direction(event.direction)),
            ends: event.effect != Effect::None,
            listed: true,
        }
    });
    watched.list()
}

/// Whether any force holds in a phase.
fn holds(setting: &Setting) -> bool {
    setting.modes.iter().any(|of| matches!(of.mode, Mode::Holds(_)))
}

/// Decides the modes of the next phase; velocities jump where contacts hit.
fn settle(
    events: &[Planned],
    at: &mut Progress,
    (base, setting): (&Model, &mut Setting),
    (run, passage): (&mut Run, &mut Passage),
) -> Result<(), Box<Failure>> {
    let open = setting.open(base).map_err(|problems| impossible(&problems, at.t))?;
    let of_force = |index: &usize| match events[*index].effect {
        Effect::Mode { force, .. } => Some(force),
        _ => None,
    };
    let fired: Vec<usize> = at.fired.iter().filter_map(of_force).list();
    let (t, before) = (at.t, at.y.clone());
    let mut place = StateAt { t, y: &mut at.y };
    let settled = modes::settle(&open, &mut place, &setting.modes, &fired)?;
    let index = |force: usize, of: usize| {
        let wanted = Effect::Mode { force, place: of };
        events.iter().position(|event| event.effect == wanted).expect("it was planned")
    };
    for k in &settled.hits {
        let index = index(*k, 0);
        run.add_event(&base.layout, index, t, &before);
        run.events[index].impulses.extend(&settled.impulses);
    }
    for (k, of) in &settled.changed {
        run.add_event(&base.layout, index(*k, *of), t, &before);
    }
    setting.modes = settled.modes;
    (passage.impacts, passage.collapsed) = (settled.impacts, settled.collapsed);
    Ok(())
}

/// Carries out the events that ended a phase, in their order. Returns whether the run continues.
fn take_effect(
    events: &[Planned],
    at: &mut Progress,
    (base, setting): (&Model, &mut Setting),
    options: &Options,
    (act, guard): (&mut Option<Act<'_>>, &mut Guard),
    (run, passage): (&mut Run, &mut Passage),
) -> Result<Flow, Box<Failure>> {
    for index in at.fired.clone() {
        let event = &events[index];
        match &event.effect {
            Effect::None | Effect::Mode { .. } => {}
            Effect::Release(driver) => setting.released.push(driver.clone()),
            Effect::Stop(count) if run.events[index].states.t.len() < *count => {}
            Effect::Stop(_) => {
                run.stopped_by = Some(event.name.clone());
                return Ok(Flow::Stop);
            }
            Effect::Act => {
                let [q, v, z, _] = base.layout.split(&at.y).map(<[f64]>::to_vec);
                let state = State { t: at.t, q, v, z };
                let change = act.as_mut().and_then(|act| act(&event.name, &state, setting));
                let Some(change) = change else { return Ok(Flow::Stop) };
                let energy = |setting: &Setting, at: &Progress| {
                    let found = setting.energy(base, at.t, &at.y);
                    found.map_err(|problems| impossible(&problems, at.t))
                };
                let before = energy(setting, at)?;
                setting.parameters.extend(change.parameters);
                if let Some(state) = change.state {
                    passage.replaced = true;
                    put(base, setting, options, at, &state)?;
                }
                guard.allow(energy(setting, at)? - before);
            }
        }
    }
    Ok(Flow::Continue)
}

/// Replaces the state; it must meet the constraints.
fn put(
    base: &Model,
    setting: &Setting,
    options: &Options,
    at: &mut Progress,
    state: &State,
) -> Result<(), Box<Failure>> {
    check_lengths(base, state)?;
    let own = Own::of(base, setting, at.t)?;
    let model = own.as_ref().map_or(base, |own| &own.model);
    StartCheck::of_change(options).check(model, at.t, [&state.q, &state.v, &state.z])?;
    let [q, v, z, _] = base.layout.split_mut(&mut at.y);
    q.copy_from_slice(&state.q);
    v.copy_from_slice(&state.v);
    z.copy_from_slice(&state.z);
    Ok(())
}
