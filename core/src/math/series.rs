//! Truncated Taylor series in one variable: all derivatives of order 0 to N - 1 at a point.
//!
//! A function of a series follows from the recurrences of its coefficients (Griewank and Walther, *Evaluating
//! Derivatives*, 2nd edition 2008, table 13.2).

#![allow(clippy::suspicious_arithmetic_impl)] // products and quotients of series
#![allow(clippy::needless_range_loop)] // indices are orders

use super::base::OverBase;
use super::dual::Dual;
use super::real::{Lift, Real};

/// Largest exponent of a power that is computed by products; `f64` computes such powers in the same way.
const MOST_PRODUCTS: f64 = 16.0;

/// The coefficients of 1, x, x², … of a function near a point: its derivatives of order n divided by n!.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaylorSeries<const N: usize, S = f64>(pub [S; N]);

impl<const N: usize, S: Real> TaylorSeries<N, S> {
    /// The independent variable at a point.
    pub fn variable(at: S) -> Self {
        let mut series = Self::lift(at);
        series.0[1] = S::one();
        series
    }

    /// The derivatives of order 0 to N - 1.
    pub fn derivatives(self) -> [S; N] {
        let mut all = self.0;
        let mut factorial = 1.0;
        for n in 2..N {
            factorial *= n as f64;
            all[n] = all[n] * S::constant(factorial);
        }
        all
    }

    /// f(self) from the coefficients of f at the constant part. A coefficient that is not finite affects only the
    /// orders that contain it.
    fn compose(self, f: [S; N]) -> Self {
        let mut result = Self::lift(f[0]);
        let mut power = self.0; // of the series without its constant part, which begins with order n
        for n in 1..N {
            for k in n..N {
                result.0[k] += f[n] * power[k];
            }
            let before = power;
            for k in n + 1..N {
                power[k] = S::zero();
                for j in n..k {
                    power[k] += before[j] * self.0[k - j];
                }
            }
        }
        result
    }

    /// The function with the value `at` whose derivative with respect to the argument `self` is `slope`.
    fn integral(self, at: S, slope: Self) -> Self {
        let mut result = Self::lift(at);
        for k in 1..N {
            let mut sum = S::zero();
            for j in 1..k + 1 {
                sum += S::constant(j as f64) * self.0[j] * slope.0[k - j];
            }
            result.0[k] = sum / S::constant(k as f64);
        }
        result
    }

    /// A constant power of the constant part, and its coefficients as a function.
    fn powers(self, exponent: S, power: impl Fn(S, usize) -> S) -> Self {
        let (mut f, mut factor) = ([S::zero(); N], S::one());
        for (n, f) in f.iter_mut().enumerate() {
            // a factor that became zero remains zero, although the power may be infinite
            if factor.largest_magnitude() != 0.0 {
                *f = factor * power(self.0[0], n);
            }
            let n = S::constant(n as f64);
            factor = factor * (exponent - n) / (n + S::one());
        }
        self.compose(f)
    }

    /// A power with a positive whole exponent, by squares.
    fn whole_power(self, mut exponent: u32) -> Self {
        let (mut result, mut square) = (Self::one(), self);
        loop {
            if exponent & 1 == 1 {
                result = result * square;
            }
            exponent >>= 1;
            if exponent == 0 {
                return result;
            }
            square = square * square;
        }
    }

    /// Two functions whose derivatives are ± each other: d(first) = second dx, d(second) = sign first dx.
    fn pair(self, (first, second): (S, S), sign: f64) -> (Self, Self) {
        let (mut a, mut b) = (Self::lift(first), Self::lift(second));
        let sign = S::constant(sign);
        for k in 1..N {
            let (mut of_a, mut of_b) = (S::zero(), S::zero());
            for j in 1..k + 1 {
                let change = S::constant(j as f64) * self.0[j];
                of_a += change * b.0[k - j];
                of_b += change * a.0[k - j];
            }
            let share = S::constant(1.0 / k as f64);
            (a.0[k], b.0[k]) = (of_a * share, sign * of_b * share);
        }
        (a, b)
    }

    /// Each coefficient of two series, combined by a function.
    #[inline]
    fn with(mut self, other: Self, f: impl Fn(S, S) -> S) -> Self {
        for k in 0..N {
            self.0[k] = f(self.0[k], other.0[k]);
        }
        self
    }
}

impl<const N: usize, S: Real> Lift<S> for TaylorSeries<N, S> {
    #[inline]
    fn lift(s: S) -> Self {
        let mut all = [S::zero(); N];
        all[0] = s;
        Self(all)
    }
}

