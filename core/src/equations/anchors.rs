//! Bodies that a pin holds to ground: γ̂ of their pins, and how they weigh.

use super::constraints::Stabilized;
use crate::elements::joints::Revolute;
use crate::elements::Joint;
use crate::math::{Motion, Real};
use crate::model::{Anchor, Model};
use crate::solve::{Anchor as Held, Saddle, Weight};

/// γ̂ of the pins that are anchors into `right`, shape (n_rows); the weights of their bodies, turned.
#[inline(always)] // once in an evaluation: a call saves and restores more than it shares
pub(super) fn begin<S: Real>(
    model: &Model<S>,
    motions: &[Motion<S>],
    stabilized: Stabilized<S>,
    saddle: &mut Saddle<S>,
    right: &mut [S],
) {
    for (anchor, held) in model.anchors.iter().zip(&mut saddle.anchors) {
        turn(anchor, motions, &mut saddle.weights, held);
        let pin = &model.pins[anchor.pin as usize];
        let [i, j] = pin.bodies.map(|body| &motions[body as usize]);
        let terms = <Revolute as Joint<2>>::velocity_terms(&pin.joint(), i, j, S::zero());
        stabilized.put(&terms, &mut right[pin.row as usize..][..2]);
    }
}

/// The shift from the origin to the pin, and the moment of the mass about the pin, at a pose.
#[inline(always)]
pub(super) fn turn<S: Real>(
    anchor: &Anchor<S>,
    motions: &[Motion<S>],
    weights: &mut [Weight<S>],
    held: &mut Held<S>,
) {
    let pose = &motions[anchor.body as usize + 1].pose;
    let (shift, moment) = (pose.global(anchor.point).perp(), pose.global(anchor.moment).perp());
    weights[anchor.body as usize].shift = [shift.x, shift.y];
    held.moment = [moment.x, moment.y];
}
