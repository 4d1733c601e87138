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

use super::symbolic::{Product, Run, Symbolic, SHORT};
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
    /// D, then the lower part of L D, column by column: length n + fill.
    entries: Vec<S>,
    /// The lower part of L: length fill.
    lower: Vec<S>,
    /// 1 / D, in the numbering of the caller.
    inverse: Vec<S>,
    /// |a| + Σ |l² d| of each pivot.
    magnitude: Vec<S>,
    /// |pivot| / magnitude, least over the lanes, in elimination order.
    ratio: Vec<f64>,
    /// The residual of a refinement.
    residual: Vec<S>,
}

impl<S: Real> Factor<S> {
    /// Memory for factors of the given pattern.
    pub fn new(symbolic: &Symbolic) -> Self {
        let n = symbolic.n;
        Self {
            entries: vec![S::zero(); n + symbolic.fill()],
            lower: vec![S::zero(); symbolic.fill()],
            inverse: vec![S::zero(); n],
            magnitude: vec![S::zero(); n],
            ratio: vec![0.0; n],
            residual: vec![S::zero(); n],
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
    #[inline(never)] // on its own it keeps its addresses in registers: a third faster
    pub fn factor(&mut self, symbolic: &Symbolic, values: &[S]) -> Result<(), ZeroPivot> {
        self.assemble(symbolic, values);
        // slices taken once: the compiler need not fear that a store moves them
        let n = symbolic.n;
        let (diagonal, below) = self.entries.split_at_mut(n);
        let (scaled, inverse) = (&mut self.lower[..], &mut self.inverse[..n]);
        let (magnitude, ratio) = (&mut self.magnitude[..n], &mut self.ratio[..n]);
        for (k, (column, &unknown)) in symbolic.columns.iter().zip(&symbolic.order).enumerate() {
            let d = diagonal[k];
            ratio[k] = (d / magnitude[k]).least_magnitude();
            let reciprocal = S::one() / d;
            if !(ratio[k] > PIVOT_TOLERANCE && d.is_finite() && reciprocal.is_finite()) {
                return Err(ZeroPivot { index: unknown as usize, ratio: ratio[k] });
            }
            inverse[unknown as usize] = reciprocal;
            let range = column.start as usize..column.end as usize;
            let (w, l) = (&below[range.clone()], &mut scaled[range.clone()]);
            for ((&w, l), &j) in w.iter().zip(l).zip(&symbolic.row[range.clone()]) {
                *l = w * reciprocal;
                let square = w * *l;
                diagonal[j as usize] -= square;
                magnitude[j as usize] += square.abs();
            }
            let updates = column.first_update as usize..column.end_update as usize;
            if range.len() <= SHORT {
                subtract_products(&symbolic.products[updates], scaled, below);
            } else {
                let (w, tail) = below[range.start..].split_at_mut(range.len());
                let runs = &symbolic.runs[updates];
                subtract_runs(w, &scaled[range.clone()], runs, range.end, tail);
            }
        }
        Ok(())
    }

    fn assemble(&mut self, symbolic: &Symbolic, values: &[S]) {
        assert_eq!(values.len(), symbolic.slot.len(), "one value for each entry of the pattern");
        assert_eq!(self.entries.len(), symbolic.n + symbolic.fill(), "a factor of this pattern");
        self.entries.fill(S::zero());
        for (&slot, &value) in symbolic.slot.iter().zip(values) {
            self.entries[slot as usize] += value;
        }
        for (magnitude, &d) in self.magnitude.iter_mut().zip(&self.entries) {
            *magnitude = d.abs();
        }
    }

    /// Solves A x = `rhs` in place, in the numbering of the caller.
    ///
    /// # Panics
    /// If `rhs` has not length n.
    #[inline(never)]
    pub fn solve(&self, symbolic: &Symbolic, rhs: &mut [S]) {
        assert_eq!(rhs.len(), symbolic.n, "one right side for each unknown");
        for (&(k, j), &l) in symbolic.unknowns.iter().zip(&self.lower) {
            let x = rhs[k as usize];
            rhs[j as usize] -= l * x;
        }
        for (x, &inverse) in rhs.iter_mut().zip(&self.inverse) {
            *x = *x * inverse;
        }
        for (&(k, j), &l) in symbolic.unknowns.iter().zip(&self.lower).rev() {
            let x = rhs[j as usize];
            rhs[k as usize] -= l * x;
        }
    }

    /// One step of iterative refinement: x += A⁻¹ (rhs - A x), with the `values` A was factorised from.
    ///
    /// # Panics
    /// If a length does not fit the pattern.
    pub fn refine(&mut self, symbolic: &Symbolic, values: &[S], rhs: &[S], x: &mut [S]) {
        let mut residual = std::mem::take(&mut self.residual);
        residual.copy_from_slice(rhs);
        symbolic.subtract_product(values, x, &mut residual);
        self.solve(symbolic, &mut residual);
        for (x, &correction) in x.iter_mut().zip(&residual) {
            *x += correction;
        }
        self.residual = residual;
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

/// Subtracts the products of a short column from the columns after it.
#[inline(always)]
fn subtract_products<S: Real>(products: &[Product], scaled: &[S], below: &mut [S]) {
    for product in products {
        let (w, l) = (below[product.a as usize], scaled[product.b as usize]);
        below[product.target as usize] -= w * l;
    }
}

/// Subtracts the products of a long column from the columns after it, which begin at position `end`.
fn subtract_runs<S: Real>(w: &[S], scaled: &[S], runs: &[Run], end: usize, tail: &mut [S]) {
    let mut runs = runs.iter();
    for (a, &w) in w.iter().enumerate() {
        let mut rest = &scaled[a + 1..];
        while !rest.is_empty() {
            let Some(run) = runs.next() else { return };
            let (now, later) = rest.split_at(run.length as usize);
            let target = &mut tail[run.target as usize - end..][..now.len()];
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
