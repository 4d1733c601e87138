//! The range of the multipliers while drivers hold friction at rest.
//!
//! Friction in a joint that drivers hold may have any value up to its limit while it is at rest: the drivers carry the
//! rest of the load. Reports use the value zero. The range follows from friction that slides either way, with the
//! coefficient of rest; the ranges of several joints are added.

use super::dynamics::{Failure, Prepared, States};
use crate::elements::{Behaviour, Mode};
use crate::equations::forces::Acting;
use crate::equations::kinematics::Motions;
use crate::equations::static_ratio;
use crate::integrate::Flow;
use crate::math::Listed;
use crate::model::Model;

/// The least and the largest multipliers at states, rows of n_rows, around `lam`. None if no friction is idle.
///
/// # Errors
/// The errors of [`Prepared::accelerations`].
pub fn friction_range(
    model: &Model,
    states: States<'_>,
    passing: bool,
    lam: &[f64],
) -> Result<Option<[Vec<f64>; 2]>, Box<Failure>> {
    let is_idle = |k: &usize| {
        let item = &model.forces[*k];
        item.mode == Mode::Idle && matches!(item.element.behaviour(), Some(Behaviour::Sticks))
    };
    let idle: Vec<usize> = (0..model.forces.len()).filter(is_idle).list();
    if idle.is_empty() || states.t.is_empty() {
        return Ok(None);
    }
    let (n, n_z, m) = (model.layout.n_q, model.layout.n_z, model.layout.n_rows);
    let motions = Motions::at(&model.layout, &states.q[..n], &states.v[..n]);
    let acting = Acting { z: &states.z[..n_z], lam: Some(&lam[..m]), t: states.t[0] };
    let [mut low, mut high] = [lam.to_vec(), lam.to_vec()];
    for k in idle {
        let ratio = static_ratio(model, k, &motions, acting);
        let mut ends = Vec::new();
        for sense in [-ratio, ratio] {
            let mut modes = model.blueprint.modes.clone();
            let own = modes.iter_mut().filter(|of| of.force == k);
            own.for_each(|own| own.mode = Mode::Slides(sense));
            let slides = model.marked(&modes);
            let found =
                Prepared::new(&slides).accelerations(states, passing, |_| Flow::Continue)?;
            ends.push(found.lam);
        }
        for (i, lam) in lam.iter().enumerate() {
            let [a, b] = [ends[0][i] - lam, ends[1][i] - lam];
            low[i] += a.min(b);
            high[i] += a.max(b);
        }
    }
    Ok(Some([low, high]))
}
