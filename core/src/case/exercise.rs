//! Variants of an exercise: random values of its parameters, and the texts of its questions with these values.

use super::digits;
use super::Case;
use crate::expression::unit::Unit;
use crate::math::{Listed, Random};
use crate::model::{Problem, Value};

/// A value of a parameter in a variant.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnValue {
    /// The parameter.
    pub name: String,
    /// Its value in SI units and rad.
    pub value: f64,
    /// The value with its unit, for people.
    pub shown: String,
}

/// The values of the random parameters of a case for a seed. The seed 0 gives the values of the file, and so none.
pub fn drawn(case: &Case, seed: u64) -> Result<Vec<DrawnValue>, Problem> {
    let Some(Value::Table(ranges)) = entry(&case.exercise, "parameters") else {
        return Ok(Vec::new());
    };
    let mut random = Random::new(seed);
    let mut found = Vec::new();
    for (name, range) in ranges.iter().filter(|_| seed > 0) {
        let Value::Table(range) = range else { continue };
        let number = |key: &str| match entry(range, key) {
            Some(Value::Number(x)) => Some(*x),
            _ => None,
        };
        let (from, to) = (number("from").unwrap_or(0.0), number("to").unwrap_or(0.0));
        let share = random.uniform();
        let x = match number("step") {
            Some(step) => {
                let count = ((to - from) / step + 1e-9).floor();
                from + step * (share * (count + 1.0)).floor()
            }
            None => from + (to - from) * share,
        };
        // four digits without a step, and no more than twelve with one
        let places = if number("step").is_some() { 11 } else { 3 };
        let x: f64 = format!("{x:.places$e}").parse().unwrap_or(x);
        let (factor, unit) = match entry(range, "unit") {
            Some(Value::Text(unit)) => (factor(unit, name)?, unit.as_str()),
            _ => (1.0, ""),
        };
        let shown = format!("{} {unit}", digits(x)).trim_end().to_string();
        found.push(DrawnValue { name: name.clone(), value: x * factor, shown });
    }
    Ok(found)
}

/// A text in which `{name}` of each parameter is its value in a variant.
pub fn filled(case: &Case, text: &str, values: &[DrawnValue]) -> String {
    let mut out = text.to_string();
    for (name, written) in &case.definition.parameters {
        let drawn = values.iter().find(|one| one.name == *name).map(|one| one.shown.clone());
        let own = || match (range_unit(case, name), written) {
            (Some(unit), Value::Number(x)) => {
                let factor = factor(unit, name).unwrap_or(1.0);
                let rounded = format!("{:.11e}", x / factor).parse().unwrap_or(x / factor);
                format!("{} {unit}", digits(rounded))
            }
            (_, Value::Number(x)) => digits(*x),
            (_, Value::Text(text)) => text.clone(),
            _ => name.clone(),
        };
        out = out.replace(&format!("{{{name}}}"), &drawn.unwrap_or_else(own));
    }
    out
}

fn range_unit<'a>(case: &'a Case, name: &str) -> Option<&'a str> {
    let Some(Value::Table(ranges)) = entry(&case.exercise, "parameters") else { return None };
    let Some(Value::Table(range)) = entry(ranges, name) else { return None };
    match entry(range, "unit") {
        Some(Value::Text(unit)) => Some(unit),
        _ => None,
    }
}

fn entry<'a>(table: &'a [(String, Value)], key: &str) -> Option<&'a Value> {
    table.iter().find(|(known, _)| known == key).map(|(_, value)| value)
}

fn factor(unit: &str, name: &str) -> Result<f64, Problem> {
    let found = Unit::parse(unit).map(|unit| unit.numerator / unit.denominator);
    let path = ["exercise", "parameters", name, "unit"];
    found.map_err(|_| Problem::at(&path, format!("unknown unit '{}'", super::shown(unit))))
}

/// The fault of the unit of a range, if it has any.
pub(super) fn unit_faults(case: &Case) -> Vec<Problem> {
    let Some(Value::Table(ranges)) = entry(&case.exercise, "parameters") else {
        return Vec::new();
    };
    let fault = |(name, _): &(String, Value)| factor(range_unit(case, name)?, name).err();
    ranges.iter().filter_map(fault).list()
}
