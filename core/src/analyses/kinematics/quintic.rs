//! Polynomials between two points of a motion.

use super::solution::Point;
use crate::math::{each, Listed, ShortArray};

/// Their degree.
pub(super) const DEGREE: usize = 5;

/// The Hermite interpolant of degree 5, which matches position, rate and acceleration at two points.
pub(super) struct Quintic<'p> {
    from: &'p Point,
    to: &'p Point,
    pub h: f64,
}

impl<'p> Quintic<'p> {
    pub fn new(from: &'p Point, to: &'p Point) -> Self {
        Self { from, to, h: to.t - from.t }
    }

    /// v₀, h a₀, the mean rate, v₁ and h a₁, for `Interpolant::quintic`: shape (5, n_q).
    pub fn stages(&self) -> Vec<f64> {
        let Self { from, to, h } = self;
        let mean = from.q.iter().zip(&to.q).map(|(from, to)| (to - from) / h);
        let of = |a: &[f64]| a.iter().map(|a| h * a).list();
        [from.v.clone(), of(&from.a), mean.list(), to.v.clone(), of(&to.a)].concat()
    }

    /// Coefficients of θ, …, θ⁵ for coordinate `k` minus its initial value.
    pub fn position(&self, k: usize) -> [f64; DEGREE] {
        let Self { from, to, h } = *self;
        let [v0, v1] = each([from.v[k], to.v[k]], |v| v * h);
        let [a0, a1] = each([from.a[k], to.a[k]], |a| a * h * h);
        // the remainders at the end after the terms up to the second degree
        let d = to.q[k] - from.q[k] - v0 - 0.5 * a0;
        let e = v1 - v0 - a0;
        let f = a1 - a0;
        [
            v0,
            0.5 * a0,
            10.0 * d - 4.0 * e + 0.5 * f,
            -15.0 * d + 7.0 * e - f,
            6.0 * d - 3.0 * e + 0.5 * f,
        ]
    }

    /// Coefficients of the first derivative of component `k`.
    pub fn rate(&self, k: usize) -> [f64; DEGREE] {
        let [_, c2, c3, c4, c5] = self.position(k);
        each([2.0 * c2, 3.0 * c3, 4.0 * c4, 5.0 * c5, 0.0], |c| c / self.h)
    }

    /// Coefficients of the second derivative of component `k`.
    fn acceleration(&self, k: usize) -> [f64; DEGREE] {
        let [_, c2, c3, c4, c5] = self.rate(k).each(|c| c / self.h);
        [2.0 * c2, 3.0 * c3, 4.0 * c4, 5.0 * c5, 0.0]
    }

    /// The interpolated point at θ in [0, 1].
    pub fn at(&self, theta: f64) -> Point {
        let value = |c: [f64; DEGREE]| c.iter().rev().fold(0.0, |sum, c| (sum + c) * theta);
        let n = self.from.q.len();
        Point {
            t: self.from.t + theta * self.h,
            q: (0..n).map(|k| self.from.q[k] + value(self.position(k))).list(),
            v: (0..n).map(|k| self.from.v[k] + value(self.rate(k))).list(),
            a: (0..n).map(|k| self.from.a[k] + value(self.acceleration(k))).list(),
        }
    }
}
