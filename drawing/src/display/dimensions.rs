//! Lengths of bars and distances of ground pins, as on a technical drawing.

use super::items::{layer, Frame, Item, Row};
use super::layout::taken;
use super::list::List;
use super::shapes::{arrow_head, spread};
use super::taken::{clipped_length, Taken};
use super::text::{size_of, Role};
use crate::numbers::general;
use crate::plane::{ahead, dot, left_of, minus, placed, size, At};
use kempe::elements::Mark;
use std::f64::consts::PI;

/// Distances of a dimension line from its object that are tried in order, points.
const DISTANCES: [f64; 3] = [20.0, 32.0, 44.0];
/// Largest number of lengths on a drawing.
const MOST: usize = 7;
const HEAD: f64 = 6.0;
/// Width of the lines.
const WIDTH: f64 = 0.6;
/// Number of positions along a dimension line at which it is compared with other items, and required clearance.
const COMPARED: usize = 13;
const ROOM: f64 = 3.0;

/// Two bodies and a point of each.
type Span = ([usize; 2], [At; 2]);

/// Adds a dimension line for each bar, and between two pins on ground.
pub fn add(made: &mut List<'_>) {
    let scene = made.scene;
    let bars = scene.bodies.iter().filter(|body| body.number > 0);
    let bar = |body: &crate::scene::Body| match body.outline[..] {
        [a, b] => Some(([body.number; 2], [a, b])),
        _ => None,
    };
    let mut spans: Vec<Span> = bars.filter_map(bar).collect();
    let pins = scene.symbols.iter().filter(|of| matches!(of.mark, Mark::Pin | Mark::Rod));
    let grounded: Vec<At> =
        pins.filter_map(|pin| pin.ends().find(|(body, _)| *body == 0).map(|(_, at)| at)).collect();
    if let [a, b] = grounded[..] {
        if a != b {
            spans.push(([0; 2], [a, b]));
        }
    }
    if spans.len() <= MOST {
        spans.into_iter().for_each(|span| add_one(made, span));
    }
}

fn add_one(made: &mut List<'_>, (bodies, ends): Span) {
    let places = [0, 1].map(|k| placed(made.poses[0][bodies[k]], ends[k]));
    let unit = &made.scene.length;
    let length = size(minus(places[1], places[0]));
    let words = format!("{} {}", general(length / unit.metres, 4), unit.unit);
    let dots = places.map(|at| made.view.points(at));
    let apart = size(minus(dots[1], dots[0]));
    if apart == 0.0 {
        return;
    }
    let along = minus(dots[1], dots[0]).map(|x| x / apart);
    let [width, height] = size_of(&words, Role::Measure);
    let [c, s] = along.map(f64::abs);
    let (wide, high) = (width / 2.0 + 2.0, height / 2.0);
    let aside = best_distance(made, dots, along, [c * wide + s * high, s * wide + c * high]);
    let (frame, of) = (Frame::between(bodies, ends), format!("length {words}"));
    // If the points are too close, the text is beside them and the arrows point inwards.
    let near = apart < width + 2.0 * HEAD;
    let out = if near { 1.8 * HEAD } else { 0.0 };
    let line = |rows: Vec<Row>| Item::line(&of, &frame, rows, "quiet", WIDTH).on(layer::GROUND);
    for (x, away) in [(0.0, PI), (1.0, 0.0)] {
        made.items.push(line(vec![[x, 0.0, 0.0, 0.0], [x, 0.0, 0.0, 1.15 * aside]]));
        let tip = arrow_head([0.0, aside], away + if near { PI } else { 0.0 }, HEAD);
        let rows = tip.map(|[px, py]| [x, 0.0, px, py]).to_vec();
        made.items.push(Item::fill(&of, &frame, rows, "quiet").on(layer::GROUND));
    }
    made.items.push(line(vec![[0.0, 0.0, -out, aside], [1.0, 0.0, out, aside]]));
    let row = match near {
        true => [1.0, 0.0, out + width / 2.0 + 2.0, aside],
        false => [0.5, 0.0, 0.0, aside],
    };
    made.items.push(Item::text(&of, &frame, row, &words, Role::Measure).along());
}

