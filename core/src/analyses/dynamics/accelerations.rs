//! Accelerations and multipliers at the states of a run, without stabilization (γ, not γ̂).
//!
//! A run keeps only states. Accelerations and multipliers are computed on request. The states are independent of each
//! other, so several states are solved at once, one in each lane. If one of them is not regular (near a singular
//! position, or with a number that is not finite), each state is solved separately.

use super::failure::Failure;
use super::lane_batch::are_finite;
use super::massless;
use super::model_cache::ModelCache;
use super::redundant_rows::{exchange, workspace_at};
use super::shared_reaction;
use super::trajectory::States;
use super::undecided_contacts;
use super::wide::Wide;
use crate::analyses::rigid::RigidContacts;
use crate::equations::augmented::NearSingular;
use crate::equations::Workspace;
use crate::integrate::{all_finite, Flow};
use crate::math::{each, Lanes, Real};
use crate::model::Model;
use crate::solve::Breakdown;

/// Accelerations and multipliers, one row per state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accelerations {
    /// Accelerations, rows of n_q.
    pub a: Vec<f64>,
    /// Multipliers, rows of n_rows.
    pub lam: Vec<f64>,
    /// Regularity of each position: the square root of the fraction of its magnitude that the worst pivot keeps. Near
    /// a singular position it is proportional to the distance.
    pub regularity: Vec<f64>,
}

/// See [`Prepared::accelerations`](super::Prepared::accelerations).
pub(super) fn accelerations(
    (model, cache): (&Model, &ModelCache),
    states: States<'_>,
    passing: bool,
    watch: &mut dyn FnMut(f64) -> Flow,
) -> Result<Accelerations, Box<Failure>> {
    let States { t, q, v, z } = states;
    let (n, n_z, count) = (model.layout.n_q, model.layout.n_z, t.len());
    let lengths = each([n, n, n_z], |width| width * count);
    assert_eq!([q.len(), v.len(), z.len()], lengths, "a row for each time");
    let Some(&from) = t.first() else { return Ok(Accelerations::default()) };
    let start = [&q[..n], &v[..n], &z[..n_z]];
    if !passing {
        massless::check(model, from, start[0])?;
    }
    shared_reaction::check(model, from, start[0])?;
    let mut one = workspace_at((model, cache), from, start);
    let mut independent = None;
    if !passing && !one.matrix.omitted().is_empty() {
        // damped rows have a solution at singular positions too
        let damped = Workspace::on(model, cache.plan(model, true));
        one.matrix.set_near_singular(NearSingular::Refuse);
        independent = Some(std::mem::replace(&mut one, damped));
    }
    if passing {
        one.matrix.set_near_singular(NearSingular::Regularise);
    }
    let wide = if independent.is_some() { None } else { cache.wide(model, count) };
    let mut many = wide.map(|wide| Many::new(wide, &one));
    let mut found = Accelerations::with_room(model, count);
    let contacts = RigidContacts::of(model);
    for first in (0..count).step_by(Lanes::WIDTH) {
        let end = (first + Lanes::WIDTH).min(count);
        if watch(t[first]) == Flow::Stop {
            break;
        }
        let (rows, states) = (first * n..end * n, first * n_z..end * n_z);
        let four = States { t: &t[first..end], q: &q[rows.clone()], v: &v[rows], z: &z[states] };
        if !many.as_mut().is_some_and(|many| many.solve(four, &mut found)) {
            one_by_one(model, (&mut one, independent.as_mut()), four, &mut found)?;
            if let Some(many) = &mut many {
                many.follow(&one);
            }
        }
        // a driven motion ends where it reaches one; its values there are those before
        if !passing {
            undecided_contacts::check(model, &contacts, four, &found.a[first * n..])?;
        }
    }
    Ok(found)
}

impl Accelerations {
    fn with_room(model: &Model, count: usize) -> Self {
        let room = |width: usize| Vec::with_capacity(count * width);
        Self { a: room(model.layout.n_q), lam: room(model.layout.n_rows), regularity: room(1) }
    }
}

