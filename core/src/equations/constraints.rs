//! Φ, Φ_q, Φ̇ and γ of all joints and drivers (Haug 3.6).
//!
//! The element evaluates a constraint with constant fields. A constraint with a law of time or state is
//! differentiated automatically: with dual numbers for each body that it touches, and with a jet in time. The law is
//! evaluated over the same scalar.

use super::gains::Gains;
use super::kinematics::Motions;
use super::laws::{self, Laws};
use crate::elements::derive::{
    columns_of, moving, participants, seeded, terms, ByThree, Few, OfBodies,
};
use crate::elements::{At, BodyId, Constraint, Coordinate, Joint, Linearized, Moving};
use crate::expression::Tape;
use crate::math::{Jet, Listed, Motion, Pose, Real, ShortArray, Twist};
use crate::model::{Block, Model, Slots};

/// Φ(q, t), shape (m).
pub fn residual<S: Real>(model: &Model<S>, motions: &Motions<S>, t: S, out: &mut [S]) {
    for (item, slots) in model.constraints.iter().zip(&model.layout.constraints) {
        let phi = &mut out[slots.rows.clone()];
        let (own, _) = motions.own(slots.own);
        let mut bodies = poses(&item.bodies, motions);
        let at = At { bodies: bodies.all(), own, t };
        match &item.law {
            None => item.element.residual(&at, phi),
            Some(law) => {
                let values = laws::held(&model.parameters, motions, &[], t);
                law.map(&mut |tape| tape.evaluate(&values)).residual(&at, phi);
            }
        }
    }
}

/// The poses of bodies.
#[inline]
pub(super) fn poses<S: Real>(bodies: &[BodyId], motions: &Motions<S>) -> OfBodies<Pose<S>> {
    let mut poses = OfBodies::new(bodies.len(), Pose::identity());
    for (pose, body) in poses.all().iter_mut().zip(bodies) {
        *pose = motions[body.0].pose;
    }
    poses
}

/// Stored entries of Φ_q, in the order of the layout.
#[inline]
pub fn jacobian<S: Real>(model: &Model<S>, motions: &Motions<S>, t: S, entries: &mut [S]) {
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        linearize_one(model, k, motions, t, &mut |_, columns| store(columns, slots, entries));
    }
}

/// Φ, Φ_q q̇ + Φ_t, and γ, each of shape (m).
pub fn terms_at<S: Real>(model: &Model<S>, motions: &Motions<S>, t: S) -> [Vec<S>; 3] {
    let [mut phi, mut rate, mut gamma] = [(); 3].each(|()| vec![S::zero(); model.layout.n_rows]);
    velocity_terms(model, motions, t, &mut phi, &mut rate, &mut gamma);
    [phi, rate, gamma]
}

/// Writes Φ, Φ_q q̇ + Φ_t, and γ, each of shape (m).
pub fn velocity_terms<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    t: S,
    residual: &mut [S],
    rate: &mut [S],
    gamma: &mut [S],
) {
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        linearize_one(model, k, motions, t, &mut |terms, _| {
            residual[slots.rows.clone()].copy_from_slice(terms.residual);
            rate[slots.rows.clone()].copy_from_slice(terms.rate);
            gamma[slots.rows.clone()].copy_from_slice(terms.gamma);
        });
    }
}

/// Φ, Φ_q q̇ + Φ_t and γ, each of shape (m), and Φ_q in `entries`, as [`jacobian`] stores it.
pub fn terms_and_jacobian<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    t: S,
    [residual, rate, gamma]: [&mut [S]; 3],
    entries: &mut [S],
) {
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        linearize_one(model, k, motions, t, &mut |terms, columns| {
            residual[slots.rows.clone()].copy_from_slice(terms.residual);
            rate[slots.rows.clone()].copy_from_slice(terms.rate);
            gamma[slots.rows.clone()].copy_from_slice(terms.gamma);
            store(columns, slots, entries);
        });
    }
}

