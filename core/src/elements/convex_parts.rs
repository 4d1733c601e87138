//! The convex parts of a polygon, as lists of corners in counter-clockwise order.
//!
//! The polygon is divided into triangles by its diagonals (ear clipping). Triangles are then joined as long as they
//! stay convex (Hertel and Mehlhorn 1983), which gives at most four times the least number of parts.

use crate::math::{Listed, Local, ShortArray};

/// A corner turns by less than this angle, rad, if its two edges count as one line.
const FLAT: f64 = 1e-9;

/// The sine of the angle by which the way a, b, c turns to the left.
fn turn(a: Local, b: Local, c: Local) -> f64 {
    let (first, second) = (b - a, c - b);
    first.cross(second) / (first.norm() * second.norm())
}

/// Radius of the circle that takes the place of a corner, relative to the circumference. With it, two corners on each
/// other, as those of equal blocks, touch along the normal of an edge.
pub const CORNER: f64 = 1e-11;

/// The corners at which the material of a polygon has an angle of less than π: the centres of small circles that touch
/// both edges from inside, and their radius.
pub fn convex_corners(corners: &[Local]) -> (Vec<Local>, f64) {
    let n = corners.len();
    let length: f64 = (0..n).map(|k| (corners[(k + 1) % n] - corners[k]).norm()).sum();
    let radius = CORNER * length;
    let of = |k: usize| {
        let [a, b, c] = [corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]];
        let sine = turn(a, b, c);
        let [first, second] = [b - a, c - b].each(|way| way.scale(1.0 / way.norm()));
        // the sum of the directions of both edges away from the corner has the length 2 cos β and the height sin β cos β
        (sine > FLAT).then(|| b + (second - first).scale(radius / sine))
    };
    ((0..n).filter_map(of).list(), radius)
}

/// Twice the area, positive for corners in counter-clockwise order.
fn area(corners: &[Local]) -> f64 {
    let n = corners.len();
    let first = corners[0];
    (0..n).map(|k| (corners[k] - first).cross(corners[(k + 1) % n] - first)).sum()
}

/// The reason why a list of corners cannot be a polygon.
pub(super) fn fault(corners: &[Local]) -> Option<String> {
    let n = corners.len();
    if let Some(k) = (0..n).find(|k| !(corners[*k].norm().is_finite())) {
        return Some(format!("corner {} is not finite", k + 1));
    }
    if let Some(k) = (0..n).find(|k| corners[*k] == corners[(k + 1) % n]) {
        let hint = "a polygon closes itself";
        return Some(format!("corners {} and {} are the same; {hint}", k + 1, (k + 1) % n + 1));
    }
    let edge = |k: usize| [corners[k], corners[(k + 1) % n]];
    let pairs = (0..n).flat_map(|k| (k + 2..n).map(move |other| (k, other)));
    let mut apart = pairs.filter(|(k, other)| *k > 0 || other + 1 < n);
    if let Some((k, other)) = apart.find(|(k, other)| cross(edge(*k), edge(*other))) {
        let message = "which a polygon must not do";
        return Some(format!("the edges from corners {} and {} meet, {message}", k + 1, other + 1));
    }
    let folded = |k: &usize| {
        let [a, b, c] = [corners[(k + n - 1) % n], corners[*k], corners[(k + 1) % n]];
        turn(a, b, c).abs() <= FLAT && (b - a).dot(c - b) < 0.0
    };
    if let Some(k) = (0..n).find(folded) {
        return Some(format!("at corner {}, the polygon turns back on itself", k + 1));
    }
    (area(corners) <= 0.0).then(|| {
        "its corners are in clockwise order; list them counter-clockwise, so that the material is on the left".to_string()
    })
}

/// Whether two segments have a point in common.
fn cross([a, b]: [Local; 2], [c, d]: [Local; 2]) -> bool {
    let side = |p: Local, q: Local, r: Local| (q - p).cross(r - p);
    let (of_c, of_d) = (side(a, b, c), side(a, b, d));
    let (of_a, of_b) = (side(c, d, a), side(c, d, b));
    let within = |p: Local, q: Local, r: Local| {
        let along = (q - p).dot(r - p);
        along >= 0.0 && along <= (q - p).dot(q - p)
    };
    let on = |s: f64, p: Local, q: Local, r: Local| s == 0.0 && within(p, q, r);
    let proper = of_c * of_d < 0.0 && of_a * of_b < 0.0;
    proper || on(of_c, a, b, c) || on(of_d, a, b, d) || on(of_a, c, d, a) || on(of_b, c, d, b)
}

