//! Arrays from a function, entry by entry.
//!
//! `std::array::from_fn` and `map` of arrays compile to ten times as much code, which counts in functions that are
//! compiled for every scalar.

/// `f` of each entry.
#[inline(always)]
pub(crate) fn each<T: Copy, U: Copy, const N: usize>(
    x: [T; N],
    mut f: impl FnMut(T) -> U,
) -> [U; N] {
    let mut all = [f(x[0]); N];
    let mut k = 1;
    while k < N {
        all[k] = f(x[k]);
        k += 1;
    }
    all
}

/// `f` of each index.
#[inline(always)]
pub(crate) fn indexed<U: Copy, const N: usize>(mut f: impl FnMut(usize) -> U) -> [U; N] {
    let mut all = [f(0); N];
    let mut k = 1;
    while k < N {
        all[k] = f(k);
        k += 1;
    }
    all
}
