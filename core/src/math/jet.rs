//! Time derivatives to second order by truncated Taylor series.
//!
//! If q is the jet (q, q̇, 0) and t is (t, 1, 0), the jet of Φ(q, t) is (Φ, Φ_q q̇ + Φ_t, -γ). It contains the right
//! sides ν and γ of the velocity and acceleration equations (Haug 3.6.10, 3.6.11), which therefore need no separate
//! formulas.

use super::base::OverBase;
use super::dual::Dual;
use super::real::{ByValues, Lift, Real};
use crate::math::Listed;

/// A quantity with its first and second time derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<S = f64> {
    /// The value.
    pub value: S,
    /// First time derivative.
    pub rate: S,
    /// Second time derivative.
    pub second: S,
}

impl<S: Real> Jet<S> {
    /// A quantity with given time derivatives.
    #[inline]
    pub fn new(value: S, rate: S, second: S) -> Self {
        Self { value, rate, second }
    }

    /// f(x) from f, f′ and f″ at the value (Faà di Bruno to second order).
    #[inline]
    fn chain(self, f: S, df: S, ddf: S) -> Self {
        Self::new(f, df * self.rate, ddf * self.rate * self.rate + df * self.second)
    }

    /// 1/x.
    #[inline]
    fn recip(self) -> Self {
        let r = S::one() / self.value;
        let r2 = r * r;
        self.chain(r, -r2, S::constant(2.0) * r2 * r)
    }
}

impl<S: Real> Lift<S> for Jet<S> {
    #[inline]
    fn lift(s: S) -> Self {
        Self::new(s, S::zero(), S::zero())
    }
}

super::operators::operators! {#[inline] {S: Real} Jet<S>: |a, b|
    + Self::new(a.value + b.value, a.rate + b.rate, a.second + b.second),
    - Self::new(a.value - b.value, a.rate - b.rate, a.second - b.second),
    * {
        let cross = a.rate * b.rate;
        Self::new(
            a.value * b.value,
            a.rate * b.value + a.value * b.rate,
            a.second * b.value + cross + cross + a.value * b.second,
        )
    },
    / a * b.recip(), // one chain rule instead of two
    negative Self::new(-a.value, -a.rate, -a.second),
}

impl<S: Real> OverBase for Jet<S> {
    type Base = S::Base;
    type Three = S::Base;
    #[inline]
    fn base(self) -> S::Base {
        self.value.base()
    }
    #[inline]
    fn of_base(x: S::Base) -> Self {
        Self::lift(S::of_base(x))
    }
    #[inline]
    fn three(x: Dual<3, Self>) -> S::Base {
        x.value.value.base()
    }
    #[inline]
    fn of_three(x: S::Base) -> Dual<3, Self> {
        Lift::lift(Self::of_base(x))
    }
}

impl<S: Real> Real for Jet<S> {
    const ORDER: usize = S::ORDER + 2;
    const HAS_EQUATIONS: bool = false;

    #[inline]
    fn constant(x: f64) -> Self {
        Self::lift(S::constant(x))
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }
    #[inline]
    fn sqrt(self) -> Self {
        let r = self.value.sqrt();
        let d = S::constant(0.5) / r;
        self.chain(r, d, -(d / (S::constant(2.0) * self.value)))
    }
    #[inline]
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e, e)
    }
    #[inline]
    fn ln(self) -> Self {
        let r = S::one() / self.value;
        self.chain(self.value.ln(), r, -(r * r))
    }
    #[inline]
    fn asin(self) -> Self {
        let x = self.value;
        let w = S::one() / (S::one() - x * x);
        let d = w.sqrt();
        self.chain(x.asin(), d, x * w * d)
    }
    #[inline]
    fn atan(self) -> Self {
        let x = self.value;
        let w = S::one() / (S::one() + x * x);
        self.chain(x.atan(), w, -(S::constant(2.0) * x * w * w))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        // θ̇ = (x ẏ - y ẋ) / r², differentiated once more
        let (a, b) = (self, x);
        let r2 = a.value * a.value + b.value * b.value;
        let rate = (b.value * a.rate - a.value * b.rate) / r2;
        let dr2 = S::constant(2.0) * (a.value * a.rate + b.value * b.rate);
        let second = (b.value * a.second - a.value * b.second - rate * dr2) / r2;
        Self::new(a.value.atan2(b.value), rate, second)
    }
    #[inline]
    fn sinh(self) -> Self {
        let (s, c) = (self.value.sinh(), self.value.cosh());
        self.chain(s, c, s)
    }
    #[inline]
    fn cosh(self) -> Self {
        let (s, c) = (self.value.sinh(), self.value.cosh());
        self.chain(c, s, c)
    }
    #[inline]
    fn tanh(self) -> Self {
        let t = self.value.tanh();
        let d = S::one() - t * t;
        self.chain(t, d, -(S::constant(2.0) * t * d))
    }
    #[inline]
    fn powc(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            return Self::one();
        }
        let p = S::constant(exponent);
        let first = p * self.value.powc(exponent - 1.0);
        let second = if exponent == 1.0 {
            S::zero()
        } else {
            p * S::constant(exponent - 1.0) * self.value.powc(exponent - 2.0)
        };
        self.chain(self.value.powc(exponent), first, second)
    }
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let (one, value) = (S::one(), x.pow(y));
        let constant = self.chain(value, y * x.pow(y - one), y * (y - one) * x.pow(y - one - one));
        // ln x exists only for x > 0, but a constant exponent does not need it
        let varying = (exponent * self.ln()).exp();
        let varies = exponent.rate * exponent.rate + exponent.second * exponent.second;
        Self::new(
            value,
            S::select(varies, varying.rate, constant.rate),
            S::select(varies, varying.second, constant.second),
        )
    }
    #[inline]
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        let c = condition.value;
        Self::new(
            S::select(c, positive.value, otherwise.value),
            S::select(c, positive.rate, otherwise.rate),
            S::select(c, positive.second, otherwise.second),
        )
    }
    #[inline]
    fn floor(self) -> Self {
        Self::lift(self.value.floor())
    }
    super::real::by_value!(|self| self.value);
    fn of_values(f: &dyn ByValues, x: &[Self]) -> Self {
        // along the path x + ẋ τ + ẍ τ²/2
        let at = |tau: f64| -> S {
            let (first, second) = (S::constant(tau), S::constant(0.5 * tau * tau));
            let moved = |x: &Self| x.value + first * x.rate + second * x.second;
            S::of_values(f, &x.iter().map(moved).list())
        };
        let tau = 1e-4;
        let (value, before, after) = (at(0.0), at(-tau), at(tau));
        let rate = (after - before) / S::constant(2.0 * tau);
        Self::new(value, rate, (after - value - value + before) / S::constant(tau * tau))
    }
    #[inline]
    fn is_constant(self) -> bool {
        let mut constant = self.value.is_constant();
        for d in [self.rate, self.second] {
            constant &= d.is_constant() && d.largest_magnitude() == 0.0;
        }
        constant
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.rate.is_finite() && self.second.is_finite()
    }
}
