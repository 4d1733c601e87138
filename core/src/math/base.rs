//! The scalar in which the data of a model are given, below the derivatives that the equations add.

use super::dual::Dual;
use super::real::Real;

/// A scalar over its base.
///
/// Time derivatives (`Jet`), and derivatives with respect to coordinates that an evaluation adds (`Dual<3, _>` over a
/// scalar that is not a number), do not concern the data of a model, such as the parameters of a curve. A function of
/// one number with such data is therefore evaluated over the base alone, by [`compose`]. `Dual<3>` is a base: its
/// derivatives may be those with respect to parameters.
pub trait OverBase: Sized {
    /// The scalar of the data.
    type Base: Real<Base = Self::Base>;
    /// The base of `Dual<3, Self>`.
    type Three: Real<Base = Self::Three>;
    /// The number without the added derivatives.
    fn base(self) -> Self::Base;
    /// The number, with added derivatives of zero.
    fn of_base(x: Self::Base) -> Self;
    /// [`base`](Self::base) of `Dual<3, Self>`.
    fn three(x: Dual<3, Self>) -> Self::Three;
    /// [`of_base`](Self::of_base) of `Dual<3, Self>`.
    fn of_three(x: Self::Three) -> Dual<3, Self>;
}

macro_rules! is_base {
    ($($S:ty),+) => {
        $(impl $crate::math::OverBase for $S {
            type Base = Self;
            type Three = Self;
            #[inline(always)]
            fn base(self) -> Self {
                self
            }
            #[inline(always)]
            fn of_base(x: Self) -> Self {
                x
            }
            #[inline(always)]
            fn three(x: $crate::math::Dual<3, Self>) -> Self {
                x.value
            }
            #[inline(always)]
            fn of_three(x: Self) -> $crate::math::Dual<3, Self> {
                $crate::math::Lift::lift(x)
            }
        })+
    };
}
pub(crate) use is_base;
impl OverBase for f64 {
    type Base = Self;
    type Three = Dual<3>;
    #[inline(always)]
    fn base(self) -> Self {
        self
    }
    #[inline(always)]
    fn of_base(x: Self) -> Self {
        x
    }
    #[inline(always)]
    fn three(x: Dual<3>) -> Dual<3> {
        x
    }
    #[inline(always)]
    fn of_three(x: Dual<3>) -> Dual<3> {
        x
    }
}

/// f(x + d) from the derivatives f, f′, f″, … at the base of x, where d is the rest of x. The series ends with the
/// order of the derivatives that the scalar adds; a derivative of a higher order that is not finite counts as zero if
/// it is not among the first `certain` ones.
#[inline]
pub fn compose<S: Real>(derivatives: &[S::Base], x: S, certain: usize) -> S {
    let d = x - S::of_base(x.base());
    let mut sum = S::zero();
    let most = (S::ORDER - <S::Base as Real>::ORDER).min(derivatives.len() - 1);
    for k in (1..=most).rev() {
        let term = match derivatives[k] {
            term if k < certain || term.is_finite() => S::of_base(term),
            _ => S::zero(),
        };
        sum = d * (term + sum) * S::constant(1.0 / k as f64);
    }
    S::of_base(derivatives[0]) + sum
}
