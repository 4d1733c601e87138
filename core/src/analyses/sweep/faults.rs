//! Faults of the variables and measures of a sweep that can be found with the model.

use super::statistic::Statistic;
use crate::analyses::assemble;
use crate::analyses::measures::Measure;
use crate::expression::suggest::did_you_mean;
use crate::math::Listed;
use crate::model::{Model, Problem, Value};

/// A statistic that the front end computes from the values of a measure.
const OF_FRONT: &str = "frequency";

/// The fault of the name of a variable: it must be a parameter, or a coordinate or rate that can be set.
pub fn variable_fault(model: &Model, name: &str) -> Option<Problem> {
    let parameters = &model.blueprint.parameters;
    if parameters.iter().any(|known| known == name) {
        return None;
    }
    if !name.contains('.') {
        let hint = did_you_mean(name, parameters);
        let problem = Problem::at(&[name], format!("there is no parameter '{name}'")).at_key();
        return Some(problem.maybe_hint(hint));
    }
    let target = [(name.to_string(), Value::Number(0.0))];
    assemble::targets(model, "set", &target).err()?.into_iter().next()
}

/// The fault of a measure with its statistic, such as `pin.max` with the declared measure `pin`, or `C.force.max`.
pub fn measure_fault(model: &Model, declared: &[(String, Value)], text: &str) -> Option<Problem> {
    let (name, statistic) = text.rsplit_once('.').unwrap_or(("", text));
    let known: Vec<&str> = Statistic::ALL.iter().map(|(known, _)| *known).chain([OF_FRONT]).list();
    if !known.contains(&statistic) {
        let message = format!("a measure has no statistic '{statistic}'");
        let hint = did_you_mean(statistic, &known);
        let hint = hint.unwrap_or_else(|| format!("end the text with one of {}", known.join(", ")));
        return Some(Problem::new(message).hint(hint));
    }
    if declared.iter().any(|(known, _)| known == name) {
        return None;
    }
    Measure::read(model, name).err()
}
