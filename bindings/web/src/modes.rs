//! The configurations of a mechanism with its degrees of freedom held at their current values.

use crate::convert::Fields;
use crate::dragged::locked_at;
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::pose::pose;
use kempe::analyses::assemble::holding;
use kempe::analyses::configurations::configurations as core;
use kempe::analyses::record::Outcome;
use kempe::{mobility, Model, State};
use serde_json::{json, Value};

/// Default of the largest number of configurations.
const MOST: f64 = 24.0;

/// All positions in which the mechanism closes.
pub fn configurations(loaded: &Loaded, fields: &Fields<'_>) -> Result<Value, Fault> {
    let limit = fields.number_or("limit", MOST)?.clamp(1.0, 1000.0) as usize;
    let (model, state) = (&loaded.model, &loaded.state);
    let held = held(loaded)?;
    let names: Vec<&str> = held.iter().map(String::as_str).collect();
    let request = locked_at(model, state, &names)?;
    let found = core(model, &request, limit, &|| false).map_err(Outcome::from)?;
    let poses = found.states.iter().map(|(state, _)| pose(model, state));
    let poses: Vec<Value> = poses.collect();
    Ok(json!({ "complete": found.complete, "held": names, "poses": poses }))
}

/// Coordinates that determine the mechanism: first coordinates that the start sets, then angles and positions of
/// bodies.
fn held(loaded: &Loaded) -> Result<Vec<String>, Fault> {
    let model = &loaded.model;
    let own = loaded.case.start.set.iter().map(|(name, _)| name.clone());
    let bodies = || model.bodies.iter().enumerate().skip(1);
    let angles = bodies().filter(|(_, body)| body.turns).map(|(_, b)| format!("{}.angle", b.name));
    let places = bodies().flat_map(|(_, b)| ["x", "y"].map(|c| format!("{}.{c}", b.name)));
    let mut held: Vec<String> = Vec::new();
    let mut left = freedoms(model, loaded, &held)?;
    for name in own.chain(angles).chain(places) {
        let rate = ["vx", "vy", "omega"].iter().any(|rate| name.ends_with(&format!(".{rate}")));
        if left == 0 || rate || held.contains(&name) {
            continue;
        }
        held.push(name);
        match freedoms(model, loaded, &held) {
            Ok(fewer) if fewer < left => left = fewer,
            _ => {
                held.pop();
            }
        }
    }
    Ok(held)
}

fn freedoms(model: &Model, loaded: &Loaded, held: &[String]) -> Result<usize, Fault> {
    let names: Vec<&str> = held.iter().map(String::as_str).collect();
    let request = locked_at(model, &loaded.state, &names)?;
    let State { t, q, .. } = &loaded.state;
    Ok(mobility(&holding(model, &request), *t, q).degrees_of_freedom)
}
