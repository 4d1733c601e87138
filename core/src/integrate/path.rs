//! Bounds of the interpolant of a step over parts of the step.
//!
//! The interpolant is a polynomial in time for each component. The coefficients of a polynomial in Bernstein form
//! enclose its values (Farouki, *The Bernstein polynomial basis: a centennial retrospective*, Comput. Aided Geom.
//! Des. 29 (2012) 379). The bounds are widened by the rounding errors of their computation.

use super::component_polynomials::HIGHEST;
use super::step::Step;
use crate::math::{Dual, Interval};

/// Bounds of a quantity and of its time derivative.
pub type Bounds = Dual<1, Interval>;

/// Rounding errors of a bound, relative to the sum of its terms. The coefficients are themselves sums over the stages of
/// the step, whose weights are up to a hundred times as large.
const ROUNDING: f64 = 1024.0 * f64::EPSILON;

/// The path of the state during a step.
#[derive(Clone, Debug)]
pub struct StepPath<'a> {
    /// The step.
    pub step: &'a Step<'a>,
    degree: usize,
    /// Coefficients of θ, θ², … of each component, divided by h.
    coefficients: Vec<f64>,
}

impl<'a> StepPath<'a> {
    /// The path of a step with its interpolant prepared.
    pub fn new(step: &'a Step<'a>) -> Self {
        let degree = step.interpolant.degree();
        let mut coefficients = vec![0.0; step.y.len() * degree];
        step.coefficients(&mut coefficients);
        Self { step, degree, coefficients }
    }

    /// θ at a time, and h.
    fn place(&self, t: f64) -> (f64, f64) {
        let h = self.step.t - self.step.t_old;
        ((t - self.step.t_old) / h, h)
    }

    /// A component of the state at a time.
    pub fn value(&self, component: usize, t: f64) -> f64 {
        let (theta, h) = self.place(t);
        let b = &self.coefficients[component * self.degree..][..self.degree];
        self.step.y_old[component] + h * theta * b.iter().rev().fold(0.0, |sum, b| b + theta * sum)
    }

    /// The bounds of a component of the state and of its time derivative between two times.
    pub fn component(&self, component: usize, [from, to]: [f64; 2]) -> Bounds {
        let degree = self.degree;
        let ((first, h), (last, _)) = (self.place(from), self.place(to));
        let b = &self.coefficients[component * degree..][..degree];
        let (mut size, mut steepest, mut sum) = (0.0, 0.0, 0.0);
        let mut taylor = [0.0; HIGHEST + 1];
        for (k, b) in (1..).zip(b) {
            taylor[k] = *b;
            size += b.abs();
            sum += b;
            steepest += k as f64 * b.abs();
        }
        // the polynomial in θ - first
        for k in 0..degree {
            for n in (k..degree).rev() {
                taylor[n] += first * taylor[n + 1];
            }
        }
        let mut slopes = [0.0; HIGHEST];
        let (mut power, width) = (1.0, last - first);
        for k in 0..degree {
            slopes[k] = (k + 1) as f64 * power * taylor[k + 1];
            taylor[k] *= power;
            power *= width;
        }
        taylor[degree] *= power;
        let [low, high] = enclosed(&mut taylor[..=degree]);
        let moved = Interval::new(low, high) * Interval::new(h, h);
        // the state at the end of the step, and times, are rounded
        let y = [self.step.y_old[component], self.step.y[component]];
        let missed = (y[1] - (y[0] + h * sum)).abs();
        let late = 4.0 * from.abs().max(to.abs()) * steepest;
        let error = missed + ROUNDING * (size * h).abs() + f64::EPSILON * (y[0].abs() + late);
        let y_old = Interval::around(y[0], error);
        let [low, high] = enclosed(&mut slopes[..degree]);
        let error = ROUNDING * steepest;
        Bounds { value: y_old + moved, slope: [Interval::new(low - error, high + error)] }
    }

    /// The bounds of the time between two times.
    pub fn time(&self, [from, to]: [f64; 2]) -> Bounds {
        Bounds::variable(Interval::new(from.min(to), from.max(to)), 0)
    }
}

/// The least and the largest Bernstein coefficient of a polynomial on [0, 1], given by its coefficients of 1, x, ….
fn enclosed(c: &mut [f64]) -> [f64; 2] {
    let degree = c.len() - 1;
    // divided by the binomial coefficients, they are the differences of the Bernstein coefficients
    let mut binomial = 1.0;
    for (k, c) in c.iter_mut().enumerate() {
        *c /= binomial;
        binomial *= (degree - k) as f64 / (k + 1) as f64;
    }
    for k in (0..degree).rev() {
        for n in k..degree {
            c[n + 1] += c[n];
        }
    }
    let least = c.iter().copied().fold(f64::INFINITY, f64::min);
    [least, c.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
}
