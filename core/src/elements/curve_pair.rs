//! The touch of two convex bodies.
//!
//! In a direction n = n(θ) away from body j, the bodies are apart by
//!
//! ```text
//! σ(θ) = n·(Pᵢ - Pⱼ)      σ′ = t·(Pᵢ - Pⱼ)      σ″ = -(σ + Rᵢ + Rⱼ)
//! ```
//!
//! with the extreme points Pⱼ in the direction n and Pᵢ in the direction -n, the radii of curvature R there and the
//! tangent t = n′. The gap is the largest σ: the distance of bodies that are apart, and the least way that parts bodies
//! that overlap, with the opposite sign. It is the distance of a point from the convex body that is the sum of both, so
//! that there is one touch as long as the depth is less than Rᵢ + Rⱼ. (Pfeiffer and Glocker, *Multibody Dynamics with
//! Unilateral Contacts*, 1996, 3.)
//!
//! θ is searched over `f64`, lane by lane. Two steps of Newton's method on tᵢ × tⱼ = 0 and (Pᵢ - Pⱼ)·tⱼ = 0 over the
//! scalar then yield the derivatives of both places, as for one curve.

use super::contact::cusp;
use super::foot::{at_foot, Rim};
use super::kinds::Side;
use super::near::{choose, Near};
use super::normal_fan::{
    direction, nearest_direction, terms, ExtremePlace, NormalFan, Patch, ALL_AROUND, DIRECTIONS,
};
use super::plane_curve::Curve;
use crate::math::{each, Local, Pose, Real, Rotation, ShortArray};
use std::f64::consts::{PI, TAU};

/// Largest number of steps of a search for θ.
const STEPS: usize = 100;

/// Body i as body j sees it: the origin of its frame, and its rotation.
#[derive(Clone, Copy, Debug)]
pub struct BodySeen<S = f64> {
    origin: Local<S>,
    rotation: Rotation<S>,
}

impl<S: Real> BodySeen<S> {
    /// From the poses of bodies i and j.
    pub fn new(i: &Pose<S>, j: &Pose<S>) -> Self {
        let ([a, b], [c, d]) = ([i.rotation.cos, i.rotation.sin], [j.rotation.cos, j.rotation.sin]);
        let rotation = Rotation { cos: a * c + b * d, sin: b * c - a * d };
        Self { origin: j.rotation.inverse(i.r - j.r), rotation }
    }

    fn way(&self, s: Local<S>) -> Local<S> {
        let of = self.rotation * s;
        Local::new(of.x, of.y)
    }

    fn place(&self, s: Local<S>) -> Local<S> {
        self.origin + self.way(s)
    }

    fn lane(&self, k: usize) -> BodySeen {
        let of = |x: S| x.in_lanes()[k];
        let rotation = Rotation { cos: of(self.rotation.cos), sin: of(self.rotation.sin) };
        BodySeen { origin: Local::new(of(self.origin.x), of(self.origin.y)), rotation }
    }
}

impl BodySeen {
    fn angle(&self) -> f64 {
        self.rotation.sin.atan2(self.rotation.cos)
    }
}

/// The touch of two bodies, or their nearest places.
#[derive(Clone, Copy, Debug)]
struct Meeting {
    /// The direction of the normal in the frame of body j, and the distance along it.
    theta: f64,
    apart: f64,
    /// The parts of the boundaries of bodies i and j, and the places on their curves.
    patches: [Patch; 2],
    u: [f64; 2],
}

/// Two bodies in a position.
struct Both<'f> {
    fans: [&'f NormalFan; 2],
    seen: BodySeen,
    angle: f64,
}

