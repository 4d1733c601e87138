//! Every force in a model with ground: wrenches, powers and dissipation, and the tangent against differences.
//!
//! Of -Q only the part of the force is compared: the residual with it minus that without it.

use crate::mechanisms::{close, model, Random};
use crate::samples::forces;
use kempe::elements::{states_of, BodyId, ForceElement, OwnState};
use kempe::equations::balance::Balance;
use kempe::equations::forces::{each_wrench, potential, Acting};
use kempe::equations::kinematics::Motions;
use kempe::equations::tangent::{Entry, Tangent};
use kempe::expression::Tape;
use kempe::math::Vec2;
use kempe::model::Model;
use std::sync::Arc;

/// Two bodies on a chain from ground, frames off the mass centres; samples refer to them and to the first joint.
const CHAIN: &str = r#"
[bodies.ground]
points = { O = [0.1, -0.2] }
[bodies.one]
mass = 1.5
inertia = 0.2
center = [0.3, -0.2]
points = { O = [0.1, 0], B = [1, 0.3] }
[bodies.two]
mass = 2
inertia = 0.4
center = [-0.1, 0.25]
points = { B = [-0.5, 0.1] }
[joints.between]
type = "revolute"
i = "one.B"
j = "two.B"
[joints.base]
type = "revolute"
i = "ground.O"
j = "one.O"
"#;
const T: f64 = 0.7;
const H: f64 = 1e-5;
/// States of each sample.
const STATES: u64 = 10;

/// The chain with one force.
fn with(force: &ForceElement) -> Model {
    let chain = model(CHAIN);
    let all = states_of(force.kind(), &|_| Some(""));
    let build = |states: &'static [OwnState]| {
        let mut blueprint = (*chain.blueprint).clone();
        let element = force.map(&mut |x| Tape::from(*x));
        Arc::make_mut(&mut blueprint.forces).push(("sample".into(), states, element));
        Model::new(&Arc::new(blueprint), &[])
    };
    let m = build(all);
    // without its field a state does not exist, and its rate divides by zero
    let finite = At::random(&m, 1).balance(&m).state_rates.iter().all(|rate| rate.is_finite());
    if finite {
        m
    } else {
        build(&[])
    }
}

#[derive(Clone)]
struct At {
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    z: Vec<f64>,
    lam: Vec<f64>,
}

impl At {
    fn random(m: &Model, seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut many = |n: usize| random.many(n);
        let n = m.layout.n_q;
        Self {
            q: many(n),
            v: many(n),
            a: many(n),
            z: many(m.layout.n_z),
            lam: many(m.layout.n_rows),
        }
    }

    fn balance(&self, m: &Model) -> Balance {
        let mut balance = Balance::new(m);
        let z = &self.z[..m.layout.n_z];
        balance.evaluate(m, T, [&self.q, &self.v, &self.a, z], &self.lam);
        balance
    }

    fn acting(&self) -> Acting<'_, f64> {
        Acting { z: &self.z, lam: Some(&self.lam), t: T }
    }

    fn motions(&self, m: &Model) -> Motions {
        Motions::at(&m.layout, &self.q, &self.v)
    }

    /// -Q of the force, and ż.
    fn loads(&self, m: &Model, chain: &Model) -> Vec<f64> {
        let (all, others) = (self.balance(m), self.balance(chain));
        let parts = all.forces.iter().zip(&others.forces).map(|(all, other)| all - other);
        parts.chain(all.state_rates).collect()
    }
}

/// Calls `check` for each sample at random states, with the chain that has no force.
fn each(mut check: impl FnMut(&str, &Model, &Model, &At)) {
    let chain = model(CHAIN);
    for force in forces() {
        let m = with(&force);
        for seed in 1..=STATES {
            check(force.kind(), &m, &chain, &At::random(&m, seed));
        }
    }
}

#[test]
fn wrenches_cancel_over_bodies_and_ground() {
    each(|kind, m, _, at| {
        let (mut force, mut moment, mut size) = (Vec2::zero(), 0.0, 0.0);
        let motions = at.motions(m);
        each_wrench(m, 0, &motions, at.acting(), |_, body: BodyId, w| {
            force = force + w.force;
            moment += w.torque + motions[body.0].pose.r.cross(w.force);
            size += w.force.norm() + w.torque.abs();
        });
        close(kind, force.norm() + moment.abs(), 0.0, 1e-13 * (1.0 + size));
    });
}

