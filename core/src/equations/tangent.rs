//! The tangent of the equations of motion: derivatives of r = M a + Φ_qᵀ λ - Q and of Φ_q v + Φ_t.
//!
//! ```text
//! K = ∂r/∂q      D = ∂r/∂v      M = ∂r/∂a      B = ∂(Φ_q v + Φ_t)/∂q
//! ```
//!
//! Bodies in closed form; constraints and forces by dual numbers, one body that they depend on at a
//! time, with the same code as the equations themselves, laws of time and state included. K and D are
//! stored as blocks (body, body), of which only those exist that an element couples.

use super::mass::{self, MassBlock};
use super::{constraints, forces};
use crate::elements::{seeded, BodyId, MOST_EQUATIONS};
use crate::math::{Dual, Lift, Motion, Pose, Real, Rotation, Twist, Vec2};
use crate::model::{Block, Body, Dependence, ForceItem, Model, Slots};

type D = Dual<3>;
/// 3 × 3 entries, row by row.
type Entries = [[f64; 3]; 3];
const ZERO: Entries = [[0.0; 3]; 3];

/// Derivatives of the equations of motion at one state.
#[derive(Clone, Debug)]
pub struct Tangent {
    lifted: Model<D>,
    motions: Vec<Motion<D>>,
    /// The bodies (from 0, ground left out) of each block; the diagonal first.
    pairs: Vec<(usize, usize)>,
    /// K, one block for each pair.
    pub stiffness: Vec<Entries>,
    /// D, one block for each pair.
    pub damping: Vec<Entries>,
    /// M.
    pub mass: Vec<MassBlock>,
    /// Φ_q, in the order of the layout.
    pub jacobian: Vec<f64>,
    /// B, in the same order.
    pub rate: Vec<f64>,
    /// Scratch: Φ_q over duals, and Φ, Φ̇, γ of one constraint.
    columns: Vec<D>,
    rows: [[D; MOST_EQUATIONS]; 3],
    by_constraint: Vec<ByConstraint>,
    by_force: Vec<ByForce>,
}

/// For each body of a constraint, the pair with each of its bodies; none if they are not coupled.
type ByConstraint = Vec<Vec<Option<usize>>>;

/// What a force depends on.
#[derive(Clone, Debug)]
struct ByForce {
    bodies: Vec<BodyId>,
    /// For each of them, the pairs with the two ends that it acts on.
    pairs: Vec<[Option<usize>; 2]>,
}

/// The pairs found so far.
struct Pairs(std::collections::BTreeMap<(usize, usize), usize>);

impl Pairs {
    /// The pair (row body, column body); a pattern is symmetric, so its mirror comes with it.
    fn index(&mut self, row: BodyId, column: BodyId) -> Option<usize> {
        if row.is_ground() || column.is_ground() {
            return None;
        }
        let pair = (row.0 - 1, column.0 - 1);
        let next = self.0.len();
        let found = *self.0.entry(pair).or_insert(next);
        let next = self.0.len();
        self.0.entry((pair.1, pair.0)).or_insert(next);
        Some(found)
    }
}

impl Tangent {
    /// Memory for a model, and the pattern of its coupling.
    pub fn new(model: &Model) -> Self {
        let lifted: Model<D> = model.lift();
        let bodies = model.bodies.len() - 1;
        let mut pairs = Pairs((0..bodies).map(|b| ((b, b), b)).collect());
        let mut probe = Probe::new(&lifted);
        let by_constraint =
            (0..model.constraints.len()).map(|k| probe.pairs(k, &mut pairs)).collect();
        let by_force = model.forces.iter().map(|item| force_pairs(item, &mut pairs)).collect();
        let mut listed: Vec<_> = pairs.0.into_iter().collect();
        listed.sort_by_key(|(_, index)| *index);
        let pairs: Vec<(usize, usize)> = listed.into_iter().map(|(pair, _)| pair).collect();
        let nothing = MassBlock { mass: 0.0, coupling: Vec2::zero(), inertia: 0.0 };
        Self {
            motions: Vec::with_capacity(bodies + 1),
            stiffness: vec![ZERO; pairs.len()],
            damping: vec![ZERO; pairs.len()],
            mass: vec![nothing; bodies],
            jacobian: vec![0.0; model.layout.n_entries],
            rate: vec![0.0; model.layout.n_entries],
            columns: vec![D::zero(); model.layout.n_entries],
            rows: [[D::zero(); MOST_EQUATIONS]; 3],
            lifted,
            pairs,
            by_constraint,
            by_force,
        }
    }

    /// The bodies of each block of K and D, counted from 0 without ground.
    pub fn pairs(&self) -> &[(usize, usize)] {
        &self.pairs
    }

