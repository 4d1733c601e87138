//! Φ, Φ_q, Φ̇ and γ of all joints and drivers (Haug 3.6).
//!
//! A constraint whose fields are constant is evaluated as its element states it. One with a law of
//! time or state takes the derived path: duals over each body it touches, and a jet in time, with
//! the law evaluated on the same scalar.

use super::laws::{self, Laws};
use super::motion::Gains;
use crate::elements::{
    jets, moving, seeded, BodyId, Constraint, Coordinate, Linear, Rows, VelocityTerms,
    MOST_EQUATIONS,
};
use crate::expression::Tape;
use crate::math::{Dual, Jet, Lift, Motion, Pose, Real};
use crate::model::{Block, ConstraintItem, Model, Slots};

/// Φ(q, t), shape (m).
pub fn residual<S: Real>(model: &Model<S>, motions: &[Motion<S>], t: S, out: &mut [S]) {
    for (item, slots) in model.constraints.iter().zip(&model.layout.constraints) {
        let [i, j] = item.element.ends().map(|b| &motions[b.0].pose);
        let out = &mut out[slots.rows.clone()];
        match &item.law {
            None => item.element.residual(i, j, t, out),
            Some(law) => {
                let values = laws::at(&model.parameters, motions, t);
                law.map(&mut |tape| tape.evaluate(&values)).residual(i, j, t, out);
            }
        }
    }
}

/// Stored entries of Φ_q, in the order of the layout.
pub fn jacobian<S: Real>(model: &Model<S>, motions: &[Motion<S>], t: S, entries: &mut [S]) {
    (0..model.constraints.len()).for_each(|k| jacobian_of(model, k, motions, t, entries));
}

/// The same of constraint `k` alone.
pub(super) fn jacobian_of<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &[Motion<S>],
    t: S,
    entries: &mut [S],
) {
    let (item, slots) = (&model.constraints[k], &model.layout.constraints[k]);
    if item.law.is_some() {
        return law_blocks(model, item, slots, motions, t, entries);
    }
    let ends = item.element.ends();
    let [i, j] = ends.map(|b| &motions[b.0].pose);
    let mut rows = [[S::zero(); 6]; MOST_EQUATIONS];
    let rows = &mut rows[..slots.rows.len()];
    item.element.jacobian(i, j, t, rows);
    store(ends, rows, slots, entries);
}

/// Puts the rows of a constraint into its blocks.
#[inline(always)]
fn store<S: Real>(ends: [BodyId; 2], rows: &[[S; 6]], slots: &Slots, entries: &mut [S]) {
    for block in &slots.blocks {
        let out = entries[block.first..][..3 * rows.len()].chunks_exact_mut(3);
        match ends.map(|body| body == block.body) {
            [true, false] => out.zip(rows).for_each(|(out, row)| out.copy_from_slice(&row[..3])),
            [false, true] => out.zip(rows).for_each(|(out, row)| out.copy_from_slice(&row[3..])),
            // a joint of a body with itself adds up both columns
            _ => out.zip(rows).for_each(|(out, row)| {
                out.copy_from_slice(&[row[0] + row[3], row[1] + row[4], row[2] + row[5]]);
            }),
        }
    }
}

/// The same, but for the columns ±I of joints that pin, which never change: they stand there already.
#[inline(always)]
pub(super) fn update<S: Real, const M: usize>(
    ends: [BodyId; 2],
    rows: &[[S; 6]; M],
    slots: &Slots,
    entries: &mut [S],
) {
    match slots.blocks.as_slice() {
        [i, j] if M == 2 && j.sign != 0.0 => {
            let out = &mut entries[i.first..i.first + 12]; // that of j follows
            (out[2], out[5]) = (rows[0][2], rows[1][2]);
            (out[8], out[11]) = (rows[0][5], rows[1][5]);
        }
        [one] if M == 2 && one.sign != 0.0 => {
            let angle = if one.sign > 0.0 { 5 } else { 2 };
            let out = &mut entries[one.first..one.first + 6];
            (out[2], out[5]) = (rows[0][angle], rows[1][angle]);
        }
        _ => store(ends, rows, slots, entries),
    }
}

/// Φ_q into `entries` as [`jacobian`], where such an entry stands already, and γ̂ = γ - 2α Φ̇ - β² Φ, shape (m),
/// into `right`, in one pass.
pub fn linearize<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
    t: S,
    gains: Gains,
    right: &mut [S],
    entries: &mut [S],
) {
    let all = 0..model.constraints.len();
    linearize_some(model, all, motions, t, Stabilized::new(gains), right, entries);
}

