//! The tangent of the equations of motion: derivatives of r = M a + Φ_qᵀ λ - Q, of Φ_q v + Φ_t, and of
//! the rates ż of first-order states.
//!
//! ```text
//! K = ∂r/∂q      D = ∂r/∂v      M = ∂r/∂a      B = ∂(Φ_q v + Φ_t)/∂q
//! ```
//!
//! The part of the bodies has a closed form. Constraints and forces, with their laws of time and state, are
//! differentiated with dual numbers for one owner of coordinates at a time, with the same code as the equations
//! themselves. K and D are stored as blocks (owner, owner); only the blocks of coupled owners exist. Few models have
//! derivatives with respect to states and multipliers; these are lists of [`Entry`].

use super::constraints;
use super::coupling::{self, Pairs, Participants};
use super::forces::{self, Acting};
use super::kinematics::Motions;
use super::mass::{self, MassBlock};
use super::{reactions, reactive};
use crate::elements::derive::{seeded, ByThree};
use crate::math::{each, Dual, Lift, Motion, Real, ShortArray, Twist, Vec2};
use crate::model::{Block, Body, Columns, Model, Slots};

type D = ByThree<f64>;
/// 3 × 3 entries, row by row.
type Entries = [[f64; 3]; 3];
const ZERO: Entries = [[0.0; 3]; 3];

/// The derivatives of one row or column of another kind for the three coordinates of one owner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The owner of coordinates.
    pub owner: usize,
    /// The index in z, or the row of Φ.
    pub at: usize,
    /// The derivatives, padded with zeros.
    pub values: [f64; 3],
}

/// Derivatives of and with respect to first-order states and multipliers.
#[derive(Clone, Debug, Default)]
pub struct ByStates {
    /// -∂Q/∂z.
    pub forces: Vec<Entry>,
    /// -∂Q/∂λ of forces that depend on reactions, and of the loads of joints.
    pub reactions: Vec<Entry>,
    /// ∂ż/∂q.
    pub by_position: Vec<Entry>,
    /// ∂ż/∂v.
    pub by_velocity: Vec<Entry>,
    /// ∂ż/∂z: row, column, value.
    pub by_state: Vec<(usize, usize, f64)>,
}

/// Derivatives of the equations of motion at one state.
#[derive(Clone, Debug)]
pub struct Tangent {
    lifted: Model<D>,
    motions: Motions<D>,
    z: Vec<D>,
    lam: Vec<D>,
    /// The two owners of each block, diagonal blocks first.
    pairs: Vec<(usize, usize)>,
    /// K, one block for each pair.
    pub stiffness: Vec<Entries>,
    /// D, one block for each pair.
    pub damping: Vec<Entries>,
    /// M.
    pub mass: Vec<MassBlock>,
    /// Φ_q, in the order of the layout.
    pub jacobian: Vec<f64>,
    /// B, in the order of the layout.
    pub rate: Vec<f64>,
    /// Derivatives of and with respect to states and multipliers.
    pub states: ByStates,
    /// Scratch memory: Φ_q over dual numbers.
    columns: Vec<D>,
    /// Scratch memory: ż over dual numbers.
    rates: Vec<D>,
    by_constraint: Vec<coupling::ByConstraint>,
    by_force: Vec<Participants>,
    /// Whether Q contains the loads of joints.
    loads: bool,
}

impl Tangent {
    /// Memory for a model, with the pattern of its couplings.
    pub fn new(model: &Model) -> Self {
        let lifted: Model<D> = model.lift();
        let (owners, n_z) = (model.layout.owners.len(), model.layout.n_z);
        let mut pairs = Pairs::diagonal(owners);
        let by_constraint = coupling::by_constraint(&lifted, &mut pairs);
        let by_force = coupling::by_force(model, &mut pairs);
        let pairs = pairs.listed();
        let nothing = MassBlock { mass: 0.0, coupling: Vec2::zero(), inertia: 0.0 };
        Self {
            motions: Motions::new(&model.layout),
            z: vec![D::zero(); n_z],
            lam: vec![D::zero(); model.layout.n_rows],
            stiffness: vec![ZERO; pairs.len()],
            damping: vec![ZERO; pairs.len()],
            mass: vec![nothing; model.bodies.len() - 1],
            jacobian: vec![0.0; model.layout.n_entries],
            rate: vec![0.0; model.layout.n_entries],
            states: ByStates::default(),
            columns: vec![D::zero(); model.layout.n_entries],
            rates: vec![D::zero(); n_z],
            lifted,
            pairs,
            by_constraint,
            by_force,
            loads: reactive::depends(model),
        }
    }

