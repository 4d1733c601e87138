//! The friction of joints that may slip. It is a force, because it slides and sticks.

use super::quantities::Quantities;
use crate::elements::forces::SlipFriction;
use crate::elements::{Constraint, ForceElement, JointId, Measured, Slips};
use crate::expression::Tape;

/// The friction of a joint. None if it cannot slip.
pub(super) fn friction_of(
    (joint, name, element): (JointId, &str, &Constraint<Tape>),
    quantities: &dyn Quantities,
) -> Option<ForceElement<Tape>> {
    let Slips { kinetic, r#static } = element.slips()?;
    let coordinate = quantities.acted(&format!("{name}.{}", Measured::SLIP.names[0]))?;
    Some(ForceElement::SlipFriction(SlipFriction { joint, coordinate, kinetic, r#static }))
}
