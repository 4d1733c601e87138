//! Checks of the analyses of a case that need no run.

use super::conditions::Condition;
use super::configurations::Options as ConfigurationsOptions;
use super::diagnosis::Options as MobilityOptions;
use super::dynamics;
use super::equilibrium::Options as EquilibriumOptions;
use super::kinematics::{InverseOptions, Options as KinematicsOptions};
use super::limits::Options as LimitsOptions;
use super::linearization::Options as ModesOptions;
use super::options::Declared;
use crate::model::{Entry, Model, Problem, Value};

/// All problems of a sequence of analyses that begins with an assembled start at t = 0.
pub fn check(model: &Model, analyses: &[Entry]) -> Vec<Problem> {
    let mut problems = releases(model);
    // the end time of each analysis, if it is known
    let mut ends = vec![("start", Some(0.0))];
    for entry in analyses {
        let path = ["analyses".to_string(), entry.name.clone()];
        let begin = match entry.get("from") {
            Some(Value::Text(name)) => ends.iter().rev().find(|(known, _)| known == name),
            _ => ends.last(),
        };
        let begin = begin.and_then(|(_, t)| *t);
        let fields = &entry.fields;
        let kind = match entry.get("type") {
            Some(Value::Text(kind)) => kind.as_str(),
            _ => "",
        };
        let end = match kind {
            KinematicsOptions::NAME => {
                KinematicsOptions::checked(model, fields, &path).map(|options| options.t_end)
            }
            InverseOptions::NAME => {
                InverseOptions::checked(model, fields, &path).map(|options| options.t_end)
            }
            // an analysis of a position ends at the time at which it begins
            EquilibriumOptions::NAME => {
                EquilibriumOptions::checked(model, fields, &path).map(|_| begin)
            }
            ModesOptions::NAME => ModesOptions::checked(model, fields, &path).map(|_| begin),
            LimitsOptions::NAME => LimitsOptions::checked(model, fields, &path).map(|_| begin),
            MobilityOptions::NAME => MobilityOptions::checked(model, fields, &path).map(|_| begin),
            ConfigurationsOptions::NAME => {
                ConfigurationsOptions::checked(model, fields, &path).map(|_| begin)
            }
            _ => dynamics_end(model, fields, &path, begin),
        };
        ends.push((
            &entry.name,
            end.unwrap_or_else(|found| {
                problems.extend(found);
                None
            }),
        ));
    }
    problems
}

/// The end of an analysis of type `dynamics` that begins at a known time.
fn dynamics_end(
    model: &Model,
    fields: &[(String, Value)],
    path: &[String],
    begin: Option<f64>,
) -> Result<Option<f64>, Vec<Problem>> {
    let options = dynamics::read(model, fields, path)?;
    let keys = |more: &[&str]| -> Vec<String> {
        path.iter().cloned().chain(more.iter().map(ToString::to_string)).collect()
    };
    let at = |more: &[&str], message: String| {
        let keys = keys(more);
        Problem::at(&keys.iter().map(String::as_str).collect::<Vec<_>>(), message)
    };
    let mut problems = Vec::new();
    problems.extend(
        options
            .fault(model, begin)
            .map(|fault| at(&fault.path, fault.message).maybe_hint(fault.hint.map(str::to_string))),
    );
    let path = keys(&["t_end"]);
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    problems.extend(begin.and_then(|begin| options.backward(begin, &path)));
    match problems.is_empty() {
        true => Ok(Some(options.t_end)),
        false => Err(problems),
    }
}

/// The problems of release conditions of drivers.
fn releases(model: &Model) -> Vec<Problem> {
    let wrong = model.constraints.iter().filter_map(|driver| {
        let problem = Condition::read(model, &[], driver.element.release()?).err()?;
        let path = ["drivers", &driver.name, "release"].map(str::to_string).to_vec();
        Some(Problem { path, ..problem })
    });
    wrong.collect()
}
