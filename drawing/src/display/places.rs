//! Which points of a motion are one place in a drawing.

use crate::plane::At;

/// Paths of points, those of one place once.
pub struct Places {
    /// Paths that are always so near are one place, m.
    near: f64,
    paths: Vec<Vec<At>>,
}

impl Places {
    /// No place yet.
    pub fn new(near: f64) -> Self {
        Self { near, paths: Vec::new() }
    }

    /// The number of the place of a path; a new one if there is none yet.
    pub fn index(&mut self, path: Vec<At>) -> usize {
        let mut best = (self.near, None);
        for (k, other) in self.paths.iter().enumerate() {
            let apart = apart(&path, other, best.0);
            if apart < best.0 {
                best = (apart, Some(k));
            }
        }
        best.1.unwrap_or_else(|| {
            self.paths.push(path);
            self.paths.len() - 1
        })
    }

    /// Whether a path has a place of its own; it is then taken.
    pub fn is_new(&mut self, path: Vec<At>) -> bool {
        let before = self.paths.len();
        self.index(path) == before
    }
}

/// The largest distance of two paths along x or y; the search ends where it reaches a limit.
fn apart(one: &[At], other: &[At], limit: f64) -> f64 {
    let mut found = 0.0_f64;
    for (a, b) in one.iter().zip(other) {
        found = found.max((a[0] - b[0]).abs()).max((a[1] - b[1]).abs());
        if found >= limit {
            break;
        }
    }
    found
}
