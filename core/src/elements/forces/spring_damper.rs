//! Translational spring-damper (Haug 6.2.10): a force along the line between two points.
//!
//! With d = Pⱼ - Pᵢ, l = |d| and u = d/l: force on j is -k (l - l₀) u - c l̇ u with l̇ = uᵀ ḋ; opposite
//! on i. V = ½ k (l - l₀)².
//!
//! The stiffness part is computed as -k d + k l₀ u, so that with l₀ = 0 it is -k d exactly, without a
//! division. Where the points meet, l = 0, the line has no direction. There k l₀ u jumps; it is taken
//! as zero, the mean over all directions. The damping force is -c ḋ, its limit on both sides of a
//! passage. All states are allowed, and the force is finite in all of them.

use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, Part, SceneSymbol, Situation,
    Wrenches,
};
use crate::math::{Local, Real, Vec2, Wrench};

element! {
    /// Translational spring-damper between two points: with l their distance, the force on j is
    /// -stiffness (l - free_length) - damping dl/dt along the line from i to j; opposite on i (Haug
    /// 6.2.10). Where the points meet the line has no direction: the stiffness force is zero there,
    /// and the damping force is -damping times the relative velocity.
    SpringDamper, "spring_damper" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Force per length.
        stiffness: law [N/m] = 0.0,
        /// Force per velocity.
        damping: law [N*s/m] = 0.0,
        /// Distance of the points at which the spring is relaxed.
        free_length: law [m] = 0.0,
    }
}

/// d, l² and l, which is zero with zero slopes where the points meet.
fn line<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>) -> (Vec2<S>, S, S) {
    let d = at.j().pose.point(e.j.s) - at.i().pose.point(e.i.s);
    let squared = d.dot(d);
    (d, squared, S::select(squared, squared.sqrt(), S::zero()))
}

impl Force for SpringDamper {
    const MEASURED: &'static [Measured] = &[Measured::LENGTH];
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
    ];

    fn bodies<S>(e: &SpringDamper<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn measure<S: Real>(e: &SpringDamper<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::length(at, &e.i, &e.j);
    }

    fn symbols(e: &SpringDamper) -> Vec<SceneSymbol> {
        [(e.stiffness, Mark::Spring), (e.damping, Mark::Dashpot)]
            .into_iter()
            .filter(|(coefficient, _)| *coefficient != 0.0)
            .map(|(_, mark)| SceneSymbol::between_points(mark, &e.i, &e.j))
            .collect()
    }

    fn action<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let (d, squared, l) = line(e, at);
        let apart = at.j().point_velocity(e.j.s) - at.i().point_velocity(e.i.s);
        let zero = S::zero();
        let u = Vec2::new(S::select(squared, d.x / l, zero), S::select(squared, d.y / l, zero));
        let rate = u.dot(apart);
        let along = |u: S, apart: S| S::select(squared, u * rate, apart);
        let damped = Vec2::new(along(u.x, apart.x), along(u.y, apart.y));
        let stretched = d - u.scale(e.free_length);
        let (arm_i, arm_j) = (at.i().pose.global(e.i.s), at.j().pose.global(e.j.s));
        let (elastic, damping) = (stretched.scale(e.stiffness), damped.scale(e.damping));
        out.put(0, 0, Wrench::at(arm_i, elastic));
        out.put(0, 1, Wrench::at(arm_j, -elastic));
        out.put(1, 0, Wrench::at(arm_i, damping));
        out.put(1, 1, Wrench::at(arm_j, -damping));
    }

    fn points<S: Real>(e: &SpringDamper<S>) -> Option<[Local<S>; 2]> {
        Some([e.i.s, e.j.s])
    }

    fn potential<S: Real>(e: &SpringDamper<S>, at: &Situation<'_, S>) -> S {
        let (_, _, l) = line(e, at);
        let stretch = l - e.free_length;
        S::constant(0.5) * e.stiffness * stretch * stretch
    }
}
