//! The nearest point of a curve: a tree of circles around its pieces, then Newton's method.
//!
//! The curve is divided into pieces of equal length in u. A circle encloses each piece, and another circle encloses
//! each pair of circles, up to a circle around the whole curve. A query descends first into the circle that may be
//! closer, and skips each circle that is farther away than the nearest chord found so far. Its cost is of the order
//! of the depth of the tree. Newton's method on (C - p)·C′ = 0 begins at the nearest point of the chords.

use super::contact::curvature;
use super::kinds::Side;
use super::normal_fan::NormalFan;
use super::plane_curve::Curve;
use crate::math::{Listed, Local, ShortArray};
use std::sync::OnceLock;

/// The smallest number of pieces, a power of two.
const PIECES: usize = 512;

/// Number of pieces of a spline for each of its points.
const OF_POINT: usize = 12;

/// Factor of the largest curvature of many places, for the places between them.
const MARGIN: f64 = 1.5;

/// Largest number of steps of Newton's method.
const STEPS: usize = 20;

/// Number of parts in which the curve between two feet is compared with them, and the least ratio of the distances.
const PARTS: usize = 32;
const APART: f64 = 1.0 + 1e-9;

/// A circle around a part of the curve.
#[derive(Clone, Copy, Debug)]
struct Circle {
    center: Local,
    radius: f64,
}

/// The position of the nearest point along a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AlongCurve {
    /// Between the ends, at this u.
    Within(f64),
    /// At the first end; the curve continues in the direction away from p.
    First(f64),
    /// At the last end.
    Last(f64),
}

impl AlongCurve {
    /// The place u.
    pub fn u(self) -> f64 {
        let (Self::Within(u) | Self::First(u) | Self::Last(u)) = self;
        u
    }
}

/// The curve around a foot, and the rest of the curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branches {
    /// Bounds of the curvature of the connected part around the foot, 1/m.
    pub bends: [f64; 2],
    /// The length of this part, m, and the angle by which it turns.
    pub length: f64,
    pub turn: f64,
    /// A distance that the other parts have at least; infinite if they are far.
    pub other: f64,
}

impl Branches {
    /// The largest rate at which the gradient of the distance turns within a radius of a point at a distance, 1/m;
    /// infinite if the foot may jump. The contact is on the right of the curve for `out` = 1, on the left for -1.
    pub fn turning(&self, out: f64, distance: f64, within: f64) -> f64 {
        let Self { bends: [low, high], length, turn, .. } = *self;
        // how strongly the curve turns towards the point, and away from it
        let [hollow, round] = if out > 0.0 { [-low, high] } else { [high, -low] };
        let behind = (-distance).max(0.0) + within + length * turn;
        if hollow * (distance.abs() + 3.0 * within) >= 1.0 || round * behind >= 1.0 {
            return f64::INFINITY;
        }
        let towards = hollow / (1.0 - hollow * (distance + within));
        towards.max(round / (1.0 + round * (distance - within)))
    }
}

/// A curve that is ready to be searched.
#[derive(Debug)]
pub(super) struct CurveSearch {
    curve: Curve,
    /// The numbers of the curve, which determine it.
    pub numbers: Vec<f64>,
    /// C at the ends of the pieces.
    points: Vec<Local>,
    range: [f64; 2],
    /// The largest distance of the curve from its chords, m.
    rise: f64,
    /// Bounds of the curvature of each part, 1/m, positive where it turns left.
    bends: Vec<[f64; 2]>,
    /// The root first, the children of k at 2k + 1 and 2k + 2.
    tree: Vec<Circle>,
    /// The normals of its convex body, for a contact with another curve.
    fan: OnceLock<NormalFan>,
}

fn apart(a: Local, b: Local) -> f64 {
    (a.x - b.x).hypot(a.y - b.y)
}

/// The point at a fraction `share` of the way from a to b.
fn between(a: Local, b: Local, share: f64) -> Local {
    Local::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y))
}

/// The smallest circle around two circles.
fn around(a: Circle, b: Circle) -> Circle {
    let distance = apart(a.center, b.center);
    if distance + b.radius <= a.radius {
        return a;
    }
    if distance + a.radius <= b.radius {
        return b;
    }
    let radius = 0.5 * (distance + a.radius + b.radius);
    Circle { center: between(a.center, b.center, (radius - a.radius) / distance), radius }
}

