//! The place at which a point or circle of body i touches a curve of body j.
//!
//! The normal force acts along the line from the nearest point C(u) of the curve to the centre P of the circle. A place
//! on this line is given by its distance from P. Friction with sticking acts at the pitch point: with the distance d of
//! P from the curve, the radius r of the circle and the signed radius of curvature ρ of the curve, the pitch point divides
//! the line from P to the centre of curvature in the ratio r : ρ. The velocity v of body i relative to body j there
//! is
//!
//! ```text
//! v = ṡ/c      s = (length along the curve) ± r (ψ - φ)      c = (ρ + r)/(ρ + d)
//! ```
//!
//! with the angle ψ of the normal in the frame of body j and the angle φ of body i relative to body j. So v = 0 is the
//! equation s = constant of the positions, also for a compliant contact, in which d < r. In a rigid contact d = r, and
//! the pitch point is C(u).

use super::curve_pair::BodySeen;
use super::foot::{side_of, sign_of, support_of, Rim};
use super::force_trait::Situation;
use super::hertz::Depth;
use super::kinds::{PointOn, Side};
use super::mode::Mode;
use super::near::Near;
use super::plane_curve::Curve;
use crate::math::{Local, Pose, Real, Vec2, Wrench};

/// A circle of body i and a curve of body j.
#[derive(Clone, Copy)]
pub(super) struct CurveTouch<'e, S> {
    pub i: &'e PointOn<S>,
    pub curve: &'e Rim<S>,
    pub radius: S,
    pub side: Side,
}

/// The state of a contact, in the global frame.
pub(super) struct TouchPoint<S> {
    pub gap: S,
    pub gap_rate: S,
    /// The velocity of body i relative to body j along growing u, at the place of action.
    pub sliding: S,
    /// ν, away from body j, and the direction of growing u.
    pub away: Vec2<S>,
    pub along: Vec2<S>,
    /// The vectors from the origins of bodies i and j to the place of action.
    pub arms: [Vec2<S>; 2],
    /// c of the pitch point.
    pub ratio: S,
}

impl<S: Real> TouchPoint<S> {
    pub fn depth(&self) -> Depth<S> {
        Depth { value: -self.gap, rate: -self.gap_rate }
    }

    /// The wrenches on bodies i and j of a force on i at the place of action.
    pub fn wrenches(&self, force: Vec2<S>) -> [Wrench<S>; 2] {
        // adding zero removes negative zeros, which occur in lanes without contact
        let at = |arm, force| Wrench::at(arm, force) + Wrench::zero();
        [at(self.arms[0], force), at(self.arms[1], -force)]
    }
}

