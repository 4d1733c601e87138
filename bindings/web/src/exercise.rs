//! The section `[exercise]` of a case: its questions with the values of a variant, and the check of answers.

use crate::columns::{sweep, unit, value};
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::typed::typed;
use kempe::analyses::assemble::Request;
use kempe::analyses::readings;
use kempe::case::exercise::{drawn, filled, DrawnValue};
use kempe::model::Value as Written;
use kempe::{assemble, build};
use serde_json::{json, Value};

/// The relative tolerance of a question without one.
const TOLERANCE: f64 = 0.01;
/// Answers below this, in SI units, are zeros with rounding errors.
const ZERO: f64 = 1e-12;

/// The questions of a case with the values of a variant.
pub struct Exercise<'a> {
    loaded: &'a Loaded,
    seed: u64,
    values: Vec<DrawnValue>,
}

/// The answer to a question in SI units, its unit, and the largest error that counts as right.
pub struct Key {
    /// The answer.
    pub value: f64,
    /// The largest error.
    pub within: f64,
}

fn entry<'a>(table: &'a [(String, Written)], key: &str) -> Option<&'a Written> {
    table.iter().find(|(known, _)| known == key).map(|(_, value)| value)
}

fn text<'a>(table: &'a [(String, Written)], key: &str) -> Option<&'a str> {
    match entry(table, key) {
        Some(Written::Text(text)) => Some(text),
        _ => None,
    }
}

impl<'a> Exercise<'a> {
    /// The exercise of a case for a seed; by default that of the section.
    pub fn read(loaded: &'a Loaded, seed: Option<u64>) -> Result<Self, Fault> {
        let section = &loaded.case.exercise;
        if section.is_empty() {
            return Err(Fault::new("the case has no section [exercise]"));
        }
        let own = match entry(section, "seed") {
            Some(Written::Number(x)) => *x as u64,
            _ => 0,
        };
        let seed = seed.unwrap_or(own);
        let values = drawn(&loaded.case, seed).map_err(Fault::of_problem)?;
        Ok(Self { loaded, seed, values })
    }

