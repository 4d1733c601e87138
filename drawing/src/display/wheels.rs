//! Wheels, gears, racks and belts, drawn to scale.
//!
//! Lengths are in points of print unless they belong to the mechanism.

use super::items::{colour_of, layer, metres, Frame, Item, Row};
use super::pins::pin_at;
use super::shapes::{arc, circle};
use crate::plane::{direction, At};
use crate::scene::{outer_radius, Symbol};
use std::f64::consts::{PI, TAU};

/// Length of rails and lines beyond the range of contact.
pub const OVERHANG: f64 = 24.0;
/// Corners of a tooth, along and perpendicular to the pitch line, as fractions of the pitch.
const TOOTH: [At; 4] = [[-0.38, -0.27], [-0.14, 0.25], [0.14, 0.25], [0.38, -0.27]];
/// Distance of the back of a rack from the pitch line, in pitches.
const BACK: f64 = 0.8;
/// Largest number of drawn teeth of a wheel or rack; more would be finer than a line.
const MOST_TEETH: f64 = 2_000.0;
const TINT: f64 = 0.84;
const TINT_OF_BODIES: f64 = 0.72;

/// A plain wheel. If it can turn, a radius shows its angle.
pub fn plain_wheel(symbol: &Symbol) -> Vec<Item> {
    let colour =
        if symbol.bodies[1] == 0 { "ground".to_string() } else { colour_of(symbol.bodies[1]) };
    wheel(symbol, circle(symbol.radii()[1], 96), &colour)
}

/// A wheel with external teeth.
pub fn toothed_wheel(symbol: &Symbol) -> Vec<Item> {
    let mut found = wheel(symbol, teeth(symbol, 1.0), &colour_of(symbol.bodies[1]));
    found.push(pitch_circle(symbol));
    found
}

/// A ring with internal teeth. On ground, its outside is hatched.
pub fn toothed_ring(symbol: &Symbol) -> Vec<Item> {
    let (of, body) = (&symbol.element, symbol.bodies[1]);
    let (frame, colour) = (Frame::on(body, symbol.at_j()), colour_of(body));
    let (inside, rim) = (teeth(symbol, -1.0), circle(outer_radius(symbol), 96));
    let around: Vec<At> = rim.iter().chain(rim.first()).copied().collect();
    let seam = around.iter().chain(inside.first()).chain(inside.iter().rev()).copied();
    let hatch = if body == 0 { -1 } else { 0 };
    vec![
        Item::fill(of, &frame, metres(seam), &colour).on(layer::GROUND).tinted(TINT),
        Item::line(of, &frame, metres(inside), &colour, 1.0).on(layer::GROUND).closed(),
        Item::line(of, &frame, metres(around), &colour, 1.0).on(layer::GROUND).hatched(hatch),
        pitch_circle(symbol),
    ]
}

/// The teeth of a rack on body i across its pitch line, and its back.
pub fn toothed_line(symbol: &Symbol) -> Vec<Item> {
    let (of, i) = (&symbol.element, symbol.bodies[0]);
    let side = 1.0_f64.copysign(symbol.radii()[1]);
    let Some(own) = symbol.teeth else { return Vec::new() };
    let (pitch, phase, [low, high]) = (PI * own.module, own.phase, symbol.reach());
    let first = ((low - phase) / pitch).floor() as i64 - 2;
    let last = ((high - phase) / pitch).ceil() as i64 + 2;
    if last - first > MOST_TEETH as i64 {
        return Vec::new();
    }
    let corner =
        |k: i64| TOOTH.map(|[x, y]| [x * pitch + phase + k as f64 * pitch, y * pitch * side]);
    let teeth: Vec<At> = (first..=last).flat_map(corner).collect();
    let ends = [teeth.first(), teeth.last()].map(|at| at.map_or(0.0, |at| at[0]));
    let [begin, end] = ends.map(|x| [x, -BACK * pitch * side]);
    let rim = metres([begin].into_iter().chain(teeth).chain([end]));
    let frame = Frame::turned(i, symbol.at_i(), i, symbol.axes[0]);
    filled(of, &frame, rim, &colour_of(i), 1.0)
}

/// An area of a body and its edge.
fn filled(of: &str, frame: &Frame, rim: Vec<Row>, colour: &str, width: f64) -> Vec<Item> {
    vec![
        Item::fill(of, frame, rim.clone(), colour).on(layer::BODY).tinted(TINT_OF_BODIES),
        Item::line(of, frame, rim, colour, width).on(layer::BODY).closed(),
    ]
}

