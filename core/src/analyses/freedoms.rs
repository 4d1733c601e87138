//! Directions in which a mechanism can move at a position: the null space of some rows of Φ_q.

use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{column_scales, ConstraintItem, Model};
use crate::solve::{normalize_rows, rank};

/// Largest number of coordinates for which freedoms are computed.
const MOST: usize = 300;
/// Largest remainder of a row that counts as dependent.
pub(super) const NEARLY: f64 = 1e-5;

/// Directions w with Φ_q w = 0 for the rows of the constraints that `counts` accepts, in metres and rad. They are
/// orthonormal if lengths are relative to the size of the mechanism. None if the model is too large.
pub(super) fn freedoms(
    model: &Model,
    t: f64,
    q: &[f64],
    counts: impl Fn(&ConstraintItem) -> bool,
) -> Option<Vec<Vec<f64>>> {
    nearly_free(model, t, q, NEARLY, &counts)
}

/// The freedoms with this largest remainder of a row that counts as dependent.
pub(super) fn nearly_free(
    model: &Model,
    t: f64,
    q: &[f64],
    tolerance: f64,
    counts: &dyn Fn(&ConstraintItem) -> bool,
) -> Option<Vec<Vec<f64>>> {
    let (n, layout) = (model.layout.n_q, &model.layout);
    if n > MOST || layout.n_rows > MOST {
        return None;
    }
    let mut entries = vec![0.0; layout.n_entries];
    constraints::jacobian(model, &Motions::at_rest(layout, q), t, &mut entries);
    let scales = column_scales(model);
    let counted = |row: usize| counts(&model.constraints[layout.owner(row).0]);
    let rows: Vec<usize> = (0..layout.n_rows).filter(|row| counted(*row)).list();
    let m = rows.len();
    let mut full = vec![0.0; m * n];
    for (row, column, at) in layout.positions() {
        if let Ok(row) = rows.binary_search(&row) {
            full[row * n + column] = entries[at] * scales[column];
        }
    }
    if full.iter().any(|x| !x.is_finite()) {
        return None;
    }
    normalize_rows(&mut full, n);
    // the left null space of the transposed matrix
    let mut transposed = vec![0.0; m * n];
    (0..m).for_each(|i| (0..n).for_each(|j| transposed[j * m + i] = full[i * n + j]));
    let mut found = match m {
        0 => (0..n).map(|k| (0..n).map(|j| f64::from(u8::from(j == k))).list()).list(),
        _ => rank(&transposed, m, tolerance).left_null,
    };
    found.iter_mut().for_each(|w: &mut Vec<f64>| {
        w.iter_mut().zip(&scales).for_each(|(w, scale)| *w *= scale);
    });
    Some(found)
}
