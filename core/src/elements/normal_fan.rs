//! A convex body by the directions of its outward normals.
//!
//! In each direction θ, the boundary has an extreme point: the one that is farthest in this direction. Where the boundary
//! is curved, the extreme point moves along an arc with θ; at a corner, it stays for an angle; at an edge, it jumps from
//! one corner to the next. The body of a closed curve is its inside. That of an open curve lies between the curve and its
//! chord. That of a line lies behind it, between the normals at its ends.

use super::contact::{curvature, places};
use super::kinds::Side;
use super::plane_curve::Curve;
use crate::math::{Listed, Local, Real, ShortArray};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

/// Number of directions with a stored extreme point.
pub(super) const DIRECTIONS: usize = 720;

/// Factor between the extreme radii of curvature at the places of an arc and those between them.
const MARGIN: f64 = 1.5;

/// Least curvature of an arc, relative to a curve of the same size.
const FLAT: f64 = 1e-6;

/// Two edges of a convex polygon turn back by less than this angle.
const STRAIGHT: f64 = 1e-6;

/// A part of the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Patch {
    /// A place on the curve.
    Arc,
    Corner(usize),
    /// The edge with this index in [`NormalFan::edges`].
    Edge(usize),
    /// No place: the body is endless in this direction.
    Outside,
}

/// The farthest place in a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExtremePlace {
    pub patch: Patch,
    /// The place along the curve, on an arc.
    pub u: f64,
    pub point: Local,
    /// The radius of curvature.
    pub radius: f64,
}

/// A straight part of the boundary: its outward normal and the extreme points before and after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatEdge {
    pub theta: f64,
    pub ends: [Patch; 2],
}

/// The unit vector with an angle.
pub(super) fn direction(theta: f64) -> Local {
    Local::new(theta.cos(), theta.sin())
}

/// The corners of a curve in the order of the curve.
pub(super) fn corner<S: Real>(curve: &Curve<S>, k: usize) -> Local<S> {
    match curve {
        Curve::Line { from, to } => [*from, *to][k],
        Curve::Polygon(own) => super::polygon::constant(own.edges[k].from),
        curve => curve.point(curve.range()[k]),
    }
}

/// C, C′, C″ and C‴ of a part of the boundary, along u or along an edge.
#[inline(never)]
pub(super) fn terms<S: Real>(curve: &Curve<S>, patch: Patch, u: S) -> [Local<S>; 4] {
    let zero = Local::zero();
    let straight = |from: Local<S>, along: Local<S>| [from, along, zero, zero];
    match (patch, curve) {
        (Patch::Corner(k), _) => straight(corner(curve, k), zero),
        (Patch::Edge(0), Curve::Line { from, to }) => straight(*from, *to - *from),
        // the normals at the ends of a line
        (Patch::Edge(k), Curve::Line { from, to }) => {
            straight([*from, *to][k - 1], (*to - *from).perp())
        }
        (Patch::Edge(k), Curve::Polygon(own)) => {
            straight(corner(curve, k), super::polygon::constant(own.edges[k].along))
        }
        (Patch::Edge(_), _) => straight(corner(curve, 1), corner(curve, 0) - corner(curve, 1)),
        _ => curve.derivatives(u),
    }
}

/// The outward normals of a convex body with their extreme points.
#[derive(Debug)]
pub(super) struct NormalFan {
    curve: Curve,
    /// +1 if growing u turns about the body counter-clockwise, -1 otherwise.
    out: f64,
    /// The angle at which each part of the boundary begins, ascending over one turn.
    parts: Vec<(f64, Patch)>,
    pub edges: Vec<FlatEdge>,
    /// Angles of the normal along the arc, ascending, with u.
    arc: Vec<[f64; 2]>,
    /// The extreme points in [`DIRECTIONS`], the first in the direction of x.
    pub grid: Vec<Option<Local>>,
    /// The smallest and largest radii of curvature of the arc.
    radii: [f64; 2],
    /// The diameter of a circle that contains the boundary.
    pub size: f64,
}

