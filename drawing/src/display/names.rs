//! Names of joints, contacts, points, forces and drivers.

use super::items::Frame;
use super::list::List;
use super::places::Places;
use super::text::{one_line, Role};
use crate::plane::At;
use crate::scene::mark::{is_along, is_drive};
use crate::scene::Symbol;
use kempe::elements::Mark;
use std::collections::HashSet;

/// Largest number of names on a drawing.
const MOST: usize = 60;
/// Separator between the names of objects at one place.
const BETWEEN: &str = " · ";

/// Objects at one place.
struct Group<'a> {
    role: Role,
    names: Vec<String>,
    frame: Frame,
    added: HashSet<&'a str>,
}

/// Names of objects, one text for each place.
struct Groups<'a> {
    places: Places,
    groups: Vec<Group<'a>>,
}

impl<'a> Groups<'a> {
    /// Adds a name at a place. Names of points are omitted at joints and contacts.
    fn add(&mut self, path: Vec<At>, role: Role, name: &'a str, (body, at): (usize, At)) {
        let k = self.places.index(path);
        if k == self.groups.len() {
            let (frame, added) = (Frame::upright(body, at), HashSet::new());
            self.groups.push(Group { role, names: Vec::new(), frame, added });
        }
        let group = &mut self.groups[k];
        if (role != Role::Point || group.role == Role::Point) && group.added.insert(name) {
            let name = one_line(name);
            if !group.names.contains(&name) {
                group.names.push(name);
            }
        }
    }
}

/// The symbols of forces at a point of body i that touches a curve.
fn contacts<'a>(made: &List<'a>) -> impl Iterator<Item = &'a Symbol> {
    let scene = made.scene;
    let touching = scene.symbols.iter().filter(|of| matches!(of.mark, Mark::Touch | Mark::Round));
    touching.filter(|symbol| scene.joints.iter().all(|joint| joint.name != symbol.element))
}

/// Writes the names of joints and contacts, one text for each place, and of free points.
pub fn add_joints(made: &mut List<'_>) {
    let scene = made.scene;
    if scene.joints.len() > MOST {
        return;
    }
    let mut found = Groups { places: Places::new(made.near), groups: Vec::new() };
    for joint in &scene.joints {
        let mut own = scene.symbols.iter().filter(|symbol| symbol.element == joint.name);
        match own.rfind(|symbol| is_along(symbol.mark)) {
            Some(rod) => made.name(Role::Joint, &joint.name, line_of(rod)),
            None => {
                let end = (joint.bodies[1], joint.points[1]);
                found.add(made.path(end.0, end.1), Role::Joint, &joint.name, end);
            }
        }
    }
    for symbol in contacts(made) {
        let end = (symbol.bodies[0], symbol.at_i());
        found.add(made.path(end.0, end.1), Role::Element, &symbol.element, end);
    }
    let count: usize = scene.bodies.iter().map(|body| body.points.len()).sum();
    for body in if count <= MOST { &scene.bodies[..] } else { &[] } {
        for point in &body.points {
            let end = (body.number, point.at);
            found.add(made.path(end.0, end.1), Role::Point, &point.name, end);
        }
    }
    for group in found.groups {
        made.name(group.role, &group.names.join(BETWEEN), group.frame);
    }
}

/// Writes the names of forces and drivers beside their symbols.
pub fn add_elements(made: &mut List<'_>) {
    let scene = made.scene;
    let mut seen: HashSet<&str> = scene.joints.iter().map(|joint| joint.name.as_str()).collect();
    seen.extend(contacts(made).map(|symbol| symbol.element.as_str()));
    for symbol in scene.symbols.iter().filter(|symbol| symbol.mark != Mark::Beam) {
        if seen.len() > MOST || !seen.insert(&symbol.element) {
            continue;
        }
        let role = if is_drive(symbol.mark) { Role::Driver } else { Role::Element };
        let frame = match symbol.mark {
            mark if is_along(mark) => line_of(symbol),
            Mark::ShiftStop => Frame::upright(symbol.bodies[0], symbol.at_i()),
            _ => Frame::upright(symbol.bodies[1], symbol.at_j()),
        };
        made.name(role, &symbol.element, frame);
    }
}

fn line_of(symbol: &Symbol) -> Frame {
    Frame::between(symbol.bodies, [symbol.at_i(), symbol.at_j()])
}
