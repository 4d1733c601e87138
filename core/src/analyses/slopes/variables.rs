//! Parameters and start values as numbers with derivatives.

use crate::equations::sensitivity::Slope;
use crate::expression::parameters::Parameters;
use crate::expression::Expression;
use crate::math::{Dual, Listed, Real};
use crate::model::{Model, Value};

/// Difference of two values of one formula, relative to the value.
const SAME: f64 = 1e-12;

/// The values of all parameters of a model, with derivatives with respect to those in `seeds`; those in `replaced` have
/// the given values. None if a formula cannot be read, which a model excludes.
pub(super) fn parameters(
    model: &Model,
    seeds: &[String],
    replaced: &[(String, Slope)],
) -> Option<Vec<Slope>> {
    let given = |name: &str, value: f64| {
        let known = replaced.iter().find(|(other, _)| other == name).map(|(_, slope)| *slope);
        let place = || seeds.iter().position(|seed| seed == name);
        known.or_else(|| Some(Dual::variable(value, place()?)))
    };
    evaluated(model, &[], &given)
}

/// The values with which a run replaces parameters, as written in the analysis, with derivatives with respect to
/// `seeds`. An action may have replaced a value by another number, which then has no derivatives.
pub(super) fn replacements(
    model: &Model,
    seeds: &[String],
    written: &[(String, Value)],
    values: &[(String, f64)],
) -> Option<Vec<(String, Slope)>> {
    let formula = |value: &Value| match value {
        Value::Text(text) => Expression::parse(text).ok(),
        Value::Number(number) => Expression::number(*number).ok(),
        _ => None,
    };
    let read = |(name, value): &(String, Value)| Some((name.clone(), formula(value)?));
    let own: Vec<(String, Expression)> = written.iter().filter_map(read).list();
    let given = |name: &str, value: f64| {
        Some(Dual::variable(value, seeds.iter().position(|seed| seed == name)?))
    };
    let all = evaluated(model, &own, &given)?;
    let of = |(name, value): &(String, f64)| {
        let place = own.iter().position(|(other, _)| other == name);
        let found = place.map(|k| all[model.parameters.len() + k]);
        let same = found.filter(|slope| (slope.value - value).abs() <= SAME * value.abs());
        (name.clone(), same.unwrap_or(Slope::constant(*value)))
    };
    Some(values.iter().map(of).list())
}

/// The values of all parameters of a model, followed by those of more formulas. `given` may give the value of a
/// parameter instead of its formula.
fn evaluated(
    model: &Model,
    more: &[(String, Expression)],
    given: &dyn Fn(&str, f64) -> Option<Slope>,
) -> Option<Vec<Slope>> {
    let blueprint = &model.blueprint;
    let named =
        |(k, (_, of)): (usize, &(String, Expression))| (format!("replacement_{k}"), of.clone());
    let more = more.iter().enumerate().map(named);
    let own = blueprint.formulas.iter().map(|(name, of)| (name.clone(), of.clone()));
    let all: Vec<(String, Expression)> = own.chain(more).list();
    let written = all.iter().map(|(name, of)| (name.as_str(), of.clone())).list();
    let compiled = Parameters::compile(&written, &blueprint.tables).ok()?;
    Some(compiled.evaluate(|k| given(&all[k].0, *model.parameters.get(k)?)))
}
