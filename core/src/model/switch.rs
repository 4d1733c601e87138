//! The switches of a model: where laws and forces are not smooth.

use crate::expression::{Boundaries, Knots, Tape};
use std::sync::Arc;

/// The element to which a switch belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SwitchOwner {
    /// A joint or driver, by its index.
    Constraint(usize),
    /// A force, by its index.
    Force(usize),
}

/// A switch of a law, or of a force itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Switch {
    /// Its element.
    pub owner: SwitchOwner,
    /// The boundaries of its pieces.
    pub boundaries: Boundaries,
    /// Whether its function depends on time.
    pub time: bool,
    /// Whether its function depends on the state.
    pub state: bool,
    /// Whether it belongs to a law rather than to the element itself.
    pub law: bool,
    /// Whether the law is C² there. Steps then end at the switch only if it depends on time alone.
    pub smooth: bool,
}

impl Switch {
    /// The switch of an element itself. It may depend on time and state.
    pub(super) fn of_element(owner: SwitchOwner) -> Self {
        Self {
            owner,
            boundaries: Boundaries::Zero,
            time: true,
            state: true,
            law: false,
            smooth: false,
        }
    }

    /// The switch at the breaks of the curve of a joint.
    pub(super) fn of_curve(owner: SwitchOwner, breaks: Arc<Knots>) -> Self {
        let boundaries = Boundaries::Knots(breaks);
        Self { owner, boundaries, time: false, state: true, law: false, smooth: false }
    }

    /// Adds the switches of a law to the list; returns the law with their indices.
    pub(super) fn number(tape: &Tape, owner: SwitchOwner, switches: &mut Vec<Self>) -> Tape {
        let numbered = tape.with_first_switch(switches.len());
        switches.extend(tape.switches().into_iter().map(|switch| {
            let crate::expression::FormulaSwitch { boundaries, time, state, smooth, .. } = switch;
            Self { owner, boundaries, time, state, law: true, smooth }
        }));
        numbered
    }
}
