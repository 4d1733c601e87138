//! Numeric sparse LDLᵀ on a static pattern: A = L D Lᵀ with 1 × 1 pivots and no pivoting.
//!
//! The signs of D may be mixed: a saddle-point matrix [M Φᵀ; Φ 0] with M eliminated first
//! ([`bodies_first`]) has positive pivots for M > 0 and negative ones for a full-rank Φ
//! (Vanderbei, *Symmetric quasidefinite matrices*, SIAM J. Optim. 5 (1995) 100).
//!
//! A pivot d = a - Σ l² d is judged by what was cancelled in it: it is refused when
//! |d| ≤ [`PIVOT_TOLERANCE`] (|a| + Σ |l² d|). A dependent row of Φ leaves a ratio near 1e-16 whatever
//! its scale; a mechanism near a singular position a small one, which [`Factor::cancellation`] shows.
//!
//! [`bodies_first`]: super::bodies_first

use super::symbolic::{Symbolic, SHORT};
use crate::math::Real;

/// Smallest ratio of a pivot to the magnitudes cancelled in it that is still trusted.
pub const PIVOT_TOLERANCE: f64 = 1e-13;

/// The matrix has no trustworthy pivot for an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZeroPivot {
    /// The unknown, in the numbering of the caller.
    pub index: usize,
    /// |pivot| over the sum of the magnitudes it was cancelled from; NaN if nothing or no finite
    /// number was there.
    pub ratio: f64,
}

impl std::fmt::Display for ZeroPivot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "no pivot for unknown {} (relative size {:.1e})", self.index, self.ratio)
    }
}

impl std::error::Error for ZeroPivot {}

/// The numbers of one factorisation; all memory is taken in [`Factor::new`].
#[derive(Clone, Debug)]
pub struct Factor<S> {
    /// D, then L below the diagonal, column by column. Length n + fill.
    entries: Vec<S>,
    /// 1 / D.
    inverse: Vec<S>,
    /// |a| + Σ |l² d| of each pivot.
    magnitude: Vec<S>,
    /// |pivot| / magnitude, least over the lanes, in elimination order.
    ratio: Vec<f64>,
    /// A column of L while its products are subtracted; elsewhere a residual.
    work: Vec<S>,
}

impl<S: Real> Factor<S> {
    /// Memory for factors of the given pattern.
    pub fn new(symbolic: &Symbolic) -> Self {
        let n = symbolic.n;
        Self {
            entries: vec![S::zero(); n + symbolic.fill()],
            inverse: vec![S::zero(); n],
            magnitude: vec![S::zero(); n],
            ratio: vec![0.0; n],
            work: vec![S::zero(); n],
        }
    }

    /// Factorises the matrix with `values`, one for each entry of the pattern and in its order.
    ///
    /// # Errors
    /// [`ZeroPivot`] at the first pivot that is zero, not finite or cancelled below
    /// [`PIVOT_TOLERANCE`] (in any lane); the factor must then not be used.
    ///
    /// # Panics
    /// If `values` has another length than the entries, or the factor is of another pattern.
    pub fn factor(&mut self, symbolic: &Symbolic, values: &[S]) -> Result<(), ZeroPivot> {
        self.assemble(symbolic, values);
        for k in 0..symbolic.n {
            let inverse = self.pivot(symbolic, k)?;
            self.eliminate(symbolic, k, inverse);
        }
        Ok(())
    }

    fn assemble(&mut self, symbolic: &Symbolic, values: &[S]) {
        assert_eq!(values.len(), symbolic.entries.len(), "one value for each entry of the pattern");
        assert_eq!(self.entries.len(), symbolic.n + symbolic.fill(), "a factor of this pattern");
        self.entries.fill(S::zero());
        for &(entry, slot) in &symbolic.scatter {
            self.entries[slot as usize] += values[entry as usize];
        }
        for (magnitude, &d) in self.magnitude.iter_mut().zip(&self.entries) {
            *magnitude = d.abs();
        }
    }

    /// Judges pivot k and returns its reciprocal.
    #[inline(always)]
    fn pivot(&mut self, symbolic: &Symbolic, k: usize) -> Result<S, ZeroPivot> {
        let d = self.entries[k];
        let ratio = (d / self.magnitude[k]).least_magnitude();
        self.ratio[k] = ratio;
        let inverse = S::one() / d;
        if !(ratio > PIVOT_TOLERANCE && d.is_finite() && inverse.is_finite()) {
            return Err(ZeroPivot { index: symbolic.order[k] as usize, ratio });
        }
        self.inverse[k] = inverse;
        Ok(inverse)
    }

