//! The numeric kernel of LDLᵀ: one column scaled to L and its outer product subtracted.
//!
//! Columns of mechanisms are short. Each length up to [`SHORT`] has its own kernel, unrolled by the
//! compiler, that holds the column in registers; longer columns are subtracted by runs of neighbours.

use super::symbolic::{Symbolic, SHORT};
use crate::math::Real;

/// What is known of a pivot while columns before it are eliminated: side by side, since every row of a
/// column changes all three.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pivot<S> {
    /// D.
    pub d: S,
    /// |a| + Σ |l² d|.
    pub magnitude: S,
    /// The right side.
    pub x: S,
}

/// The columns of L not yet eliminated; each elimination takes one off the front.
pub(super) struct Columns<'a, S> {
    lower: &'a mut [S],
    /// For each column its rows, then where its products land.
    plan: &'a [u32],
    /// The scaled column while a long one is subtracted.
    work: &'a mut [S],
}

impl<'a, S: Real> Columns<'a, S> {
    pub fn new(symbolic: &'a Symbolic, lower: &'a mut [S], work: &'a mut [S]) -> Self {
        Self { lower, plan: &symbolic.plan, work }
    }

    /// Eliminates the next column, of `length` rows, given 1 / d and its right side `x`.
    #[inline(always)]
    pub fn eliminate(&mut self, length: u32, inverse: S, x: S, pivots: &mut [Pivot<S>]) {
        const { assert!(SHORT == 8, "a kernel for each short length") };
        match length {
            0 => {}
            1 => self.short::<1>(inverse, x, pivots),
            2 => self.short::<2>(inverse, x, pivots),
            3 => self.short::<3>(inverse, x, pivots),
            4 => self.short::<4>(inverse, x, pivots),
            5 => self.short::<5>(inverse, x, pivots),
            6 => self.short::<6>(inverse, x, pivots),
            7 => self.short::<7>(inverse, x, pivots),
            8 => self.short::<8>(inverse, x, pivots),
            _ => self.long(length as usize, inverse, x, pivots),
        }
    }

    /// A column of `N` rows; each product has its place.
    #[inline(always)]
    fn short<const N: usize>(&mut self, inverse: S, x: S, pivots: &mut [Pivot<S>]) {
        let (column, tail) = take_mut(&mut self.lower, N);
        let (rows, places) = take(&mut self.plan, N + N * (N - 1) / 2).split_at(N);
        let w: [S; N] = std::array::from_fn(|a| column[a]);
        let l = w.map(|w| w * inverse);
        for a in 0..N {
            subtract(&mut pivots[rows[a] as usize], w[a], l[a], x);
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
    fn long(&mut self, length: usize, inverse: S, x: S, pivots: &mut [Pivot<S>]) {
        let (column, tail) = take_mut(&mut self.lower, length);
        let rows = take(&mut self.plan, length);
        let scaled = &mut self.work[..length];
        for (l, &w) in scaled.iter_mut().zip(column.iter()) {
            *l = w * inverse;
        }
        for (a, &w) in column.iter().enumerate() {
            subtract(&mut pivots[rows[a] as usize], w, scaled[a], x);
            let mut rest = &scaled[a + 1..];
            while !rest.is_empty() {
                let run = take(&mut self.plan, 2);
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

/// What row l = w / d of a column, with right side x, takes from the pivot of that row.
#[inline(always)]
fn subtract<S: Real>(pivot: &mut Pivot<S>, w: S, l: S, x: S) {
    let product = w * l;
    pivot.d -= product;
    pivot.magnitude += product.abs();
    pivot.x -= l * x;
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
