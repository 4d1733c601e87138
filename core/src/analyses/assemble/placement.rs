//! First positions of all bodies: along the joints from ground, with dyads closed on the way.
//!
//! A body is placed as soon as enough is known:
//!
//! * its angle and one pin;
//! * two pins;
//! * a dyad with a neighbour: two bodies pinned to each other and to placed bodies. The joint between them is
//!   an intersection of two circles, so there are two closures;
//! * a slide on a placed body, and a pin, a coordinate or a link to a placed body.
//!
//! If no body can be placed, a coordinate is taken from the guess, or several angles are tried. Choices that
//! no guess decides are numbered, so that a caller can go through all of them.

use super::dyad::{close, Closure};
use super::slider_placement::{slides, Rail, Slide};
use super::targets::{nearest_turn, Targets};
use crate::elements::Fixes;
use crate::equations::kinematics;
use crate::math::{Local, Pose, Vec2};
use crate::model::Model;

/// Two points that coincide, seen from one of their bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    constraint: usize,
    pub own: Local,
    pub other: usize,
    pub at_other: Local,
    /// The angle of the own body minus that of the other, if the joint fixes this difference as well.
    turned: Option<f64>,
}

/// Two bodies closed as a dyad.
#[derive(Clone, Debug, PartialEq)]
pub struct Dyad {
    /// The two bodies.
    pub bodies: [usize; 2],
    /// The joint between them.
    pub joint: usize,
    /// Joints that carry them.
    pub anchors: [usize; 2],
    /// Whether the two closures are different positions.
    pub has_other: bool,
    /// Whether the second anchor is a slide.
    pub slides: bool,
}

/// A dyad whose circles do not meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// The two bodies.
    pub bodies: [usize; 2],
    /// The joint between them.
    pub joint: usize,
    /// Length by which the two bodies together are too short (> 0) or one is too long for the other (< 0), m.
    pub missing: f64,
}

/// Positions of all bodies, and the choices that led to them.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// Coordinates, shape (n_q).
    pub q: Vec<f64>,
    /// Dyads, in the order of their closing.
    pub dyads: Vec<Dyad>,
    /// Dyads that did not close.
    pub gaps: Vec<Gap>,
    /// Number of options of each undecided choice.
    pub options: Vec<usize>,
}

/// Angles that are tried for a body without known coordinates, in this order.
const TRIED_DEG: [f64; 12] =
    [0.0, 90.0, 45.0, 135.0, -45.0, 180.0, -90.0, -135.0, 20.0, 110.0, -70.0, -160.0];

struct Placer<'a> {
    targets: &'a Targets,
    legs: Vec<Vec<Leg>>,
    slides: Vec<Vec<Slide>>,
    poses: Vec<Option<Pose>>,
    choices: &'a [usize],
    result: Placement,
}

/// Places all bodies; undecided choice k takes option `choices[k]`, or the first.
pub fn place(model: &Model, targets: &Targets, choices: &[usize]) -> Placement {
    let mut placer = Placer {
        targets,
        legs: legs(model),
        slides: slides(model),
        poses: vec![None; model.bodies.len()],
        choices,
        result: Placement::default(),
    };
    placer.poses[0] = Some(Pose::identity());
    while let Some(first) = placer.poses.iter().position(Option::is_none) {
        let placed = (first..placer.poses.len()).filter(|b| placer.follow(*b)).count();
        if placed == 0 && !placer.close_dyads() && !placer.close_slides() {
            placer.assume(first);
        }
    }
    let poses: Vec<Pose> = placer.poses.iter().flatten().copied().collect();
    placer.result.q = kinematics::coordinates(model, &poses);
    placer.result
}

pub(super) fn legs(model: &Model) -> Vec<Vec<Leg>> {
    let mut legs = vec![Vec::new(); model.bodies.len()];
    for (constraint, item) in model.constraints.iter().enumerate() {
        let fixes = item.element.fixes();
        if !fixes.contains(&Fixes::Points) {
            continue;
        }
        let at = [0, 1].map(|body| item.element.attachment(body));
        let rigid = fixes.contains(&Fixes::Direction);
        for (own, other) in [(0, 1), (1, 0)] {
            legs[item.bodies[own].0].push(Leg {
                constraint,
                own: at[own].s,
                other: item.bodies[other].0,
                at_other: at[other].s,
                turned: rigid.then(|| at[other].axis - at[own].axis),
            });
        }
    }
    legs
}

fn direction<V: Into<(f64, f64)>>(v: V) -> f64 {
    let (x, y) = v.into();
    y.atan2(x)
}

