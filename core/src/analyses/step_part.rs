//! Bounds of quantities of a motion over a part of a step: coordinates, formulas and distances.
//!
//! A distance changes at most as fast as its points move. Along its gradient n, it changes by n·(p - p_m) with an
//! error of at most κ |p - p_m|²/2 for a motion p of the point that is p_m in the middle of the part, where κ bounds
//! the turning of the gradient (`elements::Apart`).

use crate::elements::{
    Apart, Behaviour, BodyId, Clearance, Coordinate, Followed, ForceElement, Rim, Side, Way,
};
use crate::expression::{Tape, Values};
use crate::integrate::{Bounds, Step, StepPath};
use crate::math::{Interval, Local, Pose, Real, ShortArray, Vec2};
use crate::model::{ForceItem, Model, Variable};
use std::cell::RefCell;
use std::collections::HashMap;

/// Rounding errors of a distance, in floating-point spacings of the coordinates.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Smallest and largest number of parts of a step for functions without bounds.
const PARTS: [usize; 2] = [6, 20_000];

/// Number of parts of a step in which no body turns by more than a radian.
pub fn parts(model: &Model, step: &Step<'_>) -> usize {
    let turned = model.layout.bodies[1..].iter().filter(|columns| columns.count == 3);
    let turned =
        turned.map(|columns| (step.y[columns.first + 2] - step.y_old[columns.first + 2]).abs());
    (turned.fold(0.0, f64::max).ceil() as usize).clamp(PARTS[0], PARTS[1])
}

/// A part of a step.
pub struct StepPart<'a> {
    model: &'a Model,
    path: &'a StepPath<'a>,
    pub span: [f64; 2],
    /// The held pieces of the switches of the model; empty if none is held.
    pieces: &'a [f64],
    /// Whether the slopes of coordinates are the bounds of their rates, which differ from those of the interpolant.
    rates: bool,
    /// The bounds of components of the state that were computed.
    known: RefCell<HashMap<usize, Bounds>>,
    /// The poses of bodies that were bounded, with those in the middle of the part.
    poses: RefCell<HashMap<usize, (Pose<Bounds>, Pose)>>,
}

impl Values<Bounds> for StepPart<'_> {
    fn parameter(&self, k: usize) -> Bounds {
        Bounds::constant(self.model.parameters[k])
    }
    fn time(&self) -> Bounds {
        self.path.time(self.span)
    }
    fn variable(&self, k: usize) -> Bounds {
        let layout = &self.model.layout;
        match Variable::at(k) {
            Variable::Coordinate(body, coordinate) => self.coordinate(body, coordinate),
            Variable::State(k) => self.state(k),
            Variable::Function(_) => Bounds::constant(f64::NAN),
            Variable::Internal { place, rate } => {
                let first = layout.bodies.iter().map(|columns| columns.range().end).max();
                self.column(first.unwrap_or(0) + place, rate)
            }
        }
    }
    fn piece(&self, k: usize) -> f64 {
        self.pieces.get(k).copied().unwrap_or(f64::NAN)
    }
}

impl<'a> StepPart<'a> {
    /// The part between two times.
    pub fn new(
        model: &'a Model,
        path: &'a StepPath<'a>,
        span: [f64; 2],
        pieces: &'a [f64],
    ) -> Self {
        let (known, poses) = Default::default();
        Self { model, path, span, pieces, rates: false, known, poses }
    }

    /// The bounds of the rate of a position quantity, which `of` gives.
    pub fn rate(&self, of: impl FnOnce(&Self) -> Option<Bounds>) -> Option<Bounds> {
        let (known, poses) = Default::default();
        let [value] = of(&Self { rates: true, known, poses, ..*self })?.slope;
        Some(Bounds { value, ..Bounds::constant(f64::NAN) })
    }

