//! Positions of names that do not cover other items, at rest and while the mechanism moves.

use super::taken::{clipped_length, Taken};
use crate::plane::{ahead, direction, minus, size as length, At, Extent};

/// Number of directions from an anchor to its name, and gaps between them, points.
const DIRECTIONS: usize = 16;
const GAPS: [f64; 7] = [3.0, 7.0, 12.0, 18.0, 26.0, 36.0, 48.0];
/// Number of gaps that are used while the anchors move, because a name must not be far from its anchor.
const GAPS_IN_MOTION: usize = 4;
/// Clearance between a name and all other items.
const CLEARANCE: f64 = 2.0;
/// Additional clearance between adjacent names, so that they are not read as one name.
const BESIDE: f64 = 4.0;
/// Cost of contact with a line, per length of contact, relative to the cost of distance; and the same for a text.
const TOUCH: f64 = 10.0;
const COVER: f64 = 60.0;
/// Cost of a name that is closer to another anchor.
const MISLEADING: f64 = 40.0;
/// Shorter contacts are rounding errors, points.
const CONTACT: f64 = 1e-3;
/// Costs that differ by less count as equal, and the first position is used, so that rounding errors do not affect
/// it.
const EQUAL: f64 = 0.05;

/// Offsets from moving anchors to the centres of their names, clear of lines and of each other.
///
/// Greedy algorithm: the names are placed one by one, the longest first, each at the candidate with the least average
/// contact and the smallest distance. `anchors` are the anchors at each instant, points of print; `sizes` are widths
/// and heights.
pub fn place_labels(anchors: &[Vec<At>], sizes: &[At], mut taken: Taken) -> Vec<At> {
    let mut chosen = vec![[0.0; 2]; sizes.len()];
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|a, b| sizes[*b][0].total_cmp(&sizes[*a][0]));
    let gaps = if anchors.len() == 1 { &GAPS[..] } else { &GAPS[..GAPS_IN_MOTION] };
    for k in order {
        let candidates = candidates(sizes[k], gaps);
        let near = |(t, at): (usize, &Vec<At>)| taken.near(t, at[k], &candidates, half(sizes[k]));
        let near: Vec<Near> = anchors.iter().enumerate().map(near).collect();
        let share = 1.0 / anchors.len() as f64;
        let mut costs = Vec::with_capacity(candidates.len());
        let mut least = f64::INFINITY;
        for (gap, offset) in &candidates {
            // all costs are positive, so a sum that exceeds the least cost need not be completed
            let mut cost = *gap;
            for (at, near) in anchors.iter().zip(&near) {
                if cost > least + EQUAL {
                    break;
                }
                if is_nearer(at, k, *offset) {
                    cost += MISLEADING * share;
                }
                let room = (least + EQUAL - cost) / share;
                cost += share * near.cost(ahead(at[k], 1.0, *offset), sizes[k], room);
            }
            least = least.min(cost);
            costs.push(cost);
        }
        let first = costs.iter().position(|cost| *cost <= least + EQUAL);
        chosen[k] = candidates[first.unwrap_or(0)].1;
        taken.add(anchors.iter().map(|at| ahead(at[k], 1.0, chosen[k])), sizes[k]);
    }
    chosen
}

/// Half of the box of a name, including its clearance.
fn half(size: At) -> At {
    size.map(|x| x / 2.0 + CLEARANCE)
}

/// Whether a name of the k-th anchor with this offset is nearer to another anchor.
fn is_nearer(anchors: &[At], k: usize, offset: At) -> bool {
    let (own, centre) = (length(offset), ahead(anchors[k], 1.0, offset));
    let others = anchors.iter().enumerate().filter(|(other, _)| *other != k);
    others.into_iter().any(|(_, at)| length(minus(centre, *at)) < own - CONTACT)
}

/// Offsets at which the box of a name has one of the gaps from its anchor, each with its gap.
fn candidates(size: At, gaps: &[f64]) -> Vec<(f64, At)> {
    let ways = (1..=DIRECTIONS).map(|k| direction((k as f64 * 22.5).to_radians()));
    // together with the distance from the centre to the edge of the box
    let edge = |u: At| (size[0] / 2.0 / u[0]).abs().min((size[1] / 2.0 / u[1]).abs());
    let ways: Vec<(At, f64)> = ways.map(|u| (u, edge(u).min(length(size) / 2.0))).collect();
    let at = |gap: f64| ways.iter().map(move |(u, edge)| (gap, u.map(|x| (edge + gap) * x)));
    gaps.iter().flat_map(|gap| at(*gap)).collect()
}

