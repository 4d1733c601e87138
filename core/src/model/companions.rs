//! The forces that belong to joints and drivers: the friction of joints that may slip, and the limits of drivers. They
//! have modes: friction slides and sticks, and a driver saturates and follows its law.

use super::problem::Problem;
use super::quantities::Quantities;
use crate::elements::forces::{DriveLimit, SlipFriction};
use crate::elements::{Acted, Constraint, Followed, ForceElement, JointId, Measured, Slips};
use crate::expression::Tape;

/// The force that belongs to a joint or driver.
pub(super) fn companion_of(
    (joint, name, element): (JointId, &str, &Constraint<Tape>),
    quantities: &dyn Quantities,
    problems: &mut Vec<Problem>,
) -> Option<ForceElement<Tape>> {
    if element.limit().is_some() {
        return limit_of(name, element, quantities, problems);
    }
    let Slips { kinetic, r#static } = element.slips()?;
    let coordinate = quantities.acted(&format!("{name}.{}", Measured::SLIP.names[0]))?;
    Some(ForceElement::SlipFriction(SlipFriction { joint, coordinate, kinetic, r#static }))
}

/// The limit of a driver. Reports a driver along whose coordinate no force acts.
fn limit_of(
    name: &str,
    element: &Constraint<Tape>,
    quantities: &dyn Quantities,
    problems: &mut Vec<Problem>,
) -> Option<ForceElement<Tape>> {
    if element.value().is_some_and(|law| law.variables().next().is_some()) {
        let message =
            "the law of the driver uses positions, so that its effort acts on several bodies"
                .to_string();
        let hint = "remove the limit, or give a value that uses t only";
        problems.push(Problem::at(&["drivers", name, "limit"], message).hint(hint));
        return None;
    }
    let coordinate = match element.drives()? {
        Followed::Coordinate(of) => Some(Acted::from(*of)),
        Followed::Quantity(of) => quantities.acted(&of.name),
    };
    let Some(coordinate) = coordinate else {
        let message = "no force acts along the place of a joint on its curve".to_string();
        let hint = "remove the limit, or drive a coordinate of the body on the curve";
        problems.push(Problem::at(&["drivers", name, "limit"], message).hint(hint));
        return None;
    };
    let driver = Box::new(element.clone());
    Some(ForceElement::DriveLimit(DriveLimit { driver, coordinate, acts: false }))
}
