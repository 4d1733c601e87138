//! Bodies and coordinates with little or no inertia, and the inertia with which M can be inverted block by block.
//!
//! A coordinate without inertia gets a small one, E, in the matrix P = K + E that is factorised in place of the matrix
//! K of the equations. `equations/refine.rs` removes its effect: each correction x ← x + P⁻¹ (b - K x) multiplies the
//! error by about E / (inertia that moves with the coordinate). A coordinate with which no inertia moves keeps a
//! remainder if a load acts on it, which is an error.
//!
//! A light body needs no E. Rounding errors of its elimination are as large as the ratio of masses, and the same
//! corrections remove them. In the pivot tests it counts with the mass of its surroundings (`solve/reference.rs`).
//!
//! A body is light if it transmits loads between heavier bodies. A branch of a body is the part of the mechanism to
//! which one of its joints leads; ground is a branch of infinite mass. Only the load of the second heaviest branch
//! passes through the body. A light pendulum on a heavy cart is not light in this sense, because it has only one
//! branch. A watch beside a locomotive is not either, because no joint connects them. If two branches lead to ground,
//! the heaviest connected body counts.

use super::inertia::{self, Inertia};
use crate::elements::QuantityKind;
use crate::math::{each, Listed, Ordered, Real};
use crate::model::{Block, Body, ConstraintItem, Model, Slots, Weighed};

/// Mass, relative to the bodies between which a body lies, below which the body is light.
const LIGHT: f64 = 1e-2;
/// Mass, relative to the same bodies, with which a light body counts in the pivot tests. The pivots of its joints are
/// then about so small a fraction of their terms. A smaller mass would make them look like those of singular positions,
/// a larger one would make the ridge near singular positions too small.
pub(super) const COUNTED: f64 = 2e-2;
/// Mass, relative to the same bodies, below which a body counts as massless. Its elimination would lose all digits.
const MASSLESS: f64 = 1e-14;
/// E relative to the bodies at the joints of a massless body: the geometric mean of the lightest and the heaviest. A
/// larger E needs more corrections, a smaller one loses more digits.
pub(super) const FLOOR: f64 = 1e-8;
/// Factor on both limits for moments of inertia relative to m l². A slender bar has 1/12 of m l².
const TURNING: f64 = 0.1;

/// The inertias of a model in the matrix, and its light bodies and coordinates.
#[derive(Clone, Debug)]
pub struct Light<S> {
    /// Inertia of all bodies with E, ground first.
    pub(super) bodies: Vec<Weighed<S>>,
    /// Inertia of the moving bodies with E.
    pub(super) inertias: Vec<Inertia<S>>,
    /// For each moving body, E: mass, kg, and moment of inertia about the mass centre, kg·m².
    pub(super) added: Vec<[f64; 2]>,
    /// For each moving body, its mass and its moment of inertia relative to those with which it counts in pivot tests;
    /// 1 if it is not light.
    pub ratios: Vec<[f64; 2]>,
    pub(super) internals: Vec<Internal>,
    /// Whether any coordinate is light, so that one elimination is not exact.
    pub any: bool,
}

/// The internal coordinates of an element. Their E is Σ w Φ_u² over the rows of the element, so that it does not depend
/// on the unit of the coordinate.
#[derive(Clone, Debug)]
pub(super) struct Internal {
    /// Their index among the owners of coordinates.
    pub owner: usize,
    /// Their number.
    pub size: usize,
    /// The rows of three entries of Φ_q, and w: kg, or kg·m² for a row in rad.
    pub rows: Vec<(usize, f64)>,
}

impl<S: Real> Light<S> {
    /// The light bodies and coordinates of a model.
    pub(super) fn new(model: &Model<S>) -> Self {
        let all = Bodies::new(model);
        let mut bodies: Vec<_> = model.bodies.iter().map(weighed).list();
        let (mut added, mut ratios) = (Vec::new(), Vec::new());
        for (k, own) in bodies.iter_mut().enumerate().skip(1) {
            let found = all.light(k, model.bodies[k].turns);
            own.mass += S::constant(found.added[0]);
            own.inertia += S::constant(found.added[1]);
            added.push(found.added);
            ratios.push(found.ratios);
        }
        let inertias = inertia::inertias(model, &bodies);
        let internals = internals(model, &all);
        let any = !internals.is_empty() || ratios.iter().any(|ratios| *ratios != [1.0; 2]);
        Self { bodies, inertias, added, ratios, internals, any }
    }
}

impl Internal {
    /// E of each coordinate, from the rows of three entries of Φ_q.
    #[inline]
    pub fn inertia<S: Real>(&self, entries: impl Fn(usize) -> [S; 3]) -> [S; 3] {
        let mut sums = [S::zero(); 3];
        let mut least = 0.0;
        for (row, weight) in &self.rows {
            let entries = entries(*row);
            for (sum, entry) in sums.iter_mut().zip(entries) {
                *sum += entry * entry * S::constant(*weight);
            }
            least = f64::max(least, *weight);
        }
        each(sums, |sum| S::select(sum, sum, S::constant(least)))
    }
}

