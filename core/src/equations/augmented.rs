//! The augmented matrix [W Φ_qᵀ; Φ_q -μ I] of a model, on a pattern found once.
//!
//! With W = M and μ = 0 it is the matrix of the equations of motion (Haug 6.3.18); with W = I it
//! gives the smallest step of Newton's method, with μ > 0 a damped one.

use super::{mass, structure};
use crate::elements::BodyId;
use crate::math::{Motion, Real};
use crate::model::{columns, Model};
use crate::solve::{bodies_first, Factor, Symbolic, ZeroPivot};

/// Matrix, factors and pattern.
#[derive(Clone, Debug)]
pub struct Augmented<S = f64> {
    symbolic: Symbolic,
    factor: Factor<S>,
    /// Blocks of W (five entries to a body), entries of Φ_q, diagonal of -μ.
    values: Vec<S>,
    n_q: usize,
    n_w: usize,
    n_rows: usize,
}

/// Entries of one block of W: three on the diagonal, two that couple rotation to translation.
const BLOCK: usize = 5;

impl<S: Real> Augmented<S> {
    /// Memory and elimination order for a model: bodies first, then the rows of the constraints by
    /// minimum degree, so that every pivot is safe while Φ_q has full rank.
    pub fn new<P>(model: &Model<P>) -> Self {
        let layout = &model.layout;
        let (n_q, n) = (layout.n_q, layout.n_q + layout.n_rows);
        let (mut entries, mut present) = (Vec::new(), Vec::new());
        for (body, coupled) in (1..model.bodies.len()).zip(structure::coupled(model)) {
            let [x, y, angle]: [usize; 3] =
                std::array::from_fn(|c| columns(BodyId(body)).start + c);
            entries.extend([(x, x), (y, y), (angle, angle), (angle, x), (angle, y)]);
            present.extend([true, true, true, coupled, coupled]);
        }
        let n_w = entries.len();
        entries.extend(layout.positions().map(|(row, column)| (n_q + row, column)));
        present.extend(structure::jacobian(model));
        entries.extend((n_q..n).map(|row| (row, row)));
        present.resize(entries.len(), true);
        let bodies = (0..n_q).step_by(3);
        let constraints = layout.constraints.iter().map(|c| n_q + c.rows.start);
        let blocks: Vec<usize> = bodies.chain(constraints).collect();
        let order = bodies_first(n_q, n, &entries, Some(&blocks));
        let symbolic = Symbolic::sparse(n, &entries, &present, &order);
        let factor = Factor::new(&symbolic);
        let values = vec![S::zero(); entries.len()];
        Self { symbolic, factor, values, n_q, n_w, n_rows: layout.n_rows }
    }

    /// W = M at the given motions.
    pub fn set_mass(&mut self, model: &Model<S>, motions: &[Motion<S>]) {
        let bodies = model.bodies.iter().zip(motions).skip(1);
        for (w, (body, motion)) in self.values.chunks_exact_mut(BLOCK).zip(bodies) {
            let m = mass::block(body, motion);
            w.copy_from_slice(&[m.mass, m.mass, m.inertia, m.coupling.x, m.coupling.y]);
        }
    }

    /// W diagonal, shape (n_q).
    pub fn set_weights(&mut self, weights: &[S]) {
        for (w, d) in self.values[..self.n_w].chunks_exact_mut(BLOCK).zip(weights.chunks_exact(3)) {
            w.copy_from_slice(&[d[0], d[1], d[2], S::zero(), S::zero()]);
        }
    }

    /// The entries of Φ_q, to be filled.
    pub fn jacobian_mut(&mut self) -> &mut [S] {
        let end = self.values.len() - self.n_rows;
        &mut self.values[self.n_w..end]
    }

    /// The entries of Φ_q.
    pub fn jacobian(&self) -> &[S] {
        &self.values[self.n_w..self.values.len() - self.n_rows]
    }

    /// Sets the damping μ, one for each row.
    pub fn set_damping(&mut self, mu: impl IntoIterator<Item = S>) {
        let start = self.values.len() - self.n_rows;
        for (value, mu) in self.values[start..].iter_mut().zip(mu) {
            *value = -mu;
        }
    }

    /// Factorises.
    ///
    /// # Errors
    /// The row of Φ_q that depends on the others, or a coordinate without mass.
    pub fn factor(&mut self) -> Result<(), Dependent> {
        let outcome = self.factor.factor(&self.symbolic, &self.values);
        outcome.map_err(|pivot| Dependent::new(pivot, self.n_q))
    }

    /// Factorises and solves in place, as [`solve`](Self::solve): faster than one after the other.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `x` is then lost.
    pub fn factor_and_solve(&mut self, x: &mut [S]) -> Result<(), Dependent> {
        let outcome = self.factor.factor_and_solve(&self.symbolic, &self.values, x);
        outcome.map_err(|pivot| Dependent::new(pivot, self.n_q))
    }

    /// Solves in place; (q part, multiplier part), shape (n_q + n_rows).
    pub fn solve(&self, x: &mut [S]) {
        self.factor.solve(&self.symbolic, x);
    }

    /// How many digits the worst pivot lost: the constraint row and |pivot| over what it was
    /// cancelled from.
    pub fn cancellation(&self) -> Option<(usize, f64)> {
        let (index, ratio) = self.factor.cancellation(&self.symbolic)?;
        Some((index.checked_sub(self.n_q)?, ratio))
    }
}

/// What a failed factorisation points at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependent {
    /// A row of Φ_q that depends on the others.
    Row(usize),
    /// A coordinate without a usable mass.
    Column(usize),
}

impl Dependent {
    fn new(ZeroPivot { index, .. }: ZeroPivot, n_q: usize) -> Self {
        match index.checked_sub(n_q) {
            Some(row) => Self::Row(row),
            None => Self::Column(index),
        }
    }
}