/// Φ_q in `entries`, as [`jacobian`] stores it, and γ̂ = γ - 2α Φ̇ - β² Φ, shape (m), in `right`.
#[inline]
pub fn linearize<S: Real>(
    model: &Model<S>,
    motions: &Motions<S>,
    t: S,
    gains: Gains,
    right: &mut [S],
    entries: &mut [S],
) {
    let all = 0..model.constraints.len();
    linearize_some(model, all, motions, t, Stabilized::new(gains), right, entries);
}

/// [`linearize`] for the constraints `which` only.
pub(super) fn linearize_some<S: Real>(
    model: &Model<S>,
    which: impl Iterator<Item = usize>,
    motions: &Motions<S>,
    t: S,
    stabilized: Stabilized<S>,
    right: &mut [S],
    entries: &mut [S],
) {
    for k in which {
        let slots = &model.layout.constraints[k];
        linearize_one(model, k, motions, t, &mut |terms, columns| {
            stabilized.put(terms, &mut right[slots.rows.clone()]);
            store(columns, slots, entries);
        });
    }
}

/// Φ, Φ̇ and γ of one constraint, with one entry for each equation.
#[derive(Debug)]
pub struct Terms<'a, S> {
    /// Φ.
    pub residual: &'a [S],
    /// Φ_q q̇ + Φ_t.
    pub rate: &'a [S],
    /// γ.
    pub gamma: &'a [S],
}

/// Baumgarte's gains in γ̂.
#[derive(Clone, Copy)]
pub(super) struct Stabilized<S> {
    /// 2α.
    damping: S,
    /// β².
    stiffness: S,
    /// Whether both are zero.
    none: bool,
}

impl<S: Real> Stabilized<S> {
    #[inline]
    pub fn new(gains: Gains) -> Self {
        let damping = S::constant(2.0 * gains.alpha);
        let none = gains == Gains::default();
        Self { damping, stiffness: S::constant(gains.beta * gains.beta), none }
    }

    /// Computes γ̂ of the rows of one constraint.
    #[inline(always)]
    pub fn put(&self, terms: &Terms<'_, S>, right: &mut [S]) {
        if self.none {
            for (k, right) in right.iter_mut().enumerate() {
                *right = terms.gamma[k];
            }
            return;
        }
        for (k, right) in right.iter_mut().enumerate() {
            let [gamma, rate, residual] = [terms.gamma[k], terms.rate[k], terms.residual[k]];
            *right = gamma - self.damping * rate - self.stiffness * residual;
        }
    }
}

/// The rows of Φ_q of a constraint.
pub(super) enum ByBlock<'a, S> {
    /// One set of rows for each participant of the element.
    Participants(&'a [BodyId], &'a [[S; 3]]),
    /// One set of rows for each block, since a law may touch more bodies than the element.
    Blocks(&'a [[S; 3]]),
}

/// Memory for Φ, Φ̇, γ and the rows of Φ_q of one constraint.
struct RowMemory<S> {
    bodies: OfBodies<Motion<S>>,
    /// Φ, Φ̇ and γ.
    terms: Few<S, 9>,
    columns: Few<[S; 3], 9>,
}

impl<S: Real> RowMemory<S> {
    /// Memory for `m` equations and the columns of `count` bodies or blocks.
    #[inline(always)]
    fn new(bodies: &[BodyId], motions: &Motions<S>, [m, count]: [usize; 2]) -> Self {
        let mut all = OfBodies::new(bodies.len(), Motion::ground());
        for (motion, body) in all.all().iter_mut().zip(bodies) {
            *motion = motions[body.0];
        }
        let (terms, columns) = (Few::new(3 * m, S::zero()), Few::new(count * m, [S::zero(); 3]));
        Self { bodies: all, terms, columns }
    }
}

/// Calls `take` with Φ, Φ̇, γ and the rows of Φ_q of constraint `k`, an `element` with constant fields.
#[inline(always)]
pub(super) fn linearize_element<E: Joint, S: Real, R>(
    model: &Model<S>,
    k: usize,
    element: &E::Over<S>,
    motions: &Motions<S>,
    t: S,
    take: impl FnOnce(&Terms<'_, S>, ByBlock<'_, S>) -> R,
) -> R {
    let (bodies, slots) = (&model.constraints[k].bodies, &model.layout.constraints[k]);
    let (own, own_rates) = motions.own(slots.own);
    let m = slots.rows.len();
    let mut rows = RowMemory::new(bodies, motions, [m, participants(bodies.len(), own.len())]);
    let at = Moving { bodies: rows.bodies.all(), own, own_rates, t };
    let (residual, rest) = rows.terms.all().split_at_mut(m);
    let (rate, gamma) = rest.split_at_mut(m);
    let columns = rows.columns.all();
    E::linearize(element, &at, Linearized { residual, rate, gamma, columns });
    take(&Terms { residual, rate, gamma }, ByBlock::Participants(bodies, columns))
}

