//! The report of an assembly.

use super::placement::Dyad;
use super::placer::ON_LINE;
use super::unset::Unset;
use crate::analyses::Mobility;
use crate::equations::kinematics::Motions;
use crate::math::{each, Listed, Local, Motion, Rotation, ShortArray, Vec2};
use crate::model::{listed, Doubt, Model, MOST_REPORTED};
use crate::solve::newton::Record;

/// One of the two closures of a dyad or of two rods.
#[derive(Clone, Debug, PartialEq)]
pub struct DyadMode {
    /// The two bodies, or the body that two rods hold.
    pub bodies: Vec<String>,
    /// The joint between them, or the body that two rods hold.
    pub joint: String,
    /// The joints that carry them.
    pub anchors: [String; 2],
    /// Whether the joint lies to the left of the line from the first to the second anchor. If the second anchor is a
    /// slide, whether the joint lies ahead of the first anchor along the slide.
    pub left: bool,
    /// Whether the second anchor is a slide.
    pub slides: bool,
    /// Whether the loop is folded: the joint and the pin between the bodies that carry the dyad lie on the same side of
    /// the line between the anchors. None if there is no such pin, or if it lies on this line.
    pub folded: Option<bool>,
}

/// The course and the result of an assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Iterations of Newton's method, beginning with the start. Residuals are relative to the size of the mechanism.
    pub iterations: Vec<Record>,
    /// Degrees of freedom of the model, drivers counted as constraints.
    pub degrees_of_freedom: usize,
    /// The assembly mode: the closure of each dyad.
    pub modes: Vec<DyadMode>,
    /// Number of other combinations of closures, reachable or not; None if it is too large for the type.
    pub alternatives: Option<usize>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
    /// The coordinates and rates that were not set.
    pub unset: Unset,
}

/// The closures of dyads at a position.
pub(super) fn modes(model: &Model, dyads: &[Dyad], q: &[f64]) -> Vec<DyadMode> {
    let motions = Motions::at_rest(&model.layout, q);
    let name = |k: usize| model.constraints[k].name.clone();
    let of = |dyad: &Dyad| {
        let [first, second] = dyad.bodies;
        let body = |b: usize| model.bodies[b].name.clone();
        if first == second {
            return on_rods(
                dyad,
                body(first),
                [&name(dyad.anchors[0]), &name(dyad.anchors[1])],
                (model, &motions),
            );
        }
        let [p1, p2] = dyad.anchors.each(|k| point(model, &motions, k));
        let joint = point(model, &motions, dyad.joint);
        let left = if dyad.slides {
            along(model, &motions, dyad.anchors[1]).dot(joint - p1) > 0.0
        } else {
            (p2 - p1).cross(joint - p1) > 0.0
        };
        let side = |at: Vec2| (p2 - p1).cross(at - p1);
        let pin = dyad.opposite.map(|k| side(point(model, &motions, k)));
        let pin = pin.filter(|side| side.abs() > ON_LINE * (p2 - p1).dot(p2 - p1));
        DyadMode {
            bodies: dyad.bodies.each(body).to_vec(),
            joint: name(dyad.joint),
            anchors: dyad.anchors.each(name),
            left,
            slides: dyad.slides,
            folded: pin.map(|pin| pin * side(joint) > 0.0),
        }
    };
    dyads.iter().filter(|d| d.has_other).map(of).list()
}

/// The side of a body on two rods, relative to the line between the far ends after both near ends are moved to one
/// point.
fn on_rods(
    dyad: &Dyad,
    body: String,
    rods: [&str; 2],
    (model, motions): (&Model, &[Motion]),
) -> DyadMode {
    let ends = dyad.anchors.each(|k| {
        let item = &model.constraints[k];
        let own = usize::from(item.bodies[1].0 == dyad.bodies[0]);
        each([own, 1 - own], |end| {
            motions[item.bodies[end].0].pose.point(item.element.attachment(end).s)
        })
    });
    let [first, second] = ends.each(|[own, far]| own - far);
    DyadMode {
        bodies: vec![body.clone()],
        joint: body,
        anchors: rods.each(str::to_string),
        left: (first - second).cross(first) > 0.0,
        slides: false,
        folded: None,
    }
}

/// A warning for each dyad without a deciding guess whose unfolded closure did not lead to an assembly.
pub(super) fn folded(model: &Model, dyads: &[Dyad]) -> Vec<String> {
    let second = dyads.iter().filter(|dyad| dyad.second && dyad.opposite.is_some());
    let joints: Vec<&str> = second.map(|d| model.constraints[d.joint].name.as_str()).list();
    match joints.is_empty() {
        true => Vec::new(),
        false => vec![format!(
            "folded at {}: the unfolded placement does not close; a guess of an angle decides the side",
            listed(&joints)
        )],
    }
}

/// A warning for each group of constraints that depend on each other only at this position.
pub(super) fn singular(model: &Model, groups: &[Vec<usize>]) -> Vec<String> {
    let one = |group: &Vec<usize>| {
        let names = listed(&model.names_of(group));
        format!("this is a singular position: the constraints {names} depend on each other here")
    };
    let mut warnings: Vec<String> = groups.iter().take(MOST_REPORTED).map(one).list();
    if groups.len() > MOST_REPORTED {
        let more = groups.len() - MOST_REPORTED;
        warnings.push(format!("{more} more groups of constraints depend on each other here"));
    }
    warnings
}

/// A remark if equations hold only to second order.
pub(super) fn second_order(model: &Model, mobility: &Mobility) -> Option<String> {
    let all = mobility.second_order.iter().flat_map(|one| &one.group);
    let mut places: Vec<usize> = all.copied().list();
    places.sort_unstable();
    places.dedup();
    let kept: Vec<&str> = mobility.kept.iter().map(String::as_str).list();
    let (names, kept) = (listed(&model.names_of(&places)), listed(&kept));
    (!places.is_empty()).then(|| {
        format!(
            "{names} depend on each other in every position: they keep {kept} constant, but only to second order; the \
             mechanism moves as if this constraint were written, and the forces of these joints are not unique"
        )
    })
}

/// A warning for angles that look like degrees.
pub(super) fn degrees(model: &Model, given: &[Doubt]) -> Option<String> {
    let mut all: Vec<&Doubt> = given.iter().list();
    let known = |all: &[&Doubt], doubt: &Doubt| all.iter().any(|one| one.place == doubt.place);
    for doubt in &model.blueprint.doubts {
        if !known(&all, doubt) {
            all.push(doubt);
        }
    }
    let first = all.first()?;
    let written: Vec<String> =
        all.iter().map(|doubt| format!("{} = {}", doubt.place, doubt.value)).list();
    let written = listed(&written.iter().map(String::as_str).list());
    let (looks, others) = if all.len() == 1 { ("looks", "") } else { ("look", ", and so on") };
    Some(format!(
        "{written} {looks} like degrees, but a number without a unit is in rad; for degrees, write \"{} deg\"{others}",
        first.value
    ))
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
