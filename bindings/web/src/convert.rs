//! Fields of requests, and values between JSON and the core.

use crate::fault::Fault;
use kempe::model::Value as Written;
use serde_json::{json, Map, Value};

/// The fields of a request.
pub struct Fields<'a>(pub &'a Map<String, Value>);

impl<'a> Fields<'a> {
    /// A field that may be absent or null.
    pub fn get(&self, name: &str) -> Option<&'a Value> {
        self.0.get(name).filter(|value| !value.is_null())
    }

    /// A field that must be present.
    pub fn need(&self, name: &str) -> Result<&'a Value, Fault> {
        self.get(name).ok_or_else(|| Fault::new(format!("the request has no field '{name}'")))
    }

    /// A text.
    pub fn text(&self, name: &str) -> Result<&'a str, Fault> {
        self.need(name)?.as_str().ok_or_else(|| wrong(name, "a text"))
    }

    /// A finite number.
    pub fn number(&self, name: &str) -> Result<f64, Fault> {
        self.need(name)?.as_f64().ok_or_else(|| wrong(name, "a number"))
    }

    /// A finite number, or `absent` if it is missing.
    pub fn number_or(&self, name: &str, absent: f64) -> Result<f64, Fault> {
        self.get(name).map_or(Ok(absent), |_| self.number(name))
    }

    /// A list of numbers.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, Fault> {
        let list = self.need(name)?.as_array();
        let found: Option<Vec<f64>> = list.and_then(|x| x.iter().map(Value::as_f64).collect());
        found.ok_or_else(|| wrong(name, "a list of numbers"))
    }

    /// Two numbers.
    pub fn pair(&self, name: &str) -> Result<[f64; 2], Fault> {
        self.numbers(name)?.try_into().map_err(|_| wrong(name, "two numbers"))
    }

    /// A list of texts. Empty if it is absent.
    pub fn texts(&self, name: &str) -> Result<Vec<&'a str>, Fault> {
        let Some(value) = self.get(name) else { return Ok(Vec::new()) };
        let found = value.as_array().and_then(|x| x.iter().map(Value::as_str).collect());
        found.ok_or_else(|| wrong(name, "a list of texts"))
    }

    /// Names with values as in a file. Empty if absent.
    pub fn table(&self, name: &str) -> Result<Vec<(String, Written)>, Fault> {
        let Some(value) = self.get(name) else { return Ok(Vec::new()) };
        match written(value) {
            Some(Written::Table(found)) => Ok(found),
            _ => Err(wrong(name, "a table of numbers and texts")),
        }
    }

    /// Names with numbers.
    pub fn values(&self, name: &str) -> Result<Vec<(String, f64)>, Fault> {
        let table = self.need(name)?.as_object();
        let number = |(name, x): (&String, &Value)| Some((name.clone(), x.as_f64()?));
        let found = table.and_then(|table| table.iter().map(number).collect());
        found.ok_or_else(|| wrong(name, "a table of numbers"))
    }
}

fn wrong(name: &str, needed: &str) -> Fault {
    Fault::new(format!("the field '{name}' of the request must be {needed}"))
}

/// A value of a file; None for null.
pub fn written(value: &Value) -> Option<Written> {
    Some(match value {
        Value::Null => return None,
        Value::Bool(flag) => Written::Flag(*flag),
        Value::Number(x) => Written::Number(x.as_f64()?),
        Value::String(text) => Written::Text(text.clone()),
        Value::Array(list) => Written::List(list.iter().map(written).collect::<Option<_>>()?),
        Value::Object(table) => {
            let entry = |(key, value): (&String, &Value)| Some((key.clone(), written(value)?));
            Written::Table(table.iter().map(entry).collect::<Option<_>>()?)
        }
    })
}

/// Finite numbers. Other numbers become null.
pub fn row(values: &[f64]) -> Value {
    values.iter().map(|x| json!(x)).collect()
}

/// A value of a file as JSON.
pub fn json_of(value: &Written) -> Value {
    match value {
        Written::Number(x) => json!(x),
        Written::Text(text) => json!(text),
        Written::Flag(flag) => json!(flag),
        Written::List(list) => list.iter().map(json_of).collect(),
        Written::Table(table) => {
            Value::Object(table.iter().map(|(key, value)| (key.clone(), json_of(value))).collect())
        }
        Written::Function(_) => Value::Null,
    }
}
