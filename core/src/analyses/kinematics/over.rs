//! A motion over a driven value: the value of a quantity replaces the time.
//!
//! The mechanism is rewritten so that the quantity equals t: in its driver, in the joint that has the quantity as a
//! field, or in a new driver. In the laws of all other joints and drivers, t keeps its value at the start.

use crate::analyses::readings::{self, Readable};
use crate::analyses::State;
use crate::elements::{self, Group};
use crate::math::{Listed, ShortArray};
use crate::model::{Definition, Entry, Model, Problem, Value};

/// Fields of joints and drivers that take laws of time.
const LAWS: [&str; 3] = ["value", "length", "residual"];
/// The name of a new driver, unless it is taken.
const NAME: &str = "over";

/// Rates with the positions of which they are the derivatives.
const RATES: [(&str, &str); 6] = [
    ("omega", "angle"),
    ("vx", "x"),
    ("vy", "y"),
    ("rate", "displacement"),
    ("rate", "length"),
    ("u_rate", "u"),
];

/// A mechanism in which t is the value of a quantity.
pub struct Over {
    /// The rewritten mechanism.
    pub definition: Definition,
    /// The quantity.
    pub quantity: String,
    /// Its SI unit.
    pub unit: String,
    /// Its value at the start, which is the new t.
    pub value: f64,
}

/// Rewrites the mechanism of `definition`, whose model is `model`, so that t is the value of `over`: the name of a
/// driver or of a position quantity.
///
/// # Errors
/// The model has no such driver or quantity, or several drivers already determine the motion.
pub fn over(
    definition: &Definition,
    model: &Model,
    start: &State,
    over: &str,
) -> Result<Over, Problem> {
    let followed = DrivenQuantity::named(definition, model, over)?;
    let value = readings::of_state(model, start, &[&followed.quantity])[0];
    let law = Value::Text("t".to_string());
    let definition = driving(definition, model, start.t, &[(&followed, law)])?;
    Ok(Over { definition, quantity: followed.quantity, unit: followed.unit, value })
}

/// A position quantity whose value a law gives.
pub struct DrivenQuantity {
    /// The quantity.
    pub quantity: String,
    /// Its SI unit.
    pub unit: String,
    /// The name that was given: the quantity or its driver.
    given: String,
    /// Its driver, if it has one.
    driver: Option<String>,
}

impl DrivenQuantity {
    /// The quantity of a driver, or a position quantity by its name.
    ///
    /// # Errors
    /// The model has no such driver or quantity.
    pub fn named(definition: &Definition, model: &Model, name: &str) -> Result<Self, Problem> {
        let drivers = &definition.drivers;
        let known = drivers.iter().find(|entry| entry.name == name);
        let quantity = known.and_then(|entry| text(entry, "coordinate")).unwrap_or(name);
        let found = position_named(model, quantity)
            .map_err(|problem| Problem { path: vec!["over".to_string()], ..problem })?;
        let own = drivers.iter().find(|entry| text(entry, "coordinate") == Some(quantity));
        Ok(Self {
            quantity: quantity.to_string(),
            unit: found.unit,
            given: name.to_string(),
            driver: own.map(|entry| entry.name.clone()),
        })
    }
}

/// A position quantity by its name.
///
/// # Errors
/// The model has no such quantity, or it is a rate.
pub(super) fn position_named(model: &Model, name: &str) -> Result<Readable, Problem> {
    let found = readings::find(model, name)?;
    let (owner, rate) = name.rsplit_once('.').unwrap_or_default();
    let positions = RATES.iter().filter(|(known, _)| *known == rate);
    let mut names = positions.map(|(_, position)| format!("{owner}.{position}"));
    match names.find(|name| readings::find(model, name).is_ok()) {
        None => Ok(found),
        Some(name) => Err(Problem::new(format!("'{rate}' is a rate; must be a position"))
            .hint(format!("name '{name}'"))),
    }
}

/// The mechanism in which laws give the values of quantities. Elsewhere, t keeps a value.
///
/// # Errors
/// Other drivers already determine the motion.
pub fn driving(
    definition: &Definition,
    model: &Model,
    t: f64,
    laws: &[(&DrivenQuantity, Value)],
) -> Result<Definition, Problem> {
    let mut definition = definition.clone();
    let own: Vec<&str> = laws.iter().filter_map(|(of, _)| of.driver.as_deref()).list();
    hold_others(&mut definition, &own, t);
    let free = model.layout.n_q.saturating_sub(model.layout.n_rows);
    let more = (laws.len() - own.len()).saturating_sub(free);
    if more > 0 {
        replace_drivers(&mut definition, &own, more, laws)?;
    }
    for (of, law) in laws {
        drive(&mut definition, of, law.clone());
    }
    Ok(definition)
}

