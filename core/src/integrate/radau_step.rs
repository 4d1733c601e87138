//! One step of Radau IIA of order 5 at index 2: Φ_q v + Φ_t = 0 at every stage.
//!
//! The unknowns are the increments vᵢ - v₀ and zᵢ - z₀ and the multipliers λᵢ of the stages. The positions are q₀ + h
//! Σ aᵢⱼ vⱼ, and the derivatives of (v, z) are Σ (A⁻¹)ᵢⱼ incrementⱼ / h. For each eigenvalue μ of A⁻¹, the equations
//! of Newton's iteration for the transformed unknowns are, without z,
//!
//! ```text
//! [ M + h/μ D + (h/μ)² K   Φ_qᵀ ] [    w    ]     [ h/μ r ]
//! [ Φ_q + h/μ B             0   ] [ h/μ Δλ ] = - [  Φ̇   ]
//! ```
//!
//! They are solved with the real and with the complex eigenvalue (Hairer and Wanner, *Solving Ordinary Differential
//! Equations II*, IV.8 and VII.6). The condition number does not grow as h decreases. q and v have order 5, λ has 3.

use super::dae::{ConstraintLevel, Dae, DaeLengths, DaeResidual, Iterate};
use super::error_weights::ErrorWeights;
use super::evaluation_counter::CountedDae;
use super::failure::Cause;
use super::implicit_state::{serves, ImplicitState};
use super::radau_coefficients::{
    coefficients, complex_step, dot, lagrange, A, C, ERROR, INVERSE, REAL, T, T_INVERSE,
};
use crate::math::{indexed, Complex, Field, ShortArray};

/// Relative size of velocity corrections that are rounding errors, compared with the largest velocity.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Part of the tolerance that counts for unknowns on which others depend.
const EARLIER: f64 = 0.1;
/// Number of rows of the continuous extension: v at the beginning and at the stages, the derivatives at the stages,
/// and the jump of a projection.
pub(super) const ROWS: usize = 8;

/// The outcome of Newton's iteration.
pub(super) enum NewtonOutcome {
    /// The iteration converged, with the number of iterations and the rate of convergence.
    Converged(usize, f64),
    Diverged,
    /// The matrix is singular.
    Singular,
}

/// The limits of Newton's iteration.
#[derive(Clone, Copy)]
pub(super) struct NewtonLimits {
    /// Largest norm of the remaining error.
    pub tolerance: f64,
    /// Largest number of iterations.
    pub most: usize,
}

/// State and work memory of an integration.
pub(super) struct RadauStep {
    pub start: ImplicitState,
    pub stages: [ImplicitState; 3],
    /// (v - v₀, z - z₀) at the stages.
    increments: [Vec<f64>; 3],
    /// Increments of the step before, from which this step is predicted.
    increments_before: [Vec<f64>; 3],
    lam_before: [Vec<f64>; 3],
    h_before: Option<f64>,
    residuals: [Vec<f64>; 3],
    real: Vec<f64>,
    complex: Vec<Complex>,
    dq: Vec<f64>,
    /// Estimated errors of q, v and z.
    error: [Vec<f64>; 3],
    /// The start moved by these errors, and the change of q along it that the error estimate uses.
    moved: ImplicitState,
    along: Vec<f64>,
    /// Whether the tangent was computed for this step.
    pub fresh: bool,
    factored: Option<f64>,
    /// Number of columns of each part of the state.
    columns: usize,
}

impl RadauStep {
    pub fn new(lengths: DaeLengths) -> Self {
        let DaeLengths { coordinates: n, multipliers: m, states, .. } = lengths;
        let unknowns = lengths.unknowns();
        let rows = |len: usize| std::array::from_fn(|_| vec![0.0; len]);
        Self {
            start: ImplicitState::new(lengths),
            stages: std::array::from_fn(|_| ImplicitState::new(lengths)),
            increments: rows(n + states),
            increments_before: rows(n + states),
            lam_before: rows(m),
            h_before: None,
            residuals: rows(unknowns),
            real: vec![0.0; unknowns],
            complex: vec![Complex::zero(); unknowns],
            dq: vec![0.0; n],
            error: [n, n, states].each(|len| vec![0.0; len]),
            moved: ImplicitState::new(lengths),
            along: vec![0.0; n],
            fresh: false,
            factored: None,
            columns: lengths.columns,
        }
    }

