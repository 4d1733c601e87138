//! Connected light bodies with freedoms of their own, such as the links of a rope: their coordinates outnumber the
//! rows of their joints.
//!
//! Inertia is added to most of these bodies, and its removal takes much longer than their elimination
//! (`equations/downdates.rs`). They therefore count as light only at a smaller mass.

use crate::math::Real;
use crate::model::{Model, Slots};

/// Which of the `light` bodies, ground first, are such bodies.
pub(super) fn loose<S: Real>(model: &Model<S>, light: &[bool]) -> Vec<bool> {
    let layout = &model.layout;
    let members = |slots: &Slots| -> Vec<usize> {
        let bodies = slots.blocks.iter().filter_map(|block| block.body.map(|body| body.0));
        bodies.filter(|body| light[*body]).collect()
    };
    let mut group: Vec<usize> = (0..light.len()).collect();
    for bodies in layout.constraints.iter().map(members) {
        for pair in bodies.windows(2) {
            let (to, from) = (group[pair[0]], group[pair[1]]);
            if to != from {
                group.iter_mut().filter(|group| **group == from).for_each(|group| *group = to);
            }
        }
    }
    let (mut coordinates, mut rows) = (vec![0; light.len()], vec![0; light.len()]);
    for (body, columns) in layout.bodies.iter().enumerate() {
        coordinates[group[body]] += columns.range().len();
    }
    for slots in &layout.constraints {
        if let Some(body) = members(slots).first() {
            coordinates[group[*body]] += slots.own.range().len();
            rows[group[*body]] += slots.rows.len();
        }
    }
    let is_loose = |body: usize| light[body] && coordinates[group[body]] > rows[group[body]];
    (0..light.len()).map(is_loose).collect()
}
