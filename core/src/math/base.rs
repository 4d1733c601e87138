//! The scalar in which the data of a model are given, below the derivatives that the equations add.

use super::dual::Dual;
use super::interval::Interval;
use super::jet::Jet;
use super::lanes::Lanes;
use super::real::{Lift, Real};

/// A scalar over its base.
///
/// Derivatives with respect to time or to the coordinates of an owner (`Jet`, `Dual<3, _>`) are added during an
/// evaluation: the data of the model, such as the parameters of a curve, do not have them. A function of one number
/// with such data is therefore evaluated over the base alone, by [`compose`]. `Dual<1>` contains derivatives with
/// respect to a parameter of the model, and is a base.
pub trait OverBase: Sized {
    /// The scalar of the data.
    type Base: Real<Base = Self::Base>;
    /// The number without the added derivatives.
    fn base(self) -> Self::Base;
    /// The number, with added derivatives of zero.
    fn of_base(x: Self::Base) -> Self;
}

macro_rules! is_base {
    ($($S:ty),+) => {
        $(impl $crate::math::OverBase for $S {
            type Base = Self;
            #[inline(always)]
            fn base(self) -> Self {
                self
            }
            #[inline(always)]
            fn of_base(x: Self) -> Self {
                x
            }
        })+
    };
}
pub(crate) use is_base;
is_base!(f64, Lanes, Interval, Dual<1>, Dual<1, Interval>);

impl<S: Real> OverBase for Dual<3, S> {
    type Base = S::Base;
    fn base(self) -> S::Base {
        self.value.base()
    }
    fn of_base(x: S::Base) -> Self {
        Self::lift(S::of_base(x))
    }
}

impl<S: Real> OverBase for Jet<S> {
    type Base = S::Base;
    fn base(self) -> S::Base {
        self.value.base()
    }
    fn of_base(x: S::Base) -> Self {
        Self::lift(S::of_base(x))
    }
}

/// f(x + d) from the derivatives f, f′, f″, … at the base of x, where d is the rest of x. The series ends with the
/// order of the derivatives that the scalar adds; a derivative of a higher order that is not finite counts as zero if
/// it is not among the first `certain` ones.
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
