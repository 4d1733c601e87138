//! Obstacles to each analysis of a state or motion: the checks with which the core begins it, at the start of the
//! case.

use crate::fault::problem;
use crate::loaded::Loaded;
use kempe::analyses::dynamics::Prepared;
use kempe::analyses::record::{Outcome, Subject};
use kempe::analyses::AnyAnalysis;
use kempe::model::{Definition, Entry, Value as Written};
use kempe::Problem;
use serde_json::{json, Value};
use std::sync::Arc;

/// The analyses that are examined, with the duration of those that have one, s. A motion along drivers is examined at
/// its start only.
const KINDS: [(&str, Option<f64>); 5] = [
    ("dynamics", Some(1.0)),
    ("kinematics", Some(0.0)),
    ("inverse_dynamics", Some(0.0)),
    ("equilibrium", None),
    ("modes", None),
];

/// The obstacle to each analysis, or null. If the mechanism does not close, no other analysis can begin.
pub fn readiness(loaded: &Loaded) -> Value {
    let Loaded { model, case, .. } = loaded;
    let stated = |analysis: &str, found: Option<Outcome>| {
        let found = found.map(|outcome| problem(&obstacle(&case.definition, outcome)));
        json!({ "analysis": analysis, "problem": found })
    };
    let start = match case.assembled(model, &|| false) {
        Ok(start) => start,
        Err(found) => return json!([stated("assembly", Some(found))]),
    };
    let prepared = Prepared::new(Arc::clone(model));
    let subject = Subject { definition: &case.definition, prepared: &prepared };
    let begins = |(kind, duration): (&str, Option<f64>)| {
        let times = duration.map(|duration| {
            let numbers = [("t_end", start.state.t + duration), ("output_step", 1.0)];
            numbers.map(|(key, x)| (key.to_string(), Written::Number(x)))
        });
        let kind = ("type".to_string(), Written::Text(kind.to_string()));
        let fields: Vec<_> = [kind].into_iter().chain(times.into_iter().flatten()).collect();
        AnyAnalysis::read(model, &fields, &[])?.begins(&subject, &start)
    };
    let others = KINDS.map(|kind| stated(kind.0, begins(kind).err()));
    [stated("assembly", None)].into_iter().chain(others).collect()
}

/// An obstacle with its path in the file.
fn obstacle(definition: &Definition, found: Outcome) -> Problem {
    let own = found.problems.into_iter().map(|problem| problem.path).next();
    let path = own.unwrap_or_else(|| place(definition, found.name.as_deref().unwrap_or_default()));
    Problem::at(&path, found.message).maybe_hint(found.hint)
}

/// The path of an element in a file. For a coordinate such as `crank.angle`, the path of its body.
fn place(definition: &Definition, name: &str) -> Vec<String> {
    let name = name.split('.').next().unwrap_or_default();
    let Definition { bodies, joints, drivers, forces, .. } = definition;
    let sections =
        [("bodies", bodies), ("joints", joints), ("drivers", drivers), ("forces", forces)];
    let has = |(_, entries): &(&str, &Vec<Entry>)| entries.iter().any(|entry| entry.name == name);
    let section = sections.into_iter().find(has);
    section.map_or(Vec::new(), |(section, _)| vec![section.to_string(), name.to_string()])
}