impl CurveSearch {
    /// Prepares the search on a curve that has no fault.
    pub fn new(curve: Curve, numbers: Vec<f64>) -> Self {
        let count = match &curve {
            Curve::Points(own) => OF_POINT * own.points.len(),
            _ => 0,
        };
        let count = count.max(PIECES).next_power_of_two();
        let [a, b] = curve.range();
        let at = |share: f64| curve.point(a + (b - a) * share / count as f64);
        let points: Vec<Local> = (0..=count).map(|k| at(k as f64)).list();
        let piece = |k: usize| {
            let (from, to) = (points[k], points[k + 1]);
            let center = between(from, to, 0.5);
            // the rise of the arc over its chord is doubled, because the arc may not be a circle
            let radius = 0.5 * apart(from, to) + 2.0 * apart(at(k as f64 + 0.5), center);
            Circle { center, radius }
        };
        let mut tree = vec![Circle { center: points[0], radius: 0.0 }; 2 * count - 1];
        for k in (0..tree.len()).rev() {
            tree[k] = match k >= count - 1 {
                true => piece(k + 1 - count),
                false => around(tree[2 * k + 1], tree[2 * k + 2]),
            };
        }
        let rise = |k: usize| tree[k + count - 1].radius - 0.5 * apart(points[k], points[k + 1]);
        let rise = (0..count).map(rise).fold(0.0, f64::max);
        let bend = |k: f64| curvature(&curve.derivatives(a + (b - a) * k / count as f64));
        let bends = (0..count).map(|k| {
            let all = [0.0, 0.5, 1.0].each(|part| MARGIN * bend(k as f64 + part));
            [all.into_iter().fold(0.0, f64::min), all.into_iter().fold(0.0, f64::max)]
        });
        let bends = bends.collect();
        let fan = OnceLock::new();
        Self { numbers, points, range: [a, b], rise, bends, tree, fan, curve }
    }

    /// The normals of the convex body with the other bodies on this side of the curve, always the same one.
    pub fn fan(&self, side: Side) -> &NormalFan {
        self.fan.get_or_init(|| NormalFan::new(&self.curve, side))
    }

    /// The pieces within a distance of p, ascending.
    fn pieces(&self, p: Local, within: f64) -> Vec<usize> {
        let leaves = self.points.len() - 1;
        let (mut found, mut open) = (Vec::new(), vec![0]);
        while let Some(k) = open.pop() {
            match apart(p, self.tree[k].center) - self.tree[k].radius > within {
                true => {}
                false if k >= leaves - 1 => found.push(k + 1 - leaves),
                false => open.extend([2 * k + 2, 2 * k + 1]),
            }
        }
        found
    }

    /// The curve around the foot u of a point p, and the rest of it, for a motion of the point from p - by to p + by
    /// with an error.
    pub fn branches(&self, (p, u): (Local, f64), far: f64, (by, error): (Local, f64)) -> Branches {
        let (count, [a, b]) = (self.points.len() - 1, self.range);
        let pieces = self.pieces(p, far);
        let foot =
            ((u - a) / (b - a) * count as f64).floor().clamp(0.0, count as f64 - 1.0) as usize;
        let near = |k: &usize| pieces.binary_search(k).is_ok();
        let around = if self.curve.periodic() { count } else { 0 };
        let up = (1..count).map(|by| foot + by).map_while(|k| match around {
            0 => (k < count).then_some(k),
            _ => Some(k % count),
        });
        let down = (1..count).map_while(|by| (foot + around).checked_sub(by)).map(|k| k % count);
        let mut own: Vec<usize> = up.take_while(near).collect();
        if own.len() + 1 < count {
            own.extend(down.take_while(near));
        }
        own.push(foot);
        own.sort_unstable();
        let mut found =
            Branches { bends: [0.0, 0.0], length: 0.0, turn: 0.0, other: f64::INFINITY };
        for k in own.iter().copied() {
            let [low, high] = self.bends[k];
            let length = apart(self.points[k], self.points[k + 1]) + 2.0 * self.rise_of(k);
            found.bends = [found.bends[0].min(low), found.bends[1].max(high)];
            found.length += length;
            found.turn += length * high.max(-low);
        }
        for k in pieces.into_iter().filter(|k| own.binary_search(k).is_err()) {
            let chord = [self.points[k], self.points[k + 1]];
            let distance = of_segments([p - by, p + by], chord) - self.rise_of(k) - error;
            found.other = found.other.min(distance);
        }
        found
    }

    /// The largest distance of a piece from its chord.
    fn rise_of(&self, k: usize) -> f64 {
        let leaf = self.tree[k + self.points.len() - 2];
        leaf.radius - 0.5 * apart(self.points[k], self.points[k + 1])
    }

    /// The nearest point to p, in the frame of the curve.
    pub fn nearest(&self, p: Local) -> AlongCurve {
        if !(p.x.is_finite() && p.y.is_finite()) {
            return AlongCurve::Within(f64::NAN);
        }
        let [first, second] = self.starts(p);
        let found = self.refined(p, self.place(first.1));
        if second.0 > first.0 + 2.0 * self.rise {
            return found;
        }
        // the chords do not tell which of two distant parts of the curve is nearer
        let other = self.refined(p, self.place(second.1));
        let far = |of: AlongCurve| apart(p, self.curve.point(of.u()));
        if far(other) < far(found) {
            other
        } else {
            found
        }
    }

