//! Formulas that several elements share for their position quantities.

use super::joint_trait::At;
use super::kinds::PointOn;
use crate::math::{Local, Real, Rotation, Vec2};

/// The angle of body j relative to body i.
#[inline]
pub(super) fn turned<S: Real>(at: &At<'_, S>) -> S {
    at.j().angle - at.i().angle
}

/// d = Pⱼ - Pᵢ.
#[inline]
pub(super) fn apart<S: Real>(at: &At<'_, S>, i: &PointOn<S>, j: &PointOn<S>) -> Vec2<S> {
    at.j().point(j.s) - at.i().point(i.s)
}

/// uᵀ d with u at the angle `axis` in the frame of body i.
#[inline]
pub(super) fn along<S: Real>(at: &At<'_, S>, axis: S, i: &PointOn<S>, j: &PointOn<S>) -> S {
    let axis = Rotation::new(axis);
    at.i().global(Local::new(axis.cos, axis.sin)).dot(apart(at, i, j))
}

/// |d|; zero with zero derivatives where the points coincide.
#[inline]
pub(super) fn length<S: Real>(at: &At<'_, S>, i: &PointOn<S>, j: &PointOn<S>) -> S {
    let d = apart(at, i, j);
    let squared = d.dot(d);
    S::select(squared, squared.sqrt(), S::zero())
}
