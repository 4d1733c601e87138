//! The modes of friction at states outside of runs.
//!
//! A run begins with modes that it finds at its start. The same modes hold at any state, so that its accelerations and
//! reactions are those of a run that begins there. Contacts with restitution stay open: only a run decides them.

use super::super::failure::Failure;
use super::holding;
use super::place::{drivers_rest, with_modes, StateAt, STILL};
use crate::elements::{Behaviour, Mode};
use crate::model::{DriverSet, ForceMode, Model};
use std::rc::Rc;

/// Whether friction of a model may be at rest, so that its modes depend on the state.
pub fn can_stick(model: &Model) -> bool {
    with_modes(model).any(|k| sticks(model, k))
}

pub(super) fn sticks(model: &Model, force: usize) -> bool {
    let item = &model.forces[force];
    item.mode == Mode::Open && matches!(item.element.behaviour(), Some(Behaviour::Sticks))
}

/// The modes of friction at states with the times `t`, for each state; empty where all friction moves.
///
/// # Errors
/// [`Failure`] where no friction agrees with the reactions.
pub fn friction_modes(
    model: &Model,
    [t, q, v, z]: [&[f64]; 4],
) -> Result<Vec<Vec<ForceMode>>, Box<Failure>> {
    let (n, n_z) = (model.layout.n_q, model.layout.n_z);
    let all: Vec<usize> = with_modes(model).filter(|k| sticks(model, *k)).collect();
    if all.is_empty() {
        return Ok(vec![Vec::new(); t.len()]);
    }
    let drivers = (0..model.constraints.len()).filter(|k| model.constraints[*k].driven);
    let drivers: Vec<DriverSet> = drivers.map(|k| DriverSet::of([k])).collect();
    let phases = Rc::default();
    let own = |(k, t): (usize, &f64)| {
        let row = k * n..(k + 1) * n;
        let [q, v, z] = [&q[row.clone()], &v[row], &z[k * n_z..(k + 1) * n_z]];
        let mut y = [q, v, z, &vec![0.0; model.layout.n_works]].concat();
        let mut place = StateAt::new(model, *t, &mut y).sharing(&phases);
        let still = STILL * place.rate_scale(&place.phase(model, &[]));
        let speeds = place.thresholds(model, &all);
        let slow =
            all.iter().zip(speeds).any(|(k, speed)| speed.abs() <= still * place.unit(model, *k));
        if !slow && !drivers.iter().any(|own| drivers_rest(model, *own, *t, q)) {
            return Ok(Vec::new());
        }
        let found = holding::decide(model, &mut place, &[], (&[], None), (&[], &[]))?;
        Ok(found.into_iter().filter(|of| all.contains(&of.force)).collect())
    };
    t.iter().enumerate().map(own).collect()
}