/// The same of the constraints `which` alone.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub(super) fn linearize_some<S: Real>(
    model: &Model<S>,
    which: impl Iterator<Item = usize>,
    motions: &[Motion<S>],
    t: S,
    stabilized: Stabilized<S>,
    right: &mut [S],
    entries: &mut [S],
) {
    for k in which {
        let (item, slots) = (&model.constraints[k], &model.layout.constraints[k]);
        let right = &mut right[slots.rows.clone()];
        let Some(law) = &item.law else {
            item.element.linearize(motions, t, Target { slots, stabilized, right, entries });
            continue;
        };
        let (m, none) = (slots.rows.len(), [S::zero(); MOST_EQUATIONS]);
        let mut terms =
            VelocityTerms::<S, MOST_EQUATIONS> { residual: none, rate: none, gamma: none };
        let out = Rows {
            residual: &mut terms.residual[..m],
            rate: &mut terms.rate[..m],
            gamma: &mut terms.gamma[..m],
        };
        law_velocity_terms(model, law, item.element.ends(), motions, t, out);
        stabilized.put(&terms, right);
        law_blocks(model, item, slots, motions, t, entries);
    }
}

/// Baumgarte's gains as γ̂ takes them.
#[derive(Clone, Copy)]
pub(super) struct Stabilized<S> {
    /// 2α.
    damping: S,
    /// β².
    stiffness: S,
    /// Whether there is none.
    none: bool,
}

impl<S: Real> Stabilized<S> {
    pub fn new(gains: Gains) -> Self {
        let damping = S::constant(2.0 * gains.alpha);
        let none = gains == Gains::default();
        Self { damping, stiffness: S::constant(gains.beta * gains.beta), none }
    }

    /// γ̂ of the first rows, as many as `right` takes.
    #[inline(always)]
    pub fn put<const M: usize>(&self, terms: &VelocityTerms<S, M>, right: &mut [S]) {
        if self.none {
            right.copy_from_slice(&terms.gamma[..right.len()]);
            return;
        }
        for (k, right) in right.iter_mut().enumerate() {
            let [gamma, rate, residual] = [terms.gamma[k], terms.rate[k], terms.residual[k]];
            *right = gamma - self.damping * rate - self.stiffness * residual;
        }
    }
}

/// Where a constraint puts γ̂ and its rows of Φ_q.
struct Target<'a, S> {
    slots: &'a Slots,
    stabilized: Stabilized<S>,
    /// γ̂ of its rows.
    right: &'a mut [S],
    entries: &'a mut [S],
}

impl<S: Real> Linear<S> for Target<'_, S> {
    #[inline(always)]
    fn take<const M: usize>(
        self,
        ends: [BodyId; 2],
        terms: &VelocityTerms<S, M>,
        rows: &[[S; 6]; M],
    ) {
        self.stabilized.put(terms, &mut self.right[..M]);
        update(ends, rows, self.slots, self.entries);
    }
}

/// Φ, Φ̇ and γ of constraint `k` alone into its own rows, and its blocks of Φ_q into `entries` of all.
pub(super) fn linearize_one<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &[Motion<S>],
    t: S,
    [residual, rate, gamma]: [&mut [S]; 3],
    entries: &mut [S],
) {
    velocity_terms_of(model, k, motions, t, Rows { residual, rate, gamma });
    jacobian_of(model, k, motions, t, entries);
}

/// Blocks of a constraint with a law.
fn law_blocks<S: Real>(
    model: &Model<S>,
    item: &ConstraintItem<S>,
    slots: &Slots,
    motions: &[Motion<S>],
    t: S,
    entries: &mut [S],
) {
    for block in &slots.blocks {
        let out = &mut entries[block.first..][..3 * slots.rows.len()];
        law_block(model, item, motions, t, block, out);
    }
}

/// Derivatives of a constraint with a law by the coordinates of one body.
pub(super) fn law_block<S: Real>(
    model: &Model<S>,
    item: &ConstraintItem<S>,
    motions: &[Motion<S>],
    t: S,
    block: &Block,
    out: &mut [S],
) {
    type D<S> = Dual<3, S>;
    let pose = |body: BodyId| -> Pose<D<S>> {
        let pose = &motions[body.0].pose;
        if body == block.body {
            seeded(pose, 0)
        } else {
            lifted(pose)
        }
    };
    let t = D::lift(t);
    let coordinate =
        |body: BodyId, c: Coordinate| -> D<S> { c.of(&pose(body), &crate::math::Twist::zero()) };
    let values = Laws { parameters: &model.parameters, t, coordinate };
    let Some(law) = &item.law else { return };
    let element = law.map(&mut |tape| tape.evaluate(&values));
    let [i, j] = element.ends().map(pose);
    let mut phi = [D::<S>::zero(); MOST_EQUATIONS];
    let m = out.len() / 3;
    element.residual(&i, &j, t, &mut phi[..m]);
    for (phi, out) in phi[..m].iter().zip(out.chunks_exact_mut(3)) {
        out.copy_from_slice(&phi.slope);
    }
}

