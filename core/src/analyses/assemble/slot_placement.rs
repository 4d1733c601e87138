//! Placement of a body by points on straight lines, such as pins in slots: one such joint determines the freedom that a
//! pin or a slide leaves, and two of them hold a body of known angle. The positions are intersections of lines, or of a
//! line and a circle.

use super::equation_placement::Freedom;
use super::placer::{direction, Placer};
use super::targets::at_time;
use crate::elements::{Attachment, Fixes};
use crate::math::{each, Listed, Local, Ordered, Pose, Rotation, Vec2};

/// Smallest sine between two lines that determines their intersection.
const PARALLEL: f64 = 1e-9;
/// Half of a chord, relative to the circle, below which its ends coincide.
const TOUCHING: f64 = 1e-9;

/// A point on a line, of which one body is placed.
struct Slot {
    /// Whether the line belongs to the body to be placed.
    line_is_own: bool,
    /// The joint frame on the body to be placed.
    own: Attachment,
    /// The pose of the other body, and the joint frame on it.
    other: Pose,
    at_other: Attachment,
    /// Distance of the point to the left of the line, m.
    beside: f64,
}

/// The line normal · r = value on which the origin r of a body with known angle lies.
struct StraightLine {
    normal: Vec2,
    value: f64,
}

impl Slot {
    /// The line for a body turned by `angle`.
    fn line(&self, angle: f64) -> StraightLine {
        let turned = Pose::new(0.0, 0.0, angle);
        let (own, other) = (turned.global(self.own.s), self.other.point(self.at_other.s));
        if self.line_is_own {
            let normal = axis(angle + self.own.axis).perp();
            return StraightLine { normal, value: normal.dot(other - own) - self.beside };
        }
        let normal = axis(self.other.angle + self.at_other.axis).perp();
        StraightLine { normal, value: normal.dot(other - own) + self.beside }
    }

    /// The directions from a pin at `pin` in which the arm `from` the pin's place on the body must point, with this arm.
    fn directions(&self, from: Local, pin: Vec2) -> Vec<(Vec2, Local)> {
        let other = self.other.point(self.at_other.s) - pin;
        let arm = self.own.s - from;
        if self.line_is_own {
            // the point of the other body, seen from the pin, has these coordinates along and beside the line
            let Rotation { cos, sin } = Rotation::new(self.own.axis);
            let beside = arm.dot(Local::new(-sin, cos)) + self.beside;
            let at =
                |along: f64| Local::new(along * cos - beside * sin, along * sin + beside * cos);
            return chord(other.norm(), beside).into_iter().map(|along| (other, at(along))).list();
        }
        let line = axis(self.other.angle + self.at_other.axis);
        let beside = line.perp().dot(other) + self.beside;
        let to = |along: f64| line.scale(along) + line.perp().scale(beside);
        chord(arm.norm(), beside).into_iter().map(|along| (to(along), arm)).list()
    }
}