impl NormalFan {
    pub fn new(curve: &Curve, side: Side) -> Self {
        let out = if side == Side::Right { 1.0 } else { -1.0 };
        let mut own = Self {
            curve: curve.clone(),
            out,
            parts: Vec::new(),
            edges: Vec::new(),
            arc: Vec::new(),
            grid: Vec::new(),
            radii: [0.0; 2],
            size: 0.0,
        };
        match curve {
            Curve::Line { .. } => own.of_line(),
            Curve::Polygon(all) => {
                let count = all.edges.len();
                let normal = |k: usize| angle(all.edges[k % count].normal());
                own.of_corners((0..count).map(|k| (normal(k + count - 1), k)).list());
            }
            _ => own.of_arc(),
        }
        let at = |k: usize| own.extreme(TAU * k as f64 / DIRECTIONS as f64);
        let grid =
            (0..DIRECTIONS).map(at).map(|of| (of.patch != Patch::Outside).then_some(of.point));
        own.grid = grid.list();
        let known = own.grid.iter().flatten();
        let [low, high] = [f64::min, f64::max].each(|pick| {
            let start = pick(f64::INFINITY, f64::NEG_INFINITY);
            known.clone().fold([-start; 2], |m, p| [pick(m[0], p.x), pick(m[1], p.y)])
        });
        own.size = MARGIN * (high[0] - low[0]).hypot(high[1] - low[1]);
        own
    }

    /// Corners, each with the normal of the edge before it.
    fn of_corners(&mut self, all: Vec<(f64, usize)>) {
        let mut last = all[0].0;
        let part = |(theta, k): &(f64, usize)| {
            let by = turn(last, *theta);
            // two edges may count as one line
            last += if by < TAU - STRAIGHT { by } else { 0.0 };
            (last, Patch::Corner(*k))
        };
        self.parts = all.iter().map(part).list();
        let count = all.len();
        let edge = |k: usize| FlatEdge {
            theta: all[(k + 1) % count].0,
            ends: [all[k].1, all[(k + 1) % count].1].each(Patch::Corner),
        };
        self.edges = (0..count).map(edge).list();
    }

    fn of_line(&mut self) {
        let Curve::Line { from, to } = &self.curve else { return };
        let theta = angle((-(*to - *from).perp()).scale(self.out));
        let ends = if self.out > 0.0 { [0, 1] } else { [1, 0] };
        let [first, last] = ends.each(Patch::Corner);
        let walls = [theta - FRAC_PI_2, theta + FRAC_PI_2];
        self.parts = vec![(walls[0], first), (theta, last), (walls[1], Patch::Outside)];
        let mut edges = [FlatEdge { theta, ends: [first, last] }; 3];
        edges[1 + ends[0]] = FlatEdge { theta: walls[0], ends: [Patch::Outside, first] };
        edges[1 + ends[1]] = FlatEdge { theta: walls[1], ends: [last, Patch::Outside] };
        self.edges = edges.to_vec();
    }

    fn of_arc(&mut self) {
        let mut along: Vec<f64> = places(&self.curve).list();
        if self.out < 0.0 {
            along.reverse();
        }
        self.radii = [f64::INFINITY, 0.0];
        for u in along {
            let terms = self.curve.derivatives(u);
            let theta = angle((-terms[1].perp()).scale(self.out));
            let theta = self.arc.last().map_or(theta, |[last, _]| last + turn(*last, theta));
            self.arc.push([theta, u]);
            let radius = 1.0 / (self.out * curvature(&terms));
            self.radii = [self.radii[0].min(radius / MARGIN), self.radii[1].max(MARGIN * radius)];
        }
        let [first, last] = self.ends();
        self.parts = vec![(first, Patch::Arc)];
        if self.curve.periodic() {
            return;
        }
        let ends = if self.out > 0.0 { [1, 0] } else { [0, 1] };
        let [end, start] = ends.each(|k| corner(&self.curve, k));
        let chord = last + turn(last, angle(-(start - end).perp()));
        let ends = ends.each(Patch::Corner);
        self.parts.extend([(last, ends[0]), (chord, ends[1])]);
        self.edges = vec![FlatEdge { theta: chord, ends }];
    }

    /// The angles of the normals at the ends of the arc.
    fn ends(&self) -> [f64; 2] {
        let of = |end: Option<&[f64; 2]>| end.map_or(0.0, |[theta, _]| *theta);
        [of(self.arc.first()), of(self.arc.last())]
    }

    /// The reason why the boundary is not convex.
    pub fn fault(&self) -> Option<String> {
        let [first, last] = self.ends();
        if self.arc.is_empty() {
            return None;
        }
        let bulge = |u: f64| self.out * curvature(&self.curve.derivatives(u)) * self.size;
        if places(&self.curve).all(|u| bulge(u) < -FLAT) {
            let message = "its other side is the one that bulges outward; name that side in sides";
            return Some(message.to_string());
        }
        if let Some(u) = places(&self.curve).find(|u| bulge(*u) <= FLAT) {
            let at = super::contact::place(&self.curve, u);
            return Some(format!(
                "another curve can touch it only where it bulges outward, but not for {at}; divide it there, by range or points, \
                 into curves with a contact each, or write it as a polygon"
            ));
        }
        let whole = match self.curve.periodic() {
            true => (last - first - TAU).abs() < 1e-3,
            // the corners at both ends of the chord turn by less than half a turn
            false => {
                let chord = self.edges[0].theta;
                [chord - last, first + TAU - chord].iter().all(|by| *by > 0.0 && *by < PI)
            }
        };
        let message = "it winds around more than once, or its chord crosses it; give a part of it";
        (!whole).then(|| message.to_string())
    }