fn lifted<S: Real>(pose: &Pose<S>) -> Pose<Dual<3, S>> {
    Pose {
        r: pose.r.lift(),
        angle: Lift::lift(pose.angle),
        rotation: crate::math::Rotation {
            cos: Lift::lift(pose.rotation.cos),
            sin: Lift::lift(pose.rotation.sin),
        },
    }
}

/// Φ, Φ_q q̇ + Φ_t, and γ, each of shape (m).
pub fn velocity_terms<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
    t: S,
    residual: &mut [S],
    rate: &mut [S],
    gamma: &mut [S],
) {
    for (k, slots) in model.layout.constraints.iter().enumerate() {
        let rows = slots.rows.clone();
        let out = Rows {
            residual: &mut residual[rows.clone()],
            rate: &mut rate[rows.clone()],
            gamma: &mut gamma[rows],
        };
        velocity_terms_of(model, k, motions, t, out);
    }
}

/// The same of constraint `k` alone.
pub(super) fn velocity_terms_of<S: Real>(
    model: &Model<S>,
    k: usize,
    motions: &[Motion<S>],
    t: S,
    out: Rows<'_, S>,
) {
    let item = &model.constraints[k];
    let ends = item.element.ends();
    match &item.law {
        None => item.element.velocity_terms(&motions[ends[0].0], &motions[ends[1].0], t, out),
        Some(law) => law_velocity_terms(model, law, ends, motions, t, out),
    }
}

/// Φ, Φ̇ and γ of a constraint with a law, by a jet in time.
fn law_velocity_terms<S: Real>(
    model: &Model<S>,
    law: &Constraint<Tape>,
    ends: [BodyId; 2],
    motions: &[Motion<S>],
    t: S,
    out: Rows<'_, S>,
) {
    let time = Jet::new(t, S::one(), S::zero());
    let coordinate = |body: BodyId, c: Coordinate| -> Jet<S> {
        let motion = &motions[body.0];
        let [position, rate] = [c.column(), c.column() + 3]
            .map(|k| Coordinate::ALL[k].of(&motion.pose, &motion.twist));
        Jet::new(position, rate, S::zero())
    };
    let values = Laws { parameters: &model.parameters, t: time, coordinate };
    let element = law.map(&mut |tape| tape.evaluate(&values));
    let [i, j] = ends.map(|b| moving(&motions[b.0]));
    jets(&element, &i, &j, time, out);
}

/// ν = -Φ_t: the right side of Φ_q q̇ = ν (Haug 3.6.10), shape (m).
pub fn nu<S: Real>(model: &Model<S>, q: &[S], t: S) -> Vec<S> {
    let m = model.layout.n_rows;
    let (mut phi, mut rate, mut gamma) =
        (vec![S::zero(); m], vec![S::zero(); m], vec![S::zero(); m]);
    let motions = super::kinematics::at_rest(q);
    velocity_terms(model, &motions, t, &mut phi, &mut rate, &mut gamma);
    rate.into_iter().map(|r| -r).collect()
}

/// y += Φ_qᵀ λ, shape (n_q).
pub fn add_transposed<S: Real>(model: &Model<S>, entries: &[S], lam: &[S], y: &mut [S]) {
    for slots in &model.layout.constraints {
        for block in &slots.blocks {
            let columns = &mut y[crate::model::columns(block.body)];
            for (row, entries) in slots.rows.clone().zip(entries[block.first..].chunks_exact(3)) {
                for (y, e) in columns.iter_mut().zip(entries) {
                    *y += *e * lam[row];
                }
            }
        }
    }
}

/// Φ_q x of one constraint's rows into `out`, shape (equations).
pub fn times<S: Real>(model: &Model<S>, k: usize, entries: &[S], x: &[S], out: &mut [S]) {
    out.fill(S::zero());
    for block in &model.layout.constraints[k].blocks {
        let columns = &x[crate::model::columns(block.body)];
        for (out, entries) in out.iter_mut().zip(entries[block.first..].chunks_exact(3)) {
            *out += entries[0] * columns[0] + entries[1] * columns[1] + entries[2] * columns[2];
        }
    }
}
