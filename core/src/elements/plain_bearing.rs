//! A joint whose bodies slide or rotate along one position quantity, so that it may have friction.

use super::attachment::Attachment;
use super::followed::{BodyId, JointId, QuantityOf};
use super::quantity_kind::QuantityKind;
use crate::expression::Tape;
use crate::math::{Local, Motion, Pose, Real, Rotation, Vec2};
use std::sync::Arc;

/// A joint with the frames on its bodies, and the position quantity along which they slide or rotate.
#[derive(Clone, Debug)]
pub struct Bearing<S = f64> {
    /// The joint.
    pub joint: JointId,
    /// Whether the joint also holds the angle of its bodies, so that a torque loads it.
    pub holds_angle: bool,
    /// The joint frames on bodies i and j.
    pub ends: [Attachment<S>; 2],
    /// The angle or displacement of body j relative to body i.
    pub coordinate: Arc<QuantityOf<Tape>>,
}

impl<S> Bearing<S> {
    /// Bodies i and j.
    pub fn bodies(&self) -> [BodyId; 2] {
        self.coordinate.bodies
    }

    /// Whether its bodies rotate relative to each other; otherwise body j slides along a line of body i.
    pub fn turns(&self) -> bool {
        self.coordinate.kind == QuantityKind::Angle
    }

    /// The same over another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Bearing<T> {
        let ends = [self.ends[0].map(f), self.ends[1].map(f)];
        let Self { joint, holds_angle, ref coordinate, .. } = *self;
        Bearing { joint, holds_angle, ends, coordinate: coordinate.clone() }
    }
}

impl<S: Real> Bearing<S> {
    /// The direction in which body j slides.
    pub fn direction(&self, i: &Pose<S>) -> Vec2<S> {
        let axis = Rotation::new(self.ends[0].axis);
        i.global(Local::new(axis.cos, axis.sin))
    }

    /// The global position of the point at which bodies i and j slide on each other.
    pub fn place(&self, j: &Pose<S>) -> Vec2<S> {
        j.point(self.ends[1].s)
    }

    /// The rate of the position quantity, m/s or rad/s.
    pub fn rate(&self, i: &Motion<S>, j: &Motion<S>) -> S {
        if self.turns() {
            return j.twist.omega - i.twist.omega;
        }
        let from_i = self.place(&j.pose) - i.pose.r;
        let of_i = i.twist.velocity + from_i.perp().scale(i.twist.omega);
        self.direction(&i.pose).dot(j.point_velocity(self.ends[1].s) - of_i)
    }
}
