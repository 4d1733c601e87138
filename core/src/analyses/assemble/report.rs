//! The report of an assembly.

use super::placement::Dyad;
use crate::equations::kinematics::Motions;
use crate::math::{Local, Motion, Rotation, Vec2};
use crate::model::Model;
use crate::solve::newton::Record;

/// The closure of a dyad, one of two.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// The two bodies.
    pub bodies: [String; 2],
    /// The joint between them.
    pub joint: String,
    /// The joints that carry them.
    pub anchors: [String; 2],
    /// Whether the joint lies to the left of the line from the first to the second anchor. If the second anchor is a
    /// slide: whether the joint lies ahead of the first anchor along the slide.
    pub left: bool,
    /// Whether the second anchor is a slide.
    pub slides: bool,
}

/// The course and the result of an assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Newton's iterations, the start first; residuals relative to the size of the mechanism.
    pub iterations: Vec<Record>,
    /// Degrees of freedom of the model, drivers counted as constraints.
    pub degrees_of_freedom: usize,
    /// The assembly mode: the closure of each dyad.
    pub modes: Vec<Mode>,
    /// Number of other combinations of closures, reachable or not.
    pub alternatives: usize,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// The closures of dyads at a position.
pub(super) fn modes(model: &Model, dyads: &[Dyad], q: &[f64]) -> Vec<Mode> {
    let motions = Motions::at_rest(&model.layout, q);
    let name = |k: usize| model.constraints[k].name.clone();
    let of = |dyad: &Dyad| {
        let [p1, p2] = dyad.anchors.map(|k| point(model, &motions, k));
        let joint = point(model, &motions, dyad.joint);
        let left = if dyad.slides {
            along(model, &motions, dyad.anchors[1]).dot(joint - p1) > 0.0
        } else {
            (p2 - p1).cross(joint - p1) > 0.0
        };
        Mode {
            bodies: dyad.bodies.map(|b| model.bodies[b].name.clone()),
            joint: name(dyad.joint),
            anchors: dyad.anchors.map(name),
            left,
            slides: dyad.slides,
        }
    };
    dyads.iter().filter(|d| d.has_other).map(of).collect()
}

fn point(model: &Model, motions: &[Motion], constraint: usize) -> Vec2 {
    let item = &model.constraints[constraint];
    motions[item.bodies[0].0].pose.point(item.element.attachment(0).s)
}

/// The direction of a slide, of length 1.
fn along(model: &Model, motions: &[Motion], constraint: usize) -> Vec2 {
    let item = &model.constraints[constraint];
    let axis = Rotation::new(item.element.attachment(0).axis);
    motions[item.bodies[0].0].pose.global(Local::new(axis.cos, axis.sin))
}