    /// The quantities on which each force depends.
    pub(super) fn participants(&self) -> &[Participants] {
        &self.by_force
    }

    /// The two owners of each block of K and D.
    pub fn pairs(&self) -> &[(usize, usize)] {
        &self.pairs
    }

    /// Computes all derivatives at a state. `a` has shape (n_q), `lam` (n_rows), `z` (n_z).
    pub fn linearize(
        &mut self,
        model: &Model,
        motions: &Motions,
        t: f64,
        [a, lam, z]: [&[f64]; 3],
    ) {
        self.stiffness.fill(ZERO);
        self.damping.fill(ZERO);
        self.states = ByStates::default();
        self.motions = motions.lift();
        self.z.iter_mut().zip(z).for_each(|(to, z)| *to = D::lift(*z));
        self.lam.iter_mut().zip(lam).for_each(|(to, lam)| *to = D::lift(*lam));
        let bodies = model.bodies.iter().zip(motions.iter()).zip(&model.layout.bodies).skip(1);
        for (b, ((body, motion), columns)) in bodies.enumerate() {
            self.mass[b] = mass::block(body, motion);
            let of_body = inertial(body, motion, model.gravity, columns.of(a));
            (self.stiffness[b], self.damping[b]) = of_body;
        }
        for (k, slots) in model.layout.constraints.iter().enumerate() {
            self.constraint(k, slots, motions, t, &lam[slots.rows.clone()]);
        }
        for k in 0..self.by_force.len() {
            self.force(k, motions, t);
        }
        if self.loads {
            self.loads_by_multipliers(model, motions, t, lam);
        }
    }

    /// Computes (M x - K s, y + ∂ż/∂q s, -B s) into `out`, shape (n_q + n_z + n_rows). x and s have shape (n_q), y
    /// has (n_z).
    pub fn times(&self, model: &Model, [x, y, s]: [&[f64]; 3], out: &mut [f64]) {
        let (upper, rest) = out.split_at_mut(x.len());
        let (states, lower) = rest.split_at_mut(y.len());
        states.copy_from_slice(y);
        for Entry { owner, at, values } in &self.states.by_position {
            let s = model.layout.owners[*owner].of(s);
            states[*at] += values.iter().zip(s).map(|(slope, s)| slope * s).sum::<f64>();
        }
        upper.fill(0.0);
        for (mass, columns) in self.mass.iter().zip(&model.layout.bodies[1..]) {
            columns.add(mass.times(columns.of(x)), upper);
        }
        for ((row, column), block) in self.pairs.iter().zip(&self.stiffness) {
            let s = model.layout.owners[*column].of(s);
            let product = each(*block, |k| -(k[0] * s[0] + k[1] * s[1] + k[2] * s[2]));
            model.layout.owners[*row].add(product, upper);
        }
        constraints::times_all(model, &self.rate, s, lower);
        lower.iter_mut().for_each(|row| *row = -*row);
    }

