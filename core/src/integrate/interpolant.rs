//! The continuous extension of a step, 0 ≤ θ ≤ 1. It is either a sum over the stages, y(θ) = y_old + h Σₛ wₛ(θ) kₛ,
//! or one polynomial for each component.
//!
//! kₛ are the stages of a Runge–Kutta step, and wₛ are polynomials without a constant term. Nothing is computed until
//! the interpolant is evaluated. (Hairer, Nørsett and Wanner, *Solving Ordinary Differential Equations I*, II.6.)

#![allow(clippy::needless_range_loop)] // indices are stages, powers and lanes

use super::component_polynomials::{Polynomials, HIGHEST};
use crate::math::{indexed, Lanes, Real};

/// Largest number of stages of a method, including those of its extension and the jump of a projection.
const MOST: usize = 17;

/// Number of blocks of components that are summed together.
const TOGETHER: usize = 3;

/// The cubic Hermite polynomial, of order 3: coefficients of θ … θ⁴ for the derivative at the beginning, the
/// derivative at the end, and the chord (y - y_old) / h.
pub(super) const HERMITE: [f64; 12] =
    [1.0, -2.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, 3.0, -2.0, 0.0];

/// The Hermite polynomial of degree 5: coefficients of θ … θ⁵ for the derivative at the beginning, h times the second one,
/// the chord (y - y_old) / h, the derivative at the end, and h times the second one.
const QUINTIC: [f64; 25] = [
    1.0, 0.0, -6.0, 8.0, -3.0, 0.0, 0.5, -1.5, 1.5, -0.5, 0.0, 0.0, 10.0, -15.0, 6.0, 0.0, 0.0,
    -4.0, 7.0, -3.0, 0.0, 0.0, 0.5, -1.0, 0.5,
];

/// The form of the solution between the ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Interpolant<'a> {
    form: Form<'a>,
    degree: usize,
}

#[derive(Clone, Copy, Debug)]
enum Form<'a> {
    Stages(Stages<'a>),
    Polynomials(Polynomials<'a>),
}

/// Stages of a step, and the polynomials that weight them.
#[derive(Clone, Copy, Debug)]
struct Stages<'a> {
    /// Row-major (number of stages) × (len of y, or more).
    stages: &'a [f64],
    /// Coefficients of θ, θ², … for each stage, row-major (number of stages or more) × degree.
    table: &'static [f64],
    len: usize,
}

/// Σ bₖ θᵏ⁻¹, k = 1, ….
#[inline(always)]
fn polynomial(coefficients: &[f64], theta: f64) -> f64 {
    let mut sum = 0.0;
    for b in coefficients.iter().rev() {
        sum = b.plus_product(sum, theta);
    }
    sum
}

impl<'a> Interpolant<'a> {
    /// An interpolant from `stages` in rows of length `len`, whose first entries are the components. The number of
    /// rows may be less than that of `table`.
    #[inline]
    pub(super) fn new(stages: &'a [f64], len: usize, table: &'static [f64], degree: usize) -> Self {
        assert!(degree <= HIGHEST, "a method of a higher degree");
        assert!(table.len() <= MOST * degree, "a method of more stages");
        Self { form: Form::Stages(Stages { stages, table, len }), degree }
    }

    /// The Hermite polynomial of degree 5 from the derivative y′ at the beginning, h y″ there, the chord, y′ at the end and
    /// h y″ there: five rows of length `len`.
    pub fn quintic(stages: &'a [f64], len: usize) -> Self {
        Self::new(stages, len, &QUINTIC, 5)
    }

    /// An interpolant with one polynomial of the highest degree for each component.
    #[inline]
    pub(super) fn polynomials(polynomials: Polynomials<'a>) -> Self {
        Self { form: Form::Polynomials(polynomials), degree: HIGHEST }
    }

    /// Degree of the polynomial.
    #[inline]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Computes the state at θ. `ahead` = h θ is the time since the beginning.
    #[inline]
    pub(super) fn evaluate(&self, y_old: &[f64], ahead: f64, theta: f64, out: &mut [f64]) {
        assert_eq!(out.len(), y_old.len(), "a state");
        match self.form {
            Form::Polynomials(polynomials) => polynomials.evaluate(ahead, theta, out),
            Form::Stages(stages) => stages.evaluate(self.degree, y_old, (ahead, theta), out),
        }
    }

    pub(super) fn coefficients(&self, out: &mut [f64]) {
        match (self.form, self.degree) {
            (Form::Polynomials(polynomials), _) => polynomials.coefficients(out),
            (Form::Stages(stages), 4) => stages.add_coefficients(4, out),
            (Form::Stages(stages), 7) => stages.add_coefficients(7, out),
            (Form::Stages(stages), degree) => stages.add_coefficients(degree, out),
        }
    }
}

impl<'a> Stages<'a> {
    /// Number of stages.
    #[inline(always)]
    fn count(&self) -> usize {
        self.stages.len() / self.len.max(1)
    }

    /// A stage, with its row of the table, whose length is the degree.
    #[inline(always)]
    fn term(&self, s: usize, degree: usize) -> (&'a [f64], &'static [f64]) {
        (&self.stages[s * self.len..][..self.len], &self.table[s * degree..][..degree])
    }

