//! Bodies that a pin holds to ground: γ̂ of their pins, and how they weigh.

use super::constraints::Stabilized;
use crate::elements::VelocityTerms;
use crate::math::{Motion, Real, Vec2};
use crate::model::Anchor;
use crate::solve::{Anchor as Held, Saddle, Weight};

/// γ̂ of the pins that are anchors into `right`, shape (n_rows); the weights of their bodies, turned.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub(super) fn begin<S: Real>(
    anchors: &[Anchor<S>],
    motions: &[Motion<S>],
    stabilized: Stabilized<S>,
    saddle: &mut Saddle<S>,
    right: &mut [S],
) {
    let (weights, motions) = (&mut saddle.weights[..], &motions[1..]);
    for (anchor, held) in anchors.iter().zip(&mut saddle.anchors) {
        let motion = &motions[anchor.body as usize];
        let shift = turn(anchor, motion, &mut weights[anchor.body as usize], held);
        let gamma: &mut [S; 2] =
            right[anchor.row as usize..].first_chunk_mut().expect("two rows of its own");
        stabilized.put(&terms(anchor, motion, shift), gamma);
    }
}

/// Φ, Φ̇ and γ of the pin: those of a revolute joint (Haug 3.3.10) with one body that never moves.
#[inline(always)]
fn terms<S: Real>(anchor: &Anchor<S>, motion: &Motion<S>, shift: Vec2<S>) -> VelocityTerms<S, 2> {
    let across = shift.scale(anchor.sign);
    let (arm, omega) = (-across.perp(), motion.twist.omega);
    let gap = (motion.pose.r - anchor.ground).scale(anchor.sign) + arm;
    let rate = motion.twist.velocity.scale(anchor.sign) + across.scale(omega);
    let gamma = arm.scale(omega * omega);
    VelocityTerms { residual: [gap.x, gap.y], rate: [rate.x, rate.y], gamma: [gamma.x, gamma.y] }
}

/// The shift from the origin to the pin, and the moment of the mass about the pin, at a pose; gives the shift.
#[inline(always)]
pub(super) fn turn<S: Real>(
    anchor: &Anchor<S>,
    motion: &Motion<S>,
    weight: &mut Weight<S>,
    held: &mut Held<S>,
) -> Vec2<S> {
    let [shift, moment] = [&anchor.point, &anchor.moment].map(|s| motion.pose.turning(s));
    // each by itself: what was written is not waited for
    weight.shift = [shift.x, shift.y];
    held.shift = [shift.x, shift.y];
    held.moment = [moment.x, moment.y];
    shift
}
