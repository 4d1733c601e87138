//! The events that a run watches: those of its options, the releases of its drivers, and the changes of its forces with
//! modes.

use super::event_function::EventFunction;
use super::event_list::Watched;
use super::failure::{Failure, Reason};
use super::modes::{self, watched_mode};
use super::options::Options;
use super::setting::Setting;
use crate::analyses::conditions::Condition;
use crate::analyses::event_options::STOP;
use crate::integrate::Direction;
use crate::math::Listed;
use crate::model::{size, Model};

/// The effect of an event.
#[derive(Clone, Debug, PartialEq)]
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
#[derive(Debug)]
pub(in crate::analyses) struct Planned {
    pub name: String,
    pub condition: String,
    direction: Direction,
    pub effect: Effect,
}

/// Largest error of a step at which a gap counts as open, relative to the size of the mechanism.
const LOOSEST: f64 = 1e-10;

/// The names of the events of a limited driver, in place of those of friction that begins to stick and to slip.
const OF_LIMIT: &[&str] = &["follows", "saturated"];

/// The name of the event at which a driver is released.
fn release_of(driver: &str) -> String {
    format!("{driver}.release")
}

/// The events of a run, in the order in which they take effect.
pub(in crate::analyses) fn planned(model: &Model, options: &Options) -> Vec<Planned> {
    let model = &*model.limited();
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
    let whole = model.constraints.iter().map(|item| (&item.name, Some(&item.element)));
    let limited = model.forces.iter().map(|item| (&item.name, item.element.driver()));
    let releases = whole.chain(limited).filter_map(|(name, driver)| {
        Some(Planned {
            name: release_of(name),
            condition: driver?.release()?.to_string(),
            direction: Direction::Any,
            effect: Effect::Release(name.clone()),
        })
    });
    let modes = model.forces.iter().enumerate().flat_map(|(force, item)| {
        let names = item.element.behaviour().map_or(&[][..], |behaviour| behaviour.events());
        let names = item.element.driver().map_or(names, |_| OF_LIMIT);
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

/// The forces whose modes end at some of the events.
pub(super) fn ended(events: &[Planned], fired: &[usize]) -> Vec<usize> {
    let of_force = |index: &usize| match events[*index].effect {
        Effect::Mode { force, .. } => Some(force),
        _ => None,
    };
    fired.iter().filter_map(of_force).list()
}

/// Reads the conditions of the events for the model of a phase.
pub(super) fn conditions(
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

/// The events as the phase of a model watches them.
pub(super) fn watched<'c>(
    model: &Model,
    events: &'c [Planned],
    conditions: &'c [Option<Condition>],
    released: &[String],
    options: &Options,
) -> Vec<Watched<'c>> {
    let (accuracy, size) = (options.method.control().rtol.min(LOOSEST), size(model));
    let watched = events.iter().zip(conditions).map(|(event, condition)| {
        if let Effect::Mode { force, place } = event.effect {
            let (function, direction) = watched_mode(model, force, place);
            let has_mode = modes::has_mode(model, force);
            // the friction of a compliant contact begins and ends with the contact
            let rubs = model.forces[force].partner.is_some();
            let keeps = place == 0 && model.forces[force].element.keeps_speed();
            let ends = (has_mode || rubs) && place != modes::GRAZE || keeps;
            // a compliant contact acts as soon as the gap is negative
            let error = accuracy * modes::gap_unit(model, size, force);
            let shallow = if modes::is_contact(model, force) { error } else { 0.0 };
            return Watched {
                name: &event.name,
                shallow: if place == 0 { shallow } else { 0.0 },
                minima: (place == modes::GRAZE).then_some([-shallow, error]),
                function: EventFunction::Mode(function),
                direction,
                ends,
                lasts: ends && !keeps,
                listed: !has_mode || !ends,
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
            lasts: false,
            listed: true,
        }
    });
    watched.list()
}
