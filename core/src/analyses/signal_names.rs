//! The names of quantities, such as `crank.B.vx`, `C.force` or `energy.kinetic`.

use super::signals::{Energy, ForcePart, Signal};
use crate::elements::{BodyId, Followed, Measured};
use crate::equations::measured::{offered, ElementId};
use crate::math::{Listed, ShortArray};
use crate::model::{beam_of, is_inner, is_stretch_lock, Columns, Model, BEAM};

/// The components of a force.
const PARTS: [(&str, ForcePart); 4] = [
    ("fx", ForcePart::X),
    ("fy", ForcePart::Y),
    ("force", ForcePart::Size),
    ("torque", ForcePart::Torque),
];
/// The place of the largest effort among the results of the limit of a driver.
const LIMIT: usize = 2;

/// The quantities of one owner with their names.
type Family = Vec<(String, Signal)>;

pub(super) const COORDINATES: [[&str; 3]; 3] =
    [["x", "y", "angle"], ["vx", "vy", "omega"], ["ax", "ay", "alpha"]];

/// The quantity with this name.
pub(super) fn signal(model: &Model, name: &str) -> Option<Signal> {
    let (owner, quantity) = name.rsplit_once('.')?;
    family(model, owner)?.into_iter().find(|(known, _)| known == quantity).map(|(_, signal)| signal)
}

/// The names of all quantities, for suggestions: only those of the owner in `like` if it exists.
pub(super) fn names(model: &Model, like: &str) -> Vec<String> {
    let known = like.rsplit_once('.').map(|(owner, _)| owner.to_string());
    let known = known.filter(|owner| family(model, owner).is_some());
    let owners = known.map_or_else(|| owners(model), |owner| vec![owner]);
    let of = |owner: String| {
        let family = family(model, &owner).unwrap_or_default();
        family.into_iter().map(move |(name, _)| format!("{owner}.{name}"))
    };
    owners.into_iter().flat_map(of).list()
}

fn owners(model: &Model) -> Vec<String> {
    let shown = model.bodies.iter().filter(|body| !is_inner(&body.name));
    let points = shown.flat_map(|body| {
        let points = body.points.iter().map(|(point, _)| format!("{}.{point}", body.name));
        std::iter::once(body.name.clone()).chain(points)
    });
    let constraints = model.constraints.iter().filter(|item| item.element.in_files());
    let constraints = constraints.map(|item| item.name.clone());
    let of_file = model.listed_forces().iter().filter(|item| item.element.in_files());
    let forces = of_file.map(|item| item.name.clone());
    let of_run = ["energy", "drift"].each(str::to_string);
    points.chain(constraints).chain(forces).chain(of_run).list()
}

fn family(model: &Model, owner: &str) -> Option<Family> {
    if let Some(body) = model.body(owner) {
        return Some(of_body(model, body));
    }
    if let Some(k) = model.constraint(owner) {
        return Some(of_constraint(model, k));
    }
    if let Some(k) = model.force(owner) {
        return Some(of_force(model, k));
    }
    if let Some((body, point)) = owner.rsplit_once('.') {
        let body = model.body(body)?;
        return of_point(model, body, point);
    }
    let name = str::to_string;
    match owner {
        "energy" => {
            let all = [
                ("kinetic", Energy::Kinetic),
                ("potential", Energy::Potential),
                ("dissipated", Energy::Dissipated),
                ("work", Energy::Work),
                ("total", Energy::Total),
                ("balance", Energy::Balance),
            ];
            Some(all.each(|(known, of)| (name(known), Signal::Energy(of))).into())
        }
        "drift" => {
            let drift = |order| Signal::Drift { order };
            let balance = (name("balance"), Signal::Balance);
            Some(vec![(name("position"), drift(0)), (name("velocity"), drift(1)), balance])
        }
        _ => None,
    }
}

fn of_body(model: &Model, body: BodyId) -> Family {
    let columns = model.layout.bodies[body.0];
    let signal = |order: usize, k: usize| match body.is_ground() {
        true => Signal::Constant(0.0),
        false => Signal::Column { order, column: columns.first + k },
    };
    let count = if body.is_ground() { 3 } else { columns.count };
    let places = (0..3).flat_map(|order| (0..count).map(move |k| (order, k)));
    let mut found =
        places.map(|(order, k)| (COORDINATES[order][k].to_string(), signal(order, k))).list();
    if model.bodies[body.0].kind == BEAM {
        of_beam(model, &model.bodies[body.0].name, &mut found);
    }
    found
}