/// The internal coordinates of all elements.
fn internals<S: Real>(model: &Model<S>, all: &Bodies) -> Vec<Internal> {
    let of_element = |(item, slots): (&ConstraintItem<S>, &Slots)| {
        let own = |block: &&Block| slots.own.count > 0 && block.columns == slots.own;
        let block = slots.blocks.iter().find(own)?;
        let touched = |of: &[f64]| {
            let own = mean(item.bodies.iter().map(|body| of[body.0]));
            FLOOR * own.or_else(|| mean(of.iter().copied())).unwrap_or(1.0)
        };
        let weights = [touched(&all.mass), touched(&all.turning)];
        let rows = item.equations.iter().enumerate().map(|(k, equation)| {
            (block.first / 3 + k, weights[usize::from(equation.kind != QuantityKind::Length)])
        });
        Some(Internal { owner: block.owner, size: slots.own.count, rows: rows.list() })
    };
    model.constraints.iter().zip(&model.layout.constraints).filter_map(of_element).list()
}

/// The geometric mean of the least and the largest positive mass.
fn mean(masses: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let positive = masses.filter(|mass| *mass > 0.0);
    let least = positive.clone().reduce(f64::min)?;
    Some((least * positive.reduce(f64::max)?).sqrt())
}

/// The own inertia of a body.
fn weighed<S: Real>(body: &Body<S>) -> Weighed<S> {
    let Body { mass, center, inertia, .. } = *body;
    Weighed { mass, center, inertia }
}

/// What [`Light`] says of one body.
struct Found {
    added: [f64; 2],
    ratios: [f64; 2],
}

/// The inertias of the bodies as numbers, and the joints between the bodies.
struct Bodies {
    mass: Vec<f64>,
    inertia: Vec<f64>,
    /// Square of the distance of the farthest joint point from the mass centre, m².
    reach: Vec<f64>,
    /// The larger of J and m l², kg·m².
    turning: Vec<f64>,
    /// The largest mass, and the largest of `turning`.
    most: [f64; 2],
    /// The bodies of each joint and driver, and whether the joint is a pin.
    joints: Vec<(Vec<usize>, bool)>,
    /// The joints of each body.
    of_body: Vec<Vec<usize>>,
}

/// The largest inertia of the branch to which a joint leads, and whether the branch contains ground.
#[derive(Clone, Copy, Default)]
struct Branch {
    mass: f64,
    inertia: f64,
    grounded: bool,
}

impl Bodies {
    fn new<S: Real>(model: &Model<S>) -> Self {
        let n = model.bodies.len();
        let mut reach = vec![0.0_f64; n];
        let (mut joints, mut of_body) = (Vec::new(), vec![Vec::new(); n]);
        for (k, item) in model.constraints.iter().enumerate() {
            for (place, end) in item.bodies.iter().enumerate() {
                let arm = item.element.attachment(place).s - model.bodies[end.0].center;
                reach[end.0] = reach[end.0].max(number(arm.dot(arm)));
            }
            let blocks = &model.layout.constraints[k].blocks;
            let moving = blocks.iter().filter_map(|block| block.body.map(|body| body.0));
            let ground = item.bodies.iter().filter(|body| body.is_ground()).map(|body| body.0);
            let mut members: Vec<usize> = moving.chain(ground).list();
            members.sort_unstable();
            members.dedup();
            members.iter().for_each(|body| of_body[*body].push(k));
            joints.push((members, blocks.iter().all(|block| block.sign != 0.0)));
        }
        let of = |f: &dyn Fn(&Body<S>) -> S| model.bodies.iter().map(|b| number(f(b))).list();
        let (mass, inertia): (Vec<f64>, Vec<f64>) = (of(&|b| b.mass), of(&|b| b.inertia));
        let turning: Vec<f64> = (0..n).map(|k| inertia[k].max(mass[k] * reach[k])).list();
        let most = each([&mass, &turning], |own| own.iter().copied().fold(0.0, f64::max));
        Self { mass, inertia, reach, turning, most, joints, of_body }
    }

