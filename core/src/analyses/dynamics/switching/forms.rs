//! The forms of the functions of switches.

use crate::elements::Behaviour;
use crate::expression::Tape;
use crate::model::{Model, SwitchOwner, Variable};

/// The form of the function of a switch.
pub(super) enum SwitchForm {
    /// A formula in this law.
    Law(Tape),
    /// The opposite of a distance of a force, by its index.
    Clearance(usize, usize),
    /// The sign of the force of a contact with this distance.
    Pushes(usize, usize),
    /// An internal coordinate, by its column.
    Column(usize),
    /// A function of the state without bounds.
    Unknown,
}

impl SwitchForm {
    pub fn of(model: &Model, switch: usize) -> Self {
        let mut found = None;
        let mut look = |tape: &Tape| {
            if tape.switch_range().contains(&switch) {
                found = Some(tape.clone());
            }
        };
        let of_element = match model.switches[switch].owner {
            SwitchOwner::Constraint(k) => {
                let item = &model.constraints[k];
                if let Some(law) = &item.law {
                    law.visit(&mut look);
                }
                match item.curve_switch == Some(switch) {
                    true => Self::Column(model.layout.constraints[k].own.first),
                    false => Self::Unknown,
                }
            }
            SwitchOwner::Force(k) => {
                let item = &model.forces[k];
                if let Some(law) = &item.law {
                    law.visit(&mut look);
                }
                // a contact has two switches: its onset, and the sign of its force; that of its sliding may follow
                let contacts = item.element.clearances().len();
                let behaviour = item.element.behaviour();
                let compliant = matches!(behaviour, Some(Behaviour::Compliant { .. }));
                match switch.checked_sub(item.first_switch) {
                    Some(own) if own % 2 == 0 && own / 2 < contacts => Self::Clearance(k, own / 2),
                    Some(own) if own / 2 < contacts && compliant => Self::Pushes(k, own / 2),
                    _ => Self::Unknown,
                }
            }
        };
        let of_host = |tape: &Tape| {
            tape.variables().any(|k| matches!(Variable::at(k), Variable::Function(_)))
        };
        match found {
            Some(tape) if of_host(&tape) => Self::Unknown,
            Some(tape) => Self::Law(tape),
            None => of_element,
        }
    }
}