    /// Another foot of p than the foot `own`, and the place between them that is farthest from p. It is searched from
    /// the places `from`, and on all parts of the curve within a distance of p.
    pub fn other_foot(&self, p: Local, own: f64, (from, within): (f64, f64)) -> Option<[f64; 2]> {
        let ([a, b], count) = (self.range, self.points.len() - 1);
        let pieces = self.pieces(p, within);
        let parts = pieces.chunk_by(|k, next| k + 1 == *next).map(|part| part[part.len() / 2]);
        let starts = parts.map(|k| a + (b - a) * (k as f64 + 0.5) / count as f64);
        let turns = if self.curve.periodic() { b - a } else { f64::INFINITY };
        std::iter::once(from).chain(starts).find_map(|start| {
            let u = self.refined(p, start).u();
            let by = own - u - turns.min(f64::MAX) * ((own - u) / turns).round();
            let far = |share: f64| apart(p, self.curve.point(u + share * by));
            let inner = (1..PARTS).map(|k| k as f64 / PARTS as f64);
            let middle = inner.max_by(|s, t| far(*s).total_cmp(&far(*t)))?;
            let away = [0.0, 1.0].iter().all(|end| far(middle) > APART * far(*end));
            let touches = start == from || far(0.0) <= within;
            (away && touches).then_some([u, u + middle * by])
        })
    }

    /// The distance of p from the chords, positive on their right, and its error.
    pub fn rough(&self, p: Local) -> (f64, f64) {
        let share = self.starts(p)[0].1;
        let k = (share as usize).min(self.points.len() - 2);
        let (from, to) = (self.points[k], self.points[k + 1]);
        let away = p - between(from, to, share - k as f64);
        let sign = (away.x * (to.y - from.y) - away.y * (to.x - from.x)).signum();
        (sign * away.norm(), self.rise)
    }

    /// The u of a place among the chords.
    fn place(&self, share: f64) -> f64 {
        let [a, b] = self.range;
        a + (b - a) * share / (self.points.len() - 1) as f64
    }

    /// The distance of the nearest chord and the place of its nearest point among the chords; and those of another
    /// chord that is not beside it, if it is hardly farther.
    fn starts(&self, p: Local) -> [(f64, f64); 2] {
        let leaves = self.points.len() - 1;
        let [mut best, mut second] = [(f64::INFINITY, 0.0); 2];
        let mut stack = [(0_usize, 0.0_f64); 64];
        let mut open = 1;
        while open > 0 {
            open -= 1;
            let (k, bound) = stack[open];
            if bound >= best.0 + 2.0 * self.rise {
                continue;
            }
            if k >= leaves - 1 {
                let piece = k + 1 - leaves;
                let (distance, along) = to_chord(p, self.points[piece], self.points[piece + 1]);
                let own = (distance, piece as f64 + along);
                let beside = (own.1 - best.1).abs() < 2.0;
                (best, second) = match own.0 < best.0 {
                    true if beside => (own, second),
                    true => (own, best),
                    false if beside || own.0 >= second.0 => (best, second),
                    false => (best, own),
                };
                continue;
            }
            let child = |k: usize| (k, apart(p, self.tree[k].center) - self.tree[k].radius);
            let (left, right) = (child(2 * k + 1), child(2 * k + 2));
            let (near, far) = if left.1 <= right.1 { (left, right) } else { (right, left) };
            (stack[open], stack[open + 1]) = (far, near);
            open += 2;
        }
        [best, second]
    }

    /// Newton's method from u.
    fn refined(&self, p: Local, mut u: f64) -> AlongCurve {
        let [a, b] = self.range;
        let piece = (b - a) / (self.points.len() - 1) as f64;
        let periodic = self.curve.periodic();
        let mut out = 0.0;
        for _ in 0..STEPS {
            let [c, first, second, _] = self.curve.derivatives(u);
            let d = Local::new(c.x - p.x, c.y - p.y);
            let speed = first.dot(first);
            // if p is beyond the centre of curvature, the bounded denominator keeps the step a descent step
            let bend = (speed + d.dot(second)).max(0.1 * speed);
            let step = (-d.dot(first) / bend).clamp(-2.0 * piece, 2.0 * piece);
            let next = u + step;
            out = if periodic { 0.0 } else { next - next.clamp(a, b) };
            let moved = next - out - u;
            u = next - out;
            if moved.abs() <= 1e-15 * (b - a) {
                break;
            }
        }
        match () {
            () if out < 0.0 => AlongCurve::First(u),
            () if out > 0.0 => AlongCurve::Last(u),
            () => AlongCurve::Within(u),
        }
    }
}

/// The distance of p from a chord, and the position of the nearest point as a fraction of the chord.
fn to_chord(p: Local, from: Local, to: Local) -> (f64, f64) {
    let (chord, arm) = (between(Local::zero(), to - from, 1.0), p - from);
    let share = (chord.dot(arm) / chord.dot(chord)).clamp(0.0, 1.0);
    let share = if share.is_nan() { 0.0 } else { share };
    (apart(p, between(from, to, share)), share)
}

/// The distance of two straight pieces.
fn of_segments([a, b]: [Local; 2], [c, d]: [Local; 2]) -> f64 {
    let side = |from: Local, to: Local, p: Local| (to - from).cross(p - from);
    let crosses = side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0;
    let ends =
        [(a, c, d), (b, c, d), (c, a, b), (d, a, b)].each(|(p, from, to)| to_chord(p, from, to).0);
    if crosses {
        0.0
    } else {
        ends.into_iter().fold(f64::INFINITY, f64::min)
    }
}