/// Power of the wrenches + V̇ + dissipated - applied = 0. So a potential force has the power -V̇.
#[test]
fn all_power_of_a_force_is_accounted_for() {
    each(|kind, m, chain, at| {
        let balance = at.balance(m);
        let loads = at.loads(m, chain);
        let power: f64 = loads.iter().zip(&at.v).map(|(load, v)| -load * v).sum();
        let stored = |h: f64| {
            let mut later = at.clone();
            later.q.iter_mut().zip(&at.v).for_each(|(q, v)| *q += h * v);
            later.z.iter_mut().zip(&balance.state_rates).for_each(|(z, rate)| *z += h * rate);
            potential(m, 0, &later.motions(m), later.acting())
        };
        let rate = (stored(H) - stored(-H)) / (2.0 * H);
        let own = balance.powers;
        close(kind, power + rate + own.dissipated - own.applied, 0.0, 1e-8);
    });
}

#[test]
fn no_force_dissipates_a_negative_power() {
    each(|kind, m, _, at| {
        let dissipated = at.balance(m).powers.dissipated;
        assert!(dissipated >= 0.0, "{kind}: {dissipated}");
    });
}

/// Entries of a list as a full matrix: row `at`, a column for each coordinate.
fn full(entries: &[Entry], rows: usize, m: &Model) -> Vec<Vec<f64>> {
    let mut out = vec![vec![0.0; m.layout.n_q]; rows];
    for entry in entries {
        for (k, value) in entry.values.iter().enumerate() {
            if let Some(entry_value) = out[entry.at].get_mut(3 * entry.owner + k) {
                *entry_value += value;
            }
        }
    }
    out
}

/// K and D as full matrices.
fn blocks(m: &Model, tangent: &Tangent) -> [Vec<Vec<f64>>; 2] {
    [&tangent.stiffness, &tangent.damping].map(|blocks| {
        let mut out = vec![vec![0.0; m.layout.n_q]; m.layout.n_q];
        for ((row, column), block) in tangent.pairs().iter().zip(blocks) {
            for (r, values) in block.iter().enumerate() {
                for (c, value) in values.iter().enumerate() {
                    out[3 * row + r][3 * column + c] += value;
                }
            }
        }
        out
    })
}

fn tangent_at(m: &Model, at: &At) -> Tangent {
    let mut tangent = Tangent::new(m);
    tangent.linearize(m, &at.motions(m), T, [&at.a, &at.lam, &at.z[..m.layout.n_z]]);
    tangent
}

/// -∂Q/∂q, -∂Q/∂v, -∂Q/∂z, -∂Q/∂λ, and the derivatives of ż.
#[test]
fn the_tangent_of_every_force_agrees_with_differences() {
    each(|kind, m, chain, at| {
        let (n, n_z) = (m.layout.n_q, m.layout.n_z);
        let difference = |change: &dyn Fn(&mut At, f64)| -> Vec<f64> {
            let moved = |h: f64| {
                let mut moved = at.clone();
                change(&mut moved, h);
                moved.loads(m, chain)
            };
            let (above, below) = (moved(H), moved(-H));
            above.iter().zip(below).map(|(a, b)| (a - b) / (2.0 * H)).collect()
        };
        let (tangent, bare) = (tangent_at(m, at), tangent_at(chain, at));
        let (with_force, without) = (blocks(m, &tangent), blocks(chain, &bare));
        let rates = [&tangent.states.by_position, &tangent.states.by_velocity];
        for (k, by) in rates.map(|entries| full(entries, n_z, m)).into_iter().enumerate() {
            for c in 0..n {
                let change = |at: &mut At, h: f64| [&mut at.q, &mut at.v][k][c] += h;
                let expected = difference(&change);
                for r in 0..n {
                    let found = with_force[k][r][c] - without[k][r][c];
                    close(kind, found, expected[r], 1e-7 * (1.0 + found.abs()));
                }
                for r in 0..n_z {
                    close(kind, by[r][c], expected[n + r], 1e-7 * (1.0 + by[r][c].abs()));
                }
            }
        }
        let by_state = full(&tangent.states.forces, n_z, m);
        for (c, column) in by_state.iter().enumerate() {
            let expected = difference(&|at, h| at.z[c] += h);
            (0..n).for_each(|r| close(kind, column[r], expected[r], 1e-7));
            for r in 0..n_z {
                let listed = tangent.states.by_state.iter().filter(|e| (e.0, e.1) == (r, c));
                close(kind, listed.map(|e| e.2).sum(), expected[n + r], 1e-7);
            }
        }
        let by_reaction = full(&tangent.states.reactions, m.layout.n_rows, m);
        for (c, column) in by_reaction.iter().enumerate() {
            let expected = difference(&|at, h| at.lam[c] += h);
            (0..n).for_each(|r| close(kind, column[r], expected[r], 1e-7));
        }
    });
}