impl<S: Real> CurveTouch<'_, S> {
    /// The centre of the circle in the frame of body j.
    fn center(&self, i: &Pose<S>, j: &Pose<S>) -> Local<S> {
        j.rotation.inverse(i.point(self.i.s) - j.r)
    }

    /// The nearest point of the curve.
    pub fn near(&self, i: &Pose<S>, j: &Pose<S>) -> Near<S> {
        self.near_on(None, i, j)
    }

    /// The nearest point on the support on which the circle rests.
    fn near_on(&self, support: Option<usize>, i: &Pose<S>, j: &Pose<S>) -> Near<S> {
        match self.curve.mate {
            Some(_) => self.curve.near_pair(&BodySeen::new(i, j), self.side),
            None => self.curve.near_on(support, self.center(i, j), self.side),
        }
    }

    /// The distance of the circle from the curve.
    pub fn gap(&self, i: &Pose<S>, j: &Pose<S>) -> S {
        self.near(i, j).distance - self.radius
    }

    /// The side at which the circle touches: -1, or less for a support, an edge or corner of a polygon or a part of a
    /// line.
    pub fn side(&self, at: &Situation<'_, S>) -> f64 {
        let center = self.center(&at.i().pose, &at.j().pose);
        self.curve.support(center).map_or(-1.0, side_of)
    }

    /// How far the circle is from the end of the support on which it rests, without unit.
    pub fn margin(&self, at: &Situation<'_, S>) -> Option<S> {
        self.curve.margin(support_of_mode(at.mode)?, self.center(&at.i().pose, &at.j().pose))
    }

    /// +1 if growing u has the body of the curve at its left.
    fn turned(&self) -> S {
        sign_of(self.side)
    }

    /// The sum of the signed radii of two circles; zero for another curve.
    pub fn pitch(&self) -> S {
        match &self.curve.on.curve {
            Curve::Circle { radius, .. } => *radius + self.turned() * self.radius,
            _ => S::zero(),
        }
    }

    /// The state with the nearest point C(u) as place of action. Between two circles or two smooth curves, the place is
    /// the middle of the depth, whichever of them is that of body i.
    pub fn at_foot(&self, at: &Situation<'_, S>) -> TouchPoint<S> {
        let half = S::constant(0.5);
        self.at(at, |near| {
            let middle = half * (near.distance + self.radius);
            let place = match (&self.curve.on.curve, &self.curve.mate) {
                (Curve::Circle { .. }, _) => {
                    S::select(self.radius * self.radius, middle, near.distance)
                }
                (Curve::Line { .. } | Curve::Polygon(_), _) | (_, None) => near.distance,
                _ => half * near.distance,
            };
            (place, S::one())
        })
    }

    /// The state with the pitch point as place of action.
    pub fn at_pitch(&self, at: &Situation<'_, S>) -> TouchPoint<S> {
        let p = self.center(&at.i().pose, &at.j().pose);
        self.at(at, |near| {
            let ratio = self.ratio(p, near.distance, at.mode);
            (self.radius / ratio, ratio)
        })
    }

    /// The state with a place of action at a distance from the centre of the circle.
    fn at(&self, at: &Situation<'_, S>, place: impl Fn(&Near<S>) -> (S, S)) -> TouchPoint<S> {
        let (i, j) = (at.i(), at.j());
        let near = self.near_on(support_of_mode(at.mode), &i.pose, &j.pose);
        let (from_center, ratio) = place(&near);
        let away = j.pose.global(near.away);
        let along = away.perp().scale(self.turned());
        let on_j = j.pose.global(near.place + near.away.scale(near.distance - from_center));
        let on_i = j.pose.r + on_j - i.pose.r;
        let velocity = |arm: Vec2<S>, k: usize| {
            let twist = at.body(k).twist;
            twist.velocity + arm.perp().scale(twist.omega)
        };
        let apart = velocity(on_i, 0) - velocity(on_j, 1);
        TouchPoint {
            gap: near.distance - self.radius,
            gap_rate: away.dot(apart),
            sliding: along.dot(apart),
            away,
            along,
            arms: [on_i, on_j],
            ratio,
        }
    }

    /// c for the centre of the circle in the frame of body j. Beyond the end of a line, ρ = 0.
    fn ratio(&self, p: Local<S>, distance: S, mode: Mode) -> S {
        let of = |bend: S| {
            // a point on a corner has neither curvature nor distance
            let below = bend + distance;
            let regular = below * below * (bend + self.radius) * (bend + self.radius);
            let below = S::select(regular, below, S::one());
            S::select(regular, (bend + self.radius) / below, S::one())
        };
        if let Some(support) = support_of_mode(mode) {
            return if self.curve.is_level(support) { S::one() } else { of(S::zero()) };
        }
        match &self.curve.on.curve {
            Curve::Circle { radius, .. } => of(self.turned() * *radius),
            Curve::Line { from, to } => {
                let (u, length) = along_line(p, *from, *to);
                S::select(-u, of(S::zero()), S::select(u - length, of(S::zero()), S::one()))
            }
            Curve::Polygon(own) => S::select(own.foot(p).level, S::one(), of(S::zero())),
            _ => S::one(),
        }
    }

    /// s of lines, circles and polygons, less `value`, for the poses of bodies i and j. The length along a closed curve
    /// is known up to whole turns; that with the smallest magnitude is chosen.
    pub fn rolled(&self, i: &Pose<S>, j: &Pose<S>, value: S) -> S {
        let (p, turned) = (self.center(i, j), self.turned());
        let spin = turned * self.radius * (i.angle - j.angle);
        match &self.curve.on.curve {
            Curve::Circle { center, .. } => {
                let (arm, pitch) = (p - *center, self.pitch());
                let turn = S::constant(std::f64::consts::TAU) * pitch;
                within_turn(pitch * arm.y.atan2(arm.x) - spin - value, turn)
            }
            Curve::Polygon(own) => {
                let [length, angle] = own.foot(p).along;
                within_turn(length + self.radius * angle - spin - value, own.turn(self.radius))
            }
            Curve::Line { from, to } => {
                let (u, length) = along_line(p, *from, *to);
                let within = S::select(u, S::select(length - u, u, length), S::zero());
                let normal = (-(*to - *from).perp()).scale(turned);
                let away = self.curve.near(p, self.side).away;
                let level = S::select(-u, S::zero(), S::select(u - length, S::zero(), S::one()));
                let psi = normal.cross(away).atan2(normal.dot(away));
                within + turned * self.radius * S::select(level, S::zero(), psi) - spin - value
            }
            _ => S::zero(),
        }
    }
}

/// The support on which a contact in this mode rests.
fn support_of_mode(mode: Mode) -> Option<usize> {
    match mode {
        Mode::Holds(side) => support_of(side),
        _ => None,
    }
}

/// The value of s with the smallest magnitude that differs by whole turns.
fn within_turn<S: Real>(s: S, turn: S) -> S {
    s - turn * (s / turn + S::constant(0.5)).floor()
}

/// The length along a line to the foot of p, and the length of the line.
fn along_line<S: Real>(p: Local<S>, from: Local<S>, to: Local<S>) -> (S, S) {
    let along = to - from;
    let length = along.norm();
    (along.dot(p - from) / length, length)
}