impl Both<'_> {
    /// σ and σ′ for two extreme points.
    fn apart(&self, theta: f64, [i, j]: [ExtremePlace; 2]) -> [f64; 2] {
        let (n, d) = (direction(theta), self.seen.place(i.point) - j.point);
        [n.dot(d), n.perp().dot(d)]
    }

    /// The direction -n in body i.
    fn facing(&self, theta: f64) -> f64 {
        theta + PI - self.angle
    }

    fn extremes(&self, theta: f64) -> [ExtremePlace; 2] {
        [self.fans[0].extreme(self.facing(theta)), self.fans[1].extreme(theta)]
    }

    /// See [`PairApart::least`].
    fn least(&self, theta: f64) -> [(f64, [f64; 2]); 2] {
        let own = [self.fans[0].least_radius(self.facing(theta)), self.fans[1].least_radius(theta)];
        // beyond the end of an arc there is a corner
        let sure = own.each(|[radius, room]| if room.is_finite() { 0.0 } else { radius });
        let [[i, room_i], [j, room_j]] = own;
        [(i + j, [room_i, room_j]), (sure[0] + sure[1], [f64::INFINITY; 2])]
    }

    /// See [`PairApart::level`].
    fn level(&self, meeting: &Meeting) -> f64 {
        let (Patch::Edge(k), theta) = (meeting.patches[1], meeting.theta) else { return 0.0 };
        let i = self.fans[0].extreme(self.facing(theta));
        let ends = self.fans[1].edges[k].ends.into_iter().filter(|end| *end != Patch::Outside);
        let from = ends.map(|end| self.apart(theta, [i, self.fans[1].at(end)])[1].abs());
        from.fold(f64::INFINITY, f64::min)
    }

    fn meeting(&self, theta: f64, extremes: [ExtremePlace; 2]) -> Meeting {
        let [apart, _] = self.apart(theta, extremes);
        let [i, j] = extremes;
        Meeting { theta, apart, patches: [i.patch, j.patch], u: [i.u, j.u] }
    }

    /// σ in the stored directions; -∞ where a body is endless.
    fn rough(&self) -> Vec<f64> {
        let first = nearest_direction(PI - self.angle);
        let [i, j] = self.fans.each(|fan| &fan.grid);
        let of = |k: usize| match (i[(k + first) % DIRECTIONS], j[k]) {
            (Some(of_i), Some(of_j)) => ALL_AROUND[k].dot(self.seen.place(of_i) - of_j),
            _ => f64::NEG_INFINITY,
        };
        let mut all = vec![0.0; DIRECTIONS];
        all.iter_mut().enumerate().for_each(|(k, sigma)| *sigma = of(k));
        all
    }

    /// The direction with the largest σ.
    fn search(&self) -> Option<Meeting> {
        let rough = self.rough();
        let at = |k: usize| rough[k % DIRECTIONS];
        let step = TAU / DIRECTIONS as f64;
        let best = rough.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // σ rises by less than this between two stored directions
        let most = step * (self.fans[0].size + self.fans[1].size + best.abs());
        let mut found: Option<Meeting> = None;
        for k in 0..DIRECTIONS {
            let top = at(k) >= at(k + 1) && at(k) > at(k + DIRECTIONS - 1);
            if !(top && at(k) + most >= best) {
                continue;
            }
            let middle = k as f64 * step;
            let meeting = self.refined([middle - 1.5 * step, middle + 1.5 * step]);
            if found.is_none_or(|of| meeting.apart > of.apart) {
                found = Some(meeting);
            }
        }
        found
    }

    /// The largest σ between two directions.
    fn refined(&self, [mut low, mut high]: [f64; 2]) -> Meeting {
        let turned = self.facing(0.0);
        for body in 0..2 {
            let by = if body == 0 { turned } else { 0.0 };
            let fan = self.fans[body];
            for (k, theta) in fan.between(low + by, high + by) {
                let theta = theta - by;
                if !(low..=high).contains(&theta) {
                    continue;
                }
                let mut extremes = self.extremes(theta);
                let [before, after] = fan.edges[k].ends;
                // σ rises before the edge and falls behind it
                let slope = |of: &mut [ExtremePlace; 2], patch: Patch, outside: f64| {
                    of[body] = fan.at(patch);
                    match patch {
                        Patch::Outside => outside,
                        _ => self.apart(theta, *of)[1],
                    }
                };
                let rises = slope(&mut extremes, before, 1.0) > 0.0;
                let falls = slope(&mut extremes, after, -1.0) < 0.0;
                match (rises, falls) {
                    (true, true) => {
                        extremes[body] =
                            fan.at(if after == Patch::Outside { before } else { after });
                        extremes[body].patch = Patch::Edge(k);
                        return self.meeting(theta, extremes);
                    }
                    (true, false) => low = theta,
                    (false, _) => high = theta,
                }
            }
        }
        self.between(low, high)
    }

    /// The largest σ between two directions without an edge: Newton's method on σ′ = 0.
    fn between(&self, mut low: f64, mut high: f64) -> Meeting {
        let mut theta = 0.5 * (low + high);
        let mut extremes = self.extremes(theta);
        for _ in 0..STEPS {
            let [sigma, slope] = self.apart(theta, extremes);
            if slope > 0.0 {
                low = theta;
            } else {
                high = theta;
            }
            let bend = sigma + extremes[0].radius + extremes[1].radius;
            let newton = theta + slope / bend;
            let inside = bend > 0.0 && newton > low && newton < high;
            let next = if inside { newton } else { 0.5 * (low + high) };
            let moved = (next - theta).abs();
            theta = next;
            extremes = self.extremes(theta);
            // Newton's method doubles the digits
            if moved <= 1e-15 * (1.0 + theta.abs()) || inside && moved < 1e-9 {
                break;
            }
        }
        self.meeting(theta, extremes)
    }
}

