//! The work done over a motion, by adaptive quadrature of the powers, and the record of the motion in the form that
//! dynamics uses.

use super::motion::Motion;
use super::quintic::{Quintic, DEGREE};
use super::solution::Point;
use crate::analyses::dynamics::{PiecewiseInterpolant, Trajectory};
use crate::analyses::State;
use crate::elements::Nature;
use crate::equations::augmented::NearSingular;
use crate::equations::forces::{self, Acting};
use crate::equations::kinematics::Motions;
use crate::equations::{energy, mass, reactive, Gains, Powers, Workspace};
use crate::math::{indexed, ShortArray};
use crate::model::{Model, WORKS};

/// Interior nodes and weights of Lobatto's rule with 5 points on [0, 1], which is exact for polynomials of degree 7.
const NODES: [f64; 3] = [0.172_673_164_646_011_43, 0.5, 0.827_326_835_353_988_6];
const WEIGHTS: [f64; 5] = [0.05, 49.0 / 180.0, 16.0 / 45.0, 49.0 / 180.0, 0.05];
/// Error of a work, relative to the largest work or kinetic energy so far.
const TOLERANCE: f64 = 1e-11;
/// Largest number of halvings of a step.
const DEPTH: usize = 8;

/// A motion, recorded in the form that dynamics uses.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    /// States at the chosen times, and the works since the start.
    pub trajectory: Trajectory,
    /// Polynomials between the steps of the continuation.
    pub dense: PiecewiseInterpolant,
}

/// Records a motion from `start` with the works of its forces and drivers.
///
/// In a `resting` motion, the mechanism is at rest at each value: its rates are zero, and so are the forces that depend
/// on them. The works are those of the remaining forces along the path.
pub fn recorded(model: &Model, start: &State, motion: &Motion, resting: bool) -> Recorded {
    let mut recorder = MotionRecorder::new(model, start, resting);
    recorder.follow(motion);
    recorder.recorded
}

/// Records a motion while it is computed, so that the record is complete at any time.
pub struct MotionRecorder<'a> {
    works: Works<'a>,
    /// The record so far.
    pub recorded: Recorded,
    /// The numbers of points and outputs in the record.
    points: usize,
    outputs: usize,
}

impl<'a> MotionRecorder<'a> {
    /// The record of a motion from `start`, `resting` as for [`recorded`].
    pub fn new(model: &'a Model, start: &State, resting: bool) -> Self {
        let dense = PiecewiseInterpolant { degree: DEGREE, ..PiecewiseInterpolant::default() };
        let recorded = Recorded { dense, ..Recorded::default() };
        Self { works: Works::new(model, start, resting), recorded, points: 0, outputs: 0 }
    }

    /// Adds the points and outputs that the motion has in addition.
    pub fn follow(&mut self, motion: &Motion) {
        self.add_outputs(motion);
        for (place, point) in motion.points.iter().enumerate().skip(self.points) {
            match place.checked_sub(1) {
                Some(k) => {
                    self.works.add_step(&motion.points[k], point, &mut self.recorded.dense);
                }
                None => self.recorded.dense.t.push(point.t),
            }
            self.points += 1;
            self.add_outputs(motion);
        }
    }

    /// Adds the outputs at the last point of the record.
    fn add_outputs(&mut self, motion: &Motion) {
        let Self { works, recorded, points, outputs } = self;
        for place in motion.outputs[*outputs..].iter().take_while(|place| **place + 1 == *points) {
            let point = &motion.points[*place];
            let y = [&point.q[..], works.rates(point), &works.z, &works.total].concat();
            recorded.trajectory.add(&works.model.layout, point.t, &y);
            *outputs += 1;
        }
    }
}

/// Integrates the works since the start: dissipated energy, work of drivers, work of applied forces, J.
struct Works<'a> {
    model: &'a Model,
    workspace: Workspace,
    z: Vec<f64>,
    total: Vec<f64>,
    /// Whether forces depend on reactions.
    reactive: bool,
    /// The largest work or kinetic energy so far.
    scale: f64,
    /// The rates of a resting motion, which are zero; otherwise None.
    rest: Option<Vec<f64>>,
    /// The motion along the path.
    along: Motions,
}

type Three = [f64; WORKS];

impl<'a> Works<'a> {
    fn new(model: &'a Model, start: &State, resting: bool) -> Self {
        let (mut workspace, z) = (Workspace::new(model), start.z.clone());
        if !model.allow_redundancy {
            workspace.matrix.set_near_singular(NearSingular::Regularise);
        }
        let reactive = reactive::depends(model);
        let rest = resting.then(|| vec![0.0; model.layout.n_q]);
        let (total, along) = (vec![0.0; WORKS], Motions::new(&model.layout));
        Self { model, workspace, z, total, reactive, scale: 0.0, rest, along }
    }

    /// The rates of the states at a point.
    fn rates<'p>(&'p self, point: &'p Point) -> &'p [f64] {
        self.rest.as_ref().unwrap_or(&point.v)
    }

