//! The size of a mechanism, the unit for comparisons of lengths and angles.

use super::Model;
use crate::elements::Fixes;
use crate::math::Real;

/// The size of a mechanism: the largest distance of a point from the origin of its frame, and that of two points which
/// a joint fixes, m; 1 m without any.
pub fn size<S: Real>(model: &Model<S>) -> f64 {
    let points = model.bodies.iter().flat_map(|b| &b.points).map(|(_, s)| s.norm());
    let rods = model.constraints.iter().flat_map(|c| c.element.fixes());
    let rods = rods.filter_map(|fixed| match fixed {
        Fixes::Distance(length) | Fixes::Beside(length) => Some(length),
        _ => None,
    });
    let largest = points.chain(rods).map(|length| length.largest_magnitude()).fold(0.0, f64::max);
    if largest > 0.0 {
        largest
    } else {
        1.0
    }
}

/// Scale of each coordinate, shape (n_q): the size for lengths, 1 for angles.
pub fn column_scales<S: Real>(model: &Model<S>) -> Vec<f64> {
    let size = size(model);
    model.layout.lengths().into_iter().map(|length| if length { size } else { 1.0 }).collect()
}

/// Scale of each row of Φ, shape (n_rows): the size for lengths, 1 for angles.
pub fn row_scales<S: Real>(model: &Model<S>) -> Vec<f64> {
    let size = size(model);
    let units = model.constraints.iter().flat_map(|c| c.equations.iter().map(|e| e.unit));
    units.map(|unit| if unit == "m" { size } else { 1.0 }).collect()
}
