//! Bodies that cannot move, and bodies that no joint holds.

use super::passing::freedoms;
use crate::analyses::mobility::neighbour;
use crate::elements::Group;
use crate::math::Listed;
use crate::model::{beam_of, column_scales, Body, Model};
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
    let beams = first_ends(model);
    let moves = |beam: &usize| (1..beams.len()).any(|k| beams[k] == *beam && !locked.contains(&k));
    let whole = locked.iter().filter(|body| beams[**body] == **body && !moves(body));
    whole.map(|body| model.bodies[*body].name.clone()).list()
}

/// Of each body itself, or the first end of the beam to which it belongs.
fn first_ends(model: &Model) -> Vec<usize> {
    let first = |(k, body): (usize, &Body<f64>)| match beam_of(&body.name) {
        beam if beam == body.name => k,
        beam => model.body(beam).map_or(k, |first| first.0),
    };
    model.bodies.iter().enumerate().map(first).list()
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

/// The bodies that no chain of joints and beams connects to ground.
pub(super) fn loose(model: &Model) -> Vec<String> {
    let beams = first_ends(model);
    let mut held = vec![false; model.bodies.len()];
    held[0] = true;
    let joints = || model.constraints.iter().filter(|item| item.group == Group::Joints);
    loop {
        let reached: Vec<usize> = joints()
            .filter(|item| item.bodies.iter().any(|body| held[beams[body.0]]))
            .flat_map(|item| item.bodies.iter().map(|body| beams[body.0]))
            .filter(|body| !held[*body])
            .list();
        if reached.is_empty() {
            break;
        }
        reached.into_iter().for_each(|body| held[body] = true);
    }
    let loose = (1..held.len()).filter(|k| beams[*k] == *k && !held[*k]);
    loose.map(|k| model.bodies[k].name.clone()).list()
}
