//! The pattern of the tangent: the owners of coordinates that the constraints and forces of a model couple.

use super::constraints::{linearize_one, store};
use super::kinematics::Motions;
use super::reactive::rows_of;
use crate::elements::derive::{seeded, ByThree};
use crate::elements::{BodyId, Mode};
use crate::math::{Dual, Lift, Listed, Ordered, Pose, Real, ShortArray, Twist, Vec2};
use crate::model::{Block, Columns, Dependence, Model};
use std::collections::BTreeMap;

type D = ByThree<f64>;

/// For each block of a constraint, its pair with each block of the constraint. None if they are not coupled.
pub(super) type ByConstraint = Vec<Vec<Option<usize>>>;

/// The quantities on which a force depends.
#[derive(Clone, Debug)]
pub(super) struct Participants {
    /// The moving bodies on which the force depends: its own bodies, those of its laws, and those of the joint whose
    /// reaction it uses.
    pub bodies: Vec<BodyId>,
    /// The indices in z of the states on which the force depends.
    pub states: Vec<usize>,
    /// The rows of the multipliers on which the force depends.
    pub rows: Vec<usize>,
    /// The owners of internal coordinates on which its laws depend, with their columns.
    pub internals: Vec<(usize, Columns)>,
    /// For each of the bodies and then of the internal owners, its pair with each body on which the force acts.
    pairs: Vec<Vec<(BodyId, usize)>>,
}

impl Participants {
    /// The owners of coordinates on which the force depends: first bodies, then internal owners.
    pub fn owners(&self) -> impl Iterator<Item = usize> + '_ {
        let bodies = self.bodies.iter().map(|body| body.0 - 1);
        bodies.chain(self.internals.iter().map(|(owner, _)| *owner))
    }

    /// The pair (body on which the force acts, owner `b` on which it depends).
    pub fn pair(&self, b: usize, acted: BodyId) -> Option<usize> {
        self.pairs[b].iter().find(|(body, _)| *body == acted).map(|(_, pair)| *pair)
    }
}

/// The pairs collected so far.
pub(super) struct Pairs(BTreeMap<(usize, usize), usize>);

impl Pairs {
    /// The pair of each owner with itself.
    pub fn diagonal(owners: usize) -> Self {
        let mut pairs = Self(BTreeMap::new());
        for owner in 0..owners {
            pairs.index(owner, owner);
        }
        pairs
    }

    /// The index of the pair (row owner, column owner). The pattern is symmetric, so the transposed pair is added as
    /// well.
    fn index(&mut self, row: usize, column: usize) -> usize {
        let next = self.0.len();
        let found = *self.0.entry((row, column)).or_insert(next);
        let next = self.0.len();
        self.0.entry((column, row)).or_insert(next);
        found
    }

    /// All pairs in the order of their indices.
    pub fn listed(self) -> Vec<(usize, usize)> {
        let mut listed: Vec<_> = self.0.into_iter().list();
        listed.order_by_key(|(_, index)| *index);
        listed.into_iter().map(|(pair, _)| pair).list()
    }
}

/// The quantities on which each force depends.
pub(super) fn by_force(model: &Model, pairs: &mut Pairs) -> Vec<Participants> {
    let one = |k: usize, pairs: &mut Pairs| {
        let item = &model.forces[k];
        let mut depends = Dependence::default();
        if let Some(law) = &item.law {
            law.visit(&mut |tape| depends.add(tape));
        }
        if depends.whole {
            (1..model.bodies.len()).map(BodyId).append_to(&mut depends.bodies);
            depends.states.extend(0..model.layout.n_z);
        }
        let seen = |k: usize| {
            let item = &model.forces[k];
            let joint = item.reaction.map_or(&[][..], |k| &model.constraints[k.0].bodies);
            item.bodies.iter().chain(joint)
        };
        let leader = match item.mode {
            Mode::Follows { leader, .. } => Some(leader),
            _ => None,
        };
        let seen = seen(k).chain(leader.into_iter().flat_map(seen));
        let mut bodies: Vec<BodyId> = seen.chain(&depends.bodies).copied().list();
        bodies.retain(|body| !body.is_ground());
        bodies.sort_unstable();
        bodies.dedup();
        let mut states: Vec<usize> =
            model.layout.states[k].clone().chain(depends.states.iter().copied()).list();
        states.sort_unstable();
        states.dedup();
        let acted = || item.bodies.iter().filter(|body| !body.is_ground());
        let internals = internals(model, &depends);
        let found =
            Participants { bodies, states, rows: rows_of(model, k), internals, pairs: vec![] };
        let with = |owner: usize, pairs: &mut Pairs| {
            let pair = |acted: &BodyId| (*acted, pairs.index(acted.0 - 1, owner));
            acted().map(pair).list()
        };
        let pairs = found.owners().map(|owner| with(owner, pairs)).list();
        Participants { pairs, ..found }
    };
    (0..model.forces.len()).map(|k| one(k, pairs)).list()
}

