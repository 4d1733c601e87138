//! The items of a body: a link around its points or its outline, and its curves.

use super::items::{colour_of, layer, metres, Frame, Item, Row};
use super::shapes::circle;
use crate::plane::{ahead, minus, At, Extent};
use crate::scene::{Body, PartForm, Symbol};
use std::f64::consts::TAU;

/// Radius of a spot, and widths of a link, of its edges, and of curves, in points of print.
const SPOT: f64 = 7.0;
const LINK: f64 = 8.0;
const EDGE: f64 = 1.0;
const CURVE: f64 = 1.4;
const TINT: f64 = 0.72;
/// Positions along a body, as fractions of its length, that are tried in order for its number.
const SHARES: [f64; 7] = [0.5, 0.35, 0.65, 0.25, 0.75, 0.15, 0.85];

/// Draws a moving body, or the outline of ground.
pub fn draw(body: &Body) -> Vec<Item> {
    match body.number {
        _ if !body.drawn.is_empty() => drawn(body),
        0 => Vec::new(),
        _ if body.outline.is_empty() => Vec::new(),
        _ if is_plate(body) => Vec::new(),
        _ => link(body),
    }
}

/// Whether a closed curve contains all points of a body. Only the curve is then drawn.
fn is_plate(body: &Body) -> bool {
    let around = |ring: &&[At]| body.outline.iter().all(|at| winding(&[ring], *at) != 0);
    rings(body).iter().any(around)
}

/// The closed curves of a body, m.
fn rings(body: &Body) -> Vec<&[At]> {
    let closed = body.curves.iter().filter(|curve| curve.closed);
    closed.map(|curve| curve.points.as_slice()).collect()
}

/// Positions on a moving body, m, in order of preference for its number.
pub fn middles(body: &Body) -> Vec<At> {
    let areas = body.drawn.iter().filter(|part| part.form == PartForm::Area);
    let mut areas: Vec<&[At]> = areas.map(|part| part.points.as_slice()).collect();
    let mut corners: Vec<At> = body.drawn.iter().flat_map(|part| part.points.clone()).collect();
    if body.drawn.is_empty() {
        corners.clone_from(&body.outline);
        if corners.len() > 1 && is_plate(body) {
            areas = rings(body);
        } else if let ([curve, ..], 1) = (&body.curves[..], corners.len()) {
            corners.clone_from(&curve.points);
        }
    }
    let mut across = vec![(0, corners.len() / 2)];
    let largest = areas.iter().rev().max_by(|a, b| extent(a).total_cmp(&extent(b)));
    if let Some(largest) = largest {
        corners = largest.to_vec();
        let n = corners.len();
        across = vec![(0, n / 2), (n / 4, 3 * n / 4), (n / 8, 5 * n / 8), (3 * n / 8, 7 * n / 8)];
    }
    let mut found = vec![mean(&corners), body.center];
    for (first, last) in across {
        let (Some(&first), Some(&last)) = (corners.get(first), corners.get(last)) else { continue };
        found.extend(SHARES.map(|share| ahead(first, share, minus(last, first))));
    }
    found.retain(|at| areas.is_empty() || winding(&areas, *at) != 0);
    found
}

fn extent(points: &[At]) -> f64 {
    Extent::of(points.iter().copied()).size()
}

fn mean(points: &[At]) -> At {
    let sum = points.iter().fold([0.0; 2], |sum, at| ahead(sum, 1.0, *at));
    sum.map(|x| x / points.len().max(1) as f64)
}

/// Winding number of closed lines around a point, counter-clockwise.
fn winding(rings: &[&[At]], at: At) -> i64 {
    let mut turns = 0.0;
    for ring in rings {
        let angle = |k: usize| {
            let [x, y] = minus(ring[k % ring.len()], at);
            y.atan2(x)
        };
        for k in 0..ring.len() {
            let step = angle(k + 1) - angle(k);
            turns += step - TAU * (step / TAU).round_ties_even();
        }
    }
    (turns / TAU).round() as i64
}

/// The curves of a body: areas if they are closed, lines if they are open.
pub fn rims(body: &Body) -> Vec<Item> {
    let (of, frame, colour) = looks(body);
    let mut found = Vec::new();
    for curve in &body.curves {
        let rows = metres(curve.points.iter().copied());
        if curve.closed && body.number > 0 {
            let fill = Item::fill(of, &frame, rows.clone(), &colour);
            found.push(fill.on(layer::GROUND).tinted(TINT));
        }
        let line = Item::line(of, &frame, rows, &colour, CURVE).on(layer::GROUND);
        found.push(if curve.closed { line.closed() } else { line });
    }
    found
}

/// Name, frame and colour of a body.
fn looks(body: &Body) -> (&str, Frame, String) {
    let colour = if body.number == 0 { "ground".to_string() } else { colour_of(body.number) };
    (&body.name, Frame::on(body.number, [0.0; 2]), colour)
}

