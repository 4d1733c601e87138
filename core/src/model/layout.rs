//! Index ranges: which columns a body owns, which rows and Jacobian entries a constraint owns.
//!
//! Φ_q is stored by constraint: for each moving body that a constraint touches a dense block of
//! (equations × 3) entries, row by row. Ground owns no columns.

use crate::elements::BodyId;
use std::ops::Range;

/// Works that are integrated with the motion: dissipated, of drivers, of applied forces.
pub const WORKS: usize = 3;

/// One block of Φ_q: the equations of a constraint by the coordinates of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// The moving body.
    pub body: BodyId,
    /// Index of the block's first entry; entry (row r, column c) is `first + 3 r + c`.
    pub first: usize,
    /// ±1 where the first two columns of a block of two rows are ±I, whatever the state: at a joint that
    /// pins two points, Φ = point_j - point_i (Haug 3.3.12). 0 for other blocks.
    pub sign: f64,
}

/// What a constraint touches.
#[derive(Clone, Debug)]
pub(super) struct Touched {
    /// Number of its equations.
    pub equations: usize,
    /// Bodies, i and j first.
    pub bodies: Vec<BodyId>,
    /// Whether it only pins a point of body i to one of body j, with two equations.
    pub pins: bool,
}

/// Rows and blocks of one constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Slots {
    /// Rows of Φ.
    pub rows: Range<usize>,
    /// Blocks of Φ_q, bodies i and j first, then bodies that only a law names.
    pub blocks: Vec<Block>,
}

/// All index ranges of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// Number of coordinates, three for each moving body.
    pub n_q: usize,
    /// Number of constraint equations.
    pub n_rows: usize,
    /// Number of stored entries of Φ_q.
    pub n_entries: usize,
    /// Number of first-order states of elements.
    pub n_z: usize,
    /// Number of works.
    pub n_works: usize,
    /// One for each constraint.
    pub constraints: Vec<Slots>,
}

/// Columns of a body; empty for ground.
pub fn columns(body: BodyId) -> Range<usize> {
    match body.0 {
        0 => 0..0,
        k => 3 * (k - 1)..3 * k,
    }
}

impl Layout {
    /// For `n_bodies` moving bodies and what the constraints touch.
    pub(super) fn new(n_bodies: usize, constraints: impl Iterator<Item = Touched>) -> Self {
        let mut layout = Self { n_q: 3 * n_bodies, n_works: WORKS, ..Self::default() };
        for Touched { equations: m, bodies, pins } in constraints {
            let (i, j) = (bodies.first().copied(), bodies.get(1).copied());
            let sign = |body| match Some(body) == j {
                _ if !pins || i == j => 0.0,
                true => 1.0,
                false => -1.0,
            };
            let rows = layout.n_rows..layout.n_rows + m;
            layout.n_rows = rows.end;
            let mut blocks: Vec<Block> = Vec::new();
            for body in bodies {
                if !body.is_ground() && blocks.iter().all(|b| b.body != body) {
                    let first = layout.n_entries;
                    blocks.push(Block { body, first, sign: sign(body) });
                    layout.n_entries += 3 * m;
                }
            }
            layout.constraints.push(Slots { rows, blocks });
        }
        layout
    }

    /// Number of components of y = (q, v, z, works).
    pub fn n_y(&self) -> usize {
        2 * self.n_q + self.n_z + self.n_works
    }

    /// Splits y = (q, v, z, works) into its parts.
    pub fn split<'a, S>(&self, y: &'a [S]) -> [&'a [S]; 4] {
        let (q, rest) = y.split_at(self.n_q);
        let (v, rest) = rest.split_at(self.n_q);
        let (z, works) = rest.split_at(self.n_z);
        [q, v, z, works]
    }

    /// The same, to be changed.
    pub fn split_mut<'a, S>(&self, y: &'a mut [S]) -> [&'a mut [S]; 4] {
        let (q, rest) = y.split_at_mut(self.n_q);
        let (v, rest) = rest.split_at_mut(self.n_q);
        let (z, works) = rest.split_at_mut(self.n_z);
        [q, v, z, works]
    }

    /// Position (row, column) of every stored entry of Φ_q, in storage order.
    pub fn positions(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.constraints.iter().flat_map(|slots| {
            slots.blocks.iter().flat_map(|block| {
                let cells = move |row| columns(block.body).map(move |column| (row, column));
                slots.rows.clone().flat_map(cells)
            })
        })
    }

    /// The constraint that owns a row of Φ, and the equation's index within it.
    pub fn owner(&self, row: usize) -> (usize, usize) {
        let k = self.constraints.partition_point(|slots| slots.rows.end <= row);
        (k, row - self.constraints[k].rows.start)
    }
}
