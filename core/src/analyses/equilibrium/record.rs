//! Equilibrium as an analysis.

use super::failure::Reason;
use super::options::Options;
use super::points::{EquilibriumPath, PathEnd};
use super::result::Equilibrium;
use super::{equilibrium, path};
use crate::analyses::record::{
    Analysis, ErrorClass, Observer, Outcome, Record, StartState, Subject, Unfinished,
};
use crate::math::Listed;
use serde_json::{json, Value};

impl Analysis for Options {
    const NUMBERS: &'static [(&'static str, &'static str)] = &[
        ("stable", ""),
        ("eigenvalues", ""),
        ("residual", ""),
        ("steps", ""),
        ("relaxed", ""),
        ("complete", ""),
        ("values", ""),
        ("folds", ""),
        ("branches", ""),
    ];

    fn run(
        &self,
        subject: &Subject<'_>,
        start: &StartState,
        observer: Observer<'_>,
    ) -> Result<Record, Box<Unfinished>> {
        let (model, look) = (subject.released(start), observer.look);
        let (findings, last) = match self.over {
            None => {
                let found = equilibrium(&model, &start.state, self, |step| look(step as f64))?;
                (json!({ "points": [point(&found)] }), found.state)
            }
            Some(_) => {
                let found = path(&model, &start.state, self, look)?;
                let last = found.points.last().map(|point| point.state.clone());
                (points(&found), last.unwrap_or_else(|| start.state.clone()))
            }
        };
        Ok(Record::new(findings, start.at(last)))
    }
}

/// A path of equilibria.
fn points(found: &EquilibriumPath) -> Value {
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
    json!({
        "q": found.state.q, "z": found.state.z, "lam": found.lam, "holders": found.holders,
        "efforts": found.efforts, "coordinates": found.coordinates, "stiffness": found.stiffness,
        "eigenvalues": found.eigenvalues, "stable": found.stable, "residual": found.residual,
        "steps": found.steps, "relaxed": found.relaxed
    })
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
                "check the laws of the forces at rest, such as a division by a rate",
            ),
            Reason::State { name } => {
                outcome(ErrorClass::Singularity, "its rate must depend on it").name(name)
            }
            Reason::Endless { coordinate, force, unit, .. } => {
                let unit = if unit == "m" { "N" } else { "N m" };
                let hint = format!(
                    "{force:.4} {unit} still act along {coordinate}; add a spring or a stop, or \
                     hold = [\"{coordinate}\"]"
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
                let hint = format!("hold = [\"{coordinate}\"] keeps it where it is");
                outcome(ErrorClass::Singularity, &hint).name(coordinate)
            }
            Reason::Stopped => outcome(ErrorClass::Internal, "the search was stopped"),
        }
    }
}