    /// Computes (Φ_qᵀ λ)_q, B and Φ_q of one constraint.
    fn constraint(&mut self, k: usize, slots: &Slots, motions: &Motions, t: f64, lam: &[f64]) {
        let m = lam.len();
        for (seed, block) in slots.blocks.iter().enumerate() {
            self.seed(block, slots, motions);
            let (lifted, columns, rate) = (&self.lifted, &mut self.columns, &mut self.rate);
            constraints::linearize_one(lifted, k, &self.motions, D::lift(t), &mut |terms, rows| {
                for (r, slope) in terms.rate.iter().enumerate() {
                    rate[block.row(r)].copy_from_slice(&slope.slope);
                }
                constraints::store(rows, slots, columns);
            });
            self.load(k, slots, t, seed);
            self.unseed(block, slots, motions);
            for (to, pair) in slots.blocks.iter().zip(&self.by_constraint[k][seed]) {
                let Some(pair) = *pair else { continue };
                for (r, lam) in lam.iter().enumerate() {
                    let entries = &self.columns[to.row(r)];
                    add(&mut self.stiffness[pair], [&entries[0], &entries[1], &entries[2]], *lam);
                }
            }
        }
        for block in &slots.blocks {
            let range = block.entries(m);
            let values = self.columns[range.clone()].iter();
            self.jacobian[range].iter_mut().zip(values).for_each(|(e, d)| *e = d.value);
        }
    }

    /// Computes derivatives of the load of one constraint with respect to the coordinates of the seeded block.
    fn load(&mut self, k: usize, slots: &Slots, t: f64, seed: usize) {
        let Self { lifted, motions, lam, by_constraint, stiffness, loads, .. } = self;
        if !*loads || !lifted.constraints[k].element.has_load() {
            return;
        }
        let lam = &lam[slots.rows.clone()];
        reactions::each_load(lifted, k, motions, D::lift(t), lam, |body, w| {
            let to = slots.blocks.iter().position(|block| block.body == Some(body));
            if let Some(pair) = to.and_then(|to| by_constraint[k][seed][to]) {
                add(&mut stiffness[pair], [&w.force.x, &w.force.y, &w.torque], -1.0);
            }
        });
    }

    /// Computes derivatives of the loads of all constraints with respect to their multipliers.
    fn loads_by_multipliers(&mut self, model: &Model, motions: &Motions, t: f64, lam: &[f64]) {
        for k in reactions::loaded(model) {
            let slots = &model.layout.constraints[k];
            for row in slots.rows.clone() {
                let mut column = vec![0.0; model.layout.n_q];
                reactions::add_load_slopes(model, motions, t, (lam, row), &mut column);
                for block in &slots.blocks {
                    let of = model.layout.owners[block.owner].of(&column);
                    let values = of.each(|slope| -slope);
                    self.states.reactions.push(Entry { owner: block.owner, at: row, values });
                }
            }
        }
    }

    /// Seeds the coordinates of the owner of a block.
    fn seed(&mut self, block: &Block, slots: &Slots, motions: &Motions) {
        match block.body {
            Some(body) => self.motions.body_mut(body.0).pose = seeded(&motions[body.0].pose),
            None => {
                let (own, _) = self.motions.own_mut(slots.own);
                let own = own.iter_mut().enumerate();
                own.for_each(|(k, u)| *u = Dual::variable(u.value, k));
            }
        }
    }

    /// Removes the seeds.
    fn unseed(&mut self, block: &Block, slots: &Slots, motions: &Motions) {
        match block.body {
            Some(body) => *self.motions.body_mut(body.0) = motions[body.0].lift(),
            None => {
                let (own, _) = self.motions.own_mut(slots.own);
                own.iter_mut().for_each(|u| *u = D::lift(u.value));
            }
        }
    }

    /// Computes derivatives of one force, and of the rates of its states.
    fn force(&mut self, k: usize, motions: &Motions, t: f64) {
        for b in 0..self.by_force[k].bodies.len() {
            let body = self.by_force[k].bodies[b].0;
            self.motions.body_mut(body).pose = seeded(&motions[body].pose);
            self.differentiate(k, t, Variable::Position(b));
            *self.motions.body_mut(body) = motions[body].lift();
            self.motions.body_mut(body).twist = varied(&motions[body].twist);
            self.differentiate(k, t, Variable::Velocity(b));
            *self.motions.body_mut(body) = motions[body].lift();
        }
        for i in 0..self.by_force[k].internals.len() {
            let (b, columns) = (self.by_force[k].bodies.len() + i, self.by_force[k].internals[i].1);
            for (by, which) in [(Variable::Position(b), 0), (Variable::Velocity(b), 1)] {
                self.seed_internal(columns, which, true);
                self.differentiate(k, t, by);
                self.seed_internal(columns, which, false);
            }
        }
        for s in 0..self.by_force[k].states.len() {
            let at = self.by_force[k].states[s];
            let z = self.z[at].value;
            self.z[at] = Dual::variable(z, 0);
            self.differentiate(k, t, Variable::State(at));
            self.z[at] = D::lift(z);
        }
        for row in self.by_force[k].rows.clone() {
            let lam = self.lam[row].value;
            self.lam[row] = Dual::variable(lam, 0);
            self.differentiate(k, t, Variable::Multiplier(row));
            self.lam[row] = D::lift(lam);
        }
    }

