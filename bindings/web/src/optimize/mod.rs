//! The section `[optimize]` of a case, solved one run at a time: the values of parameters that are best within limits.

mod bound;
mod task;
mod text;

use crate::convert::row;
use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::model::Value as Written;
use kempe_synthesis::{Descent, Ending};
use serde_json::{json, Map, Value};
use task::{Seen, Task};

/// What the page leaves to the command line.
fn refused(what: &str) -> Fault {
    Fault::new(format!("the page does not search with {what}"))
        .hint("the command 'kempe optimize' does, with this file")
}

fn entry<'a>(table: &'a [(String, Written)], key: &str) -> Option<&'a Written> {
    table.iter().find(|(known, _)| known == key).map(|(_, value)| value)
}

fn number(value: Option<&Written>) -> f64 {
    match value {
        Some(Written::Number(x)) => *x,
        _ => f64::NAN,
    }
}

fn text_of(value: &Written) -> Option<&str> {
    match value {
        Written::Text(text) => Some(text),
        _ => None,
    }
}

/// A search in progress.
pub struct Search {
    task: Task,
    descent: Descent,
    sizes: Vec<f64>,
    /// The objective of the values of the text; none if these are beyond the bounds.
    before: Option<f64>,
    /// The points with values.
    seen: Vec<(Vec<f64>, Seen)>,
    runs: usize,
    reason: Option<String>,
    ending: Option<Ending>,
}

impl Search {
    /// The search of the section of a case, after its first run.
    pub fn begin(loaded: &Loaded) -> Result<Self, Fault> {
        let task = Task::read(loaded)?;
        let (mut start, mut within) = (Vec::new(), true);
        for of in &task.bounds {
            start.push(of.share(of.before));
            within &= of.ends[0] <= of.before && of.before <= of.ends[1];
        }
        let (descent, sizes, seen) = (Descent::new(start), Vec::new(), Vec::new());
        let none = (None, None, None);
        let (before, reason, ending) = none;
        let mut search = Self { task, descent, sizes, before, seen, runs: 0, reason, ending };
        search.advance();
        match search.seen.first() {
            Some((_, first)) => search.before = within.then_some(first.objective),
            None => {
                let hint = "begin with values for which the analysis runs";
                return Err(Fault::new(search.reason.unwrap_or_default()).hint(hint));
            }
        }
        Ok(search)
    }

    /// One more run, until the search ends.
    pub fn advance(&mut self) {
        if self.ending.is_some() {
            return;
        }
        let point = self.descent.point().to_vec();
        self.runs += 1;
        let found = self.task.run(&point, &mut self.sizes);
        let known = match found {
            Ok((known, seen)) => {
                self.seen.push((point, seen));
                Some(known)
            }
            Err(fault) => {
                self.reason = Some(fault.message);
                None
            }
        };
        self.ending = self.descent.take(known);
    }

    /// The search for a page; `bindings/web/README.md` describes it.
    pub fn described(&self) -> Value {
        let best = self.descent.best().map(|(at, _)| at);
        let seen = self.seen.iter().rev().find(|(at, _)| Some(at) == best);
        let mut values = Map::new();
        if let Some((shares, _)) = seen {
            for (of, share) in self.task.bounds.iter().zip(shares) {
                values.insert(of.name.clone(), json!(of.at(*share)));
            }
        }
        let ending = self.ending.map(|ending| match ending {
            Ending::Best => "best",
            Ending::Corner => "corner",
            Ending::NoValue | Ending::Enough => "enough",
        });
        json!({
            "runs": self.runs, "failed": self.runs - self.seen.len(), "reason": self.reason,
            "ending": ending, "label": self.task.label, "unit": self.task.unit,
            "before": self.before, "now": seen.map(|(_, seen)| seen.objective),
            "values": values, "room": seen.map(|(_, seen)| row(&seen.room)),
        })
    }
}
