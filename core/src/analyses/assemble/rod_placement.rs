//! Placement of a body by rods (`distance` joints): two rods hold a body of known angle, and one rod holds a body
//! that turns about a pin or moves along a slide. The positions are intersections of two circles, or of a line and a
//! circle.

use super::dyad::{close, Closure};
use super::equation_placement::Freedom;
use super::placement::Dyad;
use super::placer::Placer;
use super::targets::at_time;
use crate::elements::Fixes;
use crate::math::{each, Listed, Local, Pose, Vec2};

/// A rod from a placed body.
struct Rod {
    constraint: usize,
    /// Its end on the body to be placed.
    own: Local,
    /// Its other end.
    from: Vec2,
    /// m.
    length: f64,
}

impl Placer<'_> {
    /// Constraint `k` as a rod that holds body `b`. None if it is not a rod, or if its length depends on positions.
    fn rod(&self, k: usize, b: usize) -> Option<Rod> {
        let item = &self.equations.model.constraints[k];
        let element = at_time(self.equations.model, item, self.targets.t)?;
        let [Fixes::Distance(length)] = element.fixes()[..] else { return None };
        let end = item.bodies.iter().position(|body| body.0 == b)?;
        let other = self.poses[item.bodies[1 - end].0]?;
        let [own, at_other] = each([end, 1 - end], |end| element.attachment(end).s);
        let held = item.bodies[1 - end].0 != b && length.is_finite();
        held.then(|| Rod { constraint: k, own, from: other.point(at_other), length })
    }

    /// The poses at which rod `k` has its length; None if the constraint is not a rod.
    pub fn at_rod(&self, k: usize, b: usize, freedom: &Freedom) -> Option<Vec<Pose>> {
        let rod = self.rod(k, b)?;
        let at: Vec<f64> = match freedom {
            Freedom::Turn(leg, pin) => {
                let arm = rod.own - leg.own;
                if arm.norm() == 0.0 {
                    return Some(Vec::new());
                }
                let places = meeting((*pin, arm.norm()), (rod.from, rod.length));
                let angle = |place: &Vec2| self.dyad_angle(b, *place - *pin, arm);
                let mut angles: Vec<f64> = places.iter().map(angle).list();
                angles.sort_by(f64::total_cmp);
                angles
            }
            Freedom::Slide(rail) => match rail.meeting(rod.own, rod.from, rod.length) {
                (distances, None) => distances,
                _ => Vec::new(),
            },
        };
        Some(at.into_iter().map(|x| freedom.pose(x)).list())
    }

    /// Places body `b` with a known angle if two rods hold it; returns whether they do.
    pub fn close_rods_of(&mut self, b: usize, angle: f64) -> bool {
        let all = self.equations.of[b].iter();
        let rods: Vec<Rod> = all.filter_map(|k| self.rod(*k, b)).take(2).list();
        let [first, second] = &rods[..] else { return false };
        let turned = Pose::new(0.0, 0.0, angle);
        let centre = |rod: &Rod| rod.from - turned.global(rod.own);
        let circles = each([first, second], |rod| (centre(rod), rod.length));
        let posed = |place: &Vec2| Pose { r: *place, ..turned };
        let poses: Vec<Pose> = meeting(circles[0], circles[1]).iter().map(posed).list();
        let dyad = Dyad {
            bodies: [b, b],
            joint: first.constraint,
            anchors: [first.constraint, second.constraint],
            has_other: poses.len() == 2,
            slides: false,
            opposite: None,
            second: false,
        };
        let Some(pose) = self.chosen(b, &poses) else { return false };
        self.put(b, pose);
        self.result.dyads.push(dyad);
        true
    }
}

/// The intersections of two circles. Empty if the circles do not meet or are identical.
fn meeting((p1, r1): (Vec2, f64), (p2, r2): (Vec2, f64)) -> Vec<Vec2> {
    match close(p1, r1, p2, r2) {
        Closure::Two(left, right) => vec![left, right],
        Closure::One(place, None) => vec![place],
        Closure::One(_, Some(_)) | Closure::Undetermined => Vec::new(),
    }
}