impl Placer<'_> {
    /// The required place of a pin of body `b`, if its other body is placed.
    fn target(&self, leg: &Leg) -> Option<Vec2> {
        self.poses[leg.other].as_ref().map(|pose| pose.point(leg.at_other))
    }

    fn carried(&self, b: usize) -> impl Iterator<Item = (Leg, Vec2)> + '_ {
        self.legs[b].iter().filter_map(|leg| Some((*leg, self.target(leg)?)))
    }

    /// The first slide of body `b` whose other body is placed, and the places that it allows for `b`.
    fn rail(&self, b: usize) -> Option<(Slide, Rail)> {
        self.slides[b].iter().find_map(|s| Some((*s, s.rail(self.poses[s.other].as_ref()?)?)))
    }

    fn put(&mut self, b: usize, pose: Pose) {
        self.poses[b] = Some(pose);
    }

    /// Places a body with a known angle that is pinned at `leg` to `target`.
    fn hang(&mut self, b: usize, leg: &Leg, target: Vec2, angle: f64) {
        let mut pose = Pose::new(0.0, 0.0, angle);
        pose.r = target - pose.global(leg.own);
        self.put(b, pose);
    }

    /// Places a body by a joint that fixes a point and the angle.
    fn join(&mut self, b: usize, pins: &[(Leg, Vec2)]) {
        for (leg, target) in pins {
            if let (Some(turned), Some(other)) = (leg.turned, self.poses[leg.other]) {
                return self.hang(b, leg, *target, other.angle + turned);
            }
        }
    }

    /// Places a body if enough is known; false if not, or if it is placed already.
    fn follow(&mut self, b: usize) -> bool {
        if self.poses[b].is_some() {
            return false;
        }
        let hard = self.targets.hard[b];
        let pins: Vec<(Leg, Vec2)> = self.carried(b).take(8).collect();
        let apart = |p: &&(Leg, Vec2)| (p.0.own - pins[0].0.own).norm() > 0.0;
        let rail = self.rail(b).map(|(_, rail)| rail);
        let decided = rail.and_then(|rail| (0..2).find_map(|c| rail.reaching(c, hard[c]?)));
        match (hard, pins.as_slice()) {
            ([Some(x), Some(y), Some(angle)], _) => self.put(b, Pose::new(x, y, angle)),
            (_, pins) if pins.iter().any(|(leg, _)| leg.turned.is_some()) => self.join(b, pins),
            ([_, _, Some(angle)], [(leg, target), ..]) => self.hang(b, leg, *target, angle),
            (_, [(leg, target), ..]) if rail.is_some() => {
                let angle = rail.map_or(0.0, |rail| rail.pose.angle);
                self.hang(b, leg, *target, angle);
            }
            (_, []) if decided.is_some() => self.poses[b] = decided,
            (_, [(leg, target), rest @ ..]) => {
                let Some((second, at)) = rest.iter().find(apart) else { return false };
                let (own, global) = (second.own - leg.own, *at - *target);
                let angle = direction((global.x, global.y)) - direction((own.x, own.y));
                self.hang(b, leg, *target, self.targets.nearest_turn(b, angle));
            }
            _ => return false,
        }
        true
    }

    /// Closes every dyad that can be closed now.
    fn close_dyads(&mut self) -> bool {
        let mut any = false;
        for b in 1..self.poses.len() {
            if self.poses[b].is_some() {
                continue;
            }
            let Some((anchor, at)) = self.carried(b).next() else { continue };
            let dyad = self.legs[b].iter().find_map(|joint| {
                let free = self.poses[joint.other].is_none() && joint.other != b;
                let (far, far_at) = self.carried(joint.other).next().filter(|_| free)?;
                Some((*joint, far, far_at))
            });
            if let Some((joint, far, far_at)) = dyad {
                any |= self.close_dyad([b, joint.other], joint, [(anchor, at), (far, far_at)]);
            }
        }
        any
    }

    fn close_dyad(&mut self, bodies: [usize; 2], joint: Leg, carried: [(Leg, Vec2); 2]) -> bool {
        let at_joint = [joint.own, joint.at_other];
        let arms = [0, 1].map(|k| at_joint[k] - carried[k].0.own);
        let (closures, missing) =
            match close(carried[0].1, arms[0].norm(), carried[1].1, arms[1].norm()) {
                Closure::Two(a, b) => (vec![a, b], None),
                Closure::One(a, missing) => (vec![a], missing),
                Closure::Undetermined => return false,
            };
        let angles: Vec<[f64; 2]> = closures
            .iter()
            .map(|p| [0, 1].map(|k| self.dyad_angle(bodies[k], *p - carried[k].1, arms[k])))
            .collect();
        let chosen = match closures.len() {
            1 => 0,
            _ => self.decide(bodies, &angles),
        };
        for k in [0, 1] {
            self.hang(bodies[k], &carried[k].0, carried[k].1, angles[chosen][k]);
        }
        let joint = joint.constraint;
        if let Some(missing) = missing {
            self.result.gaps.push(Gap { bodies, joint, missing });
        }
        self.result.dyads.push(Dyad {
            bodies,
            joint,
            anchors: [carried[0].0.constraint, carried[1].0.constraint],
            has_other: closures.len() == 2,
            slides: false,
        });
        true
    }

    /// Closes every body on a slide that a link from a placed body reaches.
    fn close_slides(&mut self) -> bool {
        let mut any = false;
        for b in 1..self.poses.len() {
            let Some((slide, rail)) = self.rail(b).filter(|_| self.poses[b].is_none()) else {
                continue;
            };
            let link = self.legs[b].iter().find_map(|joint| {
                let free = self.poses[joint.other].is_none() && joint.other != b;
                let (anchor, at) = self.carried(joint.other).next().filter(|_| free)?;
                Some((*joint, anchor, at))
            });
            if let Some((joint, anchor, at)) = link {
                self.close_slide(b, (&slide, &rail), joint, (anchor, at));
                any = true;
            }
        }
        any
    }

    fn close_slide(
        &mut self,
        b: usize,
        (slide, rail): (&Slide, &Rail),
        joint: Leg,
        (anchor, at): (Leg, Vec2),
    ) {
        let link = joint.other;
        let arm = joint.at_other - anchor.own;
        let (distances, missing) = rail.meeting(joint.own, at, arm.norm());
        let closures: Vec<[Pose; 2]> = distances
            .iter()
            .map(|distance| {
                let on_slide = rail.at(*distance);
                let angle = self.dyad_angle(link, on_slide.point(joint.own) - at, arm);
                let mut pose = Pose::new(0.0, 0.0, angle);
                pose.r = at - pose.global(anchor.own);
                [on_slide, pose]
            })
            .collect();
        let bodies = [b, link];
        let chosen = match closures.as_slice() {
            [first, second] => self.decide_place(bodies, [first, second]),
            _ => 0,
        };
        for (body, pose) in bodies.into_iter().zip(closures[chosen]) {
            self.put(body, pose);
        }
        if let Some(missing) = missing {
            self.result.gaps.push(Gap { bodies, joint: joint.constraint, missing });
        }
        self.result.dyads.push(Dyad {
            bodies,
            joint: joint.constraint,
            anchors: [anchor.constraint, slide.constraint],
            has_other: closures.len() == 2,
            slides: true,
        });
    }

    /// As [`Placer::decide`], but requested places decide if there are no requested angles.
    fn decide_place(&mut self, bodies: [usize; 2], closures: [&[Pose; 2]; 2]) -> usize {
        let off = |poses: &[Pose; 2], c: usize| -> Option<f64> {
            let squares = bodies.iter().zip(poses).filter_map(|(b, pose)| {
                let soft = self.targets.soft[*b][c]?;
                Some(([pose.r.x, pose.r.y][c] - soft).powi(2))
            });
            squares.reduce(|a, b| a + b)
        };
        let place = (0..2).find_map(|c| Some((off(closures[0], c)?, off(closures[1], c)?)));
        match place {
            Some((a, b)) if a != b => usize::from(b < a),
            _ => self.decide(bodies, &closures.map(|poses| poses.map(|pose| pose.angle))),
        }
    }

    /// Angle of a body whose arm must point along `global`.
    fn dyad_angle(&self, b: usize, global: Vec2, arm: Local) -> f64 {
        if arm.norm() == 0.0 {
            return self.targets.value(b, 2).unwrap_or(0.0);
        }
        let angle = direction((global.x, global.y)) - direction((arm.x, arm.y));
        self.targets.nearest_turn(b, angle)
    }

    /// Chooses one of two closures: the one nearer to the guess, otherwise an undecided choice.
    fn decide(&mut self, bodies: [usize; 2], angles: &[[f64; 2]]) -> usize {
        let distance = |pair: &[f64; 2]| -> Option<f64> {
            let squares = bodies.iter().zip(pair).filter_map(|(b, angle)| {
                let soft = self.targets.soft[*b][2]?;
                Some((nearest_turn(*angle, soft) - soft).powi(2))
            });
            squares.reduce(|a, b| a + b)
        };
        match (distance(&angles[0]), distance(&angles[1])) {
            (Some(a), Some(b)) => usize::from(b < a),
            _ => self.choose(2),
        }
    }

    fn choose(&mut self, options: usize) -> usize {
        let k = self.result.options.len();
        self.result.options.push(options);
        self.choices.get(k).copied().unwrap_or(0)
    }

    /// If no body can be placed: takes a coordinate from the guess, or tries an angle.
    fn assume(&mut self, first: usize) {
        let open = |b: &usize| self.poses[*b].is_none();
        let all = first..self.poses.len();
        let pinned = |b: &usize| self.carried(*b).next().is_some();
        let guessed = |b: &usize| self.targets.value(*b, 2).is_some();
        let b = all.clone().filter(open).find(|b| pinned(b) && guessed(b));
        let b = b.or_else(|| all.clone().filter(open).find(|b| self.targets.pose(*b).is_some()));
        let b = b.or_else(|| all.clone().filter(open).find(pinned)).unwrap_or(first);
        if let (false, Some((_, rail))) = (pinned(&b), self.rail(b)) {
            return self.put(b, rail.towards(b, self.targets));
        }
        let angle = match self.targets.value(b, 2) {
            Some(angle) => angle,
            None => TRIED_DEG[self.choose(TRIED_DEG.len())].to_radians(),
        };
        let pin = self.carried(b).next();
        match pin {
            Some((leg, target)) => self.hang(b, &leg, target, angle),
            None => {
                let [x, y] = [0, 1].map(|c| self.targets.value(b, c).unwrap_or(0.0));
                self.put(b, Pose::new(x, y, angle));
            }
        }
    }
}
