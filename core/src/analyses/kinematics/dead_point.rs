//! Dead points: positions that a driven value cannot pass, in terms of the mechanism.

use super::solution::Point;
use crate::analyses::assemble::trimmed;
use crate::elements::{At, Attachment, BodyId, Coordinate, Fixes, Followed, Group, QuantityKind};
use crate::equations::held;
use crate::equations::kinematics::Motions;
use crate::math::{Listed, Local, Rotation, ShortArray, Vec2};
use crate::model::{column_scales, ConstraintItem, Dependence, Model};
use std::fmt;

/// Largest sine of the angle between two bodies in line, and largest cosine between a body and a slide at right
/// angles.
pub(super) const IN_LINE: f64 = 1e-3;
/// Speed below which a point counts as at rest, relative to the largest rate of the mechanism.
const AT_REST: f64 = 1e-4;
/// Significant digits of a printed value.
const DIGITS: usize = 7;

/// An extreme of the driven value.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The time, or the value that replaces it.
    pub t: f64,
    /// The position, shape (n_q).
    pub q: Vec<f64>,
    /// The driver that cannot move further.
    pub driver: String,
    /// The driven quantity, such as `crank` for the angle of this body, or `slide.displacement`.
    pub driven: String,
    /// The value of the driven quantity, m or rad; otherwise the time, s.
    pub value: f64,
    /// A length or an angle; None for the time.
    pub kind: Option<QuantityKind>,
    /// Two bodies that are in line there, if any.
    pub in_line: Option<[String; 2]>,
    /// A body and a slide at right angles to each other, if any.
    pub across: Option<[String; 2]>,
    /// What is reached if it is not a dead point: a stop, a contact with restitution, or the end of a curve.
    pub reached: Option<String>,
}

impl Limit {
    /// The limit at a position. `rates`, shape (n_q), are the derivatives of q by the arc length of the path.
    pub(super) fn new(model: &Model, t: f64, q: Vec<f64>, rates: &[f64]) -> Self {
        let motions = Motions::at(&model.layout, &q, rates);
        let item = driver(model);
        let (driven, kind) = driven(model);
        let moving = LockedDriver { model, motions: &motions, least: least(model, rates) };
        Self {
            t,
            driver: item.map(|item| item.name.clone()).unwrap_or_default(),
            driven,
            value: item.map_or(t, |item| value(model, item, &motions, t)),
            kind,
            in_line: moving.in_line(),
            across: moving.across(),
            reached: None,
            q,
        }
    }

    /// The limit at which the motion through a position reaches something.
    pub(super) fn of_barrier(model: &Model, from: &Point, reached: String) -> Self {
        let limit = Self::new(model, from.t, from.q.clone(), &from.v);
        Self { in_line: None, across: None, reached: Some(reached), ..limit }
    }
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} cannot pass {}: ", self.driven, written(self.value, self.kind))?;
        if let Some(reached) = &self.reached {
            return f.write_str(reached);
        }
        write!(f, "dead point")?;
        match (&self.in_line, &self.across) {
            (Some([a, b]), _) => write!(f, ", {a} and {b} in line"),
            (None, Some([a, b])) => write!(f, ", {a} at right angles to {b}"),
            (None, None) => Ok(()),
        }
    }
}

/// Two bodies that are in line at a position where the mechanism moves with `rates`, shape (n_q), while some of its
/// pins are at rest.
pub(in crate::analyses) fn in_line(model: &Model, q: &[f64], rates: &[f64]) -> Option<[String; 2]> {
    let motions = Motions::at(&model.layout, q, rates);
    LockedDriver { model, motions: &motions, least: least(model, rates) }.in_line()
}

/// A value with its unit, angles in degrees.
pub(in crate::analyses) fn written(value: f64, kind: Option<QuantityKind>) -> String {
    match kind {
        Some(QuantityKind::Angle) => format!("{}°", trimmed(value.to_degrees(), DIGITS)),
        Some(kind) => kind.with_unit(&trimmed(value, DIGITS)),
        None => format!("{} s", trimmed(value, DIGITS)),
    }
}

/// The driver of a model that moves, or another one, or the joint with a law of time.
fn driver(model: &Model) -> Option<&ConstraintItem> {
    let items = model.constraints.iter().filter(|item| item.driven);
    items.max_by_key(|item| {
        let mut depends = Dependence::default();
        if let Some(law) = &item.law {
            law.visit(&mut |tape| depends.add(tape));
        }
        (item.group == Group::Drivers, depends.time)
    })
}

/// Name and kind of the driven value: `crank` for the angle of this body, otherwise `slide.displacement`. A joint with
/// a law of time drives the first quantity that can be measured on it, or only the time.
pub(in crate::analyses) fn driven(model: &Model) -> (String, Option<QuantityKind>) {
    let Some(item) = driver(model) else { return (String::new(), None) };
    let measured = item.element.measured().first().map(|of| of.kind);
    let kind = item.element.drives().map(Followed::kind).or(measured);
    let name = match item.element.drives() {
        None => item.name.clone(),
        Some(Followed::Quantity(of)) => of.name.clone(),
        Some(Followed::Coordinate(of)) => {
            let body = &model.bodies[of.body.0].name;
            match of.coordinate {
                Coordinate::Angle => body.clone(),
                other => format!("{body}.{}", other.name()),
            }
        }
    };
    (name, kind)
}

