//! Dependent rows of a sparse matrix from a row-wise QR factorisation with Givens rotations (George and Heath,
//! *Solution of sparse linear least squares problems using Givens rotations*, Linear Algebra Appl. 34 (1980) 69).
//!
//! Each row is rotated with the rows of R. It becomes a new row of R at the first column that has none; if nothing
//! remains before, it depends on the rows before it. A dependent row does not change R, so that R is the factor of
//! the independent rows only. The cost is that of a sparse Cholesky factorisation of Aᵀ A.

use crate::math::Listed;
use std::collections::BTreeMap;

/// Columns in ascending order, with their entries.
pub type SparseRow = Vec<(usize, f64)>;

/// R of the independent rows, indexed by the column of the first entry.
pub struct SparseRank {
    triangle: Vec<Option<SparseRow>>,
    tolerance: f64,
    /// The rows that depend on earlier ones, ascending.
    pub dependent: Vec<usize>,
}

impl SparseRank {
    /// Factorises rows of length 1 in order. The remainder of a dependent row is at most `tolerance`. Returns None if
    /// `stop` becomes true.
    pub fn new(
        rows: &[SparseRow],
        columns: usize,
        tolerance: f64,
        stop: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let mut found = Self { triangle: vec![None; columns], tolerance, dependent: Vec::new() };
        for (k, row) in rows.iter().enumerate() {
            if stop() {
                return None;
            }
            if !found.add(row.clone()) {
                found.dependent.push(k);
            }
        }
        Some(found)
    }

    /// Adds a row to R. Returns false if it depends on the rows before it.
    fn add(&mut self, mut row: SparseRow) -> bool {
        let mut before: Vec<(usize, SparseRow)> = Vec::new();
        loop {
            let small = row.iter().take_while(|(_, x)| x.abs() <= self.tolerance).count();
            row.drain(..small);
            let Some(&(first, _)) = row.first() else { break };
            let Some(pivot) = self.triangle[first].take() else {
                self.triangle[first] = Some(row);
                return true;
            };
            let (rotated, left) = rotate(&pivot, &row);
            before.push((first, pivot));
            self.triangle[first] = Some(rotated);
            row = left;
        }
        for (first, pivot) in before {
            self.triangle[first] = Some(pivot);
        }
        false
    }

    /// The coefficients of a dependent row d: Σ y_k a_k = -a_d over the independent rows, as pairs (k, y_k). They
    /// follow from the corrected seminormal equations, y = A x with Rᵀ R x = -a_d.
    pub fn dependence(&self, rows: &[SparseRow], d: usize) -> SparseRow {
        let mut is_independent = vec![true; rows.len()];
        self.dependent.iter().for_each(|k| is_independent[*k] = false);
        let independent = || (0..rows.len()).filter(|k| is_independent[*k]);
        let mut y = vec![0.0; rows.len()];
        for _ in 0..2 {
            let mut left = BTreeMap::new();
            for (c, a) in &rows[d] {
                left.insert(*c, -a);
            }
            for k in independent().filter(|k| y[*k] != 0.0) {
                rows[k].iter().for_each(|(c, a)| *left.entry(*c).or_default() -= a * y[k]);
            }
            let x = self.solve(left);
            for k in independent() {
                y[k] += rows[k].iter().map(|(c, a)| a * x[*c]).sum::<f64>();
            }
        }
        independent().filter(|k| y[*k] != 0.0).map(|k| (k, y[k])).list()
    }

    /// The x with Rᵀ R x = b; zero in columns without a row of R.
    fn solve(&self, mut b: BTreeMap<usize, f64>) -> Vec<f64> {
        let mut x = vec![0.0; self.triangle.len()];
        while let Some((column, value)) = b.pop_first() {
            let Some(row) = self.triangle[column].as_ref().filter(|_| value != 0.0) else {
                continue;
            };
            let z = value / row[0].1;
            x[column] = z;
            row[1..].iter().for_each(|(c, r)| *b.entry(*c).or_default() -= r * z);
        }
        for row in self.triangle.iter().rev().flatten() {
            let (column, pivot) = row[0];
            let known: f64 = row[1..].iter().map(|(c, r)| r * x[*c]).sum();
            x[column] = (x[column] - known) / pivot;
        }
        x
    }
}

/// Rotates two rows with the same first column so that this entry of the second row vanishes.
fn rotate(pivot: &SparseRow, row: &SparseRow) -> (SparseRow, SparseRow) {
    let h = pivot[0].1.hypot(row[0].1);
    let (c, s) = (pivot[0].1 / h, row[0].1 / h);
    let mut rotated = Vec::with_capacity(pivot.len() + row.len());
    let mut left = Vec::with_capacity(pivot.len() + row.len());
    rotated.push((pivot[0].0, h));
    let (mut a, mut b) = (pivot[1..].iter().peekable(), row[1..].iter().peekable());
    loop {
        let column = match (a.peek(), b.peek()) {
            (Some((i, _)), Some((j, _))) => *i.min(j),
            (Some((i, _)), None) => *i,
            (None, Some((j, _))) => *j,
            (None, None) => return (rotated, left),
        };
        let x = a.next_if(|(i, _)| *i == column).map_or(0.0, |(_, x)| *x);
        let y = b.next_if(|(i, _)| *i == column).map_or(0.0, |(_, y)| *y);
        rotated.push((column, c * x + s * y));
        left.push((column, c * y - s * x));
    }
}
