//! Reasons for which a motion ends early, in terms of the mechanism.

use super::dead_point::{Limit, IN_LINE};
use super::motion::Motion;
use crate::analyses::mobility::Mobility;
use crate::elements::{BodyId, Group};
use crate::equations::kinematics::Motions;
use crate::math::{Listed, ShortArray, Vec2};
use crate::model::Model;
use std::fmt;

/// A motion that could not be followed to its end, with the part that was computed.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The reason.
    pub reason: Reason,
    /// The motion up to the failure.
    pub motion: Motion,
}

/// The reason for which a motion ended early.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// The drivers do not determine the motion.
    Free {
        /// The number of degrees of freedom that remain.
        degrees_of_freedom: usize,
    },
    /// The shape of a beam, by its name, is not determined by drivers, such as this one.
    Bends(String, Option<String>),
    /// The start does not satisfy the constraints.
    Open {
        /// The time, s.
        t: f64,
        /// The joint or driver.
        name: String,
        /// The gap, m or rad.
        gap: f64,
        /// Its unit.
        unit: &'static str,
    },
    /// The start is beyond a stop or contact with restitution.
    Beyond {
        /// The time, s.
        t: f64,
        /// The stop or contact.
        name: String,
        /// Its gap, m or rad.
        gap: f64,
    },
    /// The velocities are not determined at the start or at a later position.
    Singular {
        /// The time, s.
        t: f64,
        /// A joint or driver whose equations are dependent; empty if none was identified.
        name: String,
        /// Description.
        message: String,
    },
    /// The driven value has reached an extreme.
    Limit(Box<Limit>),
}

impl From<Reason> for Box<Failure> {
    fn from(reason: Reason) -> Self {
        Self::new(Failure { reason, motion: Motion::default() })
    }
}

impl Reason {
    pub(super) fn open(model: &Model, t: f64, row: usize, gap: f64) -> Self {
        let (k, equation) = model.layout.owner(row);
        let item = &model.constraints[k];
        Self::Open { t, name: item.name.clone(), gap, unit: item.equations[equation].kind.unit() }
    }

    pub(super) fn singular_start(model: &Model, t: f64, q: &[f64], freedom: &Mobility) -> Self {
        let group = freedom.singular.iter().chain(&freedom.redundant).next();
        let group = group.cloned().unwrap_or_default();
        let names = model.names_of(&group);
        let line =
            in_line(model, q).map(|[a, b]| format!(": {a} and {b} in line")).unwrap_or_default();
        let message = match names.is_empty() {
            true => format!("the position at the start is singular{line}: it does not determine the velocities"),
            false => format!(
                "the position at the start is singular{line}: {} depend on each other, so that the velocities are not \
                 determined",
                names.join(", ")
            ),
        };
        let name = names.first().map_or_else(String::new, |name| (*name).to_string());
        Self::Singular { t, name, message }
    }
}

/// A position from which the motion cannot be followed.
pub(super) fn lost(model: &Model, t: f64, q: &[f64]) -> Reason {
    let line =
        in_line(model, q).map(|[a, b]| format!(", near a position with {a} and {b} in line"));
    let message = format!(
        "the motion cannot be followed beyond t = {t:.6}{}: the drivers do not determine it there, or a law jumps",
        line.unwrap_or_default()
    );
    Reason::Singular { t, name: String::new(), message }
}

/// Two connected bodies that are in line. Each has exactly two joints and no driver.
fn in_line(model: &Model, q: &[f64]) -> Option<[String; 2]> {
    let motions = Motions::at_rest(&model.layout, q);
    let joints: Vec<(usize, [BodyId; 2])> = model
        .constraints
        .iter()
        .enumerate()
        .filter(|(_, item)| item.group == Group::Joints && item.bodies.len() == 2)
        .map(|(k, item)| (k, [item.bodies[0], item.bodies[1]]))
        .list();
    let place = |k: usize, body: BodyId, side: usize| -> Vec2 {
        motions[body.0].pose.point(model.constraints[k].element.attachment(side).s)
    };
    // the direction of a body with two joints, from the given joint to the other joint
    let direction = |body: BodyId, from: usize| -> Option<Vec2> {
        let own: Vec<_> = joints.iter().filter(|(_, bodies)| bodies.contains(&body)).list();
        if own.len() != 2 || body == BodyId::GROUND {
            return None;
        }
        let ends: Vec<Vec2> =
            own.iter().map(|(k, bodies)| place(*k, body, usize::from(bodies[1] == body))).list();
        let d = ends[1] - ends[0];
        Some(if own[0].0 == from { d } else { -d })
    };
    joints.iter().find_map(|(k, [i, j])| {
        let (a, b) = (direction(*i, *k)?, direction(*j, *k)?);
        let sine = (a.x * b.y - a.y * b.x).abs() / (a.norm() * b.norm());
        let driven = |body: &BodyId| {
            model
                .constraints
                .iter()
                .any(|item| item.group == Group::Drivers && item.bodies.contains(body))
        };
        let line = sine < IN_LINE && !driven(i) && !driven(j);
        line.then(|| [i, j].each(|body| model.bodies[body.0].name.clone()))
    })
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Free { degrees_of_freedom: n } => write!(
                f,
                "the drivers leave {n} degree{} of freedom; a driver is needed for each",
                if *n == 1 { "" } else { "s" }
            ),
            Self::Bends(beam, _) => write!(
                f,
                "drivers do not determine the shape of beam {beam}"
            ),
            Self::Open { t, name, gap, unit } => write!(
                f,
                "the start does not meet the constraints at t = {t:.6}: {name} is open by {:.3e} {unit}",
                gap.abs()
            ),
            Self::Beyond { t, name, gap } => {
                write!(f, "the state is beyond {name} at t = {t:.6}: its gap is {gap:.3e}")
            }
            Self::Singular { message, .. } => f.write_str(message),
            Self::Limit(limit) => limit.fmt(f),
        }
    }
}
