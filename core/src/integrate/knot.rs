//! The memory that implicit methods share: a state with its accelerations, tolerances, and counts.

use super::adaptive_options::{Atol, Options};
use super::constrained::{Constrained, Level, Point, Residual, Shares};
use super::contract::{Ended, Statistics};
use super::failure::Cause;
use super::rate::all_finite;
use super::step_size::{initial_step, probing_step};
use crate::math::Complex;

/// A state on the constraints with its derivative.
#[derive(Clone, Debug)]
pub(super) struct Knot {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
    pub lam: Vec<f64>,
    /// Rates of the quadratures.
    pub powers: Vec<f64>,
}

impl Knot {
    pub fn new(n: usize, m: usize, works: usize) -> Self {
        Self {
            q: vec![0.0; n],
            v: vec![0.0; n],
            a: vec![0.0; n],
            lam: vec![0.0; m],
            powers: vec![0.0; works],
        }
    }

    pub fn point(&self) -> Point<'_> {
        Point { q: &self.q, v: &self.v, a: &self.a, lam: &self.lam }
    }

    pub fn copy_from(&mut self, other: &Self) {
        self.q.copy_from_slice(&other.q);
        self.v.copy_from_slice(&other.v);
        self.a.copy_from_slice(&other.a);
        self.lam.copy_from_slice(&other.lam);
        self.powers.copy_from_slice(&other.powers);
    }

    /// (v, a, powers): the derivative of y.
    pub fn derivative(&self, out: &mut [f64]) {
        let n = self.q.len();
        out[..n].copy_from_slice(&self.v);
        out[n..2 * n].copy_from_slice(&self.a);
        out[2 * n..].copy_from_slice(&self.powers);
    }
}

/// What a component may be off by: atol + rtol |y|, for q and then v.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    rtol: f64,
    atol: Vec<f64>,
    pub weights: Vec<f64>,
}

impl Scale {
    pub fn new(options: &Options<'_>, n: usize) -> Self {
        let atol = match options.atol {
            Atol::Scalar(atol) => vec![*atol; 2 * n],
            Atol::Each(atol) => atol.clone(),
        };
        Self { rtol: options.rtol, weights: vec![1.0; atol.len()], atol }
    }

    /// At the larger of two states.
    pub fn set(&mut self, old: &Knot, new: &Knot) {
        let values = |k: &'_ Knot, i: usize| {
            if i < k.q.len() {
                k.q[i].abs()
            } else {
                k.v[i - k.q.len()].abs()
            }
        };
        for (i, (weight, atol)) in self.weights.iter_mut().zip(&self.atol).enumerate() {
            *weight = atol + self.rtol * values(old, i).max(values(new, i));
        }
    }

    /// √(mean (xᵢ / weightᵢ)²) over q and v; 0 / 0 counts as nothing.
    pub fn norm(&self, dq: &[f64], dv: &[f64]) -> f64 {
        let n = self.weights.len().max(1);
        let parts = dq.iter().chain(dv).zip(&self.weights);
        let sum: f64 = parts.filter(|(x, _)| **x != 0.0).map(|(x, w)| (x / w) * (x / w)).sum();
        (sum / n as f64).sqrt()
    }
}

/// A system with the count of what is asked of it.
pub(super) struct Counted<'a, Y> {
    pub system: &'a mut Y,
    pub counts: Statistics,
}

impl<'a, Y: Constrained> Counted<'a, Y> {
    pub fn new(system: &'a mut Y, t: f64) -> Self {
        Self { system, counts: Statistics { ended: Ended::Stopped, ..Statistics::none(t) } }
    }

    /// Accelerations, multipliers and powers of a knot from its q and v.
    pub fn accelerate(&mut self, t: f64, knot: &mut Knot) -> Result<(), Y::Stop> {
        self.counts.evaluations += 1;
        let Knot { q, v, a, lam, powers } = knot;
        self.system.accelerate(t, [q, v], a, lam, powers)
    }

    /// The same where it has to be finite.
    pub fn begin(&mut self, t: f64, knot: &mut Knot) -> Result<(), Cause<Y::Stop>> {
        self.accelerate(t, knot).map_err(Cause::Equations)?;
        if all_finite(&knot.a) && all_finite(&knot.lam) {
            Ok(())
        } else {
            Err(Cause::NotFinite { t })
        }
    }

    /// Hairer's choice of the magnitude of the first step from `start`, at the cost of one evaluation.
    pub fn first_step(
        &mut self,
        (t, t_end): (f64, f64),
        (start, probe): (&Knot, &mut Knot),
        scale: &mut Scale,
        error_order: i32,
    ) -> Result<f64, Y::Stop> {
        let interval = (t_end - t).abs();
        scale.set(start, start);
        let d0 = scale.norm(&start.q, &start.v);
        let d1 = scale.norm(&start.v, &start.a);
        let h0 = probing_step(d0, d1, interval);
        let h = h0.copysign(t_end - t);
        for i in 0..start.q.len() {
            probe.q[i] = start.q[i] + h * start.v[i];
            probe.v[i] = start.v[i] + h * start.a[i];
        }
        self.accelerate(t + h, probe)?;
        let change = |new: &[f64], old: &[f64]| -> Vec<f64> {
            new.iter().zip(old).map(|(new, old)| (new - old) / h0).collect()
        };
        let d2 = scale.norm(&change(&probe.v, &start.v), &change(&probe.a, &start.a));
        if !d2.is_finite() {
            return Ok(h0);
        }
        Ok(initial_step(h0, d1, d2, error_order).min(interval))
    }

    pub fn residual(&mut self, t: f64, at: Point<'_>, level: Level, out: Residual<'_>) {
        self.counts.evaluations += 1;
        self.system.residual(t, at, level, out);
    }

    pub fn linearize(&mut self, t: f64, at: Point<'_>) {
        self.counts.jacobians += 1;
        self.system.linearize(t, at);
    }

    /// Whether the matrix has a factorisation.
    pub fn factor(&mut self, shares: Shares) -> bool {
        self.counts.factorisations += 1;
        self.system.factor(shares).is_ok()
    }

    pub fn factor_complex(&mut self, shares: Shares<Complex>) -> bool {
        self.counts.factorisations += 1;
        self.system.factor_complex(shares).is_ok()
    }
}
