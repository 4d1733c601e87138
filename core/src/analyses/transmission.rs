//! The transmission angle at a pin between a coupler and an output link: the angle between their lines (Alt, 1932;
//! Norton, *Design of Machinery*, section 3.3). The line of a link goes from this pin to its other pin. If a slide
//! guides the link, its line is the normal of the slide.

use crate::elements::{BodyId, Fixes, Group};
use crate::math::Listed;
use crate::model::{ConstraintItem, Model};
use std::f64::consts::FRAC_PI_2;

/// Whether a joint only holds two points together.
fn is_pin(item: &ConstraintItem) -> bool {
    joins(item) && item.element.fixes() == [Fixes::Points]
}

/// Whether a joint is a straight slide that prevents rotation.
fn is_slide(item: &ConstraintItem) -> bool {
    joins(item) && item.element.fixes() == [Fixes::Line, Fixes::Direction]
}

fn joins(item: &ConstraintItem) -> bool {
    item.group == Group::Joints && item.bodies.len() == 2
}

/// The pins and slides of a body except one joint.
pub fn others_at(model: &Model, joint: usize, body: BodyId) -> Vec<usize> {
    let holds =
        |item: &ConstraintItem| item.bodies.contains(&body) && (is_pin(item) || is_slide(item));
    let all = model.constraints.iter().enumerate();
    all.filter(|(k, item)| *k != joint && holds(item)).map(|(k, _)| k).list()
}

/// The direction of the line of a link from a pin, in the frame of the link, rad. None unless the link has exactly
/// one other pin or slide.
pub fn line_at(model: &Model, joint: usize, body: BodyId) -> Option<f64> {
    let others = others_at(model, joint, body);
    let [other] = others[..] else { return None };
    let (here, other) = (&model.constraints[joint], &model.constraints[other]);
    let on = |item: &ConstraintItem| {
        let side = item.bodies.iter().position(|one| *one == body);
        side.map(|side| item.element.attachment(side))
    };
    let (from, to) = (on(here)?, on(other)?);
    let along = to.s - from.s;
    Some(if is_slide(other) { to.axis + FRAC_PI_2 } else { along.y.atan2(along.x) })
}

/// The transmission angle at a pin as an expression of quantities, in rad from 0 to π. None unless the joint is a pin
/// and the lines of both links are unique.
pub fn transmission_angle(model: &Model, joint: usize) -> Option<String> {
    let item = &model.constraints[joint];
    let turns = item.bodies.iter().all(|body| model.bodies[body.0].turns || body.is_ground());
    if !is_pin(item) || !turns {
        return None;
    }
    let turn = |side: usize| Some((item.bodies[side], line_at(model, joint, item.bodies[side])?));
    let ((i, at_i), (j, at_j)) = (turn(0)?, turn(1)?);
    let name = |body: BodyId| &model.bodies[body.0].name;
    let between = format!("{}.angle - {}.angle + ({:?})", name(j), name(i), at_j - at_i);
    Some(format!("atan2(abs(sin({between})), cos({between}))"))
}

/// The pins at which another link moves a link that ground guides and that has no driver.
pub fn transmitting(model: &Model) -> Vec<usize> {
    let drivers = model.constraints.iter().filter(|item| item.group == Group::Drivers);
    let driven: Vec<BodyId> = drivers.flat_map(|item| item.bodies.iter().copied()).list();
    let is_output = |joint: usize, body: &BodyId| {
        let others = others_at(model, joint, *body);
        let guided = others.iter().any(|k| model.constraints[*k].bodies.contains(&BodyId::GROUND));
        !body.is_ground() && !driven.contains(body) && guided
    };
    let transmits = |joint: &usize| {
        let bodies = &model.constraints[*joint].bodies;
        transmission_angle(model, *joint).is_some() && bodies.iter().any(|b| is_output(*joint, b))
    };
    (0..model.constraints.len()).filter(transmits).list()
}
