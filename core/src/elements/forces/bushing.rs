//! Bushing: a spring and damper in both directions and in rotation, in the frame of body i.
//!
//! With d = Pⱼ - Pᵢ: (x, y) = Aᵢᵀ d and θ = φⱼ - φᵢ, continuous. The force on j at Pⱼ has the components -kₓ x - cₓ ẋ
//! and -k_y y - c_y ẏ in the frame of body i, the torque is -k_θ θ - c_θ θ̇. The opposite force and torque act on i
//! at the same point. ẋ and ẏ are the time derivatives of x and y, as seen by an observer on body i: (ẋ, ẏ) = Aᵢᵀ (ḋ
//! - ωᵢ ẑ × d). V = ½ (kₓ x² + k_y y² + k_θ θ²). All states are allowed.

use crate::elements::line::arms;
use crate::elements::{
    element, measure, At, BodyId, Force, Mark, Measured, Nature, Part, SceneSymbol, Situation,
    Wrenches,
};
use crate::math::{indexed, Local, Real, Vec2, Wrench};

element! {
    /// Bushing: a spring and damper in two directions and in rotation. x and y are the components
    /// of point_j - point_i in the frame of body i, and angle = angle_j - angle_i. vx, vy and omega
    /// are the time derivatives of x, y and angle. The force and torque on body j at point j are
    /// -stiffness × [x, y, angle] - damping × [vx, vy, omega], in the frame of body i. The opposite
    /// force and torque act on body i at the same place.
    Bushing, "bushing" {
        /// Point of body i, as `body.point`.
        i: point,
        /// Point of body j, as `body.point`.
        j: point,
        /// Force per x, force per y, torque per angle.
        stiffness: triple [N/m, N/m, N*m/rad],
        /// Force per vx, force per vy, torque per omega.
        damping: triple [N*s/m, N*s/m, N*m*s/rad] = [0.0, 0.0, 0.0],
    }
}

/// x, y, θ.
fn position<S: Real>(e: &Bushing<S>, at: &Situation<'_, S>) -> [S; 3] {
    let (i, j) = (at.i().pose, at.j().pose);
    let d = i.rotation.inverse(j.point(e.j.s) - i.point(e.i.s));
    [d.x, d.y, j.angle - i.angle]
}

/// ẋ, ẏ, θ̇.
fn rate<S: Real>(e: &Bushing<S>, at: &Situation<'_, S>) -> [S; 3] {
    let (i, j) = (at.i(), at.j());
    let d = j.pose.point(e.j.s) - i.pose.point(e.i.s);
    let apart = j.point_velocity(e.j.s) - i.point_velocity(e.i.s);
    let seen = i.pose.rotation.inverse(apart - d.perp().scale(i.twist.omega));
    [seen.x, seen.y, j.twist.omega - i.twist.omega]
}

impl Force for Bushing {
    const MEASURED: &'static [Measured] = &[
        Measured::length(["x", "vx", ""]),
        Measured::length(["y", "vy", ""]),
        Measured::angle(["angle", "omega", ""]),
    ];
    const PARTS: &'static [Part] = &[
        Part { name: "stiffness", nature: Nature::Conservative },
        Part { name: "damping", nature: Nature::Dissipative },
    ];

    fn bodies<S>(e: &Bushing<S>) -> Vec<BodyId> {
        vec![e.i.body, e.j.body]
    }

    fn measure<S: Real>(e: &Bushing<S>, at: &At<'_, S>, out: &mut [S]) {
        let d = at.i().rotation.inverse(measure::apart(at, &e.i, &e.j));
        out.copy_from_slice(&[d.x, d.y, measure::turned(at)]);
    }

    fn free_angle<S: Real>(_: &Bushing<S>) -> Option<S> {
        Some(S::zero())
    }

    fn arms<S: Real>(e: &Bushing<S>, at: &Situation<'_, S>) -> Option<[Vec2<S>; 2]> {
        Some(arms(&e.j, at))
    }

    fn action<S: Real>(e: &Bushing<S>, at: &Situation<'_, S>, mut out: impl Wrenches<S>) {
        let i = at.i().pose;
        let [from_i, arm] = arms(&e.j, at);
        let parts = [(e.stiffness, position(e, at)), (e.damping, rate(e, at))];
        for (part, (factor, of)) in parts.into_iter().enumerate() {
            let [x, y, torque] = indexed(|k| -factor[k] * of[k]);
            let force = i.global(Local::new(x, y));
            let with =
                |wrench: Wrench<S>, torque: S| Wrench { torque: wrench.torque + torque, ..wrench };
            out.put(part, 0, with(Wrench::at(from_i, -force), -torque));
            out.put(part, 1, with(Wrench::at(arm, force), torque));
        }
    }

    fn potential<S: Real>(e: &Bushing<S>, at: &Situation<'_, S>) -> S {
        let of = position(e, at);
        let term = |k: usize| e.stiffness[k] * of[k] * of[k];
        S::constant(0.5) * (term(0) + term(1) + term(2))
    }

    fn symbols(e: &Bushing) -> Vec<SceneSymbol> {
        vec![SceneSymbol::between_points(Mark::Sleeve, &e.i, &e.j)]
    }
}
