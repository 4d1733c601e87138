//! Closing of dyads during placement: two bodies on pins, or a body on a slide with a link.

use super::dyad::{close, Closure};
use super::legs::Leg;
use super::placement::{Dyad, DyadGap};
use super::placer::{direction, Placer, ON_LINE};
use super::slider_placement::{Rail, Slide};
use super::targets::nearest_turn;
use crate::math::{each, Listed, Local, Pose, ShortArray, Vec2};

impl Placer<'_> {
    /// Closes a dyad of body `b` and a neighbour, if both have a pin on placed bodies.
    pub fn close_dyad_of(&mut self, b: usize) {
        for k in 0..self.legs[b].len() {
            let Some(anchor) = self.carried(b).next().filter(|_| self.is_open(b)) else { return };
            let joint = self.legs[b][k];
            if self.is_open(joint.other) && joint.other != b {
                let far = self.carried(joint.other).next();
                if let Some(far) = far {
                    self.close_dyad([b, joint.other], joint, [anchor, far]);
                }
            }
        }
    }

    /// The pin between the bodies that carry two legs.
    fn pin_between(&self, carriers: [usize; 2]) -> Option<Leg> {
        let [a, b] = carriers;
        let (few, other) = if self.legs[a].len() <= self.legs[b].len() { (a, b) } else { (b, a) };
        self.legs[few].iter().find(|leg| leg.other == other && a != b).copied()
    }

    fn close_dyad(&mut self, bodies: [usize; 2], joint: Leg, carried: [(Leg, Vec2); 2]) {
        let at_joint = [joint.own, joint.at_other];
        let arms = each([0, 1], |k| at_joint[k] - carried[k].0.own);
        let [p1, p2] = carried.each(|(_, at)| at);
        // a body may turn about three pins at one position
        if arms.iter().any(|arm| arm.norm() == 0.0) {
            self.result.assume();
        }
        let pin = self.pin_between(carried.each(|(leg, _)| leg.other));
        let opposite =
            pin.and_then(|pin| Some(self.poses[pin.other].as_ref()?.point(pin.at_other)));
        let (closures, missing) = match close(p1, arms[0].norm(), p2, arms[1].norm()) {
            Closure::Two(left, right) => (unfolded_first([p1, p2], [left, right], opposite), None),
            Closure::One(a, missing) => (vec![a], missing),
            Closure::Undetermined => return,
        };
        let angles: Vec<[f64; 2]> = closures
            .iter()
            .map(|p| each([0, 1], |k| self.dyad_angle(bodies[k], *p - carried[k].1, arms[k])))
            .list();
        let before = self.result.options.len();
        let chosen = match closures.len() {
            1 => 0,
            _ => self.decide(bodies, &angles),
        };
        for k in [0, 1] {
            self.hang(bodies[k], &carried[k].0, carried[k].1, angles[chosen][k]);
        }
        let second = chosen > 0 && self.result.options.len() > before;
        self.note_gap(bodies, joint.constraint, missing, before);
        self.result.dyads.push(Dyad {
            bodies,
            joint: joint.constraint,
            anchors: carried.each(|(leg, _)| leg.constraint),
            has_other: closures.len() == 2,
            slides: false,
            opposite: pin.map(|pin| pin.constraint),
            second,
        });
    }

    fn note_gap(&mut self, bodies: [usize; 2], joint: usize, missing: Option<f64>, choices: usize) {
        let gap = missing.map(|missing| DyadGap { bodies, joint, missing, choices });
        self.result.gaps.extend(gap);
    }

    /// Closes body `b` if it is on a slide and connected to a placed body by a link.
    pub fn close_slide_of(&mut self, b: usize) {
        let Some((slide, rail)) = self.rail(b).filter(|_| self.is_open(b)) else { return };
        let link = self.legs[b].iter().find_map(|joint| {
            let free = self.is_open(joint.other) && joint.other != b;
            let (anchor, at) = self.carried(joint.other).next().filter(|_| free)?;
            Some((*joint, anchor, at))
        });
        if let Some((joint, anchor, at)) = link {
            self.close_slide(b, (&slide, &rail), joint, (anchor, at));
        }
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
        if arm.norm() == 0.0 {
            self.result.assume();
        }
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
            .list();
        let bodies = [b, link];
        let before = self.result.options.len();
        let chosen = match closures.as_slice() {
            [first, second] => self.decide_place(bodies, [first, second]),
            _ => 0,
        };
        for (body, pose) in bodies.into_iter().zip(closures[chosen]) {
            self.put(body, pose);
        }
        self.note_gap(bodies, joint.constraint, missing, before);
        self.result.dyads.push(Dyad {
            bodies,
            joint: joint.constraint,
            anchors: [anchor.constraint, slide.constraint],
            has_other: closures.len() == 2,
            slides: true,
            opposite: None,
            second: false,
        });
    }

    /// Like [`Placer::decide`], but requested positions decide if there are no requested angles.
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
            _ => self.decide(bodies, &closures.each(|poses| poses.each(|pose| pose.angle))),
        }
    }

    /// Angle of a body whose arm must point along `global`.
    pub fn dyad_angle(&self, b: usize, global: Vec2, arm: Local) -> f64 {
        if arm.norm() == 0.0 {
            return self.targets.value(b, 2).unwrap_or(0.0);
        }
        let angle = direction((global.x, global.y)) - direction((arm.x, arm.y));
        self.targets.nearest_turn(b, angle)
    }

    /// Chooses one of two closures: the closure nearer to the guess, otherwise an undecided choice.
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
}

/// The left and the right closure of a dyad on two anchors. The unfolded closure, which lies away from the pin
/// `opposite` of the loop, is first. If this pin is on the line of the anchors, or missing, the left closure is
/// first.
fn unfolded_first(
    [p1, p2]: [Vec2; 2],
    [left, right]: [Vec2; 2],
    opposite: Option<Vec2>,
) -> Vec<Vec2> {
    match opposite.map(|at| (p2 - p1).cross(at - p1)) {
        Some(side) if side > ON_LINE * (p2 - p1).dot(p2 - p1) => vec![right, left],
        _ => vec![left, right],
    }
}