    fn questions(&self) -> &'a [(String, Written)] {
        match entry(&self.loaded.case.exercise, "questions") {
            Some(Written::Table(questions)) => questions,
            _ => &[],
        }
    }

    fn question(&self, name: &str) -> Result<&'a [(String, Written)], Fault> {
        match entry(self.questions(), name) {
            Some(Written::Table(question)) => Ok(question),
            _ => Err(Fault::new(format!("there is no question '{name}'"))),
        }
    }

    /// The unit in which an answer without a unit is.
    fn unit(&self, question: &[(String, Written)]) -> String {
        let si = || match (text(question, "measure"), text(question, "quantity")) {
            (Some(column), _) => unit(&self.loaded.case, &self.loaded.model, column),
            (_, Some(name)) => {
                readings::find(&self.loaded.model, name).map(|of| of.unit).unwrap_or_default()
            }
            _ => String::new(),
        };
        text(question, "unit").map_or_else(si, str::to_string)
    }

    /// The exercise for a page.
    pub fn described(&self) -> Value {
        let case = &self.loaded.case;
        let fill = |text: &str| filled(case, text, &self.values);
        let one = |(name, question): &(String, Written)| {
            let Written::Table(question) = question else { return Value::Null };
            let hints: Vec<String> = match entry(question, "hints") {
                Some(Written::List(hints)) => hints
                    .iter()
                    .filter_map(|hint| match hint {
                        Written::Text(text) => Some(fill(text)),
                        _ => None,
                    })
                    .collect(),
                _ => Vec::new(),
            };
            let points = match entry(question, "points") {
                Some(Written::Number(x)) => *x,
                _ => 1.0,
            };
            json!({
                "name": name, "text": fill(text(question, "text").unwrap_or_default()),
                "unit": self.unit(question), "hints": hints, "points": points,
            })
        };
        let parameters: Vec<Value> = self
            .values
            .iter()
            .map(|one| json!({ "name": one.name, "value": one.value, "shown": one.shown }))
            .collect();
        json!({
            "seed": self.seed,
            "random": entry(&case.exercise, "parameters").is_some(),
            "text": fill(text(&case.exercise, "text").unwrap_or_default()),
            "parameters": parameters,
            "questions": self.questions().iter().map(one).collect::<Vec<_>>(),
        })
    }

    /// The changes of the text that give the mechanism the values of this variant.
    pub fn changes(&self) -> Value {
        let value = |one: &DrawnValue| match one.shown.contains(' ') {
            true => json!({ "path": ["parameters", one.name], "value": one.shown }),
            false => json!({ "path": ["parameters", one.name], "value": one.value }),
        };
        let mut changes: Vec<Value> = self.values.iter().map(value).collect();
        changes.push(json!({ "path": ["exercise", "seed"], "value": self.seed }));
        json!({ "changes": changes })
    }

    /// The answer to a question.
    pub fn key(&self, name: &str) -> Result<Key, Fault> {
        let question = self.question(name)?;
        let of = |one: &DrawnValue| (one.name.clone(), one.value);
        let parameters: Vec<(String, f64)> = self.values.iter().map(of).collect();
        let analysis = text(&self.loaded.case.exercise, "analysis");
        let at = entry(question, "at");
        let value = match (text(question, "measure"), text(question, "quantity"), at) {
            (Some(column), ..) => {
                value(&sweep(self.loaded, &[column], analysis, None)?.0, &parameters)?
            }
            (_, Some(quantity), Some(at)) => {
                let column = format!("{quantity}.final");
                value(&sweep(self.loaded, &[&column], analysis, Some(at))?.0, &parameters)?
            }
            (_, Some(quantity), None) => self.at_start(quantity, &parameters)?,
            _ => return Err(Fault::new("the question has neither a measure nor a quantity")),
        };
        let within = tolerance(question, value, &self.unit(question), name)?;
        Ok(Key { value, within })
    }

    /// A quantity at the start.
    fn at_start(&self, quantity: &str, parameters: &[(String, f64)]) -> Result<f64, Fault> {
        let case = &self.loaded.case;
        let given: Vec<(String, Written)> =
            parameters.iter().map(|(name, x)| (name.clone(), Written::Number(*x))).collect();
        let model = build(&case.definition, &given).map_err(|of| Fault::of_problems(&of))?;
        let request: Request =
            case.start.request(&model).map_err(|found| Fault::new(found.to_string()))?;
        let (state, _) = assemble(&model, &request)
            .map_err(|failure| Fault::new(failure.message.clone()).hint(failure.hint.clone()))?;
        readings::find(&model, quantity).map_err(Fault::of_problem)?;
        Ok(readings::of_state(&model, &state, &[quantity])[0])
    }

    /// Whether an answer is correct: `{ right, value }` with its value in SI units.
    pub fn checked(&self, name: &str, given: &str) -> Result<Value, Fault> {
        let question = self.question(name)?;
        let given = Written::Text(given.trim().to_string());
        let given = typed(&given, "the answer", &self.unit(question))?;
        let key = self.key(name)?;
        Ok(json!({ "right": (given - key.value).abs() <= key.within, "value": given }))
    }
}

/// The largest error of an answer: a share of the key, or a number with a unit.
fn tolerance(
    question: &[(String, Written)],
    key: f64,
    unit: &str,
    name: &str,
) -> Result<f64, Fault> {
    let share = |share: f64| {
        if key.abs() < ZERO {
            let message = format!("the answer to '{name}' is 0, which has no relative tolerance");
            return Err(
                Fault::new(message).hint("write a tolerance with a unit, such as \"0.5 N\"")
            );
        }
        Ok(share * key.abs())
    };
    match entry(question, "tolerance") {
        None => share(TOLERANCE),
        Some(Written::Number(x)) => share(*x),
        Some(Written::Text(text)) => match text.trim().strip_suffix('%') {
            Some(percent) => {
                let found = percent.trim().parse::<f64>();
                let wrong = |_| Fault::new(format!("tolerance of '{name}': '{text}'"));
                share(found.map_err(wrong)? / 100.0)
            }
            None => typed(&Written::Text(text.clone()), "tolerance", unit),
        },
        Some(_) => Err(Fault::new(format!("the tolerance of '{name}' is not a number"))),
    }
}
