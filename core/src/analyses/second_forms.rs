//! The second-order forms of equations that depend on each other: B(v, v) = Σ y_k vᵀ Φ_qq,k v.

use super::dependence::Dependent;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::Model;

/// Entries below this fraction of the largest entry of a form count as zero.
pub(super) const ZERO: f64 = 1e-7;

/// The form B on the freedoms, row by row, for each equation.
pub(super) fn forms(
    model: &Model,
    t: f64,
    q: &[f64],
    equations: &[&Dependent],
    freedoms: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let (m, f) = (model.layout.n_rows, freedoms.len());
    let gamma = |v: &[f64]| {
        let [_, _, gamma] = constraints::terms_at(model, &Motions::at(&model.layout, q, v), t);
        gamma
    };
    let rest = gamma(&vec![0.0; q.len()]);
    // the part of -γ that is quadratic in the velocities
    let quadratic = |v: Vec<f64>| -> Vec<f64> {
        let back: Vec<f64> = v.iter().map(|x| -x).list();
        let (one, other) = (gamma(&v), gamma(&back));
        (0..m).map(|k| rest[k] - 0.5 * (one[k] + other[k])).list()
    };
    let mut found = vec![vec![0.0; f * f]; equations.len()];
    let alone: Vec<Vec<f64>> = freedoms.iter().map(|w| quadratic(w.clone())).list();
    for a in 0..f {
        for b in 0..=a {
            let sum = freedoms[a].iter().zip(&freedoms[b]).map(|(x, y)| x + y).list();
            let both =
                if a == b { alone[a].iter().map(|x| 4.0 * x).list() } else { quadratic(sum) };
            for (form, equation) in found.iter_mut().zip(equations) {
                let terms = equation
                    .factors
                    .iter()
                    .map(|(k, y)| 0.5 * y * (both[*k] - alone[a][*k] - alone[b][*k]));
                let value: f64 = terms.sum();
                (form[a * f + b], form[b * f + a]) = (value, value);
            }
        }
    }
    found
}

/// An orthonormal basis of some forms. The form of a redundant equation is zero.
pub(super) fn independent(forms: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let largest = forms.iter().map(|form| length(form)).fold(0.0, f64::max);
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut form in forms {
        for earlier in &basis {
            let part: f64 = form.iter().zip(earlier).map(|(x, y)| x * y).sum();
            form.iter_mut().zip(earlier).for_each(|(x, y)| *x -= part * y);
        }
        let size = length(&form);
        if size > ZERO * largest && size > 0.0 {
            form.iter_mut().for_each(|x| *x /= size);
            basis.push(form);
        }
    }
    basis
}

/// Linear forms whose squares have the forms, or their negatives, as sums, by Cholesky's method with pivots. None if a
/// form has values of both signs.
pub(super) fn lines(forms: &[Vec<f64>], n: usize) -> Option<Vec<Vec<f64>>> {
    let zero = ZERO * forms.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    let mut found = Vec::new();
    for form in forms {
        let sign = (0..n).map(|k| form[k * n + k]).sum::<f64>().signum();
        let mut rest = form.iter().map(|x| sign * x).list();
        for _ in 0..n {
            let pivot = (0..n).max_by(|a, b| rest[a * n + a].total_cmp(&rest[b * n + b]))?;
            let value = rest[pivot * n + pivot];
            if value <= zero {
                break;
            }
            let line = (0..n).map(|k| rest[pivot * n + k] / value.sqrt()).list();
            for (row, x) in rest.chunks_mut(n).zip(&line) {
                row.iter_mut().zip(&line).for_each(|(entry, y)| *entry -= x * y);
            }
            found.push(line);
        }
        if !rest.iter().all(|x| x.abs() <= zero) {
            return None;
        }
    }
    Some(found)
}