    /// E and the ratios of a moving body.
    fn light(&self, k: usize, turns: bool) -> Found {
        let (mass, inertia) = (self.mass[k], self.inertia[k]);
        let [most, turning] = self.most;
        let least = TURNING * LIGHT * turning.max(most * self.reach[k]);
        let heavy = mass > 0.0 && mass >= LIGHT * most;
        let mut found = Found { added: [0.0; 2], ratios: [1.0; 2] };
        if heavy && (!turns || inertia > 0.0 && inertia >= least) {
            return found;
        }
        let between = self.between(k);
        let beside = self.beside(k).unwrap_or(between[0]);
        let turning = if self.reach[k] > 0.0 { beside * self.reach[k] } else { between[1] };
        let kinds = [(mass, between[0], 1.0, beside), (inertia, between[1], TURNING, turning)];
        for (kind, (own, between, part, beside)) in kinds.into_iter().enumerate() {
            let own = if own > MASSLESS * between { own } else { 0.0 };
            if own > 0.0 && own >= LIGHT * part * between || kind == 1 && !turns {
                continue;
            }
            found.added[kind] = if own > 0.0 { 0.0 } else { FLOOR * beside };
            let counted = COUNTED * part * between;
            found.ratios[kind] = ((own + found.added[kind]) / counted).min(1.0);
        }
        found
    }

    /// The mean mass of body `k` and those that joints connect with it. None if none has mass.
    fn beside(&self, k: usize) -> Option<f64> {
        let joined = self.of_body[k].iter().flat_map(|joint| &self.joints[*joint].0);
        mean(joined.filter(|body| **body > 0).map(|body| self.mass[*body]))
    }

    /// The mass and the moment of inertia relative to which body `k` is light. Zero if it does not lie between other
    /// bodies, except that a body without mass or inertia always has a positive value.
    fn between(&self, k: usize) -> [f64; 2] {
        let mut label = vec![usize::MAX; self.mass.len()];
        let mut branches: Vec<Branch> = Vec::new();
        let (mut light, mut turned) = (Vec::new(), vec![(self.mass[k], self.mass[k])]);
        let mut turning = Vec::new();
        for &joint in &self.of_body[k] {
            let mut found = Branch::default();
            for &start in self.joints[joint].0.iter().filter(|body| **body != k) {
                let own = match label[start] {
                    _ if start == 0 => Branch { grounded: true, ..Branch::default() },
                    usize::MAX => {
                        branches.push(self.spread(k, start, branches.len(), &mut label));
                        branches[branches.len() - 1]
                    }
                    known => branches[known],
                };
                found = found.joined(own);
            }
            light.push(found.of(found.mass));
            turned.push(found.of(found.mass));
            if !self.joints[joint].1 {
                turning.push(found.of(found.inertia));
            }
        }
        let arm = self.reach[k];
        let mass = second(light);
        let inertia = (second(turned) * arm).max(second(turning));
        let all = branches.iter().fold(Branch::default(), |all, branch| all.joined(*branch));
        let or = |x: f64, others: [f64; 3]| {
            let mut candidates = std::iter::once(x).chain(others);
            candidates.find(|x| *x > 0.0).unwrap_or(1.0)
        };
        [
            if self.mass[k] > 0.0 { mass } else { or(mass, [all.mass, self.most[0], 1.0]) },
            match self.inertia[k] > 0.0 {
                true => inertia,
                false => {
                    or(inertia, [self.mass[k].max(all.mass) * arm, self.most[1], self.mass[k]])
                }
            },
        ]
    }

    /// Labels the bodies that joints connect with `start`, except body `k` and ground. Returns their branch.
    fn spread(&self, k: usize, start: usize, name: usize, label: &mut [usize]) -> Branch {
        let (mut found, mut next) = (Branch::default(), vec![start]);
        label[start] = name;
        while let Some(body) = next.pop() {
            let own =
                Branch { mass: self.mass[body], inertia: self.turning[body], grounded: false };
            found = found.joined(own);
            for &other in self.of_body[body].iter().flat_map(|joint| &self.joints[*joint].0) {
                if other == 0 {
                    found.grounded = true;
                } else if other != k && label[other] == usize::MAX {
                    label[other] = name;
                    next.push(other);
                }
            }
        }
        found
    }
}

impl Branch {
    fn joined(self, other: Self) -> Self {
        Self {
            mass: self.mass.max(other.mass),
            inertia: self.inertia.max(other.inertia),
            grounded: self.grounded || other.grounded,
        }
    }

    /// The weight of the branch, infinite for ground, and the finite number that replaces an infinite weight.
    fn of(&self, finite: f64) -> (f64, f64) {
        (if self.grounded { f64::INFINITY } else { finite }, finite)
    }
}

/// The second largest weight. If it is infinite, the largest of all finite numbers.
fn second(mut branches: Vec<(f64, f64)>) -> f64 {
    branches.order_by(|a, b| b.0.total_cmp(&a.0));
    match branches.get(1) {
        None => 0.0,
        Some((weight, _)) if weight.is_finite() => *weight,
        Some(_) => branches.iter().map(|(_, finite)| *finite).fold(0.0, f64::max),
    }
}

/// The value of a number that is equal in all lanes.
pub(super) fn number<S: Real>(x: S) -> f64 {
    x.largest_magnitude()
}
