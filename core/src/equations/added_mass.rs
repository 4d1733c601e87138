//! Finds the light bodies, and the inertia with which M can be inverted block by block without loss of digits.
//!
//! Light bodies borrow this inertia from their neighbours, or it is added (`equations/lending.rs`).
//!
//! A body is light if it transmits loads between heavier bodies. A branch of a body is the part of the mechanism to
//! which one of its joints leads; ground is a branch of infinite mass. Only the load of the second heaviest branch
//! passes through the body. A light pendulum on a heavy cart needs no addition, because it has only one branch. A
//! watch beside a locomotive needs none either, because no joint connects them. If two branches lead to ground, the
//! heaviest connected body counts.

use super::loose::loose;
use crate::math::Real;
use crate::model::{Body, Model};

/// Mass, relative to the bodies between which a body lies, below which the body is light. The pivots of its joints are
/// about so small a fraction of their terms. At a fifth of this value they would be examined for singular positions
/// (`solve/regularised.rs`), which takes longer than the elimination.
const LIGHT: f64 = 1e-2;
/// The same for light bodies with [freedoms of their own](loose()).
const LIGHT_LOOSE: f64 = 1e-3;
/// Mass of a light body after the addition, relative to the same bodies.
const FLOOR: f64 = 2e-2;
/// Factor on both limits for moments of inertia relative to m l². A slender bar has 1/12 of m l².
const TURNING: f64 = 0.1;
/// Limit below which a body is light for implicit methods. Their matrix contains the additions, and Newton's
/// iteration removes their effect, so that they must be small.
const LIGHT_IMPLICIT: f64 = 1e-12;
/// Mass of such a body after the addition.
const FLOOR_IMPLICIT: f64 = 1e-9;
/// Mass of the internal coordinates of elements, relative to the heaviest body.
const OWN: f64 = 1e-4;
/// Mass of the internal coordinates in the matrix of implicit methods.
const OWN_IMPLICIT: f64 = 1e-7;

/// Mass, kg, and moment of inertia about the mass centre, kg·m², that a light body needs; zero for other bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Added {
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia, kg·m².
    pub inertia: f64,
}

impl Added {
    /// Whether the body is light.
    pub fn any(&self) -> bool {
        self.mass > 0.0 || self.inertia > 0.0
    }
}

/// The inertia that each body needs, ground first, for the solution of the equations of motion.
pub(super) fn added<S: Real>(model: &Model<S>) -> Vec<Added> {
    let mut added = additions(model, LIGHT, FLOOR);
    let light: Vec<bool> = added.iter().map(Added::any).collect();
    let loose = loose(model, &light);
    if loose.contains(&true) {
        let other = additions(model, LIGHT_LOOSE, FLOOR);
        let bodies = added.iter_mut().zip(other).zip(loose).filter(|(_, loose)| *loose);
        bodies.for_each(|((added, other), _)| *added = other);
    }
    added
}

/// The inertia that each body needs, ground first, in the matrix of implicit methods.
pub(super) fn added_implicit(model: &Model) -> Vec<Added> {
    additions(model, LIGHT_IMPLICIT, FLOOR_IMPLICIT)
}

/// Mass added to the internal coordinates of elements, kg.
pub(super) fn own_mass<S: Real>(bodies: &[Body<S>]) -> f64 {
    let heaviest = bodies.iter().map(|body| number(body.mass)).fold(0.0, f64::max);
    OWN * if heaviest > 0.0 { heaviest } else { 1.0 }
}

/// Mass added to the internal coordinates in the matrix of implicit methods, kg.
pub(super) fn own_mass_implicit(bodies: &[Body]) -> f64 {
    own_mass(bodies) * (OWN_IMPLICIT / OWN)
}

fn additions<S: Real>(model: &Model<S>, light: f64, floor: f64) -> Vec<Added> {
    let all = Bodies::new(model);
    let most = all.mass.iter().copied().fold(0.0, f64::max);
    let turning = all.turning.iter().copied().fold(0.0, f64::max);
    let moving = 1..model.bodies.len();
    let one = |k: usize| {
        let (mass, inertia, turns) = (all.mass[k], all.inertia[k], model.bodies[k].turns);
        let least = TURNING * light * turning.max(most * all.reach[k]);
        if mass > 0.0 && mass >= light * most && (!turns || inertia > 0.0 && inertia >= least) {
            return Added::default();
        }
        let between = all.between(k);
        let scale = [(mass, between[0], 1.0), (inertia, between[1], TURNING)];
        let [mass, inertia] = scale.map(|(own, between, part)| match own {
            0.0 => floor * part * between,
            _ if own < light * part * between => floor * part * between,
            _ => 0.0,
        });
        Added { mass, inertia: if turns { inertia } else { 0.0 } }
    };
    std::iter::once(Added::default()).chain(moving.map(one)).collect()
}

/// The inertias of the bodies as numbers, and the joints between the bodies.
struct Bodies {
    mass: Vec<f64>,
    inertia: Vec<f64>,
    /// Square of the distance of the farthest joint point from the mass centre, m².
    reach: Vec<f64>,
    /// The larger of J and m l², kg·m².
    turning: Vec<f64>,
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
            let mut members: Vec<usize> = moving.chain(ground).collect();
            members.sort_unstable();
            members.dedup();
            members.iter().for_each(|body| of_body[*body].push(k));
            joints.push((members, blocks.iter().all(|block| block.sign != 0.0)));
        }
        let of = |f: &dyn Fn(&Body<S>) -> S| model.bodies.iter().map(|b| number(f(b))).collect();
        let (mass, inertia): (Vec<f64>, Vec<f64>) = (of(&|b| b.mass), of(&|b| b.inertia));
        let turning = (0..n).map(|k| inertia[k].max(mass[k] * reach[k])).collect();
        Self { mass, inertia, reach, turning, joints, of_body }
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
        let most = |own: &[f64]| own.iter().copied().fold(0.0, f64::max);
        let all = branches.iter().fold(Branch::default(), |all, branch| all.joined(*branch));
        let or = |x: f64, others: [f64; 3]| {
            let mut candidates = std::iter::once(x).chain(others);
            candidates.find(|x| *x > 0.0).unwrap_or(1.0)
        };
        [
            if self.mass[k] > 0.0 { mass } else { or(mass, [all.mass, most(&self.mass), 1.0]) },
            match self.inertia[k] > 0.0 {
                true => inertia,
                false => or(
                    inertia,
                    [self.mass[k].max(all.mass) * arm, most(&self.turning), self.mass[k]],
                ),
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
    branches.sort_by(|a, b| b.0.total_cmp(&a.0));
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
