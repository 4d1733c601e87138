//! Equations that may be freed in the joints of a redundancy.
//!
//! A dependence Σ y_k Φ_q,k = 0 is a set of constraint forces that balance each other. A joint removes the dependence
//! if it no longer transfers its force. A pin with the factors (y_x, y_y) must leave the direction of this vector
//! free; in any other joint one of the equations that take part must be removed. If the mechanism moves, the
//! direction may turn with one of the two bodies. A slot for the pin then belongs to this body.

use crate::analyses::dependence;
use crate::analyses::mobility::neighbour;
use crate::analyses::Dependent;
use crate::elements::Fixes;
use crate::math::Listed;
use crate::model::Model;
use crate::solve::RANK_TOLERANCE;
use std::f64::consts::PI;
use std::fmt;

/// Directions that differ by less than this angle count as equal, rad.
const SAME: f64 = 1e-7;

/// The equations that may be freed in one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Remedy {
    /// The joint or driver.
    pub joint: String,
    /// Its equations that take part, such as `C.x`.
    pub equations: Vec<String>,
    /// Whether the joint also has other equations.
    pub is_part: bool,
    /// The direction that may be freed, if the joint is a pin.
    pub along: Option<JointDirection>,
}

/// A direction at a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointDirection {
    /// The body with which the direction turns. None if there is no such body; the direction is then valid at this
    /// position.
    pub body: Option<String>,
    /// Angle from the x axis of this body, or of ground, in (-π/2, π/2], rad.
    pub axis: f64,
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(JointDirection { body, axis }) = &self.along else {
            return f.write_str(&self.equations.join(" or "));
        };
        write!(f, "{} along ", self.joint)?;
        let name = match *axis {
            a if a.abs() < SAME => Some("x"),
            a if (a - 0.5 * PI).abs() < SAME => Some("y"),
            _ => None,
        };
        let angle = (axis.to_degrees() * 1e4).round() / 1e4;
        match (body.as_deref(), name) {
            (Some("ground"), Some(name)) => f.write_str(name),
            (Some("ground"), None) => write!(f, "{angle}°"),
            (Some(body), Some(name)) => write!(f, "{name} of {body}"),
            (Some(body), None) => write!(f, "{angle}° of {body}"),
            (None, Some(name)) => write!(f, "{name} in this position"),
            (None, None) => write!(f, "{angle}° in this position"),
        }
    }
}

/// The remedies of each dependence: one for each joint that takes part.
pub fn remedies(model: &Model, t: f64, q: &[f64], all: &[Dependent]) -> Vec<Vec<Remedy>> {
    let near = neighbour(model, t, q, 0, &|| false);
    let there = near.map(|near| {
        let found = dependence::at(model, t, &near, RANK_TOLERANCE, &|| false);
        (near, found)
    });
    let of = |one: &Dependent| {
        let moved = there.as_ref().and_then(|(near, found)| {
            let same = found.iter().find(|other| other.row == one.row)?;
            Some((near.as_slice(), same))
        });
        let here = (q, one);
        let joint = |k: &usize| remedy(model, *k, here, moved, there.is_some());
        one.group.iter().map(joint).list()
    };
    all.iter().map(of).list()
}

/// A position, and a dependence there.
type At<'a> = (&'a [f64], &'a Dependent);

fn remedy(model: &Model, k: usize, here: At<'_>, moved: Option<At<'_>>, moves: bool) -> Remedy {
    let item = &model.constraints[k];
    let rows = model.layout.constraints[k].rows.clone();
    let taking = here.1.factors.iter().filter(|(row, _)| rows.contains(row));
    let along = direction(model, k, here.1).map(|angle| {
        let bodies = [item.bodies[0].0, item.bodies[1].0];
        let ground = bodies.iter().copied().filter(|body| *body == 0);
        let mut candidates = ground.chain(bodies.iter().copied().filter(|body| *body != 0));
        let axis = |(q, _): At<'_>, angle: f64, body: usize| turned(angle - turn(model, q, body));
        let stays = |body: &usize| match moved {
            Some(there) => direction(model, k, there.1).is_some_and(|then| {
                turned(axis(here, angle, *body) - axis(there, then, *body)).abs() < SAME
            }),
            None => !moves,
        };
        match candidates.find(stays) {
            Some(body) => JointDirection {
                body: Some(model.bodies[body].name.clone()),
                axis: axis(here, angle, body),
            },
            None => JointDirection { body: None, axis: turned(angle) },
        }
    });
    let equations = taking.map(|(row, _)| model.equation_name(*row)).list();
    Remedy { joint: item.name.clone(), equations, is_part: rows.len() > 1, along }
}

/// The direction of the force of a pin in a dependence, rad. None for other joints and equations.
fn direction(model: &Model, k: usize, one: &Dependent) -> Option<f64> {
    let item = &model.constraints[k];
    if item.element.fixes() != [Fixes::Points] {
        return None;
    }
    let rows = model.layout.constraints[k].rows.clone();
    let own: Vec<(usize, f64)> =
        one.factors.iter().copied().filter(|(row, _)| rows.contains(row)).list();
    let part = |name: &str| {
        let at = item.equations.iter().position(|equation| equation.name == name)?;
        let factor = own.iter().find(|(row, _)| *row == rows.start + at);
        Some(factor.map_or(0.0, |(_, factor)| *factor))
    };
    let (x, y) = (part("x")?, part("y")?);
    (item.bodies.len() == 2).then(|| y.atan2(x))
}

/// The angle of a body.
fn turn(model: &Model, q: &[f64], body: usize) -> f64 {
    let columns = &model.layout.bodies[body];
    if body > 0 && columns.count == 3 {
        columns.of(q)[2]
    } else {
        0.0
    }
}

/// The angle of a line in (-π/2, π/2].
fn turned(angle: f64) -> f64 {
    let rest = angle.rem_euclid(PI);
    let rest = if rest > 0.5 * PI + SAME { rest - PI } else { rest };
    // rounding errors of a direction along an axis
    [0.0, 0.5 * PI].into_iter().find(|exact| (rest - exact).abs() < SAME).unwrap_or(rest)
}