/// Calls `take` with Φ, Φ̇, γ and the rows of Φ_q of constraint `k`.
pub(super) fn linearize_one<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    take: &mut dyn FnMut(&Terms<'_, S>, ByBlock<'_, S>),
) {
    let (item, slots) = (&model.constraints[k], &model.layout.constraints[k]);
    let (own, own_rates) = motions.own(slots.own);
    let (m, bodies) = (slots.rows.len(), &item.bodies);
    let count = match &item.law {
        None => participants(bodies.len(), own.len()),
        Some(_) => slots.blocks.len(),
    };
    let mut rows = RowMemory::new(bodies, motions, [m, count]);
    let at = Moving { bodies: rows.bodies.all(), own, own_rates, t };
    let (residual, rest) = rows.terms.all().split_at_mut(m);
    let (rate, gamma) = rest.split_at_mut(m);
    let columns = rows.columns.all();
    let by_block = match &item.law {
        None => {
            item.element.linearize(&at, Linearized { residual, rate, gamma, columns });
            ByBlock::Participants(bodies, columns)
        }
        Some(law) => {
            law_terms(model, law, motions, &at, [residual, rate, gamma]);
            for (block, rows) in slots.blocks.iter().zip(columns.chunks_exact_mut(m)) {
                law_columns((model, k, law), motions, &at, block, rows);
            }
            ByBlock::Blocks(columns)
        }
    };
    take(&Terms { residual, rate, gamma }, by_block);
}

/// Adds the rows of a constraint to its blocks of Φ_q.
pub(super) fn store<S: Real>(rows: ByBlock<'_, S>, slots: &Slots, entries: &mut [S]) {
    let m = slots.rows.len();
    for (b, block) in slots.blocks.iter().enumerate() {
        let out = &mut entries[block.entries(m)];
        match rows {
            ByBlock::Blocks(rows) => out.copy_from_slice(rows[b * m..][..m].as_flattened()),
            ByBlock::Participants(bodies, rows) => {
                out.fill(S::zero());
                let own = block.body.is_none();
                for (p, rows) in rows.chunks_exact(m).enumerate() {
                    let same = bodies.get(p).map_or(own, |body| Some(*body) == block.body);
                    if same {
                        let rows = rows.as_flattened();
                        out.iter_mut().zip(rows).for_each(|(out, x)| *out += *x);
                    }
                }
            }
        }
    }
}

/// Φ, Φ̇ and γ of a constraint with a law, from a jet in time.
fn law_terms<S: Real>(
    model: &Model<S>,
    law: &Constraint<Tape>,
    motions: &Motions<S>,
    at: &Moving<'_, S>,
    out: [&mut [S]; 3],
) {
    let coordinate =
        |body: BodyId, c: Coordinate| -> Jet<S> { c.of(&moving(&motions[body.0]), &Twist::zero()) };
    let [own, rates] = motions.internals();
    let jet = |(u, rate): (&S, &S)| Jet::new(*u, *rate, S::zero());
    let internals = own.iter().zip(rates).map(jet).list();
    let residual = |at: &At<'_, Jet<S>>, phi: &mut [Jet<S>]| {
        let (parameters, pieces, own) = (&model.parameters, &motions.pieces, [&internals[..], &[]]);
        let values = Laws { parameters, t: at.t, coordinate, own, z: &[], pieces, function: None };
        law.map(&mut |tape| tape.evaluate(&values)).residual(at, phi);
    };
    terms(at, &residual, out);
}

