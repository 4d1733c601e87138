//! LU factorisation of a real or complex block matrix on a precomputed plan, without allocation.
//!
//! Blocks are stored as 3 × 3. Missing rows of a smaller block are rows of the identity, so that every loop has a
//! constant length. Pivots are chosen within a diagonal block only. A pivot that contains only cancellation errors is
//! refused.

use super::lu_symbolic::LuPlan;
use crate::math::{each, indexed, Field};

/// A block, stored row by row.
pub type Block<F> = [[F; 3]; 3];

/// A pivot below this fraction of its largest summand has no accurate digits.
pub const LOST: f64 = 1e-13;

/// A matrix, and later its factors, with the structure of an [`LuPlan`].
#[derive(Clone, Debug)]
pub struct BlockLu<F> {
    /// Diagonal blocks (inverted after factorisation), then lower and upper blocks.
    store: Vec<Block<F>>,
    /// Sum of the magnitudes of the terms in each diagonal entry.
    weight: Vec<[f64; 3]>,
    x: Vec<[F; 3]>,
}

impl<F: Field> BlockLu<F> {
    /// Memory for matrices with the pattern of the plan.
    pub fn new(plan: &LuPlan) -> Self {
        let zero = [[F::zero(); 3]; 3];
        Self {
            store: vec![zero; plan.stored()],
            weight: vec![[0.0; 3]; plan.blocks()],
            x: vec![[F::zero(); 3]; plan.blocks()],
        }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self, plan: &LuPlan) {
        self.store.fill([[F::zero(); 3]; 3]);
        for k in 0..plan.blocks() {
            for d in plan.rows(k).len()..3 {
                self.store[k][d][d] = F::one();
            }
        }
    }

    /// The block in a slot of the plan, for writing.
    #[inline]
    pub fn block_mut(&mut self, slot: usize) -> &mut Block<F> {
        &mut self.store[slot]
    }

    /// Factorises in place.
    ///
    /// # Errors
    /// The index of the unknown whose pivot has no accurate digits. The matrix is singular or nearly singular.
    pub fn factor(&mut self, plan: &LuPlan) -> Result<(), usize> {
        let n = plan.blocks();
        for (weight, block) in self.weight.iter_mut().zip(&self.store) {
            *weight = indexed(|d| block[d][d].magnitude());
        }
        let upper = plan.below.len();
        let mut targets = plan.targets.iter();
        for (k, range) in plan.columns.iter().enumerate() {
            let size = plan.rows(k).len();
            let inverse = invert(&self.store[k], &self.weight[k])
                .map_err(|row| plan.rows(k).start + row.min(size - 1))?;
            self.store[k] = inverse;
            for a in range.clone() {
                let l = product(&self.store[n + a], &inverse);
                self.store[n + a] = l;
                for b in range.clone() {
                    let (Some(&target), u) = (targets.next(), self.store[n + upper + b]) else {
                        break;
                    };
                    let target = target as usize;
                    let change = product(&l, &u);
                    subtract(&mut self.store[target], &change);
                    if let Some(weight) = self.weight.get_mut(target) {
                        weight.iter_mut().enumerate().for_each(|(d, w)| {
                            *w += change[d][d].magnitude();
                        });
                    }
                }
            }
        }
        Ok(())
    }

    /// Solves in place. `x` has the caller's numbering of unknowns.
    pub fn solve(&mut self, plan: &LuPlan, x: &mut [F]) {
        let n = plan.blocks();
        let upper = n + plan.below.len();
        for (k, block) in self.x.iter_mut().enumerate() {
            let from = &x[plan.rows(k)];
            *block = [F::zero(); 3];
            block[..from.len()].copy_from_slice(from);
        }
        for (k, range) in plan.columns.iter().enumerate() {
            let own = self.x[k];
            for at in range.clone() {
                let change = times(&self.store[n + at], &own);
                let to = &mut self.x[plan.below[at] as usize];
                to.iter_mut().zip(change).for_each(|(x, c)| *x -= c);
            }
        }
        for (k, range) in plan.columns.iter().enumerate().rev() {
            let mut own = self.x[k];
            for at in range.clone() {
                let change = times(&self.store[upper + at], &self.x[plan.below[at] as usize]);
                own.iter_mut().zip(change).for_each(|(x, c)| *x -= c);
            }
            self.x[k] = times(&self.store[k], &own);
        }
        for (k, block) in self.x.iter().enumerate() {
            let rows = plan.rows(k);
            x[rows.clone()].copy_from_slice(&block[..rows.len()]);
        }
    }
}

#[inline(always)]
fn product<F: Field>(a: &Block<F>, b: &Block<F>) -> Block<F> {
    indexed(|i| indexed(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

#[inline(always)]
fn times<F: Field>(a: &Block<F>, x: &[F; 3]) -> [F; 3] {
    indexed(|i| a[i][0] * x[0] + a[i][1] * x[1] + a[i][2] * x[2])
}

#[inline(always)]
fn subtract<F: Field>(a: &mut Block<F>, b: &Block<F>) {
    for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *a -= *b;
    }
}

/// The inverse by Gauss–Jordan elimination with row exchanges. The error is the row without a pivot.
fn invert<F: Field>(block: &Block<F>, weight: &[f64; 3]) -> Result<Block<F>, usize> {
    let mut a = *block;
    let mut row_of = [0, 1, 2];
    let mut b: Block<F> = indexed(|i| indexed(|j| F::from_real(f64::from(i == j))));
    for c in 0..3 {
        let mut best = c;
        for r in c + 1..3 {
            if a[r][c].magnitude() > a[best][c].magnitude() {
                best = r;
            }
        }
        a.swap(c, best);
        b.swap(c, best);
        row_of.swap(c, best);
        let pivot = a[c][c].magnitude();
        // also refuses NaN
        if !(pivot > LOST * weight[c] && pivot.is_finite()) {
            return Err(row_of[c]);
        }
        let inverse = a[c][c].reciprocal();
        a[c] = each(a[c], |x| x * inverse);
        b[c] = each(b[c], |x| x * inverse);
        let (own, right) = (a[c], b[c]);
        for r in (0..3).filter(|&r| r != c) {
            let factor = a[r][c];
            for j in 0..3 {
                a[r][j] -= factor * own[j];
                b[r][j] -= factor * right[j];
            }
        }
    }
    Ok(b)
}
