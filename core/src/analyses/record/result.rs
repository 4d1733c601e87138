//! The record of an analysis.

use super::fact::Fact;
use super::numbers::NumberList;
use super::outcome::Outcome;
use super::start_state::StartState;
use crate::analyses::dynamics::{Accelerations, Run};
use crate::analyses::State;
use crate::model::{Definition, Model};
use serde_json::Value;
use std::sync::Arc;

/// What an analysis found.
#[derive(Debug)]
pub struct Record {
    /// The motion, if the result is one.
    pub motion: Option<Run>,
    /// Its accelerations and multipliers, if the analysis has computed them.
    pub responses: Option<Accelerations>,
    /// The mechanism in which a quantity replaces the time, if one does.
    pub driven: Option<Driven>,
    /// Other numbers, by name.
    pub numbers: Vec<NumberTable>,
    /// The other findings, by name.
    pub findings: Value,
    /// The findings for readers, in their order.
    pub facts: Vec<Fact>,
    /// Positions that the findings contain, each with its name.
    pub positions: Vec<(Fact, State)>,
    /// The reason for which the analysis ended.
    pub message: String,
    /// Remarks that a user must see.
    pub remarks: Vec<String>,
    /// The state in which the next analysis starts.
    pub end: StartState,
}

impl Record {
    /// A record with findings alone.
    pub fn new(findings: Value, end: StartState) -> Self {
        Self {
            motion: None,
            responses: None,
            driven: None,
            numbers: Vec::new(),
            findings,
            facts: Vec::new(),
            positions: Vec::new(),
            message: String::new(),
            remarks: Vec::new(),
            end,
        }
    }

    /// The record of a motion, which ends in its last state with its last setting.
    pub fn of_motion(motion: Run, start: &StartState, message: String) -> Self {
        let end = start.after(&motion);
        Self { motion: Some(motion), message, ..Self::new(Value::Null, end) }
    }

    /// The doubts about the motion.
    pub fn doubts(&self) -> impl Iterator<Item = &String> {
        self.motion.iter().flat_map(|motion| &motion.doubts)
    }

    /// Adds rows of numbers; `shape` is their number and their length.
    pub fn with(mut self, name: &'static str, shape: [usize; 2], values: Vec<f64>) -> Self {
        self.numbers.push(NumberTable { name, shape, values });
        self
    }

    /// The numbers of a table; empty without it.
    pub fn table(&self, name: &str) -> &[f64] {
        self.numbers.iter().find(|table| table.name == name).map_or(&[], |table| &table.values)
    }

    /// Adds facts for readers.
    pub fn facts(mut self, facts: impl IntoIterator<Item = Fact>) -> Self {
        self.facts.extend(facts);
        self
    }

    /// Adds positions with their names.
    pub fn positions(mut self, positions: impl IntoIterator<Item = (Fact, State)>) -> Self {
        self.positions.extend(positions);
        self
    }
}

/// A number of a result, or several, that sweeps read by name.
#[derive(Clone, Copy, Debug)]
pub struct NamedNumber {
    /// Its name.
    pub name: &'static str,
    /// Its SI unit; "over" stands for the unit of the quantity `over`.
    pub unit: &'static str,
    /// Reads the number of this name in a record of the analysis.
    pub read: fn(&Record, &str) -> NumberList,
}

impl NamedNumber {
    /// A finding of this name.
    pub const fn finding(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit, read: |of, name| NumberList::found(&of.findings[name]) }
    }

    /// The table of this name.
    pub const fn listed(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit, read: |of, name| NumberList::list(of.table(name).iter().copied()) }
    }

    /// NumberList that a function reads.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        read: fn(&Record, &str) -> NumberList,
    ) -> Self {
        Self { name, unit, read }
    }
}

/// Rows of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberTable {
    /// Their name.
    pub name: &'static str,
    /// The number of rows, and the length of a row.
    pub shape: [usize; 2],
    /// The numbers, row by row.
    pub values: Vec<f64>,
}

/// A mechanism in which a quantity replaces the time.
#[derive(Clone, Debug)]
pub struct Driven {
    /// Its model.
    pub model: Arc<Model>,
    /// Its definition.
    pub definition: Definition,
    /// The quantity.
    pub variable: Variable,
}

/// The quantity that replaces the time.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its SI unit.
    pub unit: String,
    /// Its value at the start.
    pub start: f64,
    /// Whether the mechanism is at rest at each value. Otherwise the value grows at unit rate.
    pub rests: bool,
}

impl Variable {
    /// The SI unit of a quantity whose unit over time is `unit`: rates are derivatives by this variable.
    pub fn rate(&self, unit: &str) -> String {
        rate_unit(unit, &self.unit)
    }

    /// What forces and efforts over the variable contain, in words.
    pub fn condition(&self) -> String {
        match self.rests {
            true => "at rest, without inertia and damping".to_string(),
            false => format!("with inertia and damping at 1 {}/s", self.unit),
        }
    }
}

/// The SI unit of a rate in a motion over a quantity with the unit `by`: m/s becomes m/rad, and W becomes J/rad.
pub fn rate_unit(unit: &str, by: &str) -> String {
    let mut parts = if unit == "W" { "J/s" } else { unit }.split("/s");
    let mut written = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let is_second = !part.starts_with(|c: char| c.is_ascii_alphabetic());
        written.push('/');
        written.push_str(if is_second { by } else { "s" });
        written.push_str(part);
    }
    written
}

/// An analysis that failed.
#[derive(Debug)]
pub struct Unfinished {
    /// The reason.
    pub outcome: Outcome,
    /// The record up to the failure, if there is one.
    pub record: Option<Record>,
}

/// The result of [`Analysis::run`](super::Analysis::run).
pub type RunResult = Result<Record, Box<Unfinished>>;

impl<T: Into<Outcome>> From<T> for Box<Unfinished> {
    fn from(outcome: T) -> Self {
        Self::new(Unfinished { outcome: outcome.into(), record: None })
    }
}
