//! The continuous extension of a Runge–Kutta step: y(θ) = y_old + h Σₛ wₛ(θ) kₛ, 0 ≤ θ ≤ 1.
//!
//! kₛ are the stages and wₛ polynomials without constant term, so that nothing is computed for a step
//! nobody looks into. Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.6.

/// The cubic polynomial of Hermite, of order 3: coefficients of θ … θ⁴ of the derivative at the beginning,
/// at the end, and the chord (y - y_old) / h.
pub(super) const HERMITE: [f64; 12] =
    [1.0, -2.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 3.0, -2.0, 0.0];

/// Stages of a step with the polynomials that join them.
#[derive(Clone, Copy, Debug)]
pub struct Dense<'a> {
    /// Stages, row-major (number of stages) × (len of y).
    stages: &'a [f64],
    /// Coefficients of θ, θ², … of each stage, row-major (number of stages or more) × degree.
    table: &'static [f64],
    degree: usize,
    len: usize,
}

impl<'a> Dense<'a> {
    /// `stages` of `len` components each, as many as the caller wants of those in `table`.
    pub(super) fn new(stages: &'a [f64], len: usize, table: &'static [f64], degree: usize) -> Self {
        Self { stages, table, degree, len }
    }

    /// Degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Each stage with its row of the table.
    fn terms(&self) -> impl Iterator<Item = (&'a [f64], &'static [f64])> {
        self.stages.chunks_exact(self.len.max(1)).zip(self.table.chunks_exact(self.degree))
    }

    pub(super) fn evaluate(&self, y_old: &[f64], h: f64, theta: f64, out: &mut [f64]) {
        out.copy_from_slice(y_old);
        for (stage, row) in self.terms() {
            let weight = h * theta * row.iter().rev().fold(0.0, |sum, b| sum * theta + b);
            for (out, k) in out.iter_mut().zip(stage) {
                *out += weight * k;
            }
        }
    }

    pub(super) fn coefficients(&self, out: &mut [f64]) {
        assert_eq!(out.len(), self.len * self.degree, "len of y x degree");
        out.fill(0.0);
        for (stage, row) in self.terms() {
            for (out, k) in out.chunks_exact_mut(self.degree).zip(stage) {
                for (out, b) in out.iter_mut().zip(row) {
                    *out += b * k;
                }
            }
        }
    }
}
