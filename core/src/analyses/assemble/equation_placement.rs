//! Placement of a body with one remaining freedom by an equation to placed bodies: it turns about a pin, or moves
//! along a slide, until the equation holds. A wheel on a line is placed by two equations.

use super::legs::Leg;
use super::placer::Placer;
use super::slider_placement::{Rail, ACROSS};
use crate::elements::{At, BodyId, Coordinate, Fixes};
use crate::equations::Laws;
use crate::math::{each, Listed, Local, Ordered, Pose, Rotation, Twist, Vec2};

/// Number of angles at which an equation is evaluated to bracket its solutions.
const SAMPLES: usize = 72;
/// Largest change of an equation, relative to the size, that counts as zero.
pub(super) const NOTHING: f64 = 1e-9;

/// The remaining freedom of a body.
pub(super) enum Freedom {
    Turn(Leg, Vec2),
    Slide(Rail),
}

impl Freedom {
    pub fn pose(&self, x: f64) -> Pose {
        match self {
            Self::Slide(rail) => rail.at(x),
            Self::Turn(leg, target) => {
                let mut pose = Pose::new(0.0, 0.0, x);
                pose.r = *target - pose.global(leg.own);
                pose
            }
        }
    }
}

impl Placer<'_> {
    /// Φ of a constraint with body `b` at a pose and all other bodies placed. None if a body is not placed.
    fn phi(&self, k: usize, b: usize, pose: &Pose) -> Option<Vec<f64>> {
        let item = &self.equations.model.constraints[k];
        let place = |body: usize| if body == b { Some(*pose) } else { self.poses[body] };
        let bodies: Option<Vec<Pose>> = item.bodies.iter().map(|body| place(body.0)).collect();
        let mut phi = vec![0.0; item.equations.len()];
        let (bodies, t) = (bodies?, self.targets.t);
        let coordinate = |body: BodyId, coordinate: Coordinate| {
            let end = item.bodies.iter().position(|known| *known == body);
            end.map_or(f64::NAN, |end| coordinate.of(&bodies[end], &Twist::zero()))
        };
        let parameters = &self.equations.model.parameters;
        let laws =
            Laws { parameters, t, coordinate, own: [&[]; 2], z: &[], pieces: &[], function: None };
        let varying = item.law.as_ref().map(|law| law.map(&mut |tape| tape.evaluate(&laws)));
        let element = varying.as_ref().unwrap_or(&item.element);
        element.residual(&At { bodies: &bodies, own: &[], t }, &mut phi);
        Some(phi)
    }

    /// Places body `b` if it has one remaining freedom that an equation determines.
    pub fn close_equation_of(&mut self, b: usize) {
        if !self.is_open(b) {
            return;
        }
        let pin = self.carried(b).next();
        let freedom = match (pin, self.rail(b)) {
            (Some((leg, target)), _) => Freedom::Turn(leg, target),
            (None, Some((_, rail))) => Freedom::Slide(rail),
            (None, None) => {
                if let Some(angle) = self.targets.hard[b][2] {
                    let _ = self.close_rods_of(b, angle) || self.close_slots_of(b, angle);
                }
                return;
            }
        };
        for at in 0..self.equations.of[b].len() {
            let k = self.equations.of[b][at];
            let (solutions, all) = self.solutions(k, b, &freedom);
            if let Some(pose) = self.chosen(b, &solutions) {
                if !all {
                    self.result.assume();
                }
                return self.put(b, pose);
            }
        }
    }

    /// The poses at which an equation of constraint `k` holds, the preferred pose first, and whether the list is
    /// complete.
    fn solutions(&self, k: usize, b: usize, freedom: &Freedom) -> (Vec<Pose>, bool) {
        let fixes = self.equations.model.constraints[k].element.fixes();
        if fixes.contains(&Fixes::Contact) {
            return (self.contacts(k, b, freedom), false);
        }
        let exact = self.at_rod(k, b, freedom).or_else(|| self.at_slot(k, b, freedom));
        if let Some(poses) = exact {
            return (poses, true);
        }
        let Some(m) = self.phi(k, b, &freedom.pose(0.0)).map(|phi| phi.len()) else {
            return (Vec::new(), false);
        };
        let turns = fixes.contains(&Fixes::Turn);
        let row = |row: usize| {
            move |x: f64| self.phi(k, b, &freedom.pose(x)).map_or(f64::NAN, |phi| phi[row])
        };
        let soft = self.targets.value(b, 2).unwrap_or(0.0);
        let mut all = turns && self.turns_about_its_centre(k, b, freedom);
        let every = all && self.targets.every_solution && self.targets.soft[b][2].is_none();
        let found = match freedom {
            Freedom::Turn(..) if turns => match newton(row(m - 1), soft, 1.0) {
                Some(x) if every => {
                    let (meshes, complete) = self.meshes(k, x, row(m - 1));
                    all &= complete;
                    meshes
                }
                found => found.into_iter().list(),
            },
            Freedom::Turn(..) => (0..m)
                .map(|r| around(row(r), NOTHING * self.equations.size))
                .find(|found| !found.is_empty())
                .unwrap_or_default(),
            Freedom::Slide(rail) => {
                let place = rail.towards(b, self.targets).r - rail.pose.r;
                let (from, far) = (place.dot(rail.direction), 4.0 * self.equations.size);
                let starts = [from, from + far, from - far];
                let last = row(m - 1);
                starts.iter().filter_map(|x| newton(last, *x, self.equations.size)).list()
            }
        };
        let mut poses: Vec<Pose> = Vec::new();
        for x in found {
            let x = match freedom {
                Freedom::Turn(..) if !turns => self.targets.nearest_turn(b, x),
                _ => x,
            };
            let pose = freedom.pose(x);
            let near = 1e-6 * self.equations.size;
            let alike = |other: &Pose| {
                (other.r - pose.r).norm() < near && (other.angle - pose.angle).abs() < 1e-6
            };
            if !poses.iter().any(alike) {
                poses.push(pose);
            }
        }
        if fixes.contains(&Fixes::Line) {
            poses.order_by_key(|pose| !self.is_ahead(k, b, pose));
        }
        (poses, all)
    }

    /// Whether the point of body j is ahead of the point of body i along the axis of constraint `k`.
    pub fn is_ahead(&self, k: usize, b: usize, pose: &Pose) -> bool {
        let item = &self.equations.model.constraints[k];
        let place = |end: usize| match item.bodies[end].0 {
            body if body == b => Some(*pose),
            body => self.poses[body],
        };
        let (Some(i), Some(j)) = (place(0), place(1)) else { return true };
        let at = each([0, 1], |end| item.element.attachment(end));
        let axis = Rotation::new(at[0].axis);
        let u = i.global(Local::new(axis.cos, axis.sin));
        u.dot(j.point(at[1].s) - i.point(at[0].s)) >= 0.0
    }

    /// The pose nearest to the targets of body `b`; without targets, an undecided choice.
    pub fn chosen(&mut self, b: usize, poses: &[Pose]) -> Option<Pose> {
        if poses.len() < 2 {
            return poses.first().copied();
        }
        let scales = [self.equations.size, self.equations.size, 1.0];
        let off = |pose: &Pose| -> Option<f64> {
            let is = [pose.r.x, pose.r.y, pose.angle];
            let asked = (0..3).filter_map(|c| {
                let asked = match self.targets.every_solution {
                    true => self.targets.soft[b][c],
                    false => self.targets.value(b, c),
                }?;
                Some(((is[c] - asked) / scales[c]).powi(2))
            });
            asked.reduce(|a, b| a + b)
        };
        let offs: Option<Vec<f64>> = poses.iter().map(off).collect();
        match offs {
            Some(offs) => {
                let nearest = (0..offs.len()).min_by(|a, b| offs[*a].total_cmp(&offs[*b]))?;
                Some(poses[nearest])
            }
            None => {
                let chosen = self.choose(poses.len());
                poses.get(chosen).copied()
            }
        }
    }

    /// The pose of body `b` as a wheel on a line of a placed body: at the requested position or angle, otherwise at
    /// the beginning of the line.
    pub fn beside(&self, b: usize) -> Option<Pose> {
        self.equations.of[b].iter().find_map(|k| {
            let item = &self.equations.model.constraints[*k];
            let fixes = item.element.fixes();
            let distance = fixes.iter().find_map(|fixed| match fixed {
                Fixes::Beside(distance) => Some(*distance),
                _ => None,
            })?;
            if item.bodies[1].0 != b || !fixes.contains(&Fixes::Turn) {
                return None;
            }
            let line = self.poses[item.bodies[0].0]?;
            let [at_line, own] = each([0, 1], |end| item.element.attachment(end));
            let axis = Rotation::new(at_line.axis);
            let u = line.global(Local::new(axis.cos, axis.sin));
            let from = line.point(at_line.s) + u.perp().scale(distance);
            let pose = |s: f64, angle: f64| {
                let mut pose = Pose::new(0.0, 0.0, angle);
                pose.r = from + u.scale(s) - pose.global(own.s);
                pose
            };
            let last = |pose: &Pose| self.phi(*k, b, pose).and_then(|phi| phi.last().copied());
            let angle = self.targets.value(b, 2);
            let along = |targets: &[Option<f64>; 3]| {
                let at = pose(0.0, angle.unwrap_or(0.0)).r;
                let [x, y] = each(
                    [(targets[0], u.x, at.x), (targets[1], u.y, at.y)],
                    |(asked, along, at)| {
                        Some((asked? - at) / along).filter(|_| along.abs() > ACROSS)
                    },
                );
                x.or(y)
            };
            let value = |s: f64, angle: f64| last(&pose(s, angle)).unwrap_or(f64::NAN);
            let by_angle = |angle: Option<f64>| {
                newton(|s| value(s, angle.unwrap_or(0.0)), 0.0, self.equations.size)
                    .filter(|_| angle.is_some())
            };
            let s = along(&self.targets.hard[b])
                .or_else(|| by_angle(self.targets.hard[b][2]))
                .or_else(|| along(&self.targets.soft[b]))
                .or_else(|| by_angle(self.targets.soft[b][2]))
                .unwrap_or(0.0);
            let angle = newton(|angle| value(s, angle), angle.unwrap_or(0.0), 1.0)?;
            Some(pose(s, angle))
        })
    }
}

