//! Symbols along the line between two points: rods, springs, dashpots and cylinders.
//!
//! Lengths are in points of print unless they belong to the mechanism.

use super::items::{layer, printed, Frame, Item, Row};
use super::pins::pin_at;
use super::shapes::{circle, spread};
use crate::scene::Symbol;
use kempe::elements::Mark;

/// Width of the lines of a force element.
pub const FORCE: f64 = 1.2;
/// Position of the bars of a spring beside a dashpot, as a fraction of the distance, and their distance to the side.
const BAR: f64 = 0.15;
const ASIDE: f64 = 6.5;
/// Length of a dashpot along its line.
const ROOM: f64 = 60.0;
/// Half width of a barrel and of its piston, and gap between the base of the barrel and its pin.
const BARREL: f64 = 5.0;
const PISTON: f64 = 3.6;
const EYE: f64 = 6.0;
/// Length of a barrel that cannot contain the stroke, as a fraction of the distance, and the largest such fraction.
const SHARE: f64 = 0.6;
const MOST: f64 = 0.85;
/// Largest fraction of a barrel in which the piston moves.
const TRAVEL: f64 = 0.85;
/// Ends of a coil as fractions of the distance, and number of its windings.
const COIL: [f64; 2] = [0.22, 0.78];
const WINDINGS: usize = 18;

/// Distance to the side at which a symbol is drawn among the symbols of its element, such as a spring beside a
/// dashpot.
pub fn aside(symbol: &Symbol, own: &[Symbol]) -> f64 {
    let has = |mark: Mark| own.iter().any(|one| one.mark == mark);
    match symbol.mark {
        Mark::Spring if has(Mark::Dashpot) => ASIDE,
        Mark::Dashpot if has(Mark::Spring) => -ASIDE,
        _ => 0.0,
    }
}

/// A massless rod.
pub fn rod(symbol: &Symbol) -> Vec<Item> {
    let rows = vec![[0.0; 4], [1.0, 0.0, 0.0, 0.0]];
    let mut found = vec![Item::line(&symbol.element, &line_of(symbol), rows, "ground", 1.8)];
    found.extend([0, 1].into_iter().flat_map(|k| pin_at(symbol, k)));
    found
}

fn line_of(symbol: &Symbol) -> Frame {
    Frame::between(symbol.bodies, [symbol.at_i(), symbol.at_j()])
}

/// Lengths of a barrel and of its piston rod, m, for distances between two limits.
///
/// The piston is in the middle of the barrel at half stroke. If no rod of fixed length allows the stroke, the barrel
/// is as long as the smallest distance allows.
fn lengths([low, high]: [f64; 2]) -> (f64, f64) {
    let barrel = (SHARE * low).max((high - low) / TRAVEL).min(MOST * low);
    (barrel, (low + high - barrel) / 2.0)
}

/// A barrel on body i, drawn open, and a piston on a rod to body j.
///
/// The barrel and the rod keep their lengths while the piston moves. If the stroke needs a longer barrel than there
/// is space for, they are drawn as fractions of the distance.
pub fn cylinder(symbol: &Symbol, colour: &str) -> Vec<Item> {
    let of = &symbol.element;
    let (bodies, ends) = (symbol.bodies, [symbol.at_i(), symbol.at_j()]);
    let back = ([bodies[1], bodies[0]], [ends[1], ends[0]]);
    let [low, high] = symbol.reach();
    let (barrel, reach) = lengths([low, high]);
    let (base, top, tube, piston) = match high - low <= barrel {
        true => {
            let ray = |(bodies, ends)| Frame::Ray { bodies, ends };
            (ray((bodies, ends)), ray(back), barrel, reach)
        }
        false => (Frame::between(bodies, ends), Frame::between(back.0, back.1), 0.6, 0.7),
    };
    let corners = [(0.0, EYE, 1.0), (tube, 0.0, 1.0), (tube, 0.0, -1.0), (0.0, EYE, -1.0)];
    let walls = corners.map(|(x, px, side)| [x, 0.0, px, side * BARREL]).to_vec();
    let disc = [-PISTON, PISTON].map(|py| [piston, 0.0, 0.0, py]).to_vec();
    let mut found = vec![
        Item::fill(of, &base, walls.clone(), colour).tinted(0.85),
        Item::line(of, &base, walls, colour, FORCE).closed(),
        Item::line(of, &base, vec![[0.0; 4], [0.0, 0.0, EYE, 0.0]], colour, 2.4),
        Item::line(of, &top, vec![[0.0; 4], [piston, 0.0, 0.0, 0.0]], colour, 2.4),
        Item::line(of, &top, disc, colour, 3.0),
    ];
    found.extend([0, 1].into_iter().flat_map(|k| pin_at(symbol, k)));
    found
}

