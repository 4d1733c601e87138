//! The matrix of Newton's iteration of implicit methods,
//!
//! ```text
//! [ c_a M + c_v D + c_q K       -k_z ∂Q/∂z        Φ_qᵀ - ∂Q/∂λ ]
//! [ -k_v ∂ż/∂v - k_q ∂ż/∂q     1 - k_s ∂ż/∂z          0        ]
//! [ Φ_q + c_b B                     0                -μ        ]
//! ```
//!
//! with the [`Tangent`] of the equations of motion, real or complex. The middle row and column belong to the
//! first-order states of elements; few models have any. M contains the inertia added to bodies without mass or
//! inertia. The residual is that of the true equations, so that the iteration still converges to their solution. μ =
//! 0 except for redundant rows, which are omitted by a large μ.

use super::coupling::Participants;
use super::light::{Internal, Light};
use super::plan::row_blocks;
use super::tangent::{Entry, Tangent};
use crate::math::{indexed, Field, Listed};
use crate::model::{Model, StateLayout};
use crate::solve::{BlockLu, LuPlan};
use std::ops::Range;

/// Damping μ of an omitted redundant row. Its multiplier does not change.
const OMITTED: f64 = 1e100;

/// Coefficients of the parts of the matrix.
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<F> {
    /// Coefficients of M, D, K and B.
    pub motion: [F; 4],
    /// Coefficients of ∂Q/∂z, ∂ż/∂v, ∂ż/∂q and ∂ż/∂z.
    pub states: [F; 4],
}

/// The slots of the blocks of a tangent in the factors.
#[derive(Clone, Debug)]
pub struct Places {
    /// Pattern, elimination order and plan.
    pub plan: LuPlan,
    pairs: Vec<usize>,
    /// Number of unknowns of each group.
    groups: Vec<usize>,
    /// For each block of Φ_q: its first entry, its number of rows, and the slots of Φ_q and Φ_qᵀ.
    jacobian: Vec<(usize, usize, usize, usize)>,
    /// The block of each first-order state, and the index in this block.
    states: Vec<(usize, usize)>,
    /// The block of each row of Φ, and the index in this block.
    rows: Vec<(usize, usize)>,
    /// Slot of the diagonal block of each block of rows, and its number of rows.
    diagonal: Vec<(usize, usize)>,
    /// The omitted rows.
    omitted: Vec<usize>,
    /// Mass and inertia added to the bodies.
    added: Vec<[f64; 2]>,
    /// The internal coordinates of elements.
    internals: Vec<Internal>,
}

impl Places {
    /// The slots for a model and the pattern of its tangent.
    pub fn new(model: &Model, tangent: &Tangent) -> Self {
        let groups: Vec<usize> = model.layout.owners.iter().map(|columns| columns.count).list();
        let (blocks, _) = row_blocks(&model.layout);
        let state_sizes = state_blocks(&model.layout);
        let n = groups.len() + state_sizes.len();
        let row_sizes: Vec<usize> = blocks.iter().map(|block| block.size).list();
        let states = numbered(groups.len(), &state_sizes);
        let rows = numbered(n, &row_sizes);
        let sizes = groups.iter().copied().chain(state_sizes).chain(row_sizes).list();
        let touches = || {
            let blocks = blocks.iter().enumerate();
            blocks.flat_map(|(k, b)| b.touches.iter().map(move |touch| (n + k, b.size, *touch)))
        };
        let mut entries = tangent.pairs().to_vec();
        touches().map(|(row, _, (group, _))| (row, group)).append_to(&mut entries);
        for participants in tangent.participants() {
            entries.extend(coupled(participants, &states, &rows));
        }
        let plan = LuPlan::new(sizes, n, &entries);
        let light = Light::new(model);
        let pairs = tangent.pairs().iter().map(|&(row, column)| plan.slot(row, column)).list();
        let slots = |(row, size, (group, first)): (usize, usize, (usize, usize))| {
            (first, size, plan.slot(row, group), plan.slot(group, row))
        };
        let jacobian = touches().map(slots).list();
        let diagonal = blocks.iter().enumerate();
        let diagonal = diagonal.map(|(k, b)| (plan.slot(n + k, n + k), b.size)).list();
        Self {
            plan,
            pairs,
            groups,
            jacobian,
            states,
            rows,
            diagonal,
            omitted: Vec::new(),
            added: light.added,
            internals: light.internals,
        }
    }

    /// Omits these rows and no others.
    pub fn omit(&mut self, rows: &[usize]) {
        self.omitted.clear();
        self.omitted.extend_from_slice(rows);
    }
}

/// Sizes of the blocks of states: one block for up to three states of an element, and one block for the value of each
/// sampled law.
fn state_blocks(layout: &StateLayout) -> Vec<usize> {
    let of = |own: Range<usize>| own.clone().step_by(3).map(move |k| (k, (own.end - k).min(3)));
    let held = layout.held.iter().map(|place| (*place, 1));
    let mut all: Vec<_> = layout.states.iter().cloned().flat_map(of).chain(held).list();
    all.sort_unstable();
    all.into_iter().map(|(_, size)| size).list()
}

