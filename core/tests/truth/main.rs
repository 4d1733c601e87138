//! Published and independently computed numbers, `tests/reference/`, reproduced.

#[path = "../mechanisms/mod.rs"]
mod mechanisms;

mod adams;
mod andrews;
mod apart;
mod baumgarte;
mod convergence;
mod forces;
mod four_bar;
mod n_four_bar;
mod passing;
mod pendulum;
mod point_mass;
mod position;
mod projection;
mod slots;
mod solved;
mod teeth;
mod wheels;

use serde_json::Value;

/// A file of `tests/reference/`.
fn reference(name: &str) -> Value {
    let path = format!("{}/../tests/reference/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).expect("the file")).expect("JSON")
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().expect("a number"),
        other => other.as_f64().expect("a number"),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}
