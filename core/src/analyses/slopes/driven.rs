//! The derivatives of a motion that drivers determine, by the implicit function theorem at each time.

use crate::analyses::assemble::{determined, determines, implicit};
use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{constants, Sensitivity, Slope};
use crate::equations::{dense, Workspace};
use crate::math::Real;
use crate::model::Model;

/// The state at a time with its derivatives, in which the drivers determine all coordinates.
///
/// # Errors
/// The reason for which there are no derivatives.
pub(super) fn state(
    (model, workspace): (&Model, &mut Workspace),
    block: &mut Sensitivity,
    t: f64,
    [q, v, z]: [&[f64]; 3],
) -> Result<Vec<Slope>, String> {
    let (at, clear) = (Slope::constant(t), determines(workspace, model, t, q));
    let general = || dense::jacobian(model, &Motions::at(&model.layout, q, v), t);
    let mut follow = |x: &[f64], residual: Vec<Slope>| {
        let found = if clear { determined(workspace, model, x, &residual) } else { None };
        found.map_or_else(|| implicit(general(), x, &residual), Ok)
    };
    let of_q = follow(q, block.open(at, &constants(q)))?;
    let of_v = follow(v, block.opening(at, &of_q, &constants(v)))?;
    let mut state = [of_q, of_v, constants(z)].concat();
    state.resize(model.layout.n_y(), Slope::constant(f64::NAN));
    Ok(state)
}

/// Replaces the rates of q, v and z, the first `n_q` of which are zero, where positions at rest follow one another: q
/// changes along them, and nothing else. `state` gives q, v, z and the rates of q along such positions.
pub(super) fn follow(state: impl FnOnce() -> Option<[Vec<f64>; 4]>, rates: &mut [f64], n_q: usize) {
    let (of_q, others) = rates.split_at_mut(n_q);
    if of_q.iter().all(|v| *v == 0.0) {
        let along = state().map(|[.., along]| along).filter(|along| along.len() == n_q);
        if let Some(along) = along {
            of_q.copy_from_slice(&along);
            others.fill(0.0);
        }
    }
}
