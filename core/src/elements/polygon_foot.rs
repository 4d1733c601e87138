//! The point of a convex polygon that is nearest to a given point.
//!
//! Outside of the polygon, the nearest point is on an edge or at a corner, and the distance has a continuous gradient.
//! Inside, it is on the edge that is least far away. A contact with a polygon that is not convex is a contact with each of
//! its convex parts, see `elements/convex_parts.rs`. A body that rests is held by the line of an edge, or by a corner,
//! until it leaves the edge or corner.

use super::apart::{from_corner, Apart, Way};
use super::near::{choose, Near};
use super::plane_curve::Curve;
use super::polygon::{constant, Edge, Polygon};
use crate::expression::Tape;
use crate::math::{each, Local, Real, ShortArray};
use std::f64::consts::TAU;

/// The edge or corner nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Feature {
    Edge(usize),
    /// The corner at which an edge begins.
    Corner(usize),
}

/// The nearest point of a polygon.
pub(super) struct PolygonFoot<S> {
    pub near: Near<S>,
    /// 1 above an edge, 0 at a corner.
    pub level: S,
    /// The length along the polygon, and the angle by which its normal turns, up to the nearest point.
    pub along: [S; 2],
}

/// A body that rests on an edge or corner leaves it at this distance beyond its end, relative to the circumference. Then
/// the nearest point is certainly on what follows.
pub(super) const BEYOND: f64 = 4e-12;

/// The length of the line that supports an edge or a point on a line, on either side: in circumferences, or in lengths of
/// the line.
pub(super) const SUPPORT: f64 = 10.0;

impl Polygon {
    /// The edge or corner nearest to p, for a convex polygon.
    fn feature(&self, p: Local) -> Feature {
        let highest = |all: &dyn Fn(&Edge) -> bool| {
            let heights = self.edges.iter().enumerate().filter(|(_, edge)| all(edge));
            heights.map(|(k, edge)| (edge.of(p)[1], k)).max_by(|a, b| a.0.total_cmp(&b.0))
        };
        if highest(&|_| true).is_some_and(|(up, _)| up <= 0.0) {
            return Feature::Edge(highest(&|edge| edge.chain.is_some()).map_or(0, |(_, k)| k));
        }
        let own = (0..self.edges.len()).filter(|k| self.edges[*k].chain.is_some());
        let nearest = own.map(|k| self.off_edge(k, p)).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or(Feature::Edge(0), |(_, feature)| feature)
    }

    /// The distance of p from an edge or, if p is not above the edge, from one of its ends.
    fn off_edge(&self, k: usize, p: Local) -> (f64, Feature) {
        let edge = &self.edges[k];
        let [u, up] = edge.of(p);
        let end = match u < 0.5 * edge.length {
            true => (u.hypot(up), Feature::Corner(k)),
            false => ((u - edge.length).hypot(up), Feature::Corner((k + 1) % self.edges.len())),
        };
        let above = up > 0.0 && u >= 0.0 && u <= edge.length;
        if above {
            (up, Feature::Edge(k))
        } else {
            end
        }
    }

    /// The point of a support that is nearest to p.
    pub(super) fn foot_on_support<S: Real>(&self, support: usize, p: Local<S>) -> PolygonFoot<S> {
        let corner = support.checked_sub(self.edges.len());
        self.foot_on(corner.map_or(Feature::Edge(support), Feature::Corner), p)
    }

    /// The point nearest to p, for a convex polygon.
    pub(super) fn foot<S: Real>(&self, p: Local<S>) -> PolygonFoot<S> {
        let (x, y) = (p.x.in_lanes(), p.y.in_lanes());
        let mut features = [self.feature(Local::new(x[0], y[0])); 4];
        for lane in (1..4).filter(|lane| (x[*lane], y[*lane]) != (x[0], y[0])) {
            features[lane] = self.feature(Local::new(x[lane], y[lane]));
        }
        let mut found = self.foot_on(features[0], p);
        for lane in (1..4).filter(|lane| !features[..*lane].contains(&features[*lane])) {
            let own = each(features, |of| if of == features[lane] { 1.0 } else { -1.0 });
            let (own, other) = (S::of_lanes(own), self.foot_on(features[lane], p));
            let pick = |a: S, b: S| S::select(own, a, b);
            found = PolygonFoot {
                near: choose(own, other.near, found.near),
                level: pick(other.level, found.level),
                along: each([0, 1], |k| pick(other.along[k], found.along[k])),
            };
        }
        found
    }

