//! Placement of a body with one remaining freedom by a contact with a curve, such as the follower of a cam.
//!
//! For each pose of the body, the internal coordinate u takes its nearest value. The component of Φ perpendicular to
//! ∂Φ/∂u is then the signed distance of the bodies. It is sampled along the freedom, and its zeros are the positions
//! of contact.

use super::equation_placement::{zeros, Freedom, NOTHING};
use super::placer::Placer;
use crate::elements::At;
use crate::math::{Listed, Ordered, Pose, Vec2};
use std::f64::consts::PI;

/// Largest distance that remains at a contact, as a fraction of the reach of the curve. Beyond the end of a curve, a
/// larger distance remains.
const TOUCHES: f64 = 1e-3;
/// Number of halvings of an interval with a contact. Each halving finds the nearest u.
const HALVINGS: i32 = 12;
/// Number of samples along the freedom.
const PLACES: usize = 48;
/// Half of the length along a slide in which contacts are searched, as a multiple of the reach of the curve.
const FAR: f64 = 3.0;

impl Placer<'_> {
    /// The poses of body `b` at which constraint `k`, a contact with a curve, holds; the preferred pose first.
    pub fn contacts(&self, k: usize, b: usize, freedom: &Freedom) -> Vec<Pose> {
        let item = &self.equations.model.constraints[k];
        let Some(curve) = item.element.curve() else { return Vec::new() };
        let reach = curve.curve.reach();
        let (place, other) = match item.bodies[0].0 == b {
            true => (0, item.bodies[1].0),
            false => (1, item.bodies[0].0),
        };
        let Some(other) = self.poses[other] else { return Vec::new() };
        let own = item.element.attachment(place).s;
        // the position on the freedom at which the point of the body is nearest to the other body
        let target = other.point(item.element.attachment(1 - place).s);
        let from = match freedom {
            Freedom::Slide(rail) => (target - rail.pose.point(own)).dot(rail.direction),
            Freedom::Turn(..) => self.targets.value(b, 2).unwrap_or(0.0),
        };
        let half = if matches!(freedom, Freedom::Turn(..)) { PI } else { FAR * reach };
        let at = |k: usize| from + 2.0 * half * ((k as f64 + 0.377) / PLACES as f64 - 0.5);
        let gap = |x: f64| self.distance(k, b, &freedom.pose(x)).map_or(f64::NAN, |[gap, _]| gap);
        let mut found = zeros(gap, (PLACES, at), NOTHING * reach, HALVINGS);
        found.retain(|x| {
            let left = self.distance(k, b, &freedom.pose(*x));
            left.is_some_and(|[_, left]| left <= TOUCHES * reach)
        });
        // a guide beside the curve decides the side; otherwise the point lies ahead on the slide
        let off = |x: &f64| match freedom {
            Freedom::Turn(..) => (x - from).abs(),
            Freedom::Slide(rail) if (rail.guide - other.r).norm() > reach => {
                (freedom.pose(*x).point(own) - rail.guide).norm()
            }
            Freedom::Slide(_) => -x,
        };
        found.order_by(|a, b| off(a).total_cmp(&off(b)));
        found.into_iter().map(|x| freedom.pose(x)).list()
    }

    /// The signed distance of the bodies of a contact perpendicular to ∂Φ/∂u, and |Φ|, with body `b` at a pose.
    fn distance(&self, k: usize, b: usize, pose: &Pose) -> Option<[f64; 2]> {
        let item = &self.equations.model.constraints[k];
        let place = |body: usize| if body == b { Some(*pose) } else { self.poses[body] };
        let bodies: Option<Vec<Pose>> = item.bodies.iter().map(|body| place(body.0)).collect();
        let (bodies, t) = (bodies?, self.targets.t);
        let u = *item.element.own_start(&bodies).first()?;
        let [low, high] = item.element.curve()?.curve.range();
        let h = 1e-5 * (high - low);
        let phi = |u: f64| {
            let mut phi = [0.0; 2];
            item.element.residual(&At { bodies: &bodies, own: &[u], t }, &mut phi);
            Vec2::new(phi[0], phi[1])
        };
        let (here, along) = (phi(u), phi(u + h) - phi(u - h));
        Some([along.cross(here) / along.norm(), here.norm()])
    }
}
