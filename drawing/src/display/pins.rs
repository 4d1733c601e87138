//! Pins, the ground below them, and points without a symbol.

use super::items::{layer, printed, Frame, Item};
use super::shapes::circle;
use crate::plane::At;
use crate::scene::Symbol;

const RADIUS: f64 = 3.0;

/// The pin at the point of a symbol on body i (0) or j (1).
pub fn pin_at(symbol: &Symbol, k: usize) -> [Item; 2] {
    let frame = Frame::upright(symbol.bodies[k], symbol.points[k].unwrap_or_default());
    let rim = printed(circle(RADIUS, 32));
    [
        Item::fill(&symbol.element, &frame, rim.clone(), "paper").on(layer::PIN),
        Item::line(&symbol.element, &frame, rim, "ink", 1.0).on(layer::PIN).closed(),
    ]
}

/// The triangle under a pin on ground, and hatched ground below it.
pub fn support(of: &str, at: At) -> [Item; 3] {
    let frame = Frame::upright(0, at);
    let corners = printed([[0.0, 0.0], [-7.0, -12.0], [7.0, -12.0]]);
    let base = printed([[-11.0, -12.0], [11.0, -12.0]]);
    [
        Item::fill(of, &frame, corners.clone(), "paper").on(layer::GROUND),
        Item::line(of, &frame, corners, "ground", 1.0).on(layer::GROUND).closed(),
        Item::line(of, &frame, base, "ground", 1.0).on(layer::GROUND).hatched(-1),
    ]
}

/// The mark of a point without a symbol.
pub fn dot(of: &str, body: usize, at: At) -> Item {
    let colour = if body == 0 { "ground" } else { "ink" };
    let rim = printed(circle(2.0, 32));
    Item::fill(of, &Frame::upright(body, at), rim, colour).on(layer::PIN)
}
