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

use super::columns::{Columns, Pivot};
use super::symbolic::Symbolic;
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
    /// L below the diagonal, column by column.
    lower: Vec<S>,
    /// D and how it was judged, in elimination order.
    pivots: Vec<Pivot<S>>,
    /// 1 / D.
    inverse: Vec<S>,
    /// A long column of L while its products are subtracted; elsewhere a residual.
    work: Vec<S>,
}

impl<S: Real> Factor<S> {
    /// Memory for factors of the given pattern.
    pub fn new(symbolic: &Symbolic) -> Self {
        let n = symbolic.n;
        Self {
            lower: vec![S::zero(); symbolic.fill()],
            pivots: vec![Pivot { d: S::zero(), magnitude: S::zero(), x: S::zero() }; n],
            inverse: vec![S::zero(); n],
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
        self.assemble(symbolic, values, |_| S::zero());
        self.eliminate(symbolic)
    }

    /// Factorises as [`factor`](Self::factor) and solves A x = `rhs` in place. The right side is
    /// eliminated beside the columns, which hides that half of the solution behind their latency.
    ///
    /// # Errors
    /// As [`factor`](Self::factor); `rhs` is then lost.
    ///
    /// # Panics
    /// As [`factor`](Self::factor) and [`solve`](Self::solve).
    pub fn factor_and_solve(
        &mut self,
        symbolic: &Symbolic,
        values: &[S],
        rhs: &mut [S],
    ) -> Result<(), ZeroPivot> {
        assert_eq!(rhs.len(), symbolic.n, "one right side for each unknown");
        self.assemble(symbolic, values, |unknown| rhs[unknown]);
        self.eliminate(symbolic)?;
        for (pivot, &unknown) in self.pivots.iter().zip(&symbolic.order) {
            rhs[unknown as usize] = pivot.x;
        }
        self.substitute_back(symbolic, rhs);
        Ok(())
    }

    fn assemble(&mut self, symbolic: &Symbolic, values: &[S], rhs: impl Fn(usize) -> S) {
        assert_eq!(values.len(), symbolic.entries.len(), "one value for each entry of the pattern");
        assert_eq!(self.lower.len(), symbolic.fill(), "a factor of this pattern");
        let value = |source: u32| values.get(source as usize).copied().unwrap_or_else(S::zero);
        let (diagonal, lower) = symbolic.source.split_at(symbolic.n);
        for (entry, &source) in self.lower.iter_mut().zip(lower) {
            *entry = value(source);
        }
        let sources = diagonal.iter().zip(&symbolic.order);
        for (pivot, (&source, &unknown)) in self.pivots.iter_mut().zip(sources) {
            let d = value(source);
            *pivot = Pivot { d, magnitude: d.abs(), x: rhs(unknown as usize) };
        }
        for &(entry, slot) in &symbolic.repeated {
            let slot = slot as usize;
            if let Some(pivot) = self.pivots.get_mut(slot) {
                pivot.d += values[entry as usize];
                pivot.magnitude = pivot.d.abs();
            } else {
                self.lower[slot - symbolic.n] += values[entry as usize];
            }
        }
    }

    /// Eliminates column by column, the right side as well.
    fn eliminate(&mut self, symbolic: &Symbolic) -> Result<(), ZeroPivot> {
        let mut columns = Columns::new(symbolic, &mut self.lower, &mut self.work);
        let ends = symbolic.column.windows(2);
        for (k, (inverse, ends)) in self.inverse.iter_mut().zip(ends).enumerate() {
            let Pivot { d, magnitude, x } = self.pivots[k];
            *inverse = S::one() / d;
            // derivatives of d that are not finite show in those of 1 / d
            if !(trusted(d, magnitude) && inverse.is_finite()) {
                let ratio = (d / magnitude).least_magnitude();
                return Err(ZeroPivot { index: symbolic.order[k] as usize, ratio });
            }
            columns.eliminate(ends[1] - ends[0], *inverse, x, &mut self.pivots);
        }
        Ok(())
    }

    /// Solves A x = `rhs` in place, in the numbering of the caller.
    ///
    /// # Panics
    /// If `rhs` has not length n.
    pub fn solve(&self, symbolic: &Symbolic, rhs: &mut [S]) {
        let n = symbolic.n;
        assert_eq!(rhs.len(), n, "one right side for each unknown");
        let lower = &self.lower;
        for (k, &i) in symbolic.order.iter().enumerate() {
            let x = rhs[i as usize];
            let range = symbolic.range(k);
            for (&l, &j) in lower[range.clone()].iter().zip(&symbolic.unknown[range]) {
                rhs[j as usize] -= l * x;
            }
        }
        self.substitute_back(symbolic, rhs);
    }

    /// Solves D Lᵀ x = `rhs` in place.
    fn substitute_back(&self, symbolic: &Symbolic, rhs: &mut [S]) {
        let (mut lower, mut unknowns) = (&self.lower[..], &symbolic.unknown[..]);
        let columns = symbolic.column[..symbolic.n].iter().zip(&symbolic.order).zip(&self.inverse);
        for ((&start, &unknown), &inverse) in columns.rev() {
            let (column, rows);
            (lower, column) = lower.split_at(start as usize);
            (unknowns, rows) = unknowns.split_at(start as usize);
            let mut x = rhs[unknown as usize] * inverse;
            // the first row is the unknown found last: to wait for it last shortens the chain
            for k in (0..rows.len().min(column.len())).rev() {
                x -= column[k] * rhs[rows[k] as usize];
            }
            rhs[unknown as usize] = x;
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
        let ratios = self.pivots.iter().map(|pivot| pivot.d / pivot.magnitude);
        let worst = ratios.map(S::least_magnitude).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        worst.map(|(k, ratio)| (symbolic.order[k] as usize, ratio))
    }

    /// The pivots D with their unknowns, in elimination order; their signs are the inertia of A.
    pub fn pivots<'a>(&'a self, symbolic: &'a Symbolic) -> impl Iterator<Item = (usize, S)> + 'a {
        symbolic.order.iter().zip(&self.pivots).map(|(&i, pivot)| (i as usize, pivot.d))
    }
}

/// Whether a pivot is more than what rounding leaves of a cancelled one, in every lane; NaN is not.
#[inline(always)]
fn trusted<S: Real>(d: S, magnitude: S) -> bool {
    let margin = d.abs() - magnitude * S::constant(PIVOT_TOLERANCE);
    S::select(margin, S::one(), S::zero()).least_magnitude() > 0.0
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