    /// Scales column k to L and subtracts its products from the columns after it.
    #[inline(always)]
    fn eliminate(&mut self, symbolic: &Symbolic, k: usize, inverse: S) {
        let range = symbolic.range(k);
        let (diagonal, lower) = self.entries.split_at_mut(symbolic.n);
        let (head, tail) = lower.split_at_mut(range.end);
        let column = &mut head[range.start..];
        let rows = &symbolic.row[range];
        let scaled = &mut self.work[..column.len()];
        for (l, &w) in scaled.iter_mut().zip(column.iter()) {
            *l = w * inverse;
        }
        for ((&w, &l), &j) in column.iter().zip(scaled.iter()).zip(rows) {
            let product = w * l;
            diagonal[j as usize] -= product;
            self.magnitude[j as usize] += product.abs();
        }
        let update = &symbolic.update[symbolic.update_start[k]..symbolic.update_start[k + 1]];
        if column.len() <= SHORT {
            subtract_places(column, scaled, update, tail);
        } else {
            subtract_runs(column, scaled, update, tail);
        }
        column.copy_from_slice(scaled);
    }

    /// Solves A x = `rhs` in place, in the numbering of the caller.
    ///
    /// # Panics
    /// If `rhs` has not length n.
    pub fn solve(&self, symbolic: &Symbolic, rhs: &mut [S]) {
        let n = symbolic.n;
        assert_eq!(rhs.len(), n, "one right side for each unknown");
        let lower = &self.entries[n..];
        for (k, &i) in symbolic.order.iter().enumerate() {
            let x = rhs[i as usize];
            let range = symbolic.range(k);
            for (&l, &j) in lower[range.clone()].iter().zip(&symbolic.unknown[range]) {
                rhs[j as usize] -= l * x;
            }
        }
        for (k, &i) in symbolic.order.iter().enumerate().rev() {
            let mut x = rhs[i as usize] * self.inverse[k];
            let range = symbolic.range(k);
            for (&l, &j) in lower[range.clone()].iter().zip(&symbolic.unknown[range]) {
                x -= l * rhs[j as usize];
            }
            rhs[i as usize] = x;
        }
    }

    /// One step of iterative refinement: x += A⁻¹ (rhs - A x), with the `values` A was factorised from.
    ///
    /// # Panics
    /// If a length does not fit the pattern.
    pub fn refine(&mut self, symbolic: &Symbolic, values: &[S], rhs: &[S], x: &mut [S]) {
        let mut residual = std::mem::take(&mut self.work);
        residual.copy_from_slice(rhs);
        symbolic.subtract_product(values, x, &mut residual);
        self.solve(symbolic, &mut residual);
        for (x, &correction) in x.iter_mut().zip(&residual) {
            *x += correction;
        }
        self.work = residual;
    }

    /// The unknown whose pivot was cancelled most, and its ratio |pivot| / (|a| + Σ |l² d|): 1 means
    /// nothing was lost, 1e-10 that ten digits were. `None` without unknowns.
    pub fn cancellation(&self, symbolic: &Symbolic) -> Option<(usize, f64)> {
        let worst = self.ratio.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
        worst.map(|(k, &ratio)| (symbolic.order[k] as usize, ratio))
    }

    /// The pivots D with their unknowns, in elimination order; their signs are the inertia of A.
    pub fn pivots<'a>(&'a self, symbolic: &'a Symbolic) -> impl Iterator<Item = (usize, S)> + 'a {
        symbolic.order.iter().zip(&self.entries).map(|(&i, &d)| (i as usize, d))
    }
}

/// Products of a short column: each has its place.
#[inline(always)]
fn subtract_places<S: Real>(column: &[S], scaled: &[S], places: &[u32], tail: &mut [S]) {
    let mut place = places.iter();
    for (a, &w) in column.iter().enumerate() {
        for (&l, &at) in scaled[a + 1..].iter().zip(place.by_ref()) {
            tail[at as usize] -= w * l;
        }
    }
}

/// Products of a long column: runs of neighbours.
fn subtract_runs<S: Real>(column: &[S], scaled: &[S], runs: &[u32], tail: &mut [S]) {
    let mut run = runs.chunks_exact(2);
    for (a, &w) in column.iter().enumerate() {
        let mut rest = &scaled[a + 1..];
        while !rest.is_empty() {
            let Some(&[first, length]) = run.next() else { return };
            let (now, later) = rest.split_at(length as usize);
            let target = &mut tail[first as usize..][..now.len()];
            for (t, &l) in target.iter_mut().zip(now) {
                *t -= w * l;
            }
            rest = later;
        }
    }
}

impl Symbolic {
    /// y -= A x for the matrix with `values`; all in the numbering of the caller.
    ///
    /// # Panics
    /// If a length does not fit the pattern.
    pub fn subtract_product<S: Real>(&self, values: &[S], x: &[S], y: &mut [S]) {
        assert_eq!(values.len(), self.entries.len(), "one value for each entry of the pattern");
        for (&(i, j), &value) in self.entries.iter().zip(values) {
            let (i, j) = (i as usize, j as usize);
            y[i] -= value * x[j];
            if i != j {
                y[j] -= value * x[i];
            }
        }
    }
}
