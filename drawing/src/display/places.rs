//! Determines which moving points are one place in a drawing.

use crate::plane::At;
use std::collections::HashMap;

/// Paths of points; one path for each place.
pub struct Places {
    /// Paths that are always closer than this distance are one place, m.
    near: f64,
    paths: Vec<Vec<At>>,
    /// Indices of the paths that begin in each square with this side length, so that few paths are compared.
    squares: HashMap<[i64; 2], Vec<usize>>,
}

impl Places {
    /// No places yet.
    pub fn new(near: f64) -> Self {
        Self { near, paths: Vec::new(), squares: HashMap::new() }
    }

    /// The index of the place of a path. Adds a place if there is none.
    pub fn index(&mut self, path: Vec<At>) -> usize {
        let begin = path.first().copied().unwrap_or_default();
        let [x, y] = begin.map(|x| (x / self.near).floor() as i64);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [dx, dy]));
        let beside =
            |[dx, dy]: [i64; 2]| self.squares.get(&[x.saturating_add(dx), y.saturating_add(dy)]);
        let apart = |k: &usize| (apart(&path, &self.paths[*k]), *k);
        let found = around.filter_map(beside).flatten().map(apart);
        let nearest = found.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        if let Some((_, k)) = nearest.filter(|(apart, _)| *apart < self.near) {
            return k;
        }
        self.squares.entry([x, y]).or_default().push(self.paths.len());
        self.paths.push(path);
        self.paths.len() - 1
    }

    /// Whether a path is a new place. Adds the place if it is new.
    pub fn is_new(&mut self, path: Vec<At>) -> bool {
        let before = self.paths.len();
        self.index(path) == before
    }
}

/// The largest difference between two paths along x or y.
fn apart(one: &[At], other: &[At]) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.map(|(a, b)| (a[0] - b[0]).abs().max((a[1] - b[1]).abs())).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::Places;

    #[test]
    fn paths_that_are_always_near_are_one_place() {
        let mut places = Places::new(0.1);
        let paths =
            [[[0.99, 0.0], [2.0, 0.0]], [[1.05, 0.0], [2.05, 0.0]], [[1.0, 0.0], [2.2, 0.0]]];
        assert_eq!(paths.map(|path| places.index(path.to_vec())), [0, 0, 1]);
        assert!(!places.is_new(vec![[1.0, 0.05], [2.19, -0.05]]));
        assert!(places.is_new(vec![[-1.0, 0.0], [2.0, 0.0]]));
    }
}
