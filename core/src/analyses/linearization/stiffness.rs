//! The reduced stiffness of a mechanism at rest.

use super::freedoms::Freedoms;
use super::variation::{Point, Variation};
use crate::model::Model;

/// Nᵀ ∂(Φ_qᵀ λ - Q)/∂q N at rest, shape (f, f) row by row: the derivative of the generalized forces of the independent
/// coordinates, with opposite sign.
///
/// N is the basis of `freedoms`, at the same time `t` and coordinates `q`; `z` has shape (n_z), `lam` shape (n_rows). The
/// curvature of the constraints is included, ∂(Φ_qᵀ λ)/∂q, so `lam` must balance the forces: Φ_qᵀ λ = Q, with Q as
/// [`forces::generalized`](crate::equations::forces::generalized) computes it at rest. The matrix is then the Hessian of the
/// potential energy on the independent coordinates if all forces have a potential, and symmetric. N·m/rad for two angles.
pub fn reduced_stiffness(
    model: &Model,
    t: f64,
    [q, z, lam]: [&[f64]; 3],
    freedoms: &Freedoms,
) -> Vec<f64> {
    let rest = vec![0.0; q.len()];
    let at = Point { q, v: &rest, z, a: &rest, lam };
    let variation = Variation::new(model, t, at, false);
    let f = freedoms.basis.len();
    let mut stiffness = vec![0.0; f * f];
    for (column, basis) in freedoms.basis.iter().enumerate() {
        let slopes = variation.along(Point { q: basis, ..Point::default() });
        for (row, entry) in freedoms.reduce(&slopes.forces).into_iter().enumerate() {
            stiffness[row * f + column] = entry;
        }
    }
    stiffness
}
