//! Applied torque (Haug 6.2.16): a given torque on body j, and the opposite torque on body i.
//!
//! T is a law of time and state; a positive torque turns body j counter-clockwise. Its work counts as
//! applied. All states are allowed.

use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, Part, SceneSymbol, Situation,
    Wrenches,
};
use crate::math::{Listed, Real, Wrench};

element! {
    /// Applied torque on body j, positive counter-clockwise. The opposite torque acts on body i,
    /// which is ground by default.
    Torque, "torque" {
        /// Body j.
        j: body,
        /// Torque on body j; may use `t` and the state.
        torque: law [N*m],
        /// Body i, on which the opposite torque acts.
        i: body = "ground",
    }
}

impl Force for Torque {
    const MEASURED: &'static [Measured] = &[Measured::ANGLE];
    const PARTS: &'static [Part] = &[Part { name: "applied", nature: Nature::Applied }];

    fn bodies<S>(e: &Torque<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    fn measure<S: Real>(_: &Torque<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::turned(at);
    }

    fn symbols(e: &Torque) -> Vec<SceneSymbol> {
        let acts = e.torque != 0.0;
        acts.then(|| SceneSymbol::between_bodies(Mark::TorqueArrow, e.i, e.j)).into_iter().list()
    }

    fn action<S: Real>(e: &Torque<S>, _: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        out.put(0, 0, Wrench::torque(-e.torque));
        out.put(0, 1, Wrench::torque(e.torque));
    }
}