/// The occupied areas near the candidates for one name at one instant.
struct Near {
    segments: Vec<([At; 2], f64)>,
    boxes: Vec<[f64; 4]>,
    inside: [At; 2],
}

impl Taken {
    fn near(&self, t: usize, anchor: At, candidates: &[(f64, At)], half: At) -> Near {
        let around = Extent::of(candidates.iter().map(|(_, by)| ahead(anchor, 1.0, *by)));
        let first = minus(around.low, half);
        let last = ahead(around.high, 1.0, half);
        let meets = |low: At, high: At, wide: f64| {
            (0..2).all(|k| low[k] - wide < last[k] && high[k] + wide > first[k])
        };
        let segments = self.segments[t].iter().zip(&self.reach);
        let segments = segments.filter(|([a, b], wide)| {
            let (low, high) = ([a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]);
            meets(low, high, **wide)
        });
        let boxes = self.boxes[t].iter();
        let boxes = boxes.filter(|b| meets([b[0], b[1]], [b[2], b[3]], BESIDE));
        Near {
            segments: segments.map(|(ends, wide)| (*ends, *wide)).collect(),
            boxes: boxes.copied().collect(),
            inside: self.inside,
        }
    }
}

impl Near {
    /// Overlap of the box of a name, points. If it exceeds `limit`, any number above `limit` may be returned.
    fn cost(&self, centre: At, size: At, limit: f64) -> f64 {
        let (low, high) = (minus(centre, half(size)), ahead(centre, 1.0, half(size)));
        let [least, largest] = self.inside;
        let outside = |k: usize| (least[k] - low[k]).max(0.0) + (high[k] - largest[k]).max(0.0);
        let mut cost = TOUCH * (outside(0) + outside(1));
        for [left, bottom, right, top] in &self.boxes {
            let across = (high[0] + BESIDE).min(*right) - (low[0] - BESIDE).max(*left);
            let up = high[1].min(*top) - low[1].max(*bottom);
            if across > CONTACT && up > CONTACT {
                cost += COVER * (across + up);
            }
        }
        for (ends, wide) in &self.segments {
            if cost > limit {
                break;
            }
            let (low, high) = (low.map(|x| x - wide), high.map(|x| x + wide));
            let [a, b] = ends;
            if (0..2)
                .any(|k| (a[k] < low[k] && b[k] < low[k]) || (a[k] > high[k] && b[k] > high[k]))
            {
                continue; // far away, which is cheaper to see than a length of 0
            }
            let touched = clipped_length(low, high, ends);
            if touched > 0.0 {
                cost += TOUCH * (touched + if touched > CONTACT { 2.0 } else { 0.0 });
            }
        }
        cost
    }
}

#[cfg(test)]
mod tests {
    use super::{place_labels, Taken};
    use crate::display::taken::clipped_length;

    #[test]
    fn a_name_lies_on_no_line_and_no_other_name() {
        let anchors = vec![[0.0, 0.0], [50.0, 0.0], [50.0, 50.0], [50.0, 52.0]];
        let segments = vec![[anchors[0], anchors[1]], [anchors[1], anchors[2]]];
        let taken = Taken {
            segments: vec![segments.clone()],
            reach: vec![0.0; 2],
            boxes: vec![vec![]],
            inside: [[-100.0; 2], [100.0; 2]],
        };
        let offsets = place_labels(std::slice::from_ref(&anchors), &[[20.0, 8.0]; 4], taken);
        let centres: Vec<_> =
            anchors.iter().zip(offsets).map(|(a, by)| [a[0] + by[0], a[1] + by[1]]).collect();
        for (k, [x, y]) in centres.iter().enumerate() {
            let (low, high) = ([x - 10.0, y - 4.0], [x + 10.0, y + 4.0]);
            assert!(segments.iter().all(|ends| clipped_length(low, high, ends) == 0.0));
            let apart = |at: &[f64; 2]| (at[0] - x).abs() >= 20.0 || (at[1] - y).abs() >= 8.0;
            assert!(centres[..k].iter().all(apart));
        }
    }
}
