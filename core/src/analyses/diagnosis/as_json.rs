//! A diagnosis as JSON, for the bindings.

use super::{Diagnosis, FourBar, Redundancy, Remedy};
use crate::math::Listed;
use serde_json::{json, Value};

/// The diagnosis of a position: counts, and lists of redundancies, singular positions, bodies and four-bar loops.
pub fn json(found: &Diagnosis) -> Value {
    let singular = found.singular.iter().map(|(one, kind)| {
        let mut one = redundancy(one);
        one["kind"] = json!(kind.to_string());
        one
    });
    json!({
        "gruebler": found.gruebler,
        "driven": found.driven,
        "degrees_of_freedom": found.mobility.degrees_of_freedom,
        "rank": found.mobility.rank,
        "redundant": found.redundant.iter().map(redundancy).list(),
        "singular": singular.list(),
        "locked": found.locked,
        "loose": found.loose,
        "undetermined": found.undetermined,
        "four_bars": found.four_bars.iter().map(four_bar).list(),
    })
}

fn redundancy(one: &Redundancy) -> Value {
    let Redundancy { joints, equations, remedies, remove, consistent } = one;
    let remedies: Vec<Value> = remedies.iter().map(remedy).list();
    json!({
        "joints": joints, "equations": equations, "remedies": remedies, "remove": remove,
        "consistent": consistent,
    })
}

fn remedy(one: &Remedy) -> Value {
    let (body, axis) = one.along.as_ref().map_or((None, None), |a| (a.body.clone(), Some(a.axis)));
    json!({
        "joint": one.joint, "equations": one.equations, "body": body, "axis": axis,
        "text": one.to_string(),
    })
}

fn four_bar(one: &FourBar) -> Value {
    let FourBar { bodies, pins, lengths, class } = one;
    let turning = class.turning().map(|places| places.map(|k| bodies[k].clone()).list());
    json!({ "bodies": bodies, "pins": pins, "lengths": lengths, "kind": class.to_string(), "turning": turning })
}
