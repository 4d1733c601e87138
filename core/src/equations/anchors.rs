//! Bodies that a pin holds to ground: γ̂ of their pins, how they weigh, and how their solution begins.

use super::anchor::Anchor;
use super::constraints::{Stabilized, Terms};
use crate::math::{Motion, Real, Vec2};
use crate::solve::{Anchor as Held, Saddle, Weight};

/// Turns the weights of anchored bodies, and begins their part of the solution: `forces` and `right`, shapes (n_q)
/// and (n_rows), become what [`Held::hold`] leaves there. γ̂ is lessened by `held`, shape (n_rows) or empty.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub(super) fn begin<S: Real>(
    anchors: &[Anchor<S>],
    motions: &[Motion<S>],
    stabilized: Stabilized<S>,
    lessened: &[S],
    saddle: &mut Saddle<S>,
    (forces, right): (&mut [S], &mut [S]),
) {
    let motions = &motions[1..];
    let weights = &mut saddle.weights[..motions.len()];
    for (anchor, held) in anchors.iter().zip(&mut saddle.anchors) {
        let (body, row) = (anchor.body as usize, anchor.row as usize);
        let motion = &motions[body];
        let shift = turn(anchor, motion, &mut weights[body], held);
        let mut gamma = [S::zero(); 2];
        let [residual, rate, plain] = terms(anchor, motion, shift);
        let terms = Terms { residual: &residual, rate: &rate, gamma: &plain };
        stabilized.put(&terms, &mut gamma);
        if !lessened.is_empty() {
            gamma.iter_mut().zip(&lessened[row..row + 2]).for_each(|(gamma, held)| *gamma -= *held);
        }
        let of_body =
            forces[3 * body..3 * body + 3].first_chunk_mut().expect("as long as the range");
        held.hold(anchor.sign, of_body, &mut gamma);
        right[row..row + 2].copy_from_slice(&gamma);
    }
}

/// Φ, Φ̇ and γ of the pin: those of a revolute joint (Haug 3.3.10) with one body that never moves.
#[inline(always)]
fn terms<S: Real>(anchor: &Anchor<S>, motion: &Motion<S>, shift: Vec2<S>) -> [[S; 2]; 3] {
    let across = shift.scale(anchor.sign);
    let (arm, omega) = (-across.perp(), motion.twist.omega);
    let gap = (motion.pose.r - anchor.ground).scale(anchor.sign) + arm;
    let rate = motion.twist.velocity.scale(anchor.sign) + across.scale(omega);
    let gamma = arm.scale(omega * omega);
    [[gap.x, gap.y], [rate.x, rate.y], [gamma.x, gamma.y]]
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
