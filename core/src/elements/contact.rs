//! Searches along a curve: the nearest contact, and points at which a curve cannot carry a joint.

use super::corner::{jump, Jump};
use super::plane_curve::Curve;
use crate::math::{each, Interpolation, Listed, Local};

/// Number of values of u at which a search begins.
const PLACES: usize = 720;

/// The values of u at which a search begins, from one end to the other. A spline has several values in each piece.
pub(super) fn places(curve: &Curve) -> impl Iterator<Item = f64> {
    let [a, b] = curve.range();
    let count = match curve {
        Curve::Points(own) => PLACES.max(12 * own.points.len()),
        _ => PLACES,
    };
    (0..=count).map(move |k| a + (b - a) * k as f64 / count as f64)
}

/// The u at which `f` has its least value, to about the square root of the machine precision.
pub(super) fn least(curve: &Curve, f: impl Fn(f64) -> f64) -> f64 {
    let finite = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
    let all: Vec<f64> = places(curve).list();
    let values: Vec<f64> = all.iter().map(|u| finite(f(*u))).list();
    let best = (0..all.len()).min_by(|a, b| values[*a].total_cmp(&values[*b])).unwrap_or(0);
    let step = all[1] - all[0];
    let [low, high] = curve.range();
    let (mut a, mut b) = (all[best] - step, all[best] + step);
    if !curve.periodic() {
        (a, b) = (a.max(low), b.min(high));
    }
    // golden-section search: one of the two inner points is kept
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut left, mut right) = (b - ratio * (b - a), a + ratio * (b - a));
    let (mut at_left, mut at_right) = (finite(f(left)), finite(f(right)));
    for _ in 0..60 {
        if at_left < at_right {
            (b, right, at_right) = (right, left, at_left);
            left = b - ratio * (b - a);
            at_left = finite(f(left));
        } else {
            (a, left, at_left) = (left, right, at_right);
            right = a + ratio * (b - a);
            at_right = finite(f(right));
        }
    }
    0.5 * (a + b)
}

/// Curvature of a curve, positive where it turns to the left.
pub(super) fn curvature(terms: &[Local; 4]) -> f64 {
    let [_, first, second, _] = terms;
    first.cross(*second) / first.norm().powi(3)
}

/// "u = 0.3 at (0.1, 0.2) m".
pub(crate) fn place(curve: &Curve, u: f64) -> String {
    let p = curve.point(u);
    let [u, x, y] = each([u, p.x, p.y], |x| (1e6 * x).round() / 1e6 + 0.0);
    format!("u = {u:.6} at ({x:.6}, {y:.6}) m")
}

impl Curve {
    /// Points along the curve for drawings.
    pub fn drawn(&self) -> Vec<Local> {
        let count = match self {
            Self::Polygon(own) => return own.corners(),
            Self::Line { .. } => 1,
            Self::Points(own) => 8 * own.points.len().clamp(20, 200),
            Self::Formula(own) if own.breaks().is_some() => 720, // of pieces, some of which may be short
            _ => 240,
        };
        let [a, b] = self.range();
        let last = count - usize::from(self.periodic()); // the last point of a closed curve is the first
        (0..=last).map(|k| self.point(a + (b - a) * k as f64 / count as f64)).list()
    }