/// The side and distance at which the line meets the fewest items. Small distances on the side away from the middle
/// of the view are preferred.
fn best_distance(made: &List<'_>, dots: [At; 2], along: At, half: At) -> f64 {
    let normal = left_of(along);
    let middle = ahead(dots[0], 0.5, minus(dots[1], dots[0]));
    let outside = dot(normal, minus(middle, made.view.size.map(|x| x / 2.0))) >= 0.0;
    let sides = if outside { [1.0, -1.0] } else { [-1.0, 1.0] };
    let taken = taken(made);
    let aways = DISTANCES.iter().flat_map(|away| sides.map(|side| side * away));
    let mut best = (usize::MAX, 0.0);
    for away in aways {
        let cost = touched(&taken, dots.map(|at| ahead(at, away, normal)), half);
        if cost < best.0 {
            best = (cost, away);
        }
    }
    best.1
}

/// Number of lines and text boxes that cover a dimension line, at positions along it.
fn touched(taken: &Taken, [begin, end]: [At; 2], half: At) -> usize {
    let mut cost = 0;
    for share in spread(0.05, 0.95, COMPARED) {
        let centre = ahead(begin, share, minus(end, begin));
        let room = if 0.35 < share && share < 0.65 { half } else { [ROOM; 2] };
        let covers = |(ends, wide): (&[At; 2], &f64)| {
            let grown = room.map(|x| x + wide);
            clipped_length(minus(centre, grown), ahead(centre, 1.0, grown), ends) > 0.0
        };
        cost += usize::from(taken.segments[0].iter().zip(&taken.reach).any(covers));
        let (low, high) = (minus(centre, room), ahead(centre, 1.0, room));
        let over = |b: &&[f64; 4]| (0..2).all(|k| b[k + 2] > low[k] && b[k] < high[k]);
        cost += taken.boxes[0].iter().filter(over).count();
    }
    cost
}

#[cfg(test)]
mod tests {
    use super::{touched, Taken};

    fn cost(lines: &[[[f64; 2]; 2]], boxes: &[[f64; 4]], reach: f64) -> usize {
        let taken = Taken {
            segments: vec![lines.to_vec()],
            reach: vec![reach; lines.len()],
            boxes: vec![boxes.to_vec()],
            inside: [[0.0; 2], [400.0, 300.0]],
        };
        touched(&taken, [[0.0, 0.0], [100.0, 0.0]], [10.0, 5.0])
    }

    /// At 50 points the text has a box of ±10 and ±5, and also at 42.5 and 57.5 points.
    #[test]
    fn what_covers_the_text_is_counted() {
        assert_eq!(cost(&[], &[], 0.0), 0);
        assert_eq!(cost(&[[[50., 4.], [50., 4.5]]], &[], 0.0), 3);
        assert_eq!(cost(&[[[50., 5.5], [50., 6.]]], &[], 0.0), 0);
        assert_eq!(cost(&[[[50., 5.5], [50., 6.]]], &[], 1.0), 3);
        assert_eq!(cost(&[], &[[48., 4., 52., 8.]], 0.0), 3);
        assert_eq!(cost(&[], &[[48., 4., 52., 8.], [48., -8., 52., -4.]], 0.0), 6);
        assert_eq!(cost(&[], &[[48., 5., 52., 8.]], 0.0), 0);
        assert_eq!(cost(&[], &[[48., -8., 52., -5.]], 0.0), 0);
    }

    /// Elsewhere the line keeps 3 points free. At each of 13 positions, two lines count once.
    #[test]
    fn what_covers_the_line_is_counted() {
        assert_eq!(cost(&[[[12.5, 2.], [12.5, 2.5]]], &[], 0.0), 1);
        assert_eq!(cost(&[[[12.5, 4.], [12.5, 4.5]]], &[], 0.0), 0);
        assert_eq!(cost(&[[[12.5, 4.], [12.5, 4.5]]], &[], 2.0), 1);
        assert_eq!(cost(&[], &[[15., -1., 15.4, 1.]], 0.0), 1);
        assert_eq!(cost(&[], &[[9., -1., 10., 1.]], 0.0), 1);
        assert_eq!(cost(&[], &[[8., -1., 9.5, 1.]], 0.0), 0);
        assert_eq!(cost(&[[[-10., 0.], [110., 0.]]], &[], 0.0), 13);
        let two = [[[-10., 0.], [110., 0.]], [[-10., 1.], [110., 1.]]];
        assert_eq!(cost(&two, &[], 0.0), 13);
        assert_eq!(cost(&[], &[[-10., -1., 110., 1.]], 0.0), 13);
    }
}
