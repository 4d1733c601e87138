//! First positions of all bodies. They are placed along the joints from ground, and dyads are closed on the way.
//!
//! A body is placed as soon as enough is known about it:
//!
//! * its angle and one pin;
//! * two pins;
//! * a dyad with a neighbour: two bodies pinned to each other and to placed bodies. The joint between them is
//!   an intersection of two circles, so there are two closures;
//! * a slide on a placed body, and a pin, a coordinate or a link to a placed body;
//! * a slide between two bodies with pins on placed bodies, or with a pin and a slide; a pin between two slides;
//! * a point on a line, such as a pin in a slot, and a pin, a slide or a second line;
//! * its angle and two rods;
//! * a pin or a slide on a placed body, and an equation to placed bodies, such as that of a gear.
//!
//! If no body can be placed, a coordinate is taken from the guess, or several angles are tried. Choices that no guess
//! decides are numbered, so that a caller can enumerate them.

use super::by_equation::ByEquation;
use super::legs::{legs, Leg};
use super::placement::Placement;
use super::slider_placement::{slides, Rail, Slide};
use super::targets::Targets;
use super::worklist::Worklist;
use crate::equations::kinematics;
use crate::math::{each, Listed, Pose, Vec2};
use crate::model::Model;

/// Angles, in this order, that are tried for a body without known coordinates.
const TRIED_DEG: [f64; 12] =
    [0.0, 90.0, 45.0, 135.0, -45.0, 180.0, -90.0, -135.0, 20.0, 110.0, -70.0, -160.0];

/// Largest distance of a pin from the line of two anchors, relative to the distance of the anchors, at which it
/// counts as on the line.
pub(super) const ON_LINE: f64 = 1e-9;

pub(super) struct Placer<'a> {
    pub targets: &'a Targets,
    pub legs: Vec<Vec<Leg>>,
    pub slides: Vec<Vec<Slide>>,
    pub equations: ByEquation<'a>,
    /// Whether each body has a constraint.
    joined: Vec<bool>,
    pub poses: Vec<Option<Pose>>,
    /// For each body, the indices of its legs to placed bodies, ascending.
    carried: Vec<Vec<usize>>,
    waiting: Worklist,
    choices: &'a [usize],
    pub result: Placement,
}

/// Places all bodies. Undecided choice k uses option `choices[k]`, or the first option. The cost is linear in the
/// size of the model.
pub fn place<'a>(model: &'a Model, targets: &'a Targets, choices: &'a [usize]) -> Placement {
    let n = model.bodies.len();
    let mut joined = vec![false; n];
    for item in &model.constraints {
        item.bodies.iter().for_each(|body| joined[body.0] = true);
    }
    let posed = (1..n).filter(|b| targets.pose(*b).is_some());
    let mut placer = Placer {
        targets,
        legs: legs(model),
        slides: slides(model),
        equations: ByEquation::new(model),
        joined,
        poses: vec![None; n],
        carried: vec![Vec::new(); n],
        waiting: Worklist::new(n, posed),
        choices,
        result: Placement::default(),
    };
    placer.put(0, Pose::identity());
    placer.place_all();
    let poses: Vec<Pose> = placer.poses.iter().flatten().copied().list();
    placer.result.q = kinematics::coordinates(model, &poses);
    placer.result
}

pub(super) fn direction<V: Into<(f64, f64)>>(v: V) -> f64 {
    let (x, y) = v.into();
    y.atan2(x)
}

