//! The pins of a mechanism, described from each of their bodies.

use crate::elements::Fixes;
use crate::math::{each, Local, ShortArray};
use crate::model::Model;

/// Two coincident points, described from one of their bodies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub constraint: usize,
    pub own: Local,
    pub other: usize,
    pub at_other: Local,
    /// Index of the same joint among the legs of the other body.
    pub mirror: usize,
    /// The angle of this body minus the angle of the other body, if the joint also fixes this difference.
    pub turned: Option<f64>,
}

/// The legs of each body, in the order of the joints.
pub(super) fn legs(model: &Model) -> Vec<Vec<Leg>> {
    let mut legs = vec![Vec::new(); model.bodies.len()];
    for (constraint, item) in model.constraints.iter().enumerate() {
        let fixes = item.element.fixes();
        if !fixes.contains(&Fixes::Points) {
            continue;
        }
        let at = each([0, 1], |body| item.element.attachment(body));
        let rigid = fixes.contains(&Fixes::Direction);
        let ends = each([0, 1], |end| item.bodies[end].0);
        let places = ends.each(|body| legs[body].len());
        for (own, other) in [(0, 1), (1, 0)] {
            legs[ends[own]].push(Leg {
                constraint,
                own: at[own].s,
                other: ends[other],
                at_other: at[other].s,
                mirror: places[other],
                turned: rigid.then(|| at[other].axis - at[own].axis),
            });
        }
    }
    legs
}
