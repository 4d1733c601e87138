//! Values of the named parameters, which may be formulas of each other.

use super::definition::{Definition, Value};
use super::problem::Problem;
use crate::expression::parameters::Parameters;
use crate::expression::{Expression, Inferred, Table};
use crate::math::Listed;
use std::sync::Arc;

/// The parameters of a model.
pub struct Evaluated {
    /// Their values. A faulty value is NaN.
    pub values: Vec<f64>,
    /// Their dimensions.
    pub inferred: Vec<Inferred>,
    /// Their formulas by name. Empty if one of them is faulty.
    pub formulas: Vec<(String, Expression)>,
}

/// Evaluates all parameters in the order of their dependence, and infers their dimensions.
///
/// `overrides` replace parameters by name. Faults are reported.
pub fn values(
    definition: &Definition,
    overrides: &[(String, Value)],
    tables: &[Arc<Table>],
    problems: &mut Vec<Problem>,
) -> Evaluated {
    let names: Vec<&str> = definition.parameters.iter().map(|(name, _)| name.as_str()).list();
    for (name, _) in overrides {
        if !names.contains(&name.as_str()) {
            let known = super::link::did_you_mean(name, &names, "parameters");
            let message = format!("there is no parameter '{name}' to set");
            problems.push(Problem::at(&["parameters"], message).maybe_hint(known));
        }
    }
    let mut formulas = Vec::new();
    for (name, written) in &definition.parameters {
        let given = overrides.iter().rev().find(|(n, _)| n == name).map_or(written, |(_, v)| v);
        match formula(given) {
            Ok(e) => formulas.push((name.clone(), e)),
            Err(problem) => problems
                .push(Problem { path: vec!["parameters".to_string(), name.clone()], ..problem }),
        }
    }
    if formulas.len() < names.len() {
        return faulty(names.len());
    }
    evaluate(formulas, tables, problems)
}

fn formula(value: &Value) -> Result<Expression, Problem> {
    match value {
        Value::Number(x) if x.is_finite() => {
            Expression::number(*x).map_err(|fault| Problem::new(fault.message))
        }
        Value::Number(x) => Err(Problem::new(format!("{x} is not a number to compute with"))),
        Value::Text(text) => Expression::parse(text).map_err(Problem::from),
        other => {
            let message = format!("must be a number or a formula, not {}", other.noun());
            Err(Problem::new(message))
        }
    }
}

/// The values of formulas that refer to each other. Faults are reported.
pub fn evaluate(
    formulas: Vec<(String, Expression)>,
    tables: &[Arc<Table>],
    problems: &mut Vec<Problem>,
) -> Evaluated {
    let written: Vec<(&str, Expression)> =
        formulas.iter().map(|(name, e)| (name.as_str(), e.clone())).list();
    let compiled = match Parameters::compile(&written, tables) {
        Ok(compiled) => compiled,
        Err(fault) => {
            let at = Problem::at(&["parameters", fault.name.as_str()], fault.error.message);
            problems.push(at.within(fault.error.span).maybe_hint(fault.error.hint));
            return faulty(formulas.len());
        }
    };
    let values = compiled.evaluate(|_| None);
    for ((name, _), x) in formulas.iter().zip(&values).filter(|(_, x)| !f64::is_finite(**x)) {
        problems.push(Problem::at(&["parameters", name], format!("becomes {x}; must be finite")));
    }
    Evaluated { values, inferred: compiled.inferred().to_vec(), formulas }
}

fn faulty(count: usize) -> Evaluated {
    let (values, inferred) = (vec![f64::NAN; count], vec![Inferred::Open; count]);
    Evaluated { values, inferred, formulas: Vec::new() }
}
