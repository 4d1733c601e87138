//! Closing a mechanism: Newton–Raphson on Φ(q, t) = 0 with the rows of drivers and of `set`.
//!
//! Each step solves [W Φ_qᵀ; Φ_q -μ I]. If there are free coordinates, this is the smallest step; if Φ_q is square,
//! Newton's step; and if μ > 0, a damped least-squares step. Lengths are divided by the size of the mechanism, so
//! that metres and radians can be compared.

use crate::equations::augmented::Augmented;
use crate::equations::constraints;
use crate::equations::kinematics::Motions;
use crate::math::Listed;
use crate::model::{column_scales, row_scales, Model};
use crate::solve::newton::{Damping, Equations, Newton, Options, Outcome, Record};

/// Largest scaled residual of a consistent position.
pub const TOLERANCE: f64 = 1e-12;
/// Damping if a row of Φ_q depends on the others: far below the tolerance, but large enough for a pivot.
const REDUNDANT: f64 = 1e-9;
/// Damping of a row that is omitted. Its multiplier becomes zero.
const LEFT_OUT: f64 = 1e200;

/// Whether the computation must end early. Once true, it remains true.
pub type Halt<'a> = &'a dyn Fn() -> bool;

/// The computation ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stopped;

/// The position equations of a model at a fixed time.
pub struct Closing<'a> {
    model: &'a Model,
    t: f64,
    stop: Halt<'a>,
    /// Rows that are omitted; empty if there are none.
    left_out: Vec<bool>,
    matrix: Augmented,
    /// Scale of each row: the size for lengths, 1 for angles.
    scales: Vec<f64>,
    weights: Vec<f64>,
    solution: Vec<f64>,
}

impl<'a> Closing<'a> {
    /// The equations of a model at time `t`.
    pub fn new(model: &'a Model, t: f64, stop: Halt<'a>) -> Self {
        let (n, m) = (model.layout.n_q, model.layout.n_rows);
        let weights = column_scales(model).iter().map(|scale| 1.0 / (scale * scale)).list();
        let matrix = Augmented::new(model);
        Self {
            model,
            t,
            stop,
            left_out: Vec::new(),
            matrix,
            scales: row_scales(model),
            weights,
            solution: vec![0.0; n + m],
        }
    }

    /// The equations without some rows of Φ.
    pub fn without(mut self, rows: &[usize]) -> Self {
        self.left_out = vec![false; self.model.layout.n_rows];
        rows.iter().for_each(|row| self.left_out[*row] = true);
        self
    }

    /// The time of the closing, s.
    pub fn time(&self) -> f64 {
        self.t
    }

