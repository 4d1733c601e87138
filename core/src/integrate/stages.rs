//! Sums over the stages of a Runge–Kutta step.

use crate::math::Real;

/// out = y + h Σₛ aₛ kₛ, one pass over the components.
#[inline(always)]
pub(super) fn combine<const S: usize>(
    y: &[f64],
    h: f64,
    a: [f64; S],
    k: [&[f64]; S],
    out: &mut [f64],
) {
    let n = out.len();
    let y = &y[..n];
    let k = k.map(|k| &k[..n]); // equal lengths: no bounds checks below
    for i in 0..n {
        let mut sum = a[0] * k[0][i];
        for s in 1..S {
            sum += a[s] * k[s][i];
        }
        out[i] = y[i] + h * sum;
    }
}

/// out += Σₛ aₛ kₛ, one pass over the components; in each lane with weights of its own.
#[inline(always)]
pub(super) fn accumulate<R: Real, const S: usize>(a: [R; S], k: [&[f64]; S], out: &mut [R]) {
    let n = out.len();
    let k = k.map(|k| &k[..n]); // equal lengths: no bounds checks below
    for i in 0..n {
        let mut sum = a[0] * R::constant(k[0][i]);
        for s in 1..S {
            sum += a[s] * R::constant(k[s][i]);
        }
        out[i] += sum;
    }
}

/// The first S stages in rows of `k`.
#[inline(always)]
pub(super) fn rows<const S: usize>(k: &[f64], n: usize) -> [&[f64]; S] {
    std::array::from_fn(|s| &k[s * n..(s + 1) * n])
}

/// The larger of two numbers that are not NaN: one instruction, unlike `f64::max`.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b {
        a
    } else {
        b
    }
}

/// Σ xᵢ², even and odd ones apart, so that two are computed at once.
#[inline(always)]
pub(super) fn sum_of_squares(x: &[f64]) -> f64 {
    let mut sums = [0.0; 2];
    let pairs = x.chunks_exact(2);
    let last: f64 = pairs.remainder().iter().map(|x| x * x).sum();
    for pair in pairs {
        sums = [sums[0] + pair[0] * pair[0], sums[1] + pair[1] * pair[1]];
    }
    sums[0] + sums[1] + last
}