    /// A key of the curve with an impossible value, and the reason.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let [a, b] = match self {
            Self::Points(_) => [0.0, 1.0],
            other => other.range(),
        };
        let finite = |x: &f64| x.is_finite();
        match self {
            Self::Formula(_) if !(finite(&a) && finite(&b) && a < b) => {
                Some(("range", format!("[{a}, {b}]; must increase")))
            }
            Self::Formula(_) => {
                let empty = places(self).find(|u| !self::finite(self.point(*u)));
                let message = |u| {
                    format!("it has no finite value at u = {u:.6}; change its formula or range")
                };
                let open = || self.open_seam(a, b).filter(|_| self.periodic());
                empty.map(|u| ("", message(u))).or_else(open)
            }
            Self::Circle { radius, .. } if !(finite(radius) && *radius > 0.0) => {
                Some(("circle", format!("its radius is {radius} m; must be > 0")))
            }
            Self::Line { .. } if !(finite(&b) && b > 0.0) => {
                Some(("line", "its ends are the same point".to_string()))
            }
            Self::Polygon(own) => own.fault().map(|message| ("polygon", message)),
            Self::Points(own) => {
                let count = own.points.len();
                let pairs = (0..count).map(|k| (k, (k + 1) % count));
                let pairs = pairs.take(if own.periodic { count } else { count - 1 });
                let apart = |(j, k): (usize, usize)| {
                    let (p, q) = (own.points[j], own.points[k]);
                    (p.x - q.x).hypot(p.y - q.y)
                };
                let (j, k) =
                    { pairs }.find(|pair| !(apart(*pair) > 0.0 && apart(*pair).is_finite()))?;
                Some(("points", match k {
                    0 => "the last point repeats the first; a periodic curve closes itself, remove it".to_string(),
                    _ => format!("points {} and {} are the same or not finite", j + 1, k + 1),
                }))
            }
            _ => None,
        }
    }

    /// The fault of a periodic curve that does not close, or whose tangent jumps where it closes.
    fn open_seam(&self, a: f64, b: f64) -> Option<(&'static str, String)> {
        let mut unwound = self.clone();
        if let Self::Formula(formula) = &mut unwound {
            formula.periodic = false;
        }
        let (first, last) = (unwound.derivatives(a), unwound.derivatives(b));
        let size = places(self)
            .map(|u| self.point(u))
            .fold(0.0, |m, p| f64::max(m, p.x.abs().max(p.y.abs())));
        let speed = first[1].norm().max(last[1].norm());
        let differ = |n: usize| (first[n].x - last[n].x).hypot(first[n].y - last[n].y);
        if differ(0) > 1e-9 * size {
            let message = format!(
                "the ends are {:.3e} m apart; a periodic curve must close itself",
                differ(0)
            );
            return Some(("periodic", message));
        }
        (differ(1) > 1e-6 * speed).then(|| {
            let message =
                "the curve has a corner where it closes itself; its derivative must be periodic";
            ("periodic", message.to_string())
        })
    }
}

/// A description of a point at which the curve cannot carry a joint: a cusp with C′ = 0, a jump, a corner, or a point
/// at which C has no value.
pub(super) fn cusp(curve: &Curve) -> Option<String> {
    if curve.fault().is_some() {
        return None; // it is reported at the curve
    }
    if let Curve::Polygon(_) = curve {
        let message = "it is a polygon, which has corners; a contact takes it, a joint needs a curve without corners";
        return Some(message.to_string());
    }
    if let Curve::Points(own) = curve {
        if own.kind == Interpolation::Linear && own.points.len() > 2 {
            let (p, n) = (own.points[1], own.points.len());
            return Some(format!(
                "it has corners at its {n} points, such as ({:.6}, {:.6}) m; join them by quintic or cubic",
                p.x, p.y
            ));
        }
    }
    let speed = |u: f64| curve.derivatives(u)[1].norm();
    let largest = places(curve).map(speed).fold(0.0_f64, |most, x| match x.is_finite() {
        true => most.max(x),
        false => f64::NAN,
    });
    if let Some(u) = places(curve).find(|u| !speed(*u).is_finite() || !finite(curve.point(*u))) {
        return Some(format!("it has no value with a derivative at u = {u:.6}"));
    }
    let size = places(curve).map(|u| curve.point(u).norm()).fold(0.0, f64::max);
    if let Some(Jump { u, order, by }) = jump(curve, [size, largest]) {
        let at = place(curve, u);
        return Some(match order {
            0 => format!("it has a gap of {by:.3e} m for {at}; its parts must meet"),
            _ => format!("it has a corner for {at}: C' jumps by {by:.3e} m; its parts must have one C' there"),
        });
    }
    let slowest = least(curve, speed);
    (speed(slowest) <= 1e-6 * largest).then(|| {
        format!("it has a cusp: |C'| = {:.3e} m for {}", speed(slowest), place(curve, slowest))
    })
}

fn finite(p: Local) -> bool {
    p.x.is_finite() && p.y.is_finite()
}
