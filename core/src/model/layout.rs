//! Index ranges: the columns that a body owns, the rows and entries of Φ_q that a constraint owns, the states that an
//! element owns, and their positions in y = (q, v, z, works).
//!
//! Φ_q is stored by constraint. For each owner of columns in a constraint there is a dense block of (equations × 3)
//! entries, row by row, padded with zeros where the owner has fewer than three columns. Ground owns no columns.

use crate::elements::{BodyId, QuantityKind};
use crate::math::Listed;
use std::ops::Range;

/// Works that are integrated with the motion: dissipated energy, work of drivers, work of applied forces.
pub const WORKS: usize = 3;

/// The coordinates of one owner: a moving body, or an element with internal coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// The first column.
    pub first: usize,
    /// Number of columns, at most three; zero for ground.
    pub count: usize,
}

impl Columns {
    /// The columns as a range.
    #[inline]
    pub fn range(self) -> Range<usize> {
        self.first..self.first + self.count
    }
    /// Adds the leading numbers of `three` to these columns of `y`.
    #[inline(always)]
    pub fn add<S: crate::math::Real>(self, three: [S; 3], y: &mut [S]) {
        let y = &mut y[self.range()];
        match y {
            [x, y, angle] => {
                *x += three[0];
                *y += three[1];
                *angle += three[2];
            }
            _ => y.iter_mut().zip(three).for_each(|(y, x)| *y += x),
        }
    }
    /// These columns of `x`, padded to three numbers with zeros.
    #[inline(always)]
    pub fn of<S: crate::math::Real>(self, x: &[S]) -> [S; 3] {
        let mut three = [S::zero(); 3];
        three.iter_mut().zip(&x[self.range()]).for_each(|(to, x)| *to = *x);
        three
    }
}

/// One block of Φ_q: the equations of a constraint for the coordinates of one owner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Index of the owner in [`StateLayout::owners`].
    pub owner: usize,
    /// Its columns.
    pub columns: Columns,
    /// The body, if the owner is a body.
    pub body: Option<BodyId>,
    /// Index of the block's first entry; entry (row r, column c) is `first + 3 r + c`.
    pub first: usize,
    /// ±1 if the columns of translation are ±I for all states (Haug 3.3.12), otherwise 0.
    pub sign: f64,
}

impl Block {
    /// The indices of the stored entries of a row.
    #[inline]
    pub fn row(&self, row: usize) -> Range<usize> {
        self.first + 3 * row..self.first + 3 * row + 3
    }

    /// The indices of the stored entries of all rows. `rows` is the number of equations.
    #[inline]
    pub fn entries(&self, rows: usize) -> Range<usize> {
        self.first..self.first + 3 * rows
    }
}

/// The owners of coordinates of a constraint.
#[derive(Clone, Debug)]
pub(super) struct Touched {
    /// Number of its equations.
    pub equations: usize,
    /// Bodies, i and j first.
    pub bodies: Vec<BodyId>,
    /// Number and kind of its internal coordinates.
    pub own: (usize, QuantityKind),
    /// The internal coordinates of other constraints that occur in its laws, each once.
    pub internals: Vec<usize>,
    /// Whether its columns of translation are -I for body i and +I for body j.
    pub constant_columns: bool,
}

/// Rows and blocks of one constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct Slots {
    /// Rows of Φ.
    pub rows: Range<usize>,
    /// Blocks of Φ_q: bodies i and j first, then bodies that occur only in a law, then its internal coordinates,
    /// then internal coordinates that occur in a law.
    pub blocks: Vec<Block>,
    /// Columns of the internal coordinates.
    pub own: Columns,
}

/// All index ranges of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateLayout {
    /// Number of coordinates.
    pub n_q: usize,
    /// Number of constraint equations.
    pub n_rows: usize,
    /// Number of stored entries of Φ_q.
    pub n_entries: usize,
    /// Number of first-order states of elements.
    pub n_z: usize,
    /// Number of works.
    pub n_works: usize,
    /// Columns of every body, ground first.
    pub bodies: Vec<Columns>,
    /// The kind of each coordinate, shape (n_q).
    pub kinds: Vec<QuantityKind>,
    /// Columns of the moving bodies, then of the elements with internal coordinates.
    pub owners: Vec<Columns>,
    /// The slots of each constraint.
    pub constraints: Vec<Slots>,
    /// Indices in z of the states of each force.
    pub states: Vec<Range<usize>>,
    /// Indices in z of the values of sampled laws, in the order of [`Functions::sampled`](super::Functions::sampled).
    /// The values of a force follow its states.
    pub held: Vec<usize>,
}

impl StateLayout {
    /// The layout for the number of coordinates of each moving body, the owners of coordinates in each constraint,
    /// and the number of states of each force and of its sampled laws.
    pub(super) fn new(
        bodies: impl Iterator<Item = usize>,
        constraints: &[Touched],
        states: impl Iterator<Item = (usize, Vec<usize>)>,
    ) -> Self {
        let mut layout =
            Self { n_works: WORKS, bodies: vec![Columns::default()], ..Self::default() };
        for count in bodies {
            let columns = layout.own(count);
            layout.kinds.extend(&QuantityKind::OF_BODY[..count]);
            layout.bodies.push(columns);
        }
        for touched in constraints {
            let slots = layout.slots(touched);
            layout.constraints.push(slots);
        }
        let mut held = Vec::new();
        for (count, sampled) in states {
            layout.states.push(layout.n_z..layout.n_z + count);
            layout.n_z += count;
            for law in sampled {
                held.push((law, layout.n_z));
                layout.n_z += 1;
            }
        }
        held.sort_unstable();
        layout.held = held.into_iter().map(|(_, place)| place).list();
        layout
    }