super::operators::operators! {#[inline] {const N: usize, S: Real} TaylorSeries<N, S>: |a, b|
    + a.with(b, |a, b| a + b),
    - a.with(b, |a, b| a - b),
    * {
        let mut product = [S::zero(); N];
        for j in 0..N {
            for k in j..N {
                product[k] += a.0[j] * b.0[k - j];
            }
        }
        Self(product)
    },
    / {
        let (mut quotient, inverse) = (a.0, S::one() / b.0[0]);
        quotient[0] = quotient[0] / b.0[0];
        for k in 1..N {
            for j in 0..k {
                let before = quotient[j];
                quotient[k] -= before * b.0[k - j];
            }
            quotient[k] = quotient[k] * inverse;
        }
        Self(quotient)
    },
    negative a.with(a, |a, _| -a),
}

impl<const N: usize, S: Real> OverBase for TaylorSeries<N, S> {
    type Base = S::Base;
    type Three = S::Base;
    fn base(self) -> S::Base {
        self.0[0].base()
    }
    fn of_base(x: S::Base) -> Self {
        Self::lift(S::of_base(x))
    }
    fn three(x: Dual<3, Self>) -> S::Base {
        x.value.base()
    }
    fn of_three(x: S::Base) -> Dual<3, Self> {
        Lift::lift(Self::of_base(x))
    }
}

impl<const N: usize, S: Real> Real for TaylorSeries<N, S> {
    const ORDER: usize = S::ORDER + N - 1;

