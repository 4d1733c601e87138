//! A curve near a number u, by its Taylor series at u.
//!
//! A scalar with derivatives of order up to four differs from its value by a d with d⁵ = 0. C, C′, C″ and C‴ over
//! such a scalar therefore follow exactly from the derivatives of order 0 to 7 at the value, which are numbers. The
//! formulas of a curve need not be compiled for every scalar, which reduces the size of the program in WebAssembly.
//! The parameters of the curve must be constants.

use crate::math::{Dual, Jet, Local, Real};

/// Derivatives of order 0 to 7; those that were not computed are zero.
pub(super) type Orders = [Local; 8];

/// u with its derivatives to third order.
pub(super) type ThirdOrder = Jet<Dual<1>>;

/// u with its derivatives to seventh order.
pub(super) type SeventhOrder = Jet<Jet<ThirdOrder>>;

/// A scalar with derivatives with respect to u. A plain number has no derivatives and is by far the cheapest scalar.
pub(super) trait TaylorSeries: Real {
    /// The variable u.
    fn variable(u: f64) -> Self;
    /// The derivatives of order 0, 1, 2, …
    fn orders(&self) -> [f64; 8];
}

impl TaylorSeries for f64 {
    fn variable(u: f64) -> Self {
        u
    }
    fn orders(&self) -> [f64; 8] {
        [*self, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}

impl TaylorSeries for Dual<1> {
    fn variable(u: f64) -> Self {
        Self::variable(u, 0)
    }
    fn orders(&self) -> [f64; 8] {
        [self.value, self.slope[0], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    }
}

/// Each level of jets adds two orders.
impl<S: TaylorSeries> TaylorSeries for Jet<S> {
    fn variable(u: f64) -> Self {
        Self::new(S::variable(u), S::one(), S::zero())
    }
    fn orders(&self) -> [f64; 8] {
        let (first, later) = (self.value.orders(), self.second.orders());
        std::array::from_fn(|n| if n < 2 { first[n] } else { later[n - 2] })
    }
}

/// The derivatives of a point with these components.
pub(super) fn orders<T: TaylorSeries>(x: T, y: T) -> Orders {
    let (x, y) = (x.orders(), y.orders());
    std::array::from_fn(|n| Local::new(x[n], y[n]))
}

/// C, C′, C″ and C‴ at a distance d whose value is 0. A derivative of order four or higher that is not finite counts
/// as zero, because few scalars use it.
pub(super) fn at<S: Real>(orders: &Orders, d: S) -> [Local<S>; 4] {
    let part = |n: usize, component: fn(&Local) -> f64| {
        let term = |k: usize| {
            let order = component(&orders[n + k]);
            S::constant(if n + k < 4 || order.is_finite() { order } else { 0.0 })
        };
        (1..=4).rev().fold(S::zero(), |sum, k| d * (term(k) + sum) * S::constant(1.0 / k as f64))
            + term(0)
    };
    std::array::from_fn(|n| Local::new(part(n, |s| s.x), part(n, |s| s.y)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point with derivatives of every order.
    fn point<S: Real>(u: S) -> [S; 2] {
        let c = S::constant;
        [(u * c(1.3)).sin() * u.exp(), (u * u + c(1.0)).sqrt() / (c(2.0) + u)]
    }

    /// C, C′, C″ and C‴ by jets of dual numbers over the scalar.
    fn nested<S: Real>(u: S) -> [Local<S>; 4] {
        let u = Jet::new(Dual::variable(u, 0), Dual::one(), Dual::zero());
        let [x, y] = point::<Jet<Dual<1, S>>>(u);
        let all =
            |x: Jet<Dual<1, S>>| [x.value.value, x.rate.value, x.second.value, x.second.slope[0]];
        let (x, y) = (all(x), all(y));
        std::array::from_fn(|n| Local::new(x[n], y[n]))
    }

    fn series<S: Real>(u: S) -> [Local<S>; 4] {
        let value = u.in_lanes()[0];
        let [x, y] = point(SeventhOrder::variable(value));
        at(&orders(x, y), u - S::constant(value))
    }

    #[test]
    fn a_series_of_low_order_begins_as_one_of_high_order() {
        fn of<T: TaylorSeries>() -> Vec<f64> {
            let [x, y] = point(T::variable(0.7));
            orders(x, y)[..=T::ORDER].iter().flat_map(|c| [c.x, c.y]).collect()
        }
        let (number, third, seventh) = (of::<f64>(), of::<ThirdOrder>(), of::<SeventhOrder>());
        assert_eq!([number.len(), third.len(), seventh.len()], [2, 8, 16]);
        for (low, high) in number.iter().chain(&third).zip(seventh[..2].iter().chain(&seventh)) {
            assert!((low - high).abs() < 1e-13 * (1.0 + high.abs()), "{low} {high}");
        }
    }

    #[test]
    fn a_scalar_with_derivatives_of_fourth_order_is_exact() {
        let inner = |x: f64, a: f64, b: f64| Jet::new(x, a, b);
        let u: Jet<Jet> =
            Jet::new(inner(0.7, 0.3, -0.2), inner(1.1, 0.4, 0.9), inner(-0.5, 0.8, 0.6));
        for (a, b) in series(u).iter().zip(nested(u)) {
            for (a, b) in [(a.x, b.x), (a.y, b.y)] {
                let numbers = |x: Jet<Jet>| {
                    [x.value, x.rate, x.second].map(|x| [x.value, x.rate, x.second]).concat()
                };
                for (a, b) in numbers(a).into_iter().zip(numbers(b)) {
                    assert!((a - b).abs() <= 1e-11 * (1.0 + b.abs()), "{a} {b}");
                }
            }
        }
        let u = Dual { value: Dual::<3>::variable(0.4, 1), slope: [Dual::variable(0.2, 2); 3] };
        for (a, b) in series(u).iter().zip(nested(u)) {
            assert!((a.x.slope[0].slope[2] - b.x.slope[0].slope[2]).abs() < 1e-11);
        }
    }

    #[test]
    fn a_number_has_its_derivatives_where_higher_ones_are_not_finite() {
        let x = SeventhOrder::variable(0.0).powc(3.5);
        let at = at(&orders(x, x), 0.0);
        assert!(at.iter().all(|c| c.x == 0.0), "{at:?}");
    }
}