fn text<'a>(entry: &'a Entry, key: &str) -> Option<&'a str> {
    match entry.get(key) {
        Some(Value::Text(text)) => Some(text),
        _ => None,
    }
}

/// Removes the other drivers of a mechanism without remaining degrees of freedom, at most `most` of them, and the
/// measures of these drivers.
fn replace_drivers(
    definition: &mut Definition,
    own: &[&str],
    most: usize,
    laws: &[(&DrivenQuantity, Value)],
) -> Result<(), Problem> {
    let others = |entry: &&Entry| !own.contains(&&*entry.name);
    let names: Vec<String> =
        definition.drivers.iter().filter(others).map(|one| one.name.clone()).list();
    if names.len() > most {
        let given: Vec<&str> = laws.iter().map(|(of, _)| &*of.given).list();
        let message = format!("the drivers {} determine the motion already", names.join(", "));
        let hint =
            format!("name one of them, or remove the one that {} replaces", given.join(" and "));
        return Err(Problem::at(&["over"], message).hint(hint));
    }
    definition.drivers.retain(|one| !names.contains(&one.name));
    for gone in names {
        let stays = |value: &Value| !matches!(value, Value::Text(text) if reads(text, &gone));
        definition.measures.retain(|(_, value)| stays(value));
    }
    Ok(())
}

/// Gives a quantity a law: in its driver, in the joint that has the quantity as a field, or in a new driver.
fn drive(definition: &mut Definition, of: &DrivenQuantity, law: Value) {
    let DrivenQuantity { quantity, driver, .. } = of;
    let (element, field) = quantity.rsplit_once('.').unwrap_or_default();
    let joint = definition.joints.iter_mut().find(|entry| entry.name == element);
    let field = joint.and_then(|entry| entry.fields.iter_mut().find(|(key, _)| key == field));
    if let (None, Some((_, value))) = (driver, field) {
        *value = law;
        return;
    }
    let fields = |kind: String| {
        let coordinate = Value::Text(quantity.clone());
        [("type", Value::Text(kind)), ("coordinate", coordinate), ("value", law)]
            .each(|(key, value)| (key.to_string(), value))
            .to_vec()
    };
    let own = definition.drivers.iter_mut().find(|entry| Some(&entry.name) == driver.as_ref());
    match own {
        Some(entry) => entry.fields = fields(text(entry, "type").unwrap_or_default().to_string()),
        None => {
            let name = free_name(definition);
            definition.drivers.push(Entry { name, fields: fields(driver_of_coordinates()) });
        }
    }
}

/// The type of the driver of a coordinate.
fn driver_of_coordinates() -> String {
    let drives = |table: &elements::Table| {
        ["coordinate", "value"].iter().all(|key| table.fields.iter().any(|one| one.name == *key))
    };
    let found = elements::catalogue().into_iter();
    let mut drivers = found.filter(|(group, table)| *group == Group::Drivers && drives(table));
    drivers.next().map(|(_, table)| table.name.to_string()).unwrap_or_default()
}

/// A name for a new driver: "over", or "over_1" and so on.
fn free_name(definition: &Definition) -> String {
    let Definition { bodies, joints, drivers, forces, measures, .. } = definition;
    let entries = [bodies, joints, drivers, forces].into_iter().flatten();
    let taken = entries.map(|entry| &entry.name).chain(measures.iter().map(|(name, _)| name));
    let taken: Vec<&String> = taken.list();
    let more = (1..=taken.len()).map(|k| format!("{NAME}_{k}"));
    let mut names = std::iter::once(NAME.to_string()).chain(more);
    names.find(|name| !taken.contains(&name)).expect("there are more names than entries")
}

/// Replaces t by a time in the laws of all joints, and of all drivers except some.
fn hold_others(definition: &mut Definition, drivers: &[&str], t: f64) {
    let others = |entry: &&mut Entry| !drivers.contains(&&*entry.name);
    for entry in definition.joints.iter_mut().chain(definition.drivers.iter_mut().filter(others)) {
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

/// The formula with the name `t` replaced by a number.
fn at_time(formula: &str, t: f64) -> String {
    let mut held = String::new();
    for (word, after) in words(formula) {
        match word == "t" && !after.starts_with('(') {
            true => held.push_str(&format!("({t:?})")),
            false => held.push_str(word),
        }
    }
    held
}

/// Whether a formula reads a quantity of an element.
fn reads(formula: &str, element: &str) -> bool {
    words(formula).any(|(word, _)| word.split_once('.').is_some_and(|(owner, _)| owner == element))
}

/// The names, numbers and other characters of a formula, each with the text after it.
fn words(formula: &str) -> impl Iterator<Item = (&str, &str)> {
    let in_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut rest = formula;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let length = match in_word(first) {
            true => rest.find(|c| !in_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (word, after) = rest.split_at(length);
        rest = after;
        Some((word, after))
    })
}
