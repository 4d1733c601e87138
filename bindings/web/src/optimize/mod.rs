//! The section `[optimize]` of a case, solved one run at a time: the values of parameters that are best within limits.

mod bound;
mod task;
mod text;

use crate::fault::Fault;
use crate::loaded::Loaded;
use bound::Bound;
use kempe::model::Value as Written;
use kempe_synthesis::{Descent, Ending};
use serde_json::{json, Value};
use task::{Seen, Task};

/// Part of the size of a limit within which it is reached.
const REACHED: f64 = 1e-6;

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
    before: Option<Seen>,
    seen: Vec<(Vec<f64>, Seen)>,
    runs: usize,
    failed: usize,
    reason: Option<String>,
    ending: Option<Ending>,
}

impl Search {
    /// The search that the section of a case asks for, after its first run.
    pub fn begin(loaded: &Loaded) -> Result<Self, Fault> {
        let task = Task::read(loaded)?;
        let start: Vec<f64> = task.bounds.iter().map(|of| of.share(of.before)).collect();
        let within = task.bounds.iter().all(|Bound { before, ends: [least, largest], .. }| {
            (least..=largest).contains(&before)
        });
        let mut search = Self {
            task,
            descent: Descent::new(start),
            sizes: Vec::new(),
            before: None,
            seen: Vec::new(),
            runs: 0,
            failed: 0,
            reason: None,
            ending: None,
        };
        search.advance();
        if search.ending == Some(Ending::NoValue) {
            let reason = search.reason.unwrap_or_default();
            return Err(Fault::new(reason).hint("begin with values for which the analysis runs"));
        }
        if within {
            search.before = search.seen.first().map(|(_, seen)| seen.clone());
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
        let known = match self.task.run(&point, &mut self.sizes) {
            Ok((known, seen)) => {
                self.seen.push((point, seen));
                Some(known)
            }
            Err(fault) => {
                self.failed += 1;
                self.reason = Some(fault.message);
                None
            }
        };
        self.ending = self.descent.take(known);
    }

    /// The search for a page; `bindings/web/README.md` describes it.
    pub fn described(&self) -> Value {
        let best = self.descent.best().map(|(at, _)| at);
        let seen = best.and_then(|best| self.seen.iter().rev().find(|(at, _)| at == best));
        let shares = best.map_or(&[][..], |at| at);
        let values = self.task.bounds.iter().zip(shares).map(|(of, share)| {
            let x = of.at(*share);
            let reached = of.ends.contains(&x);
            json!({ "name": of.name, "before": of.before, "now": x, "reached": reached })
        });
        let changes = self.task.bounds.iter().zip(shares).map(|(of, share)| {
            let value = of.written(of.at(*share));
            json!({ "path": ["parameters", of.name], "value": value })
        });
        let limits = self.task.limits.iter().zip(seen.map_or(&[][..], |(_, seen)| &seen.room));
        let limits = limits.map(|(text, room)| {
            let state = match room {
                room if *room < -REACHED => "missed",
                room if *room < REACHED => "reached",
                _ => "holds",
            };
            json!({ "text": text, "state": state })
        });
        json!({
            "runs": self.runs,
            "failed": self.failed,
            "reason": self.reason,
            "ending": self.ending.map(|ending| match ending {
                Ending::Best => "best",
                Ending::Corner => "corner",
                Ending::NoValue | Ending::Enough => "enough",
            }),
            "label": self.task.label,
            "unit": self.task.unit,
            "before": self.before.as_ref().map(|seen| seen.objective),
            "now": seen.map(|(_, seen)| seen.objective),
            "values": values.collect::<Vec<_>>(),
            "limits": limits.collect::<Vec<_>>(),
            "changes": changes.collect::<Vec<_>>(),
        })
    }
}
