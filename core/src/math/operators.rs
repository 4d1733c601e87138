//! The operators of types of numbers, from one expression each.

/// Implements +, -, *, / and the sign of a type for numbers `a` and `b`, and += and -=. Parameters of the type stand
/// before it in braces.
macro_rules! operators {
    ($(#[$attribute:meta])? $({$($parameters:tt)*})? $T:ty: |$a:ident, $b:ident|
        + $add:expr,
        - $subtract:expr,
        * $multiply:expr,
        / $divide:expr,
        negative $negate:expr $(,)?
    ) => {
        impl $(<$($parameters)*>)? std::ops::Add for $T {
            type Output = Self;
            $(#[$attribute])?
            fn add(self, $b: Self) -> Self {
                let $a = self;
                $add
            }
        }
        impl $(<$($parameters)*>)? std::ops::Sub for $T {
            type Output = Self;
            $(#[$attribute])?
            fn sub(self, $b: Self) -> Self {
                let $a = self;
                $subtract
            }
        }
        impl $(<$($parameters)*>)? std::ops::Mul for $T {
            type Output = Self;
            $(#[$attribute])?
            fn mul(self, $b: Self) -> Self {
                let $a = self;
                $multiply
            }
        }
        impl $(<$($parameters)*>)? std::ops::Div for $T {
            type Output = Self;
            #[allow(clippy::suspicious_arithmetic_impl)] // a quotient as a product
            $(#[$attribute])?
            fn div(self, $b: Self) -> Self {
                let $a = self;
                $divide
            }
        }
        impl $(<$($parameters)*>)? std::ops::Neg for $T {
            type Output = Self;
            $(#[$attribute])?
            fn neg(self) -> Self {
                let $a = self;
                $negate
            }
        }
        $crate::math::operators::assign!($({$($parameters)*})? $T);
    };
}
pub(crate) use operators;

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
