//! Moments of inertia added to bodies that have none, or hardly any, so that M can be inverted.
//!
//! The equations of motion remain those of the body without added inertia: the solution is corrected for the
//! added inertia (`equations/refine.rs`). Like M + ρ Φ_qᵀ Φ_q this is exact, but M stays block-diagonal.

use crate::math::Real;
use crate::model::{Body, ConstraintItem};

/// Added inertia relative to m l², with l the distance of the farthest joint point from the mass centre. It is large
/// enough that the elimination loses few digits, and small enough that its correction needs few steps.
const ADDED: f64 = 1e-7;

/// One for each body: zero where the body's own inertia suffices, kg·m².
///
/// A body with joints only at its mass centre gets no added inertia, because no joint resists its rotation.
pub(super) fn added<S: Real>(bodies: &[Body<S>], constraints: &[ConstraintItem<S>]) -> Vec<S> {
    let mut reach = vec![S::zero(); bodies.len()];
    for item in constraints {
        for (place, end) in item.bodies.iter().enumerate() {
            let arm = item.element.attachment(place).s - bodies[end.0].center;
            reach[end.0] = reach[end.0].max(arm.dot(arm));
        }
    }
    let turning = |(body, reach): (&Body<S>, &S)| body.mass * *reach;
    let mut scale: Vec<S> = bodies.iter().zip(&reach).map(turning).collect();
    let own = bodies.iter().map(|body| body.inertia);
    let largest = scale.iter().copied().chain(own).fold(S::zero(), S::max);
    for (scale, body) in scale.iter_mut().zip(bodies).skip(1) {
        if !body.turns {
            *scale = S::zero();
            continue;
        }
        let massless = body.inertia.least_magnitude() == 0.0;
        if massless && scale.least_magnitude() == 0.0 {
            // the body has no length of its own: it gets that of the largest body of the model, or 1 m
            *scale = if largest.least_magnitude() > 0.0 { largest } else { body.mass };
        }
        let added = *scale * S::constant(ADDED);
        let suffices = !massless && (added / body.inertia).least_magnitude() < 1.0;
        *scale = if suffices { S::zero() } else { added };
    }
    scale
}

/// Mass added to the internal coordinates of elements, kg.
pub(super) fn own_mass<S: Real>(bodies: &[Body<S>]) -> S {
    let heaviest = bodies.iter().map(|body| body.mass).fold(S::zero(), S::max);
    S::select(heaviest, heaviest, S::one()) * S::constant(ADDED)
}