    /// All derivatives at a state; `a` shape (n_q), `lam` shape (n_rows).
    pub fn linearize(&mut self, model: &Model, motions: &[Motion], t: f64, a: &[f64], lam: &[f64]) {
        self.stiffness.fill(ZERO);
        self.damping.fill(ZERO);
        self.motions.clear();
        self.motions.extend(motions.iter().map(still));
        let moving = model.bodies.iter().zip(motions).skip(1).zip(a.chunks_exact(3));
        for (b, ((body, motion), a)) in moving.enumerate() {
            self.mass[b] = mass::block(body, motion);
            let g = model.gravity;
            (self.stiffness[b], self.damping[b]) = inertial(body, motion, g, [a[0], a[1], a[2]]);
        }
        for (k, slots) in model.layout.constraints.iter().enumerate() {
            self.constraint(k, slots, motions, t, &lam[slots.rows.clone()]);
        }
        for k in 0..self.by_force.len() {
            self.force(k, motions, t);
        }
    }

    /// (M x - K s, -B s) into `out`, shape (n_q + n_rows).
    pub fn times(&self, model: &Model, x: &[f64], s: &[f64], out: &mut [f64]) {
        let (upper, lower) = out.split_at_mut(x.len());
        let blocks = upper.chunks_exact_mut(3).zip(x.chunks_exact(3)).zip(&self.mass);
        for ((out, x), mass) in blocks {
            out.copy_from_slice(&mass.times([x[0], x[1], x[2]]));
        }
        for ((row, column), block) in self.pairs.iter().zip(&self.stiffness) {
            let s = &s[3 * column..][..3];
            for (out, k) in upper[3 * row..][..3].iter_mut().zip(block) {
                *out -= k[0] * s[0] + k[1] * s[1] + k[2] * s[2];
            }
        }
        for (k, slots) in model.layout.constraints.iter().enumerate() {
            let rows = &mut lower[slots.rows.clone()];
            constraints::times(model, k, &self.rate, s, rows);
            rows.iter_mut().for_each(|row| *row = -*row);
        }
    }

    /// (Φ_qᵀ λ)_q and B of one constraint; its Φ_q comes with them.
    fn constraint(&mut self, k: usize, slots: &Slots, motions: &[Motion], t: f64, lam: &[f64]) {
        let m = lam.len();
        for (seed, block) in slots.blocks.iter().enumerate() {
            let body = block.body.0;
            self.motions[body].pose = seeded(&motions[body].pose, 0);
            let out = self.rows.each_mut().map(|rows| &mut rows[..m]);
            let (lifted, columns) = (&self.lifted, &mut self.columns);
            constraints::linearize_one(lifted, k, &self.motions, D::lift(t), out, columns);
            self.motions[body] = still(&motions[body]);
            for (r, rate) in self.rows[1][..m].iter().enumerate() {
                self.rate[block.first + 3 * r..][..3].copy_from_slice(&rate.slope);
            }
            for (to, pair) in slots.blocks.iter().zip(&self.by_constraint[k][seed]) {
                let Some(pair) = *pair else { continue };
                let entries = self.columns[to.first..][..3 * m].chunks_exact(3);
                for (entries, lam) in entries.zip(lam) {
                    add(&mut self.stiffness[pair], entries, *lam);
                }
            }
        }
        for block in &slots.blocks {
            let range = block.first..block.first + 3 * m;
            let values = self.columns[range.clone()].iter();
            self.jacobian[range].iter_mut().zip(values).for_each(|(e, d)| *e = d.value);
        }
    }

    /// -∂Q/∂q and -∂Q/∂v of one force.
    fn force(&mut self, k: usize, motions: &[Motion], t: f64) {
        let Self { lifted, motions: duals, by_force, stiffness, damping, .. } = self;
        let item = &lifted.forces[k];
        for (body, pairs) in by_force[k].bodies.iter().zip(&by_force[k].pairs) {
            let at = body.0;
            for (by_rate, blocks) in [(false, &mut *stiffness), (true, &mut *damping)] {
                duals[at] = still(&motions[at]);
                if by_rate {
                    duals[at].twist = varied(&motions[at].twist);
                } else {
                    duals[at].pose = seeded(&motions[at].pose, 0);
                }
                forces::each_action(lifted, item, duals, D::lift(t), |_, _, action| {
                    for (pair, w) in pairs.iter().zip([action.on_i, action.on_j]) {
                        if let Some(pair) = *pair {
                            add(&mut blocks[pair], &[w.force.x, w.force.y, w.torque], -1.0);
                        }
                    }
                });
            }
            duals[at] = still(&motions[at]);
        }
    }
}

/// block += factor × slopes of its rows.
fn add(block: &mut Entries, rows: &[D], factor: f64) {
    for (out, row) in block.iter_mut().zip(rows) {
        out.iter_mut().zip(row.slope).for_each(|(out, slope)| *out += factor * slope);
    }
}

/// A motion without derivatives.
fn still(motion: &Motion) -> Motion<D> {
    let Motion { pose, twist } = motion;
    let rotation = Rotation { cos: D::lift(pose.rotation.cos), sin: D::lift(pose.rotation.sin) };
    Motion {
        pose: Pose { r: pose.r.lift(), angle: D::lift(pose.angle), rotation },
        twist: Twist { velocity: twist.velocity.lift(), omega: D::lift(twist.omega) },
    }
}

