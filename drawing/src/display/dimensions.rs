//! Lengths of bars and distances of ground pins, as on a technical drawing.

use super::items::{Frame, Item, Row};
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
/// Length of a line beyond its arrows if they point inwards.
const OUT: f64 = 1.8 * HEAD;
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
    let mut lengths: Vec<Vec<Length>> = Vec::new();
    for one in spans.into_iter().filter_map(|span| Length::of(made, span)) {
        match lengths.iter_mut().find(|equal| equal[0].words == one.words) {
            Some(equal) => equal.push(one),
            None => lengths.push(vec![one]),
        }
    }
    if lengths.len() <= MOST {
        lengths.iter().for_each(|equal| add_equal(made, equal));
    }
}

/// A length and its text.
#[derive(Clone)]
struct Length {
    span: Span,
    dots: [At; 2],
    words: String,
}

impl Length {
    fn of(made: &List<'_>, (bodies, ends): Span) -> Option<Self> {
        let places = [0, 1].map(|k| placed(made.poses[0][bodies[k]], ends[k]));
        let unit = &made.scene.length;
        let length = size(minus(places[1], places[0]));
        let words = format!("{} {}", general(length / unit.metres, 4), unit.unit);
        (length > 0.0).then(|| Self {
            span: (bodies, ends),
            dots: places.map(|at| made.view.points(at)),
            words,
        })
    }

    /// The same length from its other end.
    fn reversed(&self) -> Self {
        let ((bodies, ends), dots) = (self.span, self.dots);
        let span = ([bodies[1], bodies[0]], [ends[1], ends[0]]);
        Self { span, dots: [dots[1], dots[0]], words: self.words.clone() }
    }
}

/// Adds the dimension line of each of several equal lengths if all of them have free positions. Otherwise one line stands
/// for all, at the best position, and its text gives their number.
fn add_equal(made: &mut List<'_>, equal: &[Length]) {
    let count = equal.len();
    let first = made.items.len();
    let mut drawn = 0;
    for one in equal {
        let place = Place::best(made, one, &one.words);
        if place.cost == 0 {
            place.add(made, &one.words);
            drawn += 1;
        }
    }
    if drawn == count {
        return;
    }
    made.items.truncate(first);
    let words = format!("{count} \u{d7} {}", equal[0].words);
    let words = if count == 1 { &equal[0].words } else { &words };
    let places = equal.iter().map(|one| Place::best(made, one, words));
    if let Some(place) = places.min_by_key(|place| place.cost) {
        place.add(made, words);
    }
}

/// A position of a dimension line.
struct Place {
    span: Span,
    /// Distance from the object, to its left, points.
    aside: f64,
    /// Whether the points are so close that the text is beside them and the arrows point inwards.
    near: bool,
    /// Number of items that the line and its text cover.
    cost: usize,
}

impl Place {
    /// The side and distance at which the line meets the fewest items. Small distances on the side away from the
    /// middle of the view are preferred.
    fn best(made: &List<'_>, of: &Length, words: &str) -> Self {
        let [width, height] = size_of(words, Role::Measure);
        let near = size(minus(of.dots[1], of.dots[0])) < width + 2.0 * HEAD;
        let taken = taken(made);
        let mut best = Self { span: of.span, aside: DISTANCES[0], near, cost: usize::MAX };
        let ways = if near { vec![of.clone(), of.reversed()] } else { vec![of.clone()] };
        for one in ways {
            let apart = minus(one.dots[1], one.dots[0]);
            let along = apart.map(|x| x / size(apart));
            let normal = left_of(along);
            let middle = ahead(one.dots[0], 0.5, apart);
            let outside = dot(normal, minus(middle, made.view.size.map(|x| x / 2.0))) >= 0.0;
            let sides = if outside { [1.0, -1.0] } else { [-1.0, 1.0] };
            let [c, s] = along.map(f64::abs);
            let (wide, high) = (width / 2.0 + 2.0, height / 2.0);
            let half = [c * wide + s * high, s * wide + c * high];
            for aside in DISTANCES.iter().flat_map(|away| sides.map(|side| side * away)) {
                let line = one.dots.map(|at| ahead(at, aside, normal));
                let cost = match near {
                    false => touched(&taken, line, half, [0.35, 0.65]),
                    true => {
                        let out = [-OUT, OUT + width + 4.0];
                        let line = [0, 1].map(|k| ahead(line[k], out[k], along));
                        let text = 1.0 - (width + 4.0) / size(minus(line[1], line[0]));
                        touched(&taken, line, [ROOM, height / 2.0], [text, 1.0])
                    }
                };
                if cost < best.cost {
                    best = Self { span: one.span, aside, near, cost };
                }
            }
        }
        best
    }

