//! Bodies, the symbols of all elements, supports, and points without a symbol.

use super::along::aside;
use super::around::{Around, Rings};
use super::list::List;
use super::pins::{dot, support};
use super::places::Places;
use super::{bodies, symbols};
use crate::scene::mark::{is_around, is_pinned, is_wheel, unmarked};
use crate::scene::{Body, Symbol};
use kempe::elements::Mark;

/// Adds the mechanism.
pub fn draw(made: &mut List<'_>) {
    let scene = made.scene;
    made.items.extend(scene.bodies.iter().flat_map(bodies::rims));
    made.items.extend(scene.bodies.first().into_iter().flat_map(bodies::draw));
    add_links(made);
    let (mut places, mut pinned) = (Places::new(made.near), Places::new(made.near));
    let mut rings = Rings::default();
    for own in by_element(&scene.symbols) {
        for symbol in own {
            let is_drawn = match symbol.mark {
                Mark::Slot | Mark::Beam => false, // drawn with the bodies
                Mark::Pin => pinned.is_new(made.last_end(symbol)),
                _ => true,
            };
            if is_drawn {
                let around = is_around(symbol.mark);
                let place = if around { places.index(made.last_end(symbol)) } else { 0 };
                let around = Around { rings: &mut rings, place };
                made.items.extend(symbols::draw(symbol, around, aside(symbol, own)));
            }
        }
    }
    add_supports(made);
    add_points(made);
}

/// Adds the bodies. Bodies with a slot come first, so that links that move in the slot remain visible.
fn add_links(made: &mut List<'_>) {
    let scene = made.scene;
    let slots = || scene.symbols.iter().filter(|symbol| symbol.mark == Mark::Slot);
    let is_slotted = |body: &&Body| slots().any(|slot| slot.bodies[0] == body.number);
    // a body that consists only of a curve has no link
    let is_link = |body: &&Body| {
        let of_curve = !body.curves.is_empty() && body.outline.len() == 1;
        body.number > 0 && (!body.drawn.is_empty() || !of_curve)
    };
    let (slotted, others): (Vec<_>, Vec<_>) =
        scene.bodies.iter().filter(is_link).partition(is_slotted);
    made.items.extend(slotted.into_iter().flat_map(bodies::draw));
    for slot in slots() {
        let around = Around { rings: &mut Rings::default(), place: 0 };
        made.items.extend(symbols::draw(slot, around, 0.0));
    }
    made.items.extend(others.into_iter().flat_map(bodies::draw));
    for part in scene.symbols.iter().filter(|symbol| symbol.mark == Mark::Beam) {
        let own = scene.bodies.iter().find(|body| body.name == part.element);
        let number = own.map_or(part.bodies[0], |body| body.number);
        made.items.extend(bodies::beam(part, number));
    }
}

/// The symbols, grouped by element. Elements with the largest wheels come first.
fn by_element(symbols: &[Symbol]) -> Vec<&[Symbol]> {
    let mut found: Vec<&[Symbol]> = symbols.chunk_by(|a, b| a.element == b.element).collect();
    let largest = |own: &[Symbol]| {
        let wheels = own.iter().filter(|symbol| is_wheel(symbol.mark));
        wheels.map(|symbol| symbol.radii()[1]).fold(0.0, f64::max)
    };
    found.sort_by(|a, b| largest(b).total_cmp(&largest(a)));
    found
}

/// Adds one support at each place on ground about which a body turns.
fn add_supports(made: &mut List<'_>) {
    let mut supported = Places::new(made.near);
    let scene = made.scene;
    for symbol in scene.symbols.iter().filter(|symbol| is_pinned(symbol.mark)) {
        for (body, at) in symbol.ends() {
            if body == 0 && supported.is_new(made.path(body, at)) {
                made.items.extend(support(&symbol.element, at));
            }
        }
    }
}

/// Adds a dot at each named point without a symbol.
fn add_points(made: &mut List<'_>) {
    let mut marked = Places::new(made.near);
    let scene = made.scene;
    for symbol in &scene.symbols {
        for path in made.ends(symbol).into_iter().skip(unmarked(symbol.mark)) {
            marked.is_new(path);
        }
    }
    for body in &scene.bodies {
        for point in &body.points {
            if marked.is_new(made.path(body.number, point.at)) {
                made.items.push(dot(&body.name, body.number, point.at));
            }
        }
    }
}
