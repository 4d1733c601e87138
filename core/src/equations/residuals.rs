//! How far a state is from its constraints: Φ and Φ̇ of all of them and the largest of each, in one pass.

use super::{constraints, Compiled};
use crate::elements::joints::Revolute;
use crate::elements::{BodyId, Joint, Rows, MOST_EQUATIONS};
use crate::math::{Largest, Motion, Real};
use crate::model::{row_scales, size, Model};

/// Φ and Φ̇ of one model; carries no truth from one state to the next.
#[derive(Clone, Debug)]
pub struct Residuals<S = f64> {
    /// Φ and Φ̇, each of shape (n_rows), m or rad and that per s.
    pub rows: [Vec<S>; 2],
    /// 1 / scale of each row: lengths over the size of the mechanism, 1/m.
    pub per_scale: Vec<f64>,
    /// The same of pins.
    per_size: f64,
    compiled: Compiled<S>,
    /// The constraints that are no pins.
    others: Vec<usize>,
}

impl<S: Real> Residuals<S> {
    /// Memory for a model.
    pub fn new(model: &Model<S>) -> Self {
        let compiled = Compiled::new(model);
        let mut other = vec![true; model.constraints.len()];
        compiled.pins.iter().for_each(|pin| other[pin.constraint as usize] = false);
        Self {
            rows: std::array::from_fn(|_| vec![S::zero(); model.layout.n_rows]),
            per_scale: row_scales(model).into_iter().map(|scale| 1.0 / scale).collect(),
            per_size: 1.0 / size(model),
            compiled,
            others: (0..other.len()).filter(|k| other[*k]).collect(),
        }
    }

    /// Fills the [`rows`](Self::rows) at a state; the largest of Φ and of Φ̇, scaled, in any lane, NaN if one is that.
    #[inline(always)] // once in a look: a call saves and restores more than it shares
    pub fn look(&mut self, model: &Model<S>, motions: &[Motion<S>], t: S) -> [f64; 2] {
        let mut largest = self.look_at_pins(motions);
        for k in 0..self.others.len() {
            self.look_at_other(model, self.others[k], motions, t, &mut largest);
        }
        largest.map(|largest| largest.get())
    }

    /// Pins by their records. What is lengths alone is scaled once.
    #[inline(always)]
    fn look_at_pins(&mut self, motions: &[Motion<S>]) -> [Largest<S>; 2] {
        let mut largest = [Largest::new(), Largest::new()];
        for pin in &self.compiled.pins {
            let [i, j] = pin.bodies.map(|body| &motions[body as usize]);
            let terms = <Revolute as Joint<2>>::velocity_terms(&pin.joint(), i, j, S::zero());
            let both = self.rows.iter_mut().zip([terms.residual, terms.rate]);
            for ((rows, found), largest) in both.zip(&mut largest) {
                rows[pin.row as usize..][..2].copy_from_slice(&found);
                found.into_iter().for_each(|x| largest.add(x));
            }
        }
        largest.map(|largest| largest.scaled(S::constant(self.per_size)))
    }

    /// Stored entries of Φ_q, where the columns ±I of pins stand already.
    pub fn jacobian(&self, model: &Model<S>, motions: &[Motion<S>], t: S, entries: &mut [S]) {
        for pin in &self.compiled.pins {
            let [i, j] = pin.bodies.map(|body| &motions[body as usize].pose);
            let rows = <Revolute as Joint<2>>::jacobian(&pin.joint(), i, j, S::zero());
            let slots = &model.layout.constraints[pin.constraint as usize];
            let ends = pin.bodies.map(|body| BodyId(body as usize));
            constraints::update(ends, &rows, slots, entries);
        }
        for k in &self.others {
            constraints::jacobian_of(model, *k, motions, t, entries);
        }
    }

    #[inline(never)] // mechanisms of pins have none
    fn look_at_other(
        &mut self,
        model: &Model<S>,
        k: usize,
        motions: &[Motion<S>],
        t: S,
        largest: &mut [Largest<S>; 2],
    ) {
        let range = model.layout.constraints[k].rows.clone();
        let [residual, rate] = self.rows.each_mut().map(|rows| &mut rows[range.clone()]);
        let gamma = &mut [S::zero(); MOST_EQUATIONS][..range.len()];
        let out = Rows { residual, rate, gamma };
        constraints::velocity_terms_of(model, k, motions, t, out);
        for (rows, largest) in self.rows.iter().zip(largest) {
            for (x, per_scale) in rows[range.clone()].iter().zip(&self.per_scale[range.clone()]) {
                largest.add(*x * S::constant(*per_scale));
            }
        }
    }
}
