//! Bodies and joints of a model as data.

use super::data::{Body, Curve, Joint, Part, PartForm, Point};
use super::hull::hull;
use crate::numbers::rounded;
use crate::plane::At;
use kempe::elements::{BodyId, Group};
use kempe::math::Local;
use kempe::model::{DrawnForm, Model, BEAM, NODE};

/// A joint with its bodies and its point on each, not rounded.
struct Ends {
    name: String,
    bodies: [usize; 2],
    points: [At; 2],
    /// Whether its point on body j moves, as on a curve.
    moves_on: bool,
}

/// All bodies, ground first.
pub fn bodies(model: &Model) -> Vec<Body> {
    let joints = ends(model);
    (0..model.bodies.len()).map(|number| body(model, &joints, number)).collect()
}

/// All joints, without drivers.
pub fn joints(model: &Model) -> Vec<Joint> {
    let one = |of: Ends| Joint {
        name: of.name,
        bodies: if of.moves_on { [of.bodies[0]; 2] } else { of.bodies },
        points: (if of.moves_on { [of.points[0]; 2] } else { of.points }).map(nine),
    };
    ends(model).into_iter().map(one).collect()
}

/// Converts a point of the core.
pub fn pair(s: &Local) -> At {
    [s.x, s.y]
}

fn nine(at: At) -> At {
    at.map(rounded)
}

fn points(list: &[Local]) -> Vec<At> {
    list.iter().map(|s| nine(pair(s))).collect()
}

fn ends(model: &Model) -> Vec<Ends> {
    let slots = &model.layout.constraints;
    let all = model.constraints.iter().zip(slots);
    all.filter(|(item, _)| item.group == Group::Joints && item.element.in_files())
        .map(|(item, slots)| Ends {
            name: item.name.clone(),
            bodies: first_two(&item.bodies),
            points: [0, 1].map(|end| pair(&item.element.attachment(end).s)),
            moves_on: slots.own.count > 0,
        })
        .collect()
}

/// Bodies i and j. For an element with one body, this body is both i and j.
fn first_two(bodies: &[BodyId]) -> [usize; 2] {
    let number = |body: Option<&BodyId>| body.map_or(0, |body| body.0);
    [number(bodies.first()), number(bodies.get(1).or(bodies.first()))]
}

fn body(model: &Model, joints: &[Ends], number: usize) -> Body {
    let of = &model.bodies[number];
    let form = |form: DrawnForm| match form {
        DrawnForm::Area => PartForm::Area,
        DrawnForm::Rod => PartForm::Rod,
        DrawnForm::Line => PartForm::Line,
    };
    let named = of.points.iter();
    let drawn = of.drawn();
    let curves = of.curves.iter().filter_map(|(_, curve)| curve.as_ref());
    Body {
        name: of.name.clone(),
        number,
        kind: if of.kind.is_empty() { "ground" } else { of.kind }.to_string(),
        points: named.map(|(name, s)| Point { name: name.clone(), at: nine(pair(s)) }).collect(),
        center: nine(pair(&of.center)),
        outline: match of.kind {
            BEAM | NODE => Vec::new(), // its symbols show it
            _ if number == 0 => Vec::new(),
            _ => outline(model, joints, number),
        },
        drawn: drawn
            .iter()
            .map(|part| Part { form: form(part.form), points: points(&part.points) })
            .collect(),
        curves: curves
            .map(|curve| Curve { points: points(&curve.drawn()), closed: curve.periodic() })
            .collect(),
    }
}

/// The corners in the frame of the body: 1 (a spot), 2 (the ends of a line) or a convex polygon.
///
/// A slender bar extends from end to end; its length is √(12 J/m). The outline of every body contains its named
/// points and the points of its joints. The outline of a general body also contains its mass centre.
fn outline(model: &Model, joints: &[Ends], number: usize) -> Vec<At> {
    let of = &model.bodies[number];
    let mut corners: Vec<At> = of.points.iter().map(|(_, s)| pair(s)).collect();
    for joint in joints {
        if joint.bodies[0] == number {
            corners.push(joint.points[0]);
        }
        if joint.bodies[1] == number && !joint.moves_on {
            corners.push(joint.points[1]);
        }
    }
    if of.kind == "bar" && of.mass > 0.0 {
        let half = (12.0 * of.inertia / of.mass).sqrt() / 2.0;
        corners.extend([[-half, 0.0], [half, 0.0]]);
    } else {
        corners.push(pair(&of.center));
    }
    hull(corners).into_iter().map(nine).collect()
}
