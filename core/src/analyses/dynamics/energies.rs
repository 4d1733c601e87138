//! Energies at the states of a run, computed on request, for several states at once over lanes.

use super::failure::Failure;
use super::model_cache::ModelCache;
use super::run_results::Run;
use super::trajectory::States;
use crate::equations::energy;
use crate::equations::kinematics::Motions;
use crate::integrate::all_finite;
use crate::math::{each, Lanes, Listed, Real, ShortArray};
use crate::model::{Model, WORKS};
use crate::solve::Breakdown;

/// Number of columns of [`Run::energies`](super::Run::energies).
pub const ENERGIES: usize = 2 + WORKS;

impl Run {
    /// Kinetic, potential, dissipated energy, work of drivers, work of applied forces at the reported states, J:
    /// rows of [`ENERGIES`].
    ///
    /// # Errors
    /// The errors of [`Prepared::energies`](super::Prepared::energies).
    pub fn energies(&self, model: &Model) -> Result<Vec<f64>, Box<Failure>> {
        energies((model, &ModelCache::default()), self.trajectory.states(), &self.trajectory.works)
    }
}

/// See [`Prepared::energies`](super::Prepared::energies).
pub(super) fn energies(
    (model, cache): (&Model, &ModelCache),
    states: States<'_>,
    works: &[f64],
) -> Result<Vec<f64>, Box<Failure>> {
    let States { t, q, v, z } = states;
    let n = model.layout.n_q;
    let lengths = each([n, n, model.layout.n_z, WORKS], |width| width * t.len());
    assert_eq!([q.len(), v.len(), z.len(), works.len()], lengths, "a row for each time");
    let mut found = Vec::with_capacity(ENERGIES * t.len());
    let rows = mechanical((model, cache), states).into_iter().zip(works.chunks_exact(WORKS));
    for (k, (energies, works)) in rows.enumerate() {
        if !all_finite(&energies) {
            let q = &q[k * n..(k + 1) * n];
            return Err(Failure::at_state(model, t[k], q, Breakdown::NotFinite));
        }
        found.extend(energies);
        found.extend_from_slice(works);
    }
    Ok(found)
}

/// Kinetic and potential energy at each state.
fn mechanical(
    (model, cache): (&Model, &ModelCache),
    States { t, q, v, z }: States<'_>,
) -> Vec<[f64; 2]> {
    let (n, n_z) = (model.layout.n_q, model.layout.n_z);
    let mut found = Vec::with_capacity(t.len());
    let mut done = 0;
    if let Some(wide) = cache.wide(model, t.len()) {
        let wide = wide.model();
        let mut motions = Motions::new(&wide.layout);
        let [mut places, mut rates, mut states] =
            [n, n, n_z].each(|width| vec![Lanes::zero(); width]);
        for t in t.chunks_exact(Lanes::WIDTH) {
            let rows = done * n..(done + Lanes::WIDTH) * n;
            Lanes::from_rows(&q[rows.clone()], &mut places);
            Lanes::from_rows(&v[rows], &mut rates);
            Lanes::from_rows(&z[done * n_z..(done + Lanes::WIDTH) * n_z], &mut states);
            let t = Lanes::new([t[0], t[1], t[2], t[3]]);
            let [kinetic, potential] = at(wide, t, [&places, &rates, &states], &mut motions);
            let both = kinetic.to_array().into_iter().zip(potential.to_array());
            both.map(|(kinetic, potential)| [kinetic, potential]).append_to(&mut found);
            done += Lanes::WIDTH;
        }
    }
    let mut motions = Motions::new(&model.layout);
    for (k, &t) in t.iter().enumerate().skip(done) {
        let row = k * n..(k + 1) * n;
        let state = [&q[row.clone()], &v[row], &z[k * n_z..(k + 1) * n_z]];
        found.push(at(model, t, state, &mut motions));
    }
    found
}

fn at<S: Real>(model: &Model<S>, t: S, [q, v, z]: [&[S]; 3], motions: &mut Motions<S>) -> [S; 2] {
    motions.place(&model.layout, q, v);
    [energy::kinetic(model, motions), energy::potential(model, motions, z, t)]
}
