//! Options of analyses with events: conditions, lists of events, names of drivers, values of parameters.

use super::conditions::Condition;
use super::options::{kind, Reader};
use crate::elements::Group;
use crate::integrate::Direction;
use crate::math::Listed;
use crate::model::{did_you_mean, Problem, Value as Written};

/// The name of the event of the option `stop`.
pub const STOP: &str = "stop";

/// An event that a run lists.
#[derive(Clone, Debug, PartialEq)]
pub struct EventOption {
    /// Its name.
    pub name: String,
    /// A comparison, or an expression whose zeros are events.
    pub condition: String,
    /// The changes of sign of an expression that are events.
    pub direction: Direction,
    /// The run ends when the event occurs this number of times.
    pub stop: Option<usize>,
    /// Whether the caller changes the state or parameters at the event.
    pub acts: bool,
}

impl EventOption {
    /// An event at a condition in both directions; the run continues.
    pub fn new(name: impl Into<String>, condition: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            condition: condition.into(),
            direction: Direction::Any,
            stop: None,
            acts: false,
        }
    }
}

/// The values of the field `stop` of an event.
pub const STOPS: &str = "must be true, false, or the number of the event that ends the run, from 1";

/// Whether the field `stop` of an event may have this number.
pub fn is_count(number: f64) -> bool {
    (1.0..=1e9).contains(&number) && number.fract() == 0.0
}

/// Words for the directions of an expression.
pub const DIRECTIONS: [(&str, Direction); 3] =
    [("both", Direction::Any), ("rising", Direction::Rising), ("falling", Direction::Falling)];

kind! {
    /// A condition on quantities.
    condition: String, Condition, |reader, key| {
        let Some(Written::Text(text)) = reader.get(key) else {
            return reader.refuse(key, "must be a condition, such as \"crank.angle > 270*deg\"");
        };
        checked(reader, key, text).map(|_| text.clone())
    }
}

kind! {
    /// Events by name.
    events: Vec<EventOption>, Events, |reader, key| {
        let stops = reader.get(STOP).is_some();
        reader.table(key, |inner| {
            let names: Vec<String> = inner.keys().map(str::to_string).list();
            let read: Vec<_> = names.iter().map(|name| event(inner, name, stops)).list();
            read.into_iter().collect()
        })
    }
}

kind! {
    /// Names of drivers.
    drivers: Vec<String>, NameList, |reader, key| {
        reader.names(key, "drivers", |model, name, _| {
            let known = model.constraints.iter().filter(|c| c.group == Group::Drivers);
            let known: Vec<&str> = known.map(|c| c.name.as_str()).list();
            if known.contains(&name) {
                return Ok(());
            }
            let hint = did_you_mean(name, &known, "drivers");
            let hint = hint.map_or(String::new(), |hint| format!("; {hint}"));
            Err(Problem::new(format!("there is no driver '{name}'{hint}")))
        })
    }
}

kind! {
    /// Values of parameters.
    values: Vec<(String, f64)>, Values, |reader, key| {
        let known = reader.model().blueprint.parameters.clone();
        reader.table(key, |inner| {
            let names: Vec<String> = inner.keys().map(str::to_string).list();
            let mut found = Vec::new();
            for name in names {
                if !known.contains(&name) {
                    let known = known.iter().map(String::as_str).list();
                    let hint = did_you_mean(&name, &known, "parameters");
                    let hint = hint.map_or(String::new(), |hint| format!("; {hint}"));
                    return inner.refuse(&name, format!("there is no parameter '{name}'{hint}"));
                }
                let value = inner.number(&name, "any", (|_| true, "finite"))?;
                found.push((name, value));
            }
            Some(found)
        })
    }
}

fn checked(reader: &mut Reader<'_>, key: &str, text: &str) -> Option<Condition> {
    match Condition::read(reader.model(), &[], text) {
        Ok(condition) => Some(condition),
        Err(problem) => reader.report(key, problem),
    }
}

/// Reads an event: a condition, or a table with a condition.
fn event(reader: &mut Reader<'_>, name: &str, stops: bool) -> Option<EventOption> {
    if stops && name == STOP {
        let message = "the option stop has an event of this name already; take another name";
        return reader.refuse(name, message);
    }
    match reader.get(name)? {
        Written::Text(text) => {
            checked(reader, name, text)?;
            Some(EventOption::new(name, text))
        }
        Written::Table(_) => reader.table(name, |inner| {
            let Some(Written::Text(text)) = inner.get("condition") else {
                return inner.refuse("condition", "missing; an event needs a condition");
            };
            let read = checked(inner, "condition", text)?;
            let given = match inner.get("direction") {
                Some(Written::Text(word)) => Some(word.as_str()),
                _ => None,
            };
            let word = given.unwrap_or(DIRECTIONS[0].0);
            let direction = DIRECTIONS.iter().find(|(known, _)| *known == word);
            let Some((_, direction)) = direction else {
                return inner.refuse("direction", "must be rising, falling or both");
            };
            if given.is_some() && read.is_comparison() && *direction != Direction::Any {
                let message = "a comparison has no direction: its event is where it becomes true; write an expression, \
                               such as crank.angle - 270*deg";
                return inner.refuse("direction", message);
            }
            let stop = match inner.get("stop") {
                None | Some(Written::Flag(false)) => None,
                Some(Written::Flag(true)) => Some(1),
                Some(Written::Number(count)) if is_count(*count) => Some(*count as usize),
                _ => return inner.refuse("stop", STOPS),
            };
            Some(EventOption { direction: *direction, stop, ..EventOption::new(name, text) })
        }),
        _ => reader.refuse(name, "must be a condition or a table with one"),
    }
}
