//! The equations of motion together with their derivatives, for implicit methods.
//!
//! An implicit method has the parts q, v, z and works one after the other. Each part has a column for the motion and one
//! for each variable, which contains the derivatives times the magnitude of the variable. The matrix of the motion serves
//! all columns. In each step, Newton's iteration first solves the motion, then the derivatives, whose equations are linear
//! and depend on the motion.

use super::ode::SlopeOde;
use crate::analyses::dynamics::NewtonMatrix;
use crate::equations::balance::Balance;
use crate::equations::forces::{self, Acting};
use crate::equations::sensitivity::Slope;
use crate::equations::Gains;
use crate::integrate::{
    ConstraintLevel, Dae, DaeLengths, DaeRates, DaeResidual, DaeState, Iterate, NewtonCoefficients,
    Ode,
};
use crate::math::{Complex, Listed, Real, ShortArray};
use crate::model::usual_energy;
use crate::solve::Breakdown;

/// Part of the energy of a usual motion below which errors of works do not shorten steps.
const LEAST: f64 = 1e-3;

impl SlopeOde {
    /// The lengths of q, z and λ of a column.
    fn unknowns(&self) -> [usize; 3] {
        let layout = &self.model.layout;
        [layout.n_q, layout.n_z, layout.n_rows]
    }

    /// The equations of the motion and the matrices.
    fn motion(&mut self) -> &mut (Balance, NewtonMatrix) {
        let (model, omitted) = (&self.model, self.workspace.matrix.omitted());
        let make = || Box::new((Balance::new(model), NewtonMatrix::new(model, omitted)));
        self.motion.get_or_insert_with(make)
    }

    /// Computes the residuals of the motion; those of its derivatives are zero.
    fn residual_alone(&mut self, t: f64, at: Iterate<'_>, out: DaeResidual<'_>) {
        self.motion();
        let Self { model, workspace, motion: Some(motion), columns, .. } = self else { return };
        let [q, v, a] = columns.first([at.q, at.v, at.a]);
        let [lam, z, dz] = columns.first([at.lam, at.z, at.dz]);
        let (balance, _) = &mut **motion;
        balance.motions.pieces.clone_from(&workspace.motions.pieces);
        balance.evaluate(model, t, [q, v, a, z], lam);
        let states = dz.iter().zip(&balance.state_rates).map(|(dz, rate)| dz - rate).list();
        for (out, found) in
            [(out.forces, &balance.forces), (out.states, &states), (out.rows, &balance.rate)]
        {
            out.fill(0.0);
            out[..found.len()].copy_from_slice(found);
        }
    }
}

impl Dae for SlopeOde {
    type Stop = Breakdown;

    fn lengths(&self) -> DaeLengths {
        let (layout, count) = (&self.model.layout, self.columns.count());
        DaeLengths {
            coordinates: count * layout.n_q,
            multipliers: count * layout.n_rows,
            states: count * layout.n_z,
            quadratures: count * layout.n_works,
            columns: count,
        }
    }

    fn accelerate(
        &mut self,
        t: f64,
        [q, v, z]: [&[f64]; 3],
        out: DaeRates<'_>,
    ) -> Result<(), Breakdown> {
        let mut parts = [q, v, z].concat();
        let is_finite = parts.iter().all(|x| x.is_finite());
        parts.resize(Ode::len(self), 0.0);
        let mut rates = vec![0.0; parts.len()];
        if let Err(breakdown) = self.rate(t, &self.columns.in_states(&parts), &mut rates) {
            out.a.fill(f64::NAN);
            return if is_finite { Err(breakdown) } else { Ok(()) };
        }
        let rates = self.columns.in_parts(&rates);
        let (a, rest) = rates[q.len()..].split_at(v.len());
        let (dz, powers) = rest.split_at(z.len());
        out.a.copy_from_slice(a);
        out.dz.copy_from_slice(dz);
        out.powers.copy_from_slice(powers);
        for (b, block) in self.blocks.iter().enumerate() {
            self.columns.write(b, &block.lam, out.lam);
        }
        Ok(())
    }

    fn parts(&self) -> usize {
        2
    }

    fn begin_part(&mut self, part: usize) {
        self.alone = part == 0;
    }

