//! The point of a line between two ends that is nearest to a given point, and the parts of the line on which a body rests.

use super::near::{choose, Near};
use super::plane_curve::Curve;
use super::polygon_foot::{BEYOND, SUPPORT};
use crate::expression::Tape;
use crate::math::{Local, Real};

/// The parts of a line on which a body rests: the line between its ends, and its ends.
pub(super) const LEVEL: usize = 0;
const FIRST: usize = 1;
const LAST: usize = 2;

/// The curve of a part on which a body rests. Beyond its ends, a line is the corner there.
pub(super) fn supporting(from: &Local<Tape>, to: &Local<Tape>, support: usize) -> Curve<Tape> {
    match support {
        LEVEL => Curve::Line { from: extended(from, to), to: extended(to, from) },
        _ => Curve::Line { from: from.clone(), to: to.clone() },
    }
}

/// A place on the line through `end` and `other`, far beyond `end`.
fn extended(end: &Local<Tape>, other: &Local<Tape>) -> Local<Tape> {
    let of = |end: &Tape, other: &Tape| end.clone() - (other.clone() - end.clone()).times(SUPPORT);
    Local { x: of(&end.x, &other.x), y: of(&end.y, &other.y) }
}

/// The nearest point beyond an end: the corner on the side of the contact, the normal at the end behind the curve.
/// `arm` is the vector from the end to p.
pub(super) fn beyond<S: Real>(
    end: Local<S>,
    on: Local<S>,
    normal: Local<S>,
    arm: Local<S>,
) -> Near<S> {
    let (along, up) = (on.dot(arm), normal.dot(arm));
    let squared = arm.dot(arm);
    let distance = S::select(squared, squared.sqrt(), S::zero());
    let part = |a: S, b: S| S::select(squared, a / distance, b);
    let away = Local::new(part(arm.x, on.x), part(arm.y, on.y));
    let corner = Near { distance, away, place: end };
    let behind = Near { distance: along, away: on, place: end + normal.scale(up) };
    choose(up, corner, behind)
}

/// A point and a line.
pub(super) struct Straight<S> {
    from: Local<S>,
    to: Local<S>,
    length: S,
    tangent: Local<S>,
    normal: Local<S>,
    /// The coordinates of the point along the tangent and the normal.
    u: S,
    up: S,
}

impl<S: Real> Straight<S> {
    pub(super) fn new(p: Local<S>, from: Local<S>, to: Local<S>, out: S) -> Self {
        let along = to - from;
        let length = along.norm();
        let tangent = along.scale(S::one() / length);
        let normal = (-tangent.perp()).scale(out);
        let [u, up] = [tangent.dot(p - from), normal.dot(p - from)];
        Self { from, to, length, tangent, normal, u, up }
    }

    /// The nearest point of the line without ends.
    fn level(&self) -> Near<S> {
        let place = self.from + self.tangent.scale(self.u);
        Near { distance: self.up, away: self.normal, place }
    }

    /// The nearest point of a part.
    pub(super) fn near_on(&self, support: usize) -> Near<S> {
        let arm = self.tangent.scale(self.u) + self.normal.scale(self.up);
        match support {
            LEVEL => self.level(),
            FIRST => beyond(self.from, -self.tangent, self.normal, arm),
            _ => beyond(self.to, self.tangent, self.normal, arm + self.from - self.to),
        }
    }

    /// How far the point is from where a part ends, relative to the length of the line.
    pub(super) fn margin(&self, support: usize) -> S {
        let left = match support {
            LEVEL => self.u.min(self.length - self.u),
            FIRST => -self.u,
            _ => self.u - self.length,
        };
        left / self.length + S::constant(BEYOND)
    }

    /// The part that is nearest in the first lane.
    pub(super) fn support(&self) -> usize {
        match (self.u.in_lanes()[0], self.length.in_lanes()[0]) {
            (u, _) if u < 0.0 => FIRST,
            (u, length) if u > length => LAST,
            _ => LEVEL,
        }
    }
}

pub(super) fn of_line<S: Real>(p: Local<S>, from: Local<S>, to: Local<S>, out: S) -> Near<S> {
    let line = Straight::new(p, from, to, out);
    let (level, Straight { length, tangent, normal, u, up, .. }) = (line.level(), line);
    let (first, last) = (-u, u - length);
    let ends = |end: Local<S>, on: Local<S>| beyond(end, on, normal, p - end);
    // behind the line, the nearest boundary is the line or the normal at an end
    let outside = choose(first, ends(from, -tangent), choose(last, ends(to, tangent), level));
    let wall = |by: S, on: Local<S>| Near { distance: by, away: on, place: p - on.scale(by) };
    let walls = choose(first - last, wall(first, -tangent), wall(last, tangent));
    let nearer = S::select(-up, walls.distance - up, -S::one());
    choose(nearer, walls, outside)
}
