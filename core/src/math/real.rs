//! The operations on scalars that the mechanics needs.

use super::base::OverBase;
use crate::math::Listed;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A scalar: a real number, possibly with additional content (derivatives, other designs).
///
/// As for `f64`, a domain error gives NaN and never panics.
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + OverBase
{
    /// The highest order of the derivatives that the scalar contains; 0 if it contains none.
    const ORDER: usize = 0;
    /// Whether the equations of a model are evaluated over the scalar. Over [`Jet`](super::Jet), only positions, laws
    /// and forces are.
    const HAS_EQUATIONS: bool = true;

    /// A constant, without derivatives and equal in every lane.
    fn constant(x: f64) -> Self;

    /// (sin x, cos x), x in rad.
    fn sin_cos(self) -> (Self, Self);
    /// self + a b, with a single rounding if the processor supports it.
    #[inline(always)]
    fn plus_product(self, a: Self, b: Self) -> Self {
        self + a * b
    }
    /// self - a b, with a single rounding if the processor supports it.
    #[inline(always)]
    fn minus_product(self, a: Self, b: Self) -> Self {
        self - a * b
    }
    /// Square root.
    fn sqrt(self) -> Self;
    /// eˣ.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Inverse sine, in [-π/2, π/2].
    fn asin(self) -> Self;
    /// Inverse tangent, in (-π/2, π/2).
    fn atan(self) -> Self;
    /// Angle of the vector (`x`, `self`), in (-π, π].
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// x to a constant power.
    fn powc(self, exponent: f64) -> Self;
    /// `positive` where `condition` > 0, otherwise `otherwise`, in each lane separately.
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self;
    /// Largest integer not greater than x. Derivatives are zero.
    fn floor(self) -> Self;

    /// Smallest |x| over the lanes, without derivatives. Pivots are compared by it.
    fn least_magnitude(self) -> f64;
    /// Largest |x| over the lanes, without derivatives. NaN if a lane is NaN.
    fn largest_magnitude(self) -> f64;
    /// The value in each lane, without derivatives. A scalar without lanes repeats its value.
    fn in_lanes(self) -> [f64; 4];
    /// The scalar with these values in its lanes, without derivatives. A scalar without lanes takes the first value.
    #[inline]
    fn of_lanes(values: [f64; 4]) -> Self {
        Self::constant(values[0])
    }
    /// Whether every part is finite, including derivatives.
    fn is_finite(self) -> bool;
    /// The width of a scalar that is a range of numbers, such as an interval; 0 for numbers.
    #[inline(always)]
    fn spread(self) -> f64 {
        0.0
    }
    /// Whether all derivatives are zero.
    fn is_constant(self) -> bool {
        true
    }
    /// A function of the host. Derivatives that it does not give are finite differences. NaN for a scalar without
    /// values.
    fn of_values(f: &dyn ByValues, x: &[Self]) -> Self {
        let _ = (f, x);
        Self::constant(f64::NAN)
    }
    /// The named function of x, for a scalar that prints formulas. None for numbers.
    #[inline]
    fn named_function(self, name: &str) -> Option<Self> {
        let _ = name;
        None
    }

    /// Zero.
    #[inline]
    fn zero() -> Self {
        Self::constant(0.0)
    }
    /// One.
    #[inline]
    fn one() -> Self {
        Self::constant(1.0)
    }
    /// Sine.
    #[inline]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine.
    #[inline]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Tangent.
    #[inline]
    fn tan(self) -> Self {
        let (s, c) = self.sin_cos();
        s / c
    }
    /// Inverse cosine, in [0, π].
    #[inline]
    fn acos(self) -> Self {
        Self::constant(std::f64::consts::FRAC_PI_2) - self.asin()
    }
    /// x to a variable power, x > 0.
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        (exponent * self.ln()).exp()
    }
    /// |x|; the derivative at 0 is -1.
    #[inline]
    fn abs(self) -> Self {
        Self::select(self, self, -self)
    }
    /// The larger of two.
    #[inline]
    fn max(self, other: Self) -> Self {
        Self::select(self - other, self, other)
    }
    /// The smaller of two.
    #[inline]
    fn min(self, other: Self) -> Self {
        Self::select(self - other, other, self)
    }
}

/// The methods of [`Real`] that a scalar has from its value of type `S`.
macro_rules! by_value {
    (|$self:ident| $value:expr) => {
        #[inline]
        fn least_magnitude($self) -> f64 {
            $value.least_magnitude()
        }
        #[inline]
        fn largest_magnitude($self) -> f64 {
            $value.largest_magnitude()
        }
        #[inline]
        fn of_lanes(values: [f64; 4]) -> Self {
            Self::lift(S::of_lanes(values))
        }
        #[inline]
        fn in_lanes($self) -> [f64; 4] {
            $value.in_lanes()
        }
    };
}
pub(super) use by_value;

/// Methods of [`Real`] that apply the functions `f` of `f64` with their names.
macro_rules! functions {
    (|$self:ident, $f:ident| $apply:expr; $($name:ident)+) => {$(
        #[inline]
        fn $name($self) -> Self {
            let $f = f64::$name;
            $apply
        }
    )+};
}
pub(super) use functions;

