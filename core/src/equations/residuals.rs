//! How far a state is from its constraints: Φ and Φ̇ of all of them and the largest of each, in one pass.

use super::pairs::Pair;
use super::{constraints, Compiled};
use crate::elements::{Rows, MOST_EQUATIONS};
use crate::math::{Largest, Motion, Real};
use crate::model::{row_scales, Model};

/// Φ and Φ̇ of one model; carries no truth from one state to the next.
#[derive(Clone, Debug)]
pub struct Residuals<S = f64> {
    /// Φ and Φ̇, each of shape (n_rows), m or rad and that per s.
    pub rows: [Vec<S>; 2],
    /// 1 / scale of each row: lengths over the size of the mechanism, 1/m.
    pub per_scale: Vec<f64>,
    compiled: Compiled<S>,
    /// The constraints that are no pairs of rows.
    others: Vec<usize>,
}

impl<S: Real> Residuals<S> {
    /// Memory for a model.
    pub fn new(model: &Model<S>) -> Self {
        let compiled = Compiled::new(model);
        let mut other = vec![true; model.constraints.len()];
        compiled.pairs.iter().for_each(|pair| other[pair.constraint as usize] = false);
        Self {
            rows: std::array::from_fn(|_| vec![S::zero(); model.layout.n_rows]),
            per_scale: row_scales(model).into_iter().map(|scale| 1.0 / scale).collect(),
            compiled,
            others: (0..other.len()).filter(|k| other[*k]).collect(),
        }
    }

    /// Fills the [`rows`](Self::rows) at a state; the largest of Φ and of Φ̇, scaled, in any lane, NaN if one is that.
    #[inline(always)] // once in a look: a call saves and restores more than it shares
    pub fn look(&mut self, model: &Model<S>, motions: &[Motion<S>], t: S) -> [f64; 2] {
        let mut largest = self.look_at_pairs(motions, t);
        for k in 0..self.others.len() {
            self.look_at_other(model, self.others[k], motions, t, &mut largest);
        }
        largest.map(|largest| largest.get())
    }

    /// Joints of two rows by their own list.
    #[inline(always)]
    fn look_at_pairs(&mut self, motions: &[Motion<S>], t: S) -> [Largest<S>; 2] {
        let mut largest = [Largest::new(), Largest::new()];
        for Pair { element, row, .. } in &self.compiled.pairs {
            let [i, j] = element.ends().map(|body| &motions[body.0]);
            let rows = *row as usize..*row as usize + 2;
            let [residual, rate] = self.rows.each_mut().map(|all| &mut all[rows.clone()]);
            element.velocity_terms(i, j, t, Rows { residual, rate, gamma: &mut [S::zero(); 2] });
            let scales = &self.per_scale[rows.clone()];
            for (all, largest) in self.rows.iter().zip(&mut largest) {
                for (x, per_scale) in all[rows.clone()].iter().zip(scales) {
                    largest.add(*x * S::constant(*per_scale));
                }
            }
        }
        largest
    }

    /// Stored entries of Φ_q.
    pub fn jacobian(&self, model: &Model<S>, motions: &[Motion<S>], t: S, entries: &mut [S]) {
        constraints::jacobian(model, motions, t, entries);
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
