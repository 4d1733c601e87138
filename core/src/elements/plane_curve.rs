//! Curves in a body: points C(u) in its frame, m, with their derivatives with respect to the parameter u.
//!
//! A curve is evaluated over any scalar. C, C′, C″ and C‴ are exact: a formula is evaluated over jets of dual
//! numbers, and the polynomials of a spline are differentiated. The equations of a joint on a curve are
//! differentiated twice and contain C′, so that γ needs C‴. All four are obtained from a single evaluation by
//! [`Curve::near`].

use super::curve_formula::Formula;
use super::curve_points::CurvePoints;
use super::polygon::Polygon;
use super::quantity_kind::QuantityKind;
use crate::expression::Knots;
use crate::math::{indexed, Interpolation, Local, Real};
use std::sync::Arc;

/// A curve.
#[derive(Clone, Debug)]
pub enum Curve<S = f64> {
    /// x(u) and y(u) as formulas.
    Formula(Formula<S>),
    /// A spline over the accumulated chord length of its points.
    Points(CurvePoints<S>),
    /// A circle; u is the angle, counter-clockwise.
    Circle {
        /// Its centre, m.
        center: Local<S>,
        /// Its radius, m.
        radius: S,
    },
    /// A straight line; u is the length from its first end.
    Line {
        /// Its first end, m.
        from: Local<S>,
        /// Its last end, m.
        to: Local<S>,
    },
    /// A closed polygon; u is the length along it from its first corner, counter-clockwise.
    Polygon(Polygon),
    /// The curve near u = `at`, by its derivatives of order 0 to 3 there.
    Near {
        /// u.
        at: S,
        /// C, C′, C″, C‴.
        terms: [Local<S>; 4],
    },
}

impl<S> Curve<S> {
    /// Whether it repeats itself.
    pub fn periodic(&self) -> bool {
        match self {
            Self::Formula(formula) => formula.periodic,
            Self::Points(points) => points.periodic,
            Self::Circle { .. } | Self::Polygon(_) => true,
            Self::Line { .. } | Self::Near { .. } => false,
        }
    }

    /// What u measures.
    pub fn kind(&self) -> QuantityKind {
        match self {
            Self::Formula(formula) => formula.kind,
            Self::Circle { .. } => QuantityKind::Angle,
            Self::Points(_) | Self::Line { .. } | Self::Polygon(_) | Self::Near { .. } => {
                QuantityKind::Length
            }
        }
    }

    /// The same curve over another scalar.
    pub fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Curve<T> {
        let mut local = |s: &Local<S>| Local { x: f(&s.x), y: f(&s.y) };
        match self {
            Self::Formula(formula) => Curve::Formula(formula.map(f)),
            Self::Points(points) => Curve::Points(points.map(f)),
            Self::Circle { center, radius } => {
                let center = local(center);
                Curve::Circle { center, radius: f(radius) }
            }
            Self::Line { from, to } => Curve::Line { from: local(from), to: local(to) },
            Self::Polygon(own) => Curve::Polygon(own.clone()),
            Self::Near { at, terms } => {
                let [c0, c1, c2, c3] = terms;
                let terms = [local(c0), local(c1), local(c2), local(c3)];
                Curve::Near { terms, at: f(at) }
            }
        }
    }
}

impl<S: Real> Curve<S> {
    /// The ends of u; a periodic curve repeats itself beyond them.
    pub fn range(&self) -> [S; 2] {
        match self {
            Self::Formula(formula) => formula.range,
            Self::Points(points) => points.range(),
            Self::Circle { .. } => [S::zero(), S::constant(std::f64::consts::TAU)],
            Self::Line { from, to } => [S::zero(), apart(*from, *to).norm()],
            Self::Polygon(own) => [S::zero(), S::constant(own.length())],
            Self::Near { at, .. } => [*at, *at],
        }
    }

    /// C, C′, C″ and C‴ at u.
    pub fn derivatives(&self, u: S) -> [Local<S>; 4] {
        match self {
            Self::Formula(formula) => formula.derivatives(u),
            Self::Points(points) => points.derivatives(u),
            Self::Circle { center, radius } => {
                let (sin, cos) = u.sin_cos();
                let arm = Local::new(*radius * cos, *radius * sin);
                let first = arm.perp();
                [Local::new(center.x + arm.x, center.y + arm.y), first, -arm, -first]
            }
            Self::Line { from, to } => {
                let along = apart(*from, *to);
                let direction = along.scale(S::one() / along.norm());
                let here = Local::new(from.x + direction.x * u, from.y + direction.y * u);
                [here, direction, Local::zero(), Local::zero()]
            }
            Self::Polygon(own) => own.derivatives(u),
            Self::Near { at, terms } => taylor(*terms, u - *at),
        }
    }

    /// The values of u at which the curve is not smooth: those at which a condition of a formula changes or a motion
    /// law begins or ends, and the points of a spline whose curvature jumps.
    pub fn breaks(&self) -> Option<Arc<Knots>> {
        match self {
            Self::Formula(formula) => formula.breaks(),
            Self::Points(own) if own.kind == Interpolation::Monotone => {
                let mut knots = own.knots();
                let last = if own.periodic { knots.pop() } else { None };
                let period = last.map(|last| last - knots[0]);
                Some(Arc::new(Knots::new(knots, period)))
            }
            _ => None,
        }
    }

    /// The approximate largest distance from the origin, m.
    pub fn reach(&self) -> S {
        let [a, b] = self.range();
        let share = |k: u32| S::constant(f64::from(k) / 8.0);
        let far = (0..=8).map(|k| self.point(a + share(k) * (b - a)).norm());
        far.fold(S::zero(), |most, r| S::select(r - most, r, most))
    }

    /// C at u.
    pub fn point(&self, u: S) -> Local<S> {
        match self {
            Self::Formula(formula) => formula.point(u),
            other => other.derivatives(u)[0],
        }
    }

    /// C and C′ at u.
    pub fn tangent(&self, u: S) -> [Local<S>; 2] {
        match self {
            Self::Formula(formula) => formula.tangent(u),
            other => {
                let [point, first, ..] = other.derivatives(u);
                [point, first]
            }
        }
    }

    /// The cubic Taylor polynomial of the curve at u. Its derivatives of order 0 to 3 at u equal those of the curve.
    pub fn near(&self, u: S) -> Self {
        Self::Near { at: u, terms: self.derivatives(u) }
    }
}

fn apart<S: Real>(from: Local<S>, to: Local<S>) -> Local<S> {
    Local::new(to.x - from.x, to.y - from.y)
}

/// The derivatives of a cubic at `d` from its derivatives at 0.
fn taylor<S: Real>([c0, c1, c2, c3]: [Local<S>; 4], d: S) -> [Local<S>; 4] {
    let (half, sixth) = (S::constant(0.5), S::constant(1.0 / 6.0));
    let part = |c: fn(&Local<S>) -> S| {
        let [c0, c1, c2, c3] = [c(&c0), c(&c1), c(&c2), c(&c3)];
        let first = c1 + d * (c2 + d * half * c3);
        [c0 + d * (c1 + d * (half * c2 + d * sixth * c3)), first, c2 + d * c3, c3]
    };
    let (x, y) = (part(|s| s.x), part(|s| s.y));
    indexed(|n| Local::new(x[n], y[n]))
}
