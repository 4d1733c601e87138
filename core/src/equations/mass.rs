//! The mass matrix, with one symmetric 3 × 3 block for each body (Haug 6.2.8, generalized to a frame whose origin is
//! not the mass centre).
//!
//! With the mass centre c and b = B c′ = (A c′)⊥:  M = [m I, m b; m bᵀ, J + m |c′|²].

use super::Inertia;
use crate::math::{Motion, Real, Vec2};
use crate::model::{Body, Model};
use crate::solve::InverseMass;

/// The four numbers of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassBlock<S = f64> {
    /// m, kg.
    pub mass: S,
    /// m b: coupling of translation and rotation, kg·m.
    pub coupling: Vec2<S>,
    /// Moment of inertia about the frame's origin, kg·m².
    pub inertia: S,
}

/// The block of a body at a pose.
pub fn block<S: Real>(body: &Body<S>, motion: &Motion<S>) -> MassBlock<S> {
    let arm = motion.pose.global(body.center);
    MassBlock {
        mass: body.mass,
        coupling: arm.perp().scale(body.mass),
        inertia: body.inertia + body.mass * body.center.dot(body.center),
    }
}

/// Updates the inverse of the block for the current angle of the body. The vector b of the mass centre gives the
/// direction. 1/m and 1/J are already set.
#[inline(always)]
pub fn turn<S: Real>(inertia: &Inertia<S>, motion: &Motion<S>, mass: &mut InverseMass<S>) {
    if inertia.coupled {
        let b = motion.pose.global(inertia.center).perp();
        mass.direction = [-b.x, -b.y, S::one()];
    }
}

/// Updates the inverses for the bodies with the indices `coupled`.
#[inline(always)]
pub(super) fn turn_all<S: Real>(
    coupled: &[u32],
    inertias: &[Inertia<S>],
    motions: &[Motion<S>],
    masses: &mut [InverseMass<S>],
) {
    for &k in coupled {
        let k = k as usize;
        turn(&inertias[k], &motions[k + 1], &mut masses[k]);
    }
}

impl<S: Real> MassBlock<S> {
    /// M x for x = (x, y, φ) of the body.
    pub fn times(&self, x: [S; 3]) -> [S; 3] {
        let b = self.coupling;
        [
            self.mass * x[0] + b.x * x[2],
            self.mass * x[1] + b.y * x[2],
            b.x * x[0] + b.y * x[1] + self.inertia * x[2],
        ]
    }
}

/// y += M x, shape (n_q). Internal coordinates have no mass.
#[inline]
pub fn add_times<S: Real>(model: &Model<S>, motions: &[Motion<S>], x: &[S], y: &mut [S]) {
    let bodies = model.bodies.iter().zip(motions).zip(&model.layout.bodies).skip(1);
    for ((body, motion), columns) in bodies {
        columns.add(block(body, motion).times(columns.of(x)), y);
    }
}

/// Computes the blocks of all moving bodies into `blocks`.
#[inline]
pub(super) fn put_blocks<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
    blocks: &mut Vec<MassBlock<S>>,
) {
    blocks.clear();
    for (body, motion) in model.bodies.iter().zip(motions).skip(1) {
        blocks.push(block(body, motion));
    }
}

/// [`add_times`] with precomputed blocks.
#[inline]
pub(super) fn add_blocks<S: Real>(model: &Model<S>, blocks: &[MassBlock<S>], x: &[S], y: &mut [S]) {
    for (k, block) in blocks.iter().enumerate() {
        let columns = model.layout.bodies[k + 1];
        columns.add(block.times(columns.of(x)), y);
    }
}
