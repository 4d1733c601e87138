//! Bounds of a number: an interval that contains every result for operands in their intervals.
//!
//! Bounds are widened by the rounding error of each operation. A domain error inside the interval gives the whole
//! real line. (Moore, *Interval Analysis*, 1966.)

#![allow(clippy::suspicious_arithmetic_impl)] // products and quotients of bounds

use super::real::Real;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower bound.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
}

impl Interval {
    /// Every number.
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// The interval from `low` to `high`, without widening.
    pub fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// All numbers that are at most `by` away from `x`.
    pub fn around(x: f64, by: f64) -> Self {
        Self::rounded(x - by, x + by)
    }

    /// Whether zero is inside the interval or on a bound.
    pub fn contains_zero(self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// The intersection of two intervals that both contain the result.
    pub fn and(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// Bounds widened by their rounding error. The whole line if a bound is undefined.
    fn rounded(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ALL;
        }
        let wide = |x: f64| f64::EPSILON * x.abs() + f64::MIN_POSITIVE;
        let finite = |x: f64, by: f64| if x.is_finite() { x + by } else { x };
        Self { low: finite(low, -wide(low)), high: finite(high, wide(high)) }
    }

    fn of(values: &[f64]) -> Self {
        if values.iter().any(|x| x.is_nan()) {
            return Self::ALL;
        }
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        Self::rounded(low, values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
    }

    /// The bounds of an increasing function.
    fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        Self::rounded(f(self.low), f(self.high))
    }

    /// Whether a number of the form `first` + 2π k is inside the interval.
    fn meets(self, first: f64) -> bool {
        let k = ((self.low - first) / TAU).ceil();
        first + k * TAU <= self.high
    }

    fn cosine(self) -> Self {
        if self.high.is_nan() || self.low.is_nan() || self.high - self.low >= TAU {
            return Self::new(-1.0, 1.0);
        }
        let ends = [self.low.cos(), self.high.cos()];
        let found = Self::of(&ends);
        Self {
            low: if self.meets(PI) { -1.0 } else { found.low },
            high: if self.meets(0.0) { 1.0 } else { found.high },
        }
    }
}

super::operators::operators! {Interval: |a, b|
    + Self::rounded(a.low + b.low, a.high + b.high),
    - Self::rounded(a.low - b.high, a.high - b.low),
    * {
        // zero times infinity is zero here: an infinite bound is not a number of the interval
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = |a| [product(a, b.low), product(a, b.high)];
        Self::of([corners(a.low), corners(a.high)].as_flattened())
    },
    / match b.contains_zero() {
        true => Self::ALL,
        false => a * Self::rounded(1.0 / b.high, 1.0 / b.low),
    },
    negative Self { low: -a.high, high: -a.low },
}

super::base::is_base!(Interval, super::dual::Dual<1, Interval>);

impl Real for Interval {
    /// NaN gives every number.
    fn constant(x: f64) -> Self {
        if x.is_nan() {
            return Self::ALL;
        }
        Self { low: x, high: x }
    }
    fn spread(self) -> f64 {
        self.high - self.low
    }
    fn sin_cos(self) -> (Self, Self) {
        let quarter = Self::constant(FRAC_PI_2);
        ((self - quarter).cosine(), self.cosine())
    }
    super::real::functions!(|self, f| self.rising(f); exp atan sinh tanh);
    fn sqrt(self) -> Self {
        if self.high < 0.0 {
            return Self::ALL;
        }
        Self { low: self.low.max(0.0), ..self }.rising(f64::sqrt)
    }
    fn ln(self) -> Self {
        if self.high <= 0.0 {
            return Self::ALL;
        }
        Self { low: self.low.max(0.0), ..self }.rising(f64::ln)
    }
    fn asin(self) -> Self {
        self.and(Self::new(-1.0, 1.0)).rising(f64::asin)
    }
    fn atan2(self, x: Self) -> Self {
        if x.low > 0.0 {
            return (self / x).atan();
        }
        if self.contains_zero() {
            return Self::rounded(-PI, PI);
        }
        let half = if self.low > 0.0 { FRAC_PI_2 } else { -FRAC_PI_2 };
        Self::rounded(half, half) - (x / self).atan()
    }
    fn cosh(self) -> Self {
        let ends = [self.low.cosh(), self.high.cosh()];
        let found = Self::of(&ends);
        if self.contains_zero() {
            Self { low: 1.0, ..found }
        } else {
            found
        }
    }
    fn powc(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            return Self::one();
        }
        if exponent < 0.0 {
            return Self::one() / self.powc(-exponent);
        }
        let ends = [self.low.powc(exponent), self.high.powc(exponent)];
        if exponent.fract() != 0.0 {
            let low = self.low.max(0.0);
            return if self.high < 0.0 {
                Self::ALL
            } else {
                Self::of(&[low.powc(exponent), ends[1]])
            };
        }
        let found = Self::of(&ends);
        if exponent % 2.0 == 0.0 && self.contains_zero() {
            Self { low: 0.0, ..found }
        } else {
            found
        }
    }
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        if condition.low > 0.0 {
            positive
        } else if condition.high <= 0.0 {
            otherwise
        } else {
            let (low, high) = (positive.low.min(otherwise.low), positive.high.max(otherwise.high));
            Self { low, high }
        }
    }
    fn floor(self) -> Self {
        Self { low: self.low.floor(), high: self.high.floor() }
    }
    fn abs(self) -> Self {
        let (low, high) = (self.low.abs(), self.high.abs());
        let least = if self.contains_zero() { 0.0 } else { low.min(high) };
        Self { low: least, high: low.max(high) }
    }
    /// The bounds and the midpoint.
    fn in_lanes(self) -> [f64; 4] {
        let middle = 0.5 * (self.low + self.high);
        [self.low, self.high, middle, middle]
    }
    fn least_magnitude(self) -> f64 {
        self.abs().low
    }
    fn largest_magnitude(self) -> f64 {
        self.abs().high
    }
    fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every function is compared at points of random intervals.
    #[test]
    fn bounds_contain_the_values_at_all_points() {
        type Function = (&'static str, fn(Interval) -> Interval, fn(f64) -> f64);
        let functions: [Function; 14] = [
            ("sin", |x| x.sin(), |x| x.sin()),
            ("cos", |x| x.cos(), |x| x.cos()),
            ("tan", |x| x.tan(), |x| x.tan()),
            ("exp", |x| x.exp(), |x| x.exp()),
            ("ln", |x| x.ln(), |x| x.ln()),
            ("sqrt", |x| x.sqrt(), |x| x.sqrt()),
            ("atan", |x| x.atan(), |x| x.atan()),
            ("cosh", |x| x.cosh(), |x| x.cosh()),
            ("tanh", |x| x.tanh(), |x| x.tanh()),
            ("square", |x| x.powc(2.0), |x| x * x),
            ("cube", |x| x.powc(3.0), |x| x * x * x),
            ("inverse", |x| x.powc(-1.0), |x| 1.0 / x),
            ("product", |x| x * (Interval::constant(1.5) - x), |x| x * (1.5 - x)),
            ("floor", |x| x.floor(), |x| x.floor()),
        ];
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..2000 {
            let low = 20.0 * random() - 10.0;
            let x = Interval::new(low, low + 10.0_f64.powf(3.0 * random() - 2.0));
            for (name, bounds, f) in functions {
                let bounds = bounds(x);
                for part in [0.0, random(), random(), 1.0] {
                    let at = x.low + part * (x.high - x.low);
                    let value = f(at.min(x.high));
                    let inside = value.is_nan() || bounds.low <= value && value <= bounds.high;
                    assert!(inside, "{name} of {x:?} at {at}: {value} outside {bounds:?}");
                }
            }
        }
    }
}
