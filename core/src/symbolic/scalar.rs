//! Arithmetic of the scalar.

use super::arena::{Node, ONE, ZERO};
use super::function::Function;
use super::record::{constant, with, Symbolic};
use crate::math::Real;

fn call(function: Function, x: Symbolic) -> Symbolic {
    with(|arena, own| arena.call(function, &[own(x)]))
}

crate::math::operators::operators! {Symbolic: |a, b|
    + with(|arena, own| arena.sum(vec![(own(a), 1.0), (own(b), 1.0)])),
    - with(|arena, own| arena.sum(vec![(own(a), 1.0), (own(b), -1.0)])),
    * with(|arena, own| arena.multiply(own(a), own(b))),
    / with(|arena, own| {
        let inverse = arena.power(own(b), -1.0);
        arena.multiply(own(a), inverse)
    }),
    negative with(|arena, own| arena.sum(vec![(own(a), -1.0)])),
}

crate::math::base::is_base!(Symbolic);

/// Methods of [`Real`] that remain as functions in an expression.
macro_rules! calls {
    ($($name:ident: $Function:ident),+ $(,)?) => {$(
        fn $name(self) -> Self {
            call(Function::$Function, self)
        }
    )+};
}

impl Real for Symbolic {
    fn constant(x: f64) -> Self {
        with(|arena, _| match x {
            0.0 => ZERO,
            1.0 => ONE,
            _ => arena.number(x),
        })
    }
    fn sin_cos(self) -> (Self, Self) {
        (call(Function::Sin, self), call(Function::Cos, self))
    }
    calls! {
        tan: Tan, exp: Exp, ln: Ln, asin: Asin, acos: Acos, atan: Atan, sinh: Sinh, cosh: Cosh, tanh: Tanh,
        floor: Floor,
    }
    fn sqrt(self) -> Self {
        self.powc(0.5)
    }
    fn atan2(self, x: Self) -> Self {
        with(|arena, own| arena.call(Function::Atan2, &[own(self), own(x)]))
    }
    fn powc(self, exponent: f64) -> Self {
        with(|arena, own| arena.power(own(self), exponent))
    }
    fn pow(self, exponent: Self) -> Self {
        match constant(exponent) {
            Some(exponent) => self.powc(exponent),
            None => with(|arena, own| arena.call(Function::Power, &[own(self), own(exponent)])),
        }
    }
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        with(|arena, own| arena.select(own(condition), own(positive), own(otherwise)))
    }
    /// The magnitude of a constant; 1 for all other expressions.
    fn least_magnitude(self) -> f64 {
        constant(self).map_or(1.0, f64::abs)
    }
    /// The magnitude of a constant; 1 for all other expressions.
    fn largest_magnitude(self) -> f64 {
        self.least_magnitude()
    }
    /// The value of a constant in all lanes; NaN for all other expressions.
    fn in_lanes(self) -> [f64; 4] {
        [constant(self).unwrap_or(f64::NAN); 4]
    }
    /// Whether a constant is finite; true for all other expressions.
    fn is_finite(self) -> bool {
        constant(self).is_none_or(f64::is_finite)
    }
    fn named_function(self, name: &str) -> Option<Self> {
        Some(with(|arena, own| {
            let table = arena.table(name);
            arena.add(Node::Table { table, order: 0, x: own(self) })
        }))
    }
}
