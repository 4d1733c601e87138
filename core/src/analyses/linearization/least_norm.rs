//! Least-norm solutions with the constraints alone, without masses:
//!
//! ```text
//! [ W   Φ_qᵀ ] [ x ]   [ f ]
//! [ Φ_q  0   ] [ λ ] = [ g ]
//! ```
//!
//! W = diag(1/s²) with the scales s of the coordinates makes metres and radians comparable. With f = 0, x is the
//! solution of Φ_q x = g with the least norm. With g = 0 and f = W y, x is the projection of y onto Φ_q x = 0. If
//! Φ_qᵀ λ = f has a solution, λ is the solution with the least norm. Bodies without mass and redundant rows need no
//! special treatment: damping keeps the factors regular, and iterative refinement removes its effect.

use crate::equations::augmented::Augmented;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{column_scales, Model};
use crate::solve::Breakdown;

/// Damping of redundant rows, relative to the squares of the scales.
const REDUNDANT: f64 = 1e-10;
/// Number of steps of iterative refinement. The condition of the Gram matrix of the rows determines how much each
/// step reduces the error.
const CORRECTIONS: usize = 3;

/// The factors at one position.
#[derive(Debug)]
pub(in crate::analyses) struct LeastNorm<'a> {
    model: &'a Model,
    matrix: Augmented,
    /// Scale of each coordinate: the size of the mechanism for lengths, 1 for angles.
    pub scales: Vec<f64>,
}

impl<'a> LeastNorm<'a> {
    /// Factorises the matrix at time `t` and coordinates `q`. If `dependent` is set, rows may be linearly dependent.
    ///
    /// # Errors
    /// [`Breakdown::Row`]: a row depends on the others.
    pub fn new(model: &'a Model, t: f64, q: &[f64], dependent: bool) -> Result<Self, Breakdown> {
        let scales = column_scales(model);
        let weights: Vec<f64> = scales.iter().map(|scale| 1.0 / (scale * scale)).list();
        let mut matrix = Augmented::new(model);
        matrix.set_weights(&weights);
        let motions = Motions::at_rest(&model.layout, q);
        constraints::jacobian(model, &motions, t, matrix.jacobian_mut());
        if dependent {
            let largest = scales.iter().fold(0.0, |most: f64, scale| most.max(scale * scale));
            matrix.set_damping(std::iter::repeat_n(REDUNDANT * largest, model.layout.n_rows));
        }
        matrix.factor()?;
        Ok(Self { model, matrix, scales })
    }

    /// The row of Φ_q closest to linear dependence, and the remaining fraction of its pivot.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        self.matrix.cancellation()
    }

    /// Solves for (x, λ) with the right side (f, g), in place; shape (n_q + n_rows).
    pub fn solve(&self, x: &mut [f64]) {
        let right = x.to_vec();
        self.matrix.solve(x);
        for _ in 0..CORRECTIONS {
            let mut left = self.remainder(&right, x);
            self.matrix.solve(&mut left);
            x.iter_mut().zip(&left).for_each(|(x, dx)| *x += dx);
        }
    }

    /// The x of least norm with Φ_q x = g, shapes (n_q) and (n_rows).
    pub fn least(&self, g: &[f64]) -> Vec<f64> {
        if g.iter().all(|g| *g == 0.0) {
            return vec![0.0; self.scales.len()];
        }
        let mut x = vec![0.0; self.scales.len()];
        x.extend_from_slice(g);
        self.solve(&mut x);
        x.truncate(self.scales.len());
        x
    }

    /// The λ of least norm with Φ_qᵀ λ = f, shapes (n_rows) and (n_q).
    pub fn multipliers(&self, f: &[f64]) -> Vec<f64> {
        let mut x = f.to_vec();
        x.resize(f.len() + self.model.layout.n_rows, 0.0);
        self.solve(&mut x);
        x.split_off(f.len())
    }

    /// Projects `x`, shape (n_q), onto Φ_q x = 0.
    pub fn project(&self, x: &mut [f64]) {
        let mut changes = vec![0.0; self.model.layout.n_rows];
        constraints::times_all(self.model, self.matrix.jacobian(), x, &mut changes);
        let part = self.least(&changes);
        x.iter_mut().zip(part).for_each(|(x, part)| *x -= part);
    }

    /// Φ_qᵀ λ, shape (n_q).
    pub fn transposed(&self, lam: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; self.scales.len()];
        constraints::add_transposed(self.model, self.matrix.jacobian(), lam, &mut y);
        y
    }

    fn remainder(&self, right: &[f64], x: &[f64]) -> Vec<f64> {
        let n = self.scales.len();
        let (x, lam) = x.split_at(n);
        let mut product = self.transposed(lam);
        let pairs = product.iter_mut().zip(x).zip(&self.scales);
        pairs.for_each(|((y, x), scale)| *y += x / (scale * scale));
        product.resize(right.len(), 0.0);
        constraints::times_all(self.model, self.matrix.jacobian(), x, &mut product[n..]);
        right.iter().zip(&product).map(|(right, product)| right - product).list()
    }
}
