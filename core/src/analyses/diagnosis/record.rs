//! The diagnosis as an analysis.

use super::{as_json, diagnose, Diagnosis, Options, Redundancy};
use crate::analyses::record::{
    Analysis, Fact, NamedNumber, Observer, Record, RunResult, StartState, Subject,
};

impl Analysis for Options {
    const NUMBERS: &'static [NamedNumber] = &[
        NamedNumber::finding("degrees_of_freedom", ""),
        NamedNumber::finding("gruebler", ""),
        NamedNumber::finding("rank", ""),
        NamedNumber::finding("driven", ""),
        NamedNumber::finding("redundant", ""),
        NamedNumber::finding("singular", ""),
        NamedNumber::finding("locked", ""),
        NamedNumber::finding("loose", ""),
        NamedNumber::finding("undetermined", ""),
    ];

    fn run(&self, subject: &Subject<'_>, start: &StartState, _: Observer<'_>) -> RunResult {
        let found = diagnose(&subject.released(start), &start.state);
        Ok(Record::new(as_json(&found), start.clone())
            .facts(facts(&found))
            .positions([start.examined()]))
    }
}

/// The counts, and a line for each finding.
fn facts(found: &Diagnosis) -> Vec<Fact> {
    let equations = |of: &Redundancy| of.equations.join(", ");
    let mut facts = vec![
        Fact::new("degrees of freedom", found.mobility.degrees_of_freedom),
        Fact::new("Grübler's formula", found.gruebler),
        Fact::new("rank of the equations", found.mobility.rank),
        Fact::new("equations of drivers", found.driven),
        Fact::new("redundant equations", found.redundant.len()),
        Fact::new("equations that are dependent only here", found.singular.len()),
    ];
    facts.extend(found.redundant.iter().map(|one| Fact::new("redundant", equations(one))));
    let singular = found.singular.iter();
    facts.extend(singular.map(|(one, kind)| Fact::new(kind.to_string(), equations(one))));
    facts.extend(Fact::list("cannot move", &found.locked));
    facts.extend(Fact::list("not connected with ground", &found.loose));
    let undetermined = found.undetermined.iter();
    facts.extend(undetermined.map(|(_, message)| Fact::new("not determined", message.clone())));
    let loops = found.four_bars.iter();
    facts.extend(
        loops.map(|one| Fact::new(format!("loop {}", one.pins.join("-")), one.class.to_string())),
    );
    facts
}
