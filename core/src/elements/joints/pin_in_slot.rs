//! Pin in a slot: point Pⱼ of body j stays on a line fixed in body i. Body j may slide along the line and rotate.
//!
//! With u the direction of the line, n = u turned by +90° and d = Pⱼ - Pᵢ: Φ = nᵀ d = 0, the first equation of the
//! translational joint (Haug 3.3.13). All positions are allowed.

use crate::elements::wheels::directions;
use crate::elements::{
    element, measure, At, Attachment, BodyId, Equation, Fixes, Joint, Mark, Measured, SceneSymbol,
    SymbolEnd,
};
use crate::math::Real;

element! {
    /// Pin in a slot: point j stays on the line through point i along the slot (Haug 3.3.13). Φ =
    /// n·d, where n is the left normal of the slot and d = point_j - point_i. The force of the slot
    /// acts at the pin, normal to the slot: +λ along n on body i, and -λ on body j.
    PinInSlot, "pin_in_slot" {
        /// Point of body i on the line of the slot, as `body.point`.
        i: point,
        /// Point of body j, the pin, as `body.point`.
        j: point,
        /// Angle of the slot in the frame of body i.
        axis: number [rad] = 0.0,
    }
}

impl Joint for PinInSlot {
    const RUBS: bool = true;
    const MEASURED: &'static [Measured] = &[Measured::DISPLACEMENT];
    fn bodies<S>(e: &PinInSlot<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn equations<S>(_: &PinInSlot<S>) -> Vec<Equation> {
        vec![Equation::length("normal")]
    }

    fn residual<S: Real>(e: &PinInSlot<S>, at: &At<'_, S>, phi: &mut [S]) {
        let (_, n) = directions(e.axis, at.i());
        phi[0] = n.dot(measure::apart(at, &e.i, &e.j));
    }

    fn measure<S: Real>(e: &PinInSlot<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::along(at, e.axis, &e.i, &e.j);
    }

    fn symbols(e: &PinInSlot) -> Vec<SceneSymbol> {
        let i = SymbolEnd::point(&e.i).along(e.axis);
        vec![SceneSymbol::new(Mark::Slot, i, SymbolEnd::point(&e.j))]
    }

    fn attachment<S: Real>(e: &PinInSlot<S>, body: usize) -> Attachment<S> {
        match body {
            0 => Attachment { s: e.i.s, axis: e.axis },
            _ => Attachment { s: e.j.s, axis: S::zero() },
        }
    }

    fn fixes<S: Clone>(_: &PinInSlot<S>) -> Vec<Fixes<S>> {
        vec![Fixes::Line]
    }
}
