//! Equilibrium as an analysis.

use super::at_rest::{at_rest, effort, is_path, numbers, points, EFFORT};
use super::failure::Reason;
use super::options::Options;
use super::points::{EquilibriumPath, PathEnd};
use super::result::Equilibrium;
use super::{begins, equilibrium, path};
use crate::analyses::readings::find;
use crate::analyses::record::{
    effort_unit, Analysis, ErrorClass, Fact, NamedNumber, NumberList, Observer, Outcome, Record,
    RunResult, StartState, Subject,
};
use crate::analyses::State;
use crate::elements::Coordinate;
use crate::math::Listed;
use crate::model::Model;
use serde_json::{json, Value};

impl Analysis for Options {
    const NUMBERS: &'static [NamedNumber] = &[
        NamedNumber::new("stable", "", |of, _| along(of, |point| point["stable"].clone())),
        NamedNumber::new("eigenvalues", "", |of, _| {
            let own = |point: &Value| NumberList::list(numbers(&point["eigenvalues"]));
            NumberList::along(&points(of).iter().map(own).list(), is_path(of))
        }),
        NamedNumber::new("residual", "", |of, _| {
            let all = points(of).iter().filter_map(|point| point["residual"].as_f64());
            NumberList::one(all.fold(0.0, f64::max))
        }),
        NamedNumber::new("steps", "", |of, _| NumberList::found(&points(of)[0]["steps"])),
        NamedNumber::new("relaxed", "", |of, _| NumberList::found(&points(of)[0]["relaxed"])),
        NamedNumber::new("complete", "", |of, _| {
            let end = of.findings["end"].as_str();
            NumberList::one(f64::from(end.is_none_or(|end| matches!(end, "last" | "first"))))
        }),
        NamedNumber::new("values", "", |of, _| NumberList::list(numbers(&of.findings["values"]))),
        NamedNumber::new("folds", "", |of, _| values_at(of, "folds")),
        NamedNumber::new("branches", "", |of, _| values_at(of, "branches")),
    ];

    fn quantity(
        &self,
        subject: &Subject<'_>,
        record: &Record,
        name: &str,
    ) -> Result<NumberList, Outcome> {
        match name.strip_prefix(EFFORT) {
            Some(name) => Ok(along(record, |point| effort(point, &self.hold, name))),
            None => at_rest(self, subject, record, name),
        }
    }

    fn begins(&self, subject: &Subject<'_>, start: &StartState) -> Result<(), Outcome> {
        Ok(begins(&subject.released(start), &start.state)?)
    }

    fn run(&self, subject: &Subject<'_>, start: &StartState, observer: Observer<'_>) -> RunResult {
        let (model, look) = (subject.released(start), observer.look);
        let Some(over) = &self.over else {
            let found = equilibrium(&model, &start.state, self, |step| look(step as f64))?;
            let record =
                Record::new(json!({ "points": [point(&found)] }), start.at(found.state.clone()));
            let rest = Fact::new("rest position", Value::Null);
            return Ok(record
                .facts(facts(&model, &self.hold, &found))
                .positions([(rest, found.state)]));
        };
        let found = path(&model, &start.state, self, look)?;
        let last = found.points.last().map(|point| point.state.clone());
        let last = last.unwrap_or_else(|| start.state.clone());
        let record = Record::new(path_found(&found), start.at(last));
        Ok(record
            .facts(facts_of_path(&model, over, &found))
            .positions(on_path(&model, over, &found)))
    }
}

/// A finding of all points of a path, or of the only point.
fn along(record: &Record, read: impl Fn(&Value) -> Value) -> NumberList {
    let all = points(record).iter().map(|point| NumberList::found(&read(point))).list();
    NumberList::along(&all, is_path(record))
}

/// The values of the parameter at some points of a path.
fn values_at(record: &Record, places: &str) -> NumberList {
    let values = numbers(&record.findings["values"]);
    NumberList::list(numbers(&record.findings[places]).iter().map(|k| values[*k as usize]))
}

/// The stability, the stiffness and the efforts of an equilibrium.
fn facts(model: &Model, hold: &[String], found: &Equilibrium) -> Vec<Fact> {
    let coordinates = &found.coordinates;
    let (eigenvalues, stable) = found.stability();
    let stability = match (eigenvalues.first(), stable) {
        (None, _) => "held: no freedom is left",
        (Some(_), true) => "stable",
        (Some(0.0), false) => "indifferent: it can move without any force",
        (Some(_), false) => "not stable",
    };
    let mut facts = vec![Fact::new("stability", stability)];
    match &coordinates[..] {
        [only] => {
            let (force, per) = (effort_unit(model, only), unit_of(model, only));
            let name = format!("stiffness along {only}");
            facts.push(Fact::new(name, eigenvalues[0]).unit(format!("{force}/{per}")));
        }
        _ => {
            facts.extend(eigenvalues.iter().enumerate().map(|(k, value)| {
                Fact::new(format!("eigenvalue {} of the stiffness", k + 1), *value)
            }))
        }
    }
    let efforts = found.efforts.iter().map(|(name, value)| {
        let name = format!("{name}.effort");
        let unit = unit_of(model, &name);
        Fact::new(name, *value).unit(unit)
    });
    facts.extend(efforts);
    let holders = hold.iter().zip(&found.holders);
    facts.extend(holders.map(|(name, value)| {
        Fact::new(format!("effort of the holder of {name}"), *value).unit(effort_unit(model, name))
    }));
    facts
}