    /// The extreme point in a direction.
    pub fn extreme(&self, theta: f64) -> ExtremePlace {
        let first = self.parts[0].0;
        let theta = first + turn(first, theta);
        let part = self.parts.partition_point(|(begin, _)| *begin <= theta);
        match self.parts[part.max(1) - 1].1 {
            Patch::Arc => self.on_arc(theta),
            patch => self.at(patch),
        }
    }

    /// The extreme point of a part that is no arc.
    pub fn at(&self, patch: Patch) -> ExtremePlace {
        let point = match patch {
            Patch::Corner(k) => corner(&self.curve, k),
            _ => Local::new(f64::NAN, f64::NAN),
        };
        ExtremePlace { patch, u: 0.0, point, radius: 0.0 }
    }

    /// Newton's method on C′·n = 0 between two known places.
    fn on_arc(&self, theta: f64) -> ExtremePlace {
        let k = self.arc.partition_point(|[known, _]| *known <= theta).clamp(1, self.arc.len() - 1);
        let [[low, a], [high, b]] = [self.arc[k - 1], self.arc[k]];
        let normal = direction(theta);
        let (mut before, mut after) = (a, b);
        let mut u = a + (b - a) * ((theta - low) / (high - low)).clamp(0.0, 1.0);
        let mut terms = self.curve.derivatives(u);
        for _ in 0..60 {
            // positive before the place and negative behind it
            let ahead = self.out * terms[1].dot(normal);
            if ahead > 0.0 {
                before = u;
            } else {
                after = u;
            }
            let step = -terms[1].dot(normal) / terms[2].dot(normal);
            let inside = (u + step - before) * (u + step - after) < 0.0;
            let next = if inside { u + step } else { 0.5 * (before + after) };
            let moved = (next - u).abs();
            u = next;
            terms = self.curve.derivatives(u);
            if moved <= 1e-15 * (b - a).abs().max(u.abs())
                || moved <= 1e-9 * (b - a).abs() && inside
            {
                break;
            }
        }
        let radius = 1.0 / (self.out * curvature(&terms));
        ExtremePlace { patch: Patch::Arc, u, point: terms[0], radius }
    }

    /// The smallest radius of curvature around a direction, and the angle up to which it is that.
    pub fn least_radius(&self, theta: f64) -> [f64; 2] {
        if self.arc.is_empty() || self.edges.is_empty() {
            return [self.radii[0], f64::INFINITY];
        }
        let [first, last] = self.ends();
        let along = turn(first, theta);
        let room = along.min(last - first - along);
        if room > 0.0 {
            [self.radii[0], room]
        } else {
            [0.0, f64::INFINITY] // a corner
        }
    }

    /// The largest radius of curvature within an angle of a direction; infinite at an edge.
    pub fn largest_radius(&self, theta: f64, by: f64) -> f64 {
        let near = |edge: &FlatEdge| turn(theta - by, edge.theta) <= 2.0 * by;
        if self.edges.iter().any(near) {
            return f64::INFINITY;
        }
        self.radii[1]
    }

    /// The edges whose normals lie between two directions: their indices and angles.
    pub fn between(&self, low: f64, high: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
        let all = self.edges.iter().enumerate();
        all.map(move |(k, edge)| (k, low + turn(low, edge.theta)))
            .filter(move |(_, theta)| *theta <= high)
    }
}

fn angle(v: Local) -> f64 {
    v.y.atan2(v.x)
}

/// The angle from one direction to another, from 0 to a whole turn.
pub(super) fn turn(from: f64, to: f64) -> f64 {
    let by = (to - from).rem_euclid(TAU);
    if by < TAU {
        by
    } else {
        0.0
    }
}

/// The stored direction nearest to an angle.
pub(super) fn nearest_direction(theta: f64) -> usize {
    (theta / TAU * DIRECTIONS as f64).round().rem_euclid(DIRECTIONS as f64) as usize % DIRECTIONS
}

/// The unit vectors of the stored directions.
pub(super) static ALL_AROUND: LazyLock<Vec<Local>> =
    LazyLock::new(|| (0..DIRECTIONS).map(|k| direction(TAU * k as f64 / DIRECTIONS as f64)).list());