/// The owners of the internal coordinates on which a law depends, each once, with their columns.
fn internals(model: &Model, depends: &Dependence) -> Vec<(usize, Columns)> {
    let owners = model.layout.owners.iter().copied().enumerate().skip(model.bodies.len() - 1);
    let mut first = 0;
    let with_places = owners.map(|(owner, columns)| {
        let places = first..first + columns.count;
        first = places.end;
        (owner, columns, places)
    });
    let used = with_places.filter(|(_, _, places)| {
        depends.whole || depends.internals.iter().any(|place| places.contains(place))
    });
    used.map(|(owner, columns, _)| (owner, columns)).list()
}

/// The blocks that each constraint couples. For a constraint without laws they follow from two arbitrary poses: if
/// Φ_q of one owner does not change with the coordinates of another owner, no pair is needed. This is the case for
/// every revolute joint.
pub(super) fn by_constraint(lifted: &Model<D>, pairs: &mut Pairs) -> Vec<ByConstraint> {
    let trials = [0, 1].each(|trial| without_pattern(lifted, trial));
    let mut columns = vec![D::zero(); lifted.layout.n_entries];
    let constraint = |k: usize| {
        let blocks = &lifted.layout.constraints[k].blocks;
        let mut found = Vec::with_capacity(blocks.len());
        for seed in blocks {
            let item = &lifted.constraints[k];
            let mut coupled = vec![item.law.is_some() || item.element.has_load(); blocks.len()];
            for motions in &trials {
                changes(lifted, k, seed, motions, &mut columns, &mut coupled);
            }
            let pair =
                |(to, coupled): (&Block, bool)| coupled.then(|| pairs.index(to.owner, seed.owner));
            found.push(blocks.iter().zip(coupled).map(pair).list());
        }
        found
    };
    (0..lifted.constraints.len()).map(constraint).list()
}

/// Marks the blocks of constraint `k` whose columns of Φ_q change with the coordinates of `seed`.
fn changes(
    lifted: &Model<D>,
    k: usize,
    seed: &Block,
    motions: &Motions<D>,
    columns: &mut [D],
    coupled: &mut [bool],
) {
    let slots = &lifted.layout.constraints[k];
    let mut motions = motions.clone();
    match seed.body {
        Some(body) => {
            let Pose { r, angle, .. } = motions[body.0].pose;
            let pose = Pose::new(r.x.value, r.y.value, angle.value);
            motions.body_mut(body.0).pose = seeded(&pose);
        }
        None => {
            let (own, _) = motions.own_mut(seed.columns);
            own.iter_mut().enumerate().for_each(|(c, u)| *u = Dual::variable(u.value, c));
        }
    }
    linearize_one(lifted, k, &motions, D::lift(0.7), &mut |_, rows| store(rows, slots, columns));
    for (to, coupled) in slots.blocks.iter().zip(coupled) {
        let entries = &columns[to.entries(slots.rows.len())];
        *coupled |= entries.iter().any(|e| e.slope != [0.0; 3]);
    }
}

/// An arbitrary state of all bodies. Ground remains at the origin.
fn without_pattern(lifted: &Model<D>, trial: usize) -> Motions<D> {
    let mut motions = Motions::new(&lifted.layout);
    let x = |b: usize, k: usize| D::lift((1.0 + (7 * b + 3 * trial + k) as f64 * 0.618_034).sin());
    for b in 1..lifted.bodies.len() {
        let angle = if lifted.bodies[b].turns { x(b, 2) } else { D::zero() };
        let motion = motions.body_mut(b);
        motion.pose = Pose::new(x(b, 0), x(b, 1), angle);
        motion.twist = Twist { velocity: Vec2::new(x(b, 3), x(b, 4)), omega: x(b, 5) };
    }
    for (k, slots) in lifted.layout.constraints.iter().enumerate() {
        let (own, rates) = motions.own_mut(slots.own);
        own.iter_mut().chain(rates).enumerate().for_each(|(c, u)| *u = x(k, c));
    }
    motions
}
