//! The names of the nodes of a beam, which follow from its entry without any number.
//!
//! The first node has the name of the beam. The others have names with a full stop, such as `rod.B`, which no body of a
//! file can have.

use super::definition::{Entry, Value};
use crate::math::{Listed, ShortArray};

/// The `type` of a beam.
pub const BEAM: &str = "beam";
/// The kind of the bodies that are the further nodes of a beam.
pub const NODE: &str = "node";
/// The end of the name of a weld of the rigid form.
pub const WELD: &str = " (rigid)";

/// The locks of stretch and shear, in the names of the constraints that keep a piece from either.
pub const LOCKS: [&str; 2] = ["inextensible", "unsheared"];

/// Whether a constraint locks the stretch of a piece of a beam.
pub fn is_stretch_lock(name: &str, beam: &str) -> bool {
    let piece = name.strip_prefix(beam).and_then(|of| of.strip_prefix('.'));
    piece.is_some_and(|of| of.strip_prefix(LOCKS[0]).is_some_and(|of| of.starts_with('_')))
}

/// Whether an entry of the bodies is a beam.
pub fn is_beam(entry: &Entry) -> bool {
    matches!(entry.get("type"), Some(Value::Text(kind)) if kind == BEAM)
}

/// Whether a constraint of this name is a weld of the rigid form.
pub fn is_weld(name: &str) -> bool {
    name.ends_with(WELD)
}

/// The name by which messages call a constraint: that of the beam for a weld of its rigid form.
pub fn shown(name: &str) -> &str {
    if is_weld(name) {
        beam_of(name)
    } else {
        name
    }
}

/// Whether a body is a node of a beam without a name of the file.
pub fn is_inner(name: &str) -> bool {
    name.contains(".#")
}

/// The name of the beam to which an item with a name made here belongs, such as `rod` for `rod.B`.
pub fn beam_of(name: &str) -> &str {
    name.split_once('.').map_or(name, |(beam, _)| beam)
}

/// Number of elements if it is not given: of a straight beam, and of a curved one, with at least one element between
/// two points of `through`.
const DEFAULT_ELEMENTS: usize = 4;
const CURVED_ELEMENTS: usize = 8;
/// Nodes that an element adds.
pub const PER_ELEMENT: usize = 3;

/// The names of the two ends.
pub fn ends(entry: &Entry) -> [String; 2] {
    if let Some(Value::List(items)) = entry.get("ends") {
        if let [Value::Text(first), Value::Text(last)] = &items[..] {
            return [first.clone(), last.clone()];
        }
    }
    ["A", "B"].each(str::to_string)
}

/// The named points as written.
pub fn points(entry: &Entry) -> &[(String, Value)] {
    match entry.get("points") {
        Some(Value::Table(points)) => points,
        _ => &[],
    }
}

/// The number of elements that is written.
pub fn written(entry: &Entry) -> Option<usize> {
    match entry.get("elements") {
        Some(Value::Number(x)) if x.fract() == 0.0 && (1.0..=MOST).contains(x) => Some(*x as usize),
        _ => None,
    }
}

/// Largest number of elements of a beam.
pub const MOST: f64 = 10_000.0;

/// The number of elements: at least one between two places with names, and two if no number is given.
pub fn elements(entry: &Entry) -> usize {
    let least = points(entry).len() + 1;
    let by_shape = match (entry.get("through"), entry.get("arc")) {
        (Some(Value::List(points)), _) if points.len() > 2 => CURVED_ELEMENTS.max(points.len() - 1),
        (_, Some(_)) => CURVED_ELEMENTS,
        _ => DEFAULT_ELEMENTS,
    };
    written(entry).unwrap_or(by_shape.max(2 * least)).max(least)
}

/// The name of node `k` between the places with names, counted along the beam.
pub fn inner(beam: &str, k: usize) -> String {
    format!("{beam}.#{}", k + 1)
}

/// The names of the nodes of a beam after the first one, in the order of the bodies: the last end, the named points
/// as written, then the nodes between them along the beam.
pub fn names(entry: &Entry) -> Vec<String> {
    let [_, last] = ends(entry);
    let named = points(entry).iter().map(|(point, _)| point.clone());
    let places = std::iter::once(last).chain(named);
    let places: Vec<String> = places.map(|place| format!("{}.{place}", entry.name)).list();
    let inner_nodes = PER_ELEMENT * elements(entry) - places.len();
    places.into_iter().chain((0..inner_nodes).map(|k| inner(&entry.name, k))).list()
}

/// The names of a moving body in the order of q: those of all its nodes, if it is a beam.
pub fn body_names(entry: &Entry) -> Vec<String> {
    let further = if is_beam(entry) { names(entry) } else { Vec::new() };
    std::iter::once(entry.name.clone()).chain(further).list()
}

/// A second name of the first node of a beam: that of the first end.
pub fn first_end(entry: &Entry) -> Option<String> {
    is_beam(entry).then(|| format!("{}.{}", entry.name, ends(entry)[0]))
}
