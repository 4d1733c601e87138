//! The equations of motion for implicit methods: residuals, and the matrices of Newton's iteration.

use super::motion_ode::least_energy;
use super::newton_matrix::NewtonMatrix;
use super::options::Options;
use super::stabilizations::Stabilization;
use crate::equations::balance::Balance;
use crate::equations::{constraints, energy, Gains, Workspace};
use crate::integrate::{
    ConstraintLevel, Dae, DaeLengths, DaeRates, DaeResidual, DaeState, Iterate, NewtonCoefficients,
};
use crate::math::Complex;
use crate::model::Model;
use crate::solve::Breakdown;
use crate::stabilize::{Projection, Projector};

/// The mechanism and the memory of implicit methods.
pub(super) struct MotionDae<'a> {
    model: &'a Model,
    workspace: Workspace,
    projector: Projector<'a>,
    /// Whether the options require projection.
    projects: bool,
    balance: Balance,
    matrix: NewtonMatrix,
    /// Right side and solution of the augmented matrix.
    solution: Vec<f64>,
    /// Factorisations of the augmented matrix, for accelerations.
    accelerations: usize,
    /// An energy whose errors matter, J, if works are tested.
    least_energy: Option<f64>,
}

impl<'a> MotionDae<'a> {
    /// Uses the elimination plan of `one`, and omits the same rows.
    pub fn new(model: &'a Model, options: &Options, one: &Workspace) -> Self {
        let (projection, projects) = match options.stabilization {
            Stabilization::Projection(projection) => (projection, true),
            _ => (Projection::default(), false),
        };
        Self {
            model,
            workspace: Workspace::like(model, one),
            projector: Projector::new(model, projection),
            projects,
            balance: Balance::new(model),
            matrix: NewtonMatrix::new(model, one.matrix.omitted()),
            solution: vec![0.0; model.layout.n_q + model.layout.n_rows],
            accelerations: 0,
            least_energy: least_energy(model),
        }
    }

    /// Copies the held pieces of switches from `one`, and omits the same rows.
    pub fn hold(&mut self, one: &Workspace) {
        if self.workspace.matrix.omitted() != one.matrix.omitted() {
            self.workspace.omit(one.matrix.omitted());
            self.matrix.omit(one.matrix.omitted());
        }
        let pieces = &one.motions.pieces;
        for motions in [&mut self.workspace.motions, &mut self.balance.motions] {
            motions.pieces.clear();
            motions.pieces.extend_from_slice(pieces);
        }
    }

    /// Factorisations of the augmented matrix.
    pub fn factorisations(&self) -> usize {
        self.accelerations + self.projector.factorisations
    }

    /// The least ratio of a pivot to its largest summand in the augmented matrix of the last acceleration or projection.
    pub fn pivot(&self) -> Option<f64> {
        self.workspace.matrix.cancellation().map(|(_, pivot)| pivot)
    }
}

impl Dae for MotionDae<'_> {
    type Stop = Breakdown;

    fn lengths(&self) -> DaeLengths {
        let layout = &self.model.layout;
        DaeLengths {
            coordinates: layout.n_q,
            multipliers: layout.n_rows,
            states: layout.n_z,
            quadratures: layout.n_works,
            columns: 1,
        }
    }

    fn accelerate(
        &mut self,
        t: f64,
        [q, v, z]: [&[f64]; 3],
        out: DaeRates<'_>,
    ) -> Result<(), Self::Stop> {
        self.accelerations += 1;
        let outcome = self.workspace.accelerate(self.model, t, [q, v, z], Gains::default());
        if let Err(breakdown) = outcome {
            if q.iter().chain(v).chain(z).all(|x| x.is_finite()) {
                return Err(breakdown);
            }
            out.a.fill(f64::NAN);
            return Ok(());
        }
        out.a.copy_from_slice(self.workspace.a());
        out.lam.copy_from_slice(self.workspace.lam());
        self.workspace.state_rates(self.model, t, out.dz);
        let found = self.workspace.powers(self.model, v);
        out.powers.copy_from_slice(&[found.dissipated, found.drivers, found.applied]);
        Ok(())
    }

    fn residual(&mut self, t: f64, at: Iterate<'_>, level: ConstraintLevel, out: DaeResidual<'_>) {
        self.balance.evaluate(self.model, t, [at.q, at.v, at.a, at.z], at.lam);
        out.forces.copy_from_slice(&self.balance.forces);
        out.rows.copy_from_slice(match level {
            ConstraintLevel::Position => &self.balance.position,
            ConstraintLevel::Velocity => &self.balance.rate,
        });
        let rates = at.dz.iter().zip(&self.balance.state_rates);
        out.states.iter_mut().zip(rates).for_each(|(out, (dz, rate))| *out = dz - rate);
        let powers = self.balance.powers;
        out.powers.copy_from_slice(&[powers.dissipated, powers.drivers, powers.applied]);
    }

    fn linearize(&mut self, t: f64, at: Iterate<'_>) {
        let motions = &mut self.balance.motions;
        motions.place(&self.model.layout, at.q, at.v);
        self.matrix.linearize(self.model, motions, t, [at.a, at.lam, at.z]);
    }

    /// The largest of the kinetic energy and the works.
    fn quadrature_scale(&self, works: &[f64]) -> Option<f64> {
        let least = self.least_energy?.max(energy::kinetic(self.model, &self.balance.motions));
        Some(works.iter().fold(least, |most, work| most.max(work.abs())))
    }

    fn factor(&mut self, coefficients: NewtonCoefficients) -> bool {
        self.matrix.factor(coefficients)
    }

    fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool {
        self.matrix.factor_complex(coefficients)
    }

    fn solve(&mut self, x: &mut [f64]) {
        self.matrix.solve(x);
    }

    fn solve_complex(&mut self, x: &mut [Complex]) {
        self.matrix.solve_complex(x);
    }

    fn times(&self, x: &[f64], y: &[f64], s: &[f64], out: &mut [f64]) {
        self.matrix.times(self.model, [x, y, s], out);
    }

    fn normal(&mut self, x: &mut [f64]) {
        let n = self.model.layout.n_q;
        let Self { solution, workspace, .. } = self;
        solution[..n].fill(0.0);
        for (k, slots) in self.model.layout.constraints.iter().enumerate() {
            let rows = &mut solution[n..][slots.rows.clone()];
            constraints::times(self.model, k, workspace.matrix.jacobian(), x, rows);
        }
        workspace.matrix.solve(solution);
        x.copy_from_slice(&solution[..n]);
    }

    fn project(
        &mut self,
        t: f64,
        state: DaeState<'_>,
        velocities: bool,
    ) -> Result<bool, Self::Stop> {
        let DaeState { q, v, z } = state;
        if self.projects {
            return self.projector.project(&mut self.workspace, t, (q, v), false);
        }
        // `normal` needs the factors of a nearby state, which projection would provide
        self.accelerations += 1;
        self.workspace.accelerate(self.model, t, [q, v, z], Gains::default())?;
        match velocities {
            true => self.projector.project_velocities(&mut self.workspace, t, (q, v)),
            false => Ok(false),
        }
    }

    fn singular(&mut self, t: f64, state: [&[f64]; 3]) -> Option<Self::Stop> {
        self.workspace.accelerate(self.model, t, state, Gains::default()).err()
    }
}
