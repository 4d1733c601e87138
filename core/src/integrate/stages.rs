//! Sums over the stages of a Runge–Kutta step.
//!
//! States and stages are rows of whole blocks, padded with zeros. Sums over them process four numbers at a time
//! without a remainder.

use crate::math::{indexed, Lanes, Real};

/// Four numbers that are processed together.
pub(super) type Block = [f64; Lanes::WIDTH];

/// Memory for `rows` rows of `n` numbers.
#[inline]
pub(super) fn room(rows: usize, n: usize) -> Vec<Block> {
    vec![[0.0; Lanes::WIDTH]; rows * width(n)]
}

/// Number of blocks in a row of `n` numbers; at least one.
#[inline]
pub(super) fn width(n: usize) -> usize {
    n.div_ceil(Lanes::WIDTH).max(1)
}

/// out = y + h Σₛ aₛ kₛ, with an h for each number of a block. Returns whether the sum is finite, without loading it
/// again.
#[inline(always)]
pub(super) fn combine<const S: usize>(
    y: &[Block],
    h: Lanes,
    a: [f64; S],
    mut k: [&[Block]; S],
    out: &mut [Block],
) -> bool {
    let n = out.len();
    let y = &y[..n];
    // equal lengths remove the bounds checks below; a loop, since map() of an array is not inlined
    for k in &mut k {
        *k = &k[..n];
    }
    let zero = Lanes::zero();
    // 0 x is zero for finite x and NaN otherwise
    let mut none = zero;
    for i in 0..n {
        let x = Lanes::new(y[i]) + h * sum_at(i, a, k);
        none = none.plus_product(zero, x);
        out[i] = x.to_array();
    }
    none.are_zero()
}

/// Σₛ aₛ kₛ of a block. Fused operations gain little and would change steps whose error is close to the tolerance.
#[inline(always)]
pub(super) fn sum_at<const S: usize>(i: usize, a: [f64; S], k: [&[Block]; S]) -> Lanes {
    let mut sum = Lanes::constant(a[0]) * Lanes::new(k[0][i]);
    for s in 1..S {
        sum += Lanes::constant(a[s]) * Lanes::new(k[s][i]);
    }
    sum
}

/// out = (to - from) / h.
#[inline]
pub(super) fn chord(from: &[Block], to: &[Block], h: f64, out: &mut [Block]) {
    let h = Lanes::constant(h);
    for ((out, from), to) in out.iter_mut().zip(from).zip(to) {
        *out = ((Lanes::new(*to) - Lanes::new(*from)) / h).to_array();
    }
}

/// The first S rows of `k`, each `width` blocks long.
#[inline(always)]
pub(super) fn rows<const S: usize>(k: &[Block], width: usize) -> [&[Block]; S] {
    indexed(|s| row(k, width, s))
}

/// The first S rows of `k`, mutable.
#[inline(always)]
pub(super) fn rows_mut<const S: usize>(k: &mut [Block], width: usize) -> [&mut [Block]; S] {
    // not with chunks, which begin with a division
    let mut rest = k;
    std::array::from_fn(|_| {
        let (row, others) = std::mem::take(&mut rest).split_at_mut(width);
        rest = others;
        row
    })
}

/// Row `s` of `k`.
#[inline(always)]
pub(super) fn row(k: &[Block], width: usize, s: usize) -> &[Block] {
    &k[s * width..][..width]
}

/// Row `s` of `k`, mutable.
#[inline(always)]
pub(super) fn row_mut(k: &mut [Block], width: usize, s: usize) -> &mut [Block] {
    &mut k[s * width..][..width]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_report_whether_they_are_finite() {
        for n in [1, 4, 9, 21] {
            let rows = |x: f64| {
                let mut row = room(1, n);
                row.as_flattened_mut()[..n].fill(x);
                row
            };
            let (y, k, mut out) = (rows(1.0), [rows(2.0), rows(-3.0)], room(1, n));
            let sum = |y: &[Block], k: &[Vec<Block>; 2], out: &mut [Block]| {
                combine(y, Lanes::constant(0.5), [4.0, 1.0], [&k[0], &k[1]], out)
            };
            assert!(sum(&y, &k, &mut out));
            assert_eq!(out.as_flattened()[..n], vec![3.5; n]);
            for at in 0..n {
                for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    let mut k = k.clone();
                    k[1].as_flattened_mut()[at] = bad;
                    assert!(!sum(&y, &k, &mut out), "{bad} at {at} of {n}");
                }
                // finite stages may lead past the largest number
                let mut k = k.clone();
                k[0].as_flattened_mut()[at] = f64::MAX;
                assert!(!sum(&y, &k, &mut out), "{at} of {n}");
            }
        }
    }

    #[test]
    fn rows_lie_one_after_the_other() {
        let (mut k, width) = (room(3, 5), width(5));
        for (s, row) in rows_mut::<3>(&mut k, width).into_iter().enumerate() {
            row.as_flattened_mut().fill(s as f64);
        }
        for s in 0..3 {
            assert!(row(&k, width, s).as_flattened().iter().all(|x| *x == s as f64));
        }
    }
}
