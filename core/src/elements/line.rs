//! The line between two points of a force element.

use super::force_trait::Situation;
use super::kinds::PointOn;
use crate::math::{Real, Vec2, Wrench};

/// The line from point i to point j. Where the points coincide, it has no direction.
pub(super) struct Line<S> {
    /// d = Pⱼ - Pᵢ.
    pub d: Vec2<S>,
    /// |d|², zero where the points coincide.
    pub squared: S,
    /// |d|, zero with zero slopes where the points coincide.
    pub length: S,
    /// d/|d|, zero where the points coincide.
    pub u: Vec2<S>,
    /// The arms of both points in the global frame.
    arms: [Vec2<S>; 2],
}

/// The vectors from the origins of bodies i and j to a point of body j.
pub(super) fn arms<S: Real>(j: &PointOn<S>, at: &Situation<'_, S>) -> [Vec2<S>; 2] {
    let arm = at.j().pose.global(j.s);
    [at.j().pose.r + arm - at.i().pose.r, arm]
}

impl<S: Real> Line<S> {
    /// The line through points on body i and body j.
    pub fn new(at: &Situation<'_, S>, i: &PointOn<S>, j: &PointOn<S>) -> Self {
        let d = at.j().pose.point(j.s) - at.i().pose.point(i.s);
        let (squared, zero) = (d.dot(d), S::zero());
        let length = S::select(squared, squared.sqrt(), zero);
        let along = |x: S| S::select(squared, x / length, zero);
        let u = Vec2::new(along(d.x), along(d.y));
        let arms = [at.i().pose.global(i.s), at.j().pose.global(j.s)];
        Self { d, squared, length, u, arms }
    }

    /// The wrenches on bodies i and j of a force on j.
    #[inline]
    pub fn wrenches(&self, force: Vec2<S>) -> [Wrench<S>; 2] {
        [Wrench::at(self.arms[0], -force), Wrench::at(self.arms[1], force)]
    }
}