impl Placer<'_> {
    /// Places the remaining bodies one by one, by the most reliable method first.
    fn place_all(&mut self) {
        loop {
            if let Some(b) = self.waiting.follow.pop() {
                self.follow(b);
            } else if let Some(b) = self.waiting.equations.pop() {
                self.close_equation_of(b);
            } else if let Some(b) = self.waiting.dyads.pop() {
                self.close_dyad_of(b);
            } else if let Some(b) = self.waiting.slides.pop() {
                self.close_two_slides(b);
                self.close_slide_of(b);
                self.close_slide_between(b);
                self.close_pin_between_slides(b);
            } else if let Some(b) = self.next_assumed() {
                self.assume(b);
            } else {
                return;
            }
        }
    }

    pub fn is_open(&self, b: usize) -> bool {
        self.poses[b].is_none()
    }

    /// The legs of body `b` to placed bodies, with the required positions of their pins.
    pub fn carried(&self, b: usize) -> impl Iterator<Item = (Leg, Vec2)> + '_ {
        let legs = self.carried[b].iter().map(move |k| self.legs[b][*k]);
        legs.filter_map(|leg| Some((leg, self.poses[leg.other].as_ref()?.point(leg.at_other))))
    }

    /// The first slide of body `b` whose other body is placed, and the positions that it allows for `b`.
    pub fn rail(&self, b: usize) -> Option<(Slide, Rail)> {
        self.slides[b].iter().find_map(|s| Some((*s, s.rail(self.poses[s.other].as_ref()?)?)))
    }

    /// Places a body and adds its neighbours to the worklist.
    pub fn put(&mut self, b: usize, pose: Pose) {
        self.poses[b] = Some(pose);
        for k in 0..self.legs[b].len() {
            let Leg { other, mirror, .. } = self.legs[b][k];
            if self.is_open(other) {
                self.carry(other, mirror);
            }
        }
        for k in 0..self.equations.linked(b).len() {
            let other = self.equations.linked(b)[k];
            if self.is_open(other) {
                self.waiting.equations.push(other);
            }
        }
        for k in 0..self.slides[b].len() {
            let other = self.slides[b][k].other;
            if self.is_open(other) {
                self.waiting.follow.push(other);
                self.waiting.equations.push(other);
                self.waiting.slides.push(other);
                // their angles are now known
                let linked = self.slides[other].iter().map(|slide| slide.other);
                linked.for_each(|b| self.waiting.slides.push(b));
            }
        }
    }

    /// Records that leg `k` of body `b` leads to a placed body.
    fn carry(&mut self, b: usize, k: usize) {
        let carried = &mut self.carried[b];
        carried.insert(carried.partition_point(|leg| *leg < k), k);
        self.waiting.follow.push(b);
        if carried.len() > 1 {
            return;
        }
        self.waiting.equations.push(b);
        self.waiting.slides.push(b);
        self.waiting.dyads.push(b);
        self.waiting.assumed[2].push(b);
        if self.targets.value(b, 2).is_some() {
            self.waiting.assumed[0].push(b);
        }
        let linked = self.legs[b].iter().map(|leg| leg.other);
        linked.filter(|b| !self.slides[*b].is_empty()).for_each(|b| self.waiting.slides.push(b));
    }

    /// Places a body with a known angle whose pin `leg` is at `target`.
    pub fn hang(&mut self, b: usize, leg: &Leg, target: Vec2, angle: f64) {
        let mut pose = Pose::new(0.0, 0.0, angle);
        pose.r = target - pose.global(leg.own);
        self.put(b, pose);
    }

    /// Places a body by a joint that fixes a point and its angle.
    fn join(&mut self, b: usize, pins: &[(Leg, Vec2)]) {
        for (leg, target) in pins {
            if let (Some(turned), Some(other)) = (leg.turned, self.poses[leg.other]) {
                return self.hang(b, leg, *target, other.angle + turned);
            }
        }
    }

    /// Places a body if enough is known.
    fn follow(&mut self, b: usize) {
        if !self.is_open(b) {
            return;
        }
        let hard = self.targets.hard[b];
        let pins: Vec<(Leg, Vec2)> = self.carried(b).take(8).list();
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
            (_, []) if decided.is_some() => decided.into_iter().for_each(|pose| self.put(b, pose)),
            (_, [(leg, target), rest @ ..]) => {
                let Some((second, at)) = rest.iter().find(apart) else { return };
                let (own, global) = (second.own - leg.own, *at - *target);
                let angle = direction((global.x, global.y)) - direction((own.x, own.y));
                self.hang(b, leg, *target, self.targets.nearest_turn(b, angle));
            }
            _ => {}
        }
    }

    pub fn choose(&mut self, options: usize) -> usize {
        let k = self.result.options.len();
        self.result.options.push(options);
        self.choices.get(k).copied().unwrap_or(0)
    }

    /// The body that is placed by assumption if no other body can be placed.
    fn next_assumed(&mut self) -> Option<usize> {
        for kind in 0..self.waiting.assumed.len() {
            while let Some(b) = self.waiting.assumed[kind].pop() {
                if self.is_open(b) {
                    return Some(b);
                }
            }
        }
        None
    }

    /// Takes a coordinate of a body from the guess, or tries an angle.
    fn assume(&mut self, b: usize) {
        self.result.assume();
        let pin = self.carried(b).next();
        if let (None, Some((_, rail))) = (pin, self.rail(b)) {
            return self.put(b, rail.towards(b, self.targets));
        }
        if let (None, Some(pose)) = (pin, self.beside(b)) {
            return self.put(b, pose);
        }
        let angle = match self.targets.value(b, 2) {
            Some(angle) => angle,
            None if !self.joined[b] => 0.0,
            None => TRIED_DEG[self.choose(TRIED_DEG.len())].to_radians(),
        };
        match pin {
            Some((leg, target)) => self.hang(b, &leg, target, angle),
            None if self.close_rods_of(b, angle) => {}
            None => {
                let [x, y] = each([0, 1], |c| self.targets.value(b, c).unwrap_or(0.0));
                self.put(b, Pose::new(x, y, angle));
            }
        }
    }
}
