//! The arrow of gravity in a corner.

use super::items::{printed, Frame, Item};
use super::layout::taken;
use super::list::List;
use super::shapes::arrow_head;
use super::taken::{clipped_length, Taken};
use super::text::Role;
use crate::numbers::general;
use crate::plane::{ahead, minus, size, At};

/// Length of the arrow, points of print, and half sides of the space for it as multiples of the length.
const LENGTH: f64 = 30.0;
const ROOM: At = [1.6, 1.05];
const HEAD: f64 = 7.0;
/// Corners count as equal if their lengths of lines differ by less, so that rounding errors do not affect the choice.
const EQUAL: f64 = 1e-3;

/// Adds an arrow in the corner with the most free space.
pub fn add(made: &mut List<'_>) {
    let gravity = made.scene.gravity;
    let strength = size(gravity);
    if strength == 0.0 {
        return;
    }
    let along = gravity.map(|x| x / strength * LENGTH / 2.0);
    let at = made.view.plane(free_corner(&taken(made), made.view.size));
    let frame = Frame::upright(0, at);
    let shaft = printed([along.map(|x| -x), along.map(|x| 0.7 * x)]);
    let head = printed(arrow_head(along, along[1].atan2(along[0]), HEAD));
    made.items.push(Item::line("gravity", &frame, shaft, "ink", 1.0));
    made.items.push(Item::fill("gravity", &frame, head, "ink"));
    made.name(Role::Body, &format!("g = {} m/s²", general(strength, 4)), frame);
}

/// The centre of the arrow in the corner with the least length of lines; the first of equal corners.
fn free_corner(taken: &Taken, view: At) -> At {
    let room = ROOM.map(|x| x * LENGTH);
    let mut best = (f64::INFINITY, minus(view, room));
    for [right, up] in [[true, true], [false, true], [true, false], [false, false]] {
        let side = |k: usize, far: bool| if far { view[k] - room[k] } else { room[k] };
        let centre = [side(0, right), side(1, up)];
        let (low, high) = (minus(centre, room), ahead(centre, 1.0, room));
        let lines = taken.segments[0].iter();
        let over = |b: &&[f64; 4]| (0..2).all(|k| b[k + 2] > low[k] && b[k] < high[k]);
        let touched = lines.map(|ends| clipped_length(low, high, ends)).sum::<f64>()
            + taken.boxes[0].iter().filter(over).count() as f64;
        if touched < best.0 - EQUAL {
            best = (touched, centre);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::{free_corner, Taken};

    /// 1.6 and 1.05 lengths of 30 points from the edges: upper right, upper left, lower right, lower left.
    const CORNERS: [[f64; 2]; 4] = [[352.0, 268.5], [48.0, 268.5], [352.0, 31.5], [48.0, 31.5]];
    const SIZE: [f64; 2] = [400.0, 300.0];

    fn taken(lines: Vec<[[f64; 2]; 2]>, boxes: Vec<[f64; 4]>) -> Taken {
        let reach = vec![0.0; lines.len()];
        Taken { segments: vec![lines], reach, boxes: vec![boxes], inside: [[0.0; 2], SIZE] }
    }

    #[test]
    fn the_first_free_corner_is_taken() {
        for (k, corner) in CORNERS.into_iter().enumerate() {
            let before = &CORNERS[..k];
            let lines = before.iter().map(|[x, y]| [[x - 5.0, *y], [x + 5.0, *y]]).collect();
            assert_eq!(free_corner(&taken(lines, vec![]), SIZE), corner);
            let boxes = before.iter().map(|[x, y]| [x - 5.0, y - 5.0, x + 5.0, y + 5.0]).collect();
            assert_eq!(free_corner(&taken(vec![], boxes), SIZE), corner);
        }
    }

    #[test]
    fn if_none_is_free_it_is_the_one_with_the_shortest_lines() {
        let line = |([x, y], wide): (&[f64; 2], f64)| [[x - wide, *y], [x + wide, *y]];
        let lines = CORNERS.iter().zip([20.0, 30.0, 10.0, 15.0]).map(line).collect();
        assert_eq!(free_corner(&taken(lines, vec![]), SIZE), CORNERS[2]);
        // items that only touch the space of 48 × 31.5 points from outside are not in the corner
        let lines = vec![[[303.0, 268.0], [303.0, 200.0]]];
        let boxes = vec![[300.0, 200.0, 304.0, 290.0], [310.0, 200.0, 390.0, 237.0]];
        assert_eq!(free_corner(&taken(lines, boxes), SIZE), CORNERS[0]);
    }
}