/// The convex parts that have an edge of the polygon, each with its corners, and whether the edge from each corner to the
/// next is one of the polygon.
pub fn convex_parts(corners: &[Local]) -> Vec<Vec<(Local, bool)>> {
    let mut parts = triangles(corners);
    let mut k = 0;
    while k < parts.len() {
        let joined = (k + 1..parts.len())
            .find_map(|other| Some((other, joined(corners, &parts[k], &parts[other])?)));
        match joined {
            Some((other, both)) => {
                parts[k] = both;
                parts.remove(other);
            }
            None => k += 1,
        }
    }
    let n = corners.len();
    let of = |part: Vec<usize>| {
        let next = part.iter().cycle().skip(1);
        part.iter().zip(next).map(|(a, b)| (corners[*a], (a + 1) % n == *b)).list()
    };
    let has_edge = |part: &Vec<(Local, bool)>| part.iter().any(|(_, own)| *own);
    parts.into_iter().map(of).filter(has_edge).list()
}

/// Triangles between the corners, by their indices.
fn triangles(corners: &[Local]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..corners.len()).list();
    let mut found = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let at = |k: usize| [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
        // the ear with the largest of the smallest angles avoids needles
        let ears = (0..n).filter(|k| is_ear(corners, at(*k), &left));
        let quality = |k: &usize| roundness(at(*k).each(|k| corners[k]));
        let Some(ear) = ears.max_by(|a, b| quality(a).total_cmp(&quality(b))) else { break };
        found.push(at(ear).to_vec());
        left.remove(ear);
    }
    found.push(left);
    found
}

/// The sine of the smallest angle of a triangle.
fn roundness([a, b, c]: [Local; 3]) -> f64 {
    turn(a, b, c).min(turn(b, c, a)).min(turn(c, a, b))
}

fn is_ear(corners: &[Local], ear: [usize; 3], left: &[usize]) -> bool {
    let [a, b, c] = ear.each(|k| corners[k]);
    if turn(a, b, c) <= 0.0 {
        return false;
    }
    let side = |p: Local, q: Local, r: Local| (q - p).cross(r - p);
    let inside = |p: Local| side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    left.iter().filter(|k| !ear.contains(k)).all(|k| !inside(corners[*k]))
}

/// Two parts with a common edge as one, if it is convex.
fn joined(corners: &[Local], one: &[usize], other: &[usize]) -> Option<Vec<usize>> {
    let (n, m) = (one.len(), other.len());
    // the edge from one[k] to one[k + 1] is the edge from other[l] to other[l + 1] in the other direction
    let common =
        |(k, l): &(usize, usize)| one[*k] == other[(l + 1) % m] && one[(k + 1) % n] == other[*l];
    let (k, l) = (0..n).flat_map(|k| (0..m).map(move |l| (k, l))).find(common)?;
    let first = (0..n).map(|step| one[(k + 1 + step) % n]);
    let second = (1..m - 1).map(|step| other[(l + 1 + step) % m]);
    let both: Vec<usize> = first.chain(second).list();
    let p = |at: usize| corners[both[at % both.len()]];
    let convex = |at: usize| turn(p(at + both.len() - 1), p(at), p(at + 1)) >= -FLAT;
    (0..both.len()).all(convex).then_some(both)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(all: &[[f64; 2]]) -> Vec<Local> {
        all.iter().map(|[x, y]| Local::new(*x, *y)).list()
    }

    #[test]
    fn convex_polygons_are_one_part() {
        let square = points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(convex_parts(&square).len(), 1);
        let (centres, radius) = convex_corners(&square);
        assert_eq!(centres.len(), 4);
        assert!(centres.iter().all(|s| {
            let off = f64::min(s.x.min(1.0 - s.x), s.y.min(1.0 - s.y));
            (off - radius).abs() < 1e-15
        }));
    }

    #[test]
    fn parts_fill_a_star_except_inside() {
        let corner = |k: usize| {
            let (r, angle) =
                (if k % 2 == 0 { 2.0 } else { 1.0 }, 0.1 + 0.3141592653589793 * k as f64);
            [r * angle.cos(), r * angle.sin()]
        };
        let star = points(&(0..20).map(corner).list());
        let parts = convex_parts(&star);
        let all: Vec<Vec<Local>> =
            parts.iter().map(|part| part.iter().map(|(s, _)| *s).list()).list();
        let ours: f64 = all.iter().map(|part| area(part)).sum();
        assert_eq!(parts.iter().flatten().filter(|(_, own)| *own).count(), 20);
        let inner = points(&(0..10).map(|k| corner(2 * k + 1)).list());
        let left = area(&star) - ours;
        assert!(left > -1e-12 && left < area(&inner) + 1e-12, "{left}");
        assert_eq!(convex_corners(&star).0.len(), 10);
        for part in all {
            assert!((0..part.len()).all(|k| {
                let n = part.len();
                turn(part[k], part[(k + 1) % n], part[(k + 2) % n]) >= -FLAT
            }));
        }
    }

    #[test]
    fn impossible_polygons_have_a_reason() {
        let bow = points(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]);
        assert!(fault(&bow).is_some_and(|message| message.contains("meet")));
        let clockwise = points(&[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]);
        assert!(fault(&clockwise).is_some_and(|message| message.contains("clockwise")));
        let needle = points(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]]);
        assert!(fault(&needle).is_some());
    }
}
