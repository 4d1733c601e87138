//! States between the reported states. An interpolant violates the constraints by the integration error. Near a
//! singular position this error is large in the velocities, so these states are projected in the same way as reported
//! states.

use super::failure::Failure;
use super::model_cache::ModelCache;
use super::options::Options;
use super::redundant_rows::workspace_at;
use super::report_projection::ReportProjection;
use super::stabilizations::Stabilization;
use super::trajectory::States;
use crate::equations::augmented::NearSingular;
use crate::math::each;
use crate::model::Model;
use crate::stabilize::Projection;

/// See [`Prepared::project`](super::Prepared::project).
pub(super) fn project(
    (model, cache): (&Model, &ModelCache),
    states: States<'_>,
    projection: Projection,
) -> Result<[Vec<f64>; 2], Box<Failure>> {
    let States { t, q, v, z } = states;
    let (n, n_z) = (model.layout.n_q, model.layout.n_z);
    let lengths = each([n, n, n_z], |width| width * t.len());
    assert_eq!([q.len(), v.len(), z.len()], lengths, "a row for each time");
    let Some(&first) = t.first() else { return Ok([Vec::new(), Vec::new()]) };
    let mut workspace = workspace_at((model, cache), first, [&q[..n], &v[..n], &z[..n_z]]);
    workspace.matrix.set_near_singular(NearSingular::Regularise);
    let stabilization = Stabilization::Projection(projection);
    let options = Options { stabilization, ..Options::new(0.0) };
    let mut placer = ReportProjection::new(model, &options, workspace);
    let mut projected = [q.to_vec(), v.to_vec()];
    let mut y = vec![0.0; model.layout.n_y()];
    for (k, &t) in t.iter().enumerate() {
        let row = k * n..(k + 1) * n;
        let [to_q, to_v, to_z, _] = model.layout.split_mut(&mut y);
        to_q.copy_from_slice(&q[row.clone()]);
        to_v.copy_from_slice(&v[row.clone()]);
        to_z.copy_from_slice(&z[k * n_z..(k + 1) * n_z]);
        let [of_q, of_v, of_z, _] = model.layout.split(&y);
        placer.exchange_rows(t, [of_q, of_v, of_z]);
        let placed = placer.place_on_branch(t, &mut y);
        placed.map_err(|breakdown| Failure::at_state(model, t, &q[row.clone()], breakdown))?;
        let [of_q, of_v, ..] = model.layout.split(&y);
        projected[0][row.clone()].copy_from_slice(of_q);
        projected[1][row].copy_from_slice(of_v);
    }
    Ok(projected)
}
