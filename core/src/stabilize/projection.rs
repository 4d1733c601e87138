//! Projection of states onto the constraints Φ(q, t) = 0 and Φ_q v + Φ_t = 0.
//!
//! Positions first, then velocities; of all states that meet the constraints the nearest in the metric
//! of the mass matrix is taken, for velocities that of least kinetic energy of the difference:
//!
//! ```text
//! [ M   Φ_qᵀ ] [ Δq ]   [  0 ]        [ M   Φ_qᵀ ] [ Δv ]   [        0        ]
//! [ Φ_q  0   ] [ μ  ] = [ -Φ ] ,      [ Φ_q  0   ] [ μ  ] = [ -(Φ_q v + Φ_t) ]
//! ```
//!
//! (Eich, *Convergence results for a coordinate projection method applied to mechanical systems with
//! algebraic constraints*, SIAM J. Numer. Anal. 30 (1993) 1467.) The matrix is that of the equations of
//! motion, so its last factor serves: chord iterations, whose error falls by about the share of the
//! mechanism's size that is corrected. It is factorised anew only where that is too slow.

use crate::equations::{constraints, kinematics, Singular, Workspace};
use crate::model::{row_scales, size, Model};

/// Most iterations for positions, and for velocities.
const MOST: usize = 12;
/// A chord iteration that lowers the residual by less deserves a factor of its own.
const SLOW: f64 = 1e-2;
/// A residual that Newton's own step does not lower is rounding up to this factor of the tolerance.
const ROUNDING: f64 = 1e3;

/// Projection as an option.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Largest residual that is left: of lengths relative to the size of the mechanism, of angles in
    /// rad, of their rates relative to the largest rate.
    pub tolerance: f64,
}

impl Default for Projection {
    /// 1e-12.
    fn default() -> Self {
        Self { tolerance: 1e-12 }
    }
}

/// Why a state cannot be had.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// Φ_q lost rank.
    Singular(Singular),
    /// Φ_q lost rank where the mechanism all but rests under load.
    AtRest(Singular),
    /// A row of Φ stays open.
    Open {
        /// The row that is worst.
        row: usize,
        /// What is left of it, m or rad, or that per s.
        gap: f64,
    },
}

/// Scratch of projections of one model.
#[derive(Clone, Debug)]
pub struct Projector<'a> {
    model: &'a Model,
    tolerance: f64,
    size: f64,
    scales: Vec<f64>,
    /// Right side, then (Δ, μ).
    correction: Vec<f64>,
    /// Factorisations that chord iterations did not spare.
    pub factorisations: usize,
}

/// What is to be met.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Level {
    Position,
    Velocity,
}

impl<'a> Projector<'a> {
    /// For a model.
    pub fn new(model: &'a Model, options: Projection) -> Self {
        let unknowns = model.layout.n_q + model.layout.n_rows;
        Self {
            model,
            tolerance: options.tolerance,
            size: size(model),
            scales: row_scales(model),
            correction: vec![0.0; unknowns],
            factorisations: 0,
        }
    }

    /// Projects (q, v) in place; whether they changed. With `factored`, the matrix of the workspace
    /// holds the factor of a state nearby.
    ///
    /// # Errors
    /// [`Fault`]; q and v are then of no use.
    pub fn project(
        &mut self,
        workspace: &mut Workspace,
        t: f64,
        (q, v): (&mut [f64], &mut [f64]),
        mut factored: bool,
    ) -> Result<bool, Fault> {
        let mut changed = false;
        for level in [Level::Position, Level::Velocity] {
            changed |= self.meet(level, workspace, t, (&mut *q, &mut *v), &mut factored)?;
        }
        Ok(changed)
    }