    /// A component of y = (q, v, z, works).
    pub fn component(&self, k: usize) -> Bounds {
        if let Some(bounds) = self.known.borrow().get(&k) {
            return *bounds;
        }
        let mut bounds = self.path.component(k, self.span);
        if self.rates && k < self.model.layout.n_q {
            bounds.slope = [self.path.component(k + self.model.layout.n_q, self.span).value];
        }
        self.known.borrow_mut().insert(k, bounds);
        bounds
    }

    /// A column of q, or its rate.
    pub fn column(&self, column: usize, rate: bool) -> Bounds {
        self.component(column + if rate { self.model.layout.n_q } else { 0 })
    }

    /// A first-order state.
    pub fn state(&self, k: usize) -> Bounds {
        self.component(2 * self.model.layout.n_q + k)
    }

    /// A work since the start of the run.
    pub fn work(&self, k: usize) -> Bounds {
        self.state(self.model.layout.n_z + k)
    }

    fn coordinate(&self, body: BodyId, of: Coordinate) -> Bounds {
        let columns = self.model.layout.bodies[body.0];
        match of.column() < columns.count {
            true => self.column(columns.first + of.column(), of.is_rate()),
            false => Bounds::zero(),
        }
    }

    fn pose(&self, body: BodyId) -> Pose<Bounds> {
        if body.is_ground() {
            return Pose::identity();
        }
        let of = |coordinate| self.coordinate(body, coordinate);
        let r = Vec2::new(of(Coordinate::X), of(Coordinate::Y));
        match self.model.layout.bodies[body.0].count {
            3 => Pose::new(r.x, r.y, of(Coordinate::Angle)),
            _ => Pose { r, ..Pose::identity() },
        }
    }

    /// The pose of a body, and in the middle of the part.
    fn poses(&self, body: BodyId) -> (Pose<Bounds>, Pose) {
        if let Some(poses) = self.poses.borrow().get(&body.0) {
            return *poses;
        }
        let poses = (self.pose(body), self.middle(body));
        self.poses.borrow_mut().insert(body.0, poses);
        poses
    }

    /// The pose of a body in the middle of the part.
    fn middle(&self, body: BodyId) -> Pose {
        let t = self.span[0] + 0.5 * (self.span[1] - self.span[0]);
        let columns = self.model.layout.bodies[body.0];
        let of = |k: usize| match k < columns.count {
            true => self.path.value(columns.first + k, t),
            false => 0.0,
        };
        Pose::new(of(0), of(1), of(2))
    }

    /// A component of a point of a body, or of its velocity.
    pub fn point(&self, body: BodyId, point: usize, axis: usize, rate: bool) -> Bounds {
        let s = self.model.bodies[body.0].points[point].1;
        let s = Local::new(Bounds::constant(s.x), Bounds::constant(s.y));
        let pose = self.pose(body);
        let p = match rate {
            false => pose.point(s),
            true => {
                let of = |coordinate| self.coordinate(body, coordinate);
                let velocity = Vec2::new(of(Coordinate::Vx), of(Coordinate::Vy));
                velocity + pose.global(s).perp().scale(of(Coordinate::Omega))
            }
        };
        [p.x, p.y][axis]
    }

    /// A position quantity.
    pub fn followed(&self, of: &Followed<Tape>) -> Bounds {
        match of {
            Followed::Coordinate(of) => self.coordinate(of.body, of.coordinate),
            Followed::Quantity(of) => of.value.evaluate(self),
        }
    }

    /// A switch of a law, by its index among the switches of the model.
    pub fn switch(&self, law: &Tape, switch: usize) -> Bounds {
        let mut found = Bounds::constant(f64::NAN);
        law.switch_functions(self, |k, sigma| {
            if k == switch {
                found = sigma;
            }
        });
        found
    }

    /// Whether a force is a stop or contact.
    pub fn is_contact(&self, force: usize) -> bool {
        let behaviour = self.model.forces[force].element.behaviour();
        matches!(behaviour, Some(Behaviour::Compliant { .. } | Behaviour::Impacts { .. }))
    }

