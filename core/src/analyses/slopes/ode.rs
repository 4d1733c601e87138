//! The equations of motion together with their derivatives, as one system of differential equations.

use super::columns::{gather, SlopeColumns};
use crate::analyses::dynamics::{rates, NewtonMatrix};
use crate::elements::{Behaviour, Mode};
use crate::equations::balance::Balance;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::equations::{forces, Gains, Workspace};
use crate::integrate::Ode;
use crate::math::{Listed, Real, ShortArray};
use crate::model::{ForceItem, Model};
use crate::solve::Breakdown;
use std::sync::Arc;

/// Factor by which derivatives at a fixed time may exceed those at a time that moves with the last change, or numbers as
/// large as the state, when they take their place: a digit is lost.
const CALM: f64 = 10.0;

/// y = (state, derivatives of the state by the first variable, by the second variable, and so on). A state is
/// (q, v, z, works).
pub(super) struct SlopeOde {
    pub model: Arc<Model>,
    pub workspace: Workspace,
    /// The equations with derivatives, for [`ABREAST`] variables each.
    pub blocks: Vec<Sensitivity>,
    /// The derivatives of the equations with which friction sticks: it holds where it was when it came to rest, which
    /// depends on the variables. One row for each block; empty if no friction sticks.
    anchors: Vec<Vec<Slope>>,
    n_y: usize,
    /// The layout of an implicit method, its equations of the motion and its matrices.
    pub columns: SlopeColumns,
    pub motion: Option<Box<(Balance, NewtonMatrix)>>,
    /// Whether the motion is solved, not its derivatives.
    pub alone: bool,
    /// The derivatives of the time. After a change of the motion it is that of the change plus a given duration: at a
    /// fixed time, derivatives would contain the rates of motions that begin there and decay fast.
    pub late: Vec<f64>,
    /// The variables whose change would end a rest at the start of a phase, as a start rate of a brake at rest does.
    pub caught: Vec<bool>,
    /// The state with derivatives by the variables of one block.
    state: Vec<Slope>,
}

/// The part of the largest derivative of rates, or of their scale, by which one of them changes where a rest begins.
const CAUGHT: f64 = 1e-9;

impl SlopeOde {
    /// The equations of a model by variables of these magnitudes.
    pub fn new(model: Arc<Model>, blocks: Vec<Sensitivity>, sizes: Vec<f64>) -> Self {
        let (n_y, workspace) = (model.layout.n_y(), Workspace::new(&model));
        let (state, anchors) = (vec![Slope::constant(0.0); n_y], Vec::new());
        let layout = &model.layout;
        let columns =
            SlopeColumns::new(sizes, [layout.n_q, layout.n_q, layout.n_z, layout.n_works]);
        let (motion, alone, late) = (None, false, vec![0.0; columns.count() - 1]);
        let caught = Vec::new();
        Self { model, workspace, blocks, anchors, n_y, columns, motion, alone, late, caught, state }
    }

    /// A time whose derivatives by the variables of block `b` are in `late`.
    pub fn time(t: f64, late: &[f64], b: usize) -> Slope {
        let mut at = Slope::constant(t);
        at.slope.copy_from_slice(&late[ABREAST * b..][..ABREAST]);
        at
    }

    /// Begins a phase at a state: friction that sticks holds where it is, and the derivatives meet the constraints.
    pub fn begin(&mut self, t: f64, y: &mut [f64], scales: &[f64]) -> Result<(), Breakdown> {
        let (n, before) = (self.model.layout.n_q, y.to_vec());
        self.anchor(t, y);
        self.project(t, y)?;
        let is_caught = |k: usize| {
            let [a, b, scales] = [&before[..], &*y, scales].each(|y| &y[self.n_y * k + n..][..n]);
            let most = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let jumps = |k: usize| (a[k] - b[k]).abs() > CAUGHT * most.max(scales[k]);
            (0..n).any(jumps)
        };
        self.caught = (1..=ABREAST * self.blocks.len()).map(is_caught).list();
        Ok(())
    }

    /// Friction that sticks holds where it is in a state.
    fn anchor(&mut self, t: f64, y: &[f64]) {
        let sticks = |item: &&ForceItem<f64>| {
            matches!(item.element.behaviour(), Some(Behaviour::Sticks))
                && matches!(item.mode, Mode::Holds(_))
        };
        let rows: Vec<usize> =
            self.model.forces.iter().filter(sticks).filter_map(|item| item.held_row).list();
        if rows.is_empty() {
            return;
        }
        let n = self.model.layout.n_q;
        for b in 0..self.blocks.len() {
            let state = self.state(b, y);
            let open = self.blocks[b].open(Self::time(t, &self.late, b), &state[..n]);
            let mut anchors = vec![Slope::constant(0.0); open.len()];
            rows.iter().for_each(|row| anchors[*row] = open[*row]);
            self.anchors.push(anchors);
        }
    }

    /// The rates of a state, without those of its derivatives.
    pub fn rates(&mut self, t: f64, y: &[f64]) -> Result<Vec<f64>, Breakdown> {
        let mut dy = vec![0.0; self.n_y];
        self.rate_of_motion(t, &y[..self.n_y], &mut dy)?;
        Ok(dy)
    }

