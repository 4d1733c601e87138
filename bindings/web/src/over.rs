//! A motion over a driven value: it takes the place of the time, as in `kp.kinematics(over=…)`.

use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::analyses::readings;
use kempe::model::{Definition, Entry, Value};
use kempe::{build, Model, State};
use std::sync::Arc;

/// Fields of joints and drivers that take laws of time.
const LAWS: [&str; 3] = ["value", "length", "residual"];
/// The name of a new driver; users cannot write names with a space.
const NAME: &str = "driven value";

/// What takes the place of the time: a quantity and its unit.
pub struct Variable {
    pub name: String,
    pub unit: String,
}

/// The model in which t is the value of `over`, a driver or a position quantity, and the start with this t. Laws of other
/// drivers keep their value at the start.
pub fn driven_by(
    loaded: &Loaded,
    over: &str,
    start: &State,
) -> Result<(Arc<Model>, State, Variable), Fault> {
    let mut definition = loaded.case.definition.clone();
    let known = definition.drivers.iter().find(|entry| entry.name == over);
    let quantity = known.and_then(|entry| text(entry, "coordinate")).unwrap_or(over).to_string();
    let same = |entry: &&Entry| text(entry, "coordinate") == Some(&quantity);
    let driver = definition.drivers.iter().find(same).map(|entry| entry.name.clone());
    let found = readings::find(&loaded.model, &quantity).map_err(Fault::of_problem)?;
    let value = readings::of_state(&loaded.model, start, &[&quantity])[0];
    hold_others(&mut definition, driver.as_deref(), start.t);
    if driver.is_none() && loaded.model.layout.n_rows >= loaded.model.layout.n_q {
        replace_the_driver(&mut definition, &quantity)?;
    }
    drive(&mut definition, driver, &quantity);
    let model = build(&definition, &loaded.values()).map_err(|found| Fault::of_problems(&found))?;
    let start = State { t: value, ..start.clone() };
    Ok((Arc::new(model), start, Variable { name: quantity, unit: found.unit }))
}

fn text<'a>(entry: &'a Entry, key: &str) -> Option<&'a str> {
    match entry.get(key) {
        Some(Value::Text(text)) => Some(text),
        _ => None,
    }
}

/// Removes the only driver of a mechanism without freedom.
fn replace_the_driver(definition: &mut Definition, quantity: &str) -> Result<(), Fault> {
    if definition.drivers.len() > 1 {
        let names: Vec<&str> = definition.drivers.iter().map(|one| one.name.as_str()).collect();
        let names = names.join(", ");
        return Err(Fault::new(format!("over: the drivers {names} determine the motion already"))
            .hint(format!("name one of them, or remove the one that {quantity} replaces")));
    }
    definition.drivers.clear();
    Ok(())
}

/// Lets t drive a quantity: by its driver, by the joint that has it as a field, or by a new driver.
fn drive(definition: &mut Definition, driver: Option<String>, quantity: &str) {
    let law = || Value::Text("t".to_string());
    let (element, field) = quantity.rsplit_once('.').unwrap_or_default();
    let joint = definition.joints.iter_mut().find(|entry| entry.name == element);
    let field = joint.and_then(|entry| entry.fields.iter_mut().find(|(key, _)| key == field));
    if let (None, Some((_, value))) = (&driver, field) {
        *value = law();
        return;
    }
    let fields = vec![
        ("type".to_string(), Value::Text(driver_of_coordinates())),
        ("coordinate".to_string(), Value::Text(quantity.to_string())),
        ("value".to_string(), law()),
    ];
    let name = driver.unwrap_or_else(|| NAME.to_string());
    definition.drivers.retain(|entry| entry.name != name);
    definition.drivers.push(Entry { name, fields });
}

/// The type of the driver of a coordinate.
fn driver_of_coordinates() -> String {
    let found = kempe::case::catalogue();
    let has = |kind: &serde_json::Value, key: &str| {
        kind["fields"].as_array().is_some_and(|all| all.iter().any(|field| field["name"] == key))
    };
    let mut drivers = found["drivers"].as_array().into_iter().flatten();
    let kind = drivers.find(|kind| has(kind, "coordinate") && has(kind, "value"));
    kind.and_then(|kind| kind["name"].as_str()).unwrap_or_default().to_string()
}

/// Replaces the time in the laws of joints and drivers by that of the start, except in one driver.
fn hold_others(definition: &mut Definition, driver: Option<&str>, t: f64) {
    for entry in definition.joints.iter_mut().chain(&mut definition.drivers) {
        if Some(entry.name.as_str()) == driver {
            continue;
        }
        let laws = entry.fields.iter_mut().filter(|(key, _)| LAWS.contains(&key.as_str()));
        laws.for_each(|(_, value)| hold(value, t));
    }
}

fn hold(value: &mut Value, t: f64) {
    match value {
        Value::Text(text) => *text = at_time(text, t),
        Value::List(values) => values.iter_mut().for_each(|one| hold(one, t)),
        _ => {}
    }
}

/// A formula with a number in place of the name `t`.
fn at_time(formula: &str, t: f64) -> String {
    let in_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let (mut held, mut rest) = (String::new(), formula);
    while let Some(first) = rest.chars().next() {
        let length = match in_word(first) {
            true => rest.find(|c| !in_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (word, after) = rest.split_at(length);
        match word == "t" && !after.starts_with('(') {
            true => held.push_str(&format!("({t:?})")),
            false => held.push_str(word),
        }
        rest = after;
    }
    held
}
