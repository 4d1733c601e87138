//! Dragging a point of a mechanism.

use crate::convert::Fields;
use crate::fault::Fault;
use crate::loaded::Loaded;
use crate::pose::pose;
use kempe::analyses::assemble::{holding, Request, Target};
use kempe::analyses::dragging::{drag as core, DeadPoint, Grip};
use kempe::elements::BodyId;
use kempe::math::Local;
use kempe::model::Value as Written;
use kempe::{mobility, Model, State, Vec2};
use serde_json::{json, Value};

/// Moves a point towards a target. Drivers do not act meanwhile. The new state is at rest.
pub fn drag(loaded: &mut Loaded, fields: &Fields<'_>) -> Result<Value, Fault> {
    if !loaded.assembled {
        return Err(Fault::new("the mechanism does not close").hint("assemble it first"));
    }
    let body = moving(&loaded.model, fields.text("body")?)?;
    let ([x, y], [to_x, to_y]) = (fields.pair("point")?, fields.pair("to")?);
    let locked = fields.texts("locked")?;
    let (free, freedoms) = &loaded.free;
    let (t, q) = (loaded.state.t, &loaded.state.q);
    let mut grip = Grip { body, point: Local::new(x, y), degrees_of_freedom: *freedoms };
    let target = Vec2::new(to_x, to_y);
    let found = if locked.is_empty() {
        core(free, t, q, grip, target)
    } else {
        let held = holding(free, &locked_at(free, &loaded.state, &locked)?);
        grip.degrees_of_freedom = mobility(&held, t, q).degrees_of_freedom;
        core(&held, t, q, grip, target)
    };
    let Some(found) = found else {
        let text = "no motion can be computed at this singular position";
        return Ok(json!({ "pose": pose(&loaded.model, &loaded.state), "stopped": text }));
    };
    let q = found.q[..loaded.model.layout.n_q].to_vec();
    loaded.state = State { v: vec![0.0; q.len()], q, ..loaded.state.clone() };
    let stopped = found.dead_point.map(|dead_point| {
        let name = &loaded.model.bodies[body.0].name;
        match dead_point {
            DeadPoint { in_line: Some([a, b]) } => {
                format!("{name} cannot go farther: dead point, {a} and {b} in line")
            }
            DeadPoint { in_line: None } => format!("{name} cannot go farther: dead point"),
        }
    });
    Ok(json!({ "pose": pose(&loaded.model, &loaded.state), "stopped": stopped }))
}

/// A moving body by name.
pub fn moving(model: &Model, name: &str) -> Result<BodyId, Fault> {
    let body = model.body(name).filter(|body| !body.is_ground());
    body.ok_or_else(|| Fault::new(format!("there is no moving body '{name}'")))
}

/// The request that holds coordinates at their current values.
pub fn locked_at(model: &Model, state: &State, names: &[&str]) -> Result<Request, Fault> {
    let values = kempe::analyses::readings::of_state(model, state, names);
    let written = names.iter().zip(values);
    let written: Vec<(String, Written)> =
        written.map(|(name, x)| ((*name).to_string(), Written::Number(x))).collect();
    let set: Vec<Target> = kempe::analyses::assemble::targets(model, "set", &written)
        .map_err(|found| Fault::of_problems(&found))?;
    Ok(Request { set, t: state.t, ..Request::default() })
}