/// A zero of `f` by Newton's method with finite differences. None if it does not converge.
fn newton(f: impl Fn(f64) -> f64, start: f64, scale: f64) -> Option<f64> {
    let (h, mut x) = (1e-5 * scale, start);
    for _ in 0..40 {
        let step = f(x) * 2.0 * h / (f(x + h) - f(x - h));
        if !step.is_finite() {
            return None;
        }
        x -= step;
        if step.abs() <= 1e-9 * scale.max(x.abs()) {
            return Some(x);
        }
    }
    None
}

/// The zeros of `f` in one turn: sign changes between samples, refined by bisection. Empty for a constant function.
fn around(f: impl Fn(f64) -> f64, nothing: f64) -> Vec<f64> {
    // samples avoid round angles, because solutions are often round
    let at = |k: usize| std::f64::consts::TAU * ((k as f64 + 0.377) / SAMPLES as f64 - 0.5);
    zeros(f, (SAMPLES, at), nothing, 60)
}

/// The zeros of `f` from sign changes between the samples `at(k)`, k = 0 to `samples`, with this number of
/// bisections. Empty for a constant function.
pub(super) fn zeros(
    f: impl Fn(f64) -> f64,
    (samples, at): (usize, impl Fn(usize) -> f64),
    nothing: f64,
    halvings: i32,
) -> Vec<f64> {
    let values: Vec<f64> = (0..=samples).map(|k| f(at(k))).list();
    let spread = values.iter().fold(0.0, |most: f64, v| most.max((v - values[0]).abs()));
    if spread.is_nan() || spread <= nothing {
        return Vec::new();
    }
    let crossing = (0..samples).filter(|k| (values[*k] <= 0.0) != (values[k + 1] <= 0.0));
    let halved = crossing.filter_map(|k| {
        let [mut low, mut high] = [at(k), at(k + 1)];
        for _ in 0..halvings {
            let middle = 0.5 * (low + high);
            match (f(middle) <= 0.0) == (values[k] <= 0.0) {
                true => low = middle,
                false => high = middle,
            }
        }
        // a jump is not a zero
        let small = 0.5_f64.powi(halvings).max(1e-6);
        (f(low).abs() <= small * spread).then_some(low)
    });
    halved.list()
}
