//! The modes of forces in a phase of a run, and the indices of their multipliers.

use super::items::{ConstraintItem, ForceItem, ForceMode};
use super::layout::StateLayout;
use crate::elements::{Group, Mode};
use crate::math::{Listed, Real};

/// Sets the modes of forces, and the indices of their multipliers.
pub(super) fn set<S: Real>(
    forces: &mut [ForceItem<S>],
    constraints: &[ConstraintItem<S>],
    layout: &StateLayout,
    modes: &[ForceMode],
) {
    let with_modes = |item: &&mut ForceItem<S>| {
        let has_modes = item.element.behaviour().is_some_and(|behaviour| behaviour.has_modes());
        has_modes || item.element.driver().is_some()
    };
    for (k, item) in forces.iter_mut().filter(with_modes).enumerate() {
        item.held_row = Some(layout.n_rows + k);
    }
    let held = constraints.iter().position(|item| item.group == Group::Forces);
    let mut held = held.unwrap_or(constraints.len())..;
    for ForceMode { force, mode, .. } in modes {
        forces[*force].mode = *mode;
        if matches!(mode, Mode::Holds(_)) {
            let slots = held.next().and_then(|k| layout.constraints.get(k));
            if let Some(slots) = slots {
                forces[*force].held_row = Some(slots.rows.start);
            }
        }
    }
    for k in (0..forces.len()).filter(|k| forces[*k].is_companion).list() {
        let of = forces[k].partner.map(|of| &forces[of]);
        let rests = of.filter(|of| matches!(of.mode, Mode::Holds(_)));
        forces[k].load_row = rests.and_then(|of| of.held_row);
    }
}