    /// The distance of a force that begins or ends a contact, or the least of several. None if it is not known.
    pub fn apart(&self, force: usize, place: Option<usize>) -> Option<Bounds> {
        let item = &self.model.forces[force];
        let all = item.element.clearances();
        let wanted = all.iter().enumerate().filter(|(k, _)| place.is_none_or(|place| *k == place));
        let bounds = wanted.map(|(_, of)| self.distance(of, item));
        bounds.reduce(|a, b| Some(a?.min(b?)))?
    }

    /// The least distance of all parts of a contact. None if it is not known.
    pub fn gap(&self, force: usize) -> Option<Bounds> {
        let all = self.model.parts(force).map(|part| self.apart(part, None));
        all.reduce(|a, b| Some(a?.min(b?)))?
    }

    /// The function 1 + c δ̇ of a compliant contact, which is 1 where the bodies are apart.
    pub fn pushes(&self, force: usize, place: usize) -> Option<Bounds> {
        let behaviour = self.model.forces[force].element.behaviour();
        let Some(Behaviour::Compliant { damping: Some(damping), .. }) = behaviour else {
            return None;
        };
        if damping == 0.0 {
            return Some(Bounds::one());
        }
        let gap = self.apart(force, Some(place))?;
        if gap.value.low > 0.0 {
            return Some(Bounds::one());
        }
        let rate = self.rate(|part| part.apart(force, Some(place)))?;
        let factor = Bounds::one() - Bounds::constant(damping) * rate;
        Some(Bounds::select(-gap, factor, Bounds::one()))
    }

    fn distance(&self, of: &Clearance<'_>, item: &ForceItem) -> Option<Bounds> {
        let ForceItem { element, bodies, .. } = item;
        let law = item.law.as_deref();
        let constant = Bounds::constant;
        let local = |s: Local| Local::new(constant(s.x), constant(s.y));
        let at = |place: usize| self.poses(bodies[place]);
        match *of {
            Clearance::Limit { limit, sign } => {
                let s = match (law.and_then(ForceElement::followed), element.followed()?) {
                    (Some(of), _) => self.followed(of),
                    (None, Followed::Coordinate(of)) => self.coordinate(of.body, of.coordinate),
                    (None, Followed::Quantity(_)) => return None,
                };
                Some(constant(sign) * (s - constant(limit)))
            }
            _ if law.is_some() => None,
            Clearance::Curve { curve, side, radius, .. } if curve.mate.is_some() => {
                Some(self.of_pair(curve, side, bodies)? - constant(radius))
            }
            Clearance::Curve { i, curve, side, radius } => {
                let ((moving, there), (frame, held)) = (at(0), at(1));
                let p = moving.point(local(i.s)) - frame.r;
                let p = match bodies[1].is_ground() {
                    true => Local::new(p.x, p.y),
                    false => frame.rotation.inverse(p),
                };
                let middle = held.rotation.inverse(there.point(i.s) - held.r);
                let apart = |way: Way| curve.apart(middle, side, (way, radius));
                Some(
                    self.moved([p.x, p.y], &apart, there.r.norm() + held.r.norm())
                        - constant(radius),
                )
            }
            Clearance::Length { i, j, length, sign } => {
                let ((of_i, at_i), (of_j, at_j)) = (at(0), at(1));
                let d = of_j.point(local(j.s)) - of_i.point(local(i.s));
                let middle = at_j.point(j.s) - at_i.point(i.s);
                let middle = Local::new(middle.x, middle.y);
                let apart = |way: Way| Apart::from_origin(middle, way.within);
                let found = self.moved([d.x, d.y], &apart, at_i.r.norm() + at_j.r.norm());
                Some(constant(sign) * (found - constant(length)))
            }
        }
    }

