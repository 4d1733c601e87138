//! Placement of bodies on slides. The other body determines the angle. The position along the slide follows from a
//! pin, a coordinate, or a link to a placed body.

use super::targets::Targets;
use crate::elements::Fixes;
use crate::math::{each, Local, Pose, Rotation, Vec2};
use crate::model::Model;

/// A slide, described from one of its bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slide {
    /// The joint.
    pub constraint: usize,
    /// The body at its other end.
    pub other: usize,
    pub own: Local,
    pub own_axis: f64,
    pub at_other: Local,
    pub other_axis: f64,
}

/// The possible positions of a body on a slide: `pose` moved along `direction`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rail {
    /// The pose at which the joint points coincide.
    pub pose: Pose,
    /// Unit vector along the slide.
    pub direction: Vec2,
    /// The joint point of the other body.
    pub guide: Vec2,
}

/// Smallest component of a direction along a coordinate for which the coordinate determines the position.
pub(super) const ACROSS: f64 = 1e-9;

/// The slides of each body.
pub(super) fn slides(model: &Model) -> Vec<Vec<Slide>> {
    let mut slides = vec![Vec::new(); model.bodies.len()];
    for (constraint, item) in model.constraints.iter().enumerate() {
        let fixes = item.element.fixes();
        if !(fixes.contains(&Fixes::Line) && fixes.contains(&Fixes::Direction)) {
            continue;
        }
        let ends = [item.bodies[0].0, item.bodies[1].0];
        let at = each([0, 1], |body| item.element.attachment(body));
        for (own, other) in [(0, 1), (1, 0)] {
            slides[ends[own]].push(Slide {
                constraint,
                other: ends[other],
                own: at[own].s,
                own_axis: at[own].axis,
                at_other: at[other].s,
                other_axis: at[other].axis,
            });
        }
    }
    slides
}

impl Slide {
    /// The possible positions of the body if the other body is placed. None if they are not finite.
    pub fn rail(&self, other: &Pose) -> Option<Rail> {
        let axis = other.angle + self.other_axis;
        let mut pose = Pose::new(0.0, 0.0, axis - self.own_axis);
        let guide = other.point(self.at_other);
        pose.r = guide - pose.global(self.own);
        let Rotation { cos, sin } = Rotation::new(axis);
        axis.is_finite().then_some(Rail { pose, direction: Vec2::new(cos, sin), guide })
    }
}

impl Rail {
    /// The pose at a distance along the slide, m.
    pub fn at(&self, distance: f64) -> Pose {
        let mut pose = self.pose;
        pose.r = pose.r + self.direction.scale(distance);
        pose
    }

    /// The pose at which x (0) or y (1) of the body has a value. None if the slide is perpendicular to this axis.
    pub fn reaching(&self, column: usize, value: f64) -> Option<Pose> {
        let (along, from) = match column {
            0 => (self.direction.x, self.pose.r.x),
            _ => (self.direction.y, self.pose.r.y),
        };
        (along.abs() > ACROSS).then(|| self.at((value - from) / along))
    }

    /// The pose nearest to the requested position of body `b`.
    pub fn towards(&self, b: usize, targets: &Targets) -> Pose {
        let targeted = |c: usize, otherwise: f64| targets.value(b, c).unwrap_or(otherwise);
        let place = Vec2::new(targeted(0, self.pose.r.x), targeted(1, self.pose.r.y));
        self.at((place - self.pose.r).dot(self.direction))
    }

    /// The positions at which the point `s` of the body has the distance `radius` from `center`: the intersections of
    /// a line and a circle, with the point ahead first. Returns the distances along the slide, and the length by
    /// which the radius is too short, m.
    pub fn meeting(&self, s: Local, center: Vec2, radius: f64) -> (Vec<f64>, Option<f64>) {
        let from = self.pose.point(s) - center;
        let (along, across) = (-from.dot(self.direction), self.direction.cross(from).abs());
        let scale = radius.max(across);
        let square = (radius - across) * (radius + across);
        if square > (1e-9 * scale).powi(2) {
            let half = square.sqrt();
            return (vec![along + half, along - half], None);
        }
        let missing = across - radius;
        (vec![along], (missing > 1e-9 * scale).then_some(missing))
    }
}