    fn foot_on<S: Real>(&self, feature: Feature, p: Local<S>) -> PolygonFoot<S> {
        let of = S::constant;
        match feature {
            Feature::Edge(k) => {
                let edge = &self.edges[k];
                let (from, along) = (constant::<S>(edge.from), constant::<S>(edge.along));
                let (away, arm) = (constant::<S>(edge.normal()), p - from);
                let u = along.dot(arm);
                PolygonFoot {
                    near: Near { distance: away.dot(arm), away, place: from + along.scale(u) },
                    level: S::one(),
                    along: [of(edge.start) + u, of(edge.turn)],
                }
            }
            Feature::Corner(k) => {
                let (last, place) = (self.before(k), constant::<S>(self.edges[k].from));
                let (normal, arm) = (constant::<S>(last.normal()), p - place);
                let distance = arm.norm();
                let away = arm.scale(S::one() / distance);
                let turned = normal.cross(away).atan2(normal.dot(away));
                PolygonFoot {
                    near: Near { distance: distance + of(self.apart), away, place },
                    level: S::zero(),
                    along: [of(last.start + last.length), of(last.turn) + turned],
                }
            }
        }
    }

    /// The edge before an edge.
    fn before(&self, k: usize) -> &Edge {
        &self.edges[(k + self.edges.len() - 1) % self.edges.len()]
    }

    /// The index of the edge or corner nearest to p.
    pub(super) fn support(&self, p: Local) -> usize {
        match self.feature(p) {
            Feature::Edge(k) => k,
            Feature::Corner(k) => self.edges.len() + k,
        }
    }

    /// The curve on which a body rests: the line of an edge, or a corner as a circle without radius.
    pub(super) fn supporting(&self, support: usize) -> Curve<Tape> {
        let tapes = |s: Local| Local { x: Tape::from(s.x), y: Tape::from(s.y) };
        let Some(edge) = self.edges.get(support) else {
            let center = tapes(self.edges[support - self.edges.len()].from);
            return Curve::Circle { center, radius: Tape::from(0.0) };
        };
        let way = edge.along.scale(SUPPORT * self.length());
        Curve::Line { from: tapes(edge.from - way), to: tapes(edge.from + way) }
    }

    /// Whether a support is an edge.
    pub(super) fn is_edge(&self, support: usize) -> bool {
        support < self.edges.len()
    }

    /// How far p is from where a support ends, relative to the circumference.
    pub(super) fn margin<S: Real>(&self, support: usize, p: Local<S>) -> S {
        let of = S::constant;
        let left = match self.edges.get(support) {
            Some(edge) => {
                let u = constant::<S>(edge.along).dot(p - constant(edge.from));
                u.min(of(edge.length) - u)
            }
            None => {
                let k = support - self.edges.len();
                let arm = p - constant(self.edges[k].from);
                let [last, next] =
                    [self.before(k), &self.edges[k]].each(|e| constant::<S>(e.along));
                last.dot(arm).min(-next.dot(arm))
            }
        };
        left / of(self.length()) + of(BEYOND)
    }

    /// The length rolled by a circle once around a convex polygon.
    pub(super) fn turn<S: Real>(&self, radius: S) -> S {
        S::constant(self.length()) + S::constant(TAU) * radius
    }

    /// The distance of p from a convex polygon, with the turning of its gradient along a way around p.
    pub(super) fn apart(&self, p: Local, way: Way) -> Apart {
        let (near, within) = (self.foot(p).near, way.within);
        let Near { distance, away, .. } = near;
        let feature = self.feature(p);
        let flat = match feature {
            Feature::Corner(_) => false,
            Feature::Edge(k) => {
                let [u, up] = self.edges[k].of(p);
                let level = u.min(self.edges[k].length - u) > within;
                // inside, no other edge is nearer
                let others = self.edges.iter().enumerate().filter(|(other, _)| *other != k);
                let highest = others.map(|(_, edge)| edge.of(p)[1]).fold(f64::MIN, f64::max);
                level && (up > within || highest + 2.0 * within < up)
            }
        };
        let bend = if flat { 0.0 } else { from_corner(distance, within) };
        // the distance from the chain of the nearest edge has a continuous gradient, except at another end of the chain
        let beside = |k: usize| match feature {
            Feature::Edge(own) => self.edges[k].chain == self.edges[own].chain,
            Feature::Corner(own) => {
                let [edge, last] = [self.edges[own].chain, self.before(own).chain];
                let adjacent = k == own || (k + 1) % self.edges.len() == own;
                adjacent || edge == last && self.edges[k].chain == edge
            }
        };
        let own = (0..self.edges.len()).filter(|k| self.edges[*k].chain.is_some());
        let others = own.filter(|k| !beside(*k)).map(|k| self.off_edge(k, p).0 - within);
        let other = others.fold(f64::INFINITY, f64::min);
        let other = if other > distance.abs() + within { f64::INFINITY } else { other };
        Apart { distance, away, bend, error: 0.0, other }
    }
}