/// A coil.
pub fn spring(symbol: &Symbol, aside: f64) -> Vec<Item> {
    let [first, last] = COIL;
    let lead = lead(aside);
    let places = spread(first, last, 2 * WINDINGS + 1);
    let teeth = places.iter().skip(1).step_by(2).enumerate();
    let mut coil = vec![[lead, 0.0, 0.0, aside], [first, 0.0, 0.0, aside]];
    coil.extend(teeth.map(|(k, x)| [*x, 0.0, 0.0, aside + [-5.5, 5.5][k % 2]]));
    coil.extend([[last, 0.0, 0.0, aside], [1.0 - lead, 0.0, 0.0, aside]]);
    lines(symbol, aside, vec![coil])
}

/// A cup with a piston in it.
pub fn dashpot(symbol: &Symbol, aside: f64) -> Vec<Item> {
    let at = |px: f64, py: f64| -> Row { [0.5, 0.0, px, aside + py] };
    let first = lead(aside);
    let rod = vec![[first, 0.0, 0.0, aside], at(-3.0, 0.0)];
    let piston = vec![at(-3.0, -3.5), at(-3.0, 3.5)];
    let cup = vec![at(-11.0, 5.0), at(10.0, 5.0), at(10.0, -5.0), at(-11.0, -5.0)];
    let end = vec![at(10.0, 0.0), [1.0 - first, 0.0, 0.0, aside]];
    lines(symbol, aside, vec![rod, piston, cup, end])
}

/// Start of a line: at its end, or at the bar if it is drawn beside another.
fn lead(aside: f64) -> f64 {
    if aside == 0.0 {
        0.0
    } else {
        BAR
    }
}

fn lines(symbol: &Symbol, aside: f64, mut lines: Vec<Vec<Row>>) -> Vec<Item> {
    let (of, ends) = (&symbol.element, [symbol.at_i(), symbol.at_j()]);
    let frame = Frame::Line { bodies: symbol.bodies, ends, room: ROOM };
    if aside > 0.0 {
        // the bars that both symbols share are drawn once
        for (bar, end) in [(BAR, 0.0), (1.0 - BAR, 1.0)] {
            lines.push(vec![[bar, 0.0, 0.0, aside], [bar, 0.0, 0.0, -aside]]);
            lines.push(vec![[bar, 0.0, 0.0, 0.0], [end, 0.0, 0.0, 0.0]]);
        }
    }
    let line = |rows| Item::line(of, &frame, rows, "force", FORCE);
    let mut found: Vec<Item> = lines.into_iter().map(line).collect();
    if aside > 0.0 {
        return found;
    }
    for k in [0, 1] {
        match symbol.bodies[k] {
            // on ground, the end turns on a pin, like a joint
            0 => found.extend(pin_at(symbol, k)),
            body => {
                let (frame, dot) = (Frame::upright(body, ends[k]), printed(circle(2.0, 32)));
                found.push(Item::fill(of, &frame, dot, "force").on(layer::PIN));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::lengths;

    #[test]
    fn a_stroke_fits_in_its_barrel() {
        for [low, high] in [[1.0, 1.0], [1.0, 1.5], [1.0, 1.84], [2.0, 2.1]] {
            let (barrel, rod) = lengths([low, high]);
            assert!(barrel < low);
            assert!(
                [low, high].iter().all(|x| (0.0..=barrel).contains(&(x - rod))),
                "{low} {high}"
            );
        }
    }
}
