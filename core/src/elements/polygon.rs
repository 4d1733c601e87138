//! Closed polygons of straight edges. `elements/polygon_foot.rs` contains the nearest point of a convex polygon.

use super::convex_parts;
use crate::math::{Listed, Local, Real};
use std::sync::Arc;

/// The distance that is added between two sharp corners, relative to the circumference.
const SHARP: f64 = 1e-8;

/// An edge of a polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    pub from: Local,
    /// Its direction, a unit vector.
    pub along: Local,
    pub length: f64,
    /// The length of the edges before it.
    pub start: f64,
    /// The angle by which the edges before it turn.
    pub turn: f64,
    /// The chain of edges to which it belongs; None for a diagonal of a larger polygon, which no body touches.
    pub chain: Option<usize>,
}

impl Edge {
    /// The outward normal.
    pub fn normal(&self) -> Local {
        -self.along.perp()
    }

    /// The length along the edge to the foot of p, and the height of p above the edge.
    pub fn of(&self, p: Local) -> [f64; 2] {
        let arm = p - self.from;
        [self.along.dot(arm), self.normal().dot(arm)]
    }
}

/// A closed polygon with its corners in counter-clockwise order.
#[derive(Clone, Debug)]
pub struct Polygon {
    pub(super) edges: Arc<[Edge]>,
    /// Added to the distance from a corner. Between two sharp corners, it is positive, because two corners that pass each
    /// other touch along an edge before and after.
    pub(super) apart: f64,
}

/// A point as constants of a scalar.
pub(super) fn constant<S: Real>(s: Local) -> Local<S> {
    Local::new(S::constant(s.x), S::constant(s.y))
}

impl Polygon {
    /// The polygon with these corners.
    pub fn new(corners: &[Local]) -> Self {
        Self::part(&corners.iter().map(|s| (*s, true)).list())
    }

    /// The part of a polygon with these corners; the edge after each of them may be touched or not.
    pub fn part(corners: &[(Local, bool)]) -> Self {
        let count = corners.len();
        // the chain of the first edge may begin before it
        let first = (0..count).find(|k| !corners[*k].1).map_or(0, |k| k + 1);
        let mut chains = vec![None; count];
        let mut chain = 0;
        for k in (0..count).map(|k| (k + first) % count) {
            chain += usize::from(!corners[k].1);
            chains[k] = corners[k].1.then_some(chain);
        }
        let (mut start, mut turn, mut before) = (0.0, 0.0, None::<Local>);
        let edge = |k: usize| {
            let from = corners[k].0;
            let way = corners[(k + 1) % count].0 - from;
            let length = way.norm();
            let along = way.scale(1.0 / length);
            turn += before.map_or(0.0, |last| last.cross(along).atan2(last.dot(along)));
            let edge = Edge { from, along, length, start, turn, chain: chains[k] };
            (start, before) = (start + length, Some(along));
            edge
        };
        Self { edges: (0..count).map(edge).list().into(), apart: 0.0 }
    }

    /// The same polygon, whose corners other sharp corners do not touch.
    pub fn sharp(self) -> Self {
        Self { apart: SHARP * self.length(), ..self }
    }

    /// Its corners.
    pub fn corners(&self) -> Vec<Local> {
        self.edges.iter().map(|edge| edge.from).list()
    }

    /// Its circumference.
    pub fn length(&self) -> f64 {
        self.edges.last().map_or(0.0, |edge| edge.start + edge.length)
    }

    /// C, C′, C″ and C‴ at a length along it.
    pub fn derivatives<S: Real>(&self, u: S) -> [Local<S>; 4] {
        let at = u.in_lanes()[0];
        let whole = self.length() * (at / self.length()).floor();
        let k = self.edges.iter().rposition(|edge| edge.start <= at - whole).unwrap_or(0);
        let Edge { from, along, start, .. } = self.edges[k];
        let along = constant(along);
        let here = constant(from) + along.scale(u - S::constant(whole + start));
        [here, along, Local::zero(), Local::zero()]
    }

    /// The reason why it cannot be used.
    pub fn fault(&self) -> Option<String> {
        convex_parts::fault(&self.corners())
    }
}
