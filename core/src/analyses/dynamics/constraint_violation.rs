//! Joints that open too far. Baumgarte's stabilization bounds the opening only by its gains and the tolerance.
//!
//! Projection closes the joints or fails. With Baumgarte's stabilization they open a little. If they open by more
//! than [`APART`] times the mechanism's size, the result is not a motion of the mechanism. Without stabilization,
//! drift is expected, but no joint may open farther than the size of the mechanism.

use super::options::Options;
use super::stabilizations::Stabilization;
use crate::equations::kinematics::Motions;
use crate::equations::{constraints, Gains};
use crate::math::{Listed, Real};
use crate::model::{row_scales, size, Model};
use crate::solve::Breakdown;

/// Largest opening of a joint: lengths relative to the size of the mechanism, angles in rad. The classical gains at
/// their smallest, α = 1, β = 20 at rtol 1e-3, open the flagship by 6e-4.
pub(super) const APART: f64 = 1e-2;
/// Largest opening of a joint without stabilization.
pub(super) const ADRIFT: f64 = 1.0;
/// Distance, in sizes of the mechanism or in rad, beyond which a trial state cannot belong to the motion.
const FAR: f64 = 1e6;

/// Checks states for joints that opened too far.
pub(super) struct ViolationCheck<S = f64> {
    /// Largest residual of each row.
    most: Vec<f64>,
    residual: Vec<S>,
}

impl<S: Real> ViolationCheck<S> {
    /// The check for runs without projection.
    pub fn new(model: &Model<S>, options: &Options) -> Option<Self> {
        let most = match options.stabilization {
            Stabilization::Projection(_) => return None,
            Stabilization::None => ADRIFT,
            Stabilization::Baumgarte(gains) if gains == Gains::default() => ADRIFT,
            Stabilization::Baumgarte(_) | Stabilization::BaumgarteFromStep => APART,
        };
        Some(Self {
            most: row_scales(model).iter().map(|scale| most * scale).list(),
            residual: vec![S::zero(); model.layout.n_rows],
        })
    }

    /// Returns [`Breakdown::Apart`] for the row with the largest residual if this residual is too large; over lanes,
    /// if it is too large in any lane.
    pub fn largest(&mut self, model: &Model<S>, t: S, motions: &Motions<S>) -> Option<Breakdown> {
        constraints::residual(model, motions, t, &mut self.residual);
        let gaps = || self.residual.iter().map(|gap| gap.largest_magnitude());
        if gaps().zip(&self.most).all(|(gap, most)| gap <= *most) {
            return None;
        }
        let over = gaps().zip(&self.most).map(|(gap, most)| gap / most);
        let (row, widest) = over.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let gap = self.residual[row].largest_magnitude();
        (widest > 1.0).then(|| Breakdown::Apart { row, gap, most: self.most[row] })
    }
}

/// Whether a trial state is far from the motion: so far away that rounding errors make constraints dependent, or with a
/// joint so open that dependent constraints say nothing about the motion. A shorter step stays closer to it.
#[cold]
pub(super) fn is_astray(model: &Model, motions: &Motions, t: f64, q: &[f64]) -> bool {
    let (most, scales) = (FAR * size(model), row_scales(model));
    let mut residual = vec![0.0; model.layout.n_rows];
    constraints::residual(model, motions, t, &mut residual);
    q.iter().any(|q| q.abs() > most)
        || residual.iter().zip(scales).any(|(gap, scale)| gap.abs() > APART * scale)
}