    /// The constraint equations are those of the velocities.
    fn residual(&mut self, t: f64, at: Iterate<'_>, _: ConstraintLevel, out: DaeResidual<'_>) {
        if self.alone {
            return self.residual_alone(t, at, out);
        }
        let Self { columns, blocks, workspace, late, .. } = self;
        for (b, block) in blocks.iter_mut().enumerate() {
            let t = Self::time(t, late, b);
            let [q, v, z, a, lam] = [at.q, at.v, at.z, at.a, at.lam].each(|x| columns.read(b, x));
            block.motions.pieces.clone_from(&workspace.motions.pieces);
            let [forces, rows] = block.balance(t, [&q, &v, &z], [&a, &lam]);
            columns.write(b, forces, out.forces);
            columns.write(b, rows, out.rows);
            let mut dz = columns.read(b, at.dz);
            if !dz.is_empty() {
                let mut rates = vec![Slope::constant(0.0); dz.len()];
                let acting = Acting { z: &z, lam: None, t };
                forces::state_rates(&block.model, &block.motions, acting, &mut rates);
                dz.iter_mut().zip(&rates).for_each(|(dz, rate)| *dz -= *rate);
                columns.write(b, &dz, out.states);
            }
            let powers = block.powers;
            let powers = [powers.dissipated, powers.drivers, powers.applied];
            columns.write(b, &powers, out.powers);
        }
        for part in [out.forces, out.states, out.rows] {
            let n = part.len() / columns.count();
            part[..n].fill(0.0);
        }
    }

    fn linearize(&mut self, t: f64, at: Iterate<'_>) {
        self.motion();
        let Self { model, workspace, motion: Some(motion), columns, .. } = self else { return };
        let [q, v, a] = columns.first([at.q, at.v, at.a]);
        let [lam, z, _] = columns.first([at.lam, at.z, &[]]);
        workspace.motions.place(&model.layout, q, v);
        motion.1.linearize(model, &workspace.motions, t, [a, lam, z]);
    }

    /// The largest of the works, of their derivatives, and of a small part of the energy of a usual motion.
    fn quadrature_scale(&self, works: &[f64]) -> Option<f64> {
        let least = LEAST * usual_energy(&self.model);
        Some(works.iter().fold(least, |most, work| most.max(work.abs())))
    }

    fn factor(&mut self, coefficients: NewtonCoefficients) -> bool {
        self.motion().1.factor(coefficients)
    }

    fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool {
        self.motion().1.factor_complex(coefficients)
    }

    fn solve(&mut self, x: &mut [f64]) {
        let lengths = self.unknowns();
        let Self { motion: Some(motion), columns, .. } = self else { return };
        columns.each_column(lengths, x, |x| {
            if x.iter().any(|x| *x != 0.0) {
                motion.1.solve(x);
            }
        });
    }

    fn solve_complex(&mut self, x: &mut [Complex]) {
        let lengths = self.unknowns();
        let Self { motion: Some(motion), columns, .. } = self else { return };
        columns.each_column(lengths, x, |x| {
            if x.iter().any(|x| x.re != 0.0 || x.im != 0.0) {
                motion.1.solve_complex(x);
            }
        });
    }

    fn times(&self, x: &[f64], y: &[f64], s: &[f64], out: &mut [f64]) {
        let Some(motion) = &self.motion else { return };
        let count = self.columns.count();
        let mut j = 0;
        self.columns.each_column(self.unknowns(), out, |out| {
            let of = [x, y, s].each(|x| {
                let n = x.len() / count;
                &x[j * n..][..n]
            });
            motion.1.times(&self.model, of, out);
            j += 1;
        });
    }

    fn normal(&mut self, _: &mut [f64]) {
        unreachable!("generalized-alpha does not integrate derivatives")
    }

    /// The derivatives are projected where the run has its states.
    fn project(&mut self, _: f64, _: DaeState<'_>, _: bool) -> Result<bool, Breakdown> {
        Ok(false)
    }

    fn singular(&mut self, t: f64, state: [&[f64]; 3]) -> Option<Breakdown> {
        let state = self.columns.first(state);
        self.workspace.accelerate(&self.model, t, state, Gains::default()).err()
    }
}
