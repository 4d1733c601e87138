//! First derivatives by dual numbers: x + Σ xₖ εₖ with εₖ εₗ = 0.

#![allow(clippy::suspicious_arithmetic_impl)] // product and quotient rule

use super::base::OverBase;
use super::real::{difference, ByValues, Lift, Real};

/// A value with its derivatives with respect to `N` seeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize, S = f64> {
    /// The value.
    pub value: S,
    /// The derivative with respect to each seed.
    pub slope: [S; N],
}

impl<const N: usize, S: Real> Dual<N, S> {
    /// The independent variable of seed `k`.
    #[inline]
    pub fn variable(value: S, k: usize) -> Self {
        let mut slope = [S::zero(); N];
        slope[k] = S::one();
        Self { value, slope }
    }

    /// A range over which a function jumps, so that its derivatives have no bounds.
    #[inline(never)]
    fn of_jump(value: S) -> Self {
        Self { value, slope: [S::constant(f64::NAN); N] }
    }

    /// f(x) from f and f′ at the value, by the chain rule.
    #[inline]
    fn chain(self, f: S, df: S) -> Self {
        let mut slope = self.slope;
        for d in &mut slope {
            *d = df * *d;
        }
        Self { value: f, slope }
    }
}

impl<const N: usize, S: Real> Lift<S> for Dual<N, S>
where
    Self: OverBase,
{
    #[inline]
    fn lift(s: S) -> Self {
        Self { value: s, slope: [S::zero(); N] }
    }
}

/// A loop compiles to a tenth of the code of `std::array::from_fn`.
#[inline(always)]
fn zip<const N: usize, S: Copy>(mut a: [S; N], b: [S; N], f: impl Fn(S, S) -> S) -> [S; N] {
    for k in 0..N {
        a[k] = f(a[k], b[k]);
    }
    a
}

super::operators::operators! {#[inline] {const N: usize, S: Real} Dual<N, S>: |a, b|
    + Self { value: a.value + b.value, slope: zip(a.slope, b.slope, |a, b| a + b) },
    - Self { value: a.value - b.value, slope: zip(a.slope, b.slope, |a, b| a - b) },
    * Self {
        value: a.value * b.value,
        slope: zip(a.slope, b.slope, |da, db| da * b.value + a.value * db),
    },
    / {
        let value = a.value / b.value;
        Self { value, slope: zip(a.slope, b.slope, |da, db| (da - value * db) / b.value) }
    },
    negative {
        let mut slope = a.slope;
        for d in &mut slope {
            *d = -*d;
        }
        Self { value: -a.value, slope }
    },
}

impl<S: Real> OverBase for Dual<3, S> {
    type Base = S::Three;
    type Three = S::Three;
    #[inline]
    fn base(self) -> S::Three {
        S::three(self)
    }
    #[inline]
    fn of_base(x: S::Three) -> Self {
        S::of_three(x)
    }
    #[inline]
    fn three(x: Dual<3, Self>) -> S::Three {
        S::three(x.value)
    }
    #[inline]
    fn of_three(x: S::Three) -> Dual<3, Self> {
        Lift::lift(S::of_three(x))
    }
}

impl<const N: usize, S: Real> Real for Dual<N, S>
where
    Self: OverBase,
{
    const ORDER: usize = S::ORDER + 1;

    #[inline]
    fn constant(x: f64) -> Self {
        let value = S::constant(x);
        match value.spread() > 0.0 {
            true => Self::of_jump(value),
            false => Self::lift(value),
        }
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    #[inline]
    fn sqrt(self) -> Self {
        let r = self.value.sqrt();
        self.chain(r, S::constant(0.5) / r)
    }
    #[inline]
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }
    #[inline]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), S::one() / self.value)
    }
    #[inline]
    fn asin(self) -> Self {
        let x = self.value;
        self.chain(x.asin(), S::one() / (S::one() - x * x).sqrt())
    }
    #[inline]
    fn atan(self) -> Self {
        let x = self.value;
        self.chain(x.atan(), S::one() / (S::one() + x * x))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        let (a, b) = (self.value, x.value);
        let r2 = a * a + b * b;
        let value = a.atan2(b);
        if value.spread() > std::f64::consts::PI {
            return Self::of_jump(value);
        }
        Self { value, slope: zip(self.slope, x.slope, |da, db| (b * da - a * db) / r2) }
    }
    #[inline]
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }
    #[inline]
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }
    #[inline]
    fn tanh(self) -> Self {
        let t = self.value.tanh();
        self.chain(t, S::one() - t * t)
    }
    #[inline]
    fn powc(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            return Self::one();
        }
        let slope = S::constant(exponent) * self.value.powc(exponent - 1.0);
        self.chain(self.value.powc(exponent), slope)
    }
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        let (x, y) = (self.value, exponent.value);
        let value = x.pow(y);
        let (by_x, by_y) = (y * x.pow(y - S::one()), value * x.ln());
        // ln x exists only for x > 0, but a constant exponent does not need it
        let slope = zip(self.slope, exponent.slope, |dx, dy| {
            by_x * dx + S::select(dy * dy, by_y * dy, S::zero())
        });
        Self { value, slope }
    }
    #[inline]
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        let c = condition.value;
        Self {
            value: S::select(c, positive.value, otherwise.value),
            slope: zip(positive.slope, otherwise.slope, |a, b| S::select(c, a, b)),
        }
    }
    #[inline]
    fn floor(self) -> Self {
        let value = self.value.floor();
        match value.spread() > 0.0 {
            true => Self::of_jump(value),
            false => Self::lift(value),
        }
    }
    #[inline(always)]
    fn spread(self) -> f64 {
        self.value.spread()
    }
    super::real::by_value!(|self| self.value);
    fn of_values(f: &dyn ByValues, x: &[Self]) -> Self {
        let (mut at, mut direction) = (vec![S::zero(); x.len()], vec![S::zero(); x.len()]);
        for (at, x) in at.iter_mut().zip(x) {
            *at = x.value;
        }
        let value = S::of_values(f, &at);
        let mut slope = [S::zero(); N];
        for (k, slope) in slope.iter_mut().enumerate() {
            for (direction, x) in direction.iter_mut().zip(x) {
                *direction = x.slope[k];
            }
            *slope = difference(f, &at, value, &direction);
        }
        Self { value, slope }
    }
    #[inline]
    fn is_constant(self) -> bool {
        let mut constant = self.value.is_constant();
        for d in self.slope {
            constant &= d.is_constant() && d.largest_magnitude() == 0.0;
        }
        constant
    }
    #[inline]
    fn is_finite(self) -> bool {
        let mut finite = self.value.is_finite();
        for d in self.slope {
            finite &= d.is_finite();
        }
        finite
    }
}
