//! The matrix of Newton's iteration of implicit methods,
//!
//! ```text
//! [ c_a M + c_v D + c_q K   Φ_qᵀ ]
//! [ Φ_q + c_b B              -μ  ]
//! ```
//!
//! with the [`Tangent`] of the equations of motion, real or complex. Bodies without inertia get in M what
//! the model adds to them: the residual stays that of the true equations, so the iteration converges to
//! their solution. Redundant rows are damped with μ, for the same reason without harm.

use super::plan::{groups, row_blocks};
use super::tangent::Tangent;
use super::Compiled;
use crate::math::Field;
use crate::model::Model;
use crate::solve::{BlockLu, LuPlan};

/// Damping of redundant rows, relative to the compliance of the bodies.
const REDUNDANT: f64 = 1e-10;

/// Where the blocks of a tangent go in the factors.
#[derive(Clone, Debug)]
pub struct Places {
    /// Pattern, order and plan.
    pub plan: LuPlan,
    pairs: Vec<usize>,
    /// Number of unknowns of each group.
    groups: Vec<usize>,
    /// For each block of Φ_q: the first entry, its rows, and the slots of Φ_q and Φ_qᵀ.
    jacobian: Vec<(usize, usize, usize, usize)>,
    /// Slot of the diagonal block of each block of rows, and its rows.
    diagonal: Vec<(usize, usize)>,
    damping: f64,
    /// Inertia added to the bodies, kg·m².
    added_inertia: Vec<f64>,
    /// Mass added to the internal coordinates of elements, kg.
    own_mass: f64,
}

impl Places {
    /// For a model and the pattern of its tangent.
    pub fn new(model: &Model, tangent: &Tangent) -> Self {
        let compiled = Compiled::new(model);
        let groups: Vec<usize> = groups(model, &compiled).iter().map(|group| group.size).collect();
        let (blocks, _) = row_blocks(&model.layout);
        let n = groups.len();
        let sizes = groups.iter().copied().chain(blocks.iter().map(|block| block.size)).collect();
        let touches = || {
            let blocks = blocks.iter().enumerate();
            blocks.flat_map(|(k, b)| b.touches.iter().map(move |touch| (n + k, b.size, *touch)))
        };
        let mut entries = tangent.pairs().to_vec();
        entries.extend(touches().map(|(row, _, (group, _))| (row, group)));
        let plan = LuPlan::new(sizes, n, &entries);
        let pairs = tangent.pairs().iter().map(|&(row, column)| plan.slot(row, column)).collect();
        let slots = |(row, size, (group, first)): (usize, usize, (usize, usize))| {
            (first, size, plan.slot(row, group), plan.slot(group, row))
        };
        let jacobian = touches().map(slots).collect();
        let diagonal = blocks.iter().enumerate();
        let diagonal = diagonal.map(|(k, b)| (plan.slot(n + k, n + k), b.size)).collect();
        let compliance = model.bodies[1..].iter().map(|b| 1.0 / b.mass).fold(0.0, f64::max);
        let damping = if model.allow_redundancy { REDUNDANT * compliance } else { 0.0 };
        let Compiled { added_inertia, own_mass, .. } = compiled;
        Self { plan, pairs, groups, jacobian, diagonal, damping, added_inertia, own_mass }
    }
}

/// Puts the matrix together, with the factors [c_a, c_v, c_q, c_b] of M, D, K and B.
pub fn assemble<F: Field>(
    places: &Places,
    tangent: &Tangent,
    [c_a, c_v, c_q, c_b]: [F; 4],
    lu: &mut BlockLu<F>,
) {
    let real = F::from_real;
    lu.clear(&places.plan);
    // rows that a short group does not have keep the identity
    for (pair, &slot) in places.pairs.iter().enumerate() {
        let (stiffness, damping) = (&tangent.stiffness[pair], &tangent.damping[pair]);
        let block = lu.block_mut(slot);
        for r in 0..3 {
            for c in 0..3 {
                block[r][c] += c_q * real(stiffness[r][c]) + c_v * real(damping[r][c]);
            }
        }
    }
    // the diagonal blocks are the first pairs
    let masses = tangent.mass.iter().zip(&places.added_inertia).zip(&places.groups);
    for (((mass, added), &size), &slot) in masses.zip(&places.pairs) {
        let block = lu.block_mut(slot);
        let (m, b) = (mass.mass, mass.coupling);
        let full = [[m, 0.0, b.x], [0.0, m, b.y], [b.x, b.y, mass.inertia + added]];
        for (row, full) in block.iter_mut().zip(full).take(size) {
            row.iter_mut().zip(full).take(size).for_each(|(e, full)| *e += c_a * real(full));
        }
    }
    let own = places.groups.iter().zip(&places.pairs).skip(tangent.mass.len());
    for (&size, &slot) in own {
        (0..size).for_each(|d| lu.block_mut(slot)[d][d] += c_a * real(places.own_mass));
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
        (0..m).for_each(|d| lu.block_mut(slot)[d][d] = real(-places.damping));
    }
}
