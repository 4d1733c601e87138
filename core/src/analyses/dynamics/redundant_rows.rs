//! Redundant equations of a run. They are omitted, and the motion follows from the independent equations
//! (`equations/independent.rs`).

use super::model_cache::ModelCache;
use crate::analyses::mobility;
use crate::equations::augmented::NearSingular;
use crate::equations::{Gains, Workspace};
use crate::math::Listed;
use crate::model::Model;

/// The rows that repeat others at and near a position. Empty if redundant constraints are refused.
pub(super) fn redundant_rows(model: &Model, t: f64, q: &[f64]) -> Vec<usize> {
    match model.allow_redundancy {
        true => mobility(model, t, q).redundant_equations.iter().map(|one| one.row).list(),
        false => Vec::new(),
    }
}

/// A workspace for states near this one. Without redundant rows it equals the workspace of a model that does not
/// allow redundancy.
pub(super) fn workspace_at(
    (model, cache): (&Model, &ModelCache),
    t: f64,
    state: [&[f64]; 3],
) -> Workspace {
    let rows = redundant_rows(model, t, state[0]);
    let mut workspace = Workspace::on(model, cache.plan(model, !rows.is_empty()));
    if !rows.is_empty() {
        workspace.omit(&rows);
        let mut regular = workspace.clone();
        regular.matrix.set_near_singular(NearSingular::Regularise);
        if exchange(model, &mut regular, t, state) {
            workspace.omit(regular.matrix.omitted());
        }
    }
    workspace
}

/// Omits other redundant rows if this state requires it; returns whether the rows changed.
pub(super) fn exchange(
    model: &Model,
    workspace: &mut Workspace,
    t: f64,
    state: [&[f64]; 3],
) -> bool {
    !workspace.matrix.omitted().is_empty()
        && workspace.accelerate(model, t, state, Gains::default()).is_ok()
        && workspace.exchange_rows(model)
}
