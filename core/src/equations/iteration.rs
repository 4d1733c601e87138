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

use super::tangent::Tangent;
use super::Compiled;
use crate::math::Field;
use crate::model::{Model, StateLayout};
use crate::solve::{BlockLu, LuPlan};

/// Damping of redundant rows, relative to the compliance of the bodies.
const REDUNDANT: f64 = 1e-10;

/// Where the blocks of a tangent go in the factors.
#[derive(Clone, Debug)]
pub struct Places {
    /// Pattern, order and plan.
    pub plan: LuPlan,
    pairs: Vec<usize>,
    /// For each block of Φ_q: the first entry, its rows, and the slots of Φ_q and Φ_qᵀ.
    jacobian: Vec<(usize, usize, usize, usize)>,
    /// Slot of the diagonal block of each constraint, and its rows.
    diagonal: Vec<(usize, usize)>,
    damping: f64,
    /// Inertia added to the bodies, kg·m².
    added_inertia: Vec<f64>,
}

impl Places {
    /// For a model and the pattern of its tangent.
    pub fn new(model: &Model, tangent: &Tangent) -> Self {
        let layout = &model.layout;
        let bodies = layout.owners.len();
        let rows = layout.constraints.iter().map(|slots| slots.rows.len());
        let sizes: Vec<usize> = layout.owners.iter().map(|owner| owner.count).chain(rows).collect();
        let mut entries = tangent.pairs().to_vec();
        entries.extend(blocks(layout).map(|(k, body, _)| (bodies + k, body)));
        let plan = LuPlan::new(sizes, bodies, &entries);
        let pairs = tangent.pairs().iter().map(|&(row, column)| plan.slot(row, column)).collect();
        let jacobian = blocks(layout)
            .map(|(k, body, first)| {
                let m = layout.constraints[k].rows.len();
                (first, m, plan.slot(bodies + k, body), plan.slot(body, bodies + k))
            })
            .collect();
        let diagonal = layout
            .constraints
            .iter()
            .enumerate()
            .map(|(k, slots)| (plan.slot(bodies + k, bodies + k), slots.rows.len()))
            .collect();
        let compliance = model.bodies[1..].iter().map(|b| 1.0 / b.mass).fold(0.0, f64::max);
        let damping = if model.allow_redundancy { REDUNDANT * compliance } else { 0.0 };
        let added_inertia = Compiled::new(model).added_inertia;
        Self { plan, pairs, jacobian, diagonal, damping, added_inertia }
    }
}

/// Each block of Φ_q: constraint, body (from 0 without ground), first entry.
fn blocks(layout: &StateLayout) -> impl Iterator<Item = (usize, usize, usize)> + '_ {
    layout
        .constraints
        .iter()
        .enumerate()
        .flat_map(|(k, slots)| slots.blocks.iter().map(move |block| (k, block.owner, block.first)))
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
    for (pair, &slot) in places.pairs.iter().enumerate() {
        let (stiffness, damping) = (&tangent.stiffness[pair], &tangent.damping[pair]);
        let block = lu.block_mut(slot);
        for r in 0..3 {
            for c in 0..3 {
                block[r][c] = c_q * real(stiffness[r][c]) + c_v * real(damping[r][c]);
            }
        }
    }
    // the diagonal blocks are the first pairs
    for ((mass, added), &slot) in tangent.mass.iter().zip(&places.added_inertia).zip(&places.pairs)
    {
        let block = lu.block_mut(slot);
        let (m, b) = (mass.mass, mass.coupling);
        let full = [[m, 0.0, b.x], [0.0, m, b.y], [b.x, b.y, mass.inertia + added]];
        for (row, full) in block.iter_mut().zip(full) {
            row.iter_mut().zip(full).for_each(|(e, full)| *e += c_a * real(full));
        }
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
