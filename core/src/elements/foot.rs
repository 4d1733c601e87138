//! The curve of a contact: its point nearest to a given point, and the direction away from the curve.
//!
//! Lines and circles have closed forms. Other curves are searched over `f64`, lane by lane. Two steps of Newton's
//! method over the scalar then yield the derivatives of u (implicit function), exact to third order.
//!
//! The material of the body is on the other side of the curve. An open curve ends with a corner: on the side of the
//! contact, the distance of a point beyond an end is the distance from the corner. Behind a line, the normals at its
//! ends bound the body, so that the gap is continuous there. Behind other open curves, the normals bound the body
//! only beyond the ends.

use super::apart::{from_corner, Apart, Way};
use super::field::{Default, Field, Shape};
use super::kinds::{self, CurveOn, Kind, Side, Source};
use super::line_foot::{self, beyond, of_line, Straight, LEVEL};
use super::near::{choose, Near};
use super::nearest::{AlongCurve, CurveSearch};
use super::normal_fan::NormalFan;
use super::plane_curve::Curve;
use crate::expression::Tape;
use crate::math::{each, Listed, Local, Real, ShortArray};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Largest number of searches that are kept for each element.
const MOST_KNOWN: usize = 8;

/// A curve of a body, with the data for searches.
#[derive(Clone, Debug)]
pub struct Rim<S = f64> {
    /// The curve.
    pub on: CurveOn<S>,
    /// One search for all lanes, or one search for each lane.
    searches: OnceLock<Vec<Arc<CurveSearch>>>,
    /// The latest searches of this element over any scalar and for any parameters.
    known: Arc<Mutex<Vec<Arc<CurveSearch>>>>,
    /// The curve of body i that touches this one, in place of a point.
    pub mate: Option<Box<Mate<S>>>,
}

/// A curve of body i that touches a curve of body j.
#[derive(Clone, Debug)]
pub struct Mate<S = f64> {
    /// The curve.
    pub rim: Rim<S>,
    /// Its side on which body j lies.
    pub side: Side,
}

impl<S> Rim<S> {
    /// A curve whose search is prepared at the first use.
    pub fn new(on: CurveOn<S>) -> Self {
        Self { on, searches: OnceLock::new(), known: Arc::default(), mate: None }
    }

    /// The same with a curve of body i.
    pub fn touched_by(self, mate: Option<(CurveOn<S>, Side)>) -> Self {
        let mate = mate.map(|(on, side)| Box::new(Mate { rim: Self::new(on), side }));
        Self { mate, ..self }
    }

    /// Whether the nearest point is a formula of the coordinates.
    pub fn has_formulas(&self) -> bool {
        matches!(self.on.curve, Curve::Line { .. } | Curve::Circle { .. }) && self.mate.is_none()
    }

    /// Whether the nearest point has a closed form.
    pub fn is_closed_form(&self) -> bool {
        self.has_formulas() || matches!(self.on.curve, Curve::Polygon(_)) && self.mate.is_none()
    }
}

impl Rim<Tape> {
    /// The curve on which a body rests, see [`CurveTouch::side`](super::touch::CurveTouch::side).
    pub fn supporting(&self, side: f64) -> Self {
        let curve = match (&self.on.curve, support_of(side)) {
            (Curve::Polygon(own), Some(support)) => own.supporting(support),
            (Curve::Line { from, to }, Some(support)) => line_foot::supporting(from, to, support),
            _ => return self.clone(),
        };
        Rim::new(CurveOn { body: self.on.body, curve })
    }
}

/// The side at which a body rests on an edge or corner of a polygon with this index.
pub(super) fn side_of(support: usize) -> f64 {
    -2.0 - support as f64
}

/// The index of an edge or corner of a polygon, if a side is one.
pub(super) fn support_of(side: f64) -> Option<usize> {
    (side <= -2.0).then(|| (-2.0 - side) as usize)
}

/// A curve of a contact.
#[allow(non_camel_case_types)] // a type in `element!`, written like a word
#[derive(Clone, Copy, Debug)]
pub enum rim {}

