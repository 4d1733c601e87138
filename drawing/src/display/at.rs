//! Symbols at a point of a body, or along an axis of a body.
//!
//! Lengths are in points of print unless they belong to the mechanism.

use super::along::FORCE;
use super::items::{colour_of, layer, printed, Frame, Item};
use super::pins::pin_at;
use super::shapes::{arc, arrow_head, circle, spread};
use super::wheels::OVERHANG;
use crate::plane::At;
use crate::scene::Symbol;
use std::f64::consts::FRAC_PI_2;

const BLOCK: [At; 4] = [[-13.0, -7.5], [13.0, -7.5], [13.0, 7.5], [-13.0, 7.5]];
const RAIL: f64 = 9.0;
/// Half width of a slot, and its length beyond the positions of the pin.
const SLOT: f64 = 5.5;
const BEYOND: f64 = 14.0;
/// Radius of the eye of a sleeve.
const EYE: f64 = 8.5;
/// Half height of a stop.
const STOP: f64 = 9.0;
/// Overhang of a face beyond its contacts.
const FACE: f64 = 8.0;

/// A rigid connection.
pub fn clamp(symbol: &Symbol) -> Vec<Item> {
    let of = &symbol.element;
    let square = printed([[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]]);
    let frame = Frame::on(symbol.bodies[1], symbol.at_j());
    let mut found = vec![Item::fill(of, &frame, square, "ink").on(layer::PIN)];
    if let Some(k) = symbol.bodies.iter().position(|body| *body == 0) {
        let (wall, at) = (printed([[-10.0, -5.0], [10.0, -5.0]]), symbol.points[k]);
        let frame = Frame::upright(0, at.unwrap_or_default());
        let line = Item::line(of, &frame, wall, "ground", 1.0);
        found.push(line.on(layer::GROUND).hatched(-1));
    }
    found
}

/// A rubber ring in an eye of body i around a pin of body j. On ground the eye has feet.
pub fn sleeve(symbol: &Symbol) -> Vec<Item> {
    let (of, i) = (&symbol.element, symbol.bodies[0]);
    let (frame, eye) = (Frame::upright(i, symbol.at_i()), printed(circle(EYE, 32)));
    let mut found = Vec::new();
    if i == 0 {
        let feet = printed([[-12.0, -14.0], [-7.0, -5.0], [7.0, -5.0], [12.0, -14.0]]);
        let base = printed([[-15.0, -14.0], [15.0, -14.0]]);
        let line = |rows| Item::line(of, &frame, rows, "ground", 1.0).on(layer::GROUND);
        found.extend([line(feet), line(base).hatched(-1)]);
    }
    let apart = Frame::between(symbol.bodies, [symbol.at_i(), symbol.at_j()]);
    let rows = vec![[0.0; 4], [1.0, 0.0, 0.0, 0.0]];
    found.extend([
        Item::fill(of, &frame, eye.clone(), "force").on(layer::PIN).tinted(0.7),
        Item::line(of, &frame, eye, "force", 1.6).on(layer::PIN).closed(),
        Item::line(of, &apart, rows, "force", FORCE).on(layer::PIN),
    ]);
    found.extend(pin_at(symbol, 1));
    found
}

/// A block of body j between rails of body i. The rails are hatched on ground.
pub fn slide(symbol: &Symbol) -> Vec<Item> {
    let (of, [i, j], [low, high]) = (&symbol.element, symbol.bodies, symbol.reach());
    let rail = |side: i8| {
        let y = f64::from(side) * RAIL;
        let rows = vec![[low, 0.0, -OVERHANG, y], [high, 0.0, OVERHANG, y]];
        let frame = Frame::turned(i, symbol.at_i(), i, symbol.axes[0]);
        let line = Item::line(of, &frame, rows, &colour_of(i), 1.0);
        line.on(layer::GROUND).hatched(if i == 0 { side } else { 0 })
    };
    let frame = Frame::turned(j, symbol.at_j(), j, symbol.axes[1]);
    let colour = colour_of(j);
    vec![
        rail(1),
        rail(-1),
        Item::fill(of, &frame, printed(BLOCK), &colour).on(layer::BODY).tinted(0.72),
        Item::line(of, &frame, printed(BLOCK), &colour, 1.2).on(layer::BODY).closed(),
    ]
}

