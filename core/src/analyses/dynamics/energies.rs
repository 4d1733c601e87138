//! Energies at the states of a run, worked out when they are asked for; several at once over lanes.

use super::accelerations::{States, MANY};
use super::failure::Reason;
use super::model_cache::ModelCache;
use super::report_projection::Halt;
use super::run::Run;
use crate::equations::{energy, kinematics};
use crate::integrate::all_finite;
use crate::math::{Lanes, Motion, Real};
use crate::model::{Model, WORKS};

/// Number of columns of [`Run::energies`].
pub const ENERGIES: usize = 2 + WORKS;

/// See [`Prepared::energies`](super::Prepared::energies).
pub(super) fn energies(
    (model, cache): (&Model, &ModelCache),
    states: States<'_>,
    works: &[f64],
) -> Result<Vec<f64>, Reason> {
    let States { t, q, v, .. } = states;
    let n = model.layout.n_q;
    let lengths = [n, n, WORKS].map(|width| width * t.len());
    assert_eq!([q.len(), v.len(), works.len()], lengths, "a row for each time");
    let mut found = Vec::with_capacity(ENERGIES * t.len());
    let rows = mechanical((model, cache), states).into_iter().zip(works.chunks_exact(WORKS));
    for (k, (energies, works)) in rows.enumerate() {
        if !all_finite(&energies) {
            return Err(Reason::halt(model, t[k], &q[k * n..(k + 1) * n], Halt::NotFinite));
        }
        found.extend(energies);
        found.extend_from_slice(works);
    }
    Ok(found)
}

/// Kinetic and potential energy at each state.
fn mechanical(
    (model, cache): (&Model, &ModelCache),
    States { t, q, v, .. }: States<'_>,
) -> Vec<[f64; 2]> {
    let (n, mut found) = (model.layout.n_q, Vec::with_capacity(t.len()));
    let mut done = 0;
    if t.len() >= MANY {
        let (mut motions, none) = (Vec::new(), vec![Lanes::zero(); n]);
        let (mut places, mut rates) = (none.clone(), none);
        for t in t.chunks_exact(Lanes::WIDTH) {
            let rows = done * n..(done + Lanes::WIDTH) * n;
            Lanes::from_rows(&q[rows.clone()], &mut places);
            Lanes::from_rows(&v[rows], &mut rates);
            let t = Lanes::new([t[0], t[1], t[2], t[3]]);
            let [kinetic, potential] = at(cache.wide(model), t, (&places, &rates), &mut motions);
            let both = kinetic.to_array().into_iter().zip(potential.to_array());
            found.extend(both.map(|(kinetic, potential)| [kinetic, potential]));
            done += Lanes::WIDTH;
        }
    }
    let mut motions = Vec::new();
    for (k, &t) in t.iter().enumerate().skip(done) {
        let row = k * n..(k + 1) * n;
        found.push(at(model, t, (&q[row.clone()], &v[row]), &mut motions));
    }
    found
}

fn at<S: Real>(
    model: &Model<S>,
    t: S,
    (q, v): (&[S], &[S]),
    motions: &mut Vec<Motion<S>>,
) -> [S; 2] {
    kinematics::motions(q, v, motions);
    [energy::kinetic(model, motions), energy::potential(model, motions, t)]
}

impl Run {
    /// Kinetic, potential, dissipated energy, work of drivers, work of applied forces at the reported states, J:
    /// rows of [`ENERGIES`].
    ///
    /// # Errors
    /// As [`Prepared::energies`](super::Prepared::energies).
    pub fn energies(&self, model: &Model) -> Result<Vec<f64>, Reason> {
        energies((model, &ModelCache::default()), self.trajectory.states(), &self.trajectory.works)
    }
}
