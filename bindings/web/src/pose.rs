//! The description of a state of a mechanism for a page.

use crate::convert::row;
use kempe::analyses::meshed;
use kempe::equations::constraints;
use kempe::equations::kinematics::Motions;
use kempe::model::row_scales;
use kempe::{Model, State};
use serde_json::{json, Value};

/// Coordinates, poses and rates of the moving bodies, and the largest violation of the constraints.
pub fn pose(model: &Model, state: &State) -> Value {
    let State { t, q, v, z } = state;
    let motions = Motions::at(&model.layout, q, v);
    let moving = 1..model.bodies.len();
    let poses = moving.clone().map(|b| {
        let pose = &motions[b].pose;
        row(&[pose.r.x, pose.r.y, pose.angle])
    });
    let rates = moving.map(|b| {
        let twist = &motions[b].twist;
        row(&[twist.velocity.x, twist.velocity.y, twist.omega])
    });
    json!({
        "t": t, "q": row(q), "v": row(v), "z": row(z),
        "poses": poses.collect::<Vec<_>>(), "rates": rates.collect::<Vec<_>>(),
        "residual": residual(model, *t, q),
    })
}

/// The largest violation of the constraints, with lengths relative to the size of the mechanism.
pub fn residual(model: &Model, t: f64, q: &[f64]) -> f64 {
    let meshed = meshed(model, t, q);
    let model = meshed.as_ref().unwrap_or(model);
    let mut phi = vec![0.0; model.layout.n_rows];
    constraints::residual(model, &Motions::at_rest(&model.layout, q), t, &mut phi);
    let scaled = phi.iter().zip(row_scales(model)).map(|(phi, scale)| (phi / scale).abs());
    scaled.fold(0.0, f64::max)
}