impl Real for f64 {
    #[inline]
    fn constant(x: f64) -> Self {
        x
    }
    functions!(|self, f| f(self); sqrt exp ln asin acos atan sinh cosh tanh floor abs);
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        super::sine::sin_cos(self)
    }
    #[inline(always)]
    fn plus_product(self, a: f64, b: f64) -> f64 {
        match cfg!(target_feature = "fma") {
            true => a.mul_add(b, self),
            false => self + a * b, // the fused product of the library is a hundred times slower
        }
    }
    #[inline(always)]
    fn minus_product(self, a: f64, b: f64) -> f64 {
        self.plus_product(-a, b)
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        f64::atan2(self, x)
    }
    #[inline]
    fn powc(self, exponent: f64) -> Self {
        // powi is exact for the small integer exponents of polynomial laws; powf may not be
        if exponent.fract() == 0.0 && exponent.abs() <= 16.0 {
            f64::powi(self, exponent as i32)
        } else {
            f64::powf(self, exponent)
        }
    }
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        f64::powf(self, exponent)
    }
    #[inline]
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        if condition > 0.0 {
            positive
        } else {
            otherwise
        }
    }
    #[inline(always)]
    fn least_magnitude(self) -> f64 {
        f64::abs(self)
    }
    #[inline(always)]
    fn largest_magnitude(self) -> f64 {
        f64::abs(self)
    }
    #[inline]
    fn in_lanes(self) -> [f64; 4] {
        [self; 4]
    }
    #[inline]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
    fn of_values(f: &dyn ByValues, x: &[Self]) -> Self {
        f.value(x)
    }
}

/// The derivative of a function at x by the argument with an index.
pub type ByArgument<'a> = &'a dyn Fn(&[f64], usize) -> f64;

/// A function of numbers that is given by its values, and perhaps by its derivatives.
pub trait ByValues {
    /// The value at x.
    fn value(&self, x: &[f64]) -> f64;
    /// The derivatives with respect to the arguments, as functions; None if they are not known.
    fn slopes(&self) -> Option<ByArgument<'_>> {
        None
    }
}

impl<F: Fn(&[f64]) -> f64> ByValues for F {
    fn value(&self, x: &[f64]) -> f64 {
        self(x)
    }
}

/// The derivative along `direction` of a function that is given by its values, as a finite difference if its derivatives
/// are not known. `value` is f(x).
pub(super) fn difference<S: Real>(f: &dyn ByValues, x: &[S], value: S, direction: &[S]) -> S {
    if let Some(slopes) = f.slopes() {
        let moves = |(_, d): &(usize, &S)| d.largest_magnitude() != 0.0;
        let part = |sum, (k, d): (usize, &S)| sum + S::of_values(&|x: &[f64]| slopes(x, k), x) * *d;
        return direction.iter().enumerate().filter(moves).fold(S::zero(), part);
    }
    let moved = || x.iter().zip(direction).filter(|(_, d)| d.largest_magnitude() != 0.0);
    let Some(rate) = moved().map(|(_, d)| d.largest_magnitude()).reduce(f64::max) else {
        return S::zero();
    };
    let size = moved().fold(1.0, |size, (x, _)| x.largest_magnitude().max(size));
    let h = S::constant(f64::EPSILON.sqrt() * size / rate);
    let beside: Vec<S> = x.iter().zip(direction).map(|(x, d)| *x + h * *d).list();
    (S::of_values(f, &beside) - value) / h
}

/// A scalar that contains `S`: quantities over `S` can be used in computations over `Self`.
pub trait Lift<S: Real>: Real {
    /// `s` as a constant of `Self`.
    fn lift(s: S) -> Self;
}

impl<S: Real> Lift<S> for S {
    #[inline]
    fn lift(s: S) -> Self {
        s
    }
}

/// The largest magnitude of many numbers, in any lane. NaN if a number is NaN.
///
/// The maximum is updated lane by lane, since extracting the lanes of each number takes longer.
#[derive(Clone, Copy, Debug)]
pub struct Largest<S> {
    most: S,
    /// Keeps NaN, which the maximum does not.
    sum: S,
}

impl<S: Real> Largest<S> {
    /// The maximum of no numbers.
    #[inline(always)]
    pub fn new() -> Self {
        Self { most: S::zero(), sum: S::zero() }
    }

    /// Includes one more number.
    #[inline(always)]
    pub fn add(&mut self, x: S) {
        let x = x.abs();
        self.most = x.max(self.most);
        self.sum += x;
    }

    /// The largest magnitude so far.
    #[inline(always)]
    pub fn get(&self) -> f64 {
        // if the sum is NaN, returns the sum; if it is zero, so is the maximum
        S::select(self.sum, self.most, self.sum).largest_magnitude()
    }
}

impl<S: Real> Default for Largest<S> {
    #[inline]
    fn default() -> Self {
        Self::new()
    }
}
