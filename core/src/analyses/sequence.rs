//! Checks of the analyses of a case: what is known without a run.

use super::conditions::Condition;
use super::dynamics;
use crate::model::{Entry, Model, Problem, Value};

/// Everything that is wrong with analyses that follow each other from an assembled start at t = 0.
pub fn check(model: &Model, analyses: &[Entry]) -> Vec<Problem> {
    let mut problems = releases(model);
    // the time at which each analysis ends, if it is known
    let mut ends = vec![("start", Some(0.0))];
    for entry in analyses {
        let path = ["analyses".to_string(), entry.name.clone()];
        let begin = match entry.get("from") {
            Some(Value::Text(name)) => ends.iter().rev().find(|(known, _)| known == name),
            _ => ends.last(),
        };
        let begin = begin.and_then(|(_, t)| *t);
        let end = match dynamics::read(model, &entry.fields, &path) {
            Err(found) => {
                problems.extend(found);
                None
            }
            Ok(options) => {
                problems.extend(options.fault(model, begin).map(|fault| {
                    let keys = path.iter().map(String::as_str).chain(fault.path);
                    let keys: Vec<&str> = keys.collect();
                    Problem::at(&keys, fault.message).maybe_hint(fault.hint.map(str::to_string))
                }));
                let path = ["analyses", &entry.name, "t_end"];
                problems.extend(begin.and_then(|begin| options.backward(begin, &path)));
                Some(options.t_end)
            }
        };
        ends.push((&entry.name, end));
    }
    problems
}

/// Conditions of drivers that are wrong.
fn releases(model: &Model) -> Vec<Problem> {
    let wrong = model.constraints.iter().filter_map(|driver| {
        let problem = Condition::read(model, &[], driver.element.release()?).err()?;
        let path = ["drivers", &driver.name, "release"].map(str::to_string).to_vec();
        Some(Problem { path, ..problem })
    });
    wrong.collect()
}