/// A rounded bar or plate: a wide dark line with a narrower light line on top.
fn link(body: &Body) -> Vec<Item> {
    let (of, frame, colour) = looks(body);
    let line = |rows: &[Row], width: f64| {
        Item::line(of, &frame, rows.to_vec(), &colour, width).on(layer::BODY)
    };
    let fill =
        |rows: &[Row]| Item::fill(of, &frame, rows.to_vec(), &colour).on(layer::BODY).tinted(TINT);
    if let [end] = body.outline[..] {
        let rim = circle(SPOT, 32).into_iter().map(|[x, y]| [end[0], end[1], x, y]);
        let rows: Vec<Row> = rim.collect();
        return vec![fill(&rows), line(&rows, EDGE).closed()];
    }
    let rows = metres(body.outline.iter().copied());
    let (edge, inside) = (line(&rows, LINK + 2.0 * EDGE), line(&rows, LINK).tinted(TINT));
    match rows.len() > 2 {
        true => vec![edge.closed(), fill(&rows), inside.closed()],
        false => vec![edge, inside],
    }
}

/// A part of a beam. Its edge lies below the bodies, so that the edge of the next part does not cover it.
pub fn beam(symbol: &Symbol, number: usize) -> Vec<Item> {
    let frame = Frame::between(symbol.bodies, [symbol.at_i(), symbol.at_j()]);
    let line = |width: f64| {
        let rows = vec![[0.0; 4], [1.0, 0.0, 0.0, 0.0]];
        Item::line(&symbol.element, &frame, rows, &colour_of(number), width)
    };
    let edge = line(LINK + 2.0 * EDGE).on(layer::GROUND);
    vec![edge, line(LINK).on(layer::BODY).tinted(TINT)]
}

/// All edges, then all areas on top of them, so that only the outer edge of the union remains visible.
fn drawn(body: &Body) -> Vec<Item> {
    let (of, frame, colour) = looks(body);
    let above = if body.number == 0 { layer::GROUND } else { layer::BODY };
    let parts = |form: PartForm| -> Vec<Vec<Row>> {
        let own = body.drawn.iter().filter(|part| part.form == form);
        own.map(|part| metres(part.points.iter().copied())).collect()
    };
    let line = |rows: &Vec<Row>, width: f64| {
        Item::line(of, &frame, rows.clone(), &colour, width).on(above)
    };
    let (areas, rods) = (parts(PartForm::Area), parts(PartForm::Rod));
    let mut found: Vec<Item> = areas.iter().map(|rows| line(rows, 2.0 * EDGE).closed()).collect();
    found.extend(rods.iter().map(|rows| line(rows, LINK + 2.0 * EDGE)));
    if !areas.is_empty() {
        found.push(Item::fill(of, &frame, joined(&areas), &colour).on(above).tinted(TINT));
    }
    found.extend(rods.iter().map(|rows| line(rows, LINK).tinted(TINT)));
    found.extend(parts(PartForm::Line).iter().map(|rows| line(rows, CURVE)));
    found
}

/// Joins closed lines to one line: from the first point to each ring, around it, and back.
///
/// The paths to a ring and back coincide, so the winding number of every point is the sum of the winding numbers of
/// the rings. Areas are filled where it is nonzero, and a hole is a ring with the opposite sense.
fn joined(rings: &[Vec<Row>]) -> Vec<Row> {
    let start = rings.iter().flatten().next().copied();
    let one = |ring: &Vec<Row>| -> Vec<Row> {
        ring.iter().chain(ring.first()).copied().chain(start).collect()
    };
    rings.iter().flat_map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::{joined, middles, winding};
    use crate::plane::At;
    use crate::scene::{Body, Part, PartForm};

    const SQUARE: [At; 4] = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    const HOLE: [At; 4] = [[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]];

    #[test]
    fn a_hole_is_a_ring_of_the_other_sense() {
        let around = |at| winding(&[&SQUARE, &HOLE], at);
        assert_eq!([[0.5, 0.5], [2.0, 2.0], [5.0, 2.0]].map(around), [1, 0, 0]);
        let rows = |ring: [At; 4]| ring.map(|[x, y]| [x, y, 0.0, 0.0]).to_vec();
        let line = joined(&[rows(SQUARE), rows(HOLE)]);
        let line: Vec<At> = line.iter().map(|row| [row[0], row[1]]).collect();
        let around = |at| winding(&[&line], at);
        assert_eq!([[0.5, 0.5], [2.0, 2.0], [5.0, 2.0]].map(around), [1, 0, 0]);
    }

    #[test]
    fn a_number_is_not_in_a_hole() {
        let part = |points: [At; 4]| Part { form: PartForm::Area, points: points.to_vec() };
        let body = Body {
            name: "frame".into(),
            number: 1,
            kind: "body".into(),
            points: vec![],
            center: [2.0, 2.0],
            outline: vec![[2.0, 2.0]],
            drawn: vec![part(SQUARE), part(HOLE)],
            curves: vec![],
        };
        let found = middles(&body);
        assert!(!found.is_empty());
        assert!(found.iter().all(|at| winding(&[&SQUARE, &HOLE], *at) == 1));
    }
}
