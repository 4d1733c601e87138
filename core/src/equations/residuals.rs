//! The constraint residuals of a state: Φ and Φ̇ of all constraints and the largest of each, in one pass.

use super::constraints::{self};
use super::kinematics::Motions;
use super::Compiled;
use crate::elements::{Joint, Linearized, Moving, Pooled, VisitJoints};
use crate::math::{Largest, Listed, Real, ShortArray};
use crate::model::{row_scales, Model};

/// Φ and Φ̇ of one model, at the last evaluated state.
#[derive(Clone, Debug)]
pub struct Residuals<S = f64> {
    /// Φ and Φ̇, each of shape (n_rows), in m or rad, and in m/s or rad/s.
    pub rows: [Vec<S>; 2],
    /// 1 / scale of each row. The scale of a length is the size of the mechanism, m.
    pub per_scale: Vec<f64>,
    /// The omitted row with the largest Φ, and the scaled Φ of this row; NaN is kept.
    pub omitted: (usize, f64),
}

impl<S: Real> Residuals<S> {
    /// Memory for a model.
    pub fn new(model: &Model<S>) -> Self {
        Self {
            rows: std::array::from_fn(|_| vec![S::zero(); model.layout.n_rows]),
            per_scale: row_scales(model).into_iter().map(|scale| 1.0 / scale).list(),
            omitted: (0, 0.0),
        }
    }

    /// Evaluates the [`rows`](Self::rows) at a state, and sets omitted rows to zero. Returns the largest scaled Φ and
    /// Φ̇ over all lanes, or NaN if a residual is NaN.
    pub fn look(
        &mut self,
        (model, compiled): (&Model<S>, &Compiled<S>),
        motions: &Motions<S>,
        t: S,
        omitted: &[usize],
    ) -> [f64; 2] {
        let mut look = Look { model, motions, t, rows: &mut self.rows };
        compiled.joints.visit(&mut look);
        for &k in &compiled.joints_with_laws {
            look.one(k);
        }
        self.omitted = (0, 0.0);
        for &row in omitted {
            let gap = self.rows[0][row].largest_magnitude() * self.per_scale[row];
            if gap > self.omitted.1 || gap.is_nan() {
                self.omitted = (row, gap);
            }
            self.rows.iter_mut().for_each(|rows| rows[row] = S::zero());
        }
        let mut largest = [Largest::new(), Largest::new()];
        for (rows, largest) in self.rows.iter().zip(&mut largest) {
            for (x, per_scale) in rows.iter().zip(&self.per_scale) {
                largest.add(*x * S::constant(*per_scale));
            }
        }
        largest.each(|largest| largest.get())
    }

    /// Computes the stored entries of Φ_q.
    pub fn jacobian(&self, model: &Model<S>, motions: &Motions<S>, t: S, entries: &mut [S]) {
        constraints::jacobian(model, motions, t, entries);
    }
}

/// Evaluates the rows of one joint after the other.
struct Look<'a, S> {
    model: &'a Model<S>,
    motions: &'a Motions<S>,
    t: S,
    rows: &'a mut [Vec<S>; 2],
}

impl<S: Real> VisitJoints<S> for Look<'_, S> {
    #[inline(never)] // one loop for each type
    fn visit<E: Joint>(&mut self, pool: &[Pooled<E::Over<S>>]) {
        if !E::CONSTANT_COLUMNS {
            return pool.iter().for_each(|own| self.one(own.place.item as usize));
        }
        for Pooled { element, place } in pool {
            let bodies = place.bodies.each(|body| self.motions[body as usize]);
            let at = Moving { bodies: &bodies, own: &[], own_rates: &[], t: self.t };
            let [mut residual, mut rate, mut gamma] = [[S::zero(); 2]; 3];
            let out = Linearized {
                residual: &mut residual,
                rate: &mut rate,
                gamma: &mut gamma,
                columns: &mut [[S::zero(); 3]; 4],
            };
            E::linearize(element, &at, out);
            for (rows, found) in self.rows.iter_mut().zip([residual, rate]) {
                rows[place.row as usize..][..2].copy_from_slice(&found);
            }
        }
    }
}

impl<S: Real> Look<'_, S> {
    /// Evaluates any constraint.
    fn one(&mut self, k: usize) {
        let range = self.model.layout.constraints[k].rows.clone();
        constraints::linearize_one(self.model, k, self.motions, self.t, &mut |terms, _| {
            self.rows[0][range.clone()].copy_from_slice(terms.residual);
            self.rows[1][range.clone()].copy_from_slice(terms.rate);
        });
    }
}
