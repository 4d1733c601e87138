//! The nearest point of a curve: a tree of circles around its pieces, then Newton's method.
//!
//! The curve is divided into pieces of equal length in u. A circle encloses each piece, and another circle encloses
//! each pair of circles, up to a circle around the whole curve. A query descends first into the circle that may be
//! closer, and skips each circle that is farther away than the nearest chord found so far. Its cost is of the order
//! of the depth of the tree. Newton's method on (C - p)·C′ = 0 begins at the nearest point of the chords.

use super::contact::curvature;
use super::plane_curve::Curve;
use crate::math::{Listed, Local};

/// The smallest number of pieces, a power of two.
const PIECES: usize = 512;

/// Number of pieces of a spline for each of its points.
const OF_POINT: usize = 12;

/// Factor of the largest curvature of many places, for the places between them.
const MARGIN: f64 = 1.5;

/// Largest number of steps of Newton's method.
const STEPS: usize = 20;

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
    /// A curvature that is not exceeded in each part, 1/m.
    bends: Vec<f64>,
    /// The root first, the children of k at 2k + 1 and 2k + 2.
    tree: Vec<Circle>,
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
        let bend = |k: f64| curvature(&curve.derivatives(a + (b - a) * k / count as f64)).abs();
        let most = |k: f64| MARGIN * bend(k).max(bend(k + 0.5)).max(bend(k + 1.0));
        let mut bends = vec![0.0; tree.len()];
        for k in (0..tree.len()).rev() {
            bends[k] = match k >= count - 1 {
                true => most((k + 1 - count) as f64),
                false => f64::max(bends[2 * k + 1], bends[2 * k + 2]),
            };
        }
        Self { numbers, points, range: [a, b], rise, bends, tree, curve }
    }

    /// A curvature that the curve does not exceed within a distance of p, 1/m.
    pub fn curved(&self, p: Local, within: f64) -> f64 {
        let leaves = self.points.len() - 1;
        let (mut most, mut open) = (0.0, vec![0]);
        while let Some(k) = open.pop() {
            let far = apart(p, self.tree[k].center) - self.tree[k].radius > within;
            match far || self.bends[k] <= most {
                true => {}
                false if k >= leaves - 1 => most = self.bends[k],
                false => open.extend([2 * k + 1, 2 * k + 2]),
            }
        }
        most
    }

    /// The nearest point to p, in the frame of the curve.
    pub fn nearest(&self, p: Local) -> AlongCurve {
        if !(p.x.is_finite() && p.y.is_finite()) {
            return AlongCurve::Within(f64::NAN);
        }
        self.refined(p, self.start(p).0)
    }

    /// The distance of p from the chords, positive on their right, and its error.
    pub fn rough(&self, p: Local) -> (f64, f64) {
        let share = self.start(p).1;
        let k = (share as usize).min(self.points.len() - 2);
        let (from, to) = (self.points[k], self.points[k + 1]);
        let away = p - between(from, to, share - k as f64);
        let sign = (away.x * (to.y - from.y) - away.y * (to.x - from.x)).signum();
        (sign * away.norm(), self.rise)
    }

    /// The u of the nearest point of the chords, and its place among them.
    fn start(&self, p: Local) -> (f64, f64) {
        let leaves = self.points.len() - 1;
        let (mut best, mut share) = (f64::INFINITY, 0.0);
        let mut stack = [(0_usize, 0.0_f64); 64];
        let mut open = 1;
        while open > 0 {
            open -= 1;
            let (k, bound) = stack[open];
            if bound >= best {
                continue;
            }
            if k >= leaves - 1 {
                let piece = k + 1 - leaves;
                let (distance, along) = to_chord(p, self.points[piece], self.points[piece + 1]);
                if distance < best {
                    (best, share) = (distance, piece as f64 + along);
                }
                continue;
            }
            let child = |k: usize| (k, apart(p, self.tree[k].center) - self.tree[k].radius);
            let (left, right) = (child(2 * k + 1), child(2 * k + 2));
            let (near, far) = if left.1 <= right.1 { (left, right) } else { (right, left) };
            (stack[open], stack[open + 1]) = (far, near);
            open += 2;
        }
        let [a, b] = self.range;
        (a + (b - a) * share / leaves as f64, share)
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
