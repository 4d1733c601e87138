//! The functions whose zeros may change the mode of a force. Each is positive while the mode lasts.

use super::place::drivers_rest;
use crate::analyses::signals::Seen;
use crate::elements::{Behaviour, Mode};
use crate::equations::{forces, leading};
use crate::integrate::{Bounds, Direction};
use crate::math::Real;
use crate::model::{DriverSet, Model};

/// The place of the event at which a contact is passed within the error of a step.
pub const GRAZE: usize = 2;
/// The place of the event at which a sequence of impacts without end is replaced by its limit.
pub const COLLAPSE: usize = 3;
/// The place of the event at which an impact without collision ends the sliding.
pub const PARADOX: usize = 4;

/// A function of a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeFunction {
    /// Sliding speed or gap, times a sign, and the slack of the mode.
    Threshold {
        /// The force.
        force: usize,
        /// ±1.
        sign: f64,
        /// Added to the function.
        slack: f64,
        /// The function is negative where these drivers stand still.
        held_by: DriverSet,
    },
    /// The reserve until friction slips, a contact separates or friction can no longer lead others, and the slack of the
    /// mode.
    Reserve {
        /// The force.
        force: usize,
        /// Added to the reserve.
        slack: f64,
    },
    /// In a joint that drivers hold, friction begins to slide at a certain speed. The function is this speed minus
    /// the actual speed.
    Begins {
        /// The force.
        force: usize,
        /// This speed.
        at: f64,
        /// It cannot begin while these drivers stand still.
        held_by: DriverSet,
    },
    /// The mode does not end by itself.
    Never,
}

impl ModeFunction {
    /// Whether the function needs multipliers.
    pub fn needs_solution(self) -> bool {
        matches!(self, Self::Reserve { .. })
    }

    /// Bounds of the function in a part of a step, given those of the distances of forces. None if they are not known.
    pub fn bounds(self, clearance: &mut dyn FnMut(usize) -> Option<Bounds>) -> Option<Bounds> {
        let constant = Bounds::constant;
        match self {
            Self::Threshold { force, sign, slack, held_by } if held_by.is_empty() => {
                Some(constant(sign) * clearance(force)? + constant(slack))
            }
            Self::Never => Some(Bounds::one()),
            Self::Threshold { .. } | Self::Reserve { .. } | Self::Begins { .. } => None,
        }
    }

    /// The value of the function at a state.
    pub fn value(self, model: &Model, seen: &Seen<'_>) -> f64 {
        let rests = |drivers| drivers_rest(model, drivers, seen.t, seen.state[0]);
        match self {
            Self::Threshold { held_by, .. } if rests(held_by) => -1.0,
            Self::Begins { at, held_by, .. } if rests(held_by) => at,
            _ => self.while_moving(model, seen),
        }
    }

    /// The value of the function at a state in which no drivers stand still.
    pub fn while_moving<S: Real>(self, model: &Model<S>, seen: &Seen<'_, S>) -> S {
        let acting = seen.acting();
        let threshold = |force: usize| forces::threshold(model, force, seen.motions, acting);
        match self {
            Self::Threshold { force, sign, slack, .. } => {
                S::constant(sign) * threshold(force) + S::constant(slack)
            }
            Self::Reserve { force, slack } => {
                let own = forces::reserve(model, force, seen.motions, acting);
                if let Mode::Carries(_) = model.forces[force].mode {
                    return own.min(S::constant(slack) - threshold(force).abs());
                }
                let own = own + S::constant(slack);
                let lead = leading::lead(model, force, seen.motions, acting, slack);
                lead.map_or(own, |lead| own.min(lead))
            }
            Self::Begins { force, at, .. } => S::constant(at) - threshold(force).abs(),
            Self::Never => S::constant(1.0),
        }
    }

    /// Whether drivers that stand still decide its value.
    pub fn is_held(self) -> bool {
        match self {
            Self::Threshold { held_by, .. } | Self::Begins { held_by, .. } => !held_by.is_empty(),
            Self::Reserve { .. } | Self::Never => false,
        }
    }
}

/// The function of an event of a force, and the direction of its zero. `place` is the index of the event in
/// [`Behaviour::events`]. The modes are read from the model.
pub fn watched_mode(model: &Model, force: usize, place: usize) -> (ModeFunction, Direction) {
    let item = &model.forces[force];
    // whether a compliant contact whose friction has modes is closed
    let rubs = item.partner.map(|of| model.forces[of].mode).filter(|of| *of != Mode::Open);
    let closed = rubs.map(|mode| mode != Mode::Free);
    let compliant = matches!(item.element.behaviour(), Some(Behaviour::Compliant { .. }));
    // the slack of a compliant contact that is open is that of its friction, because it has no mode of its own
    let named = item.partner.filter(|_| compliant && closed == Some(false)).unwrap_or(force);
    let own = model.blueprint.modes.iter().find(|of| of.force == named);
    let (slack, held_by) = own.map(|of| (of.slack, of.held_by)).unwrap_or_default();
    let threshold = |sign: f64| ModeFunction::Threshold { force, sign, slack, held_by };
    let (gap, falling) = (threshold(1.0), Direction::Falling);
    let reserve = ModeFunction::Reserve { force, slack };
    match (item.element.behaviour(), item.mode, place) {
        (Some(Behaviour::Compliant { .. }), _, 0) if closed == Some(true) => {
            (ModeFunction::Never, falling)
        }
        (Some(Behaviour::Compliant { .. }), _, 1) if closed == Some(true) => {
            (threshold(-1.0), falling)
        }
        (Some(Behaviour::Compliant { .. }), _, 1) if closed == Some(false) => {
            (ModeFunction::Never, falling)
        }
        (Some(Behaviour::Compliant { .. }), _, 0) => (gap, falling),
        (Some(Behaviour::Compliant { .. }), _, 1) => (gap, Direction::Rising),
        (Some(Behaviour::Compliant { .. }), _, GRAZE) => (gap, falling),
        (Some(Behaviour::Sticks), Mode::Slides(sign), 0) => (threshold(sign), falling),
        (Some(Behaviour::Impacts { .. }), Mode::Free, 0 | GRAZE) => (gap, falling),
        // the others that hold it may move apart or together
        (Some(Behaviour::Impacts { .. }), Mode::Idle, 0) => (gap, falling),
        (Some(Behaviour::Impacts { .. }), Mode::Idle, 1) => (threshold(-1.0), falling),
        (Some(_), Mode::Holds(_), 1) | (_, Mode::Carries(_), 1) => (reserve, falling),
        (Some(Behaviour::Sticks), Mode::Idle | Mode::Follows { .. }, 1) => {
            (ModeFunction::Begins { force, at: slack, held_by }, falling)
        }
        _ => (ModeFunction::Never, falling),
    }
}