/// The driven value at a position.
fn value(model: &Model, item: &ConstraintItem, motions: &Motions, t: f64) -> f64 {
    let values = held(&model.parameters, motions, &[], t);
    let element = match &item.law {
        Some(law) => law.map(&mut |tape| tape.evaluate(&values)),
        None => item.element.clone(),
    };
    match element.drives() {
        Some(of) => {
            let [i, j] = of.bodies().each(|body| motions[body.0].pose);
            of.value(&i, &j)
        }
        None => {
            let bodies = item.bodies.iter().map(|body| motions[body.0].pose).list();
            let mut values = vec![t; element.measured().len().max(1)];
            element.measure(&At { bodies: &bodies, own: &[], t }, &mut values);
            values[0]
        }
    }
}

/// The speed above which a point counts as moving.
fn least(model: &Model, rates: &[f64]) -> f64 {
    let scales = column_scales(model);
    let speeds = rates.iter().zip(&scales).map(|(v, scale)| v.abs() / scale);
    AT_REST * speeds.fold(0.0, f64::max) * crate::model::size(model)
}

/// A mechanism that moves while its driver is at rest.
struct LockedDriver<'m> {
    model: &'m Model,
    motions: &'m Motions,
    least: f64,
}

impl LockedDriver<'_> {
    /// The index and the two bodies of each joint that fixes points but no direction.
    fn pins(&self) -> impl Iterator<Item = (usize, [BodyId; 2])> + '_ {
        let joints = self.model.constraints.iter().enumerate();
        joints
            .filter(|(_, item)| item.group == Group::Joints && item.bodies.len() == 2)
            .filter(|(_, item)| {
                let fixes = item.element.fixes();
                fixes.contains(&Fixes::Points) && !fixes.contains(&Fixes::Direction)
            })
            .map(|(k, item)| (k, [item.bodies[0], item.bodies[1]]))
    }

    fn place(&self, k: usize, side: usize) -> (Vec2, Vec2) {
        let item = &self.model.constraints[k];
        let motion = &self.motions[item.bodies[side].0];
        let Attachment { s, .. } = item.element.attachment(side);
        let arm = motion.pose.global(s);
        (motion.pose.point(s), motion.twist.velocity + arm.perp().scale(motion.twist.omega))
    }

    fn moves(&self, k: usize, side: usize) -> bool {
        self.place(k, side).1.norm() > self.least
    }

    /// The direction from joint `from` to another pin of a body that is at rest.
    fn towards_rest(&self, body: BodyId, from: (usize, usize)) -> Option<Vec2> {
        let resting = self.pins().filter(|(k, _)| *k != from.0).find_map(|(k, bodies)| {
            let side = bodies.iter().position(|b| *b == body)?;
            (!self.moves(k, side)).then(|| self.place(k, side).0)
        })?;
        (!body.is_ground()).then(|| resting - self.place(from.0, from.1).0)
    }

    /// Two bodies with a moving joint between them, each with a pin at rest.
    fn in_line(&self) -> Option<[String; 2]> {
        self.pins().filter(|(k, _)| self.moves(*k, 0)).find_map(|(k, [i, j])| {
            let (a, b) = (self.towards_rest(i, (k, 0))?, self.towards_rest(j, (k, 1))?);
            let sine = a.cross(b).abs() / (a.norm() * b.norm());
            (sine < IN_LINE).then(|| [i, j].each(|body| self.model.bodies[body.0].name.clone()))
        })
    }

    /// A body with a pin at rest, and a slide along which its other pin moves.
    fn across(&self) -> Option<[String; 2]> {
        self.pins().filter(|(k, _)| self.moves(*k, 0)).find_map(|(k, bodies)| {
            (0..2).find_map(|side| {
                let (link, carried) = (bodies[side], bodies[1 - side]);
                let arm = self.towards_rest(link, (k, side))?;
                let slide = self.model.constraints.iter().find(|item| {
                    let fixes = item.element.fixes();
                    item.bodies.contains(&carried)
                        && fixes.contains(&Fixes::Line)
                        && fixes.contains(&Fixes::Direction)
                })?;
                let axis = Rotation::new(slide.element.attachment(0).axis);
                let along = Local::new(axis.cos, axis.sin);
                let along = self.motions[slide.bodies[0].0].pose.global(along);
                let cosine = arm.dot(along).abs() / arm.norm();
                let link = self.model.bodies[link.0].name.clone();
                (cosine < IN_LINE).then(|| [link, slide.name.clone()])
            })
        })
    }
}
