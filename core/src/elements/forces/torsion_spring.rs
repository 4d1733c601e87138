//! Rotational spring-damper (Haug 6.2.18): a torque that depends on the relative angle and its rate.
//!
//! θ = φⱼ - φᵢ is continuous and never reduced modulo 2π. The torque on j is -k (θ - θ₀) - c θ̇ - T₀, and the
//! opposite torque acts on i. V = ½ k (θ - θ₀)² + T₀ (θ - θ₀). All real θ are allowed.

use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, Part, SceneSymbol, Situation,
    Wrenches,
};
use crate::math::{Listed, Real, Wrench};

element! {
    /// Rotational spring-damper (Haug 6.2.18): the torque on body j is -(stiffness (θ -
    /// free_angle) + damping θ̇ + preload), where θ = angle_j - angle_i is continuous. The opposite
    /// torque acts on body i.
    TorsionSpring, "torsion_spring" {
        /// Body i.
        i: body,
        /// Body j.
        j: body,
        /// Torque per angle.
        stiffness: law [N*m/rad] = 0.0,
        /// Torque per angular velocity.
        damping: law [N*m*s/rad] = 0.0,
        /// Relative angle at which the spring is relaxed.
        free_angle: law [rad] = 0.0,
        /// Torque of the relaxed spring; a positive value acts clockwise on body j.
        preload: law [N*m] = 0.0,
    }
}

impl Force for TorsionSpring {
    const MEASURED: &'static [Measured] = &[Measured::ANGLE];
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
    ];

    #[inline]
    fn bodies<S>(e: &TorsionSpring<S>) -> Vec<BodyId> {
        vec![e.i, e.j]
    }

    #[inline]
    fn measure<S: Real>(_: &TorsionSpring<S>, at: &At<'_, S>, out: &mut [S]) {
        out[0] = measure::turned(at);
    }

    fn symbols(e: &TorsionSpring) -> Vec<SceneSymbol> {
        let elastic = e.stiffness != 0.0 || e.preload != 0.0;
        [(elastic, Mark::SpiralSpring), (e.damping != 0.0, Mark::RotaryDashpot)]
            .into_iter()
            .filter(|(acts, _)| *acts)
            .map(|(_, mark)| SceneSymbol::between_bodies(mark, e.i, e.j))
            .list()
    }

    fn action<S: Real>(e: &TorsionSpring<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let stretch = at.j().pose.angle - at.i().pose.angle - e.free_angle;
        let rate = at.j().twist.omega - at.i().twist.omega;
        let (elastic, damping) = (-(e.stiffness * stretch + e.preload), -(e.damping * rate));
        out.put(0, 0, Wrench::torque(-elastic));
        out.put(0, 1, Wrench::torque(elastic));
        out.put(1, 0, Wrench::torque(-damping));
        out.put(1, 1, Wrench::torque(damping));
    }

    #[inline]
    fn free_angle<S: Real>(e: &TorsionSpring<S>) -> Option<S> {
        Some(e.free_angle)
    }

    #[inline]
    fn potential<S: Real>(e: &TorsionSpring<S>, at: &Situation<'_, S>) -> S {
        let stretch = at.j().pose.angle - at.i().pose.angle - e.free_angle;
        S::constant(0.5) * e.stiffness * stretch * stretch + e.preload * stretch
    }
}