fn wheel(symbol: &Symbol, rim: Vec<At>, colour: &str) -> Vec<Item> {
    let (of, body) = (&symbol.element, symbol.bodies[1]);
    let frame = Frame::on(body, symbol.at_j());
    let edge = Item::line(of, &frame, metres(rim.iter().copied()), colour, 1.0);
    let edge = edge.on(layer::GROUND).closed();
    if body == 0 {
        return vec![edge];
    }
    let spoke = metres([[0.0, 0.0], [symbol.radii()[1], 0.0]]);
    vec![
        Item::fill(of, &frame, metres(rim), colour).on(layer::GROUND).tinted(TINT),
        edge,
        Item::line(of, &frame, spoke, colour, 0.8).on(layer::GROUND),
    ]
}

fn pitch_circle(symbol: &Symbol) -> Item {
    let body = symbol.bodies[1];
    let (frame, pitch) = (Frame::on(body, symbol.at_j()), circle(symbol.radii()[1], 96));
    let line = Item::line(&symbol.element, &frame, metres(pitch), &colour_of(body), 0.5);
    line.on(layer::GROUND).closed()
}

/// The corners of all teeth of a wheel, counter-clockwise, m.
fn teeth(symbol: &Symbol, outwards: f64) -> Vec<At> {
    let Some(own) = symbol.teeth else { return Vec::new() };
    let radius = symbol.radii()[1];
    let count = (2.0 * radius / own.module).round_ties_even();
    if count > MOST_TEETH {
        return circle(radius, 96);
    }
    let pitch = PI * own.module;
    let tooth = |k: usize| {
        let middle = own.phase + TAU / count * k as f64;
        TOOTH.map(|[x, y]| {
            let away = radius + outwards * y * pitch;
            direction(middle + x * pitch / radius).map(|x| away * x)
        })
    };
    (0..count as usize).flat_map(tooth).collect()
}

/// The line of body i on which a wheel rolls; hatched on ground.
pub fn track(symbol: &Symbol) -> Item {
    let i = symbol.bodies[0];
    let [low, high] = symbol.reach();
    let frame = Frame::turned(i, symbol.at_i(), i, symbol.axes[0]);
    let rows = vec![[low, 0.0, -OVERHANG, 0.0], [high, 0.0, OVERHANG, 0.0]];
    let side = if symbol.radii()[1] > 0.0 { 1 } else { -1 };
    let hatch = if i == 0 { -side } else { 0 };
    let line = Item::line(&symbol.element, &frame, rows, &colour_of(i), 1.2);
    line.on(layer::GROUND).hatched(hatch)
}

/// A belt: common tangents of two circles, and the arcs between their ends.
pub fn strands(symbol: &Symbol, crossed: bool) -> Item {
    let ([r_i, r_j], length) = (symbol.radii(), symbol.reach()[1].max(1e-300));
    let sigma = if crossed { 1.0 } else { -1.0 };
    let turn = ((r_i + sigma * r_j) / length).clamp(-1.0, 1.0).acos();
    let begin = if crossed { PI - turn } else { turn };
    let mut around: Vec<At> =
        arc(r_j, -begin, begin, 48).into_iter().map(|[x, y]| [length + x, y]).collect();
    if crossed {
        around.reverse();
    }
    around.extend(arc(r_i, turn, TAU - turn, 48));
    let rows = around.into_iter().map(|[x, y]| [x / length, y, 0.0, 0.0]).collect();
    let frame = Frame::between(symbol.bodies, [symbol.at_i(), symbol.at_j()]);
    Item::line(&symbol.element, &frame, rows, "ground", 1.8).closed()
}

/// A roller of body i on its pin.
pub fn roller(symbol: &Symbol) -> Vec<Item> {
    let (of, i) = (&symbol.element, symbol.bodies[0]);
    let frame = Frame::on(i, symbol.at_i());
    let rim = metres(circle(symbol.radii()[0], 64));
    let mut found = vec![
        Item::fill(of, &frame, rim.clone(), "paper").on(layer::BODY),
        Item::line(of, &frame, rim, &colour_of(i), 1.4).on(layer::BODY).closed(),
    ];
    found.extend(pin_at(symbol, 0));
    found
}

/// A round end of body i.
pub fn round_end(symbol: &Symbol) -> Vec<Item> {
    let i = symbol.bodies[0];
    let rim = metres(circle(symbol.radii()[0], 64));
    filled(&symbol.element, &Frame::on(i, symbol.at_i()), rim, &colour_of(i), 1.4)
}