impl Kind for rim {
    type Over<S> = Rim<S>;
    const SHAPE: Shape = Shape::Curve;
    fn read(source: &mut dyn Source, field: &Field) -> Option<Rim<Tape>> {
        let on = source.curve(field)?;
        Some(Rim::new(on).touched_by(source.mate()))
    }
    fn map<S, T>(value: &Rim<S>, f: &mut dyn FnMut(&S) -> T) -> Rim<T> {
        let known = Arc::clone(&value.known);
        let mate = value.mate.as_ref();
        let mate = mate.map(|of| Box::new(Mate { rim: rim::map(&of.rim, f), side: of.side }));
        Rim { on: kinds::curve::map(&value.on, f), searches: OnceLock::new(), known, mate }
    }
}

/// A curve of a contact that another form of the element replaces, so that the field may be absent.
#[allow(non_camel_case_types)] // a type in `element!`, written like a word
#[derive(Clone, Copy, Debug)]
pub enum rim_or_curves {}

impl Kind for rim_or_curves {
    type Over<S> = Rim<S>;
    const SHAPE: Shape = rim::SHAPE;
    const DEFAULT: Option<Default> = Some(Default::Absent);
    fn read(source: &mut dyn Source, field: &Field) -> Option<Rim<Tape>> {
        rim::read(source, field)
    }
    fn map<S, T>(value: &Rim<S>, f: &mut dyn FnMut(&S) -> T) -> Rim<T> {
        rim::map(value, f)
    }
}

impl Rim {
    /// The distance of p from the curve, positive on the given side, with the turning of its gradient along a way
    /// around p. Farther from the curve than `far`, the distance is only approximate.
    pub fn apart(&self, p: Local, side: Side, (way, far): (Way, f64)) -> Apart {
        let within = way.within;
        let of = |distance: f64, away: Local, bend: f64| Apart {
            distance,
            away,
            bend,
            error: 0.0,
            other: f64::INFINITY,
        };
        match &self.on.curve {
            Curve::Circle { center, .. } => {
                let Near { distance, away, .. } = self.near(p, side);
                of(distance, away, from_corner((p - *center).norm(), within))
            }
            Curve::Line { from, to } => {
                let Near { distance, away, .. } = self.near(p, side);
                let (along, arm) = (*to - *from, p - *from);
                let length = along.norm();
                let (u, up) = (along.dot(arm) / length, along.cross(arm).abs() / length);
                // the nearest point stays between the ends, or the ends are corners
                let inside = u.min(length - u) - within;
                let level = inside > 0.0 && up > within || inside > up + within;
                let flat = if distance > 0.0 { level } else { inside > up + within };
                of(distance, away, if flat { 0.0 } else { from_corner(distance, within) })
            }
            Curve::Polygon(own) => own.apart(p, way),
            curve => self.searched_apart(curve, p, side, (way, far)),
        }
    }

    /// The place u of the point nearest to p. None for a line or circle, which has no second foot.
    pub fn foot(&self, p: Local) -> Option<f64> {
        (!self.is_closed_form()).then(|| self.searches()[0].nearest(p).u())
    }

    /// Another foot of p than the foot `own`, and the place between them that is farthest from p. The other foot is
    /// within a distance of p, or beside the place `from`.
    pub fn other_foot(&self, p: Local, own: f64, place: (f64, f64)) -> Option<[f64; 2]> {
        self.searches()[0].other_foot(p, own, place)
    }

    fn searched_apart(&self, curve: &Curve, p: Local, side: Side, (way, far): (Way, f64)) -> Apart {
        let (search, within) = (&self.searches()[0], way.within);
        let out = if side == Side::Right { 1.0 } else { -1.0 };
        if curve.periodic() {
            let (right, error) = search.rough(p);
            if right.abs() > far + within + 2.0 * error {
                let (distance, away) = (out * right, Local::zero());
                return Apart { distance, away, bend: f64::INFINITY, error, other: f64::INFINITY };
            }
        }
        let (u, distance, away) = match search.nearest(p) {
            AlongCurve::Within(u) => {
                let [c, first] = curve.tangent(u);
                let away = (-first.perp()).scale(out / first.norm());
                (u, away.dot(p - c), away)
            }
            AlongCurve::First(u) | AlongCurve::Last(u) => {
                let Near { distance, away, .. } = self.near(p, side);
                (u, distance, away)
            }
        };
        let reach = distance.abs() + 2.0 * within;
        let near = search.branches((p, u), reach, (way.by, way.error));
        let bend = near.turning(out, distance, within);
        let ends = curve.range().each(|u| (p - curve.point(u)).norm());
        let bend = match curve.periodic() || ends[0].min(ends[1]) > reach {
            true => bend,
            false => bend.max(from_corner(distance, within)),
        };
        let moved = away.dot(way.by).abs() + way.error + 0.5 * bend * within * within;
        let other = if near.other > distance.abs() + moved { f64::INFINITY } else { near.other };
        Apart { distance, away, bend, error: 0.0, other }
    }
}