    /// Adds the works of a step, and its polynomials.
    fn add_step(&mut self, from: &Point, to: &Point, dense: &mut PiecewiseInterpolant) {
        let h = to.t - from.t;
        let ends = [self.powers(from), self.powers(to)];
        let kinetic = energy::kinetic(self.model, &self.workspace.motions);
        let added = self.workspace.matrix.added_energy(&self.workspace.motions);
        self.scale = self.scale.max(kinetic).max(added);
        let works = self.over(&Quintic::new(from, to), [0.0, 1.0], ends, DEPTH);
        dense.t.push(to.t);
        dense.y.extend([&from.q[..], self.rates(from), &self.z, &self.total].concat());
        let quintic = Quintic::new(from, to);
        for k in 0..from.q.len() {
            dense.c.extend(quintic.position(k).each(|c| c / h));
        }
        for k in 0..from.q.len() {
            let moves = if self.rest.is_some() { 0.0 } else { 1.0 };
            dense.c.extend(quintic.rate(k).each(|c| moves * c / h));
        }
        dense.c.extend(std::iter::repeat_n(0.0, DEGREE * self.z.len()));
        for (k, work) in works.iter().enumerate() {
            // the cubic work polynomial whose derivative is the quadratic with these end values and this mean
            let [p0, p1, mean] = [ends[0][k], ends[1][k], work / h];
            dense.c.extend([p0, 3.0 * mean - 2.0 * p0 - p1, p0 + p1 - 2.0 * mean, 0.0, 0.0]);
            self.total[k] += work;
            self.scale = self.scale.max(self.total[k].abs());
        }
    }

    /// The powers at a point.
    fn powers(&mut self, Point { t, q, v, a }: &Point) -> Three {
        let rates = self.rest.as_ref().unwrap_or(v);
        let state = [&q[..], rates, &self.z];
        let solved = self.workspace.accelerate(self.model, *t, state, Gains::default()).is_ok();
        let mut powers = match solved && (!self.workspace.matrix.regularised() || self.reactive) {
            true => self.workspace.powers(self.model, v),
            false => self.balanced(*t, v, if self.rest.is_some() { rates } else { a }),
        };
        if self.rest.is_some() {
            self.along.place(&self.model.layout, q, v);
            powers.applied += self.applied(*t);
        }
        [powers.dissipated, powers.drivers, powers.applied]
    }

    /// The power along the path of the forces at rest that have no potential. Forces that depend on reactions have no
    /// effect at rest.
    fn applied(&self, t: f64) -> f64 {
        let acting = Acting { z: &self.z, lam: None, t };
        let (motions, mut power) = (&self.workspace.motions, 0.0);
        for (k, item) in self.model.forces.iter().enumerate() {
            forces::each_wrench(self.model, k, motions, acting, |part, body, wrench| {
                let nature = item.element.parts()[part].nature;
                let follows = item.law.is_none() || item.element.follows();
                let nature = if follows { nature } else { nature.under_law() };
                if nature != Nature::Conservative {
                    power += wrench.power(self.along[body.0].twist);
                }
            });
        }
        power
    }

    /// The powers near a singular position, without multipliers: the drivers supply q̇ᵀ (M q̈ - Q).
    fn balanced(&self, t: f64, v: &[f64], a: &[f64]) -> Powers {
        let Self { model, workspace, z, .. } = self;
        let (mut load, mut powers) = (vec![0.0; v.len()], Powers::zero());
        let (compiled, motions) = (&workspace.compiled, &workspace.motions);
        let acting = Acting { z, lam: None, t };
        forces::generalized(model, compiled, motions, acting, &mut load, &mut powers);
        let bodies = model.bodies.iter().zip(motions.iter()).zip(&model.layout.bodies).skip(1);
        powers.drivers = bodies.fold(0.0, |sum, ((body, motion), columns)| {
            let inertial = mass::block(body, motion).times(columns.of(a));
            let (v, load) = (columns.of(v), columns.of(&load));
            sum + (0..3).map(|k| v[k] * (inertial[k] - load[k])).sum::<f64>()
        });
        powers
    }

    /// The works over a part of a step, given the powers at its ends.
    fn over(
        &mut self,
        step: &Quintic<'_>,
        [a, b]: [f64; 2],
        ends: [Three; 2],
        depth: usize,
    ) -> Three {
        let middle = 0.5 * (a + b);
        let inside = NODES.each(|x| self.powers(&step.at(a + x * (b - a))));
        let h = (b - a) * step.h;
        let whole = lobatto(h, ends, inside);
        let halves = [[ends[0], inside[1]], [inside[1], ends[1]]];
        let parts = [[a, middle], [middle, b]];
        let fine: [Three; 2] = indexed(|k| {
            let [from, to] = parts[k];
            let inside = NODES.each(|x| self.powers(&step.at(from + x * (to - from))));
            lobatto(0.5 * h, halves[k], inside)
        });
        let sum: Three = indexed(|k| fine[0][k] + fine[1][k]);
        let size = sum.iter().fold(self.scale, |most, w| most.max(w.abs()));
        let error = (0..WORKS).fold(0.0, |most: f64, k| most.max((sum[k] - whole[k]).abs()));
        if depth == 0 || error <= TOLERANCE * size {
            return sum;
        }
        let both: [Three; 2] = indexed(|k| self.over(step, parts[k], halves[k], depth - 1));
        indexed(|k| both[0][k] + both[1][k])
    }
}

fn lobatto(h: f64, ends: [Three; 2], inside: [Three; 3]) -> Three {
    let [first, last] = ends;
    let [a, b, c] = inside;
    let rule = |k: usize| {
        [first[k], a[k], b[k], c[k], last[k]].iter().zip(WEIGHTS).map(|(p, w)| p * w).sum::<f64>()
    };
    indexed(|k| h * rule(k))
}
