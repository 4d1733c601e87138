//! Point force: a given force at a point of body j, and the opposite force on body i at the same point.
//!
//! F has two components, in the global frame or in the frame of body i or j. With the point Pⱼ, the wrench on body i
//! about its origin is (-F, -(Pⱼ - rᵢ) × F). The power is therefore F times the velocity of Pⱼ relative to body i at
//! this point; the work counts as applied. All states are allowed.

use crate::elements::line::arms;
use crate::elements::{
    element, At, BodyId, Force, Frame, Mark, Measured, Nature, Part, SceneSymbol, Situation,
    SymbolEnd, Wrenches,
};
use crate::math::{Local, Real, ShortArray, Vec2, Wrench};

element! {
    /// Force at a point of body j. The opposite force acts at the same place on body i, which is
    /// ground by default. The power of the force is force × (velocity of the point - velocity of
    /// body i at that place).
    PointForce, "force" {
        /// Point of body j, as `body.point`.
        j: point,
        /// Components of the force on body j; may use `t` and the state.
        force: law_pair [N],
        /// Body i, on which the opposite force acts.
        i: body = "ground",
        /// Frame of the components: `global`, or the frame of body `i` or `j`.
        frame: frame = "global",
    }
}

impl Force for PointForce {
    const MEASURED: &'static [Measured] =
        &[Measured::length(["x", "vx", "ax"]), Measured::length(["y", "vy", "ay"])];
    const PARTS: &'static [Part] = &[Part { name: "applied", nature: Nature::Applied }];

    fn bodies<S>(e: &PointForce<S>) -> Vec<BodyId> {
        vec![e.i, e.j.body]
    }

    fn measure<S: Real>(e: &PointForce<S>, at: &At<'_, S>, out: &mut [S]) {
        let place = at.j().point(e.j.s);
        out.copy_from_slice(&[place.x, place.y]);
    }

    fn arms<S: Real>(e: &PointForce<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(arms(&e.j, at))
    }

    fn action<S: Real>(e: &PointForce<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let [x, y] = e.force;
        let force = match e.frame {
            Frame::Global => Vec2::new(x, y),
            Frame::I => at.i().pose.global(Local::new(x, y)),
            Frame::J => at.j().pose.global(Local::new(x, y)),
        };
        let [from_i, arm] = arms(&e.j, at);
        out.put(0, 0, Wrench::at(from_i, -force));
        out.put(0, 1, Wrench::at(arm, force));
    }

    fn symbols(e: &PointForce) -> Vec<SceneSymbol> {
        if e.force == [0.0, 0.0] {
            return Vec::new();
        }
        // a varying component is drawn in its positive direction
        let [x, y] = e.force.each(|x| if x.is_nan() { 1.0 } else { x });
        let axes = match e.frame {
            Frame::Global => BodyId::GROUND,
            Frame::I => e.i,
            Frame::J => e.j.body,
        };
        let i = SymbolEnd::body(axes).along(y.atan2(x));
        vec![SceneSymbol::new(Mark::ForceArrow, i, SymbolEnd::point(&e.j))]
    }
}
