//! Areas of a drawing that names must not cover.

use crate::plane::{minus, size, At};

/// Areas that names must not cover, at some instants of a motion, in points of print.
#[derive(Clone, Debug)]
pub struct Taken {
    /// Lines at each instant.
    pub segments: Vec<Vec<[At; 2]>>,
    /// Half widths of the lines.
    pub reach: Vec<f64>,
    /// Other texts at each instant: smallest x and y, largest x and y.
    pub boxes: Vec<Vec<[f64; 4]>>,
    /// Smallest and largest limits of the area that names should not leave.
    pub inside: [At; 2],
}

impl Taken {
    /// Adds a text with its centre at each instant.
    pub fn add(&mut self, centres: impl Iterator<Item = At>, [wide, high]: At) {
        for (boxes, [x, y]) in self.boxes.iter_mut().zip(centres) {
            boxes.push([x - wide / 2.0, y - high / 2.0, x + wide / 2.0, y + high / 2.0]);
        }
    }
}

/// Length of the part of a segment inside a box (Liang and Barsky 1984).
pub fn clipped_length(low: At, high: At, [begin, end]: &[At; 2]) -> f64 {
    let along = minus(*end, *begin);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for k in 0..2 {
        if along[k] == 0.0 {
            // parallel to an edge: inside along its whole length or not at all
            if !(low[k]..=high[k]).contains(&begin[k]) {
                return 0.0;
            }
            continue;
        }
        let (one, other) = ((low[k] - begin[k]) / along[k], (high[k] - begin[k]) / along[k]);
        enter = enter.max(one.min(other));
        leave = leave.min(one.max(other));
    }
    (leave - enter).clamp(0.0, 1.0) * size(along)
}

#[cfg(test)]
mod tests {
    use super::clipped_length;

    #[test]
    fn lengths_inside_a_box() {
        let inside = |ends: [[f64; 2]; 2]| clipped_length([0.0, 0.0], [2.0, 1.0], &ends);
        assert_eq!(inside([[-1.0, 0.5], [3.0, 0.5]]), 2.0);
        assert_eq!(inside([[0.5, 0.25], [0.5, 0.75]]), 0.5);
        assert_eq!(inside([[-1.0, 2.0], [3.0, 2.0]]), 0.0);
        assert_eq!(inside([[1.0, -1.0], [1.0, 0.5]]), 0.5);
    }
}