    fn add(&self, made: &mut List<'_>, words: &str) {
        let Self { span: (bodies, ends), aside, near, .. } = *self;
        let (frame, of) = (Frame::between(bodies, ends), format!("length {words}"));
        let out = if near { OUT } else { 0.0 };
        let line = |rows: Vec<Row>| Item::line(&of, &frame, rows, "quiet", WIDTH);
        for (x, away) in [(0.0, PI), (1.0, 0.0)] {
            made.items.push(line(vec![[x, 0.0, 0.0, 0.0], [x, 0.0, 0.0, 1.15 * aside]]));
            let tip = arrow_head([0.0, aside], away + if near { PI } else { 0.0 }, HEAD);
            let rows = tip.map(|[px, py]| [x, 0.0, px, py]).to_vec();
            made.items.push(Item::fill(&of, &frame, rows, "quiet"));
        }
        made.items.push(line(vec![[0.0, 0.0, -out, aside], [1.0, 0.0, out, aside]]));
        let width = size_of(words, Role::Measure)[0];
        let row = match near {
            true => [1.0, 0.0, out + width / 2.0 + 2.0, aside],
            false => [0.5, 0.0, 0.0, aside],
        };
        made.items.push(Item::text(&of, &frame, row, words, Role::Measure).along());
    }
}

/// Number of lines and text boxes that cover a dimension line, at positions along it, and of positions outside of the
/// view. Its text has the given half size and lies between two fractions of the line.
fn touched(taken: &Taken, [begin, end]: [At; 2], half: At, text: [f64; 2]) -> usize {
    let mut cost = 0;
    for share in spread(0.05, 0.95, COMPARED) {
        let centre = ahead(begin, share, minus(end, begin));
        let room = if text[0] < share && share < text[1] { half } else { [ROOM; 2] };
        let covers = |(ends, wide): (&[At; 2], &f64)| {
            let grown = room.map(|x| x + wide);
            clipped_length(minus(centre, grown), ahead(centre, 1.0, grown), ends) > 0.0
        };
        cost += usize::from(taken.segments[0].iter().zip(&taken.reach).any(covers));
        let (low, high) = (minus(centre, room), ahead(centre, 1.0, room));
        let over = |b: &&[f64; 4]| (0..2).all(|k| b[k + 2] > low[k] && b[k] < high[k]);
        cost += taken.boxes[0].iter().filter(over).count();
        let [least, most] = taken.inside;
        cost += usize::from((0..2).any(|k| low[k] < least[k] || high[k] > most[k]));
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
            inside: [[-400.0, -300.0], [400.0, 300.0]],
        };
        touched(&taken, [[0.0, 0.0], [100.0, 0.0]], [10.0, 5.0], [0.35, 0.65])
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

    /// The text sticks out of the view to the left at one position, below it at three.
    #[test]
    fn what_is_outside_of_the_view_is_counted() {
        let taken = |least: [f64; 2]| Taken {
            segments: vec![vec![]],
            reach: vec![],
            boxes: vec![vec![]],
            inside: [least, [400.0, 300.0]],
        };
        let cost =
            |least| touched(&taken(least), [[0.0, 0.0], [100.0, 0.0]], [10.0, 5.0], [0.35, 0.65]);
        assert_eq!(cost([-5.0, -5.0]), 0);
        assert_eq!(cost([3.0, -5.0]), 1);
        assert_eq!(cost([-5.0, -4.0]), 3);
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
