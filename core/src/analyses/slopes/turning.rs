//! A limit of a driven value where the motion turns back, with its derivatives.
//!
//! At a dead point, yᵀ Φ_q = 0. From Φ(q, t, p) = 0 follows dt = -yᵀ Φ_p dp / yᵀ Φ_t: the change of the position does
//! not count. The position is first improved by Newton's method: along the path, t″ = -yᵀ Φ_qq[q′, q′] / yᵀ Φ_t.

use crate::equations::kinematics::Motions;
use crate::equations::sensitivity::{constants, Sensitivity, Slope, ABREAST};
use crate::equations::{constraints, dense};
use crate::math::{Complex, Field, Listed, Real, ShortArray};
use crate::model::{column_scales, row_scales, Model};
use crate::solve::{null_space, solve_dense};

/// Largest rate of t along the scaled path at a dead point before the position is improved.
const TURNS: f64 = 1e-3;
/// Number of improvements.
const STEPS: usize = 5;
/// Smallest scaled pivot, slope and curvature at which a limit is separate from others.
const SEPARATE: f64 = 1e-6;

/// A dead point: the value t, the position, and the left null vector of Φ_q.
pub(super) struct Turning {
    t: f64,
    q: Vec<f64>,
    left: Vec<f64>,
    /// yᵀ Φ_t.
    by_t: f64,
}

impl Turning {
    /// The dead point near a position of a model whose drivers determine its motion over t. `unit` is the scale of t.
    /// None if t does not turn back there.
    ///
    /// # Errors
    /// The reason for which a limit has no derivatives.
    pub fn near(model: &Model, unit: f64, t: f64, q: &[f64]) -> Result<Option<Self>, String> {
        let (given, mut t, mut q, n) = (t, t, q.to_vec(), q.len());
        let (columns, rows) = (column_scales(model), row_scales(model));
        let mut found = None;
        for step in 0..STEPS {
            let matrix = extended(model, unit, t, &q);
            let transposed = (0..n * n).map(|k| matrix[k % n * (n + 1) + k / n]);
            let left = null_space(&complex(transposed), n, 1);
            let right = null_space(&complex(matrix.iter().copied()), n + 1, 1);
            if left.pivots[0].min(right.pivots[0]) <= SEPARATE {
                return Err("paths of the motion cross there, so that limits meet".to_string());
            }
            let [y, path] = [&left, &right].each(|of| unit_vector(&of.vectors[0]));
            if step == 0 && path[n].abs() > TURNS {
                return Ok(None);
            }
            let by_t: f64 = (0..n).map(|row| y[row] * matrix[row * (n + 1) + n]).sum();
            let v: Vec<f64> = path.iter().zip(&columns).map(|(x, scale)| x * scale).list();
            let bent = curvature(model, t, &q, &v);
            let bent: f64 = bent.iter().zip(&rows).zip(&y).map(|((x, row), y)| y * x / row).sum();
            if by_t.abs() <= SEPARATE || bent.abs() <= SEPARATE {
                return Err("two limits meet there".to_string());
            }
            let ds = path[n] * by_t / bent;
            q.iter_mut().zip(&v).for_each(|(q, v)| *q += ds * v);
            close(model, (unit, &path), &mut t, &mut q);
            let left = y.iter().zip(&rows).map(|(y, row)| y / row).list();
            found = Some((left, by_t / unit));
        }
        // beyond the end of a curve, the dead point is not the limit
        let found = found.filter(|_| (t - given).abs() <= SEPARATE * unit);
        Ok(found.map(|(left, by_t)| Self { t, q, left, by_t }))
    }

    /// The derivatives of the limit by the variables of a block.
    pub fn slopes(&self, over: &mut Sensitivity) -> [f64; ABREAST] {
        let q = constants(&self.q);
        let phi = over.open(Slope::constant(self.t), &q);
        let mut slopes = [0.0; ABREAST];
        for (k, slope) in slopes.iter_mut().enumerate() {
            let open: f64 = phi.iter().zip(&self.left).map(|(phi, y)| y * phi.slope[k]).sum();
            *slope = -open / self.by_t;
        }
        slopes
    }
}

/// Φ_q and Φ_t, scaled, row by row.
fn extended(model: &Model, unit: f64, t: f64, q: &[f64]) -> Vec<f64> {
    let (columns, rows) = (column_scales(model), row_scales(model));
    let jacobian = dense::jacobian(model, &Motions::at_rest(&model.layout, q), t);
    let by_t = constraints::nu(model, q, t);
    let mut matrix = Vec::new();
    for (k, (row, nu)) in jacobian.chunks(q.len()).zip(&by_t).enumerate() {
        matrix.extend(row.iter().zip(&columns).map(|(x, scale)| x * scale / rows[k]));
        matrix.push(-nu * unit / rows[k]);
    }
    matrix
}

/// Φ_qq[v, v].
fn curvature(model: &Model, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
    let gamma = |sign: f64| {
        let v: Vec<f64> = v.iter().map(|v| sign * v).list();
        let [_, _, gamma] = constraints::terms_at(model, &Motions::at(&model.layout, q, &v), t);
        gamma
    };
    let [forth, back, rest] = [1.0, -1.0, 0.0].each(gamma);
    (0..rest.len()).map(|k| rest[k] - 0.5 * (forth[k] + back[k])).list()
}

/// One step of Newton's method for Φ = 0, at right angles to the path.
fn close(model: &Model, (unit, path): (f64, &[f64]), t: &mut f64, q: &mut [f64]) {
    let (columns, rows) = (column_scales(model), row_scales(model));
    let mut matrix = extended(model, unit, *t, q);
    matrix.extend_from_slice(path);
    let mut phi = vec![0.0; rows.len()];
    constraints::residual(model, &Motions::at_rest(&model.layout, q), *t, &mut phi);
    let mut step: Vec<f64> = phi.iter().zip(&rows).map(|(x, row)| -x / row).chain([0.0]).list();
    if solve_dense(&mut matrix, &mut step) {
        q.iter_mut().zip(&columns).zip(&step).for_each(|((q, scale), dq)| *q += scale * dq);
        *t += unit * step[q.len()];
    }
}

fn complex(x: impl Iterator<Item = f64>) -> Vec<Complex> {
    x.map(Complex::from_real).list()
}

/// The real part of a vector, of length one.
fn unit_vector(x: &[Complex]) -> Vec<f64> {
    let length = x.iter().map(|x| x.re * x.re).sum::<f64>().sqrt();
    x.iter().map(|x| x.re / length).list()
}