    /// The distance of two curves. It changes as fast as the nearest place of body i moves along the normal. The normal
    /// turns as fast as this place slides, over the sum of the radii of curvature and the distance.
    fn of_pair(&self, curve: &Rim, side: Side, bodies: &[BodyId]) -> Option<Bounds> {
        let [i, j] = [bodies[0], bodies[1]];
        let ((moving, at_i), (frame, at_j)) = (self.poses(i), self.poses(j));
        let apart = curve.pair_apart(&at_i, &at_j, side)?;
        let constant = Bounds::constant;
        let place = Local::new(constant(apart.place.x), constant(apart.place.y));
        let p = moving.point(place) - frame.r;
        let p = match j.is_ground() {
            true => Local::new(p.x, p.y),
            false => frame.rotation.inverse(p),
        };
        let [x, y] = [p.x.slope[0], p.y.slope[0]];
        let spin = (moving.angle.slope[0] + -frame.angle.slope[0]).largest_magnitude();
        let half = 0.5 * (self.span[1] - self.span[0]).abs();
        let fixed = |by: f64| Interval::around(0.0, by);
        let times = |k: f64, of: Interval| Interval::new(k, k) * of;
        // of all places of body i
        let speed = x.largest_magnitude().hypot(y.largest_magnitude()) + spin * apart.size;
        let turned = |(least, [of_i, of_j]): (f64, [f64; 2])| {
            let from = least + apart.distance - half * speed;
            let by = half * (speed / from + spin * (least / from).max(1.0));
            (from > 0.0 && by <= of_j && by + half * spin <= of_i).then_some(by)
        };
        // an edge keeps its normal
        let level = apart.level > half * speed + curve.moves(&apart, half * spin);
        let turned = if level { Some(0.0) } else { apart.least.into_iter().find_map(turned) };
        let mut slope = fixed(speed);
        if let Some(by) = turned {
            let moved = curve.moves(&apart, by + half * spin);
            let along = times(apart.away.x, x) + times(apart.away.y, y);
            slope = slope.and(along + fixed(by * speed + spin * moved));
        }
        let far = at_i.r.norm() + at_j.r.norm() + apart.size + apart.distance.abs();
        let value = Interval::new(apart.distance, apart.distance) + slope * fixed(half);
        Some(Bounds { value: value + fixed(ROUNDING * far), slope: [slope] })
    }

    /// A distance during the motion of a point. `apart` gives the distance in the middle of the part.
    fn moved(&self, p: [Bounds; 2], apart: &dyn Fn(Way) -> Apart, far: f64) -> Bounds {
        let [x, y] = p.each(|p| p.slope[0]);
        let speed = x.largest_magnitude().hypot(y.largest_magnitude());
        let half = 0.5 * (self.span[1] - self.span[0]).abs();
        let within = speed * half;
        let middle = |of: Interval| 0.5 * (of.low + of.high);
        let error = half * (0.5 * x.spread()).hypot(0.5 * y.spread());
        let by = Local::new(half * middle(x), half * middle(y));
        let Apart { distance, away, bend, error, other } = apart(Way { by, error, within });
        let rounding = ROUNDING * (far + distance.abs() + p[0].value.largest_magnitude());
        let fixed = |by: f64| Interval::around(0.0, by);
        let mut value = Interval::around(distance, within + error);
        let mut slope = fixed(speed);
        if bend.is_finite() {
            let times = |k: f64, of: Interval| Interval::new(k, k) * of;
            let along = times(away.x, x) + times(away.y, y);
            let moved = along * fixed(half) + fixed(0.5 * bend * within * within);
            let own = Interval::new(distance, distance) + moved;
            if other == f64::INFINITY {
                value = value.and(own);
                slope = slope.and(along + fixed(bend * within * speed));
            } else if own.low > 0.0 && other > 0.0 {
                value = value.and(Interval::new(own.low.min(other), own.high));
            }
        }
        Bounds { value: value + fixed(rounding), slope: [slope] }
    }
}
