//! Symbols around a point of body j, in rings from the inside to the outside.
//!
//! Lengths are in points of print.

use super::along::FORCE;
use super::items::{colour_of, printed, Frame, Item};
use super::shapes::{arc, arrow_head, spread};
use crate::plane::{direction, At};
use crate::scene::Symbol;
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, PI};

/// Inner and outer radius of a spiral, and the angle of its windings.
const SPIRAL: [f64; 2] = [4.5, 12.0];
const WINDINGS: f64 = 5.0 * PI;
const FIRST_RING: f64 = 13.0;
const RING: f64 = 8.0;
/// Half thickness of a brake pad around a pin.
const PAD: f64 = 3.0;

/// Radii that the symbols around each place already occupy.
#[derive(Default)]
pub struct Rings(HashMap<usize, f64>);

impl Rings {
    /// The next free radius around a place.
    fn radius(&mut self, place: usize, least: f64) -> f64 {
        let used = self.0.entry(place).or_insert(0.0);
        *used = least.max(*used + RING);
        *used
    }
}

/// A ring around a place, for the next symbol.
pub struct Around<'a> {
    /// The radii occupied around each place.
    pub rings: &'a mut Rings,
    /// The place of the point on body j.
    pub place: usize,
}

impl Around<'_> {
    fn radius(&mut self, least: f64) -> f64 {
        self.rings.radius(self.place, least)
    }
}

/// Two brake pads on body j around the pin.
pub fn rubbing_pin(symbol: &Symbol, mut around: Around<'_>) -> Vec<Item> {
    let (of, r) = (&symbol.element, around.radius(FIRST_RING - 2.0));
    let frame = Frame::on(symbol.bodies[1], symbol.at_j());
    let pad = |middle: f64| {
        let (begin, end) = (middle - 0.6, middle + 0.6);
        let rows = printed([arc(r + PAD, begin, end, 24), arc(r - PAD, end, begin, 24)].concat());
        let fill = Item::fill(of, &frame, rows.clone(), "force").tinted(0.6);
        [fill, Item::line(of, &frame, rows, "force", FORCE).closed()]
    };
    [0.0, PI].into_iter().flat_map(pad).collect()
}

/// A spiral from body i to body j that winds up as they rotate relative to each other.
pub fn spiral(symbol: &Symbol, mut around: Around<'_>) -> Vec<Item> {
    let [inner, outer] = SPIRAL;
    let radius = around.radius(outer);
    let [rest, most] = symbol.turning.unwrap_or_default();
    let count = (6.0 * (WINDINGS + most)).clamp(90.0, 2000.0) as usize;
    let row = |s: f64| [s, 0.0, inner + (radius - inner) * s, 0.0];
    let rows = spread(0.0, 1.0, count).into_iter().map(row).collect();
    let (bodies, at) = (symbol.bodies, symbol.at_j());
    let frame = Frame::Twist { bodies, at, turn: WINDINGS - rest };
    vec![Item::line(&symbol.element, &frame, rows, "force", FORCE)]
}

/// A dashpot bent around the pin: rod, piston, cup, rod. Each end is on a leg from the pin.
pub fn rotary_dashpot(symbol: &Symbol, mut around: Around<'_>) -> Vec<Item> {
    let r = around.radius(FIRST_RING + 3.0);
    let [begin, piston, end] = [20.0_f64, 86.0, 160.0].map(f64::to_radians);
    let [low, high] = [70.0_f64, 110.0].map(f64::to_radians);
    let at = |radius: f64, angle: f64| -> At { direction(angle).map(|x| radius * x) };
    let lines = [
        [vec![at(4.5, begin)], arc(r, begin, piston, 24)].concat(),
        vec![at(r - 3.0, piston), at(r + 3.0, piston)],
        [arc(r + 4.5, low, high, 24), arc(r - 4.5, high, low, 24)].concat(),
        [arc(r, high, end, 24), vec![at(4.5, end)]].concat(),
    ];
    let frame = Frame::upright(symbol.bodies[1], symbol.at_j());
    let line = |points| Item::line(&symbol.element, &frame, printed(points), "force", FORCE);
    lines.map(line).to_vec()
}

/// A stop on body i at an angle of body j around their joint.
pub fn turn_stop(symbol: &Symbol) -> Vec<Item> {
    let ([i, j], r) = (symbol.bodies, FIRST_RING + RING);
    let frame = Frame::turned(j, symbol.at_j(), i, symbol.axes[0]);
    let rows = printed([[r - 5.0, 0.0], [r + 5.0, 0.0]]);
    vec![Item::line(&symbol.element, &frame, rows, &colour_of(i), 4.0)]
}

/// An arrow around the pin, counter-clockwise unless its sense is negative: a torque, or the rotation of a driver.
pub fn curved_arrow(
    symbol: &Symbol,
    mut around: Around<'_>,
    colour: &str,
    width: f64,
) -> Vec<Item> {
    let r = around.radius(FIRST_RING);
    let [begin, end] = [10.0_f64, 170.0].map(f64::to_radians);
    let frame = Frame::upright(symbol.bodies[1], symbol.at_j());
    let sense = f64::from(symbol.sense);
    let turned = |[x, y]: At| [sense * x, y];
    let shaft = arc(r, begin, end - 4.0 / r, 24).into_iter().map(turned);
    let tip = direction(end).map(|x| r * x);
    let head = arrow_head(tip, end + FRAC_PI_2 - 3.5 / r, 8.0).map(turned);
    vec![
        Item::line(&symbol.element, &frame, printed(shaft), colour, width),
        Item::fill(&symbol.element, &frame, printed(head), colour),
    ]
}
