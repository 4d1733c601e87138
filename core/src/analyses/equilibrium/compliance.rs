//! The compliance C = ∂(displacement)/∂(force) of a point of a mechanism at rest, shape (2, 2).
//!
//! With the reduced stiffness K and the motion P = ∂(point)/∂u with the independent coordinates u, C = P K⁻¹ Pᵀ. The
//! compliance is computed in place of the stiffness because it remains finite where a point is rigidly held.

use super::failure::Reason;
use super::holding;
use super::search::{relative, zero};
use super::statics::Statics;
use crate::analyses::linearization::coordinate;
use crate::analyses::State;
use crate::elements::BodyId;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Local, ShortArray};
use crate::model::Model;
use crate::solve::{solve_dense, Eigen};

/// Largest residual force of a state at rest, relative to the largest single force.
const AT_REST: f64 = 1e-6;
/// Motion of a point that counts as zero in a mode without stiffness, relative to the largest scale of the
/// coordinates.
const STILL: f64 = 1e-9;

/// Motion of a point that counts as a rounding error, relative to the largest scale of the coordinates.
const ROUNDING: f64 = 1e-13;

/// C of a point fixed in a body, m/N, row by row, at a state of rest. `hold` contains the names of position
/// quantities that are held.
///
/// # Errors
/// The state is not at rest, or the point moves without any stiffness.
pub fn compliance(
    model: &Model,
    state: &State,
    hold: &[String],
    body: BodyId,
    point: Local,
) -> Result<[f64; 4], Reason> {
    let held = holding::holding(model, state, hold)?;
    let mut statics = Statics::new(&held, state.t);
    let place = statics.place(&state.q, &state.z)?;
    let local = statics.local(&place)?;
    let left = relative(&local, &place);
    if left > AT_REST {
        return Err(Reason::Moving { relative: left });
    }
    let motions = Motions::at_rest(&held.layout, &place.q);
    let arm = motions[body.0].pose.global(point);
    let moved = |basis: &Vec<f64>| {
        let [x, y, angle] = held.layout.bodies[body.0].of(basis);
        [x - arm.y * angle, y + arm.x * angle]
    };
    let size = statics.columns.iter().fold(0.0, |most: f64, x| most.max(*x));
    let exact = |x: f64| if x.abs() > ROUNDING * size { x } else { 0.0 };
    let by_basis: Vec<[f64; 2]> =
        local.basis.basis.iter().map(|basis| moved(basis).each(exact)).list();
    let limit = zero(&local.stiffness, place.scale);
    let eigen = Eigen::of(&local.stiffness, local.gradient.len());
    for (value, vector) in eigen.values.iter().zip(&eigen.vectors) {
        let along =
            |axis: usize| -> f64 { by_basis.iter().zip(vector).map(|(p, v)| p[axis] * v).sum() };
        if value.abs() <= limit && along(0).hypot(along(1)) > STILL * size {
            let free = local.basis.coordinates.first().map_or(0, |k| *k);
            return Err(Reason::Loose { coordinate: coordinate(&held, free) });
        }
    }
    let mut found = [0.0; 4];
    for force in 0..2 {
        let mut u: Vec<f64> = by_basis.iter().map(|p| p[force]).list();
        if !solve_dense(&mut local.stiffness.clone(), &mut u) {
            return Err(Reason::Loose { coordinate: String::new() });
        }
        for axis in 0..2 {
            found[2 * axis + force] = by_basis.iter().zip(&u).map(|(p, u)| p[axis] * u).sum();
        }
    }
    Ok(found)
}
