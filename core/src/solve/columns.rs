//! The numeric kernel of LDLᵀ: one column scaled to L and its outer product subtracted.
//!
//! Columns of mechanisms are short. Each length up to [`SHORT`] has its own kernel, unrolled by the
//! compiler, that holds the column in registers; longer columns are subtracted by runs of neighbours.

use super::symbolic::{Symbolic, SHORT};
use crate::math::Real;

/// The columns of L not yet eliminated; each elimination takes one off the front.
pub(super) struct Columns<'a, S> {
    lower: &'a mut [S],
    rows: &'a [u32],
    unknowns: &'a [u32],
    update: &'a [u32],
    /// The scaled column while a long one is subtracted.
    work: &'a mut [S],
}

/// What an elimination changes beside L.
pub(super) struct Later<'a, S> {
    /// D, in elimination order.
    pub diagonal: &'a mut [S],
    /// |a| + Σ |l² d| of the pivots, in elimination order.
    pub magnitude: &'a mut [S],
    /// The right side, in the caller's numbering; not touched by kernels without `RHS`.
    pub rhs: &'a mut [S],
}

impl<S: Real> Later<'_, S> {
    #[inline(always)]
    fn subtract<const RHS: bool>(&mut self, (w, l): (S, S), x: S, row: u32, unknown: u32) {
        let product = w * l;
        self.diagonal[row as usize] -= product;
        self.magnitude[row as usize] += product.abs();
        if RHS {
            self.rhs[unknown as usize] -= l * x;
        }
    }
}

impl<'a, S: Real> Columns<'a, S> {
    pub fn new(symbolic: &'a Symbolic, lower: &'a mut [S], work: &'a mut [S]) -> Self {
        let (rows, unknowns, update) = (&symbolic.row, &symbolic.unknown, &symbolic.update);
        Self { lower, rows, unknowns, update, work }
    }

    /// Eliminates the next column, of `length` rows, given 1 / d and its right side `x`.
    #[inline(always)]
    pub fn eliminate<const RHS: bool>(
        &mut self,
        length: u32,
        inverse: S,
        x: S,
        later: &mut Later<'_, S>,
    ) {
        const { assert!(SHORT == 8, "a kernel for each short length") };
        match length {
            0 => {}
            1 => self.short::<1, RHS>(inverse, x, later),
            2 => self.short::<2, RHS>(inverse, x, later),
            3 => self.short::<3, RHS>(inverse, x, later),
            4 => self.short::<4, RHS>(inverse, x, later),
            5 => self.short::<5, RHS>(inverse, x, later),
            6 => self.short::<6, RHS>(inverse, x, later),
            7 => self.short::<7, RHS>(inverse, x, later),
            8 => self.short::<8, RHS>(inverse, x, later),
            _ => self.long::<RHS>(length as usize, inverse, x, later),
        }
    }

    /// A column of `N` rows; each product has its place.
    #[inline(always)]
    fn short<const N: usize, const RHS: bool>(
        &mut self,
        inverse: S,
        x: S,
        later: &mut Later<'_, S>,
    ) {
        let (column, tail) = take_mut(&mut self.lower, N);
        let (rows, unknowns) = (take(&mut self.rows, N), take(&mut self.unknowns, N));
        let places = take(&mut self.update, N * (N - 1) / 2);
        let w: [S; N] = std::array::from_fn(|a| column[a]);
        let l = w.map(|w| w * inverse);
        for a in 0..N {
            later.subtract::<RHS>((w[a], l[a]), x, rows[a], unknowns[a]);
        }
        let mut place = places.iter();
        for a in 0..N {
            for (&l, &at) in l[a + 1..].iter().zip(place.by_ref()) {
                tail[at as usize] -= w[a] * l;
            }
        }
        column.copy_from_slice(&l);
        self.lower = tail;
    }

    /// A column of any length, in runs of products.
    fn long<const RHS: bool>(&mut self, length: usize, inverse: S, x: S, later: &mut Later<'_, S>) {
        let (column, tail) = take_mut(&mut self.lower, length);
        let (rows, unknowns) = (take(&mut self.rows, length), take(&mut self.unknowns, length));
        let scaled = &mut self.work[..length];
        for (l, &w) in scaled.iter_mut().zip(column.iter()) {
            *l = w * inverse;
        }
        for (a, &w) in column.iter().enumerate() {
            later.subtract::<RHS>((w, scaled[a]), x, rows[a], unknowns[a]);
            let mut rest = &scaled[a + 1..];
            while !rest.is_empty() {
                let run = take(&mut self.update, 2);
                let (now, more) = rest.split_at(run[1] as usize);
                for (t, &l) in tail[run[0] as usize..][..now.len()].iter_mut().zip(now) {
                    *t -= w * l;
                }
                rest = more;
            }
        }
        column.copy_from_slice(scaled);
        self.lower = tail;
    }
}

/// Splits `count` off the front.
#[inline(always)]
fn take<'a>(rest: &mut &'a [u32], count: usize) -> &'a [u32] {
    let (front, back) = rest.split_at(count);
    *rest = back;
    front
}

/// Splits the front off, and leaves the rest to be put back by the caller.
#[inline(always)]
fn take_mut<'a, S>(rest: &mut &'a mut [S], count: usize) -> (&'a mut [S], &'a mut [S]) {
    std::mem::take(rest).split_at_mut(count)
}