    /// Discards the data of earlier steps after a change of the state.
    pub fn forget(&mut self) {
        (self.h_before, self.factored, self.fresh) = (None, None, false);
    }

    /// Solves for the stages of a step.
    pub fn advance<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &mut ErrorWeights,
        enough: NewtonLimits,
    ) -> NewtonOutcome {
        if !serves(self.factored, h) {
            self.factored = None;
            if !(system.factor(coefficients(h / REAL))
                && system.factor_complex(coefficients(complex_step(h))))
            {
                return NewtonOutcome::Singular;
            }
            self.factored = Some(h);
        }
        self.predict(h);
        let (parts, mut most, mut slowest) = (system.system.parts(), 0, 0.0_f64);
        for part in 0..parts {
            system.system.begin_part(part);
            let tolerance = enough.tolerance * if part + 1 < parts { EARLIER } else { 1.0 };
            let limits = NewtonLimits { tolerance, ..enough };
            match self.newton(system, (t, h), scale, (limits, slowest)) {
                NewtonOutcome::Converged(count, rate) => {
                    (most, slowest) = (most.max(count), slowest.max(rate));
                }
                other => return other,
            }
        }
        NewtonOutcome::Converged(most, slowest)
    }

    /// Computes the tangent at the beginning of the step, but with the positions at its middle. Because bodies
    /// rotate, this makes the iteration converge twice as fast.
    pub fn linearize<Y: Dae + ?Sized>(&mut self, system: &mut CountedDae<'_, Y>, t: f64, h: f64) {
        let ImplicitState { q, v, .. } = &self.start;
        self.dq.iter_mut().zip(q.iter().zip(v)).for_each(|(mid, (q, v))| *mid = q + 0.5 * h * v);
        system.linearize(t + 0.5 * h, Iterate { q: &self.dq, ..self.start.iterate() });
        self.fresh = true;
        self.factored = None;
    }

    /// Predicts the increments and multipliers by extrapolating the polynomials of the step before.
    fn predict(&mut self, h: f64) {
        let nodes = [0.0, C[0], C[1], C[2]];
        for (i, stage) in self.stages.iter_mut().enumerate() {
            let Some(h_before) = self.h_before else {
                let step = C[i] * h;
                let rates = self.start.a.iter().chain(&self.start.dz);
                self.increments[i].iter_mut().zip(rates).for_each(|(to, rate)| *to = step * rate);
                stage.lam.copy_from_slice(&self.start.lam);
                continue;
            };
            let theta = 1.0 + C[i] * h / h_before;
            let [_, one, two, three] = lagrange(nodes, theta);
            let before = self.increments_before.each_ref();
            for (k, out) in self.increments[i].iter_mut().enumerate() {
                *out = one * before[0][k] + two * before[1][k] + (three - 1.0) * before[2][k];
            }
            let [one, two, three] = lagrange(C, theta);
            let lam = self.lam_before.each_ref();
            for (k, out) in stage.lam.iter_mut().enumerate() {
                *out = one * lam[0][k] + two * lam[1][k] + three * lam[2][k];
            }
        }
    }

    /// Newton's iteration. `rate` is that of its convergence for the unknowns before, with the same matrix; 0 without them.
    fn newton<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &mut ErrorWeights,
        (NewtonLimits { tolerance, most }, mut rate): (NewtonLimits, f64),
    ) -> NewtonOutcome {
        self.update_stages(h);
        scale.set(&self.start, &self.stages[2]);
        let mut last = f64::INFINITY;
        for iteration in 1..=most {
            self.evaluate(system, (t, h));
            let norm = self.correct(system, h, scale);
            if !norm.is_finite() {
                return NewtonOutcome::Diverged;
            }
            let enough = tolerance.max(self.rounding(scale));
            if iteration > 1 {
                rate = norm / last;
                let to_come = rate.powi((most - iteration) as i32) / (1.0 - rate) * norm;
                if rate >= 1.0 && norm > enough || rate < 1.0 && to_come > enough {
                    return NewtonOutcome::Diverged;
                }
            }
            let left = if rate < 0.5 { norm * rate / (1.0 - rate) } else { norm };
            if rate > 0.0 && left <= enough || norm <= 0.1 * enough {
                return NewtonOutcome::Converged(iteration, rate);
            }
            last = norm;
        }
        NewtonOutcome::Diverged
    }

    /// Computes q, v, z and the derivatives of the stages from the increments.
    fn update_stages(&mut self, h: f64) {
        let Self { start, stages, increments, .. } = self;
        let n = start.q.len();
        let at = |k: usize| [increments[0][k], increments[1][k], increments[2][k]];
        for (i, stage) in stages.iter_mut().enumerate() {
            for k in 0..n {
                let rise = at(k);
                stage.v[k] = start.v[k] + rise[i];
                stage.q[k] = start.q[k] + h * (C[i] * start.v[k] + dot(&A[i], &rise));
                stage.a[k] = dot(&INVERSE[i], &rise) / h;
            }
            for k in 0..start.z.len() {
                let rise = at(n + k);
                stage.z[k] = start.z[k] + rise[i];
                stage.dz[k] = dot(&INVERSE[i], &rise) / h;
            }
        }
    }

    /// Computes the residuals and powers of all stages.
    pub fn evaluate<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
    ) {
        let (n, states) = (self.dq.len(), self.start.z.len());
        for ((stage, residual), c) in self.stages.iter_mut().zip(&mut self.residuals).zip(C) {
            let ImplicitState { q, v, a, lam, z, dz, powers } = stage;
            let (forces, rest) = residual.split_at_mut(n);
            let (states, rows) = rest.split_at_mut(states);
            let at = Iterate { q, v, a, lam, z, dz };
            let out = DaeResidual { forces, states, rows, powers };
            system.residual(t + c * h, at, ConstraintLevel::Velocity, out);
        }
    }

    /// Corrects the stages by one iteration. Returns the norm of the correction.
    fn correct<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        h: f64,
        scale: &ErrorWeights,
    ) -> f64 {
        let n = self.increments[0].len(); // of v and z
        system.counts.iterations += 1;
        let Self { residuals: r, real, complex, .. } = self;
        let scaled = complex_step(h);
        for k in 0..real.len() {
            let r = [r[0][k], r[1][k], r[2][k]];
            let [first, second, third] = T_INVERSE.each(|row| dot(&row, &r));
            let pair = Complex::new(second, third);
            (real[k], complex[k]) =
                if k < n { (-h / REAL * first, -(scaled * pair)) } else { (-first, -pair) };
        }
        system.system.solve(real);
        system.system.solve_complex(complex);
        let unscaled = scaled.reciprocal();
        for k in 0..real.len() {
            let (first, pair) = if k < n {
                (real[k], complex[k])
            } else {
                (REAL / h * real[k], unscaled * complex[k])
            };
            for (i, row) in T.iter().enumerate() {
                let change = dot(row, &[first, pair.re, pair.im]);
                // overwrites the residual, for `norm`
                self.residuals[i][k] = change;
                if k < n {
                    self.increments[i][k] += change;
                } else {
                    self.stages[i].lam[k - n] += change;
                }
            }
        }
        self.update_stages(h);
        self.norm(h, scale)
    }

    /// The root mean square of the norms of the last correction over the stages.
    fn norm(&mut self, h: f64, scale: &ErrorWeights) -> f64 {
        let (n, both) = (self.dq.len(), self.increments[0].len());
        let mut sum = 0.0;
        for i in 0..3 {
            let r = self.residuals.each_ref();
            for (k, dq) in self.dq.iter_mut().enumerate() {
                *dq = h * dot(&A[i], &[r[0][k], r[1][k], r[2][k]]);
            }
            let norm = scale.norm(&self.dq, &r[i][..n], &r[i][n..both]);
            sum += norm * norm;
        }
        (sum / 3.0_f64).sqrt()
    }

    /// The norm of corrections that contain only rounding errors: of v relative to the largest velocity of its column, of
    /// z to its own size.
    fn rounding(&self, scale: &ErrorWeights) -> f64 {
        let (n, end) = (self.dq.len(), &self.stages[2]);
        let largest = |v: &[f64]| v.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let columns = end.v.chunks((n / self.columns).max(1));
        let sizes = columns.flat_map(|v| std::iter::repeat_n(largest(v), v.len()));
        let sizes = sizes.chain(end.z.iter().map(|z| z.abs()));
        let parts = sizes.zip(&scale.weights[n..]).filter(|(_, w)| **w > 0.0);
        let sum: f64 = parts.map(|(x, w)| (ROUNDING * x / w) * (ROUNDING * x / w)).sum();
        (sum / scale.weights.len().max(1) as f64).sqrt()
    }

    /// The estimated error of the step relative to its tolerance. It is the difference from an embedded method of
    /// order 3, filtered by the real matrix (IV.8.19 and IV.8.20 of the book). With `again`, the estimate is repeated
    /// from the start moved by the first estimate. A stiff start requires this.
    pub fn error<Y: Dae + ?Sized>(
        &mut self,
        system: &mut CountedDae<'_, Y>,
        (t, h): (f64, f64),
        scale: &ErrorWeights,
        again: bool,
    ) -> Result<f64, Cause<Y::Stop>> {
        let n = self.dq.len();
        let Self { start, moved, stages, increments, error, real, along, .. } = self;
        moved.copy_from(start);
        if again {
            for (x, dx) in [&mut moved.q, &mut moved.v, &mut moved.z].into_iter().zip(&*error) {
                x.iter_mut().zip(dx).for_each(|(x, d)| *x += d);
            }
            system.accelerate(t, moved)?;
        }
        let step = h / REAL;
        let rise = |k: usize| dot(&ERROR, &[increments[0][k], increments[1][k], increments[2][k]]);
        // the memory of the error first contains the factors of K and M
        let [stiff, force, states] = error;
        for k in 0..n {
            let q = indexed(|i| stages[i].q[k] - start.q[k]);
            along[k] = step * moved.v[k] + dot(&ERROR, &q);
            force[k] = step * moved.a[k] + rise(k);
            stiff[k] = step * along[k];
        }
        for (k, state) in states.iter_mut().enumerate() {
            *state = step * moved.dz[k] + rise(n + k);
        }
        system.system.times(force, states, stiff, real);
        // the row of B lacks the second factor h/μ of K
        let both = n + states.len();
        real[both..].iter_mut().for_each(|row| *row /= step);
        system.system.solve(real);
        force.copy_from_slice(&real[..n]);
        states.copy_from_slice(&real[n..both]);
        let along = along.iter().zip(&real[..n]);
        stiff.iter_mut().zip(along).for_each(|(dq, (along, dv))| *dq = along + step * dv);
        let [dq, dv, dz] = &self.error;
        Ok(scale.norm(dq, dv, dz))
    }

    /// Sets all rows of the interpolant of y = (q, v, z, quadratures) but the last.
    pub fn interpolant_rows(&self, rows: &mut [f64]) {
        let ImplicitState { q, z, powers, .. } = &self.start;
        let (n, works) = (q.len(), 2 * q.len() + z.len());
        let len = works + powers.len();
        rows.fill(0.0);
        rows[..n].copy_from_slice(&self.start.v);
        rows[works..len].copy_from_slice(powers);
        for (i, stage) in self.stages.iter().enumerate() {
            let integrated = &mut rows[(1 + i) * len..][..len];
            integrated[..n].copy_from_slice(&stage.v);
            integrated[works..].copy_from_slice(&stage.powers);
            let rest = &mut rows[(4 + i) * len..][n..works];
            rest[..n].copy_from_slice(&stage.a);
            rest[n..].copy_from_slice(&stage.dz);
        }
    }

    /// The change h Σ bᵢ powerᵢ of one quadrature.
    pub fn work(&self, k: usize, h: f64) -> f64 {
        h * dot(&A[2], &self.powers(k))
    }

    /// The powers of one quadrature at the stages.
    pub fn powers(&self, k: usize) -> [f64; 3] {
        indexed(|i| self.stages[i].powers[k])
    }

    /// Stores the stages for the prediction of the next step.
    pub fn move_on(&mut self, h: f64) {
        for i in 0..3 {
            self.increments_before[i].copy_from_slice(&self.increments[i]);
            self.lam_before[i].copy_from_slice(&self.stages[i].lam);
        }
        self.h_before = Some(h);
        self.fresh = false;
    }
}