/// Derivatives of a constraint with a law with respect to the coordinates of one owner.
fn law_columns<S: Real>(
    (model, k, law): (&Model<S>, usize, &Constraint<Tape>),
    motions: &Motions<S>,
    at: &Moving<'_, S>,
    block: &Block,
    rows: &mut [[S; 3]],
) {
    let coordinate = |body: BodyId, c: Coordinate| -> ByThree<S> {
        let pose = &motions[body.0].pose;
        let pose = if Some(body) == block.body { seeded(pose) } else { pose.lift() };
        c.of(&pose, &Twist::zero())
    };
    let internals = motions.seeded_internals(block.columns, block.body.is_none());
    let residual = |at: &At<'_, ByThree<S>>, phi: &mut [ByThree<S>]| {
        let (parameters, pieces, own) = (&model.parameters, &motions.pieces, [&internals[..], &[]]);
        let values = Laws { parameters, t: at.t, coordinate, own, z: &[], pieces, function: None };
        law.map(&mut |tape| tape.evaluate(&values)).residual(at, phi);
    };
    let varies = |b: usize| Some(model.constraints[k].bodies[b]) == block.body;
    let own_varies = block.body.is_none() && block.columns == model.layout.constraints[k].own;
    columns_of(at, &varies, own_varies, &residual, rows);
}

/// Derivatives of constraint `k` with respect to the coordinates of one body, one row for each equation, in `rows`.
/// They are zero if the constraint does not touch the body. Ground counts only if it is a body of the element.
pub(super) fn columns_by_body<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &Motions<S>,
    t: S,
    body: BodyId,
    rows: &mut [[S; 3]],
) {
    let slots = &model.layout.constraints[k];
    let m = slots.rows.len();
    rows.fill([S::zero(); 3]);
    let mut add = |from: &[[S; 3]]| {
        for (row, from) in rows.iter_mut().zip(from) {
            row.iter_mut().zip(from).for_each(|(row, x)| *row += *x);
        }
    };
    linearize_one(model, k, motions, t, &mut |_, columns| match columns {
        ByBlock::Participants(bodies, columns) => {
            let own = bodies.iter().zip(columns.chunks_exact(m)).filter(|(b, _)| **b == body);
            own.for_each(|(_, rows)| add(rows));
        }
        ByBlock::Blocks(columns) => {
            let blocks = slots.blocks.iter().zip(columns.chunks_exact(m));
            let own = blocks.filter(|(block, _)| block.body == Some(body));
            own.for_each(|(_, rows)| add(rows));
        }
    });
}

/// ν = -Φ_t: the right side of Φ_q q̇ = ν (Haug 3.6.10), shape (m).
#[inline]
pub fn nu<S: Real>(model: &Model<S>, q: &[S], t: S) -> Vec<S> {
    let [_, rate, _] = terms_at(model, &Motions::at_rest(&model.layout, q), t);
    rate.into_iter().map(|r| -r).list()
}

/// y += Φ_qᵀ λ, shape (n_q).
pub fn add_transposed<S: Real>(model: &Model<S>, entries: &[S], lam: &[S], y: &mut [S]) {
    for slots in &model.layout.constraints {
        for block in &slots.blocks {
            for (r, row) in slots.rows.clone().enumerate() {
                let entries = &entries[block.row(r)];
                let y = &mut y[block.columns.range()];
                y.iter_mut().zip(entries).for_each(|(y, e)| *y += *e * lam[row]);
            }
        }
    }
}

/// Φ_q x for the rows of one constraint, in `out`, shape (equations).
pub fn times<S: Real>(model: &Model<S>, k: usize, entries: &[S], x: &[S], out: &mut [S]) {
    out.fill(S::zero());
    for block in &model.layout.constraints[k].blocks {
        let [x, y, angle] = block.columns.of(x);
        for (r, out) in out.iter_mut().enumerate() {
            let entries = &entries[block.row(r)];
            *out += entries[0] * x + entries[1] * y + entries[2] * angle;
        }
    }
}

/// Φ_q x, shape (m).
#[inline]
pub fn times_all<S: Real>(model: &Model<S>, entries: &[S], x: &[S], out: &mut [S]) {
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        times(model, k, entries, x, &mut out[slots.rows.clone()]);
    }
}
