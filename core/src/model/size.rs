//! The size of a mechanism, which makes lengths and angles comparable.

use super::Model;
use crate::elements::Fixes;
use crate::math::{Listed, Real};
use std::f64::consts::TAU;

/// The size of a mechanism, m: the largest of the distances of points and curves from the origins of their frames,
/// of the distances between two points fixed by a joint, and of the arc lengths of beams. 1 m if there are no such distances.
pub fn size<S: Real>(model: &Model<S>) -> f64 {
    let points = model.bodies.iter().flat_map(|b| &b.points).map(|(_, s)| s.norm());
    let curves = model.bodies.iter().flat_map(|b| &b.curves).filter_map(|(_, c)| c.as_ref());
    let curves = curves.map(crate::elements::Curve::reach);
    let rods = model.constraints.iter().flat_map(|c| c.element.fixes());
    let rods = rods.filter_map(|fixed| match fixed {
        Fixes::Distance(length) | Fixes::Beside(length) => Some(length),
        _ => None,
    });
    let beams = model.forces.iter().filter_map(|item| item.element.reach());
    let largest = points
        .chain(rods)
        .chain(beams)
        .chain(curves)
        .map(|length| length.largest_magnitude())
        .fold(0.0, f64::max);
    if largest > 0.0 {
        largest
    } else {
        1.0
    }
}

/// The energy of a usual motion, J: the heaviest body moves by the size of the mechanism, against gravity or within a
/// second. Positive.
pub fn usual_energy(model: &Model) -> f64 {
    let heaviest = model.bodies.iter().map(|body| body.mass).fold(0.0, f64::max);
    let size = size(model);
    (heaviest * size * (model.gravity.norm() + size)).max(f64::MIN_POSITIVE)
}

/// Scale of each coordinate, shape (n_q): the size for lengths, 1 for angles, and the range of the curve over 2π for
/// the place of a joint on its curve, whatever its unit.
pub fn column_scales<S: Real>(model: &Model<S>) -> Vec<f64> {
    let size = size(model);
    let lengths = model.layout.lengths().into_iter();
    let mut scales = lengths.map(|length| if length { size } else { 1.0 }).list();
    for (item, slots) in model.constraints.iter().zip(&model.layout.constraints) {
        let Some(on) = item.element.curve().filter(|_| slots.own.count > 0) else { continue };
        let [from, to] = on.curve.range();
        let scale = (to - from).largest_magnitude() / TAU;
        scales[slots.own.first] = if scale > 0.0 { scale } else { size };
    }
    scales
}

/// Scale of each row of Φ, shape (n_rows): the size for lengths, 1 for angles.
pub fn row_scales<S: Real>(model: &Model<S>) -> Vec<f64> {
    let size = size(model);
    let equations = model.constraints.iter().flat_map(|c| &c.equations);
    equations.map(|equation| equation.kind.scale(size)).list()
}