    fn rate_of_motion(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Breakdown> {
        let Self { model, workspace, .. } = self;
        let [q, v, z, _] = model.layout.split(y);
        workspace.react(model, t, [q, v, z])?;
        rates(model, workspace, t, v, dy);
        Ok(())
    }

    /// Adds rates times the derivatives of a time, times `sign`, to the derivatives of a state.
    pub fn shift(&self, (rates, late): (&[f64], &[f64]), sign: f64, y: &mut [f64]) {
        for (j, late) in late.iter().enumerate().filter(|(_, late)| **late != 0.0) {
            for (k, rate) in rates.iter().enumerate() {
                y[self.n_y * (1 + j) + k] += sign * rate * late;
            }
        }
    }

    /// A state with its derivatives at a fixed time.
    pub fn at_fixed_time(&mut self, t: f64, mut y: Vec<f64>) -> Result<Vec<f64>, Breakdown> {
        if self.late.iter().any(|late| *late != 0.0) {
            let rates = self.rates(t, &y)?;
            self.shift((&rates, &self.late), -1.0, &mut y);
        }
        Ok(y)
    }

    /// Goes back to derivatives at a fixed time for variables where what a change of the motion has begun has decayed.
    /// `sizes` are the magnitudes of the variables, `scales` those of y.
    pub fn calm_down(
        &mut self,
        (t, sizes): (f64, &[f64]),
        scales: &[f64],
        y: &mut [f64],
    ) -> Result<(), Breakdown> {
        if self.late.iter().all(|late| *late == 0.0) {
            return Ok(());
        }
        let fixed = self.at_fixed_time(t, y.to_vec())?;
        for (j, size) in sizes.iter().enumerate() {
            let own = self.n_y * (1 + j)..self.n_y * (2 + j);
            let is_calm = own.clone().zip(&y[..self.n_y]).all(|(k, x)| {
                let usual = y[k].abs().max(x.abs() / size).max(scales[k]);
                fixed[k].abs() <= CALM * usual
            });
            if is_calm {
                self.late[j] = 0.0;
                y[own.clone()].copy_from_slice(&fixed[own]);
            }
        }
        Ok(())
    }

    /// The state with derivatives by the variables of block `b`.
    pub fn state(&self, b: usize, y: &[f64]) -> Vec<Slope> {
        let mut state = vec![Slope::constant(0.0); self.n_y];
        gather(self.n_y, b, y, &mut state);
        state
    }

    /// Writes the derivatives of a state into y.
    pub fn put(&self, b: usize, state: &[Slope], y: &mut [f64]) {
        for (k, x) in state.iter().enumerate() {
            for (place, slope) in x.slope.iter().enumerate() {
                y[self.n_y * (1 + ABREAST * b + place) + k] = *slope;
            }
        }
    }

    /// Makes the derivatives meet the derivatives of the constraints.
    pub fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), Breakdown> {
        let [q, v, z, _] = self.model.layout.split(&y[..self.n_y]);
        self.workspace.accelerate(&self.model, t, [q, v, z], Gains::default())?;
        let n = self.model.layout.n_q;
        for b in 0..self.blocks.len() {
            let (mut state, at) = (self.state(b, y), Self::time(t, &self.late, b));
            let mut open = self.blocks[b].open(at, &state[..n]);
            if let Some(anchors) = self.anchors.get(b) {
                open.iter_mut().zip(anchors).for_each(|(open, anchor)| *open -= *anchor);
            }
            self.close(&open, &mut state[..n])?;
            let (q, rest) = state.split_at_mut(n);
            let opening = self.blocks[b].opening(at, q, &rest[..n]);
            self.close(&opening, &mut rest[..n])?;
            self.put(b, &state, y);
        }
        Ok(())
    }

    /// Changes derivatives by the least amount, in the metric of the mass, that closes derivatives of equations.
    fn close(&mut self, open: &[Slope], x: &mut [Slope]) -> Result<(), Breakdown> {
        for place in 0..ABREAST {
            let mut change = vec![0.0; x.len()];
            change.extend(open.iter().map(|open| -open.slope[place]));
            self.workspace.solve(&self.model, &mut change)?;
            x.iter_mut().zip(&change).for_each(|(x, dx)| x.slope[place] += dx);
        }
        Ok(())
    }
}

impl Ode for SlopeOde {
    type Stop = Breakdown;

    fn len(&self) -> usize {
        self.n_y * (1 + ABREAST * self.blocks.len())
    }

    fn rate(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), Breakdown> {
        let n_y = self.n_y;
        self.rate_of_motion(t, &y[..n_y], &mut dy[..n_y])?;
        let Self { model, workspace, blocks, late, state, .. } = self;
        let model: &Model = model;
        let layout = &model.layout;
        let mut rates = vec![Slope::constant(0.0); n_y];
        for (b, block) in blocks.iter_mut().enumerate() {
            gather(n_y, b, y, state);
            let ([q, v, z, _], at) = (layout.split(state), Self::time(t, late, b));
            block.respond((model, workspace), at, [q, v, z])?;
            block.add_powers_of_drivers(v);
            let [dq, dv, dz, works] = layout.split_mut(&mut rates);
            dq.copy_from_slice(v);
            dv.copy_from_slice(&block.a);
            if !dz.is_empty() {
                let acting = forces::Acting { z, lam: None, t: at };
                forces::state_rates(&block.model, &block.motions, acting, dz);
            }
            let powers = block.powers;
            works.copy_from_slice(&[powers.dissipated, powers.drivers, powers.applied]);
            for (k, rate) in rates.iter().enumerate() {
                for (place, slope) in rate.slope.iter().enumerate() {
                    dy[n_y * (1 + ABREAST * b + place) + k] = *slope;
                }
            }
        }
        Ok(())
    }
}
