//! A pin whose residual is written in the frame of body i: Φ = Aᵢᵀ (Pⱼ - Pᵢ). Its columns are not
//! constant, its λ are not those of a revolute joint, and its reactions are.

use crate::elements::{element, At, Attachment, BodyId, Equation, Fixes, Joint};
use crate::math::Real;

element! {
    /// A pin in the frame of body i.
    TurnedPin, "turned_pin" {
        /// Point of body i.
        i: point,
        /// Point of body j.
        j: point,
    }
}

impl Joint for TurnedPin {
    const CONDENSES: bool = true;

    fn bodies<S>(e: &TurnedPin<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &TurnedPin<S>) -> Vec<Equation> {
        vec![Equation::length("x"), Equation::length("y")]
    }

    fn residual<S: Real>(e: &TurnedPin<S>, at: &At<'_, S>, phi: &mut [S]) {
        let gap = at.i().rotation.inverse(at.j().point(e.j.s) - at.i().point(e.i.s));
        phi.copy_from_slice(&[gap.x, gap.y]);
    }

    fn attachment<S: Real>(e: &TurnedPin<S>, body: usize) -> Attachment<S> {
        Attachment { s: [e.i.s, e.j.s][body], axis: S::zero() }
    }

    fn fixes<S: Clone>(_: &TurnedPin<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Points]
    }
}