    #[inline]
    fn constant(x: f64) -> Self {
        Self::lift(S::constant(x))
    }
    fn sin_cos(self) -> (Self, Self) {
        self.pair(self.0[0].sin_cos(), -1.0)
    }
    fn sqrt(self) -> Self {
        let (root, x) = (self.0[0].sqrt(), self.0[0]);
        let half = S::constant(0.5);
        self.powers(half, |_, n| if n == 0 { root } else { root / x.powc(n as f64) })
    }
    fn exp(self) -> Self {
        self.pair((self.0[0].exp(), self.0[0].exp()), 1.0).0
    }
    fn ln(self) -> Self {
        self.integral(self.0[0].ln(), Self::one() / self)
    }
    fn asin(self) -> Self {
        self.integral(self.0[0].asin(), Self::one() / (Self::one() - self * self).sqrt())
    }
    fn atan(self) -> Self {
        self.integral(self.0[0].atan(), Self::one() / (Self::one() + self * self))
    }
    fn atan2(self, x: Self) -> Self {
        // θ′ = (x y′ - y x′) / r²
        let squared = self * self + x * x;
        let (by_y, by_x) =
            (self.integral(S::zero(), x / squared), x.integral(S::zero(), self / squared));
        let mut angle = by_y - by_x;
        angle.0[0] = self.0[0].atan2(x.0[0]);
        angle
    }
    fn sinh(self) -> Self {
        self.pair((self.0[0].sinh(), self.0[0].cosh()), 1.0).0
    }
    fn cosh(self) -> Self {
        self.pair((self.0[0].sinh(), self.0[0].cosh()), 1.0).1
    }
    fn tanh(self) -> Self {
        // one more order in each round: tanh′ = 1 - tanh²
        let mut tanh = Self::lift(self.0[0].tanh());
        for _ in 1..N {
            tanh = self.integral(tanh.0[0], Self::one() - tanh * tanh);
        }
        tanh
    }
    fn powc(self, exponent: f64) -> Self {
        if exponent.fract() == 0.0 && (1.0..=MOST_PRODUCTS).contains(&exponent) {
            return self.whole_power(exponent as u32);
        }
        self.powers(S::constant(exponent), |x, n| x.powc(exponent - n as f64))
    }
    fn pow(self, exponent: Self) -> Self {
        let varies = exponent.0[1..].iter().any(|x| x.largest_magnitude() != 0.0);
        match varies {
            true => (exponent * self.ln()).exp(),
            // ln x exists only for x > 0, but a constant exponent does not need it
            false => {
                let p = exponent.0[0];
                self.powers(p, |x, n| x.pow(p - S::constant(n as f64)))
            }
        }
    }
    #[inline]
    fn select(condition: Self, positive: Self, otherwise: Self) -> Self {
        positive.with(otherwise, |a, b| S::select(condition.0[0], a, b))
    }
    fn floor(self) -> Self {
        Self::lift(self.0[0].floor())
    }
    super::real::by_value!(|self| self.0[0]);
    fn is_constant(self) -> bool {
        let zero = |x: &S| x.is_constant() && x.largest_magnitude() == 0.0;
        self.0[0].is_constant() && self.0[1..].iter().all(zero)
    }
    fn is_finite(self) -> bool {
        self.0.iter().all(|x| x.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::TaylorSeries;
    use crate::math::{Dual, Jet, Lift, Real};

    /// The derivatives of order 0 to 3 by jets of dual numbers.
    fn nested(f: &impl Fn(Jet<Dual<3>>) -> Jet<Dual<3>>, x: f64) -> [f64; 4] {
        let y = f(Jet::new(Dual::variable(x, 0), Dual::one(), Dual::zero()));
        [y.value.value, y.rate.value, y.second.value, y.second.slope[0]]
    }

    /// Compares derivatives of a function with those of nested scalars, and the derivative of order 7 with a difference.
    fn agrees(
        text: &str,
        f: impl Fn(TaylorSeries<8>) -> TaylorSeries<8>,
        low: impl Fn(TaylorSeries<4>) -> TaylorSeries<4>,
        over: impl Fn(Jet<Dual<3>>) -> Jet<Dual<3>>,
    ) {
        for x in [0.3, 0.55, 0.9] {
            let found = f(TaylorSeries::variable(x)).derivatives();
            for (n, (found, known)) in found.iter().zip(nested(&over, x)).enumerate() {
                let close = (found - known).abs() <= 1e-12 * (1.0 + known.abs());
                assert!(close, "{text} at {x}, order {n}: {found}, not {known}");
            }
            // of fourth order, from derivatives of order 3 at neighbours
            let h = 2e-2;
            let of = |k: f64| low(TaylorSeries::variable(x + k * h)).derivatives()[3];
            let seventh =
                (of(-2.0) + of(2.0) - 4.0 * (of(-1.0) + of(1.0)) + 6.0 * of(0.0)) / h.powi(4);
            let scale = found[7].abs().max(found[6].abs()).max(1.0);
            assert!((found[7] - seventh).abs() < 0.1 * scale, "{text}: {} {seventh}", found[7]);
        }
    }

    macro_rules! compare {
        ($(|$x:ident| $f:expr),+ $(,)?) => {
            $({
                fn of_scalar<S: Real>($x: S) -> S {
                    $f
                }
                agrees(stringify!($f), of_scalar, of_scalar, of_scalar);
            })+
        };
    }

    #[test]
    fn derivatives_are_those_of_nested_scalars() {
        fn c<S: Real>(x: f64) -> S {
            S::constant(x)
        }
        compare!(
            |x| (x * c(1.3)).sin() * x.exp(),
            |x| (x * x + c(1.0)).sqrt() / (x + c(2.0)),
            |x| (x * c(0.4)).cos().ln(),
            |x| (x * c(0.5)).asin() + (x * c(0.8)).atan(),
            |x| (x * x).atan2(x + c(0.5)),
            |x| (x * c(0.3)).sinh() - (x * x).cosh(),
            |x| (x * c(0.7)).tanh(),
            |x| (x + c(1.0)).powc(-1.5) + (x + c(2.0)).powc(3.0),
            |x| (x + c(1.0)).pow(x),
            |x| (x + c(1.0)).pow(c(2.5)),
        );
    }

    #[test]
    fn a_power_has_its_derivatives_where_higher_ones_are_not_finite() {
        let x = TaylorSeries::<8>::variable(0.0).powc(3.5).derivatives();
        assert_eq!(x[..4], [0.0; 4]);
        assert_eq!(TaylorSeries::<4>::variable(0.0).powc(2.0).derivatives(), [0.0, 0.0, 2.0, 0.0]);
        assert_eq!(
            TaylorSeries::<4>::variable(-2.0).powc(3.0).derivatives(),
            [-8.0, 12.0, -12.0, 6.0]
        );
    }

    #[test]
    fn a_choice_and_a_floor_have_the_derivatives_of_a_piece() {
        let x = TaylorSeries::<4>::variable(1.5);
        assert_eq!(TaylorSeries::select(x, x * x, x).0, [2.25, 3.0, 1.0, 0.0]);
        assert_eq!(x.floor().0, [1.0, 0.0, 0.0, 0.0]);
        let lifted: TaylorSeries<4> = Lift::lift(3.0);
        assert_eq!(lifted.0, [3.0, 0.0, 0.0, 0.0]);
    }
}