/// The block of each unknown and the index in this block, for blocks of the given sizes, numbered from `first`.
fn numbered(first: usize, sizes: &[usize]) -> Vec<(usize, usize)> {
    let blocks = sizes.iter().enumerate();
    blocks.flat_map(|(k, &size)| (0..size).map(move |place| (first + k, place))).list()
}

/// All pairs of blocks that a force with states or with a reaction couples.
fn coupled(
    force: &Participants,
    states: &[(usize, usize)],
    rows: &[(usize, usize)],
) -> Vec<(usize, usize)> {
    let own = force.states.iter().map(|&at| states[at].0);
    let others: Vec<usize> = own.chain(force.rows.iter().map(|row| rows[*row].0)).list();
    let all: Vec<usize> = force.owners().chain(others.iter().copied()).list();
    others.iter().flat_map(|&a| all.iter().map(move |&b| (a, b))).list()
}

/// Assembles the matrix.
pub fn assemble<F: Field>(
    places: &Places,
    tangent: &Tangent,
    coefficients: Coefficients<F>,
    lu: &mut BlockLu<F>,
) {
    let real = F::from_real;
    let [c_a, c_v, c_q, c_b] = coefficients.motion;
    lu.clear(&places.plan);
    // missing rows of a smaller group keep the identity
    for (pair, &slot) in places.pairs.iter().enumerate() {
        let (stiffness, damping) = (&tangent.stiffness[pair], &tangent.damping[pair]);
        let block = lu.block_mut(slot);
        for r in 0..3 {
            for c in 0..3 {
                block[r][c] += c_q * real(stiffness[r][c]) + c_v * real(damping[r][c]);
            }
        }
    }
    // the first pairs are the diagonal blocks
    let masses = tangent.mass.iter().zip(&places.added).zip(&places.groups);
    for (((mass, added), &size), &slot) in masses.zip(&places.pairs) {
        let block = lu.block_mut(slot);
        // added at the origin of the frame, since the solution of the iteration does not depend on the addition
        let (m, j, b) = (mass.mass + added[0], mass.inertia + added[1], mass.coupling);
        let full = [[m, 0.0, b.x], [0.0, m, b.y], [b.x, b.y, j]];
        for (row, full) in block.iter_mut().zip(full).take(size) {
            row.iter_mut().zip(full).take(size).for_each(|(e, full)| *e += c_a * real(full));
        }
    }
    for own in &places.internals {
        let block = lu.block_mut(places.pairs[own.owner]);
        let added = own.inertia(|row| indexed(|c| tangent.jacobian[3 * row + c]));
        (0..own.size).for_each(|d| block[d][d] += c_a * real(added[d]));
    }
    for &(first, m, lower, upper) in &places.jacobian {
        let (plain, rate) = (&tangent.jacobian[first..], &tangent.rate[first..]);
        for r in 0..m {
            for c in 0..3 {
                let (entry, rate) = (real(plain[3 * r + c]), real(rate[3 * r + c]));
                lu.block_mut(lower)[r][c] = entry + c_b * rate;
                lu.block_mut(upper)[c][r] = entry;
            }
        }
    }
    for &(slot, m) in &places.diagonal {
        (0..m).for_each(|d| lu.block_mut(slot)[d][d] = F::zero());
    }
    for &row in &places.omitted {
        let (block, d) = places.rows[row];
        lu.block_mut(places.plan.slot(block, block))[d][d] = real(-OMITTED);
    }
    add_states(places, tangent, coefficients.states, lu);
}

/// Adds the rows and columns of first-order states, and the derivatives of forces with respect to multipliers.
fn add_states<F: Field>(
    places: &Places,
    tangent: &Tangent,
    [k_z, k_v, k_q, k_s]: [F; 4],
    lu: &mut BlockLu<F>,
) {
    let (plan, real, of) = (&places.plan, F::from_real, &tangent.states);
    for &(block, d) in &places.states {
        lu.block_mut(plan.slot(block, block))[d][d] = F::one();
    }
    let columns = [(&of.forces, k_z, &places.states), (&of.reactions, F::one(), &places.rows)];
    for (entries, factor, places) in columns {
        for Entry { owner, at, values } in entries {
            let (block, column) = places[*at];
            let to = lu.block_mut(plan.slot(*owner, block));
            to.iter_mut().zip(values).for_each(|(row, x)| row[column] += factor * real(*x));
        }
    }
    for (entries, factor) in [(&of.by_velocity, k_v), (&of.by_position, k_q)] {
        for Entry { owner, at, values } in entries {
            let (block, row) = places.states[*at];
            let to = &mut lu.block_mut(plan.slot(block, *owner))[row];
            to.iter_mut().zip(values).for_each(|(entry, x)| *entry += factor * real(-x));
        }
    }
    for &(at, by, slope) in &of.by_state {
        let ((row, r), (column, c)) = (places.states[at], places.states[by]);
        lu.block_mut(plan.slot(row, column))[r][c] += k_s * real(-slope);
    }
}
