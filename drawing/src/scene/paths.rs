//! Positions of bodies and their points at some instants.

use crate::plane::{placed, At, Pose};

/// Poses of the moving bodies at some instants.
#[derive(Clone, Copy)]
pub struct Paths<'a>(pub &'a [Vec<Pose>]);

impl<'a> Paths<'a> {
    /// The pose of a body at each instant. Ground, with the number 0, does not move.
    pub fn of(self, body: usize) -> impl Iterator<Item = Pose> + 'a {
        let at = move |poses: &Vec<Pose>| match body {
            0 => [0.0; 3],
            _ => poses.get(body - 1).copied().unwrap_or_default(),
        };
        self.0.iter().map(at)
    }

    /// The position of a point of a body at each instant.
    pub fn point(self, body: usize, at: At) -> impl Iterator<Item = At> + 'a {
        self.of(body).map(move |pose| placed(pose, at))
    }

    /// Poses of two bodies at each instant.
    pub fn both(self, [i, j]: [usize; 2]) -> impl Iterator<Item = [Pose; 2]> + 'a {
        self.of(i).zip(self.of(j)).map(|(i, j)| [i, j])
    }
}

/// Smallest and largest of some numbers.
pub fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    values.fold(ends, |[low, high], x| [low.min(x), high.max(x)])
}
