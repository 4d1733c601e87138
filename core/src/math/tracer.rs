//! Which variables a result depends on, found by carrying sets instead of numbers.
//!
//! Every operation unites the sets of its operands, so a derivative by a variable outside the set of
//! a result is zero wherever it is taken: the structural zeros of a Jacobian follow from the
//! residual alone (Griewank and Walther, *Evaluating Derivatives*, 2nd ed., 2008, ch. 7).

use super::real::Real;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A set of variables, one bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tracer(u64);

impl Tracer {
    /// The variable `k` < 64.
    pub fn variable(k: usize) -> Self {
        Self(1 << k)
    }
    /// Whether the result depends on variable `k` < 64.
    pub fn depends_on(self, k: usize) -> bool {
        self.0 >> k & 1 == 1
    }
}

macro_rules! unite {
    ($($Operation:ident $method:ident),+) => {$(
        impl $Operation for Tracer {
            type Output = Self;
            #[allow(clippy::suspicious_arithmetic_impl)] // of sets, every operation is the union
            fn $method(self, o: Self) -> Self {
                Self(self.0 | o.0)
            }
        }
    )+};
}
unite!(Add add, Sub sub, Mul mul, Div div);

macro_rules! unite_assign {
    ($($Operation:ident $method:ident),+) => {$(
        impl $Operation for Tracer {
            #[allow(clippy::suspicious_op_assign_impl)]
            fn $method(&mut self, o: Self) {
                self.0 |= o.0;
            }
        }
    )+};
}
unite_assign!(AddAssign add_assign, SubAssign sub_assign);

impl Neg for Tracer {
    type Output = Self;
    fn neg(self) -> Self {
        self
    }
}

macro_rules! same {
    ($($method:ident),+) => {$(
        fn $method(self) -> Self {
            self
        }
    )+};
}

impl Real for Tracer {
    fn constant(_: f64) -> Self {
        Self(0)
    }
    fn sin_cos(self) -> (Self, Self) {
        (self, self)
    }
    same!(sqrt, exp, ln, asin, atan, sinh, cosh, tanh, floor);
    fn atan2(self, x: Self) -> Self {
        self + x
    }
    fn powc(self, _: f64) -> Self {
        self
    }
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        condition + positive + otherwise
    }
    fn least_magnitude(self) -> f64 {
        1.0
    }
    fn is_finite(self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_depends_on_what_it_was_computed_from() {
        let [a, b, c, d] = [0, 1, 2, 3].map(Tracer::variable);
        let result = Tracer::select(a, (b * Tracer::constant(2.0)).sin(), c.powc(2.0));
        assert_eq!([0, 1, 2, 3].map(|k| result.depends_on(k)), [true, true, true, false]);
        assert!((d / a).atan2(b).depends_on(3));
    }
}
