//! Bodies that cannot move, and bodies that no joint holds.

use super::passing::freedoms;
use crate::analyses::mobility::neighbour;
use crate::elements::Group;
use crate::math::Listed;
use crate::model::{column_scales, Model};
use std::sync::Arc;

/// Components of a motion below this fraction of the motion count as rest. Lengths are relative to the size of the
/// mechanism.
const AT_REST: f64 = 1e-7;

/// The bodies that no motion without drivers moves. Empty if the model is too large for this check.
pub(super) fn locked(model: &Model, t: f64, q: &[f64]) -> Vec<String> {
    let Some(here) = resting(model, t, q) else { return Vec::new() };
    let mut locked = here;
    // a piston at a dead centre is at rest only in this position
    let near = neighbour(&released(model), t, q, 0, &|| false);
    if let Some(there) = near.and_then(|near| resting(model, t, &near)) {
        locked.retain(|body| there.contains(body));
    }
    locked.into_iter().map(|body| model.bodies[body].name.clone()).list()
}

/// The bodies with zero velocity in every motion at a position.
fn resting(model: &Model, t: f64, q: &[f64]) -> Option<Vec<usize>> {
    let (freedoms, scales) = (freedoms(model, t, q)?, column_scales(model));
    let rests = |body: &usize| {
        let columns = model.layout.bodies[*body].range();
        freedoms.iter().all(|w| columns.clone().all(|k| w[k].abs() <= AT_REST * scales[k]))
    };
    Some((1..model.bodies.len()).filter(rests).list())
}

/// The model without drivers and joints with a law of time.
fn released(model: &Model) -> Model {
    let items = model.constraints.iter().enumerate();
    let kept: Vec<usize> = items.filter(|(_, item)| !item.driven).map(|(k, _)| k).list();
    Model::new(&Arc::new(model.blueprint.keeping(&kept)), &model.parameters)
}

/// The bodies that no chain of joints connects to ground.
pub(super) fn loose(model: &Model) -> Vec<String> {
    let mut held = vec![false; model.bodies.len()];
    held[0] = true;
    let joints = || model.constraints.iter().filter(|item| item.group == Group::Joints);
    loop {
        let reached: Vec<usize> = joints()
            .filter(|item| item.bodies.iter().any(|body| held[body.0]))
            .flat_map(|item| item.bodies.iter().map(|body| body.0))
            .filter(|body| !held[*body])
            .list();
        if reached.is_empty() {
            break;
        }
        reached.into_iter().for_each(|body| held[body] = true);
    }
    let loose = model.bodies.iter().zip(held).filter(|(_, held)| !held);
    loose.map(|(body, _)| body.name.clone()).list()
}