    /// Assigns the next columns to a new owner.
    #[inline]
    fn own(&mut self, count: usize) -> Columns {
        let columns = Columns { first: self.n_q, count };
        self.owners.push(columns);
        self.n_q += count;
        columns
    }

    fn slots(&mut self, touched: &Touched) -> Slots {
        let Touched { equations, bodies, own, internals, constant_columns } = touched;
        let rows = self.n_rows..self.n_rows + equations;
        self.n_rows = rows.end;
        let (i, j) = (bodies.first(), bodies.get(1));
        let sign = |body: &BodyId| match Some(body) == j {
            _ if !constant_columns || i == j => 0.0,
            true => 1.0,
            false => -1.0,
        };
        let mut blocks: Vec<Block> = Vec::new();
        for body in bodies {
            if !body.is_ground() && blocks.iter().all(|b| b.body != Some(*body)) {
                let (owner, sign) = (body.0 - 1, sign(body));
                blocks.push(self.block(owner, Some(*body), sign, *equations));
            }
        }
        let mut columns = Columns::default();
        let (count, kind) = *own;
        if count > 0 {
            columns = self.own(count);
            self.kinds.extend(std::iter::repeat_n(kind, count));
            blocks.push(self.block(self.owners.len() - 1, None, 0.0, *equations));
        }
        for place in internals {
            let owner = self.owner_of_internal(*place);
            if blocks.iter().all(|block| block.owner != owner) {
                blocks.push(self.block(owner, None, 0.0, *equations));
            }
        }
        Slots { rows, blocks, own: columns }
    }

    /// The owner of an internal coordinate, by its index among those of all joints.
    fn owner_of_internal(&self, place: usize) -> usize {
        let first: usize = self.bodies.iter().map(|body| body.count).sum();
        let has = |columns: &Columns| columns.range().contains(&(first + place));
        self.owners.iter().position(has).expect("a joint before this constraint owns it")
    }

    #[inline]
    fn block(&mut self, owner: usize, body: Option<BodyId>, sign: f64, rows: usize) -> Block {
        let first = self.n_entries;
        self.n_entries += 3 * rows;
        Block { owner, columns: self.owners[owner], body, first, sign }
    }

    /// Number of components of y = (q, v, z, works).
    #[inline]
    pub fn n_y(&self) -> usize {
        2 * self.n_q + self.n_z + self.n_works
    }

    /// Splits y = (q, v, z, works) into its parts.
    #[inline]
    pub fn split<'a, S>(&self, y: &'a [S]) -> [&'a [S]; 4] {
        let (q, rest) = y.split_at(self.n_q);
        let (v, rest) = rest.split_at(self.n_q);
        let (z, works) = rest.split_at(self.n_z);
        [q, v, z, works]
    }

    /// Splits y into its mutable parts.
    #[inline]
    pub fn split_mut<'a, S>(&self, y: &'a mut [S]) -> [&'a mut [S]; 4] {
        let (q, rest) = y.split_at_mut(self.n_q);
        let (v, rest) = rest.split_at_mut(self.n_q);
        let (z, works) = rest.split_at_mut(self.n_z);
        [q, v, z, works]
    }

    /// Whether each coordinate is a length; otherwise it is an angle. An internal coordinate counts as a length.
    #[inline]
    pub fn lengths(&self) -> Vec<bool> {
        let mut lengths = vec![true; self.n_q];
        let full = self.bodies.iter().filter(|body| body.count == 3);
        full.for_each(|body| lengths[body.first + 2] = false);
        lengths
    }

    /// Position (row, column) and storage index of every entry of Φ_q that is not padding, in storage order.
    pub fn positions(&self) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
        self.constraints.iter().flat_map(|slots| {
            slots.blocks.iter().flat_map(|block| {
                let rows = slots.rows.clone().enumerate();
                rows.flat_map(|(r, row)| {
                    let places = block.row(r);
                    block.columns.range().zip(places).map(move |(column, at)| (row, column, at))
                })
            })
        })
    }

    /// The constraint that owns a row of Φ, and the index of the equation within the constraint.
    #[inline]
    pub fn owner(&self, row: usize) -> (usize, usize) {
        let k = self.constraints.partition_point(|slots| slots.rows.end <= row);
        (k, row - self.constraints[k].rows.start)
    }

    /// The body that owns a coordinate, and the index of the coordinate within the body. None for an internal
    /// coordinate.
    #[inline]
    pub fn body_of(&self, column: usize) -> Option<(BodyId, usize)> {
        let body = self.bodies.iter().position(|b| b.range().contains(&column))?;
        Some((BodyId(body), column - self.bodies[body].first))
    }
}