impl<S: Real> Rim<S> {
    /// The point nearest to p, with the distance positive on the given side.
    pub(super) fn near(&self, p: Local<S>, side: Side) -> Near<S> {
        let out = sign_of(side);
        match &self.on.curve {
            Curve::Circle { center, radius } => of_circle(p, *center, *radius, out),
            Curve::Line { from, to } => of_line(p, *from, *to, out),
            Curve::Polygon(own) => own.foot(p).near,
            curve => self.searched(curve, p, out),
        }
    }

    /// The point nearest to p on the curve that supports a body, see [`Rim::supporting`].
    pub(super) fn near_on(&self, support: Option<usize>, p: Local<S>, side: Side) -> Near<S> {
        match (&self.on.curve, support) {
            (Curve::Polygon(own), Some(support)) => own.foot_on_support(support, p).near,
            (Curve::Line { from, to }, Some(support)) => {
                Straight::new(p, *from, *to, sign_of(side)).near_on(support)
            }
            _ => self.near(p, side),
        }
    }

    /// The edge or corner of a polygon, or the part of a line, that is nearest to p. None for another curve, and for the
    /// touch of two curves.
    pub(super) fn support(&self, p: Local<S>) -> Option<usize> {
        match &self.on.curve {
            _ if self.mate.is_some() => None,
            Curve::Polygon(own) => {
                Some(own.support(Local::new(p.x.in_lanes()[0], p.y.in_lanes()[0])))
            }
            Curve::Line { from, to } => Some(Straight::new(p, *from, *to, S::one()).support()),
            _ => None,
        }
    }

    /// How far p is from where a support ends, relative to the circumference of a polygon or the length of a line.
    pub(super) fn margin(&self, support: usize, p: Local<S>) -> Option<S> {
        match &self.on.curve {
            Curve::Polygon(own) => Some(own.margin(support, p)),
            Curve::Line { from, to } => {
                Some(Straight::new(p, *from, *to, S::one()).margin(support))
            }
            _ => None,
        }
    }

    /// Whether a support is an edge of a polygon or the inside of a line, not a corner or an end.
    pub(super) fn is_level(&self, support: usize) -> bool {
        match &self.on.curve {
            Curve::Polygon(own) => own.is_edge(support),
            _ => support == LEVEL,
        }
    }

    /// Whether the numbers of its curves are the same in all lanes.
    pub(super) fn is_one_curve(&self) -> bool {
        self.searches().len() == 1 && self.mate.as_ref().is_none_or(|of| of.rim.is_one_curve())
    }

    /// The normals of the convex body of the curve.
    pub(super) fn fan(&self, lane: usize, side: Side) -> &NormalFan {
        let all = self.searches();
        all[lane.min(all.len() - 1)].fan(side)
    }

    fn searches(&self) -> &[Arc<CurveSearch>] {
        self.searches.get_or_init(|| {
            let numbers = |lane: usize| self.numbers(lane);
            let first = numbers(0);
            let lanes = if (1..4).all(|lane| numbers(lane) == first) { 1 } else { 4 };
            let search = |lane: usize| {
                let numbers = numbers(lane);
                let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some(same) = known.iter().find(|search| search.numbers == numbers) {
                    return Arc::clone(same);
                }
                let curve = self.on.curve.map(&mut |x: &S| x.in_lanes()[lane]);
                let found = Arc::new(CurveSearch::new(curve, numbers));
                known.truncate(MOST_KNOWN - 1);
                known.insert(0, Arc::clone(&found));
                found
            };
            (0..lanes).map(search).list()
        })
    }