    /// The function that ends the computation.
    pub fn stop(&self) -> Halt<'a> {
        self.stop
    }

    /// Whether the computation must end.
    pub fn stopped(&self) -> bool {
        (self.stop)()
    }

    /// The model with the drivers for `set`.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// Corrects `q` until it satisfies the constraints; a consistent `q` is not changed. Returns the iterations, and
    /// whether the mechanism closed.
    pub fn close(&mut self, q: &mut [f64]) -> (Vec<Record>, bool) {
        let mut newton = Newton::new();
        let mut options = Options {
            residual_tolerance: TOLERANCE,
            step_tolerance: 1e-7,
            max_iterations: 60,
            damping: Damping::Halving { most: 12 },
        };
        let start = q.to_vec();
        let mut outcome = newton.solve(self, q, &options);
        let mut history = newton.history().to_vec();
        if outcome != Ok(Outcome::Converged) {
            q.copy_from_slice(&start);
            options.damping = Damping::Levenberg { initial: 1e-2, most: 24 };
            options.max_iterations = 200;
            outcome = newton.solve(self, q, &options);
            history = newton.history().to_vec();
        }
        let small = history.last().is_some_and(|r| r.residual_norm <= 1e3 * TOLERANCE);
        (history, outcome == Ok(Outcome::Converged) || small)
    }

    /// Φ at `q`, in m and rad.
    pub fn phi(&self, q: &[f64]) -> Vec<f64> {
        let mut phi = vec![0.0; self.model.layout.n_rows];
        constraints::residual(self.model, &self.at(q), self.t, &mut phi);
        phi
    }

    /// `q` after one step of Newton's method that removes given values of Φ, in m and rad.
    pub fn without_openings(&mut self, q: &[f64], phi: &[f64]) -> Vec<f64> {
        let scaled = phi.iter().zip(&self.scales).map(|(phi, s)| phi / s).list();
        let mut step = vec![0.0; q.len()];
        let Ok(()) = self.step(q, &scaled, 0.0, &mut step) else { return q.to_vec() };
        q.iter().zip(&step).map(|(q, step)| q + step).list()
    }

    /// The norm of Φ at `q`, scaled.
    pub fn left(&self, q: &[f64]) -> f64 {
        let scaled = self.phi(q).into_iter().zip(&self.scales);
        scaled.map(|(phi, scale)| (phi / scale).powi(2)).sum::<f64>().sqrt()
    }

    /// aᵀ W b, dimensionless: lengths are relative to the size of the mechanism.
    pub fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).zip(&self.weights).map(|((a, b), w)| a * w * b).sum()
    }

    /// The motions x that generalized forces f would cause if W were the mass matrix: [W Φ_qᵀ; Φ_q 0] [x; λ] = [f;
    /// 0]. None if the matrix cannot be factorised.
    pub fn motions_under<const N: usize>(
        &mut self,
        q: &[f64],
        forces: &[Vec<f64>; N],
    ) -> Option<[Vec<f64>; N]> {
        self.set_matrix(q, 0.0).then(|| forces.each_ref().map(|force| self.motion_under(force)))
    }

    /// The motion under generalized forces at the position of the last factors.
    fn motion_under(&mut self, force: &[f64]) -> Vec<f64> {
        let n = force.len();
        self.solution.fill(0.0);
        self.solution[..n].copy_from_slice(force);
        self.matrix.solve(&mut self.solution);
        self.solution[..n].to_vec()
    }

    fn at(&self, q: &[f64]) -> Motions {
        Motions::at_rest(&self.model.layout, q)
    }

    /// Factorises the matrix at a position; returns whether this succeeded.
    fn set_matrix(&mut self, q: &[f64], levenberg: f64) -> bool {
        let motions = self.at(q);
        self.matrix.set_weights(&self.weights);
        constraints::jacobian(self.model, &motions, self.t, self.matrix.jacobian_mut());
        self.factor(levenberg) || self.factor(levenberg.max(REDUNDANT.sqrt()))
    }

    fn factor(&mut self, levenberg: f64) -> bool {
        let damping = levenberg * levenberg;
        let damping = self.scales.iter().map(|s| damping * s * s).enumerate();
        let left_out = &self.left_out;
        self.matrix.set_damping(damping.map(|(row, damping)| match left_out.get(row) {
            Some(true) => LEFT_OUT,
            _ => damping,
        }));
        self.matrix.factor().is_ok()
    }
}

impl Equations for Closing<'_> {
    type Stop = Stopped;

    fn unknowns(&self) -> usize {
        self.model.layout.n_q
    }

    fn equations(&self) -> usize {
        self.model.layout.n_rows
    }

    fn residual(&mut self, q: &[f64], out: &mut [f64]) -> Result<(), Self::Stop> {
        if self.stopped() {
            return Err(Stopped);
        }
        constraints::residual(self.model, &self.at(q), self.t, out);
        for (r, s) in out.iter_mut().zip(&self.scales) {
            *r /= s;
        }
        let left_out = out.iter_mut().zip(&self.left_out).filter(|(_, left_out)| **left_out);
        left_out.for_each(|(r, _)| *r = 0.0);
        Ok(())
    }

    fn step(
        &mut self,
        q: &[f64],
        residual: &[f64],
        levenberg: f64,
        step: &mut [f64],
    ) -> Result<(), Self::Stop> {
        if !self.set_matrix(q, levenberg) {
            step.fill(f64::NAN);
            return Ok(());
        }
        let (upper, lower) = self.solution.split_at_mut(step.len());
        upper.fill(0.0);
        for ((x, r), s) in lower.iter_mut().zip(residual).zip(&self.scales) {
            *x = -r * s;
        }
        self.matrix.solve(&mut self.solution);
        step.copy_from_slice(&self.solution[..step.len()]);
        Ok(())
    }

    /// Euclidean norm.
    fn residual_norm(&self, residual: &[f64]) -> f64 {
        // the sum over an empty iterator is -0
        residual.iter().map(|r| r * r).sum::<f64>().abs().sqrt()
    }

    fn step_norm(&self, _: &[f64], step: &[f64]) -> f64 {
        let weighted = step.iter().zip(&self.weights).map(|(s, w)| s * s * w);
        weighted.sum::<f64>().abs().sqrt()
    }
}