fn one_by_one(
    model: &Model,
    (workspace, mut independent): (&mut Workspace, Option<&mut Workspace>),
    States { t, q, v, z }: States<'_>,
    found: &mut Accelerations,
) -> Result<(), Box<Failure>> {
    let (n, n_z) = (model.layout.n_q, model.layout.n_z);
    for (k, &t) in t.iter().enumerate() {
        let row = k * n..(k + 1) * n;
        let (q, v, z) = (&q[row.clone()], &v[row], &z[k * n_z..(k + 1) * n_z]);
        exchange(model, workspace, t, [q, v, z]);
        workspace
            .react(model, t, [q, v, z])
            .and_then(|()| match [workspace.a(), workspace.lam()].into_iter().all(all_finite) {
                true => Ok(()),
                false => Err(Breakdown::NotFinite),
            })
            .map_err(|breakdown| Failure::at_state(model, t, q, breakdown))?;
        workspace.least_multipliers(model);
        found.a.extend_from_slice(workspace.a());
        found.lam.extend_from_slice(workspace.lam());
        let mut kept = workspace.matrix.cancellation();
        if let Some(independent) = &mut independent {
            let lam = found.lam.len() - model.layout.n_rows;
            take_smallest(model, independent, (t, [q, v, z]), &mut found.lam[lam..]);
            kept = independent.matrix.cancellation();
        }
        found.regularity.push(kept.map_or(1.0, |(_, kept)| kept.max(0.0).sqrt()));
    }
    Ok(())
}

/// Replaces multipliers from damped rows, which have nearly the least norm, by the multipliers of least norm. Keeps
/// them if the independent rows have no solution.
fn take_smallest(
    model: &Model,
    independent: &mut Workspace,
    (t, state): (f64, [&[f64]; 3]),
    lam: &mut [f64],
) {
    exchange(model, independent, t, state);
    if independent.react(model, t, state).is_ok() {
        let found = lam.to_vec();
        independent.least_of(model, lam);
        if !all_finite(lam) {
            lam.copy_from_slice(&found);
        }
    }
}

/// Four states at once.
struct Many<'a> {
    wide: Wide<'a>,
    workspace: Workspace<Lanes>,
    q: Vec<Lanes>,
    v: Vec<Lanes>,
    z: Vec<Lanes>,
}

impl<'a> Many<'a> {
    /// Uses the elimination plan of `one`.
    fn new(wide: Wide<'a>, one: &Workspace) -> Self {
        let model = wide.model();
        let mut workspace = Workspace::like(model, one);
        workspace.matrix.set_near_singular(NearSingular::Refuse);
        let room = |width: usize| vec![Lanes::zero(); width];
        let (n_q, n_z) = (model.layout.n_q, model.layout.n_z);
        Self { wide, workspace, q: room(n_q), v: room(n_q), z: room(n_z) }
    }

    /// Omits the same rows as `one`.
    fn follow(&mut self, one: &Workspace) {
        if self.workspace.matrix.omitted() != one.matrix.omitted() {
            self.workspace.omit(one.matrix.omitted());
        }
    }

    /// Solves four states. Returns false if there are fewer than four or if one of them is not regular.
    fn solve(&mut self, rows: States<'_>, found: &mut Accelerations) -> bool {
        let Ok(t) = rows.t.try_into() else { return false };
        Lanes::from_rows(rows.q, &mut self.q);
        Lanes::from_rows(rows.v, &mut self.v);
        Lanes::from_rows(rows.z, &mut self.z);
        let Self { wide, workspace, q, v, z } = self;
        let model = wide.model();
        let solved = workspace.react(model, Lanes::new(t), [q, v, z]);
        workspace.least_multipliers(model);
        let (a, lam) = (workspace.a(), workspace.lam());
        if solved.is_err() || !are_finite([a, lam]) {
            return false;
        }
        for (to, lanes) in [(&mut found.a, a), (&mut found.lam, lam)] {
            let start = to.len();
            to.resize(start + Lanes::WIDTH * lanes.len(), 0.0);
            Lanes::rows(lanes, &mut to[start..]);
        }
        let kept = [workspace.matrix.cancellations().sqrt()];
        let start = found.regularity.len();
        found.regularity.resize(start + Lanes::WIDTH, 0.0);
        Lanes::rows(&kept, &mut found.regularity[start..]);
        true
    }
}
