//! Closed lines of straight pieces and arcs.

/// A corner, and the bulge of the piece after it: the tangent of a quarter of its angle, positive counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub(super) at: [f64; 2],
    pub(super) bulge: f64,
}

/// Straight pieces in place of an arc, for its mass.
const PIECES: usize = 64;

/// The radius of the arc between two corners.
fn radius(from: [f64; 2], to: [f64; 2], bulge: f64) -> f64 {
    let chord = (to[0] - from[0]).hypot(to[1] - from[1]);
    chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs())
}

/// The corners of a closed line, with arcs in pieces.
pub(super) fn corners(line: &[Corner]) -> Vec<[f64; 2]> {
    let mut found = Vec::new();
    for (k, corner) in line.iter().enumerate() {
        let (from, to) = (corner.at, line[(k + 1) % line.len()].at);
        found.push(from);
        if corner.bulge == 0.0 {
            continue;
        }
        // from the middle of the chord, the centre lies to the left by this share of the chord
        let side = (1.0 - corner.bulge * corner.bulge) / (4.0 * corner.bulge);
        let center = [
            f64::midpoint(from[0], to[0]) - side * (to[1] - from[1]),
            f64::midpoint(from[1], to[1]) + side * (to[0] - from[0]),
        ];
        let (dx, dy) = (from[0] - center[0], from[1] - center[1]);
        for piece in 1..PIECES {
            let angle = 4.0 * corner.bulge.atan() * piece as f64 / PIECES as f64;
            let (sin, cos) = angle.sin_cos();
            found.push([center[0] + cos * dx - sin * dy, center[1] + sin * dx + cos * dy]);
        }
    }
    found
}

/// The closed line as an SVG path with y upwards.
pub(super) fn path(line: &[Corner]) -> String {
    let mut out = format!("M {} {}", line[0].at[0], line[0].at[1]);
    for (k, corner) in line.iter().enumerate() {
        let (from, to) = (corner.at, line[(k + 1) % line.len()].at);
        if corner.bulge == 0.0 {
            out += &format!(" L {} {}", to[0], to[1]);
        } else {
            let r = radius(from, to, corner.bulge);
            let (large, left) = (u8::from(corner.bulge.abs() > 1.0), u8::from(corner.bulge > 0.0));
            out += &format!(" A {r} {r} 0 {large} {left} {} {}", to[0], to[1]);
        }
    }
    out + " Z"
}

/// Area, centre and second moment of area about it.
pub(super) fn area(line: &[Corner]) -> (f64, [f64; 2], f64) {
    let all = corners(line);
    let origin = all[0];
    let (mut sum, mut first, mut second) = (0.0, [0.0; 2], 0.0);
    for (k, a) in all.iter().enumerate() {
        let b = all[(k + 1) % all.len()];
        let (ax, ay, bx, by) =
            (a[0] - origin[0], a[1] - origin[1], b[0] - origin[0], b[1] - origin[1]);
        let twice = ax * by - bx * ay;
        sum += twice / 2.0;
        first = [first[0] + twice * (ax + bx) / 6.0, first[1] + twice * (ay + by) / 6.0];
        second += twice * (ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by) / 12.0;
    }
    let center = first.map(|moment| moment / sum);
    let about = second - sum * (center[0] * center[0] + center[1] * center[1]);
    (sum.abs(), [origin[0] + center[0], origin[1] + center[1]], about.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn two_half_circles_are_a_disc() {
        let half = |x: f64| Corner { at: [x, 1.0], bulge: 1.0 };
        let (area, center, second) = area(&[half(3.0), half(-1.0)]);
        assert!(
            (area - 4.0 * PI).abs() < 1e-2 && (second - 8.0 * PI).abs() < 4e-2,
            "{area} {second}"
        );
        assert!((center[0] - 1.0).abs() < 1e-12 && (center[1] - 1.0).abs() < 1e-12);
        assert_eq!(path(&[half(3.0), half(-1.0)]), "M 3 1 A 2 2 0 0 1 -1 1 A 2 2 0 0 1 3 1 Z");
    }

    #[test]
    fn a_rectangle_has_its_moments_in_either_sense() {
        let corners =
            [[1.0, 2.0], [5.0, 2.0], [5.0, 4.0], [1.0, 4.0]].map(|at| Corner { at, bulge: 0.0 });
        let mut other = corners;
        other.reverse();
        for line in [corners, other] {
            let (area, center, second) = area(&line);
            assert!((area - 8.0).abs() < 1e-12 && (second - 8.0 * 20.0 / 12.0).abs() < 1e-11);
            assert_eq!(center, [3.0, 3.0]);
        }
    }
}