/// The distance of two bodies, and what bounds its change.
#[derive(Clone, Copy, Debug)]
pub struct PairApart {
    /// The distance.
    pub distance: f64,
    /// The normal away from body j, in its frame.
    pub away: Local,
    /// The nearest place of body i, in its frame.
    pub place: Local,
    /// The least sums of the radii of curvature, each with the angles of the normal in bodies i and j up to which it holds.
    pub least: [(f64, [f64; 2]); 2],
    /// How far the nearest place is from the ends of an edge of body j; zero on an arc or corner.
    pub level: f64,
    /// The size of body i.
    pub size: f64,
    /// The direction -n in body i.
    facing: f64,
}

impl Rim {
    /// The reason why one of two curves cannot take part.
    pub(super) fn fault_of_pair(&self, side: Side) -> Option<String> {
        let mate = self.mate.as_ref()?;
        let both = [(&mate.rim, mate.side, "i"), (self, side, "j")];
        both.into_iter().find_map(|(rim, side, body)| {
            let curve = &rim.on.curve;
            let straight = matches!(curve, Curve::Line { .. } | Curve::Polygon(_));
            if straight || curve.fault().is_some() {
                return None; // a fault is reported at the curve
            }
            let fault = cusp(curve).or_else(|| rim.fan(0, side).fault())?;
            Some(format!("the curve of body {body}: {fault}"))
        })
    }

    /// The distance from the curve of body i. None without such a curve.
    pub fn pair_apart(&self, i: &Pose, j: &Pose, side: Side) -> Option<PairApart> {
        let (both, meeting) = self.meeting_in(0, &BodySeen::new(i, j), side)?;
        let fan = both.fans[0];
        let facing = both.facing(meeting.theta);
        let place = match meeting.patches[0] {
            // an edge has the same distance at both ends
            Patch::Edge(k) => fan.at(fan.edges[k].ends[1]),
            Patch::Corner(_) | Patch::Outside => fan.at(meeting.patches[0]),
            Patch::Arc => fan.extreme(facing),
        };
        Some(PairApart {
            distance: meeting.apart,
            away: direction(meeting.theta),
            place: place.point,
            least: both.least(meeting.theta),
            level: both.level(&meeting),
            size: fan.size,
            facing,
        })
    }

    /// The largest distance along body i of its nearest place from that of `apart`, if this turns by an angle.
    pub fn moves(&self, apart: &PairApart, by: f64) -> f64 {
        let Some(mate) = &self.mate else { return 0.0 };
        let radius = mate.rim.fan(0, mate.side).largest_radius(apart.facing, by);
        (radius * by).min(apart.size)
    }
}

impl<S: Real> Rim<S> {
    fn meeting_in(&self, lane: usize, seen: &BodySeen, side: Side) -> Option<(Both<'_>, Meeting)> {
        let mate = self.mate.as_ref()?;
        let fans = [mate.rim.fan(lane, mate.side), self.fan(lane, side)];
        let both = Both { fans, seen: *seen, angle: seen.angle() };
        let finite =
            seen.origin.x.is_finite() && seen.origin.y.is_finite() && both.angle.is_finite();
        let meeting = finite.then(|| both.search()).flatten()?;
        Some((both, meeting))
    }

