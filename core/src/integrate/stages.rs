//! Sums over the stages of a Runge–Kutta step.
//!
//! States and stages are rows of whole blocks with zeros behind the last number, so that sums over them are
//! taken four numbers at once and know no remainder.

use super::contract::FirstOrder;
use super::rate::{Rate, Trouble};
use crate::math::{Lanes, Real};

/// Numbers side by side.
pub(super) type Block = [f64; Lanes::WIDTH];

/// Room for so many rows of `n` numbers.
pub(super) fn room(rows: usize, n: usize) -> Vec<Block> {
    vec![[0.0; Lanes::WIDTH]; rows * width(n)]
}

/// Blocks in a row of `n` numbers; at least one.
pub(super) fn width(n: usize) -> usize {
    n.div_ceil(Lanes::WIDTH).max(1)
}

/// out = y + h Σₛ aₛ kₛ.
#[inline(always)]
pub(super) fn combine<const S: usize>(
    y: &[Block],
    h: f64,
    a: [f64; S],
    mut k: [&[Block]; S],
    out: &mut [Block],
) {
    let n = out.len();
    let y = &y[..n];
    // equal lengths: no bounds checks below; as a loop, since map() of an array is a call
    for k in &mut k {
        *k = &k[..n];
    }
    let h = Lanes::constant(h);
    for i in 0..n {
        out[i] = (Lanes::new(y[i]) + h * sum_at(i, a, k)).to_array();
    }
}

/// Σₛ aₛ kₛ of a block; not fused, which gains little and moves steps next to the limit of their error.
#[inline(always)]
pub(super) fn sum_at<const S: usize>(i: usize, a: [f64; S], k: [&[Block]; S]) -> Lanes {
    let mut sum = Lanes::constant(a[0]) * Lanes::new(k[0][i]);
    for s in 1..S {
        sum += Lanes::constant(a[s]) * Lanes::new(k[s][i]);
    }
    sum
}

/// out = (to - from) / h.
pub(super) fn chord(from: &[Block], to: &[Block], h: f64, out: &mut [Block]) {
    let h = Lanes::constant(h);
    for ((out, from), to) in out.iter_mut().zip(from).zip(to) {
        *out = ((Lanes::new(*to) - Lanes::new(*from)) / h).to_array();
    }
}

/// out += Σₛ aₛ kₛ, one pass over the components.
#[inline(always)]
pub(super) fn accumulate<const S: usize>(a: [f64; S], k: [&[f64]; S], out: &mut [f64]) {
    let n = out.len();
    let k = k.map(|k| &k[..n]); // equal lengths: no bounds checks below
    for i in 0..n {
        let mut sum = a[0] * k[0][i];
        for s in 1..S {
            sum += a[s] * k[s][i];
        }
        out[i] += sum;
    }
}

/// The first S rows of `k`, `width` blocks long.
#[inline(always)]
pub(super) fn rows<const S: usize>(k: &[Block], width: usize) -> [&[Block]; S] {
    std::array::from_fn(|s| row(k, width, s))
}

/// The same, to be written.
#[inline(always)]
pub(super) fn rows_mut<const S: usize>(k: &mut [Block], width: usize) -> [&mut [Block]; S] {
    let mut rows = k.chunks_exact_mut(width);
    std::array::from_fn(|_| rows.next().expect("so many rows"))
}

/// Row `s` of `k`.
#[inline(always)]
pub(super) fn row(k: &[Block], width: usize, s: usize) -> &[Block] {
    &k[s * width..][..width]
}

/// The same, to be written.
#[inline(always)]
pub(super) fn row_mut(k: &mut [Block], width: usize, s: usize) -> &mut [Block] {
    &mut k[s * width..][..width]
}

/// A step that is tried.
pub(super) struct Trial<'r, 's, Y> {
    pub rate: &'r mut Rate<'s, Y>,
    pub t: f64,
    pub h: f64,
    pub y: &'r [Block],
    /// The argument of the stage under way.
    pub work: &'r mut [Block],
}

impl<Y: FirstOrder> Trial<'_, '_, Y> {
    /// out = f(t + c h, y + h Σₛ aₛ kₛ).
    #[inline(always)]
    pub fn stage<const S: usize>(
        &mut self,
        c: f64,
        a: [f64; S],
        k: [&[Block]; S],
        out: &mut [Block],
    ) -> Result<(), Trouble<Y::Stop>> {
        combine(self.y, self.h, a, k, self.work);
        self.rate.at(self.t + c * self.h, self.work, out)
    }
}
