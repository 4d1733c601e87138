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

/// Short arrays, whose items may own memory.
pub(crate) trait ShortArray<T> {
    /// The array of as many items of another type.
    type Of<U>;
    /// `f` of each item.
    fn each<U>(self, f: impl FnMut(T) -> U) -> Self::Of<U>;
}

macro_rules! short {
    ($($N:literal: $($item:ident)+;)+) => {$(
        impl<T> ShortArray<T> for [T; $N] {
            type Of<U> = [U; $N];
            #[inline(always)]
            fn each<U>(self, mut f: impl FnMut(T) -> U) -> [U; $N] {
                let [$($item),+] = self;
                [$(f($item)),+]
            }
        }
    )+};
}

short! {
    1: a;
    2: a b;
    3: a b c;
    4: a b c d;
    5: a b c d e;
    6: a b c d e g;
}
