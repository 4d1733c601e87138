//! The reply for an analysis whose result is not a motion.

use crate::pose::{pose, residual};
use kempe::analyses::record::{Fact, Record};
use kempe::{Model, State};
use serde_json::{json, Map, Value};

/// Largest violation of the constraints, relative to the size of the mechanism, of a position that is drawn. A parameter
/// that changes lengths moves positions away from the drawn mechanism.
const CLOSED: f64 = 1e-6;
/// The table of numbers with the outlines of an area: the number of the outline, x and y.
const OUTLINES: &str = "boundary";

/// The findings of a record: facts with their units, positions to draw, and outlines of areas, m.
pub fn described(model: &Model, record: &Record) -> Value {
    let drawn = |state: &State| residual(model, state.t, &state.q) <= CLOSED;
    let (shown, other): (Vec<_>, Vec<_>) =
        record.positions.iter().partition(|(_, state)| drawn(state));
    let mut remarks = record.remarks.clone();
    if !other.is_empty() {
        let count = other.len();
        remarks.push(format!("{count} positions are not drawn, because lengths differ there"));
    }
    let positions = shown.into_iter().map(|(name, state)| {
        let mut described = fact(name);
        described.insert("pose".to_string(), pose(model, state));
        Value::Object(described)
    });
    json!({
        "status": "found", "facts": record.facts.iter().map(fact).collect::<Vec<_>>(),
        "positions": positions.collect::<Vec<_>>(), "outlines": outlines(record),
        "findings": record.findings, "remarks": remarks, "error": null,
    })
}

fn fact(of: &Fact) -> Map<String, Value> {
    let Fact { name, value, unit } = of;
    let fields = [("name", json!(name)), ("value", value.clone()), ("unit", json!(unit))];
    fields.map(|(key, value)| (key.to_string(), value)).into_iter().collect()
}

/// Closed lines around the areas of a record.
fn outlines(record: &Record) -> Vec<Vec<[f64; 2]>> {
    let mut found: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut last = f64::NAN;
    for table in record.numbers.iter().filter(|table| table.name == OUTLINES) {
        for row in table.values.chunks_exact(3) {
            if row[0] != last {
                found.push(Vec::new());
                last = row[0];
            }
            found.last_mut().expect("an outline").push([row[1], row[2]]);
        }
    }
    found
}
