//! Actuator: a given force along the line between two points, such as the force of a hydraulic cylinder.
//!
//! With u the direction from Pᵢ to Pⱼ, the force on j is F u, and the opposite force acts on i: F > 0 pushes the
//! points apart. Its power is F l̇, where l is the distance of the points; the work counts as applied. Where the
//! points coincide, the line has no direction and the force is zero.

use crate::elements::line::Line;
use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, Part, SceneSymbol, Situation,
    Wrenches,
};
use crate::math::{Local, Real};

element! {
    /// Actuator: a force along the line between two points. A positive force pushes the points
    /// apart. Its power is force × rate, where rate is the derivative of their distance `length`.
    /// The force is zero where the points meet.
    Actuator, "actuator" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Force that pushes the points apart; may use `t` and the state.
        force: law [N],
    }
}

impl Force for Actuator {
    const MEASURED: &'static [Measured] = &[Measured::LENGTH];
    const PARTS: &'static [Part] = &[Part { name: "applied", nature: Nature::Applied }];

    fn bodies<S>(e: &Actuator<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn measure<S: Real>(e: &Actuator<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::length(at, &e.i, &e.j);
    }

    fn points<S: Real>(e: &Actuator<S>) -> Option<[Local<S>; 2]> {
        Some([e.i.s, e.j.s])
    }

    fn action<S: Real>(e: &Actuator<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let line = Line::new(at, &e.i, &e.j);
        let [on_i, on_j] = line.wrenches(line.u.scale(e.force));
        out.put(0, 0, on_i);
        out.put(0, 1, on_j);
    }

    fn symbols(e: &Actuator) -> Vec<SceneSymbol> {
        vec![SceneSymbol::between_points(Mark::Cylinder, &e.i, &e.j)]
    }
}