    /// out = y_old + ahead Σₛ wₛ(θ) / θ kₛ. Not inlined, because the other form, with polynomials, does not need its
    /// registers.
    #[inline(never)]
    fn evaluate(&self, degree: usize, y_old: &[f64], at: (f64, f64), out: &mut [f64]) {
        // a constant degree lets the compiler unroll the inner loops, here and in `coefficients`
        let mut weights = [0.0; MOST];
        match degree {
            4 => self.weigh(4, at, &mut weights),
            7 => self.weigh(7, at, &mut weights),
            degree => self.weigh(degree, at, &mut weights),
        }
        let terms = || self.stages.chunks_exact(self.len.max(1)).zip(&weights);
        match out.len() {
            0..Lanes::WIDTH => {
                for (i, (out, y)) in out.iter_mut().zip(y_old).enumerate() {
                    *out = terms().fold(*y, |sum, (k, weight)| sum.plus_product(*weight, k[i]));
                }
            }
            n if n < TOGETHER * Lanes::WIDTH => blocks_of_sums::<1, _>(y_old, terms, out),
            _ => blocks_of_sums::<TOGETHER, _>(y_old, terms, out),
        }
    }

    /// ahead wₛ(θ) / θ of each stage.
    #[inline(always)]
    fn weigh(&self, degree: usize, (ahead, theta): (f64, f64), weights: &mut [f64; MOST]) {
        for s in 0..self.count() {
            weights[s] = ahead * polynomial(&self.table[s * degree..][..degree], theta);
        }
    }

    #[inline(always)]
    fn add_coefficients(&self, degree: usize, out: &mut [f64]) {
        assert!(out.len() <= self.len * degree, "len of y x degree");
        let mut first = 0;
        while (first + Lanes::WIDTH) * degree <= out.len() {
            let sums = self.sums(degree, |stage| {
                let block: &[f64; Lanes::WIDTH] = stage[first..].first_chunk().expect("a block");
                Lanes::new(*block)
            });
            let out = &mut out[first * degree..(first + Lanes::WIDTH) * degree];
            for d in 0..degree {
                let sum = sums[d].to_array();
                for lane in 0..Lanes::WIDTH {
                    out[lane * degree + d] = sum[lane];
                }
            }
            first += Lanes::WIDTH;
        }
        while (first + 1) * degree <= out.len() {
            let sums = self.sums(degree, |stage| stage[first]);
            out[first * degree..][..degree].copy_from_slice(&sums[..degree]);
            first += 1;
        }
    }

    /// The coefficients of θ, θ², … of one `component`.
    #[inline(always)]
    fn sums<R: Real>(&self, degree: usize, component: impl Fn(&[f64]) -> R) -> [R; HIGHEST] {
        let mut sums = [R::zero(); HIGHEST];
        for s in 0..self.count() {
            let (stage, row) = self.term(s, degree);
            let k = component(stage);
            for d in 0..degree {
                sums[d] += R::constant(row[d]) * k;
            }
        }
        sums
    }
}

/// out = y + Σ weight stage, in passes over `BLOCKS` blocks of components. The last pass may overlap the one before.
/// `out` must have at least as many components as one pass.
#[inline(always)]
fn blocks_of_sums<'a, const BLOCKS: usize, T>(y: &[f64], terms: impl Fn() -> T, out: &mut [f64])
where
    T: Iterator<Item = (&'a [f64], &'a f64)>,
{
    let pass = BLOCKS * Lanes::WIDTH;
    let last = out.len() - pass;
    let mut first = 0;
    loop {
        let mut sums: [Lanes; BLOCKS] = lanes(&y[first..]);
        for (stage, weight) in terms() {
            let weight = Lanes::constant(*weight);
            let k: [Lanes; BLOCKS] = lanes(&stage[first..]);
            for b in 0..BLOCKS {
                sums[b] = sums[b].plus_product(weight, k[b]);
            }
        }
        for b in 0..BLOCKS {
            let out: &mut [f64; Lanes::WIDTH] =
                out[first + b * Lanes::WIDTH..].first_chunk_mut().expect("a block");
            *out = sums[b].to_array();
        }
        if first == last {
            return;
        }
        first = (first + pass).min(last);
    }
}

/// The first `BLOCKS` blocks of x.
#[inline(always)]
fn lanes<const BLOCKS: usize>(x: &[f64]) -> [Lanes; BLOCKS] {
    let x = &x[..BLOCKS * Lanes::WIDTH];
    indexed(|b| {
        let block = &x[b * Lanes::WIDTH..];
        Lanes::new([block[0], block[1], block[2], block[3]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows as long as the state and longer, in as many components as blocks, passes and what they leave behind take.
    #[test]
    fn states_are_the_sums_that_the_table_says() {
        let (ahead, theta) = (0.2, 0.4);
        let weights = HERMITE
            .chunks_exact(4)
            .map(|b| ahead * (b[0] + theta * (b[1] + theta * (b[2] + theta * b[3]))));
        let weights: Vec<f64> = weights.collect();
        for n in [0, 1, 3, 4, 5, 8, 11, 12, 13, 21, 24, 33] {
            for len in [n, n + 3] {
                let stages: Vec<f64> = (0..3 * len).map(|k| (k as f64).sin()).collect();
                let y_old: Vec<f64> = (0..n).map(|k| (k as f64).cos()).collect();
                let mut out = vec![f64::NAN; n];
                let interpolant = Interpolant::new(&stages, len, &HERMITE, 4);
                interpolant.evaluate(&y_old, ahead, theta, &mut out);
                for (i, (out, y)) in out.iter().zip(&y_old).enumerate() {
                    let sum: f64 =
                        weights.iter().zip(0..).map(|(w, s)| w * stages[s * len + i]).sum();
                    assert!((out - (y + sum)).abs() < 1e-15, "{i} of {n} in rows of {len}");
                }
            }
        }
    }
}