/// Adds the largest stress and bending moment of a beam, and its strain energy.
fn of_beam(model: &Model, beam: &str, found: &mut Family) {
    let of_it = |k: &usize| {
        let item = &model.forces[*k];
        !item.element.in_files() && beam_of(&item.name) == beam
    };
    let pieces = (0..model.forces.len()).filter(of_it).list();
    let Some(first) = pieces.first() else { return };
    let has_stress = model.forces[*first].element.has_stress();
    // the multipliers contain the normal force of an inextensible beam
    let locks =
        (0..model.constraints.len()).filter(|k| is_stretch_lock(&model.constraints[*k].name, beam));
    let locks = locks.map(ElementId::Constraint).list();
    let pieces = pieces.into_iter().map(ElementId::Force).list();
    for (name, sum) in [("stress", false), ("bending_moment", false), ("strain_energy", true)] {
        let of = if name == "stress" && !locks.is_empty() { &locks } else { &pieces };
        let results = match of[0] {
            ElementId::Constraint(k) => model.constraints[k].element.result_quantities(),
            ElementId::Force(k) => model.forces[k].element.result_quantities(),
        };
        let place = results.iter().position(|known| known.name == name);
        let signal = place
            .filter(|_| name != "stress" || has_stress)
            .map(|place| (name.to_string(), Signal::OfBeam { pieces: of.clone(), place, sum }));
        found.extend(signal);
    }
}

fn of_point(model: &Model, body: BodyId, point: &str) -> Option<Family> {
    let mut known = model.bodies[body.0].points.iter();
    let point = known.position(|(name, _)| name == point)?;
    let places = (0..3).flat_map(|order| (0..2).map(move |axis| (order, axis)));
    let signal = |(order, axis): (usize, usize)| {
        (COORDINATES[order][axis].to_string(), Signal::Point { body, point, axis, order })
    };
    Some(places.map(signal).list())
}

fn of_measured(all: &[Measured], id: ElementId) -> Family {
    let named = all.iter().enumerate().flat_map(|(k, of)| {
        let names = of.names.into_iter().enumerate().filter(|(_, name)| !name.is_empty());
        names.map(move |(order, name)| (name.to_string(), Signal::Measured { id, k, order }))
    });
    named.list()
}

fn of_constraint(model: &Model, k: usize) -> Family {
    let (item, id) = (&model.constraints[k], ElementId::Constraint(k));
    let mut found = of_measured(offered(model, id), id);
    let mut add = |name: &str, signal: Signal| found.push((name.to_string(), signal));
    if item.equations.len() == 1 && item.equations[0].name == "length" {
        add("tension", Signal::Line { id });
    }
    if let Some(coordinate) = item.element.drives() {
        add("effort", Signal::Effort(k));
        if let Some(rate) = rate_of(model, coordinate) {
            add("power", Signal::Power(k, Box::new(rate)));
        }
    }
    if let Some(k) = item.companion.filter(|k| model.forces[*k].element.driver().is_some()) {
        add("limit", Signal::ForceResult { k, place: LIMIT });
    }
    PARTS.into_iter().for_each(|(name, part)| add(name, Signal::Reaction { k, part }));
    let own = model.layout.constraints[k].own;
    for (column, name) in own.range().zip(own_names(own)) {
        add(&name, Signal::Column { order: 0, column });
        add(&format!("{name}_rate"), Signal::Column { order: 1, column });
    }
    for (place, result) in item.element.result_quantities().iter().enumerate() {
        add(result.name, Signal::Result { k, place });
    }
    found
}

/// Names of internal coordinates: u, or u1, u2 and u3.
fn own_names(own: Columns) -> Vec<String> {
    match own.count {
        1 => vec!["u".to_string()],
        count => (1..=count).map(|k| format!("u{k}")).list(),
    }
}

/// The rate of a driven coordinate.
fn rate_of(model: &Model, coordinate: &Followed) -> Option<Signal> {
    match coordinate {
        Followed::Coordinate(of) => {
            let column = model.layout.bodies[of.body.0].first + of.coordinate.column();
            Some(Signal::Column { order: 1, column })
        }
        Followed::Quantity(of) => Some(match signal(model, &of.name)? {
            Signal::Point { body, point, axis, .. } => {
                Signal::Point { body, point, axis, order: 1 }
            }
            Signal::Measured { id, k, .. } => Signal::Measured { id, k, order: 1 },
            Signal::Column { column, .. } => Signal::Column { order: 1, column },
            other => other,
        }),
    }
}

fn of_force(model: &Model, k: usize) -> Family {
    let (item, id) = (&model.forces[k], ElementId::Force(k));
    let mut found = of_measured(offered(model, id), id);
    let mut add = |name: &str, signal: Signal| found.push((name.to_string(), signal));
    for (place, result) in item.element.result_quantities().iter().enumerate() {
        add(result.name, Signal::ForceResult { k, place });
    }
    if item.element.driver().is_some() {
        // in place of the driver, it has its quantities
        PARTS.into_iter().for_each(|(name, part)| add(name, Signal::Force { k, part }));
        return found;
    }
    for (name, part) in PARTS.into_iter().filter(|(name, _)| *name != "force") {
        add(name, Signal::Force { k, part });
    }
    if item.element.points().is_some() {
        add("force", Signal::Line { id });
    }
    add("power", Signal::ForcePower(k));
    add("energy", Signal::ForceEnergy(k));
    add("dissipated", Signal::ForceDissipated(k));
    for (state, place) in item.states.iter().zip(model.layout.states[k].clone()) {
        add(state.name, Signal::State(place));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::Coordinate;

    #[test]
    fn names_of_coordinates_are_those_of_laws() {
        let laws = Coordinate::ALL.map(Coordinate::name);
        assert_eq!(laws, [COORDINATES[0], COORDINATES[1]].concat()[..]);
    }
}
