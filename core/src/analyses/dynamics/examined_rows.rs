//! Reported states at which a run is examined.

use super::trajectory::States;
use crate::model::{Model, WORKS};

/// Largest number of examined states of a phase.
const EXAMINED: usize = 64;

/// Some rows of a table of states.
#[derive(Default)]
pub(super) struct ExaminedRows {
    t: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    z: Vec<f64>,
    /// Works, row by row.
    pub works: Vec<f64>,
}

impl ExaminedRows {
    /// At most [`EXAMINED`] rows at equal intervals, and the last one.
    pub fn some(model: &Model, states: States<'_>, works: &[f64]) -> Self {
        let (mut rows, count) = (Self::default(), states.t.len());
        let every = count.div_ceil(EXAMINED).max(1);
        for (k, (t, [q, v, z])) in each(model, states).enumerate() {
            if k % every == 0 || k + 1 == count {
                rows.t.push(t);
                rows.q.extend_from_slice(q);
                rows.v.extend_from_slice(v);
                rows.z.extend_from_slice(z);
                rows.works.extend_from_slice(&works[WORKS * k..WORKS * (k + 1)]);
            }
        }
        rows
    }

    /// The rows.
    pub fn states(&self) -> States<'_> {
        States { t: &self.t, q: &self.q, v: &self.v, z: &self.z }
    }
}

/// The times and states of a table.
pub(super) fn each<'a>(
    model: &Model,
    States { t, q, v, z }: States<'a>,
) -> impl Iterator<Item = (f64, [&'a [f64]; 3])> {
    let (n, n_z) = (model.layout.n_q, model.layout.n_z);
    t.iter().enumerate().map(move |(k, t)| {
        let row = k * n..(k + 1) * n;
        (*t, [&q[row.clone()], &v[row], &z[k * n_z..(k + 1) * n_z]])
    })
}
