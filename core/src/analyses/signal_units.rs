//! The SI units of quantities of a motion.

use super::signal_names::COORDINATES;
use super::signals::{Energy, ForcePart, Signal};
use crate::elements::QuantityKind;
use crate::equations::measured::{offered, ElementId};
use crate::model::Model;

/// The SI unit of a quantity, such as `rad/s`; `m or rad` for the largest violation of constraints of both kinds.
pub(super) fn unit_of(model: &Model, name: &str, signal: &Signal) -> String {
    match signal {
        Signal::Constant(_) => of_ground(name),
        Signal::Column { order, column } => model.layout.kinds[*column].unit_of_rate(*order),
        Signal::State(place) => of_state(model, *place).to_string(),
        Signal::Point { order, .. } => QuantityKind::Length.unit_of_rate(*order),
        Signal::Measured { id, k, order } => offered(model, *id)[*k].kind.unit_of_rate(*order),
        Signal::Reaction { part, .. } | Signal::Force { part, .. } => of_part(*part).to_string(),
        Signal::ForceResult { k, place } => {
            model.forces[*k].element.result_quantities()[*place].unit.to_string()
        }
        Signal::OfBeam { pieces, place, .. } => {
            let results = match pieces[0] {
                ElementId::Constraint(k) => model.constraints[k].element.result_quantities(),
                ElementId::Force(k) => model.forces[k].element.result_quantities(),
            };
            results[*place].unit.to_string()
        }
        Signal::Result { k, place } => {
            model.constraints[*k].element.result_quantities()[*place].unit.to_string()
        }
        Signal::Effort(k) => model.constraints[*k].equations[0].kind.unit_of_effort().to_string(),
        Signal::Line { .. } => "N".to_string(),
        Signal::Power(..) | Signal::ForcePower(_) | Signal::ForceDissipating(_) => "W".to_string(),
        Signal::ForceEnergy(_) | Signal::ForceDissipated(_) => "J".to_string(),
        Signal::Energy(Energy::Balance) | Signal::Balance => "1".to_string(),
        Signal::Energy(_) => "J".to_string(),
        Signal::Drift { order } => ["m or rad", "m/s or rad/s"][*order].to_string(),
    }
}

/// The unit of a coordinate of ground, or of a quantity of a released driver.
fn of_ground(name: &str) -> String {
    let last = name.rsplit('.').next().unwrap_or_default();
    let places = (0..3).flat_map(|order| (0..3).map(move |k| (order, k)));
    let found = places.into_iter().find(|(order, k)| COORDINATES[*order][*k] == last);
    found.map_or("1".to_string(), |(order, k)| QuantityKind::OF_BODY[k].unit_of_rate(order))
}

fn of_state(model: &Model, place: usize) -> &'static str {
    let forces = model.forces.iter().zip(&model.layout.states);
    let owner = forces.into_iter().find(|(_, places)| places.contains(&place));
    let state = owner.and_then(|(item, places)| item.states.get(place - places.start));
    state.map_or("1", |state| state.unit)
}

fn of_part(part: ForcePart) -> &'static str {
    match part {
        ForcePart::Torque => "N*m",
        ForcePart::X | ForcePart::Y | ForcePart::Size => "N",
    }
}