impl Placer<'_> {
    /// Constraint `k` as a point on a line between body `b` and a placed body. None if it is not, or if it depends on
    /// positions.
    fn slot(&self, k: usize, b: usize) -> Option<Slot> {
        let item = &self.equations.model.constraints[k];
        let element = at_time(self.equations.model, item, self.targets.t)?;
        let line = |fixes: &Fixes<f64>| match fixes {
            Fixes::Line => Some(0.0),
            Fixes::Beside(distance) => Some(*distance),
            _ => None,
        };
        let fixes = element.fixes();
        if fixes.contains(&Fixes::Turn) {
            return None;
        }
        let beside = fixes.iter().find_map(line).filter(|beside| beside.is_finite())?;
        let end = item.bodies.iter().position(|body| body.0 == b)?;
        let other = item.bodies[1 - end].0;
        let other_pose = self.poses[other].filter(|_| other != b)?;
        let [own, at_other] = each([end, 1 - end], |end| element.attachment(end));
        Some(Slot { line_is_own: end == 0, own, other: other_pose, at_other, beside })
    }

    /// The poses at which constraint `k`, a point on a line, holds, those with the point ahead first; None if it is not
    /// one.
    pub fn at_slot(&self, k: usize, b: usize, freedom: &Freedom) -> Option<Vec<Pose>> {
        let slot = self.slot(k, b)?;
        let at: Vec<f64> = match freedom {
            Freedom::Turn(leg, pin) => {
                let directions = slot.directions(leg.own, *pin);
                let usable =
                    directions.into_iter().filter(|(to, arm)| to.norm() > 0.0 && arm.norm() > 0.0);
                let mut angles: Vec<f64> =
                    usable.map(|(to, arm)| self.dyad_angle(b, to, arm)).list();
                angles.sort_by(f64::total_cmp);
                angles
            }
            Freedom::Slide(rail) => {
                let StraightLine { normal, value } = slot.line(rail.pose.angle);
                let slope = normal.dot(rail.direction);
                let distance = (value - normal.dot(rail.pose.r)) / slope;
                if slope.abs() > PARALLEL {
                    vec![distance]
                } else {
                    Vec::new()
                }
            }
        };
        let mut poses: Vec<Pose> = at.into_iter().map(|x| freedom.pose(x)).list();
        poses.order_by_key(|pose| !self.is_ahead(k, b, pose));
        Some(poses)
    }

    /// Places body `b` with a known angle if two points on lines hold it; returns whether they do.
    pub fn close_slots_of(&mut self, b: usize, angle: f64) -> bool {
        let all = self.equations.of[b].iter();
        let slots = all.filter_map(|k| self.slot(*k, b));
        let lines: Vec<StraightLine> = slots.map(|slot| slot.line(angle)).list();
        let Some((first, rest)) = lines.split_first() else { return false };
        let crosses = |other: &&StraightLine| first.normal.cross(other.normal).abs() > PARALLEL;
        let Some(second) = rest.iter().find(crosses) else { return false };
        let across = first.normal.cross(second.normal);
        let x = (first.value * second.normal.y - second.value * first.normal.y) / across;
        let y = (first.normal.x * second.value - second.normal.x * first.value) / across;
        self.put(b, Pose::new(x, y, angle));
        true
    }

    /// The angle of body `b` if a slide fixes it to that of a body whose angle is known by a rail.
    pub fn angle_by_slide(&self, b: usize) -> Option<f64> {
        self.slides[b].iter().find_map(|slide| {
            let (_, rail) = self.rail(slide.other).filter(|_| self.is_open(slide.other))?;
            Some(rail.pose.angle + slide.other_axis - slide.own_axis)
        })
    }

    /// Places a body that a slide connects with an open body: both have a pin on placed bodies, or one of them has a pin
    /// and the other one a slide.
    pub fn close_slide_between(&mut self, b: usize) {
        let Some((leg, pin)) = self.carried(b).next().filter(|_| self.is_open(b)) else { return };
        if let Some(angle) = self.angle_by_slide(b) {
            return self.hang(b, &leg, pin, angle);
        }
        for k in 0..self.slides[b].len() {
            let slide = self.slides[b][k];
            let far = self.carried(slide.other).next().filter(|_| self.is_open(slide.other));
            let Some((far, other)) = far else { continue };
            // along and beside the slide, from the one pin to the other
            let across = |angle: f64| {
                let Rotation { cos, sin } = Rotation::new(angle);
                Local::new(-sin, cos)
            };
            let beside = across(slide.own_axis).dot(slide.own - leg.own)
                + across(slide.other_axis).dot(far.own - slide.at_other);
            let line = other - pin;
            let angles = chord(line.norm(), beside).into_iter().map(|along| {
                let own = direction((line.x, line.y)) - direction((along, beside)) - slide.own_axis;
                self.targets.nearest_turn(b, own)
            });
            let poses: Vec<Pose> = angles.map(|x| Freedom::Turn(leg, pin).pose(x)).list();
            if line.norm() > 0.0 {
                if let Some(pose) = self.chosen(b, &poses) {
                    return self.put(b, pose);
                }
            }
        }
    }

    /// Places a body that slides connect with two placed bodies.
    pub fn close_two_slides(&mut self, b: usize) {
        let Some((first, rail)) = self.rail(b).filter(|_| self.is_open(b)) else { return };
        let freedom = Freedom::Slide(rail);
        let others = self.slides[b].iter().filter(|slide| slide.constraint != first.constraint);
        let poses = others.filter_map(|slide| self.at_slot(slide.constraint, b, &freedom));
        let found = poses.flatten().next();
        found.into_iter().for_each(|pose| self.put(b, pose));
    }

    /// Places a body on a slide that a pin connects with an open body on another slide.
    pub fn close_pin_between_slides(&mut self, b: usize) {
        let Some((_, rail)) = self.rail(b).filter(|_| self.is_open(b)) else { return };
        for k in 0..self.legs[b].len() {
            let leg = self.legs[b][k];
            let far = self.rail(leg.other).filter(|_| self.is_open(leg.other) && leg.other != b);
            let Some((_, other)) = far else { continue };
            let apart = other.pose.point(leg.at_other) - rail.pose.point(leg.own);
            let across = rail.direction.cross(other.direction);
            if across.abs() > PARALLEL {
                return self.put(b, rail.at(apart.cross(other.direction) / across));
            }
        }
    }
}

/// The halves of a chord at a distance from the centre of a circle, with both signs. One value if the line touches the
/// circle, none if it misses.
fn chord(radius: f64, distance: f64) -> Vec<f64> {
    let square = (radius - distance) * (radius + distance);
    if square > (TOUCHING * radius).powi(2) {
        return vec![square.sqrt(), -square.sqrt()];
    }
    if square >= -TOUCHING * radius * radius {
        vec![0.0]
    } else {
        Vec::new()
    }
}

fn axis(angle: f64) -> Vec2 {
    let Rotation { cos, sin } = Rotation::new(angle);
    Vec2::new(cos, sin)
}
