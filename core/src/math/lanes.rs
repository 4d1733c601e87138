//! Several simulations at once: the same formula on `W` numbers side by side.

use super::real::Real;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// `W` independent values of one quantity, one for each design.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Lanes<const W: usize>(pub [f64; W]);

impl<const W: usize> Lanes<W> {
    fn zip(self, o: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|k| f(self.0[k], o.0[k])))
    }
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
}

impl<const W: usize> Add for Lanes<W> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        self.zip(o, |a, b| a + b)
    }
}
impl<const W: usize> Sub for Lanes<W> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self.zip(o, |a, b| a - b)
    }
}
impl<const W: usize> Mul for Lanes<W> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.zip(o, |a, b| a * b)
    }
}
impl<const W: usize> Div for Lanes<W> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        self.zip(o, |a, b| a / b)
    }
}
impl<const W: usize> Neg for Lanes<W> {
    type Output = Self;
    fn neg(self) -> Self {
        self.each(|a| -a)
    }
}
impl<const W: usize> AddAssign for Lanes<W> {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}
impl<const W: usize> SubAssign for Lanes<W> {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<const W: usize> Real for Lanes<W> {
    fn constant(x: f64) -> Self {
        Self([x; W])
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.each(Real::sin), self.each(Real::cos))
    }
    fn sqrt(self) -> Self {
        self.each(f64::sqrt)
    }
    fn exp(self) -> Self {
        self.each(f64::exp)
    }
    fn ln(self) -> Self {
        self.each(f64::ln)
    }
    fn asin(self) -> Self {
        self.each(f64::asin)
    }
    fn acos(self) -> Self {
        self.each(f64::acos)
    }
    fn atan(self) -> Self {
        self.each(f64::atan)
    }
    fn atan2(self, x: Self) -> Self {
        self.zip(x, f64::atan2)
    }
    fn sinh(self) -> Self {
        self.each(f64::sinh)
    }
    fn cosh(self) -> Self {
        self.each(f64::cosh)
    }
    fn tanh(self) -> Self {
        self.each(f64::tanh)
    }
    fn powc(self, exponent: f64) -> Self {
        self.each(|x| Real::powc(x, exponent))
    }
    fn pow(self, exponent: Self) -> Self {
        self.zip(exponent, f64::powf)
    }
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        Self(std::array::from_fn(|k| Real::select(condition.0[k], positive.0[k], otherwise.0[k])))
    }
    fn floor(self) -> Self {
        self.each(f64::floor)
    }
    fn least_magnitude(self) -> f64 {
        self.0.iter().fold(f64::INFINITY, |least, x| least.min(x.abs()))
    }
    fn is_finite(self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}
