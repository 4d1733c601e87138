//! Circles that rest on one curve at two feet.
//!
//! A contact has one foot, the point of the curve nearest to the circle. While the circle rests, the foot moves along
//! the curve. In a valley that is sharper than the circle, the circle arrives at a second foot, and the nearest point
//! jumps from one flank to the other. One force cannot hold it there, and the run ends.

use super::failure::{Failure, Reason};
use crate::elements::{contact, Clearance, Curve, CurveOn, Rim};
use crate::equations::kinematics::Motions;
use crate::math::{each, Listed, Local, ShortArray};
use crate::model::{ForceItem, Model};

/// Distance of a second foot, relative to the radius, up to which the circle touches it; and up to which a step may
/// have passed beyond both feet.
const TOUCHES: f64 = 1.0 + 1e-6;
const PASSED: f64 = 1.01;

/// The foot of each circle that rests on a curve, by the index of its force. None where the circle is apart.
pub(super) struct Feet(Vec<(usize, Option<f64>)>);

impl Feet {
    /// The feet at the start of a phase.
    pub fn of(model: &Model, q: &[f64]) -> Self {
        let circles = (0..model.forces.len()).filter(|k| circle(&model.forces[*k]).is_some());
        Self(circles.map(|k| (k, foot(model, k, q).map(|(u, _)| u))).list())
    }

    /// The failure of a contact with a second foot, or whose foot has jumped since the last look.
    pub fn look(&mut self, model: &Model, t: f64, q: &[f64]) -> Option<Box<Failure>> {
        self.0.iter_mut().find_map(|(k, last)| {
            let before = *last;
            let now = foot(model, *k, q);
            *last = now.map(|(u, _)| u);
            let ((u, p), before) = (now?, before?);
            let (rim, radius) = circle(&model.forces[*k])?;
            let [other, middle] = rim.other_foot(p, u, (before, TOUCHES * radius))?;
            let touches = (p - rim.on.curve.point(other)).norm() <= PASSED * radius;
            touches.then(|| wedged(model, t, *k, ([u, other], middle)))
        })
    }
}

/// The curve and radius of a circle on a curve that is searched.
fn circle(item: &ForceItem) -> Option<(&Rim, f64)> {
    match item.element.clearances()[..] {
        [Clearance::Curve { curve, radius, .. }] if radius > 0.0 && item.law.is_none() => {
            (!curve.is_closed_form() && curve.mate.is_none()).then_some((curve, radius))
        }
        _ => None,
    }
}

/// The foot of a circle that rests on its curve, and its centre in the frame of the curve.
fn foot(model: &Model, force: usize, q: &[f64]) -> Option<(f64, Local)> {
    let item = &model.forces[force];
    let [Clearance::Curve { i, curve, .. }] = item.element.clearances()[..] else {
        return None;
    };
    if !item.mode.holds() {
        return None;
    }
    let motions = Motions::at_rest(&model.layout, q);
    let [moving, frame] = each([0, 1], |k| motions[item.bodies[k].0].pose);
    let p = frame.rotation.inverse(moving.point(i.s) - frame.r);
    curve.foot(p).map(|u| (u, p))
}

fn wedged(model: &Model, t: f64, force: usize, (u, middle): ([f64; 2], f64)) -> Box<Failure> {
    let item = &model.forces[force];
    let (rim, _) = circle(item).expect("it has a circle");
    let CurveOn { body, curve } = &rim.on;
    let points = u.each(|u| curve.point(u));
    let same = |of: &Curve| u.each(|u| of.point(u)) == points;
    let body = &model.bodies[body.0];
    let own = body.curves.iter().find(|(_, of)| of.as_ref().is_some_and(same));
    let name = own.map_or(String::new(), |(name, _)| format!(" {}.{name}", body.name));
    let [one, other] = u.each(|u| contact::place(curve, u));
    let message = format!(
        "the circle of {} touches the curve{name} at two feet at t = {t:.6} s, {one} and {other}, but a contact has one \
         foot; between them, the curve is farthest at u = {middle:.6}",
        item.name
    );
    let hint = "divide the curve there into two curves, by their ranges or points, and give each of them a contact";
    Reason::Integration { t, message, hint }.into()
}
