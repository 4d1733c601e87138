//! += and -= from + and -.

/// Implements += and -= of a type by its + and -. Parameters of the type stand before it in braces.
macro_rules! assign {
    ($({$($parameters:tt)*})? $T:ty) => {
        impl $(<$($parameters)*>)? std::ops::AddAssign for $T {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl $(<$($parameters)*>)? std::ops::SubAssign for $T {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
    };
}
pub(crate) use assign;
