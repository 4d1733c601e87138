//! Numbers of bodies in circles, and their names beside them.

use super::bodies::middles;
use super::items::{colour_of, layer, printed, Frame, Item};
use super::list::{List, Name, Numbers};
use super::shapes::circle;
use super::text::{one_line, Role};
use crate::plane::{ahead, minus, size, At};
use crate::scene::mark::is_around;
use crate::scene::Body;
use kempe::elements::Mark;
use kempe::model::{beam_of, NODE};

/// Radius of the circle around a number, and of symbols around a pin, points of print.
pub const RADIUS: f64 = 7.0;
const RINGED: f64 = 20.0;
/// Largest number of numbers on a drawing.
const MOST: usize = 40;

/// Positions at the instants, points of print, and the occupied radius around them.
type Pin = (Vec<At>, f64);

/// Writes a number in a circle on each moving body, and its name beside it. A beam is one body.
pub fn add(made: &mut List<'_>, numbers: Numbers) {
    let scene = made.scene;
    let bodies = scene.bodies.get(1..).unwrap_or_default();
    let shown: Vec<&Body> = bodies.iter().filter(|body| body.kind != NODE).collect();
    if shown.len() > MOST {
        return;
    }
    let mut pins: Vec<Pin> = Vec::new();
    for symbol in scene.symbols.iter().filter(|symbol| symbol.mark != Mark::Beam) {
        let wide = if is_around(symbol.mark) { RINGED } else { RADIUS };
        pins.extend(symbol.ends().map(|(body, at)| (printed_path(made, body, at), wide)));
    }
    for (k, body) in shown.into_iter().enumerate() {
        let carriers = carriers(bodies, body);
        let place = |carrier: &&Body| Some(carrier.number).zip(free_place(made, carrier, &pins));
        let number = (k as i64 + numbers.first).to_string();
        match carriers.iter().find_map(place) {
            Some((carrier, at)) => {
                let frame = Frame::upright(carrier, at);
                let rim = circled(&body.name, &frame, [0.0; 2]);
                let colour = colour_of(body.number);
                made.items.extend(rim.map(|item| match item.colour.as_str() {
                    "paper" => item,
                    _ => Item { colour: colour.clone(), ..item },
                }));
                made.items.push(Item::text(&body.name, &frame, [0.0; 4], &number, Role::Number));
                pins.push((printed_path(made, carrier, at), RADIUS));
                if numbers.names {
                    made.name(Role::Body, &body.name, frame);
                }
            }
            None => {
                let (role, words) = match numbers.names {
                    true => (Role::Body, format!("{number} {}", one_line(&body.name))),
                    false => (Role::Number, number),
                };
                let frame = Frame::upright(carriers[0].number, carriers[0].center);
                made.names.push(Name { of: body.name.clone(), words, role, frame });
            }
        }
    }
}

/// The bodies that may carry the number of a body: the nodes of a beam, from its middle on.
fn carriers<'a>(bodies: &'a [Body], body: &'a Body) -> Vec<&'a Body> {
    let is_inner = |other: &&Body| other.kind == NODE && beam_of(&other.name) == body.name;
    let mut nodes: Vec<(usize, &Body)> = bodies.iter().filter(is_inner).enumerate().collect();
    let middle = nodes.len() / 2;
    nodes.sort_by_key(|(k, _)| k.abs_diff(middle));
    let nodes = nodes.into_iter().map(|(_, node)| node);
    if middle == 0 {
        vec![body]
    } else {
        nodes.collect()
    }
}

/// The circle around the number of a body.
pub fn circled(of: &str, frame: &Frame, offset: At) -> [Item; 2] {
    let rim = printed(circle(RADIUS, 32).into_iter().map(|at| ahead(at, 1.0, offset)));
    let colour = match frame {
        Frame::Body { body, .. } => colour_of(*body),
        _ => "ink".to_string(),
    };
    let items = [
        Item::fill(of, frame, rim.clone(), "paper"),
        Item::line(of, frame, rim, &colour, 1.0).closed(),
    ];
    items.map(|item| Item { numbered: true, ..item.on(layer::NUMBER) })
}

fn printed_path(made: &List<'_>, body: usize, at: At) -> Vec<At> {
    made.path(body, at).into_iter().map(|place| made.view.points(place)).collect()
}

/// A position at which a number covers no pin and no other number. None if there is no free position.
fn free_place(made: &List<'_>, body: &Body, pins: &[Pin]) -> Option<At> {
    middles(body).into_iter().find(|at| {
        let path = printed_path(made, body.number, *at);
        pins.iter().all(|(pin, wide)| {
            let mut apart = path.iter().zip(pin).map(|(a, b)| size(minus(*a, *b)));
            apart.all(|apart| apart - wide > RADIUS)
        })
    })
}
