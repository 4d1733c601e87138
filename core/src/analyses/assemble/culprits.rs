//! The smallest group of constraints that cannot close.

use crate::analyses::closing::{Closing, Halt};
use crate::analyses::mobility::moved;
use crate::math::Listed;
use crate::model::Model;

/// Distance of a further start, in sizes of the mechanism or in rad.
const BESIDE: f64 = 0.5;
/// Largest number of equations of a model in which groups and contradictions are searched.
pub(super) const MOST_ROWS: usize = 300;

/// A group that cannot close.
pub(super) struct OpenGroup {
    /// The constraints, ascending. Without any one of them, the others close.
    pub constraints: Vec<usize>,
    /// The position with the smallest gap that was found, shape (n_q).
    pub q: Vec<f64>,
}

impl OpenGroup {
    /// A smallest group of the constraints `of` that closes from none of the positions `starts`, and not from a position
    /// beside the last of them. None if they close, or if the model is too large. Constraints are left out as long as
    /// the rest stays open: first halves, then ever smaller parts, and drivers before joints.
    pub fn among(
        model: &Model,
        t: f64,
        starts: &[Vec<f64>],
        of: &[usize],
        stop: Halt<'_>,
    ) -> Option<Self> {
        let last = starts.last().filter(|q| q.len() == model.layout.n_q)?;
        if model.layout.n_rows > MOST_ROWS {
            return None;
        }
        let beside = moved(model, last, BESIDE, 0);
        let starts = starts.iter().chain([&beside]).list();
        let open = |kept: Vec<usize>| {
            let left_out = (0..model.constraints.len()).filter(|k| !kept.contains(k));
            let rows = left_out.flat_map(|k| model.layout.constraints[k].rows.clone()).list();
            let mut closing = Closing::new(model, t, stop).without(&rows);
            let reached = starts.iter().map(|start| {
                let mut q = start.to_vec();
                let (history, closed) = closing.close(&mut q);
                let gap = history.last().map_or(f64::INFINITY, |last| last.residual_norm);
                (!closed && !stop()).then_some((gap, q))
            });
            let all: Option<Vec<(f64, Vec<f64>)>> = reached.collect();
            let (_, q) = all?.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
            Some(Self { constraints: kept, q })
        };
        let mut found = open(of.to_vec())?;
        let mut part = of.len();
        while part > 1 {
            part = part.div_ceil(2);
            let (driven, joints): (Vec<usize>, Vec<usize>) =
                found.constraints.iter().rev().partition(|k| model.constraints[**k].driven);
            for left_out in [driven, joints].concat().chunks(part) {
                let kept = found.constraints.iter().copied().filter(|k| !left_out.contains(k));
                let kept = kept.list();
                found = if kept.is_empty() { found } else { open(kept).unwrap_or(found) };
            }
        }
        Some(found)
    }
}
