//! Generalized force: a given effort that increases a position quantity.
//!
//! With the quantity s(q) and the effort Q, the force on the coordinates of each body is Q ∂s/∂q, so that its power
//! is Q ṡ; the work counts as applied. ∂s/∂q is computed from the formula of the quantity by dual numbers. All states
//! are allowed.

use crate::elements::{
    element, BodyId, Force, Mark, Nature, Part, SceneSymbol, Situation, Wrenches,
};
use crate::math::{Listed, Real};

element! {
    /// Generalized force: an effort on a position quantity. A positive effort increases the
    /// quantity. The power is value × rate of the quantity. The effort acts on both bodies of the
    /// quantity in opposite directions. If the quantity has a single body, the opposite effort acts
    /// on ground.
    GeneralizedForce, "generalized_force" {
        /// The quantity, such as `crank.angle`, `crank.B.x` or `slide.displacement`.
        coordinate: acted,
        /// The effort: a force for a length, a torque for an angle; may use `t` and the state.
        value: law [N|N*m],
    }
}

impl Force for GeneralizedForce {
    const PARTS: &'static [Part] = &[Part { name: "applied", nature: Nature::Applied }];

    fn bodies<S>(e: &GeneralizedForce<S>) -> Vec<BodyId> {
        e.coordinate.of.bodies().into()
    }

    fn action<S: Real>(e: &GeneralizedForce<S>, _: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        for (body, wrench) in e.coordinate.wrenches(e.value).into_iter().enumerate() {
            out.put(0, body, wrench);
        }
    }

    fn symbols(e: &GeneralizedForce) -> Vec<SceneSymbol> {
        let arrow = SceneSymbol::drive(&e.coordinate.of);
        let mark = match arrow.mark {
            Mark::DriveTurn => Mark::TorqueArrow,
            _ => Mark::ForceArrow,
        };
        let acts = e.value != 0.0;
        acts.then_some(SceneSymbol { mark, ..arrow }).into_iter().list()
    }
}