/// A slot in body i, as long as the travel of the pin of body j, and the pin.
pub fn slot(symbol: &Symbol) -> Vec<Item> {
    let (of, i, [low, high]) = (&symbol.element, symbol.bodies[0], symbol.reach());
    let frame = Frame::turned(i, symbol.at_i(), i, symbol.axes[0]);
    let end = |x: f64, beyond: f64, begin: f64, end: f64| {
        let row = move |[px, py]: At| [x, 0.0, px + beyond, py];
        arc(SLOT, begin, end, 24).into_iter().map(row)
    };
    let left = end(low, -BEYOND, FRAC_PI_2, 3.0 * FRAC_PI_2);
    let rim: Vec<_> = left.chain(end(high, BEYOND, -FRAC_PI_2, FRAC_PI_2)).collect();
    let mut found = vec![
        Item::fill(of, &frame, rim.clone(), "paper").on(layer::BODY),
        Item::line(of, &frame, rim, &colour_of(i), 1.2).on(layer::BODY).closed(),
    ];
    found.extend(pin_at(symbol, 1));
    found
}

/// Teeth of friction on both sides of the block of body j.
pub fn rubbing_slide(symbol: &Symbol) -> Vec<Item> {
    let [i, j] = symbol.bodies;
    let frame = Frame::turned(j, symbol.at_j(), i, symbol.axes[0]);
    let line = |side: f64| {
        let x = spread(-BLOCK[1][0], BLOCK[1][0], 11).into_iter().enumerate();
        let y = |k: usize| side * if k % 2 == 1 { RAIL + 2.5 } else { RAIL - 2.5 };
        let teeth = printed(x.map(|(k, x)| [x, y(k)]));
        Item::line(&symbol.element, &frame, teeth, "force", FORCE).on(layer::PIN)
    };
    [1.0, -1.0].map(line).to_vec()
}

/// The point of body i that slides on a curve.
pub fn touch(symbol: &Symbol) -> Item {
    let i = symbol.bodies[0];
    let (frame, dot) = (Frame::upright(i, symbol.at_i()), printed(circle(3.5, 32)));
    Item::fill(&symbol.element, &frame, dot, &colour_of(i)).on(layer::PIN)
}

/// A face of body i, as long as the range in which the curve touches it.
pub fn face(symbol: &Symbol) -> Item {
    let (i, [low, high]) = (symbol.bodies[0], symbol.reach());
    let frame = Frame::turned(i, symbol.at_i(), i, symbol.axes[0]);
    let rows = vec![[low.min(0.0), 0.0, -FACE, 0.0], [high.max(0.0), 0.0, FACE, 0.0]];
    Item::line(&symbol.element, &frame, rows, &colour_of(i), 3.0).on(layer::BODY)
}

/// A stop of body i, hatched on the blocked side.
pub fn shift_stop(symbol: &Symbol) -> Item {
    let i = symbol.bodies[0];
    let frame = Frame::turned(i, symbol.at_i(), i, symbol.axes[0]);
    let face = printed([[0.0, -STOP], [0.0, STOP]]);
    Item::line(&symbol.element, &frame, face, &colour_of(i), 2.0).hatched(-1)
}

/// An arrow on body j along the axis of body i.
pub fn straight_arrow(symbol: &Symbol, colour: &str, width: f64) -> Vec<Item> {
    let [i, j] = symbol.bodies;
    let frame = Frame::turned(j, symbol.at_j(), i, symbol.axes[0]);
    let shaft = printed([[16.0, 0.0], [40.0, 0.0]]);
    let head = printed(arrow_head([47.0, 0.0], 0.0, 8.0));
    vec![
        Item::line(&symbol.element, &frame, shaft, colour, width),
        Item::fill(&symbol.element, &frame, head, colour),
    ]
}