    /// The numbers that determine the curve in a lane.
    fn numbers(&self, lane: usize) -> Vec<f64> {
        let of = |x: &S| x.in_lanes()[lane];
        let mut all = Vec::new();
        match &self.on.curve {
            Curve::Points(own) => {
                own.points.iter().flat_map(|s| [of(&s.x), of(&s.y)]).append_to(&mut all)
            }
            curve => {
                curve.map(&mut |x: &S| {
                    all.push(of(x));
                    0.0
                });
            }
        }
        all
    }

    fn searched(&self, curve: &Curve<S>, p: Local<S>, out: S) -> Near<S> {
        let searches = self.searches();
        let (x, y) = (p.x.in_lanes(), p.y.in_lanes());
        let mut found = [(0.0, 0.0); 4];
        for lane in 0..4 {
            let same = lane > 0 && searches.len() == 1 && (x[lane], y[lane]) == (x[0], y[0]);
            found[lane] = if same {
                found[0]
            } else {
                let search = &searches[lane.min(searches.len() - 1)];
                match search.nearest(Local::new(x[lane], y[lane])) {
                    AlongCurve::Within(u) => (u, 0.0),
                    AlongCurve::First(u) => (u, -1.0),
                    AlongCurve::Last(u) => (u, 1.0),
                }
            };
        }
        let end = S::of_lanes(each(found, |(_, end)| end));
        let [first, last] = curve.range();
        let within = S::of_lanes(each(found, |(u, _)| u));
        let u = S::select(end, last, S::select(-end, first, within));
        let terms = curve.derivatives(u);
        let inner = S::constant(0.5) - end * end;
        let (c, first) = at_foot(terms, p, inner);
        let tangent = first.scale(S::one() / first.norm());
        let normal = (-tangent.perp()).scale(out);
        let arm = p - c;
        let within = Near { distance: normal.dot(arm), away: normal, place: c };
        if found.iter().all(|(_, end)| *end == 0.0) {
            return within;
        }
        choose(inner, within, beyond(c, tangent.scale(end), normal, arm))
    }
}

/// C and C′ at the foot of p on the cubic with these derivatives, or at the start of the cubic where `inner` ≤ 0.
#[inline(never)]
pub(super) fn at_foot<S: Real>(
    [c0, c1, c2, c3]: [Local<S>; 4],
    p: Local<S>,
    inner: S,
) -> (Local<S>, Local<S>) {
    let (half, sixth) = (S::constant(0.5), S::constant(1.0 / 6.0));
    let mut d = S::zero();
    let at = |d: S| {
        let square = half * d * d;
        let c = c0 + c1.scale(d) + c2.scale(square) + c3.scale(sixth * d * d * d);
        (c, c1 + c2.scale(d) + c3.scale(square), c2 + c3.scale(d))
    };
    for _ in 0..2 {
        let (c, first, second) = at(d);
        let (arm, speed) = (c - p, first.dot(first));
        let bend = speed + arm.dot(second);
        // at a centre of curvature, the foot jumps and has no derivatives
        let regular = bend * bend - S::constant(1e-12) * speed * speed;
        let step = arm.dot(first) / S::select(regular, bend, S::one());
        let moves = S::select(regular, inner, -S::one());
        d -= S::select(moves, step, S::zero());
    }
    let (c, first, _) = at(d);
    (c, first)
}

fn of_circle<S: Real>(p: Local<S>, center: Local<S>, radius: S, out: S) -> Near<S> {
    let arm = p - center;
    let squared = arm.dot(arm);
    let from = S::select(squared, squared.sqrt(), S::zero());
    // the centre has the same distance from every point; the x direction is chosen
    let part = |x: S, other: S| S::select(squared, x / from, other);
    let radial = Local::new(part(arm.x, S::one()), part(arm.y, S::zero()));
    let place = center + radial.scale(radius);
    Near { distance: out * (from - radius), away: radial.scale(out), place }
}

/// +1 for the right side of a curve, -1 for the left one.
pub(super) fn sign_of<S: Real>(side: Side) -> S {
    S::constant(match side {
        Side::Right => 1.0,
        Side::Left => -1.0,
    })
}
