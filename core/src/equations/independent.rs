//! The equations of motion with independent rows of Φ, if constraints are redundant.
//!
//! With r redundant equations, Yᵀ Φ_q = 0 for r vectors y at every position. Therefore r rows are omitted. The other
//! rows are those of a mechanism without redundancy, in which a small pivot indicates a singular position. Each y
//! belongs to one omitted row o: y_o = 1, and y is 0 for the other omitted rows. The remaining components follow from
//! the factors,
//!
//! ```text
//! [ M   Φ_qᵀ ] [ 0 ]   [ -Φ_q,oᵀ ]
//! [ Φ_q  0   ] [ y ] = [    0    ]
//! ```
//!
//! without the omitted rows. If y_o vanishes relative to another y_k, the rows without o become dependent although
//! all rows together do not. Row o is exchanged for k before that. Rows are exchanged while some |y_k| > 2. Each
//! exchange at least doubles the volume of the chosen part of Y, so that the iteration ends (S. A. Goreinov, I. V.
//! Oseledets, D. V. Savostyanov, E. E. Tyrtyshnikov, N. L. Zamarashkin, *How to find a good submatrix*, World
//! Scientific, 2010).

use super::motion::Workspace;
use crate::math::{Listed, Real};
use crate::model::{row_scales, Model};

/// Largest accepted component |y_k| in the dependence of an omitted row.
const LARGEST: f64 = 2.0;

impl<S: Real> Workspace<S> {
    /// Omits these rows of Φ and no others. The pivots of the other rows are then tested as in a model without
    /// redundancy.
    ///
    /// # Panics
    /// If the plan of elimination condenses grounded bodies, as
    /// [`Plan::without_redundancy`](super::Plan::without_redundancy) does.
    pub fn omit(&mut self, rows: &[usize]) {
        self.matrix.omit(rows);
        self.set_direct();
    }

    /// If rows are omitted, replaces the multipliers of the last evaluation by the smallest ones that balance the
    /// same loads.
    pub fn least_multipliers(&mut self, model: &Model<S>) {
        let at = self.n_unknowns;
        let rows = at..at + self.n_rows;
        subtract_parts(self.dependences(model), &mut self.solution[rows]);
    }

    /// Replaces given multipliers of all rows, at the state of the last evaluation, by the smallest ones in the same
    /// way.
    pub fn least_of(&self, model: &Model<S>, lam: &mut [S]) {
        subtract_parts(self.dependences(model), lam);
    }

    /// For each omitted row, the vector y with Σ y_k Φ_q,k = 0, from the factors of the last evaluation.
    fn dependences(&self, model: &Model<S>) -> Vec<Vec<S>> {
        let (n, layout) = (self.n_q, &model.layout);
        let of_row = |&row: &usize| {
            let mut x = vec![S::zero(); n + layout.n_rows];
            for (_, column, at) in layout.positions().filter(|(of, ..)| *of == row) {
                x[column] -= self.matrix.jacobian()[at];
            }
            self.matrix.solve(&mut x);
            let mut y = x.split_off(n);
            self.matrix.omitted().iter().for_each(|other| y[*other] = S::zero());
            y[row] = S::one();
            y
        };
        self.matrix.omitted().iter().map(of_row).list()
    }
}

impl Workspace {
    /// Exchanges omitted rows on which other rows depend too strongly, with the factors of the last evaluation.
    /// Returns whether any row was exchanged. The factors still belong to the previous rows.
    pub fn exchange_rows(&mut self, model: &Model) -> bool {
        let mut omitted = self.matrix.omitted().to_vec();
        let mut parts = self.dependences(model);
        let scales = row_scales(model);
        for (y, row) in parts.iter_mut().zip(&omitted) {
            y.iter_mut().zip(&scales).for_each(|(y, scale)| *y *= scale / scales[*row]);
        }
        let mut exchanged = false;
        while let Some((k, row)) = largest(&parts) {
            let pivot = parts[k][row];
            parts[k].iter_mut().for_each(|y| *y /= pivot);
            let chosen = parts[k].clone();
            for other in (0..parts.len()).filter(|other| *other != k) {
                let part = parts[other][row];
                parts[other].iter_mut().zip(&chosen).for_each(|(y, c)| *y -= part * c);
            }
            omitted[k] = row;
            exchanged = true;
        }
        if exchanged {
            omitted.sort_unstable();
            self.omit(&omitted);
        }
        exchanged
    }
}

/// The largest component above the limit: the index of its dependence, and its row.
fn largest(parts: &[Vec<f64>]) -> Option<(usize, usize)> {
    let all = parts.iter().enumerate().flat_map(|(k, y)| y.iter().enumerate().map(move |y| (k, y)));
    let over = all.map(|(k, (row, y))| (k, row, y.abs())).filter(|(.., y)| *y > LARGEST);
    over.filter(|(.., y)| y.is_finite())
        .max_by(|a, b| a.2.total_cmp(&b.2))
        .map(|(k, row, _)| (k, row))
}

fn product<S: Real>(a: &[S], b: &[S]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (a, b)| sum + *a * *b)
}

/// Subtracts from x its component in the span of some vectors, which are orthogonalised one after the other.
fn subtract_parts<S: Real>(vectors: Vec<Vec<S>>, x: &mut [S]) {
    let mut basis: Vec<Vec<S>> = Vec::with_capacity(vectors.len());
    for mut y in vectors {
        basis.iter().for_each(|unit| subtract_part(&mut y, unit));
        let length = product(&y, &y).sqrt();
        y.iter_mut().for_each(|y| *y = *y / length);
        basis.push(y);
    }
    basis.iter().for_each(|unit| subtract_part(x, unit));
}

/// Subtracts from x its component along a unit vector.
fn subtract_part<S: Real>(x: &mut [S], unit: &[S]) {
    let part = product(x, unit);
    x.iter_mut().zip(unit).for_each(|(x, unit)| *x -= part * *unit);
}