/// A twist whose components are the seeds.
fn varied(twist: &Twist) -> Twist<D> {
    let velocity = Vec2::new(D::variable(twist.velocity.x, 0), D::variable(twist.velocity.y, 1));
    Twist { velocity, omega: D::variable(twist.omega, 2) }
}

/// ∂/∂q and ∂/∂v of M a minus weight and centrifugal force, of one body: with s = A c′ and b = s⊥,
/// db/dφ = -s. Only φ and φ̇ enter.
fn inertial(body: &Body, motion: &Motion, g: Vec2, a: [f64; 3]) -> (Entries, Entries) {
    let s = motion.pose.global(body.center).scale(body.mass);
    let (b, omega) = (s.perp(), motion.twist.omega);
    let (mut stiffness, mut damping) = (ZERO, ZERO);
    stiffness[0][2] = -s.x * a[2] - b.x * omega * omega;
    stiffness[1][2] = -s.y * a[2] - b.y * omega * omega;
    stiffness[2][2] = -(s.x * a[0] + s.y * a[1]) - b.cross(g);
    damping[0][2] = -2.0 * s.x * omega;
    damping[1][2] = -2.0 * s.y * omega;
    (stiffness, damping)
}

/// Finds which bodies a constraint couples. Without laws that is seen at two poses without pattern: where
/// Φ_q of one body does not change with the other, no block is needed, as with every revolute joint.
struct Probe<'a> {
    lifted: &'a Model<D>,
    /// All bodies at the two poses.
    motions: [Vec<Motion<D>>; 2],
    columns: Vec<D>,
}

impl<'a> Probe<'a> {
    fn new(lifted: &'a Model<D>) -> Self {
        let bodies = lifted.bodies.len();
        let motions = [0, 1].map(|trial| (0..bodies).map(|b| without_pattern(b, trial)).collect());
        Self { lifted, motions, columns: vec![D::zero(); lifted.layout.n_entries] }
    }

    fn pairs(&mut self, k: usize, pairs: &mut Pairs) -> ByConstraint {
        let slots = &self.lifted.layout.constraints[k];
        let mut found = Vec::with_capacity(slots.blocks.len());
        for seed in &slots.blocks {
            let coupled = self.coupled(k, seed.body);
            let pair = |(to, coupled): (&Block, bool)| {
                coupled.then(|| pairs.index(to.body, seed.body)).flatten()
            };
            found.push(slots.blocks.iter().zip(coupled).map(pair).collect());
        }
        found
    }

    /// For each body of the constraint, whether its columns of Φ_q change with the pose of `seed`.
    fn coupled(&mut self, k: usize, seed: BodyId) -> Vec<bool> {
        let slots = &self.lifted.layout.constraints[k];
        let m = slots.rows.len();
        let mut coupled = vec![self.lifted.constraints[k].law.is_some(); slots.blocks.len()];
        for motions in &mut self.motions {
            let pose = motions[seed.0].pose;
            let (r, rotation) = (Vec2::new(pose.r.x.value, pose.r.y.value), pose.rotation);
            let rotation = Rotation { cos: rotation.cos.value, sin: rotation.sin.value };
            motions[seed.0].pose = seeded(&Pose { r, angle: pose.angle.value, rotation }, 0);
            let mut rows = [[D::zero(); MOST_EQUATIONS]; 3];
            let out = rows.each_mut().map(|rows| &mut rows[..m]);
            let time = D::lift(0.7);
            constraints::linearize_one(self.lifted, k, motions, time, out, &mut self.columns);
            motions[seed.0].pose = pose;
            for (to, coupled) in slots.blocks.iter().zip(&mut coupled) {
                let entries = &self.columns[to.first..][..3 * m];
                *coupled |= entries.iter().any(|e| e.slope != [0.0; 3]);
            }
        }
        coupled
    }
}

/// A motion of body `b` without derivatives; ground stands in the origin.
fn without_pattern(b: usize, trial: usize) -> Motion<D> {
    if b == 0 {
        return Motion { pose: Pose::identity(), twist: Twist::zero() };
    }
    let x = |k: usize| (1.0 + (7 * b + 3 * trial + k) as f64 * 0.618_034).sin();
    let twist = Twist { velocity: Vec2::new(x(3), x(4)), omega: x(5) };
    still(&Motion { pose: Pose::new(x(0), x(1), x(2)), twist })
}

/// What a force depends on: its ends, and the bodies that its laws name.
fn force_pairs(item: &ForceItem, pairs: &mut Pairs) -> ByForce {
    let ends = item.element.ends();
    let mut depends = Dependence::default();
    if let Some(law) = &item.law {
        law.map(&mut |tape| depends.add(tape));
    }
    let mut bodies: Vec<BodyId> = ends.into_iter().chain(depends.bodies).collect();
    bodies.retain(|body| !body.is_ground());
    bodies.sort_unstable();
    bodies.dedup();
    let pairs = bodies.iter().map(|body| ends.map(|end| pairs.index(end, *body))).collect();
    ByForce { bodies, pairs }
}
