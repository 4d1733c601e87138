//! Positions of names: the areas that they must not cover, and the resulting texts.

use super::items::{layer, Frame, Item, Kind};
use super::labels::place_labels;
use super::list::{List, Name};
use super::numbered;
use super::taken::Taken;
use super::text::{size_of, Role};
use crate::plane::At;

/// Largest number of corners of an item that are considered.
const MOST: usize = 60;
/// Width of the hatching of ground beside a line, points of print.
const HATCHED: f64 = 4.0;

/// Writes all names at free positions.
pub fn lay_out(made: &mut List<'_>) {
    let names = std::mem::take(&mut made.names);
    if names.is_empty() {
        return;
    }
    let text = |name: &Name| {
        let half_way = if let Frame::Body { .. } = name.frame { 0.0 } else { 0.5 };
        Item::text(&name.of, &name.frame, [half_way, 0.0, 0.0, 0.0], &name.words, name.role)
    };
    let texts: Vec<Item> = names.iter().map(text).collect();
    let paths: Vec<Vec<Vec<At>>> = texts.iter().map(|one| made.placed(one)).collect();
    let anchors: Vec<Vec<At>> =
        (0..made.poses.len()).map(|t| paths.iter().map(|path| path[t][0]).collect()).collect();
    let sizes: Vec<At> = names.iter().map(|name| box_of(&name.words, name.role)).collect();
    let offsets = place_labels(&anchors, &sizes, taken(made));
    for (name, offset) in names.iter().zip(&offsets) {
        if name.role == Role::Number {
            made.items.extend(numbered::circled(&name.of, &name.frame, *offset));
        }
    }
    made.items.extend(texts.into_iter().zip(offsets).map(|(text, offset)| text.moved(offset)));
}

/// Width and height of a text. A number has a circle around it.
fn box_of(words: &str, role: Role) -> At {
    match role {
        Role::Number => [2.0 * numbered::RADIUS; 2],
        _ => size_of(words, role),
    }
}

/// Areas that names must not cover: lines, texts and the outside of the view.
pub fn taken(made: &List<'_>) -> Taken {
    let count = made.poses.len();
    let mut found = Taken {
        segments: vec![Vec::new(); count],
        reach: Vec::new(),
        boxes: vec![made.boxes.to_vec(); count],
        inside: [[0.0; 2], made.view.size],
    };
    for item in &made.items {
        match &item.kind {
            Kind::Text { text, role, .. } => {
                let centres = made.placed(item);
                found.add(centres.into_iter().map(|at| at[0]), box_of(text, *role));
            }
            _ if item.layer >= layer::NUMBER => {}
            Kind::Line { width, hatch, .. } => {
                let hatched = if *hatch == 0 { 0.0 } else { HATCHED };
                add_lines(&mut found, made, item, width / 2.0 + hatched);
            }
            Kind::Fill {} => add_lines(&mut found, made, item, 0.0),
        }
    }
    found
}

fn add_lines(found: &mut Taken, made: &List<'_>, item: &Item, reach: f64) {
    let item = thinned(item);
    for (segments, points) in found.segments.iter_mut().zip(made.placed(&item)) {
        segments.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
    }
    let count = item.points.len().saturating_sub(1);
    found.reach.extend(std::iter::repeat_n(reach, count));
}

fn thinned(item: &Item) -> Item {
    let mut item = item.clone();
    if let (Kind::Line { closed: true, .. }, Some(first)) = (&item.kind, item.points.first()) {
        item.points.push(*first);
    }
    if item.points.len() > MOST {
        let step = item.points.len() / MOST + 1;
        item.points = item.points.into_iter().step_by(step).collect();
    }
    item
}