    fn meet(
        &mut self,
        level: Level,
        workspace: &mut Workspace,
        t: f64,
        (q, v): (&mut [f64], &mut [f64]),
        factored: &mut bool,
    ) -> Result<bool, Fault> {
        let (mut last, mut target, mut newton) = (f64::INFINITY, 0.0, false);
        let mut worst = (0, 0.0);
        for iteration in 0..MOST {
            let gap = self.gap(level, workspace, t, (&*q, &*v), &mut worst);
            if iteration == 0 {
                target = match level {
                    Level::Position => self.tolerance.max(8.0 * f64::EPSILON * self.largest(q)),
                    Level::Velocity => self.tolerance * self.largest(v).max(gap),
                };
            }
            if gap <= target {
                return Ok(iteration > 0);
            }
            let slow = gap > SLOW * last;
            let bounded = newton && workspace.matrix.ridged() && gap > 0.5 * last;
            if bounded
                && gap
                    <= level.near() * if level == Level::Velocity { self.largest(v) } else { 1.0 }
            {
                return Ok(true);
            }
            if slow && newton && gap <= ROUNDING * target {
                return Ok(true);
            }
            newton = slow || !*factored;
            if newton {
                self.factor(workspace, t)?;
                *factored = true;
            }
            self.correct(
                level,
                workspace,
                if level == Level::Position { &mut *q } else { &mut *v },
            );
            last = gap;
        }
        Err(Fault::Open { row: worst.0, gap: worst.1 })
    }

    /// The largest scaled residual; its row and what it is unscaled go into `worst`.
    fn gap(
        &self,
        level: Level,
        workspace: &mut Workspace,
        t: f64,
        (q, v): (&[f64], &[f64]),
        worst: &mut (usize, f64),
    ) -> f64 {
        let Workspace { motions, residual, rate, gamma, .. } = workspace;
        kinematics::motions(q, v, motions);
        constraints::velocity_terms(self.model, motions, t, residual, rate, gamma);
        let mut gap = 0.0;
        for (row, (r, scale)) in level.of(workspace).iter().zip(&self.scales).enumerate() {
            let scaled = r.abs() / scale;
            // NaN, once there, stays
            if scaled > gap || scaled.is_nan() {
                (gap, *worst) = (scaled, (row, *r));
            }
        }
        gap
    }

    /// Factorises at the state that `gap` saw last.
    fn factor(&mut self, workspace: &mut Workspace, t: f64) -> Result<(), Fault> {
        let Workspace { motions, matrix, .. } = workspace;
        constraints::jacobian(self.model, motions, t, matrix.jacobian_mut());
        matrix.set_mass(self.model, motions);
        self.factorisations += 1;
        matrix.factor().map_err(|dependent| Fault::Singular(Singular(dependent)))
    }

    /// One step with the factor at hand.
    fn correct(&mut self, level: Level, workspace: &Workspace, x: &mut [f64]) {
        let (upper, lower) = self.correction.split_at_mut(x.len());
        upper.fill(0.0);
        lower.iter_mut().zip(level.of(workspace)).for_each(|(right, r)| *right = -r);
        workspace.matrix.solve(&mut self.correction);
        x.iter_mut().zip(&self.correction).for_each(|(x, dx)| *x += dx);
    }

    /// Leaves of a displacement what the constraints admit, by the factor at hand.
    pub fn tangent(&mut self, workspace: &Workspace, x: &mut [f64]) {
        let (upper, lower) = self.correction.split_at_mut(x.len());
        upper.fill(0.0);
        for (k, slots) in self.model.layout.constraints.iter().enumerate() {
            let rows = &mut lower[slots.rows.clone()];
            constraints::times(self.model, k, workspace.matrix.jacobian(), x, rows);
            rows.iter_mut().for_each(|r| *r = -*r);
        }
        workspace.matrix.solve(&mut self.correction);
        x.iter_mut().zip(&self.correction).for_each(|(x, dx)| *x += dx);
    }

    /// Largest coordinate or rate, lengths over the size of the mechanism.
    fn largest(&self, x: &[f64]) -> f64 {
        let scaled = |(k, x): (usize, &f64)| if k % 3 == 2 { x.abs() } else { x.abs() / self.size };
        x.iter().enumerate().map(scaled).fold(0.0, f64::max)
    }
}

impl Level {
    /// Residual, relative as the tolerance is, that may stay near a singular position, where a deviation
    /// e leaves residuals of order e² in positions and e in velocities.
    fn near(self) -> f64 {
        match self {
            Self::Position => 1e-9,
            Self::Velocity => 1e-6,
        }
    }

    fn of(self, workspace: &Workspace) -> &[f64] {
        match self {
            Self::Position => &workspace.residual,
            Self::Velocity => &workspace.rate,
        }
    }
}