    /// Seeds internal coordinates or their rates, or removes the seeds.
    fn seed_internal(&mut self, columns: Columns, which: usize, seeds: bool) {
        let (own, rates) = self.motions.own_mut(columns);
        let all = [own, rates][which].iter_mut().enumerate();
        all.for_each(|(k, u)| *u = if seeds { D::variable(u.value, k) } else { D::lift(u.value) });
    }

    /// Computes derivatives of one force and its states with respect to the seeded variable.
    fn differentiate(&mut self, k: usize, t: f64, by: Variable) {
        let Self { lifted, motions, z, lam, by_force, rates, .. } = self;
        let acting = Acting { z, lam: Some(lam), t: D::lift(t) };
        let own = &by_force[k];
        forces::each_wrench(lifted, k, motions, acting, |_, body, w| {
            if body.is_ground() {
                return;
            }
            let rows = [&w.force.x, &w.force.y, &w.torque];
            let entry = |at| {
                let values = each(rows, |row| -row.slope[0]);
                Entry { owner: body.0 - 1, at, values }
            };
            match by {
                Variable::Position(b) => own
                    .pair(b, body)
                    .into_iter()
                    .for_each(|pair| add(&mut self.stiffness[pair], rows, -1.0)),
                Variable::Velocity(b) => own
                    .pair(b, body)
                    .into_iter()
                    .for_each(|pair| add(&mut self.damping[pair], rows, -1.0)),
                Variable::State(at) => self.states.forces.push(entry(at)),
                Variable::Multiplier(row) => self.states.reactions.push(entry(row)),
            }
        });
        let states = lifted.layout.states[k].clone();
        if states.is_empty() {
            return;
        }
        forces::state_rates_of(lifted, k, motions, acting, &mut rates[states.clone()]);
        for at in states {
            let slope = rates[at].slope;
            let owner = |b: usize| own.owners().nth(b).expect("it is one of them");
            let of = |b: usize| Entry { owner: owner(b), at, values: slope };
            match by {
                Variable::Position(b) => self.states.by_position.push(of(b)),
                Variable::Velocity(b) => self.states.by_velocity.push(of(b)),
                Variable::State(column) => self.states.by_state.push((at, column, slope[0])),
                Variable::Multiplier(_) => {} // rates of states do not depend on multipliers
            }
        }
    }
}

/// The variable with respect to which a force is differentiated.
#[derive(Clone, Copy)]
enum Variable {
    /// The pose of the body, or the internal coordinates, with this index among the participants.
    Position(usize),
    /// The twist of the body, or the internal rates, with this index among the participants.
    Velocity(usize),
    /// The state with this index in z.
    State(usize),
    /// The multiplier of this row.
    Multiplier(usize),
}

/// block += factor × derivatives of its rows.
fn add(block: &mut Entries, rows: [&D; 3], factor: f64) {
    for (out, row) in block.iter_mut().zip(rows) {
        out.iter_mut().zip(row.slope).for_each(|(out, slope)| *out += factor * slope);
    }
}

/// A twist whose components are seeded.
fn varied(twist: &Twist) -> Twist<D> {
    let velocity = Vec2::new(D::variable(twist.velocity.x, 0), D::variable(twist.velocity.y, 1));
    Twist { velocity, omega: D::variable(twist.omega, 2) }
}

/// Derivatives with respect to q and v of M a minus weight and centrifugal force, of one body. With s = A c′ and b =
/// s⊥, db/dφ = -s. Only φ and φ̇ occur.
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
