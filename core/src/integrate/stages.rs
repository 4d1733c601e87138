//! Sums over the stages of a Runge–Kutta step.

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

/// The first S stages in rows of `k`.
#[inline(always)]
pub(super) fn rows<const S: usize>(k: &[f64], n: usize) -> [&[f64]; S] {
    std::array::from_fn(|s| &k[s * n..(s + 1) * n])
}