    /// The place of the curve that is nearest to the curve of body i.
    #[inline(never)]
    pub(super) fn near_pair(&self, seen: &BodySeen<S>, side: Side) -> Near<S> {
        let nothing = Meeting {
            theta: f64::NAN,
            apart: f64::NAN,
            patches: [Patch::Arc; 2],
            u: [f64::NAN; 2],
        };
        let at = |lane: usize| {
            self.meeting_in(lane, &seen.lane(lane), side).map_or(nothing, |(_, of)| of)
        };
        let mut found = [at(0); 4];
        let numbers = |lane: usize| {
            let BodySeen { origin, rotation } = seen.lane(lane);
            [origin.x, origin.y, rotation.cos, rotation.sin]
        };
        let one = self.is_one_curve();
        for lane in (1..4).filter(|lane| !one || numbers(*lane) != numbers(0)) {
            found[lane] = at(lane);
        }
        let mut near = self.near_at(seen, found, 0);
        for lane in
            (1..4).filter(|lane| found[..*lane].iter().all(|of| of.patches != found[*lane].patches))
        {
            let own = each(found, |of| if of.patches == found[lane].patches { 1.0 } else { -1.0 });
            near = choose(S::of_lanes(own), self.near_at(seen, found, lane), near);
        }
        near
    }

    /// The nearest place in the lanes that have the parts of a given lane.
    #[inline(never)]
    fn near_at(&self, seen: &BodySeen<S>, found: [Meeting; 4], lane: usize) -> Near<S> {
        let own =
            each(found, |of| if of.patches == found[lane].patches { of } else { found[lane] });
        let u = |body: usize| S::of_lanes(each(own, |of| of.u[body]));
        let [of_i, of_j] = found[lane].patches;
        let mate = self.mate.as_ref().map_or(&self.on.curve, |mate| &mate.rim.on.curve);
        let [place, first, second, third] = terms(mate, of_i, u(0));
        let i = [seen.place(place), seen.way(first), seen.way(second), seen.way(third)];
        let j = terms(&self.on.curve, of_j, u(1));
        let facing = Local::new(
            S::of_lanes(each(own, |of| of.theta.cos())),
            S::of_lanes(each(own, |of| of.theta.sin())),
        );
        let corner = |patch: Patch| matches!(patch, Patch::Corner(_));
        let (at_i, at_j, tangent) = match (corner(of_i), corner(of_j)) {
            (false, false) => together(i, j),
            (true, true) => {
                let arm = i[0] - j[0];
                let squared = arm.dot(arm);
                let part = |x: S, other: S| S::select(squared, x, other);
                let other = facing.perp();
                (i[0], j[0], Local::new(part(-arm.y, other.x), part(arm.x, other.y)))
            }
            (of_i, _) => {
                let (along, p) = if of_i { (j, i[0]) } else { (i, j[0]) };
                let (at, tangent) = at_foot(along, p, S::one());
                let [at_i, at_j] = if of_i { [p, at] } else { [at, p] };
                (at_i, at_j, tangent)
            }
        };
        let normal = (-tangent.perp()).scale(S::one() / tangent.norm());
        let away = normal.scale(S::select(normal.dot(facing), S::one(), -S::one()));
        Near { distance: away.dot(at_i - at_j), away, place: at_j }
    }
}

/// The places of two cubics, and C′ of the second one, where both have the same tangent and the normal goes through
/// both.
fn together<S: Real>(i: [Local<S>; 4], j: [Local<S>; 4]) -> (Local<S>, Local<S>, Local<S>) {
    let (half, sixth) = (S::constant(0.5), S::constant(1.0 / 6.0));
    let at = |[c0, c1, c2, c3]: [Local<S>; 4], d: S| {
        let square = half * d * d;
        let c = c0 + c1.scale(d) + c2.scale(square) + c3.scale(sixth * d * d * d);
        [c, c1 + c2.scale(d) + c3.scale(square), c2 + c3.scale(d)]
    };
    let mut by = [S::zero(); 2];
    for _ in 0..2 {
        let ([a, a1, a2], [b, b1, b2]) = (at(i, by[0]), at(j, by[1]));
        let arm = a - b;
        let (turned, along) = (a1.cross(b1), arm.dot(b1));
        let [[p, q], [r, s]] =
            [[a2.cross(b1), a1.cross(b2)], [a1.dot(b1), arm.dot(b2) - b1.dot(b1)]];
        let bend = p * s - q * r;
        // where the foot jumps, the places have no derivatives
        let regular = bend * bend;
        let bend = S::select(regular, bend, S::one());
        let step = |x: S| S::select(regular, x / bend, S::zero());
        by = [by[0] - step(turned * s - q * along), by[1] - step(p * along - turned * r)];
    }
    let ([a, ..], [b, b1, _]) = (at(i, by[0]), at(j, by[1]));
    (a, b, b1)
}
