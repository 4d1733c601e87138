//! The course of a run with events: phases, each with the drivers and parameters that hold in it.
//!
//! An event that only lists its times does not end a phase. A phase ends where the run stops, where a driver is released
//! and where the caller acts; the next one begins there, with a model of its own.

use super::clock::Clock;
use super::event_list::{Function, Watched};
use super::failure::{Failure, Reason};
use super::model_cache::ModelCache;
use super::option_checks::check_lengths;
use super::options::Options;
use super::run::{run_phase, At, Phase, PhaseEnd, Watcher};
use super::run_results::{EventStates, Run};
use super::setting::Setting;
use super::start_check::StartCheck;
use crate::analyses::conditions::Condition;
use crate::analyses::event_options::STOP;
use crate::analyses::State;
use crate::integrate::{Direction, Flow};
use crate::model::{Model, Problem};

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

/// What follows from an event.
#[derive(Clone, PartialEq)]
enum Effect {
    /// It is listed.
    None,
    /// The run ends.
    Stop,
    /// The caller acts.
    Act,
    /// This driver no longer acts.
    Release(String),
}

/// An event of the whole run.
struct Planned {
    name: String,
    condition: String,
    direction: Direction,
    effect: Effect,
}

/// The name of the event at which a driver is released.
fn release_of(driver: &str) -> String {
    format!("{driver}.release")
}

/// The events of a run, in the order in which they take effect.
fn planned(model: &Model, options: &Options) -> Vec<Planned> {
    let listed = options.events.iter().map(|event| Planned {
        name: event.name.clone(),
        condition: event.condition.clone(),
        direction: event.direction,
        effect: match (event.stop, event.acts) {
            (true, _) => Effect::Stop,
            (_, true) => Effect::Act,
            _ => Effect::None,
        },
    });
    let stop = options.stop.iter().map(|condition| Planned {
        name: STOP.to_string(),
        condition: condition.clone(),
        direction: Direction::Any,
        effect: Effect::Stop,
    });
    let releases = model.constraints.iter().filter_map(|driver| {
        Some(Planned {
            name: release_of(&driver.name),
            condition: driver.element.release()?.to_string(),
            direction: Direction::Any,
            effect: Effect::Release(driver.name.clone()),
        })
    });
    listed.chain(stop).chain(releases).collect()
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

/// Numbers that cannot be right.
fn impossible(problems: &[Problem], t: f64) -> Box<Failure> {
    let all: Vec<String> = problems.iter().map(ToString::to_string).collect();
    let message = format!("the parameters at t = {t:.6} s: {}", all.join("; "));
    Reason::Option { name: "parameters", message }.into()
}

/// Runs a model through its phases.
pub(super) fn run<W: FnMut(f64) -> Flow>(
    base: (&Model, &ModelCache),
    start: &State,
    options: &Options,
    clock: Clock,
    mut watcher: Watcher<'_, W>,
    mut act: Option<Act<'_>>,
) -> Result<Run, Box<Failure>> {
    let began = clock();
    let events = planned(base.0, options);
    let mut setting =
        Setting { parameters: options.parameters.clone(), released: options.release.clone() };
    let named = |event: &Planned| EventStates { name: event.name.clone(), ..Default::default() };
    let mut run = Run { events: events.iter().map(named).collect(), ..Run::default() };
    let mut own = Own::of(base.0, &setting, start.t)?;
    options.check(own.as_ref().map_or(base.0, |own| &own.model), start)?;
    let mut at = At::begin(base.0, start, options, &mut run);
    loop {
        let (model, cache) = own.as_ref().map_or(base, |own| (&own.model, &own.cache));
        let conditions = conditions(model, &setting, &events)?;
        let watched = watched(&events, &conditions, &setting.released);
        run.settings.push(setting.clone());
        let phase = Phase::new(model);
        let outcome = run_phase((&phase, cache), watched, &mut at, options, &mut run, &mut watcher);
        run.statistics.seconds = clock() - began;
        let ended = outcome.and_then(|ended| match ended {
            PhaseEnd::Reached => {
                run.reached = true;
                Ok(None)
            }
            PhaseEnd::Stopped => Ok(None),
            PhaseEnd::Event => {
                let before = setting.clone();
                let flow = take_effect(
                    &events,
                    &mut at,
                    (base.0, &mut setting),
                    options,
                    &mut act,
                    &mut run,
                )?;
                Ok((flow == Flow::Continue).then_some(before))
            }
        });
        let before = match ended {
            Ok(None) => return Ok(run),
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

/// The model of the next phase, which must meet its constraints where it begins.
fn changed(
    base: &Model,
    setting: &Setting,
    at: &At,
    options: &Options,
) -> Result<Option<Box<Own>>, Box<Failure>> {
    let own = Own::of(base, setting, at.t)?;
    let model = own.as_ref().map_or(base, |own| &own.model);
    let [q, v, z, _] = model.layout.split(&at.y);
    StartCheck::of_change(options).check(model, at.t, [q, v, z])?;
    Ok(own)
}

/// The conditions of a phase over its model.
fn conditions(
    model: &Model,
    setting: &Setting,
    events: &[Planned],
) -> Result<Vec<Condition>, Box<Failure>> {
    let released = &setting.released;
    let read = |event: &Planned| {
        Condition::read(model, released, &event.condition).map_err(|problem| {
            let message = format!("events.{}: {}", event.name, problem.message);
            Reason::Option { name: "events", message }.into()
        })
    };
    events.iter().map(read).collect()
}

fn watched<'c>(
    events: &[Planned],
    conditions: &'c [Condition],
    released: &[String],
) -> Vec<Watched<'c>> {
    let watched = events.iter().zip(conditions).map(|(event, condition)| {
        let done = matches!(&event.effect, Effect::Release(driver) if released.contains(driver));
        Watched {
            function: if done { Function::Given(&never) } else { Function::Condition(condition) },
            direction: condition.direction(event.direction),
            ends: event.effect != Effect::None,
        }
    });
    watched.collect()
}

/// The function of an event that does not happen any more.
fn never(_: f64, _: [&[f64]; 3]) -> f64 {
    1.0
}

/// Carries out the events that ended a phase, in their order. Returns whether the run goes on.
fn take_effect(
    events: &[Planned],
    at: &mut At,
    (base, setting): (&Model, &mut Setting),
    options: &Options,
    act: &mut Option<Act<'_>>,
    run: &mut Run,
) -> Result<Flow, Box<Failure>> {
    for event in at.fired.clone().into_iter().map(|index| &events[index]) {
        match &event.effect {
            Effect::None => {}
            Effect::Release(driver) => setting.released.push(driver.clone()),
            Effect::Stop => {
                run.stopped_by = Some(event.name.clone());
                return Ok(Flow::Stop);
            }
            Effect::Act => {
                let [q, v, z, _] = base.layout.split(&at.y).map(<[f64]>::to_vec);
                let state = State { t: at.t, q, v, z };
                let change = act.as_mut().and_then(|act| act(&event.name, &state, setting));
                let Some(change) = change else { return Ok(Flow::Stop) };
                setting.parameters.extend(change.parameters);
                if let Some(state) = change.state {
                    put(base, setting, options, at, &state)?;
                }
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
    at: &mut At,
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
