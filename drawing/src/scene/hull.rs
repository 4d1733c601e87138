//! The convex hull of points.

use crate::plane::{minus, At, Extent};
use std::cmp::Ordering;

/// Points whose distance from a line is below this fraction of its length lie on it.
const STRAIGHT: f64 = 1e-9;

/// The convex hull of points, counter-clockwise. If all points lie on a line, its two ends.
///
/// Andrew's monotone chain (Inf. Proc. Lett. 9, 1979).
pub fn hull(mut points: Vec<At>) -> Vec<At> {
    let size = Extent::of(points.iter().copied()).size();
    points.sort_by(order);
    points.dedup();
    if size == 0.0 {
        points.truncate(1);
        return points;
    }
    let least = STRAIGHT * size * size;
    let mut lower = chain(points.iter(), least);
    let mut upper = chain(points.iter().rev(), least);
    lower.pop();
    upper.pop();
    lower.extend(upper);
    lower
}

fn order(a: &At, b: &At) -> Ordering {
    a.partial_cmp(b).unwrap_or(Ordering::Equal)
}

fn chain<'a>(points: impl Iterator<Item = &'a At>, least: f64) -> Vec<At> {
    let mut kept: Vec<At> = Vec::new();
    for &point in points {
        while let [.., a, b] = kept[..] {
            if turn(a, b, point) > least {
                break;
            }
            kept.pop();
        }
        kept.push(point);
    }
    kept
}

fn turn(a: At, b: At, c: At) -> f64 {
    let (one, other) = (minus(b, a), minus(c, a));
    one[0] * other[1] - one[1] * other[0]
}

#[cfg(test)]
mod tests {
    use super::hull;

    #[test]
    fn inner_points_and_points_on_edges_are_left_out() {
        let square = vec![[1., 1.], [0., 0.], [0.5, 0.], [1., 0.], [0.3, 0.4], [0., 1.], [0., 0.]];
        assert_eq!(hull(square), [[0., 0.], [1., 0.], [1., 1.], [0., 1.]]);
        assert_eq!(hull(vec![[2., 2.], [0., 0.], [1., 1.]]), [[0., 0.], [2., 2.]]);
        assert_eq!(hull(vec![[2., 2.], [2., 2.]]), [[2., 2.]]);
    }
}
