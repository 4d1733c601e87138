//! Places of a drawing: points that are very near to each other lie at one place.

use std::collections::HashMap;

/// The places so far, each with a number.
#[derive(Debug)]
pub(super) struct Places {
    close: f64,
    all: Vec<[f64; 2]>,
    /// The places in each square with this side.
    cells: HashMap<[i64; 2], Vec<usize>>,
}

impl Places {
    /// Points at this distance or less lie at one place.
    pub(super) fn new(close: f64) -> Self {
        Self { close: close.max(f64::MIN_POSITIVE), all: Vec::new(), cells: HashMap::new() }
    }

    fn cell(&self, at: [f64; 2]) -> [i64; 2] {
        at.map(|x| (x / self.close).floor() as i64)
    }

    /// The place of a point, if there is one.
    pub(super) fn find(&self, at: [f64; 2]) -> Option<usize> {
        let [x, y] = self.cell(at);
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [i, j]));
        let mut near = around.filter_map(|[i, j]| {
            let places = self.cells.get(&[x.saturating_add(i), y.saturating_add(j)])?;
            let is_near = |place: &usize| {
                let [u, v] = self.all[*place];
                (u - at[0]).hypot(v - at[1]) <= self.close
            };
            places.iter().copied().find(is_near)
        });
        near.next()
    }

    /// The place of a point, and whether it is new.
    pub(super) fn put(&mut self, at: [f64; 2]) -> (usize, bool) {
        if let Some(place) = self.find(at) {
            return (place, false);
        }
        let (cell, place) = (self.cell(at), self.all.len());
        self.cells.entry(cell).or_default().push(place);
        self.all.push(at);
        (place, true)
    }
}