/// The SI unit of a quantity; empty if it is not known.
fn unit_of(model: &Model, name: &str) -> String {
    find(model, name).map_or(String::new(), |found| found.unit)
}

/// The length of a path, its folds and crossings, and its end.
fn facts_of_path(model: &Model, over: &str, found: &EquilibriumPath) -> Vec<Fact> {
    let stable = found.points.iter().filter(|point| point.stable).count();
    let mut facts =
        vec![Fact::new("positions", found.points.len()), Fact::new("stable positions", stable)];
    for (name, places) in [("fold", &found.folds), ("crossing", &found.branches)] {
        facts.extend(places.iter().map(|k| value_on_path(model, over, name, found.values[*k])));
    }
    let end = match &found.end {
        PathEnd::Last => "the path reached the end of the range".to_string(),
        PathEnd::First => "the path turned and came back to the beginning of the range".to_string(),
        PathEnd::Lost(reason) => format!("the path could not be followed further: {reason}"),
        PathEnd::Long => "the path has very many points and was ended".to_string(),
        PathEnd::Stopped => "the analysis was stopped".to_string(),
    };
    facts.push(Fact::new("end", end));
    facts
}

/// A value of the parameter of a path.
fn value_on_path(model: &Model, over: &str, name: &str, value: f64) -> Fact {
    let place = model.blueprint.parameters.iter().position(|parameter| parameter == over);
    let unit = place.and_then(|place| model.blueprint.inferred[place].unit());
    Fact::new(format!("{name} at {over}").trim_start_matches(" at "), value)
        .unit(unit.unwrap_or_default())
}

/// The positions of a path, each with the value of the parameter.
fn on_path(model: &Model, over: &str, found: &EquilibriumPath) -> Vec<(Fact, State)> {
    let all = found.values.iter().zip(&found.points);
    all.map(|(value, point)| (value_on_path(model, over, "", *value), point.state.clone())).list()
}

/// A path of equilibria.
fn path_found(found: &EquilibriumPath) -> Value {
    let (end, why) = match &found.end {
        PathEnd::Last => ("last", String::new()),
        PathEnd::First => ("first", String::new()),
        PathEnd::Lost(reason) => ("lost", reason.to_string()),
        PathEnd::Long => ("long", String::new()),
        PathEnd::Stopped => ("stopped", String::new()),
    };
    json!({
        "points": found.points.iter().map(point).list(), "values": found.values,
        "folds": found.folds, "branches": found.branches, "end": end, "why": why
    })
}

fn point(found: &Equilibrium) -> Value {
    let (eigenvalues, stable) = found.stability();
    json!({
        "q": found.state.q, "z": found.state.z, "lam": found.lam, "holders": found.holders,
        "efforts": found.efforts, "coordinates": found.coordinates, "stiffness": found.stiffness,
        "eigenvalues": eigenvalues, "stable": stable, "residual": found.residual,
        "steps": found.steps, "relaxed": found.relaxed
    })
}

/// The option that holds a coordinate. None for an internal coordinate, which cannot be held.
fn hold(coordinate: &str) -> Option<String> {
    let (_, word) = coordinate.rsplit_once('.')?;
    Coordinate::named(word).map(|_| format!("hold = [\"{coordinate}\"]"))
}

impl From<Reason> for Outcome {
    fn from(reason: Reason) -> Self {
        let message = reason.to_string();
        let outcome = |class, hint: &str| Self::new(class, message).hint(hint);
        match reason {
            Reason::Option(problems) => problems.into(),
            Reason::Open => outcome(
                ErrorClass::Assembly,
                "kp.assemble(model, from_state=state) assembles the mechanism anew",
            ),
            Reason::Singular { name, .. } => {
                outcome(ErrorClass::Singularity, "start at another position").name(name)
            }
            Reason::NotFinite => outcome(
                ErrorClass::Integration,
                "check the laws of the forces at rest, such as a division by a rate, and the depths of contacts",
            ),
            Reason::State { name } => {
                outcome(ErrorClass::Singularity, "its rate must depend on it").name(name)
            }
            Reason::Endless { coordinate, force, kind, .. } => {
                let hold = hold(&coordinate).map_or(String::new(), |hold| format!(", or {hold}"));
                let hint = format!(
                    "{force:.4} {} still act along {coordinate}; add a spring or a stop{hold}",
                    kind.unit_of_effort()
                );
                outcome(ErrorClass::Singularity, &hint).name(coordinate)
            }
            Reason::Lost { coordinate, .. } => outcome(
                ErrorClass::Singularity,
                "start nearer to the rest position; a force that jumps may have no equilibrium",
            )
            .name(coordinate),
            Reason::Moving { .. } => outcome(
                ErrorClass::Model,
                "kp.equilibrium(model, state).state is at rest; hold = [\"crank.angle\"] keeps a \
                 coordinate where it is",
            ),
            Reason::Loose { coordinate } => {
                let hint = match hold(&coordinate) {
                    Some(hold) => format!("{hold} keeps it where it is"),
                    None => "add a spring or a stop".to_string(),
                };
                outcome(ErrorClass::Singularity, &hint).name(coordinate)
            }
            Reason::Stopped => outcome(ErrorClass::Internal, "the search was stopped"),
        }
    }
}
